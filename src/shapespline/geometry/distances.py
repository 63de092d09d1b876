"""Distances between a curve and its data, both ways, with certified upper bounds.

From curve to data it is an interval Hausdorff bound: branch and bound over halves of Bezier pieces.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.geometry.nearest import Nearest, feet_of, nearest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve, Contour, Piece

# The bound of the distance from curve to data is tight to this part of itself ...
RELATIVE_GAP = 1e-3
# ... or to this part of the box diagonal where the curve lies on the data.
FLOOR = 1e-9


class Distances(NamedTuple):
    """What was measured between a curve and a contour, in data units.

    ``max_distance`` and ``rms_distance`` go from the points to the curve; ``reverse_distance`` is
    the certified bound from the curve to the data polyline, ``parameters`` (n,) are the foot
    parameters of the contour's points.
    """

    max_distance: float
    rms_distance: float
    reverse_distance: float
    parameters: FloatArray

    @property
    def hausdorff_distance(self) -> float:
        """Upper bound of the larger of both directions."""
        return max(self.max_distance, self.reverse_distance)

    def beside(self, pieces: Sequence[Piece]) -> Distances:
        """Bounds for the pieces that a curve was made of, too: arcs lie beside their twins."""
        by = max((piece.twin_error for piece in pieces), default=0.0)
        if by == 0.0:
            return self
        return self._replace(
            max_distance=self.max_distance + by, reverse_distance=self.reverse_distance + by
        )


def two_sided_distance(curve: BSplineCurve, contour: Contour) -> Distances:
    """Distances from the data to the curve and from the curve to the data polyline.

    Data to curve: the distance to any curve point is an upper bound of the distance to the curve,
    and the nearest one is taken. Curve to data: every Bezier piece of the curve is bounded by the
    largest distance of its control points to one segment, halved until the bound is within 0.1 %
    of a distance that a curve point really has (METHOD 6). The curve is bounded from end to end,
    tails and closing piece included.

    Notes
    -----
    Rigorous up to the rounding of the evaluations, for which a few units in the last place of the
    largest coordinate are added.

    Examples
    --------
    >>> from shapespline import Contour
    >>> from shapespline.values import BSplineCurve
    >>> roof = BSplineCurve([0, 0, 0.5, 1, 1], [(0, 0), (1, 1), (2, 0)], degree=1)
    >>> found = two_sided_distance(roof, Contour([(0, 0), (2, 0)]))
    >>> found.max_distance < 1e-14, round(found.reverse_distance, 3)
    (True, 1.0)
    """
    centred, lost = CentredCurve.of(curve, contour), rounding(curve, contour)
    polyline = contour.polyline - centred.middle
    found = feet_of(centred.moved, polyline[: len(contour)])
    return Distances(
        float(np.sqrt(found.distances_sq.max())) + lost,
        float(np.sqrt(found.distances_sq.mean())),
        centred.farthest_from(polyline, FLOOR * contour.box_diagonal) + lost,
        found.parameters,
    )


def distances_at(curve: BSplineCurve, contour: Contour, parameters: FloatArray) -> Distances:
    """The same where the foot parameter of every point is known: none is searched for."""
    offset = curve(parameters) - contour.points
    distances = np.hypot(offset[:, 0], offset[:, 1])
    return Distances(
        float(distances.max()) + rounding(curve, contour),
        float(np.sqrt((distances**2).mean())),
        reverse_distance(curve, contour),
        parameters,
    )


def reverse_distance(curve: BSplineCurve, contour: Contour) -> float:
    """Certified bound of the distance from the curve to the data polyline."""
    centred = CentredCurve.of(curve, contour)
    polyline = contour.polyline - centred.middle
    bound = centred.farthest_from(polyline, FLOOR * contour.box_diagonal)
    return bound + rounding(curve, contour)


class CentredCurve(NamedTuple):
    """A curve about the middle of its data: differences formed there do not pay for its place."""

    moved: BSplineCurve
    middle: FloatArray

    @classmethod
    def of(cls, curve: BSplineCurve, contour: Contour) -> CentredCurve:
        """The curve about the middle of a contour's box."""
        low, high = contour.box
        middle = 0.5 * (low + high)
        points = curve.control_points - middle
        return cls(type(curve).trusted(curve.knots, points, curve.degree, curve.periodic), middle)

    def nearest(self, points: FloatArray) -> Nearest:
        """Nearest points of the curve, as `nearest` finds them."""
        return nearest(self.moved, points - self.middle)

    def farthest_from(self, polyline: FloatArray, floor: float) -> float:
        """Bound of the distance to a polyline about the middle, tight to a part or a floor."""
        _, reverse, _ = _kernels.curve_deviation(
            self.moved.knots,
            self.moved.degree,
            self.moved.coefficients,
            polyline,
            RELATIVE_GAP,
            floor,
        )
        return float(reverse)


def rounding(curve: BSplineCurve, contour: Contour) -> float:
    """A few units in the last place of the largest coordinate."""
    low, high = contour.box
    points = curve.control_points
    largest = max(-min(low.tolist()), max(high.tolist()), -points.min(), points.max())
    return 8.0 * float(np.finfo(float).eps * largest)
