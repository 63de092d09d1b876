"""One start, one solver, one curve: control points and location parameters move together."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, cast

import numpy as np

from shapespline.engines.least_squares.descent import descend, go_on
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.engines.least_squares.settings import DEFAULT_LIMITS
from shapespline.errors import InvalidInputError
from shapespline.geometry import nondecreasing, two_sided_distance
from shapespline.validation import float_array
from shapespline.values import BSplineCurve, Contour, Snapshot

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.monitor import Callback, Iteration
    from shapespline.solvers import Limits, Result, Solver
    from shapespline.typing import ArrayLike, FloatArray


class Start(Protocol):
    """What a run starts from: an InitialCurve, a Fit, or anything with these two."""

    @property
    def spline(self) -> BSplineCurve:
        """The curve."""

    @property
    def parameters(self) -> FloatArray:
        """Location parameter of every point, of the contour or as they were given."""


class Minimized(NamedTuple):
    """A curve, how the iterations that led to it ended, their records, curves on the way."""

    spline: BSplineCurve
    run: Result
    history: tuple[Iteration, ...]
    snapshots: tuple[Snapshot, ...] = ()


@dataclass(frozen=True, kw_only=True)
class RunArguments:
    """What a run is asked for, beside its data, its start and its method.

    ``weights`` (n,) are those of the points; the others are as `optimize` takes them.
    """

    tolerance: float | None = None
    weights: FloatArray | None = None
    ends: str | None = None
    stray_weight: float = 0.0
    limits: Limits = DEFAULT_LIMITS
    callback: Callback | None = None
    snapshots: int = 0


class Album:
    """Keeps every so many curves of a run.

    Parameters
    ----------
    every : int
        Iterations from one to the next; 0 keeps none.
    middle : ndarray, shape (2,)
        Where the data were before they were moved about it.
    """

    def __init__(self, every: int, middle: FloatArray) -> None:
        self.every, self.middle = every, middle
        self.kept: list[Snapshot] = []

    def note(self, iteration: int, curve: BSplineCurve) -> None:
        """Keep the curve of an iteration, if it is its turn."""
        if self.every and iteration % self.every == 0:
            points = curve.control_points + self.middle
            moved = BSplineCurve(curve.knots, points, curve.degree, curve.periodic)
            self.kept.append(Snapshot(iteration, moved))

    def finished(self, iteration: int, curve: BSplineCurve) -> tuple[Snapshot, ...]:
        """The curves, the last one of the run among them."""
        if self.every and (not self.kept or self.kept[-1].iteration < iteration):
            self.kept.append(Snapshot(iteration, curve))
        return tuple(self.kept)


class KnotMethod(Protocol):
    """A method that moves knots as well, and runs itself."""

    def run(self, contour: Contour, start: Start, arguments: RunArguments) -> Minimized:
        """The curve that it ends with."""


def minimized(
    contour: Contour,
    start: Start,
    solver: Solver[Any, Any] | KnotMethod,
    *,
    tolerance: float | None = None,
    weights: FloatArray | None = None,
    ends: str | None = None,
    stray_weight: float = 0.0,
    limits: Limits = DEFAULT_LIMITS,
    callback: Callback | None = None,
    snapshots: int = 0,
    ask: Callable[[int], bool] = go_on,
) -> Minimized:
    """The curve that a solver ends with; arguments as `optimize` takes them.

    ``weights`` (n,) are those of the contour's points. The data are moved about their middle while
    computing, so that their place costs no accuracy.
    """
    arguments = RunArguments(
        tolerance=tolerance,
        weights=weights,
        ends=ends,
        stray_weight=stray_weight,
        limits=limits,
        callback=callback,
        snapshots=snapshots,
    )
    return run_solver(contour, start, solver, arguments, ask)


def run_solver(
    contour: Contour,
    start: Start,
    solver: Solver[Any, Any] | KnotMethod,
    arguments: RunArguments,
    ask: Callable[[int], bool] = go_on,
) -> Minimized:
    """What `minimized` does, with its arguments in one."""
    run_itself = getattr(solver, "run", None)
    if run_itself is not None:
        found: Minimized = run_itself(contour, start, arguments)
        return found
    problem, x, middle = prepared_problem(contour, start, arguments)
    limits, callback, snapshots = arguments.limits, arguments.callback, arguments.snapshots
    if arguments.tolerance is not None:
        limits = _stopping_at(limits, arguments.tolerance, problem, contour.closed)
    n, album = len(contour), Album(snapshots, middle)

    def observe(record: Iteration, x: FloatArray) -> None:
        album.note(record.iteration, problem.curve(x))

    result = descend(
        cast("Solver[Any, Any]", solver),
        problem,
        x,
        limits=limits,
        callback=None if callback is None else lambda record: callback(with_paper_error(record, n)),
        observer=observe if snapshots else None,
        ask=ask,
    )
    curve = finished_curve(problem, result.x, middle, contour)
    history = tuple(with_paper_error(record, n) for record in result.history)
    return Minimized(curve, result, history, album.finished(len(history) - 1, curve))


def prepared_problem(
    contour: Contour, start: Start, arguments: RunArguments
) -> tuple[CurveProblem, FloatArray, FloatArray]:
    """The problem about the middle of the data, the vector to start from, and that middle."""
    spline, ends = start.spline, arguments.ends
    if spline.periodic and not contour.closed:
        raise InvalidInputError(
            "start must be an open curve for an open contour, got a periodic one;"
            " make it from the same contour"
        )
    if ends is None:
        ends = "free" if spline.periodic else "fixed"
    middle = 0.5 * (contour.points.min(axis=0) + contour.points.max(axis=0))
    problem = CurveProblem(
        contour.points - middle,
        spline,
        arguments.weights,
        ends=ends,
        stray_weight=arguments.stray_weight,
    )
    first = spline.control_points - middle
    if ends == "fixed":
        first[[0, -1]] = problem.points[[0, -1]]
    return problem, problem.pack(first, parameters_in_order(start, contour)), middle


def finished_curve(
    problem: CurveProblem, x: FloatArray, middle: FloatArray, contour: Contour
) -> BSplineCurve:
    """The curve of a vector, back where the data are."""
    fitted = problem.curve(x)
    control_points = fitted.control_points + middle
    if problem.ends == "fixed":  # to the bit, in spite of the way to the middle and back
        control_points[[0, -1]] = contour.points[[0, -1]]
    return type(fitted)(fitted.knots, control_points, fitted.degree, fitted.periodic)


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
