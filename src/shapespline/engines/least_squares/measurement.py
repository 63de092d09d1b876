"""Measured points: errors that differ from point to point and axis to axis, and robust losses.

A point with covariance S meets the curve where it likes, so only its normal distance d counts, with
variance n' S n: generalised least squares with the location eliminated. The weights depend on the
normals of the curve, so the fit is repeated until they stand still (iteratively reweighted least
squares), and robust losses come in the same way.

References
----------
.. [1] P. J. Huber, Robust Statistics, 1981, section 7.6: the covariance of an M-estimate.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.engines.least_squares.descent import go_on
from shapespline.engines.least_squares.losses import (
    LOSSES,
    NORMAL_MEDIAN,
    slope_and_square,
    weight_factors,
)
from shapespline.engines.least_squares.solve import parameters_in_order, run_solver
from shapespline.engines.least_squares.starts.equidistribution import Balanced
from shapespline.errors import InvalidInputError
from shapespline.geometry import curve_motion, unit_normals
from shapespline.solvers import Stop
from shapespline.validation import float_array, median
from shapespline.values import Contour, Uncertainty

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.engines.least_squares.solve import KnotMethod, Minimized, RunArguments, Start
    from shapespline.solvers import Solver
    from shapespline.typing import ArrayLike, FloatArray, IntArray
    from shapespline.values import BSplineCurve

# The fit is repeated until no weight changes by more than a part, or so many times.
_ROUNDS, _STILL = 30, 1e-3
# Parts of a span whose points are counted together in what tells of the second order (LSQ-09).
_PARTS = 12
# Tukey's loss forgets points: it begins from rounds of Huber's.
_HUBER_ROUNDS = 4


@dataclass(frozen=True)
class Measurement:
    """Covariances of the points (n, 2, 2), None where unknown, and the name of a loss or None."""

    covariances: FloatArray | None
    loss: str | None

    def again(self) -> Measurement:
        """With the first point once more at the end."""
        if self.covariances is None:
            return self
        return replace(self, covariances=np.concatenate([self.covariances, self.covariances[:1]]))

    @property
    def spread(self) -> tuple[FloatArray | None, float | None]:
        """Weights for a start, of mean one, None where alike; the error of one of weight one."""
        if self.covariances is None:
            return None, None
        precision = 2.0 / np.einsum("kii->k", self.covariances)
        mean = float(precision.mean())
        alike = bool((precision == precision[0]).all())
        return None if alike else precision / mean, mean**-0.5

    @property
    def is_plain(self) -> bool:
        """Whether one fit is all: weights that do not depend on the curve."""
        if self.loss is not None:
            return False
        if self.covariances is None:
            return True
        s = self.covariances
        return bool((s[:, 0, 1] == 0.0).all() and (s[:, 0, 0] == s[:, 1, 1]).all())


class Residuals(NamedTuple):
    """Normal distances of the points and their standard deviations, (n,)."""

    distances: FloatArray
    deviations: FloatArray

    @property
    def standardized(self) -> FloatArray:
        """Distances in standard deviations."""
        return self.distances / self.deviations


def checked_measurement(
    sigma: ArrayLike | None, loss: str | None, source: IntArray, n_points: int
) -> Measurement:
    """The errors of the points that were given, for those that stand for them.

    Points that coincide count together: their precisions add up.
    """
    if loss is not None and loss not in LOSSES:
        raise InvalidInputError(f"loss must be one of {', '.join(LOSSES)} or None, got {loss!r}")
    if sigma is None:
        return Measurement(None, loss)
    given = _covariances(sigma, len(source))
    if len(source) == n_points:
        return Measurement(given, loss)
    precision = np.zeros((n_points, 2, 2))
    np.add.at(precision, source, np.linalg.inv(given))
    summed: FloatArray = np.asarray(np.linalg.inv(precision), dtype=np.float64)
    return Measurement(summed, loss)


def _covariances(sigma: ArrayLike, n: int) -> FloatArray:
    """One covariance for each point from a length, lengths, lengths per axis, or covariances."""
    array = float_array(sigma, "sigma")
    if array.shape not in ((), (n,), (n, 2), (n, 2, 2)):
        raise InvalidInputError(
            "sigma must be a length, or have shape (n,), (n, 2) or (n, 2, 2) for the"
            f" n = {n} points, got {array.shape}"
        )
    if array.ndim == 3:
        _check_covariances(array)
        return array
    if not (np.isfinite(array).all() and (array > 0.0).all()):
        flat = np.atleast_1d(array)
        bad = np.argwhere(~(np.isfinite(flat) & (flat > 0.0)))[0]
        raise InvalidInputError(
            f"sigma must be positive and finite, got {flat[tuple(bad)]} at index"
            f" {bad[0]}; leave points out that were not measured"
        )
    if array.ndim < 2:
        array = np.broadcast_to(np.atleast_1d(array)[:, None], (n, 2))
    return array[:, :, None] ** 2 * np.eye(2)


def _check_covariances(array: FloatArray) -> None:
    """Raise unless every covariance is symmetric and positive definite."""
    determinant = array[:, 0, 0] * array[:, 1, 1] - array[:, 0, 1] * array[:, 1, 0]
    size = array[:, 0, 0] * array[:, 1, 1]
    good = (array[:, 0, 1] == array[:, 1, 0]) & (array[:, 0, 0] > 0.0)
    good &= np.isfinite(array).all(axis=(1, 2)) & (determinant > 1e-14 * size)
    if not good.all():
        raise InvalidInputError(
            "sigma must hold covariances that are symmetric and positive definite, got a singular"
            f" or invalid one at index {int(np.argmin(good))}; a point without error along one"
            " axis gets a small one"
        )


def measured(
    contour: Contour,
    start: Start,
    solver: Solver[Any, Any] | KnotMethod,
    model: Measurement,
    arguments: RunArguments,
    ask: Callable[[int], bool] = go_on,
) -> tuple[Minimized, Uncertainty | None]:
    """The curve that fits measured points, and its uncertainty where their errors are known.

    Points without errors and loss are fitted once, with the weights of the arguments. The history
    is that of the last round. ``ask`` is asked now and then whether to end with what there is.
    """
    if model.covariances is None and model.loss is None:
        return run_solver(contour, start, solver, arguments, ask), None
    if model.covariances is not None:
        held = not start.spline.periodic and arguments.ends in (None, "fixed")
        check_freedom(len(contour), start.spline.n_control_points, held)
    # Squares first would bend the curve towards outliers, and it might not come back.
    gentle = replace(model, loss=model.loss and "huber")
    weights = _weights(contour, start.spline, parameters_in_order(start, contour), gentle)
    for round_ in range(_ROUNDS):
        weighted = replace(arguments, weights=weights / weights.mean())
        found = run_solver(contour, start, solver, weighted, ask)
        parameters = found.run.x[2 * found.spline.n_control_points :]
        if model.is_plain or found.run.stop is Stop.CANCELLED:
            break
        loss = "huber" if model.loss == "tukey" and round_ < _HUBER_ROUNDS else model.loss
        last, weights = (
            weights,
            _weights(contour, found.spline, parameters, replace(model, loss=loss)),
        )
        start = Balanced(found.spline, parameters)
        settled = np.abs(weights - last).max() <= _STILL * weights.max()
        if settled and loss == model.loss:
            break
    if model.covariances is None:
        return found, None
    return found, _uncertainty(contour, found.spline, parameters, model, arguments.ends)


def check_freedom(n_points: int, n_control_points: int, held: bool) -> None:
    """Raise if no points are left to tell the errors from the curve; held ends are no unknowns."""
    free = 2 * n_control_points - (4 if held else 0)
    if n_points <= free:
        raise InvalidInputError(
            f"sigma needs more points than unknowns: {n_points} points for"
            f" {n_control_points} control points with {free} free coordinates leave no"
            " degree of freedom; take fewer control points"
        )


def _residuals(
    contour: Contour, spline: BSplineCurve, parameters: FloatArray, model: Measurement
) -> Residuals:
    """Normal distances, with the deviations known or by the median of the distances."""
    normals = unit_normals(spline, parameters)
    return _along(contour, spline, parameters, normals, model)


def _along(
    contour: Contour,
    spline: BSplineCurve,
    parameters: FloatArray,
    directions: FloatArray,
    model: Measurement,
) -> Residuals:
    """Residuals along directions of the plane."""
    distances = ((contour.points - spline(parameters)) * directions).sum(axis=1)
    if model.covariances is None:
        scale = median(np.abs(distances)) / NORMAL_MEDIAN
        scale = max(scale, np.finfo(float).eps * contour.box_diagonal)
        return Residuals(distances, np.full(len(distances), scale))
    variances = np.einsum("ki,kij,kj->k", directions, model.covariances, directions)
    # Where the curve stands still there is no normal: the mean over all directions.
    still = variances == 0.0
    variances[still] = 0.5 * np.einsum("kii->k", model.covariances[still])
    return Residuals(distances, np.sqrt(variances))


def _weights(
    contour: Contour, spline: BSplineCurve, parameters: FloatArray, model: Measurement
) -> FloatArray:
    """psi(z) / z over the variance of each normal distance."""
    found = _residuals(contour, spline, parameters, model)
    z = np.abs(found.standardized)
    return weight_factors(z, model.loss) / found.deviations**2


def _uncertainty(
    contour: Contour,
    spline: BSplineCurve,
    parameters: FloatArray,
    model: Measurement,
    ends: str | None,
) -> Uncertainty:
    """Covariance by propagation; of a robust loss the sandwich of [1].

    With the location free, moving a control point along a straight run changes nothing; that it
    stays between its neighbours is taken as known, with the spacing as its standard deviation.
    """
    found = _residuals(contour, spline, parameters, model)
    z = found.standardized
    slope, square = slope_and_square(z, model.loss)
    normals, count = unit_normals(spline, parameters), spline.n_control_points
    motion = curve_motion(spline, parameters, normals)
    precision = 1.0 / found.deviations**2
    bread = _information(motion.gains, motion.columns, slope * precision, count)
    meat = _information(motion.gains, motion.columns, square * precision, count)
    n, chi_squared, free = len(contour), float(z @ z), np.arange(2 * count)
    if not spline.periodic and ends in (None, "fixed"):
        free = free[2:-2]
    elif not spline.periodic and ends == "fitted":  # end parameters are held: both axes count
        tangents = np.column_stack([normals[:, 1], -normals[:, 0]])[[0, -1]]
        tips = contour.points[[0, -1]], parameters[[0, -1]]
        two = replace(model, covariances=_tips(model.covariances))
        held = _along(Contour.trusted(tips[0], False), spline, tips[1], tangents, two)
        gains, columns = curve_motion(spline, tips[1], tangents)
        extra = _information(gains, columns, 1.0 / held.deviations**2, count)
        bread, meat = bread + extra, meat + extra
        n, chi_squared = n + 2, chi_squared + float(held.standardized @ held.standardized)
    size = 2 * count
    # A control point may slide along the curve unseen, but no farther than to its neighbours.
    reach = np.repeat(_spacing(spline), 2)[free] ** -2.0
    inverse = _inverse(bread[np.ix_(free, free)] + np.diag(reach), spline.periodic)
    covariance = np.zeros((size, size))
    inner = inverse
    if model.loss is not None:
        inner = inverse @ meat[np.ix_(free, free)] @ inverse
    covariance[np.ix_(free, free)] = 0.5 * (inner + inner.T)
    acting = float(np.sum(inverse * bread[np.ix_(free, free)]))
    return Uncertainty(
        covariance=covariance,
        chi_squared=chi_squared,
        degrees_of_freedom=n - acting,
        precisions=_in_parts(spline, parameters, slope * precision),
    )


def _in_parts(spline: BSplineCurve, parameters: FloatArray, weights: FloatArray) -> FloatArray:
    """Sum of the weights of the points in each part of a span between breakpoints."""
    breaks = spline.breakpoints
    edges = np.linspace(breaks[:-1], breaks[1:], _PARTS, endpoint=False, axis=1).ravel()
    place = parameters
    if spline.periodic:
        place = breaks[0] + np.mod(parameters - breaks[0], breaks[-1] - breaks[0])
    part = np.maximum(np.searchsorted(edges, place, side="right") - 1, 0)
    return np.asarray(np.bincount(part, weights, len(edges)), dtype=np.float64)


def _tips(covariances: FloatArray | None) -> FloatArray | None:
    """Those of the first and last point."""
    return None if covariances is None else covariances[[0, -1]]


def _spacing(spline: BSplineCurve) -> FloatArray:
    """Distance of each control point to the nearer of its neighbours, or to the mean of all."""
    points = spline.control_points
    if spline.periodic:
        points = np.concatenate([points, points[:1]])
    steps = np.hypot(*np.diff(points, axis=0).T)
    if spline.periodic:
        nearer = np.minimum(steps, np.roll(steps, 1))
    else:
        nearer = np.minimum(np.append(steps, np.inf), np.append(np.inf, steps))
    return np.maximum(nearer, 0.1 * steps.mean())


def _information(
    gains: FloatArray, columns: IntArray, weights: FloatArray, count: int
) -> FloatArray:
    """sum_j w_j g_j g_j', shape (2 m, 2 m)."""
    size = 2 * count
    places = columns[:, :, None] * size + columns[:, None, :]
    products = weights[:, None, None] * gains[:, :, None] * gains[:, None, :]
    summed = np.bincount(places.ravel(), products.ravel(), size * size)
    return np.asarray(summed, dtype=np.float64).reshape(size, size)


def _inverse(matrix: FloatArray, periodic: bool) -> FloatArray:
    """Inverse from the banded Cholesky factor; a cyclic band is folded into a band first."""
    from scipy.linalg import cho_solve_banded, cholesky_banded

    size = len(matrix)
    order = np.arange(size)
    if periodic:  # 0, m - 1, 1, m - 2, ...: neighbours round the ring stay near each other
        points = np.arange(size // 2)
        folded = np.empty_like(points)
        half = (len(points) + 1) // 2
        folded[0::2], folded[1::2] = points[:half], points[::-1][: len(points) - half]
        order = (2 * folded[:, None] + np.arange(2)).ravel()
    ordered = matrix[np.ix_(order, order)]
    rows, columns = np.nonzero(ordered)
    width = int(np.max(rows - columns, initial=0))
    band = np.zeros((width + 1, size))
    for k in range(width + 1):
        band[k, : size - k] = np.diag(ordered, -k)
    inverse = np.empty((size, size))
    factor = cholesky_banded(band, lower=True)
    inverse[np.ix_(order, order)] = cho_solve_banded((factor, True), np.eye(size))
    return inverse
