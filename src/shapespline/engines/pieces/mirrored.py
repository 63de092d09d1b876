"""Pieces of a mirror-symmetric outline: one half is fitted, the other one reflected."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.pieces.constraints import Constraints
from shapespline.engines.pieces.engine import PiecesResult, fit_pieces, verified_pieces
from shapespline.geometry import backwards, turn_between
from shapespline.values import Contour, Piece

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from shapespline.engines.pieces.problem import PiecesProblem
    from shapespline.engines.pieces.search import Effort
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray, IntArray

    Sampler = Callable[[FloatArray], NDArray[np.complex128]]
from shapespline.analysis import Mirror, find_mirror

# The outline and its mirror image may differ by this part of the tolerance; the fit has the rest.
LARGEST_PART = 0.2
# A corner that is so near to the axis, in tolerances, lies on it.
ON_AXIS = 4.0
# Points nearer to a crossing along the outline, in parts of its length, are that crossing.
CLOSE = 1e-6
# Two lines that turn less at the axis are one, radians.
STRAIGHT = 1e-6


def fit_mirrored(
    contour: Contour,
    tolerance: float,
    *,
    degree: int,
    effort: Effort,
    monitor: Monitor,
    outline: PiecesProblem,
) -> PiecesResult | None:
    """Pieces of an outline that has a mirror symmetry, symmetric; None if it has none.

    Nor if the half cannot be fitted within what the asymmetry leaves of the tolerance, or meets the
    axis at an angle that is no corner of the outline.
    """
    if not contour.closed or monitor.ended:
        return None
    work = outline.thinned()
    mirror = find_mirror(work.frame.contour)
    if mirror is None or mirror.error > LARGEST_PART * work.tolerance:
        return None
    half, corners, held = _half(work, mirror)
    found = fit_pieces(
        half,
        work.tolerance - mirror.error,
        corners=corners,
        degree=degree,
        effort=effort,
        held=held,
        monitor=monitor,
    )
    if not found.kept or found.tangent_error:
        return None
    other = tuple(
        piece._replace(control_points=mirror.reflected(piece.control_points))
        for piece in backwards(found.pieces)
    )
    other[0].control_points[0] = found.pieces[-1].control_points[-1]
    other[-1].control_points[-1] = found.pieces[0].control_points[0]
    pieces = _without_split_pieces([*found.pieces, *other])
    result = verified_pieces(outline.frame, pieces, contour, tolerance, degree, Constraints())
    return result if result.kept else None


def _half(work: PiecesProblem, mirror: Mirror) -> tuple[Contour, IntArray, Constraints]:
    """The data from one crossing of the axis to the other, its corners, what it must keep."""
    contour = work.frame.contour
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
    if a.degree != b.degree or not abs(turn_between(a, b)) < STRAIGHT:
        return [a, b]
    if a.degree == 1:
        return [a._replace(control_points=np.array([a.control_points[0], b.control_points[-1]]))]
    if len(a.control_points) != len(b.control_points):
        return [a, b]
    # Mirror images have the same parameters: the node between them is half-way, and a knot less.
    p = a.degree
    left, right = 0.5 * a.knots[: -p - 1], 0.5 + 0.5 * b.knots[p + 1 :]
    knots = np.concatenate([left, np.full(p - 1, 0.5), right])
    points = np.concatenate([a.control_points[:-1], b.control_points[1:]])
    return [Piece("spline", p, knots, points)]
