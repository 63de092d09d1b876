"""Length, area, box and inside of curves, and points at equal arc length.

Areas are exact up to rounding: the integrand of Green's formula is a polynomial of degree 2p - 1 on
every Bezier piece of degree p, which Gauss-Legendre quadrature with p nodes integrates exactly.
Boxes and the inside come from the monotone parts of the pieces.
"""

from __future__ import annotations

from math import ceil, floor, pi, sin
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.geometry.monotone import bezier_at, critical_parameters, monotone_parts
from shapespline.validation import float_array, is_number, whole_number
from shapespline.values import Arc, BSplineCurve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.typing import ArrayLike, FloatArray
    from shapespline.values import Piece

# Nodes of a length on a part of a span, and parts of a span in the table of arc lengths.
NODES, PARTS = np.polynomial.legendre.leggauss(16), 4
# Steps of Newton's method, kept in its part; each more than doubles the digits or halves the part.
MOST_STEPS = 60
# Points of a curve that a caller may want.
MOST_POINTS = 10_000_000
# Pairs of a point and a part of a curve looked at at a time.
CHUNK = 4_000_000


class Box(NamedTuple):
    """The smallest box with sides along the axes, data units."""

    x_min: float
    y_min: float
    x_max: float
    y_max: float


def enclosed_area(curve: BSplineCurve, pieces: Sequence[Piece] = ()) -> float:
    """Signed area of a closed curve, positive if it runs counter-clockwise.

    Exact up to rounding (Green's formula about the first point); what a curve that crosses itself
    runs around twice counts twice.

    Parameters
    ----------
    curve : BSplineCurve
    pieces : sequence of Piece, optional
        What it was made of: between an arc and its chord lies the segment of the circle, not that
        of the arc's twin.

    Examples
    --------
    >>> from shapespline.values import BSplineCurve
    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2), (0, 0)]
    >>> enclosed_area(BSplineCurve([0, 0, 0.25, 0.5, 0.75, 1, 1], square, degree=1))
    4.0
    """
    beziers = curve.beziers().points
    beziers = beziers - beziers[0, 0]
    nodes, weights = np.polynomial.legendre.leggauss(curve.degree)
    u = np.broadcast_to(0.5 * (nodes + 1), (len(beziers), len(nodes)))
    point = bezier_at(beziers, u)
    velocity = bezier_at(curve.degree * np.diff(beziers, axis=1), u)
    swept = point[..., 0] * velocity[..., 1] - point[..., 1] * velocity[..., 0]
    beside = 0.0
    for piece in pieces:
        if piece.arc is not None:
            arc = piece.arc
            twin = BSplineCurve(piece.knots, piece.control_points, piece.degree)
            segment = 0.5 * arc.radius**2 * (arc.sweep - sin(arc.sweep) * (not arc.is_circle))
            beside += segment - enclosed_area(twin)
    return 0.25 * float(np.sum(swept @ weights)) + beside


def bounds(curves: Sequence[BSplineCurve | Arc]) -> Box:
    """The box of some curves, from the zeros of their derivatives.

    Examples
    --------
    >>> from shapespline.values import BSplineCurve
    >>> bounds([BSplineCurve([0, 0, 0, 1, 1, 1], [(0, 0), (1, 2), (2, 0)], degree=2)])
    Box(x_min=0.0, y_min=0.0, x_max=2.0, y_max=1.0)
    """
    sides = []
    for curve in curves:
        if isinstance(curve, Arc):
            sides.append(_ends_of_box(curve))
            continue
        pieces = curve.beziers().points
        ends = np.array([pieces[:, [0, -1]].min(axis=(0, 1)), pieces[:, [0, -1]].max(axis=(0, 1))])
        for axis in (0, 1):
            values = pieces[..., axis : axis + 1]
            at = bezier_at(values, critical_parameters(values[..., 0]))
            ends[0, axis] = min(ends[0, axis], at.min(initial=np.inf))
            ends[1, axis] = max(ends[1, axis], at.max(initial=-np.inf))
        sides.append(ends)
    low, high = np.min(sides, axis=0)[0], np.max(sides, axis=0)[1]
    return Box(*low.tolist(), *high.tolist())


