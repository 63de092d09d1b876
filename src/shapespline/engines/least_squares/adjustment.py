"""Insertion and removal: squared-distance minimisation with knots that come and go.

SDM fits the curve on the knots there are. Then a knot goes into the middle of the span that errs
most, and the knot whose removal costs least goes out; SDM again. With a tolerance knots are
inserted until it is kept both ways, and removed as long as it is; without one every insertion is
followed by a removal, so that the number stays, until that gains nothing any more. The cost rises
in between: the records show it.

References
----------
.. [1] H. Yang, W. Wang, J. Sun, Control point adjustment for B-spline curve approximation,
   Computer-Aided Design 36, 2004: sections 4 (insertion) and 5 (removal).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.least_squares.solve import (
    Album,
    Minimized,
    finished_curve,
    prepared_problem,
    with_paper_error,
)
from shapespline.geometry import two_sided_distance
from shapespline.solvers import Alternation, Limits, Result, Stop, minimize
from shapespline.values import BSplineCurve, Contour, clamped_knots, periodic_knots

if TYPE_CHECKING:
    from shapespline.engines.least_squares.problem import CurveProblem
    from shapespline.engines.least_squares.solve import RunArguments, Start
    from shapespline.monitor import Iteration
    from shapespline.typing import FloatArray

# SDM between two changes of the knots: it converges in a few steps.
_ROUND = Limits(max_iterations=12, relative_decrease=1e-3)
# Changes in a row that gained nothing before the search ends.
_PATIENCE = 3


class _Found(NamedTuple):
    """A problem on some knots and its minimum."""

    problem: CurveProblem
    x: FloatArray
    cost: float


@dataclass(frozen=True, slots=True)
class InsertionRemoval:
    """The method as one value; it moves knots, so it runs beside `solvers.minimize`."""

    def run(self, contour: Contour, start: Start, arguments: RunArguments) -> Minimized:
        """The curve that insertions and removals end with."""
        return _Search(contour, start, arguments).run()


class _Search:
    """One run: its records, its budget, the best curve so far."""

    def __init__(self, contour: Contour, start: Start, arguments: RunArguments) -> None:
        self.contour, self.arguments = contour, arguments
        self.problem, self.x, self.middle = prepared_problem(contour, start, arguments)
        self.data = Contour.silently(self.problem.points, contour.closed)
        self.album = Album(arguments.snapshots, self.middle)
        self.records: list[Iteration] = []
        self.stop: Stop | None = None

    def run(self) -> Minimized:
        """Fit, then change knots until nothing is gained."""
        found = self.fitted(self.problem, self.x)
        if self.arguments.tolerance is None:
            found = self.exchanged(found)
            if self.stop is None:
                found = self.fitted(found.problem, found.x, self.arguments.limits)
        else:
            found = self.thinned(self.grown(found))
        stop = self.stop or Stop.DECREASE
        if self.records[-1].cost != found.cost:  # the last knots tried were no better
            last = self.records[-1]
            self.records.append(last._replace(iteration=last.iteration + 1, cost=found.cost))
        result = Result(found.x, found.cost, stop, tuple(self.records))
        n = len(self.contour)
        curve = finished_curve(found.problem, found.x, self.middle, self.contour)
        history = tuple(with_paper_error(record, n) for record in self.records)
        snapshots = self.album.finished(history[-1].iteration, curve)
        return Minimized(curve, result, history, snapshots)

    def fitted(self, problem: CurveProblem, x: FloatArray, until: Limits = _ROUND) -> _Found:
        """SDM on some knots; its records continue those before."""
        limits, last = self.arguments.limits, self.records[-1] if self.records else None
        used = (last.iteration, last.evaluations, last.seconds) if last else (0, 0, 0.0)
        left = limits.max_evaluations - used[1], limits.max_iterations - used[0]
        if min(left) <= 0:
            self.stop = Stop.EVALUATIONS if left[0] <= 0 else Stop.ITERATIONS
            return _Found(problem, x, problem.cost(x))
        callback = self.arguments.callback

        def note(record: Iteration) -> bool | None:
            if last is not None and record.iteration == 0:
                return None
            record = record._replace(
                iteration=record.iteration + used[0],
                evaluations=record.evaluations + used[1],
                seconds=record.seconds + used[2],
            )
            self.records.append(record)
            return callback(with_paper_error(record, len(self.contour))) if callback else None

        round_ = replace(
            until,
            max_evaluations=left[0],
            max_iterations=min(until.max_iterations, left[1]),
        )
        result = minimize(
            Alternation("squared"),
            problem,
            x,
            limits=round_,
            callback=note,
            observer=lambda record, x: (
                self.album.note(record.iteration + used[0], problem.curve(x))
                if last is None or record.iteration
                else None
            ),
        )
        if result.stop is Stop.CANCELLED:
            self.stop = Stop.CANCELLED
        return _Found(problem, result.x, result.cost)

    def exchanged(self, found: _Found) -> _Found:
        """One in, one out, as long as that lowers the cost."""
        failures, tried = 0, found
        while failures < _PATIENCE and self.stop is None:
            more = self.fitted(*inserted(tried.problem, tried.x))
            fewer = self.fitted(*removed(more.problem, more.x))
            if fewer.cost < found.cost * (1.0 - 1e-3):
                found, failures = fewer, 0
            else:
                failures += 1
            tried = fewer
        return found

    def grown(self, found: _Found) -> _Found:
        """Knots inserted until the tolerance is kept, or half the points are control points."""
        while not self.kept(found) and self.stop is None:
            if found.problem.template.n_control_points >= len(self.contour) // 2:
                break
            found = self.fitted(*inserted(found.problem, found.x))
        return found

    def thinned(self, found: _Found) -> _Found:
        """Knots removed as long as the tolerance stays kept."""
        while self.kept(found) and self.stop is None:
            template = found.problem.template
            if template.n_control_points <= template.degree + 1:
                break
            fewer = self.fitted(*removed(found.problem, found.x))
            if not self.kept(fewer):
                break
            found = fewer
        return found

    def kept(self, found: _Found) -> bool:
        """Whether the curve is within the tolerance, both ways."""
        distance = two_sided_distance(found.problem.curve(found.x), self.data)
        return self.arguments.tolerance is not None and (
            distance.hausdorff_distance <= self.arguments.tolerance
        )


def inserted(problem: CurveProblem, x: FloatArray) -> tuple[CurveProblem, FloatArray]:
    """A knot in the middle of the span whose squared residuals sum to most, and the fit to it."""
    curve, parameters = problem.curve(x), problem.unpack(x)[1]
    breaks = _breaks(curve)
    place = np.mod(parameters, 1.0) if curve.periodic else parameters
    span = np.clip(np.searchsorted(breaks, place, side="right") - 1, 0, len(breaks) - 2)
    squares = ((curve(parameters) - problem.points) ** 2).sum(axis=1)
    if problem.weights is not None:
        squares = squares * problem.weights
    worst = int(np.argmax(np.bincount(span, squares, len(breaks) - 1)))
    middle = 0.5 * (breaks[worst] + breaks[worst + 1])
    return _refitted(problem, x, np.insert(breaks, worst + 1, middle))


def removed(problem: CurveProblem, x: FloatArray) -> tuple[CurveProblem, FloatArray]:
    """The knot taken out whose removal costs least, all others fitted to the same parameters."""
    breaks = _breaks(problem.template)
    candidates = [_refitted(problem, x, np.delete(breaks, i)) for i in range(1, len(breaks) - 1)]
    return min(candidates, key=lambda pair: pair[0].cost(pair[1]))


def _breaks(curve: BSplineCurve) -> FloatArray:
    """The knots of the domain, one period of them."""
    return curve.knots[curve.degree : len(curve.knots) - curve.degree]


def _refitted(
    problem: CurveProblem, x: FloatArray, breaks: FloatArray
) -> tuple[CurveProblem, FloatArray]:
    """The same data on other knots, the control points solved for at the same parameters."""
    old, parameters = problem.curve(x), problem.unpack(x)[1]
    degree = old.degree
    if old.periodic:
        count = len(breaks) - 1
        knots = periodic_knots(count, degree, breaks)
    else:
        count = len(breaks) + degree - 1
        knots = clamped_knots(count, degree, breaks[1:-1])
    blank = BSplineCurve(knots, np.zeros((count, 2)), degree, old.periodic)
    guess = old(blank.greville[:count])
    template = BSplineCurve(knots, guess, degree, old.periodic)
    other = problem.on(template)
    return other, other.solved(other.pack(guess, parameters))
