"""A start with a given number of control points: knots by error equidistribution.

On uniform knots, placing the parameters places the knots: a span covers as much of the outline as
its parameters do. They are spread so that every span bends about as much, then, fit by fit, so
that every span errs about as much (de Boor 1973: a good approximation equidistributes its error).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import chord_to_point
from shapespline.engines.least_squares.descent import descend, go_on
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.solvers import LevenbergMarquardt, Limits, Stop
from shapespline.values import BSplineCurve, clamped_knots, greville_abscissae, periodic_knots

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# Chord of the CPDA in points, and the fewest points that it is measured on.
CHORD = 8
FEWEST_SAMPLES = 400
# Density of knots: a constant and the root of the curvature in units of the box diagonal. Measured
# on four outlines: exponents 0.33 to 0.7 and constants 0.3 to 3 differ by less than the rounds do
# (LSQ-02).
BEND_EXPONENT = 0.5
# Rounds of fitting and spreading the parameters again, the power of the error in them, and what is
# added to the error of every span (LSQ-02).
ROUNDS = 6
ERROR_EXPONENT = 0.4
LEAST_ERROR = 0.05
ROUND_LIMITS = Limits(max_iterations=30, relative_decrease=1e-3)
# Weight of the residuals that hold the curve on the data polyline: at 0.01 it still strays, from
# 0.1 the distance from curve to data comes down to that from data to curve; 1 slows convergence
# (LSQ-01).
STRAY_WEIGHT = 0.1


class Balanced(NamedTuple):
    """A curve to start from and the parameters (n,) of the points along it."""

    spline: BSplineCurve
    parameters: FloatArray


def balanced_start(
    contour: Contour,
    n_control_points: int,
    degree: int,
    weights: FloatArray | None = None,
    rounds: int = ROUNDS,
    *,
    ends: str = "fixed",
    parameters: FloatArray | None = None,
    ask: Callable[[int], bool] = go_on,
) -> Balanced:
    """The best of a few short fits, each balanced by the errors of the one before.

    Parameters
    ----------
    contour : Contour
    n_control_points : int
        At least ``degree + 1``.
    degree : int
        1 to 9.
    weights : ndarray, shape (n,), optional
    rounds : int
        Times that the parameters are spread again.
    ends : {"fixed", "fitted"}
        Of an open contour; see `CurveProblem`.
    parameters : ndarray, shape (n,), optional
        Of the points, to begin with; as `bending_parameters` places them if not given.
    ask : callable
        Asked now and then whether to end with what there is, see `descend`.
    """
    middle = 0.5 * (contour.points.min(axis=0) + contour.points.max(axis=0))
    periodic = contour.closed
    knots = (periodic_knots if periodic else clamped_knots)(n_control_points, degree)
    if parameters is None:
        parameters = bending_parameters(contour)
    solver = LevenbergMarquardt()
    best_cost = np.inf
    for round_ in range(rounds + 1):
        guess = _guess(contour, parameters, knots, degree, n_control_points) - middle
        problem = CurveProblem(
            contour.points - middle,
            BSplineCurve(knots, guess, degree, periodic),
            weights,
            ends="free" if periodic else ends,
            stray_weight=STRAY_WEIGHT,
        )
        control_points = problem.control_points_for(parameters, guess)
        result = descend(
            solver, problem, problem.pack(control_points, parameters), limits=ROUND_LIMITS, ask=ask
        )
        if result.cost < best_cost:
            best_cost, best = result.cost, (problem, result.x)
        if result.stop is Stop.CANCELLED:
            break
        if round_ < rounds:
            parameters = _balanced_by_error(problem, result.x)
    problem, x = best
    control_points, parameters = problem.unpack(x)
    return Balanced(
        BSplineCurve(knots, control_points + middle, degree, periodic), parameters.copy()
    )


def bending_parameters(contour: Contour) -> FloatArray:
    """Parameters that grow with the arc length and the root of the curvature, shape (n,)."""
    n_steps = max(len(contour), FEWEST_SAMPLES)
    samples = contour.resampled(n_steps if contour.closed else n_steps + 1)
    step = contour.length / n_steps
    cpda = chord_to_point(samples, CHORD, window=CHORD + 1)
    bend = np.abs(cpda.curvature(step)[:n_steps]) * contour.box_diagonal
    density = 1.0 + bend**BEND_EXPONENT
    share = np.concatenate([[0.0], np.cumsum(density)])
    return np.interp(
        contour.arc_length[: len(contour)], step * np.arange(n_steps + 1), share / share[-1]
    )


def _guess(
    contour: Contour, parameters: FloatArray, knots: FloatArray, degree: int, count: int
) -> FloatArray:
    """Control points on the outline at their Greville abscissae, shape (count, 2)."""
    abscissae = greville_abscissae(knots, degree)[:count]
    at = contour.arc_length[: len(contour)]
    if not contour.closed:
        return contour.at(np.interp(abscissae, parameters, at))
    laps = np.arange(-2, 3)
    around = (parameters + laps[:, None]).ravel()
    lengths = (at + laps[:, None] * contour.length).ravel()
    return contour.at(np.interp(abscissae, around, lengths) % contour.length)


def _balanced_by_error(problem: CurveProblem, x: FloatArray) -> FloatArray:
    """Parameters spread so that spans with large errors become narrower on the outline."""
    curve, parameters = problem.curve(x), problem.unpack(x)[1]
    n_spans = len(curve.breakpoints) - 1
    residuals = curve(parameters) - problem.points
    lap = np.floor(parameters) if curve.periodic else np.zeros(len(parameters))
    wrapped = np.clip(parameters - lap, 0.0, 1.0)
    span = np.minimum((wrapped * n_spans).astype(np.int64), n_spans - 1)
    total = np.bincount(span, (residuals**2).sum(axis=1), n_spans)
    error = np.sqrt(total / np.maximum(np.bincount(span, minlength=n_spans), 1))
    share = (error / max(float(error.mean()), np.finfo(float).tiny) + LEAST_ERROR) ** ERROR_EXPONENT
    if curve.periodic and n_spans > 2:
        share = 0.25 * (np.roll(share, 1) + 2 * share + np.roll(share, -1))
    edges = np.concatenate([[0.0], np.cumsum(share)])
    return lap + np.interp(wrapped, np.arange(n_spans + 1) / n_spans, edges / edges[-1])