def _ends_of_box(arc: Arc) -> FloatArray:
    """The corners of the box of an arc, shape (2, 2): of its ends, and where it meets an axis."""
    low, high = sorted((arc.start_angle, arc.end_angle))
    quarters = np.arange(ceil(low / (0.5 * pi)), floor(high / (0.5 * pi)) + 1) % 4
    axes = np.array([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)])[quarters.astype(int)]
    points = np.concatenate([[arc.begin, arc.end], np.array(arc.centre) + arc.radius * axes])
    return np.array([points.min(axis=0), points.max(axis=0)])


def contains(curves: Sequence[BSplineCurve], points: ArrayLike) -> NDArray[np.bool_]:
    """Which points lie inside closed curves by the even-odd rule: in an outline, not in its holes.

    A ray to the right is cut with the parts of the curves on which y is monotone, exactly up to
    rounding; a point on a curve, up to rounding, may count as either.

    Parameters
    ----------
    curves : sequence of BSplineCurve
        Each ends where it begins.
    points : array_like, shape (k, 2) or (2,)

    Returns
    -------
    ndarray of bool, shape (k,)

    Examples
    --------
    >>> from shapespline.values import BSplineCurve
    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2), (0, 0)]
    >>> curve = BSplineCurve([0, 0, 0.25, 0.5, 0.75, 1, 1], square, degree=1)
    >>> contains([curve], [(1, 1), (3, 1)]).tolist()
    [True, False]
    """
    queries = np.atleast_2d(float_array(points, "points"))
    if queries.ndim != 2 or queries.shape[1] != 2 or not np.isfinite(queries).all():
        raise InvalidInputError(
            f"points must be a finite (k, 2) array, got shape {queries.shape} with"
            f" {int((~np.isfinite(queries)).sum())} numbers that are not finite"
        )
    inside = np.zeros(len(queries), dtype=bool)
    for curve in curves:
        parts = monotone_parts(curve, axis=1)
        step = max(1, CHUNK // len(parts))
        for k in range(0, len(queries), step):
            inside[k : k + step] ^= _crossings(parts, queries[k : k + step]) % 2 == 1
    return inside


def _crossings(parts: FloatArray, points: FloatArray) -> NDArray[np.int64]:
    """How many of the parts, monotone in y, a ray to the right of each point crosses."""
    x, y = points[:, 0], points[:, 1]
    begin, end = parts[:, 0, 1], parts[:, -1, 1]
    # Half-open in y, so that a ray through the end of two parts counts once.
    spans = (begin > y[:, None]) != (end > y[:, None])
    beyond = spans & (parts[:, :, 0].min(axis=1) > x[:, None])
    count = np.count_nonzero(beyond, axis=1)
    unclear = spans & ~beyond & (parts[:, :, 0].max(axis=1) > x[:, None])
    who, which = np.nonzero(unclear)
    if len(who):
        at = _at_height(parts[which], y[who])
        np.add.at(count, who, at > x[who])
    return count


def _at_height(parts: FloatArray, y: FloatArray) -> FloatArray:
    """The x of each part, monotone in y, at a height: by bisection, to the last bit."""
    low, high = np.zeros(len(parts)), np.ones(len(parts))
    rising = parts[:, -1, 1] > parts[:, 0, 1]
    for _ in range(MOST_STEPS):
        middle = 0.5 * (low + high)
        below = (bezier_at(parts, middle[:, None])[:, 0, 1] <= y) == rising
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return bezier_at(parts, (0.5 * (low + high))[:, None])[:, 0, 0]


def evenly_spaced(
    curve: BSplineCurve, n_points: int | None = None, *, step: float | None = None, closed: bool
) -> FloatArray:
    """Parameters of points at equal arc length, the first at the beginning of the curve.

    Lengths are those of 16-point Gauss-Legendre quadrature on quarters of the spans, inverted by
    Newton's method kept between bounds.

    Parameters
    ----------
    curve : BSplineCurve
    n_points : int, optional
        How many, 2 or more; 1 or more if closed.
    step : float, optional
        Instead: the largest arc length between neighbours, data units. The spacing is the largest
        one not above it that divides the length.
    closed : bool
        Of a closed curve the end is not repeated.

    Returns
    -------
    ndarray, shape (n,)

    Raises
    ------
    InvalidInputError
        Unless one of both is given and in range.

    Examples
    --------
    >>> from shapespline.values import BSplineCurve
    >>> line = BSplineCurve([0, 0, 1, 1], [(0, 0), (4, 0)], degree=1)
    >>> evenly_spaced(line, 3, closed=False).tolist()
    [0.0, 0.5, 1.0]
    """
    cuts = np.linspace(curve.breakpoints[:-1], curve.breakpoints[1:], PARTS + 1, axis=1)
    begin, end = cuts[:, :-1].ravel(), cuts[:, 1:].ravel()
    table = np.concatenate([[0.0], np.cumsum(_lengths(curve, begin, end))])
    count = _checked_count(n_points, step, float(table[-1]), closed)
    wanted = np.linspace(0.0, table[-1], count, endpoint=not closed)
    part = np.clip(np.searchsorted(table, wanted, side="right") - 1, 0, len(begin) - 1)
    rest = wanted - table[part]
    first, low, high = begin[part], begin[part].copy(), end[part].copy()
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.nan_to_num(rest / (table[part + 1] - table[part]))
    u = first + share * (high - low)
    for _ in range(MOST_STEPS):
        error = _lengths(curve, first, u) - rest
        low, high = np.where(error < 0, u, low), np.where(error > 0, u, high)
        speed = np.hypot(*curve(u, derivative=1).T)
        with np.errstate(divide="ignore", invalid="ignore"):
            after = u - error / speed
        after = np.where((after > low) & (after < high), after, 0.5 * (low + high))
        moved = np.where(error == 0, 0.0, np.abs(after - u))
        u = np.where(error == 0, u, after)
        if moved.max() <= 4 * np.finfo(float).eps:
            break
    u[0] = curve.domain[0]
    if not closed:
        u[-1] = curve.domain[1]
    return u


def _lengths(curve: BSplineCurve, begin: FloatArray, end: FloatArray) -> FloatArray:
    """Arc lengths between parameters within one span each."""
    nodes, weights = NODES
    half = 0.5 * (end - begin)
    at = 0.5 * (begin + end)[:, None] + half[:, None] * nodes
    velocity = curve(at.ravel(), derivative=1)
    return half * (np.hypot(velocity[:, 0], velocity[:, 1]).reshape(at.shape) @ weights)


def _checked_count(n_points: int | None, step: float | None, length: float, closed: bool) -> int:
    """How many points are asked for."""
    if (n_points is None) == (step is None):
        raise InvalidInputError("points needs a number of points or step=, one of both")
    least = 1 if closed else 2
    if step is not None:
        if not (is_number(step) and 0 < step < np.inf):
            raise InvalidInputError(f"step must be a positive length, got {step!r}")
        wanted = float(np.ceil(length / step * (1 - 1e-12)))
        count = max(1.0, wanted) + (0 if closed else 1)
    else:
        whole = whole_number(n_points)
        if whole is None or whole < least:
            raise InvalidInputError(
                f"n must be a whole number of points, {least} or more, got {n_points!r}"
            )
        count = float(whole)
    if count > MOST_POINTS:
        raise InvalidInputError(
            f"{count:.3g} points are more than {MOST_POINTS:.0e}; take fewer or a larger step"
        )
    return int(count)
