"""Tangents at the ends of an outline, kept by virtual end extensions.

Some points stand before the first one, in a row along the tangent. A line follows them and the
curve must join it smoothly. The extension is cut off again (PIE-15).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.pieces.constraints import Constraints
from shapespline.values import SMOOTH_TURN, Contour

if TYPE_CHECKING:
    from shapespline.engines.pieces.problem import PiecesProblem
    from shapespline.typing import FloatArray
    from shapespline.values import Piece

# Points of an extension, and its length in tolerances.
N_EXTENSION, EXTENSION_LENGTH = 8, 20.0
# Tangents that the search has brought so near, radians, are made exact; that is verified later.
NEARLY = 3.0 * SMOOTH_TURN


def extended(problem: PiecesProblem) -> PiecesProblem:
    """The problem with a straight extension at each end whose tangent is kept."""
    begin, end = problem.constraints.tangents
    if begin is None and end is None:
        return problem
    contour = problem.normalized.contour
    along = EXTENSION_LENGTH * problem.tolerance * np.arange(1, N_EXTENSION + 1) / N_EXTENSION
    parts = [contour.points]
    if begin is not None:
        parts.insert(0, contour.points[0] - along[::-1, None] * begin)
    if end is not None:
        parts.append(contour.points[-1] + along[:, None] * end)
    shift = N_EXTENSION if begin is not None else 0
    n, points = len(contour), np.concatenate(parts)
    first = np.array([] if begin is None else [shift], dtype=np.int64)
    last = np.array([] if end is None else [shift + n - 1], dtype=np.int64)
    at = np.concatenate([first, last])
    low_turn = np.ones(len(points), dtype=np.int64)
    low_turn[shift : shift + n] = problem.low_turn
    through = np.union1d(problem.constraints.through + shift, at)
    constraints = Constraints(True, through, after_extension=first, before_extension=last)
    return problem._replace(
        normalized=problem.normalized._replace(contour=Contour.trusted(points, closed=False)),
        corners=np.setdiff1d(problem.corners + shift, at),
        low_turn=low_turn,
        constraints=constraints,
    )


def without_extensions(pieces: tuple[Piece, ...], problem: PiecesProblem) -> tuple[Piece, ...]:
    """The pieces between the first and the last point of a problem that was extended."""
    begin, end = problem.constraints.tangents
    points = problem.normalized.contour.points
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
