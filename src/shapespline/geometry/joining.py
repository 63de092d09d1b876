"""Pieces laid end to end, exactly: lines, Beziers and splines of mixed degree as one B-spline.

Every piece is raised to one degree, exactly (by blossoms, Ramshaw 1989), and pieces are laid end to
end on [0, 1]. A node without common tangent is a knot of full multiplicity; where the tangents
agree the widths of the parameter intervals are chosen so that the speeds agree too, the curve is C1
and one knot less.
"""

from __future__ import annotations

from functools import cache
from itertools import accumulate, combinations, pairwise, starmap
from math import atan2, comb, dist, hypot
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.values import EXACT_TURN, BSplineCurve, Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray

# Control points beside a node that are closer to it than this part of the others leave the node a
# full knot; so does a parameter interval so many times as long, or short, as the piece asks for
# (GEO-11).
LARGEST_RATIO, MOST_UNEVEN = 1e5, 10.0
# Parameter intervals are at least this part of all, so that their sums can be told apart (GEO-08).
LEAST_PART = 1e-12


def turn_between(before: Piece, after: Piece) -> float:
    """Signed angle from the end of one piece to the start of the next, radians.

    Examples
    --------
    >>> right = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[0.0, 0], [1, 0]]))
    >>> up = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[1.0, 0], [1, 1]]))
    >>> round(float(np.degrees(turn_between(right, up))), 6)
    90.0
    """
    return _turn(_way(before.control_points[-2:].tolist()), _way(after.control_points[:2].tolist()))


def turns_of(pieces: Sequence[Piece], closed: bool) -> list[float]:
    """Signed turns between neighbours, radians; of a closed curve that at the seam comes first.

    Examples
    --------
    >>> from shapespline import fit_curve
    >>> square = fit_curve([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True, tolerance=0.01)
    >>> np.abs(np.degrees(turns_of(square.pieces, closed=True))).round(6).tolist()
    [90.0, 90.0, 90.0, 90.0]
    """
    seam = [(pieces[-1], pieces[0])] if closed and pieces else []
    return [turn_between(before, after) for before, after in (*seam, *pairwise(pieces))]


class _Polygon(NamedTuple):
    """Of a piece's control polygon its length and its first and last way between two points.

    Numbers, not arrays: of a glyph's pieces each is looked at several times.
    """

    length: float
    first_leg: tuple[float, float]
    last_leg: tuple[float, float]


def _polygon_of(piece: Piece) -> _Polygon:
    """That of a piece."""
    points = piece.control_points.tolist()
    length = sum(starmap(dist, pairwise(points)))
    return _Polygon(length, _way(points[:2]), _way(points[-2:]))


def _way(ends: Sequence[Sequence[float]]) -> tuple[float, float]:
    """From one point to another."""
    (ax, ay), (bx, by) = ends
    return bx - ax, by - ay


def _turn(leg: tuple[float, float], after: tuple[float, float]) -> float:
    """Signed angle from one way to the next."""
    (ux, uy), (vx, vy) = leg, after
    return atan2(ux * vy - uy * vx, ux * vx + uy * vy)


def joined(pieces: Sequence[Piece], degree: int | None = None) -> BSplineCurve:
    """All pieces as one clamped B-spline over [0, 1]: the same curve.

    Parameters
    ----------
    pieces : sequence of Piece
        End to end, each clamped over [0, 1] and at most of the degree.
    degree : int, optional
        1 to 9; the highest among the pieces when not given.

    Examples
    --------
    >>> right = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[0.0, 0], [1, 0]]))
    >>> up = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[1.0, 0], [1, 1]]))
    >>> corner = joined([right, up], 3)
    >>> corner.knots.tolist()
    [0.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0, 1.0]
    >>> corner([0.25, 0.5]).tolist()
    [[0.5, 0.0], [1.0, 0.0]]
    """
    if degree is None:
        degree = max(piece.degree for piece in pieces)
    raised = [elevated(piece, degree) for piece in pieces]
    widths, smooth = _intervals(raised)
    total = sum(widths)
    if min(widths) < LEAST_PART * total:
        smooth = [False] * len(raised)
        widths = [piece.polygon_length for piece in raised]
        least = LEAST_PART * sum(widths)
        widths = [max(width, least) for width in widths]
        total = sum(widths)
    ends = [along / total for along in accumulate(widths, initial=0.0)]
    ends[-1] = 1.0
    knots, points = [0.0] * (degree + 1), [raised[0].control_points[:1]]
    for i, piece in enumerate(raised):
        inner = piece.knots[degree + 1 : -degree - 1].tolist()
        last = i == len(raised) - 1
        drop = 0 if last else int(smooth[i + 1])
        knots += [ends[i] + u * (ends[i + 1] - ends[i]) for u in inner]
        knots += [ends[i + 1]] * (degree + 1 if last else degree - drop)
        points.append(piece.control_points[1 : len(piece.control_points) - drop])
    return BSplineCurve(knots, np.concatenate(points), degree)


