"""Curves and pieces that run the other way."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.values import BSplineCurve, Piece


def reversed_curve(curve: BSplineCurve) -> BSplineCurve:
    """A curve over [0, 1] that runs the other way."""
    control_points = curve.control_points[::-1]
    if curve.periodic:  # the points beyond the seam have changed sides
        control_points = np.roll(control_points, curve.degree, axis=0)
    knots = np.ascontiguousarray(1.0 - curve.knots[::-1])
    points = np.ascontiguousarray(control_points)
    return type(curve).trusted(knots, points, curve.degree, curve.periodic)


def backwards(pieces: Sequence[Piece]) -> tuple[Piece, ...]:
    """The same pieces run through from their end to their beginning."""
    return tuple(
        piece._replace(
            knots=1.0 - piece.knots[::-1],
            control_points=np.ascontiguousarray(piece.control_points[::-1]),
            arc=None if piece.arc is None else piece.arc.reversed(),
        )
        for piece in reversed(pieces)
    )
