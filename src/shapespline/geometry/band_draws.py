"""How much wider bands are than their first order says, by draws of the second.

Control points that the points hardly hold slide along the curve, and a slide moves the curve along
its normal, too: by ``k a^2 / 2 - a b'`` where it moves along its tangent by ``a`` and the normal
part of the motion changes by ``b'`` a unit of length, with the curvature ``k``. So the distance of
a point is a quadratic function of the control points, ``J d + d'H d / 2``, and the estimate that
minimises the squares of noise ``e`` less these distances is, to second order,

    d1 = C J'e,    d2 = C (sum_j (e - J d1)_j H_j d1 - J'(d1'H d1) / 2)

with the covariance C (Bates and Watts' intrinsic curvature acts, that of the parameters does not).

References
----------
.. [1] D. M. Bates, D. G. Watts, Relative curvature measures of nonlinearity, Journal of the Royal
   Statistical Society B 42, 1980: section 2.
.. [2] B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap, 1993: section 6.5 (parametric).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry.normal_motion import curve_motion, unit_normals

if TYPE_CHECKING:
    from scipy.sparse import csr_array

    from shapespline.geometry.normal_motion import CurveMotion
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve, Uncertainty

# Places times noisy data sets drawn, the same in every run: the price of a band. Each place is an
# example of one place, a whole curve is one of whole curves.
_DRAWN_PLACES, _DRAWN_CURVES = 20_000, 80_000
# Draws that lie beyond a quantile at least, and quantiles around the level, in parts of what lies
# beyond it, that are averaged: a single one of few draws is off by some per cent.
_BEYOND, _WINDOW = 5, np.linspace(-0.5, 0.5, 9)
# Of the mean speed: where a curve stands nearly still the second order has no bound (LSQ-09).
_SLOWEST = 0.25


def second_order_stretch(
    spline: BSplineCurve, uncertainty: Uncertainty, level: float, simultaneous: bool
) -> float:
    """Quantile of the deviations of second order over that of the first, from the same draws."""
    breaks = spline.breakpoints
    parts = len(uncertainty.precisions) // (len(breaks) - 1)
    steps = np.diff(breaks)[:, None] / parts
    at = (breaks[:-1, None] + steps * (np.arange(parts) + 0.5)).ravel()
    weights = np.sqrt(uncertainty.precisions)[:, None]
    step = np.repeat(steps / 4.0, parts)
    count = (_DRAWN_CURVES if simultaneous else _DRAWN_PLACES) // len(at)
    noise = np.random.default_rng(0).normal(size=(len(at), max(count, _BEYOND)))
    curve = SlidingCurve(spline, at, step)
    first, second = curve.estimated(uncertainty.covariance, weights, noise)
    variance = (first**2).mean(axis=1)
    moving = variance > 1e-12 * variance.max(initial=0.0)
    if not moving.any():
        return 1.0
    scale = np.sqrt(variance[moving])[:, None]
    quantiles = []
    for more in (0.0, second[moving] / scale):
        # Noise of the other sign: what is of second order is the same.
        both = np.abs(np.stack([more + first[moving] / scale, more - first[moving] / scale]))
        sizes = both.max(axis=1) if simultaneous else both
        kept = min(level, 1.0 - _BEYOND / sizes.size)
        quantiles.append(np.quantile(sizes, kept + (1.0 - kept) * _WINDOW).mean())
    return float(quantiles[1] / quantiles[0])


class SlidingCurve:
    """How a curve moves along its normals at places, to second order in its control points.

    Parameters
    ----------
    spline : BSplineCurve
    at : ndarray, shape (k,)
    step : ndarray, shape (k,)
        Parameters so far to both sides lie in the same span: differences replace a derivative.
    """

    def __init__(self, spline: BSplineCurve, at: FloatArray, step: FloatArray) -> None:
        size = 2 * spline.n_control_points
        normals, velocity = unit_normals(spline, at), spline(at, derivative=1)
        speed = np.hypot(velocity[:, 0], velocity[:, 1])
        least = max(_SLOWEST * float(speed.mean()), np.finfo(float).tiny)
        speed = np.maximum(speed, least)[:, None]
        tangents = np.column_stack([normals[:, 1], -normals[:, 0]])
        self.bend = (normals * spline(at, derivative=2)).sum(axis=1)[:, None] / speed**2
        self.along = _matrix(curve_motion(spline, at, tangents), size)
        self.across = _matrix(curve_motion(spline, at, normals), size)
        later, sooner = (
            _matrix(curve_motion(spline, at + h, normals), size) for h in (step, -step)
        )
        self.change = (later - sooner).multiply(0.5 / (step[:, None] * speed)).tocsr()

    def second(self, moves: FloatArray) -> FloatArray:
        """What moves (2 m, draws) of the control points add to ``across @ moves``, (k, draws)."""
        slide = self.along @ moves
        return 0.5 * self.bend * slide**2 - slide * (self.change @ moves)

    def estimated(
        self, covariance: FloatArray, weights: FloatArray, noise: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Motions of the estimate under noise: of first order, and what the second adds."""
        d1 = covariance @ (self.across.T @ (weights * noise))
        first, slide, turn = self.across @ d1, self.along @ d1, self.change @ d1
        own = self.second(d1)
        rest = weights * (noise - weights * first)
        pull = self.along.T @ (rest * (self.bend * slide - turn)) - self.change.T @ (rest * slide)
        d2 = covariance @ (pull - self.across.T @ (weights**2 * own))
        return first, self.across @ d2 + own


def _matrix(motion: CurveMotion, size: int) -> csr_array:
    """The motions as rows of a sparse matrix."""
    from scipy.sparse import csr_array

    count, width = motion.gains.shape
    starts = np.arange(0, count * width + 1, width)
    return csr_array((motion.gains.ravel(), motion.columns.ravel(), starts), shape=(count, size))
