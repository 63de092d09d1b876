"""Points that are found by their first coordinates, so that few of many are looked at."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray

# The nearest point is first looked for among so many on either side.
BESIDE = 8
# And then in a breadth that sums cannot round it out of.
ROUNDING = 1e-12


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

    def nearest(self, place: FloatArray) -> tuple[int, float]:
        """Index and distance of the point nearest to a place; of those as near the first.

        Examples
        --------
        >>> points = np.array([(0.0, 9.0), (2.0, 1.0), (2.0, -1.0)])
        >>> PointsByX.of(points).nearest(np.array([2.0, 0.0]))
        (1, 1.0)
        """
        x = float(place[0])
        at = int(np.searchsorted(self.sorted_x, x))
        first = self.indices[max(at - BESIDE, 0) : at + BESIDE]
        reach = float(self._far(first, place).min())
        reach += ROUNDING * (reach + abs(x))
        among = self._among(x - reach, x + reach)
        far = self._far(among, place)
        k = int(far.argmin())
        return int(among[k]), float(far[k])

    def _among(self, low: float, high: float) -> IntArray:
        begin = np.searchsorted(self.sorted_x, low, side="left")
        end = np.searchsorted(self.sorted_x, high, side="right")
        return np.sort(self.indices[begin:end])

    def _far(self, indices: IntArray, place: FloatArray) -> FloatArray:
        away = self.points[indices] - place
        return np.hypot(away[:, 0], away[:, 1])
