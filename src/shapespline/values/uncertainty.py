"""Uncertainty of a curve fitted to measured points, and the Band around it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from shapespline.typing import FloatArray


@dataclass(frozen=True, eq=False, kw_only=True)
class Uncertainty:
    """What the errors of the points say about the curve.

    Attributes
    ----------
    covariance : ndarray, shape (2 m, 2 m)
        Of the control points, x and y in turn, data units squared; the location parameters are
        free. Zero for control points that are held.
    chi_squared : float
        Sum of squared normal distances in units of their standard deviations.
    degrees_of_freedom : float
        Points less the parameters as they act: the trace of the matrix that takes the points to
        the curve. Control points that slide along a straight run count less than one each.
    precisions : ndarray, shape (parts * spans,)
        Every span between breakpoints is divided into so many equal parts. Of each part: the sum
        over its points of one over the variance of their normal distance.
    """

    covariance: FloatArray = field(repr=False)
    chi_squared: float
    degrees_of_freedom: float
    precisions: FloatArray = field(repr=False)


class Band(NamedTuple):
    """A band around a curve that holds the true one as often as ``level`` says.

    Attributes
    ----------
    parameters : ndarray, shape (k,)
    points, normals : ndarray, shape (k, 2)
        Of the curve there; the normals have length 1 and point to the left.
    half_width : ndarray, shape (k,)
        Along the normal, data units.
    level : float
        At each point, or of the whole curve where ``simultaneous``.
    simultaneous : bool
    """

    parameters: FloatArray
    points: FloatArray
    normals: FloatArray
    half_width: FloatArray
    level: float
    simultaneous: bool

    @property
    def left(self) -> FloatArray:
        """The edge to the left of the curve, shape (k, 2)."""
        return self.points + self.half_width[:, None] * self.normals

    @property
    def right(self) -> FloatArray:
        """The edge to the right of the curve, shape (k, 2)."""
        return self.points - self.half_width[:, None] * self.normals
