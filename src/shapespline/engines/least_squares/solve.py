"""One start, one solver, one curve: control points and location parameters move together."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from shapespline.engines.least_squares.descent import descend, go_on
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.errors import InvalidInputError
from shapespline.geometry import nondecreasing, two_sided_distance
from shapespline.solvers import METHODS as QUASI_NEWTON
from shapespline.solvers import (
    Alternation,
    FixedParameters,
    LevenbergMarquardt,
    Limits,
    QuasiNewton,
    Result,
    Solver,
    make_solver,
)
from shapespline.validation import float_array
from shapespline.values import BSplineCurve, Contour

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.monitor import Callback, Iteration
    from shapespline.typing import ArrayLike, FloatArray

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


class Minimized(NamedTuple):
    """A curve, how the iterations that led to it ended, and their records."""

    spline: BSplineCurve
    run: Result
    history: tuple[Iteration, ...]


def minimized(
    contour: Contour,
    start: Start,
    solver: Solver[Any, Any],
    *,
    tolerance: float | None = None,
    weights: FloatArray | None = None,
    ends: str | None = None,
    stray_weight: float = 0.0,
    limits: Limits = DEFAULT_LIMITS,
    callback: Callback | None = None,
    ask: Callable[[int], bool] = go_on,
) -> Minimized:
    """The curve of a start's knots that a solver ends with; arguments as `optimize` takes them.

    ``weights`` (n,) are those of the contour's points. The data are moved about their middle while
    computing, so that their place costs no accuracy.
    """
    spline = start.spline
    if spline.periodic and not contour.closed:
        raise InvalidInputError(
            "start must be an open curve for an open contour, got a periodic one;"
            " make it from the same contour"
        )
    if ends is None:
        ends = "free" if spline.periodic else "interpolated"
    middle = 0.5 * (contour.points.min(axis=0) + contour.points.max(axis=0))
    problem = CurveProblem(
        contour.points - middle, spline, weights, ends=ends, stray_weight=stray_weight
    )
    if tolerance is not None:
        limits = _stopping_at(limits, tolerance, problem, contour.closed)
    n = len(contour)
    first = spline.control_points - middle
    if ends == "interpolated":
        first[[0, -1]] = problem.points[[0, -1]]
    result = descend(
        solver,
        problem,
        problem.pack(first, parameters_in_order(start, contour)),
        limits=limits,
        callback=None if callback is None else lambda record: callback(with_paper_error(record, n)),
        ask=ask,
    )
    fitted = problem.curve(result.x)
    control_points = fitted.control_points + middle
    if ends == "interpolated":  # to the bit, in spite of the way to the middle and back
        control_points[[0, -1]] = contour.points[[0, -1]]
    curve = type(fitted)(fitted.knots, control_points, fitted.degree, fitted.periodic)
    return Minimized(curve, result, tuple(with_paper_error(record, n) for record in result.history))


def named_solver(method: str | Solver[Any, Any]) -> tuple[Solver[Any, Any], str]:
    """The solver of a method's name, or one that was made by hand; and its name."""
    if isinstance(method, LevenbergMarquardt | QuasiNewton | Alternation | FixedParameters):
        return method, type(method).__name__
    if method not in METHODS:
        raise InvalidInputError(f"method must be one of {', '.join(METHODS)}, got {method!r}")
    if method == "levenberg-marquardt":
        return LevenbergMarquardt(), method
    if method in COMPARISONS:
        return COMPARISONS[method], method
    return make_solver(method), method


def summed_weights(weights: ArrayLike, contour: Contour) -> FloatArray:
    """One weight per contour point: those of points that coincide add up."""
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


def with_paper_error(record: Iteration, n: int) -> Iteration:
    """A record of a least-squares run over n points with the paper's error."""
    return record._replace(paper_error=float(np.sqrt(2.0 * record.cost / max(n - 1, 1))))
