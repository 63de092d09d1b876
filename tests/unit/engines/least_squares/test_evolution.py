"""Differential evolution of the knots: its objective and its search, beside literal ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import make_lsq_spline
from scipy.optimize import differential_evolution
from tests.support.shapes import flower, plain_start, wave

from shapespline import Contour, Status, optimize
from shapespline.engines.least_squares.evolution import fitted_on
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.solvers import Limits

SHORT = Limits(max_evaluations=200)


def literal_cost(widths, parameters, points):
    """Half the sum of squares of the linear fit on knots with spans of these widths."""
    inner = np.cumsum(widths)[:-1] / np.sum(widths)
    knots = np.concatenate([np.zeros(4), inner, np.ones(4)])
    spline = make_lsq_spline(parameters, points, knots, k=3)
    return 0.5 * float(((spline(parameters) - points) ** 2).sum())


def test_the_objective_is_the_linear_fit():
    contour = wave()
    start = plain_start(contour, 8)
    problem = CurveProblem(contour.points, start.spline)
    spans = start.spline.n_control_points - 3
    for seed in range(5):
        widths = np.random.default_rng(seed).uniform(0.5, 2.0, spans)
        x = problem.pack(start.spline.control_points, start.parameters)
        _, _, cost = fitted_on(problem, widths, x)
        # Normal equations: twice the digits of a condition below 1e4.
        expected = literal_cost(widths, start.parameters, contour.points)
        assert cost == pytest.approx(expected, rel=1e-7)


def test_the_search_is_scipys_on_the_literal_objective():
    contour = wave()
    start = plain_start(contour, 8)
    fit = optimize(contour, start, "differential-evolution", ends="free", limits=SHORT)
    spans = start.spline.n_control_points - 3
    size = max(5, min(40, 2 * spans))
    bound = np.log(20.0) / 2
    first = np.exp(np.random.default_rng(0).uniform(-bound, bound, (size, spans)))
    first[0] = 1.0
    found = differential_evolution(
        literal_cost,
        [(20.0**-0.5, 20.0**0.5)] * spans,
        args=(start.parameters, contour.points),
        init=first,
        maxiter=200 // size - 1,
        tol=0.0,
        polish=False,
        seed=0,
    )
    assert fit.history[-1].cost == pytest.approx(found.fun, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("closed", [True, False])
def test_knots_move_and_the_same_seed_gives_the_same_bits(closed):
    points = flower(160).points + np.array([12.0, 0.0])
    points *= np.hypot(*points.T)[:, None]  # uneven: bends crowd at the left
    contour = Contour(points, closed)
    start = plain_start(contour, 5)
    linear = optimize(contour, start, "fixed-parameters")
    one, two = (optimize(contour, start, "differential-evolution", limits=SHORT) for _ in range(2))
    assert one.control_points.tobytes() == two.control_points.tobytes()
    assert one.n_control_points == start.spline.n_control_points
    assert one.history[-1].cost <= linear.history[-1].cost * (1 + 1e-9)
    assert not np.array_equal(one.knots, start.spline.knots)
    assert one.history[-1].evaluations <= SHORT.max_evaluations + 1


def test_a_callback_ends_it():
    contour = wave()
    fit = optimize(
        contour,
        plain_start(contour, 8),
        "differential-evolution",
        callback=lambda record: record.iteration == 2,
    )
    assert fit.status == Status.CANCELLED
    assert fit.history[-1].iteration <= 3
