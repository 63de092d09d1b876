"""Which closed outline lies directly inside which: the even-odd rule for a few witnesses."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour

# Vertices of an outline that are asked whether they lie inside another: where outlines touch or
# share a stretch, a single one may be told wrong (GEO-03).
WITNESSES = 7
# Polygons that are asked at once; the nearest in size, which most often is the one, by itself.
MOST_AT_ONCE = 256


def parents_of(contours: Sequence[Contour]) -> list[int]:
    """For each contour the closed one directly around it, -1 for none; open ones lie in nothing.

    Examples
    --------
    >>> from shapespline import Contour
    >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> parents_of([Contour(4 * square - 1, closed=True), Contour(square, closed=True)])
    [-1, 0]
    """
    closed = [index for index, contour in enumerate(contours) if contour.closed]
    parents = [-1] * len(contours)
    around = containing([contours[index].points for index in closed])
    for index, parent in zip(closed, around, strict=True):
        parents[index] = closed[parent] if parent >= 0 else -1
    return parents


def containing(polygons: Sequence[FloatArray]) -> list[int]:
    """For each polygon the smallest other one around it, -1 for none.

    A polygon lies inside another if its box is not the larger one, its area is smaller and most of
    a few of its vertices are inside by the even-odd rule.

    Parameters
    ----------
    polygons : sequence of ndarray, shape (n_i, 2)
        Vertices of closed polygons in any order.

    Examples
    --------
    >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> containing([square, 4 * square - 1, square + 5])
    [1, -1, -1]
    """
    sides = _sides(polygons)
    parents = [-1] * len(polygons)
    for child, witnesses, boxed in _candidates(polygons):
        parents[child] = _first_around(witnesses, sides, boxed)
    return parents


def all_containing(polygons: Sequence[FloatArray]) -> list[list[int]]:
    """For each polygon all others around it, as `containing` tells it, the smallest first.

    Parameters
    ----------
    polygons : sequence of ndarray, shape (n_i, 2)
        Vertices of closed polygons in any order.

    Examples
    --------
    >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> all_containing([square, 4 * square - 1, 9 * square - 2])
    [[1, 2], [2], []]
    """
    sides = _sides(polygons)
    around: list[list[int]] = [[] for _ in polygons]
    for child, witnesses, boxed in _candidates(polygons):
        first = _first_around(witnesses, sides, boxed)
        if first < 0:
            continue
        # What lies around that one lies around this one.
        known = {first, *around[first]}
        others = [k for k in boxed[list(boxed).index(first) :].tolist() if k not in known]
        if others:
            held = _held(witnesses, [sides[k] for k in others])
            known.update(k for k, n in zip(others, held, strict=True) if 2 * n > len(witnesses))
        around[child] = [k for k in boxed.tolist() if k in known]
    return around


def holding(points: FloatArray, polygons: Sequence[FloatArray]) -> list[list[int]]:
    """For each point the polygons that it lies in, by the even-odd rule.

    Parameters
    ----------
    points : ndarray, shape (m, 2)
    polygons : sequence of ndarray, shape (n_i, 2)
        Vertices of closed polygons in any order.

    Examples
    --------
    >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> holding(np.array([(0.5, 0.5), (2.0, 2.0), (9.0, 9.0)]), [square, 4 * square - 1])
    [[0, 1], [1], []]
    """
    if not len(points):
        return []
    sides = _sides(polygons)
    left, low = np.array([polygon.min(axis=0) for polygon in polygons]).T.copy()
    right, high = np.array([polygon.max(axis=0) for polygon in polygons]).T.copy()
    found = []
    for point in points:
        x, y = point
        boxed = np.flatnonzero((left <= x) & (right >= x) & (low <= y) & (high >= y))
        held = _held(point[None], [sides[k] for k in boxed]) if len(boxed) else boxed
        found.append(boxed[held > 0].tolist())
    return found


def _sides(polygons: Sequence[FloatArray]) -> list[FloatArray]:
    """Both ends of each side, shape (n_i, 4)."""
    return [np.hstack([points, np.roll(points, -1, axis=0)]) for points in polygons]


def _candidates(polygons: Sequence[FloatArray]) -> Iterator[tuple[int, FloatArray, IntArray]]:
    """Each polygon, its witnesses, and those that can hold it from the smallest; largest first."""
    if not polygons:
        return
    areas = np.array([abs(signed_area(points)) for points in polygons])
    order: IntArray = np.argsort(-areas, kind="stable")
    lows = np.array([polygons[i].min(axis=0) for i in order])
    highs = np.array([polygons[i].max(axis=0) for i in order])
    for rank, child in enumerate(order):
        boxed = (lows[:rank] <= lows[rank]).all(axis=1) & (highs[:rank] >= highs[rank]).all(axis=1)
        boxed &= areas[order[:rank]] > areas[child]  # no two contain each other
        points = polygons[child]
        witnesses = points[np.linspace(0, len(points), WITNESSES, endpoint=False).astype(int)]
        # Areas fall, so the last candidate is the smallest one.
        yield int(child), witnesses, order[:rank][boxed][::-1]


def _first_around(witnesses: FloatArray, sides: Sequence[FloatArray], outers: IntArray) -> int:
    """The first of some polygons that holds most of the witnesses, -1 if none does."""
    begin, count = 0, 1
    while begin < len(outers):
        asked = outers[begin : begin + count]
        inside = _held(witnesses, [sides[outer] for outer in asked])
        if (2 * inside > len(witnesses)).any():
            return int(asked[np.argmax(2 * inside > len(witnesses))])
        begin, count = begin + count, min(2 * count, MOST_AT_ONCE)
    return -1


def signed_area(points: FloatArray) -> float:
    """Shoelace formula, positive if counter-clockwise."""
    x, y = (points - points[0]).T
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def _held(points: FloatArray, polygons: Sequence[FloatArray]) -> IntArray:
    """How many points each polygon, given by its sides, holds: rays to the right cross it."""
    starts = np.cumsum([0, *(len(sides) for sides in polygons[:-1])])
    sides = np.concatenate(polygons)
    inside = np.zeros(len(polygons), dtype=np.int64)
    for x, y in points:
        # Half-open in y, so that a ray through a vertex counts it once.
        crossed = np.flatnonzero((sides[:, 1] > y) != (sides[:, 3] > y))
        x0, y0, x1, y1 = sides[crossed].T
        right = crossed[x0 + (y - y0) / (y1 - y0) * (x1 - x0) > x]
        owners = np.searchsorted(starts, right, side="right") - 1
        inside += np.bincount(owners, minlength=len(polygons)) % 2
    return inside
