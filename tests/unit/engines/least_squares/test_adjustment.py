"""Insertion and removal of knots: every choice against a dense, literal one."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.interpolate import make_lsq_spline
from tests.support.shapes import flower, plain_start, wave

from shapespline import Contour, Status, optimize
from shapespline.engines.least_squares.adjustment import inserted, removed
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.solvers import Limits


def open_problem():
    contour = wave()
    rng = np.random.default_rng(5)
    contour = Contour(contour.points + rng.normal(0, 0.05, contour.points.shape), False)
    start = plain_start(contour, 8)
    problem = CurveProblem(contour.points, start.spline)
    for _ in range(4):
        x = problem.solved(problem.pack(problem.template.control_points, start.parameters))
        problem, x = inserted(problem, x)
    return problem, x, contour, start.parameters


def lsq(contour, parameters, breaks):
    knots = np.concatenate([np.zeros(3), breaks, np.ones(3)])
    spline = make_lsq_spline(parameters, contour.points, knots, k=3)
    return spline, 0.5 * float(((spline(parameters) - contour.points) ** 2).sum())


def test_a_knot_goes_into_the_middle_of_the_worst_span():
    problem, x, contour, parameters = open_problem()
    before = problem.template.breakpoints
    spline, _ = lsq(contour, parameters, before)
    squares = ((spline(parameters) - contour.points) ** 2).sum(axis=1)
    sums = [
        squares[(parameters >= a) & ((parameters < b) | (b == 1.0))].sum()
        for a, b in pairwise(before)
    ]
    worst = int(np.argmax(sums))
    after = inserted(problem, x)[0].template.breakpoints
    expected = np.sort(np.append(before, 0.5 * (before[worst] + before[worst + 1])))
    np.testing.assert_array_equal(after, expected)


def test_the_knot_that_goes_is_the_one_that_costs_least():
    problem, x, contour, parameters = open_problem()
    before = problem.template.breakpoints
    costs = [lsq(contour, parameters, np.delete(before, i))[1] for i in range(1, len(before) - 1)]
    other, moved = removed(problem, x)
    np.testing.assert_array_equal(
        other.template.breakpoints, np.delete(before, 1 + int(np.argmin(costs)))
    )
    # Normal equations lose twice the digits of the condition, which is below 1e4 here.
    assert other.cost(moved) == pytest.approx(min(costs), rel=1e-8)


@pytest.mark.parametrize("closed", [True, False])
def test_without_a_tolerance_the_number_stays_and_the_error_falls(closed):
    contour = Contour(flower(200).points, closed)
    start = plain_start(contour, 5)
    sdm = optimize(contour, start, "sdm")
    fit = optimize(contour, start, "insertion-removal")
    assert fit.n_control_points == start.spline.n_control_points
    # Both end where the cost falls by 1e-6 of itself three times in a row.
    assert fit.history[-1].cost <= sdm.history[-1].cost * (1 + 1e-4)


@pytest.mark.parametrize("closed", [True, False])
def test_a_tolerance_is_kept_with_a_knot_that_cannot_go(closed):
    contour = Contour(flower(200).points, closed)
    fit, looser = (
        optimize(
            contour,
            plain_start(contour, 5),
            "insertion-removal",
            tolerance=tolerance,
            stray_weight=0.1,
        )
        for tolerance in (0.05, 0.5)
    )
    assert fit.status == looser.status == Status.KEPT
    assert fit.hausdorff_distance <= 0.05
    assert looser.n_control_points < fit.n_control_points


def test_limits_and_callbacks_end_it():
    contour = flower(200)
    start = plain_start(contour, 5)
    short = optimize(contour, start, "insertion-removal", limits=Limits(max_evaluations=5))
    assert short.status == Status.BUDGET
    assert short.history[-1].evaluations <= 5
    seen = []
    stopped = optimize(
        contour,
        start,
        "insertion-removal",
        callback=lambda record: seen.append(record) or len(seen) > 20,
    )
    assert stopped.status == Status.CANCELLED
    assert [record.iteration for record in seen] == list(range(21))
