"""Pieces that readers make of points, and outlines closed where they were meant to be."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.values import Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import ArrayLike

# Ends closer than this part of an outline's size are the same point, written with few digits or
# reached over many additions.
SAME_END = 1e-9


def bezier(points: ArrayLike) -> Piece:
    """A line or Bezier of its control points, shape (degree + 1, 2)."""
    control_points = np.array(points, dtype=np.float64)
    degree = len(control_points) - 1
    kind = "line" if degree == 1 else "bezier"
    return Piece(kind, degree, np.repeat([0.0, 1.0], degree + 1), control_points)


def closed_up(pieces: Sequence[Piece]) -> list[Piece]:
    """The pieces but for those without extent; ends that all but meet are made to meet."""
    kept = [piece for piece in pieces if np.ptp(piece.control_points, axis=0).any()]
    if not kept:
        return []
    near = SAME_END * size_of(kept)
    while len(kept) > 1 and _reach(kept[-1]) <= near:  # such as the line that closes a path
        kept.pop()
    gap = kept[-1].control_points[-1] - kept[0].control_points[0]
    if (len(kept) > 1 or kept[0].degree > 1) and np.hypot(*gap) <= near:
        kept[-1] = kept[-1].meeting(end=kept[0].control_points[0])
    return kept


def size_of(pieces: Sequence[Piece]) -> float:
    """Diagonal of the box around all control points."""
    points = np.concatenate([piece.control_points for piece in pieces])
    return float(np.hypot(*np.ptp(points, axis=0)))


def _reach(piece: Piece) -> float:
    return float(np.hypot(*np.ptp(piece.control_points, axis=0)))
