"""Nearest points: on a curve, by branch and bound over Bezier pieces; of points, by their order."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.errors import InvalidInputError
from shapespline.validation import float_array

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike, FloatArray, IntArray
    from shapespline.values import BSplineCurve


class Nearest(NamedTuple):
    """Foot parameters and squared distances of query points, both (k,)."""

    parameters: FloatArray
    distances_sq: FloatArray


def nearest(curve: BSplineCurve, points: ArrayLike) -> Nearest:
    """Nearest point of the curve for each query point.

    Every Bezier piece whose hull comes near enough is searched, so no distant branch is missed;
    within such a piece Newton's method finds the foot. The distance is that of a real curve
    point, hence an upper bound of the true one whatever happens.

    Parameters
    ----------
    curve : BSplineCurve
    points : array_like, shape (k, 2)

    Raises
    ------
    InvalidInputError
        If the points are no finite (k, 2) array.

    Examples
    --------
    >>> from shapespline.values import BSplineCurve
    >>> line = BSplineCurve([0, 0, 1, 1], [(0, 0), (4, 0)], degree=1)
    >>> nearest(line, [(1.0, 2.0), (9.0, 0.0)])
    Nearest(parameters=array([0.25, 1.  ]), distances_sq=array([ 4., 25.]))
    """
    queries = float_array(points, "points")
    if queries.ndim != 2 or queries.shape[1] != 2 or not np.isfinite(queries).all():
        raise InvalidInputError(
            f"points must be a finite (k, 2) array, got shape {queries.shape} with"
            f" {int((~np.isfinite(queries)).sum())} numbers that are not finite"
        )
    return feet_of(curve, queries)


def feet_of(curve: BSplineCurve, queries: FloatArray) -> Nearest:
    """The same of an array of points that is known to be one."""
    parameters, distances_sq = np.empty(len(queries)), np.empty(len(queries))
    _kernels.nearest_on_curve(
        curve.knots, curve.degree, curve.coefficients, queries, parameters, distances_sq
    )
    return Nearest(parameters, distances_sq)


def distance_from_chords(point: FloatArray, points: FloatArray) -> float:
    """Distance of a point (2,) from the polyline through some points, shape (k, 2).

    Examples
    --------
    >>> distance_from_chords(np.array([1.0, 1.0]), np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]]))
    1.0
    """
    x, y = (points[:-1] - point).T
    u, v = (points[1:] - points[:-1]).T
    share = -(x * u + y * v) / np.maximum(u * u + v * v, 1e-300)
    share = np.minimum(np.maximum(share, 0.0), 1.0)
    return float(np.hypot(x + share * u, y + share * v).min())


def nondecreasing(parameters: FloatArray, period: float | None = None) -> FloatArray:
    """Parameters put back into the order of their data, by sorting.

    Sorting is the rearrangement nearest to what came, point by point; of closed data whose
    unwrapped parameters stretch past one period the excess is clipped.
    """
    in_order = bool((parameters[1:] >= parameters[:-1]).all())
    ordered = parameters if in_order else np.sort(parameters)
    if period is not None and ordered[-1] > ordered[0] + period:
        ordered = np.minimum(ordered, ordered[0] + period)
    return ordered


class NearestPoints(NamedTuple):
    """Of each query point the index of the point nearest to it, and its distance, both (n,)."""

    indices: IntArray
    distances: FloatArray


def nearest_points(points: FloatArray, queries: FloatArray) -> NearestPoints:
    """Which of some points (k, 2) is nearest to each of others (n, 2); of those as near the first.

    Examples
    --------
    >>> points = np.array([(0.0, 9.0), (2.0, 1.0), (2.0, -1.0)])
    >>> nearest_points(points, np.array([(2.0, 0.0), (0.0, 9.0)]))
    NearestPoints(indices=array([1, 0]), distances=array([1., 0.]))
    """
    found = NearestPoints(np.empty(len(queries), dtype=np.int64), np.empty(len(queries)))
    _kernels.nearest_points(points, queries, *found)
    return found


class PointsByX(NamedTuple):
    """Points in their order, their indices by first coordinate, and these coordinates."""

    points: FloatArray
    indices: IntArray
    sorted_x: FloatArray

    @classmethod
    def of(cls, points: FloatArray) -> PointsByX:
        """Those of an array, shape (n, 2)."""
        indices = np.argsort(points[:, 0], kind="stable")
        return cls(points, indices, points[indices, 0])

    def between(self, low: float, high: float) -> FloatArray:
        """The points whose first coordinates are in a range, in their order.

        Examples
        --------
        >>> points = np.array([(3.0, 0.0), (1.0, 5.0), (2.0, 0.0)])
        >>> PointsByX.of(points).between(2.0, 3.0)
        array([[3., 0.],
               [2., 0.]])
        """
        return self.points[self._among(low, high)]

    def _among(self, low: float, high: float) -> IntArray:
        begin = np.searchsorted(self.sorted_x, low, side="left")
        end = np.searchsorted(self.sorted_x, high, side="right")
        return np.sort(self.indices[begin:end])
