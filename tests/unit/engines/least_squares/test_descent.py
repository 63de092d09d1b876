"""The kernel's Levenberg-Marquardt against that of `solvers`: the same bits, records and ends."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.shapes import flower

from shapespline import InvalidInputError, _kernels
from shapespline.engines.least_squares.descent import descend
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.solvers import LevenbergMarquardt, Limits, Stop, make_solver
from shapespline.values import BSplineCurve, clamped_knots, periodic_knots


def curve_problem(periodic, degree, *, ends="fitted", stray_weight=0.1, weighted=False, seed=0):
    """A noisy flower, or a piece of it, and a start that is far away."""
    rng = np.random.default_rng(seed)
    points = flower(200).points + rng.normal(0, 0.05, (200, 2))
    points = np.ascontiguousarray(points if periodic else points[:130])
    count = degree + 9
    knots = (periodic_knots if periodic else clamped_knots)(count, degree)
    parameters = np.linspace(0, 1, len(points), endpoint=not periodic)
    guess = points[np.linspace(0, len(points) - 1, count).astype(int)]
    problem = CurveProblem(
        points,
        BSplineCurve(knots, guess, degree, periodic),
        rng.uniform(0.5, 2.0, len(points)) if weighted else None,
        ends="free" if periodic else ends,
        stray_weight=stray_weight,
    )
    return problem, problem.pack(guess, parameters)


def listening(record):
    """A callback that does nothing keeps the run in Python."""


def assert_same_run(problem, x, limits, solver=None):
    solver = LevenbergMarquardt() if solver is None else solver
    start = x.copy()
    kernel = descend(solver, problem, x, limits=limits)
    python = descend(solver, problem, x, limits=limits, callback=listening)
    assert_array_equal(x, start)
    assert_array_equal(kernel.x, python.x)
    assert kernel.cost == python.cost
    assert kernel.stop is python.stop
    for mine, other in zip(kernel.history, python.history, strict=True):
        told = {"seconds": 0.0, "paper_error": 0.0}
        assert mine._replace(**told) == other._replace(**told)
    assert [r.seconds for r in kernel.history] == sorted(r.seconds for r in kernel.history)
    return kernel


@pytest.mark.parametrize("degree", [1, 2, 3, 5, 7])
@pytest.mark.parametrize(
    ("periodic", "ends"),
    [(True, "free"), (False, "free"), (False, "fitted"), (False, "fixed")],
)
def test_both_find_the_same_bits(periodic, ends, degree):
    for weighted, stray_weight in ((False, 0.1), (True, 0.0)):
        problem, x = curve_problem(
            periodic, degree, ends=ends, stray_weight=stray_weight, weighted=weighted
        )
        run = assert_same_run(problem, x, Limits(max_iterations=60))
        assert len(run.history) > 5
        assert run.cost < 0.5 * run.history[0].cost


@pytest.mark.parametrize(
    ("limits", "stop"),
    [
        (Limits(max_iterations=0), Stop.ITERATIONS),
        (Limits(max_iterations=4), Stop.ITERATIONS),
        (Limits(max_evaluations=6), Stop.EVALUATIONS),
        (Limits(relative_decrease=0.1), Stop.DECREASE),
        (Limits(gradient_tolerance=0.3, relative_decrease=0.0), Stop.GRADIENT),
        (Limits(target_cost=10.0), Stop.TARGET),
        (
            Limits(relative_decrease=0.0, gradient_tolerance=0.0, max_iterations=100_000),
            Stop.NO_DECREASE,
        ),
    ],
    ids=lambda value: value.name if isinstance(value, Stop) else "",
)
def test_both_end_for_the_same_reason(limits, stop):
    problem, x = curve_problem(True, 3)
    assert assert_same_run(problem, x, limits).stop is stop


def test_parameters_out_of_order_are_put_back_alike():
    """Half the data far away: the parameters of a first undamped step pass each other."""
    problem, x = curve_problem(True, 3, stray_weight=0.0)
    problem.points[::2] *= 1.5
    solver = LevenbergMarquardt(start_damping=1e-12)
    trial = problem.unpack(problem.damped_step(x, 1e-12).x)[1]
    control_step, parameter_step = np.empty((12, 2)), np.empty(len(trial))
    problem.kernel.damped_step(*problem.unpack(x), 1e-12, control_step, parameter_step)
    assert (np.diff(problem.unpack(x)[1] + parameter_step) < 0).any()
    assert (np.diff(trial) >= 0).all()
    assert_same_run(problem, x, Limits(max_iterations=40), solver)


def test_a_start_that_is_none_is_refused_alike():
    problem, x = curve_problem(False, 3)
    for at in (0, -1):  # a control point, a parameter
        bad = x.copy()
        bad[at] = np.nan
        with pytest.raises(InvalidInputError, match="x0 must be finite"):
            descend(LevenbergMarquardt(), problem, bad, limits=Limits())
    x[0] = 1e200
    with pytest.raises(InvalidInputError, match="failed at x0 with every damping"):
        descend(LevenbergMarquardt(), problem, x, limits=Limits())


def endless(n=20_000):
    """Minutes of steps, if nobody ends them."""
    t = np.linspace(0, 1, n)
    points = np.column_stack([t, np.sin(40 * t)]) + np.random.default_rng(1).normal(0, 0.1, (n, 2))
    knots = clamped_knots(400, 3)
    guess = points[np.linspace(0, n - 1, 400).astype(int)]
    problem = CurveProblem(points, BSplineCurve(knots, guess, 3), ends="fitted")
    limits = Limits(
        max_iterations=10**6, max_evaluations=10**6, relative_decrease=0.0, gradient_tolerance=0.0
    )
    return problem, problem.pack(guess, t), limits


def test_a_run_that_is_asked_to_end_keeps_what_it_has():
    problem, x, limits = endless()
    asked = []

    def enough(size):
        asked.append(size)
        return len(asked) > 2

    run = descend(LevenbergMarquardt(), problem, x, limits=limits, ask=enough)
    assert run.stop is Stop.CANCELLED
    assert asked == [400] * 3
    assert run.cost == run.history[-1].cost < run.history[0].cost
    assert problem.cost(run.x) == run.cost


def test_another_solver_is_asked_after_every_iteration():
    problem, x = curve_problem(True, 3)
    asked = []
    run = descend(make_solver("l-bfgs"), problem, x, limits=Limits(), ask=asked.append)
    assert len(asked) == len(run.history) > 3


def test_a_run_takes_one_call():
    assert set(dir(_kernels.LeastSquares)) >= {"descend", "damped_step", "cost"}
    problem, x = curve_problem(True, 3)
    calls = []

    class Counting:
        def __getattr__(self, name):
            calls.append(name)
            return getattr(kernel, name)

    kernel, problem.kernel = problem.kernel, Counting()
    descend(LevenbergMarquardt(), problem, x, limits=Limits())
    assert calls == ["descend"]
