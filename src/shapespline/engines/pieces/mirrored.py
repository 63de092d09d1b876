"""A mirror-symmetric outline in pieces: one half is searched, the other one reflected."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import Mirror, find_mirror
from shapespline.engines.pieces.constraints import Constraints
from shapespline.geometry import backwards, turn_between
from shapespline.values import Contour, Piece

if TYPE_CHECKING:
    from shapespline.engines.pieces.problem import PiecesProblem
    from shapespline.typing import FloatArray, IntArray

# An outline is symmetric if it differs from its mirror image by at most this part of the tolerance;
# the fit has the rest.
LARGEST_PART = 0.2
# A corner lies on the axis if it is at most so many tolerances away from it.
ON_AXIS = 4.0
# A point is the crossing itself if it lies nearer to it, in parts of the outline's length.
CLOSE = 1e-6
# Two lines that turn less at the axis are one, radians: more than rounding, for the axis itself is
# found to some digits only; less than any joint that was drawn.
SAME_LINE_TURN = 1e-6


class MirroredHalf(NamedTuple):
    """One half of a symmetric outline, and what its curve must keep to meet its mirror image.

    ``tolerance`` is what the asymmetry leaves; ``corners`` are indices of ``contour``. All is in
    the unit of the problem.
    """

    contour: Contour
    tolerance: float
    corners: IntArray
    constraints: Constraints
    mirror: Mirror

    @classmethod
    def of(cls, problem: PiecesProblem) -> MirroredHalf | None:
        """The half of a problem whose outline is closed and nearly symmetric, else None."""
        if not problem.normalized.contour.closed:
            return None
        mirror = find_mirror(problem.normalized.contour)
        if mirror is None or mirror.error > LARGEST_PART * problem.tolerance:
            return None
        return cls(*_half(problem, mirror), mirror)

    def whole(self, pieces: tuple[Piece, ...]) -> tuple[Piece, ...]:
        """Pieces of the half and their mirror image, end to end."""
        other = tuple(
            piece._replace(control_points=self.mirror.reflected(piece.control_points))
            for piece in backwards(pieces)
        )
        other[0].control_points[0] = pieces[-1].control_points[-1]
        other[-1].control_points[-1] = pieces[0].control_points[0]
        return _without_split_pieces([*pieces, *other])


def _half(work: PiecesProblem, mirror: Mirror) -> tuple[Contour, float, IntArray, Constraints]:
    """The data from one crossing of the axis to the other, what is left of the tolerance."""
    contour = work.normalized.contour
    stations, least = contour.arc_length[:-1], CLOSE * contour.length
    begin, end = sorted(mirror.crossings)
    first, last = (mirror.projected(point) for point in contour.at(np.array([begin, end])))
    inside = np.flatnonzero((stations > begin + least) & (stations < end - least))
    points = np.concatenate([[first], contour.points[inside], [last]])
    corners = contour.points[work.corners]

    def tangent(node: FloatArray, step: FloatArray) -> FloatArray | None:
        """Square to the axis, the way of a step; none where a corner lies on the axis."""
        if (np.hypot(*(corners - node).T) < ON_AXIS * work.tolerance).any():
            return None
        across = np.array([-mirror.direction[1], mirror.direction[0]])
        return across if step @ across > 0 else -across

    tangents = tangent(first, points[1] - first), tangent(last, last - points[-2])
    marked = 1 + np.flatnonzero(np.isin(inside, work.corners))
    apart = [
        np.hypot(*(points[marked] - node).T) >= ON_AXIS * work.tolerance for node in (first, last)
    ]
    return (
        Contour.silently(points, closed=False),
        work.tolerance - mirror.error,
        marked[apart[0] & apart[1]],
        Constraints(True, tangents=tangents),
    )


def _without_split_pieces(pieces: list[Piece]) -> tuple[Piece, ...]:
    """The pieces, those that meet smoothly on the axis made one: two lines, or two like curves."""
    joined = pieces[:1]
    for piece in pieces[1:]:
        joined[-1:] = _united(joined[-1], piece)
    if len(joined) > 2 and len(seam := _united(joined[-1], joined[0])) == 1:
        joined = [*seam, *joined[1:-1]]
    return tuple(joined)


def _united(a: Piece, b: Piece) -> list[Piece]:
    """One piece instead of two where they go on with the same velocity, else both."""
    if a.degree != b.degree or not abs(turn_between(a, b)) < SAME_LINE_TURN:
        return [a, b]
    if len(a.control_points) == len(b.control_points) == 2:
        return [a._replace(control_points=np.array([a.control_points[0], b.control_points[-1]]))]
    if len(a.control_points) != len(b.control_points):
        return [a, b]
    # Mirror images have the same parameters: the node between them is half-way, and a knot less.
    p = a.degree
    left, right = 0.5 * a.knots[: -p - 1], 0.5 + 0.5 * b.knots[p + 1 :]
    knots = np.concatenate([left, np.full(p - 1, 0.5), right])
    points = np.concatenate([a.control_points[:-1], b.control_points[1:]])
    return [Piece("spline", p, knots, points)]
