"""Which closed outline lies directly inside which: the even-odd rule for a few witnesses."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour

# Vertices of an outline that are asked whether they lie inside another: where outlines touch or
# share a stretch, a single one may be told wrong (GEO-03).
WITNESSES = 7


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

    A polygon lies inside another if its box and its area are not the larger ones and most of a
    few of its vertices are inside by the even-odd rule.

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
    if not polygons:
        return []
    areas = np.array([abs(signed_area(points)) for points in polygons])
    # Equal areas: the earlier one is the outer one, so that no two contain each other.
    order: IntArray = np.argsort(-areas, kind="stable")
    lows = np.array([polygons[i].min(axis=0) for i in order])
    highs = np.array([polygons[i].max(axis=0) for i in order])
    parents = [-1] * len(polygons)
    for rank, child in enumerate(order):
        boxed = (lows[:rank] <= lows[rank]).all(axis=1) & (highs[:rank] >= highs[rank]).all(axis=1)
        points = polygons[child]
        witnesses = points[np.linspace(0, len(points), WITNESSES, endpoint=False).astype(int)]
        # Areas fall, so the last container is the smallest one.
        for outer in order[:rank][boxed][::-1]:
            inside = sum(_contains(polygons[outer], point) for point in witnesses)
            if 2 * inside > WITNESSES:
                parents[child] = int(outer)
                break
    return parents


def signed_area(points: FloatArray) -> float:
    """Shoelace formula, positive if counter-clockwise."""
    x, y = (points - points[0]).T
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def _contains(polygon: FloatArray, point: FloatArray) -> bool:
    """Even-odd rule: whether a ray to the right crosses the polygon an odd number of times."""
    ahead = np.roll(polygon, -1, axis=0)
    x, y = point
    # Half-open in y, so that a ray through a vertex counts it once.
    crossed = (polygon[:, 1] > y) != (ahead[:, 1] > y)
    start, end = polygon[crossed], ahead[crossed]
    at = start[:, 0] + (y - start[:, 1]) / (end[:, 1] - start[:, 1]) * (end[:, 0] - start[:, 0])
    return bool(np.count_nonzero(at > x) % 2)
