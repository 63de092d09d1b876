"""Differential evolution of the knots: a metaheuristic for comparison.

The parameters stay those of the start; the widths of the knot spans are found by chance and
selection, each trial judged by the linear fit on its knots. It needs no start and knows no
derivative, and pays for that with thousands of fits.

References
----------
.. [1] R. Storn, K. Price, Differential evolution, J. Global Optimization 11, 1997; the code is
   ``scipy.optimize.differential_evolution``.
.. [2] A. Galvez, A. Iglesias, Efficient particle swarm optimization approach for data fitting with
   free knot B-splines, Computer-Aided Design 43, 2011: the same set-up with another heuristic.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.least_squares.solve import (
    Album,
    Minimized,
    finished_curve,
    prepared_problem,
    with_paper_error,
)
from shapespline.monitor import Iteration
from shapespline.solvers import Result, Stop
from shapespline.values import BSplineCurve, clamped_knots, periodic_knots

if TYPE_CHECKING:
    from shapespline.engines.least_squares.problem import CurveProblem
    from shapespline.engines.least_squares.solve import RunArguments, Start
    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# Span widths differ by this factor at most: narrower spans would hold no point.
_WIDEST = 20.0
# Members of the population at most, whatever the number of knots.
_POPULATION = 40


@dataclass(frozen=True, slots=True)
class KnotEvolution:
    """The method as one value; the same seed gives the same curve."""

    seed: int = 0

    def run(self, contour: Contour, start: Start, arguments: RunArguments) -> Minimized:
        """The best curve of the population when the evaluations have run out."""
        from scipy.optimize import differential_evolution

        problem, x, middle = prepared_problem(contour, start, arguments)
        widths = _widths(problem.template)
        size = max(5, min(_POPULATION, 2 * len(widths)))
        first = np.exp(
            np.random.default_rng(self.seed).uniform(
                -0.5 * np.log(_WIDEST), 0.5 * np.log(_WIDEST), (size, len(widths))
            )
        )
        first[0] = np.clip(widths / widths.mean(), _WIDEST**-0.5, _WIDEST**0.5)
        run = _Run(problem, x, arguments, Album(arguments.snapshots, middle))
        limits = arguments.limits
        generations = min(limits.max_iterations, limits.max_evaluations // size - 1)
        if generations > 0:
            differential_evolution(
                run.cost,
                [(_WIDEST**-0.5, _WIDEST**0.5)] * len(widths),
                init=first,
                maxiter=generations,
                tol=0.0,
                polish=False,
                seed=self.seed,
                callback=run.generation,
            )
        result = run.result()
        n = len(contour)
        curve = finished_curve(run.best[0], result.x, middle, contour)
        history = tuple(with_paper_error(record, n) for record in run.records)
        snapshots = run.album.finished(history[-1].iteration, curve)
        return Minimized(curve, result, history, snapshots)


class _Run:
    """What the search has seen: the best fit, and a record a generation."""

    def __init__(
        self, problem: CurveProblem, x: FloatArray, arguments: RunArguments, album: Album
    ) -> None:
        self.start, self.x, self.album = problem, x, album
        self.arguments, self.began = arguments, time.perf_counter()
        self.best = problem, x, problem.cost(x)
        self.evaluations = 1
        self.records = [self.record(0)]
        album.note(0, problem.curve(x))
        self.cancelled = False

    def cost(self, widths: FloatArray) -> float:
        """Cost of the linear fit on knots with spans of these widths."""
        found = fitted_on(self.start, widths, self.x)
        self.evaluations += 1
        if found[2] < self.best[2]:
            self.best = found
        return found[2]

    def generation(self, x: FloatArray, convergence: float) -> bool:
        """Note a generation; whether the caller has had enough."""
        record = self.record(len(self.records))
        self.records.append(record)
        self.album.note(record.iteration, self.best[0].curve(self.best[1]))
        callback = self.arguments.callback
        n = len(self.start.points)
        self.cancelled = bool(callback and callback(with_paper_error(record, n)))
        return self.cancelled

    def record(self, iteration: int) -> Iteration:
        """How it stands; there is no gradient."""
        seconds = time.perf_counter() - self.began
        return Iteration(iteration, self.best[2], nan, nan, self.evaluations, nan, seconds)

    def result(self) -> Result:
        """The best fit as the end of a run."""
        _, x, cost = self.best
        stop = Stop.CANCELLED if self.cancelled else Stop.EVALUATIONS
        if self.records[-1].cost > cost:
            self.records.append(self.record(len(self.records)))
        return Result(x, cost, stop, tuple(self.records))


def _widths(curve: BSplineCurve) -> FloatArray:
    """Widths of the knot spans of the domain."""
    return np.diff(curve.knots[curve.degree : len(curve.knots) - curve.degree])


def fitted_on(
    problem: CurveProblem, widths: FloatArray, x: FloatArray
) -> tuple[CurveProblem, FloatArray, float]:
    """The linear fit on knots whose spans have these widths, up to a factor; and its cost."""
    template = problem.template
    control_points, parameters = problem.unpack(x)
    breaks = np.concatenate([[0.0], np.cumsum(widths)])
    breaks /= breaks[-1]
    breaks[-1] = 1.0
    m, degree = template.n_control_points, template.degree
    if template.periodic:
        knots = periodic_knots(m, degree, breaks)
    else:
        knots = clamped_knots(m, degree, breaks[1:-1])
    other = problem.on(BSplineCurve(knots, control_points, degree, template.periodic))
    found = other.solved(other.pack(control_points, parameters))
    return other, found, other.cost(found)
