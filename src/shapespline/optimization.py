"""optimize: one start, one method, one Fit.

Moves control points and location parameters together from a start, then verifies the curve.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from shapespline.arrays import float_array, is_number
from shapespline.contour import Contour, checked_contour
from shapespline.distance import two_sided_distance
from shapespline.drawing import Fit, Iteration
from shapespline.errors import InvalidInputError
from shapespline.footpoint import nondecreasing
from shapespline.residuals import CurveProblem
from shapespline.solvers.alternation import Alternation
from shapespline.solvers.fixed_parameters import FixedParameters
from shapespline.solvers.iteration import IterationRecord, Limits, Solver, minimize
from shapespline.solvers.levenberg_marquardt import LevenbergMarquardt
from shapespline.solvers.quasi_newton import METHODS as QUASI_NEWTON
from shapespline.solvers.quasi_newton import QuasiNewton, make_solver
from shapespline.verification import verified_fit

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.curve import BSplineCurve
    from shapespline.typing import ArrayLike, FloatArray

    Callback = Callable[[Iteration], bool | None]

# Methods for comparison, beside the generalised BFGS family: foot points in turn with control
# points, or parameters that stay.
COMPARISONS: dict[str, Alternation | FixedParameters] = {
    "pdm": Alternation("point"),
    "tdm": Alternation("tangent"),
    "sdm": Alternation("squared"),
    "fixed-parameters": FixedParameters(),
}
METHODS = ("levenberg-marquardt", *QUASI_NEWTON, *COMPARISONS)
# Enough for Levenberg-Marquardt to converge and for the quasi-Newton family to come near.
DEFAULT_LIMITS = Limits(max_iterations=300, max_evaluations=2000, relative_decrease=1e-6)


class Start(Protocol):
    """What a run starts from: an InitialCurve, a Fit, or anything with these two."""

    @property
    def spline(self) -> BSplineCurve:
        """The curve."""

    @property
    def parameters(self) -> FloatArray:
        """Location parameter of every point, of the contour or as they were given."""


def optimize(
    contour: Contour,
    start: Start,
    method: str | Solver[Any, Any] = "levenberg-marquardt",
    *,
    tolerance: float | None = None,
    weights: ArrayLike | None = None,
    ends: str | None = None,
    stray_weight: float = 0.0,
    limits: Limits = DEFAULT_LIMITS,
    callback: Callback | None = None,
) -> Fit:
    """Minimise the residuals over control points and location parameters, and verify the curve.

    Knots and number of control points stay those of the start. The data are moved about their
    middle while computing, so that their place costs no accuracy.

    Parameters
    ----------
    contour : Contour
    start : InitialCurve or Fit
        Curve and parameters to start from.
    method : str or Solver
        ``"levenberg-marquardt"`` (parameters eliminated), ``"d-bfgs"``, ``"d-bfgs-ns"``,
        ``"d-bfgs-inverse"``, ``"d-bfgs-inverse-ns"``, ``"oss"``, ``"oss-ns"``, ``"bfgs"``,
        ``"l-bfgs"``; for comparison ``"pdm"``, ``"tdm"``, ``"sdm"`` (point-, tangent- and
        squared-distance minimisation) and ``"fixed-parameters"``; or a solver from
        ``solvers.quasi_newton.make_solver``, which takes the start diagonal, the Wolfe conditions
        and the memory.
    tolerance : float, optional
        Stop as soon as no residual is longer, data units; the promise is then checked both ways.
    weights : array_like, shape (n_given,), optional
        One positive weight per point that was given.
    ends : {"interpolated", "fitted", "free"}, optional
        Of an open curve: held on the first and last point (default), held by their parameters
        only, or not held at all.
    stray_weight : float
        Weight, relative to that of a data point, of residuals that hold the curve on the data
        polyline where neighbours drift apart on it; 0 is the paper's problem, 0.1 keeps both
        distances alike.
    limits : Limits
        Iterations, evaluations and the tests of convergence.
    callback : callable, optional
        Called with every Iteration; a true answer cancels, and the best curve so far is returned.

    Raises
    ------
    InvalidInputError
        For an unknown method, or a start or weights that do not match the contour.

    Examples
    --------
    >>> from shapespline import Contour, Status, initial_curve
    >>> t = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    >>> r = 10 + 2 * np.cos(5 * t)
    >>> flower = Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)
    >>> fit = optimize(flower, initial_curve(flower, length=8))
    >>> fit.n_control_points, fit.rms_distance < 0.4, fit.status == Status.KEPT
    (10, True, True)
    """
    checked_contour(contour, "contour")
    solver, name = _solver(method)
    spline = start.spline
    if spline.periodic and not contour.closed:
        raise InvalidInputError(
            "start must be an open curve for an open contour, got a periodic one;"
            " make it from the same contour"
        )
    if ends is None:
        ends = "free" if spline.periodic else "interpolated"
    if tolerance is not None and not (is_number(tolerance) and 0 < tolerance < np.inf):
        raise InvalidInputError(f"tolerance must be positive, got {tolerance!r}; in data units")
    middle = 0.5 * (contour.points.min(axis=0) + contour.points.max(axis=0))
    problem = CurveProblem(
        contour.points - middle,
        spline,
        checked_weights(weights, contour),
        ends=ends,
        stray_weight=stray_weight,
    )
    if tolerance is not None:
        limits = _stopping_at(limits, tolerance, problem, contour.closed)
    n = len(contour)
    first = spline.control_points - middle
    if ends == "interpolated":
        first[[0, -1]] = problem.points[[0, -1]]
    result = minimize(
        solver,
        problem,
        problem.pack(first, parameters_in_order(start, contour)),
        limits=limits,
        callback=None if callback is None else lambda record: callback(as_iteration(record, n)),
    )
    fitted = problem.curve(result.x)
    control_points = fitted.control_points + middle
    if ends == "interpolated":  # to the bit, in spite of the way to the middle and back
        control_points[[0, -1]] = contour.points[[0, -1]]
    curve = type(fitted)(fitted.knots, control_points, fitted.degree, fitted.periodic)
    return verified_fit(
        contour,
        curve,
        tolerance=tolerance,
        method=name,
        run=result,
        history=tuple(as_iteration(record, n) for record in result.history),
    )


def _solver(method: str | Solver[Any, Any]) -> tuple[Solver[Any, Any], str]:
    """The solver and its name."""
    if isinstance(method, LevenbergMarquardt | QuasiNewton | Alternation | FixedParameters):
        return method, type(method).__name__
    if method not in METHODS:
        raise InvalidInputError(f"method must be one of {', '.join(METHODS)}, got {method!r}")
    if method == "levenberg-marquardt":
        return LevenbergMarquardt(), method
    if method in COMPARISONS:
        return COMPARISONS[method], method
    return make_solver(method), method


def checked_weights(weights: ArrayLike | None, contour: Contour) -> FloatArray | None:
    """One weight per contour point: those of points that coincide add up."""
    if weights is None:
        return None
    summed = np.zeros(len(contour))
    np.add.at(summed, contour.source, given_weights(weights, contour))
    return summed


def given_weights(weights: ArrayLike, contour: Contour) -> FloatArray:
    """One positive weight for each point that was given."""
    given = float_array(weights, "weights")
    if given.shape != (contour.n_given,):
        raise InvalidInputError(
            f"weights must have shape ({contour.n_given},), one per point, got {given.shape}"
        )
    if not (np.isfinite(given).all() and (given > 0).all()):
        raise InvalidInputError("weights must be positive and finite; leave points out instead")
    return given


def parameters_in_order(start: Start, contour: Contour) -> FloatArray:
    """The start's parameters, one per contour point, unwrapped and in data order."""
    parameters = start.parameters
    if len(parameters) == contour.n_given != len(contour):
        _, first = np.unique(contour.source, return_index=True)
        parameters = parameters[first]
    if len(parameters) != len(contour):
        raise InvalidInputError(
            f"start must have one parameter per point: expected {len(contour)},"
            f" got {len(parameters)}; make it from the same contour"
        )
    if not start.spline.periodic:
        return nondecreasing(parameters)
    begin, end = start.spline.domain
    return nondecreasing(np.unwrap(parameters, period=end - begin), end - begin)


def _stopping_at(limits: Limits, tolerance: float, problem: CurveProblem, closed: bool) -> Limits:
    """The limits, and a stop where the tolerance is kept both ways."""
    data = Contour.silently(problem.points, closed)

    def reached(x: FloatArray) -> bool:
        curve = problem.curve(x)
        residuals = curve(problem.unpack(x)[1]) - problem.points
        # No residual is shorter than its distance: the full check is for when these are met.
        if float(np.hypot(residuals[:, 0], residuals[:, 1]).max()) <= tolerance:
            return two_sided_distance(curve, data).hausdorff_distance <= tolerance
        return limits.reached is not None and limits.reached(x)

    return replace(limits, reached=reached)


def as_iteration(record: IterationRecord, n: int) -> Iteration:
    """What a caller hears of an iteration over n points."""
    error = float(np.sqrt(2.0 * record.cost / max(n - 1, 1)))
    rest = record.gradient_norm, record.evaluations, record.step, record.seconds
    return Iteration(record.iteration, record.cost, error, *rest)
