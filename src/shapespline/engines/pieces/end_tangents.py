"""Tangents at the ends of an outline, kept by virtual end extensions.

Some points stand before the first one, in a row along the tangent. A line follows them and the
curve must join it smoothly. The extension is cut off again (PIE-15).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.pieces.constraints import Constraints
from shapespline.geometry import backwards, elevated
from shapespline.validation import distinct
from shapespline.values import EXACT_TURN, SMOOTH_TURN, Contour, Piece, with_knot

if TYPE_CHECKING:
    from shapespline.engines.pieces.problem import PiecesProblem
    from shapespline.typing import FloatArray

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
    corners = sorted({*(problem.corners + shift).tolist()} - {*at.tolist()})
    low_turn = np.ones(len(points), dtype=np.int64)
    low_turn[shift : shift + n] = problem.low_turn
    through = distinct(problem.constraints.through + shift, at)
    constraints = Constraints(True, through, after_extension=first, before_extension=last)
    return problem._replace(
        normalized=problem.normalized._replace(contour=Contour.trusted(points, closed=False)),
        corners=np.array(corners, dtype=np.int64),
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
    if pieces and end is not None:
        ends = np.array([piece.control_points[-1] for piece in pieces])
        pieces = pieces[: int(((ends - points[-1]) ** 2).sum(axis=1).argmin()) + 1]
    return pieces


def turned_exactly(
    pieces: tuple[Piece, ...], tangents: tuple[FloatArray | None, FloatArray | None]
) -> None:
    """Turns the ends of pieces, in place, into directions that they have nearly."""
    begin, end = tangents
    if begin is not None and pieces[0].degree > 1:
        _turn(pieces[0].control_points[:2], begin)
    if end is not None and pieces[-1].degree > 1:
        _turn(pieces[-1].control_points[:-3:-1], -end)


def _turn(ends: FloatArray, direction: FloatArray) -> None:
    """Moves the second of two control points into a direction from the first, if that is near."""
    arm = ends[1] - ends[0]
    along = float(arm @ direction)
    if along > np.cos(NEARLY) * np.hypot(*arm):
        ends[1] = ends[0] + along * direction


def with_ends_turned(
    pieces: tuple[Piece, ...],
    tangents: tuple[FloatArray | None, FloatArray | None],
    length: float,
    degree: int,
) -> tuple[Piece, ...]:
    """Pieces that begin and end in some directions: what is so long at an end turns into its own.

    The last resort, where a search finds no curve with these tangents (PIE-24).

    Examples
    --------
    >>> line = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[0.0, 0], [8, 0]]))
    >>> turned = with_ends_turned((line,), (np.array([0.0, 1.0]), None), 3.0, 3)
    >>> turned[0].control_points.tolist()
    [[0.0, 0.0], [0.0, 1.0], [2.0, 0.0], [3.0, 0.0]]
    """
    begin, end = tangents
    if begin is not None:
        pieces = _begun_in(pieces, begin, length, degree)
    if end is not None:
        pieces = backwards(_begun_in(backwards(pieces), -end, length, degree))
    return pieces


def _begun_in(
    pieces: tuple[Piece, ...], direction: FloatArray, length: float, degree: int
) -> tuple[Piece, ...]:
    """Pieces whose first is cut, and its beginning turned into a direction."""
    first = pieces[0]
    (ux, uy), (vx, vy) = direction, first.control_points[1] - first.control_points[0]
    if abs(np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy)) <= EXACT_TURN:
        return pieces
    span = float(first.knots[first.degree + 1])
    speed = first.degree / span * float(np.hypot(vx, vy))
    before, after = _cut(first, min(length / max(speed, length), 0.5 * span))
    raised = elevated(before, max(before.degree, min(degree, 3)))
    points = raised.control_points.copy()
    points[1] = points[0] + np.hypot(*(points[1] - points[0])) * direction
    turned = raised._replace(kind="bezier", control_points=points)
    if raised.degree > 1:
        return (turned, after, *pieces[1:])
    # A line cannot turn: two of them go around, no farther away than a cubic would.
    corner = points[0] + 0.25 * (points[1] - points[0])
    end, knots = after.control_points[0], raised.knots
    return (
        Piece("line", 1, knots, np.array([points[0], corner])),
        Piece("line", 1, knots, np.array([corner, end])),
        after,
        *pieces[1:],
    )


def _cut(piece: Piece, at: float) -> tuple[Piece, Piece]:
    """The parts of a piece before and after a parameter in its first knot interval."""
    p, knots, points = piece.degree, piece.knots, piece.control_points
    for _ in range(p):
        knots, points = with_knot(knots, points, p, at)
    after = np.concatenate([[at], knots[p + 1 :]])
    ends, last = np.repeat([0.0, 1.0], p + 1), len(after) > 2 * p + 2
    kind = "line" if p == 1 else "spline" if last else "bezier"
    return (
        Piece("line" if p == 1 else "bezier", p, ends, points[: p + 1].copy()),
        Piece(kind, p, (after - at) / (1.0 - at), points[p:].copy()),
    )
