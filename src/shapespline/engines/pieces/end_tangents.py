"""Tangents at the ends of an outline, kept by straight stubs.

Some points before the first one, in a row along the tangent: a line follows them and the curve must
join it smoothly. The stub is cut off again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.pieces.constraints import Constraints
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.engines.pieces.problem import PiecesProblem
    from shapespline.typing import FloatArray
    from shapespline.values import Piece

# Points of a stub, and its length in tolerances.
STUB_POINTS, STUB_TOLERANCES = 8, 20.0
# Tangents that the search has brought so near, radians, are made exact; that is verified later.
NEARLY = np.radians(3.0)


def stubbed(outline: PiecesProblem) -> PiecesProblem:
    """The outline with a straight stub at each end whose tangent is held."""
    begin, end = outline.constraints.tangents
    if begin is None and end is None:
        return outline
    contour = outline.normalized.contour
    along = STUB_TOLERANCES * outline.tolerance * np.arange(1, STUB_POINTS + 1) / STUB_POINTS
    parts = [contour.points]
    if begin is not None:
        parts.insert(0, contour.points[0] - along[::-1, None] * begin)
    if end is not None:
        parts.append(contour.points[-1] + along[:, None] * end)
    shift = STUB_POINTS if begin is not None else 0
    n, points = len(contour), np.concatenate(parts)
    first = np.array([] if begin is None else [shift], dtype=np.int64)
    last = np.array([] if end is None else [shift + n - 1], dtype=np.int64)
    at = np.concatenate([first, last])
    gentle = np.ones(len(points), dtype=np.int64)
    gentle[shift : shift + n] = outline.low_turn
    through = np.union1d(outline.constraints.through + shift, at)
    held = Constraints(True, through, after_stub=first, before_stub=last)
    return outline._replace(
        normalized=outline.normalized._replace(contour=Contour.trusted(points, closed=False)),
        corners=np.setdiff1d(outline.corners + shift, at),
        low_turn=gentle,
        constraints=held,
    )


def without_stubs(pieces: tuple[Piece, ...], outline: PiecesProblem) -> tuple[Piece, ...]:
    """The pieces between the first and the last point of an outline that was stubbed."""
    begin, end = outline.constraints.tangents
    points = outline.normalized.contour.points
    if pieces and begin is not None:
        starts = np.array([piece.control_points[0] for piece in pieces])
        pieces = pieces[int(((starts - points[0]) ** 2).sum(axis=1).argmin()) :]
        if pieces[0].degree > 1:
            _turn(pieces[0].control_points[:2], begin)
    if pieces and end is not None:
        ends = np.array([piece.control_points[-1] for piece in pieces])
        pieces = pieces[: int(((ends - points[-1]) ** 2).sum(axis=1).argmin()) + 1]
        if pieces[-1].degree > 1:
            _turn(pieces[-1].control_points[:-3:-1], -end)
    return pieces


def _turn(ends: FloatArray, direction: FloatArray) -> None:
    """Moves the second of two control points into a direction from the first, if that is near."""
    arm = ends[1] - ends[0]
    along = float(arm @ direction)
    if along > np.cos(NEARLY) * np.hypot(*arm):
        ends[1] = ends[0] + along * direction
