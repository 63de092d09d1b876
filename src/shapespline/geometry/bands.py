"""Confidence bands around a curve from the covariance of its control points.

The curve moves along its normal n by n' B(u) dP, a linear function of the control points: its
variance is that of a few neighbouring ones. A pointwise band is as wide as a normal quantile says.
For the whole curve at once Weyl's tube formula gives the quantile of the largest deviation. Both
are stretched by what the second order adds (`band_draws`).

References
----------
.. [1] J. Sun, C. Loader, Simultaneous confidence bands for linear regression and smoothing, Annals
   of Statistics 22, 1994: Eq. 2.2 (tube formula), the constant kappa_0 by differences.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.geometry.band_draws import second_order_stretch
from shapespline.geometry.normal_motion import CurveMotion, curve_motion, unit_normals
from shapespline.validation import float_array, is_number, whole_number
from shapespline.values import Band

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike, FloatArray
    from shapespline.values import BSplineCurve, Uncertainty

# Places at which the tube formula follows the curve: a control point has so many.
_TUBE_STEPS = 16
_SMALLEST = 1e-300


def confidence_band(
    spline: BSplineCurve,
    uncertainty: Uncertainty,
    level: float = 0.95,
    *,
    simultaneous: bool = False,
    parameters: ArrayLike | int = 1000,
) -> Band:
    """The band that holds the true curve with a probability.

    Parameters
    ----------
    spline : BSplineCurve
    uncertainty : Uncertainty
    level : float
        Between 0 and 1.
    simultaneous : bool
        Hold the whole curve at once, not each point of it.
    parameters : array_like, shape (k,), or int
        Where; or at so many parameters, equally spaced over the curve.

    Raises
    ------
    InvalidInputError
        If the level is no probability or the parameters are none.

    Notes
    -----
    Second order in the noise. The size of the curve is taken as given; choosing it from the same
    points makes bands too narrow.
    """
    if not (is_number(level) and 0.0 < level < 1.0):
        raise InvalidInputError(f"level must be between 0 and 1, got {level!r}; try 0.95")
    at = _places(spline, parameters)
    normals = unit_normals(spline, at)
    motion = curve_motion(spline, at, normals)
    deviation = np.sqrt(np.maximum(_products(uncertainty.covariance, motion, motion), 0.0))
    factor = _pointwise(level)
    if simultaneous:
        factor = _simultaneous(spline, uncertainty.covariance, level)
    factor *= second_order_stretch(spline, uncertainty, level, simultaneous)
    return Band(at, spline(at), normals, factor * deviation, float(level), simultaneous)


def _places(spline: BSplineCurve, parameters: ArrayLike | int) -> FloatArray:
    """The parameters that were asked for."""
    begin, end = spline.domain
    count = whole_number(parameters)
    if count is not None:
        if count < 2:
            raise InvalidInputError(f"parameters must be 2 or more places, got {parameters!r}")
        return np.linspace(begin, end, count)
    at = float_array(parameters, "parameters")
    if at.ndim != 1 or not np.isfinite(at).all():
        raise InvalidInputError(f"parameters must be finite and of shape (k,), got {at.shape}")
    return at


def _products(covariance: FloatArray, one: CurveMotion, other: CurveMotion) -> FloatArray:
    """Covariances of the motions at matching places, shape (k,)."""
    blocks = covariance[one.columns[:, :, None], other.columns[:, None, :]]
    moved = np.einsum("kij,kj->ki", blocks, other.gains)
    return np.einsum("ki,ki->k", one.gains, moved)


def _pointwise(level: float) -> float:
    """Normal quantile of a two-sided level."""
    from scipy.special import ndtri

    return float(ndtri(0.5 + 0.5 * level))


def _simultaneous(spline: BSplineCurve, covariance: FloatArray, level: float) -> float:
    """Quantile of the largest deviation in standard deviations."""
    from scipy.special import ndtr

    at = _places(spline, _TUBE_STEPS * spline.n_control_points + 1)
    motion = curve_motion(spline, at, unit_normals(spline, at))
    first = CurveMotion(motion.gains[:-1], motion.columns[:-1])
    last = CurveMotion(motion.gains[1:], motion.columns[1:])
    variance = np.maximum(_products(covariance, motion, motion), _SMALLEST)
    between = _products(covariance, first, last) / np.sqrt(variance[:-1] * variance[1:])
    length = float(np.sqrt(np.maximum(2.0 - 2.0 * between, 0.0)).sum())
    low, high = _pointwise(level), 40.0
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        beyond = length / np.pi * np.exp(-0.5 * middle**2)
        if not spline.periodic:
            beyond += 2.0 * float(ndtr(-middle))
        low, high = (middle, high) if beyond > 1.0 - level else (low, middle)
    return high