def _c1_possible(before: _Polygon, after: _Polygon) -> bool:
    """Whether a common tangent and bounded intervals allow the same speed on both sides."""
    u, v = hypot(*before.last_leg), hypot(*after.first_leg)
    return (
        abs(_turn(before.last_leg, after.first_leg)) < EXACT_TURN
        and u < LARGEST_RATIO * v
        and v < LARGEST_RATIO * u
    )


def _intervals(pieces: Sequence[Piece]) -> tuple[list[float], list[bool]]:
    """Parameter widths, and which pieces go on from the one before as fast as it ends.

    Widths are polygon lengths, scaled along smooth chains so that speeds agree; a piece that would
    be so much faster or slower than its length asks for begins a chain of its own (GEO-11).
    """
    polygons = [_polygon_of(piece) for piece in pieces]
    widths, smooth = [polygons[0].length], [False]
    for (before, left), (piece, right) in pairwise(zip(pieces, polygons, strict=True)):
        length, goes_on = right.length, piece.degree > 1 and _c1_possible(left, right)
        width = _as_fast(before, left, piece, right, widths[-1]) if goes_on else length
        even = length <= MOST_UNEVEN * width and width <= MOST_UNEVEN * length
        smooth.append(goes_on and even)
        widths.append(width if even else length)
    return widths, smooth


def _as_fast(before: Piece, left: _Polygon, piece: Piece, right: _Polygon, width: float) -> float:
    """Width of a piece that begins as fast as the one before, of that width, ends."""
    degree = piece.degree
    gap_before = width * (before.knots[-degree - 1] - before.knots[-degree - 2])
    u, v = hypot(*left.last_leg), hypot(*right.first_leg)
    gap = piece.knots[degree + 1] - piece.knots[degree]
    return float(gap_before * v / u / gap)


def elevated(piece: Piece, degree: int) -> Piece:
    """The same piece with a higher degree, exact up to rounding.

    Control point i is the blossom at degree consecutive knots, and the blossom of a polynomial
    read with a higher degree is the mean of its own over all choices of arguments (Ramshaw 1989).
    """
    p = piece.degree
    if p == degree:
        return piece
    if len(piece.control_points) == p + 1:
        knots = np.repeat(piece.knots[[0, -1]], degree + 1)
        points = _elevation_matrix(p, degree) @ piece.control_points
        return Piece("bezier", degree, knots, points)
    breakpoints, counts = np.unique(piece.knots, return_counts=True)
    knots = np.repeat(breakpoints, counts + degree - p)
    points = np.empty((len(knots) - degree - 1, 2))
    for i in range(len(points)):
        # Any span of the support will do: the first that is not empty.
        begin = knots[i + 1 : i + degree + 1].min()
        span = int(np.searchsorted(piece.knots, begin, side="right")) - 1
        span = min(span, len(piece.control_points) - 1)
        choices = combinations(knots[i + 1 : i + degree + 1], p)
        points[i] = np.mean([blossom(piece, span, arguments) for arguments in choices], axis=0)
    points[0], points[-1] = piece.control_points[0], piece.control_points[-1]
    return Piece("spline", degree, knots, points)


@cache
def _elevation_matrix(p: int, degree: int) -> FloatArray:
    """Control points of a Bezier of degree p turned into those of a higher degree."""
    return np.array(
        [
            [comb(p, j) * comb(degree - p, i - j) / comb(degree, i) if i >= j else 0.0
             for j in range(p + 1)]
            for i in range(degree + 1)
        ]
    )  # fmt: skip


def blossom(piece: Piece, span: int, arguments: tuple[float, ...]) -> FloatArray:
    """Polar form of the polynomial of one span (de Boor's algorithm with mixed arguments)."""
    p, knots = piece.degree, piece.knots
    work = piece.control_points[span - p : span + 1].copy()
    for r, u in enumerate(arguments, start=1):
        low, high = knots[span - p + r : span + 1], knots[span + 1 : span + p + 2 - r]
        share = ((u - low) / (high - low))[:, None]
        work = (1 - share) * work[:-1] + share * work[1:]
    return work[0]
