"""The loop: its stopping rules, its history, its input."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from tests.support.solver_problems import EPS, CircleFit, Rosenbrock, Slope

from shapespline.errors import InvalidInputError
from shapespline.solvers.iteration import Limits, Stop, minimize
from shapespline.solvers.quasi_newton import METHODS, make_solver

# --- why a run stops -----------------------------------------------------------------------------


def run(limits, problem=None, callback=None, name="l-bfgs"):
    problem = Rosenbrock() if problem is None else problem
    start = getattr(problem, "start", np.ones(2))
    return minimize(make_solver(name), problem, start, limits=limits, callback=callback)


def test_stops_at_the_gradient():
    result = run(Limits(gradient_tolerance=1e-3, relative_decrease=0.0))
    assert result.stop is Stop.GRADIENT
    assert result.stop.converged
    first, *middle, last = (r.gradient_norm for r in result.history)
    assert last <= 1e-3 * first < min(middle)


def test_a_start_at_the_minimum_stops_at_once():
    problem = Rosenbrock()
    result = minimize(make_solver("d-bfgs"), problem, np.ones(4))
    assert (result.stop, len(result.history), problem.evaluations) == (Stop.GRADIENT, 1, 1)


def test_stops_when_the_cost_hardly_falls_three_times():
    result = run(Limits(relative_decrease=1e-6, gradient_tolerance=0.0), CircleFit())
    assert result.stop is Stop.DECREASE
    costs = [r.cost for r in result.history]
    small = [a - b <= 1e-6 * a for a, b in pairwise(costs)]
    assert small[-3:] == [True] * 3
    assert not any(all(small[i : i + 3]) for i in range(len(small) - 3))


@dataclass(frozen=True)
class Scripted:
    """Goes through given costs, an evaluation each, and stays at the last."""

    costs: tuple
    patience: int = 3

    def init(self, problem, x):
        return replace(make_solver("oss").init(Slope(), x), cost=self.costs[0])

    def step(self, problem, state, max_evaluations):
        cost = self.costs[min(state.evaluations, len(self.costs) - 1)]
        return replace(state, cost=cost, evaluations=state.evaluations + 1)


def test_one_short_step_is_no_convergence():
    costs = (100.0, 90.0, 90.0, 89.9999, 80.0, 70.0)
    limits = Limits(relative_decrease=1e-4, gradient_tolerance=0.0)
    assert len(minimize(Scripted(costs), None, [0.0], limits=limits).history) == 6 + 3
    assert len(minimize(Scripted(costs, 2), None, [0.0], limits=limits).history) == 4
    assert len(minimize(Scripted(costs, 1), None, [0.0], limits=limits).history) == 3


def test_stops_at_the_target_cost():
    result = run(Limits(target_cost=1.0))
    assert result.stop is Stop.TARGET
    assert result.history[-1].cost <= 1.0 < result.history[-2].cost


def test_stops_when_the_problem_is_satisfied():
    seen = []
    result = run(Limits(reached=lambda x: seen.append(x) or len(seen) == 3))
    assert result.stop is Stop.TARGET
    assert len(result.history) == 3
    assert seen[-1] is result.x


def test_stops_at_round_off():
    """The circle's cost stays at 0.03; a gradient of zero is not to be had."""
    result = run(
        Limits(relative_decrease=0.0, gradient_tolerance=0.0, target_cost=None), CircleFit(), None
    )
    assert result.stop in (Stop.NO_DECREASE, Stop.DECREASE, Stop.GRADIENT)
    assert result.cost - CircleFit.minimum <= 100 * EPS * CircleFit.minimum


def test_stops_when_no_lower_point_is_found():
    class WrongSign(Rosenbrock):
        def cost_and_gradient(self, x):
            cost, gradient = super().cost_and_gradient(x)
            return cost, -gradient

    problem = WrongSign()
    result = run(Limits(), problem)
    assert result.stop is Stop.NO_DECREASE
    assert not result.stop.converged
    np.testing.assert_array_equal(result.x, problem.start)
    assert result.history[-1].step == 0.0
    assert result.history[-1].evaluations == problem.evaluations


@pytest.mark.parametrize("most", [0, 1, 4])
def test_stops_at_the_iterations(most):
    result = run(Limits(max_iterations=most))
    assert result.stop is Stop.ITERATIONS
    assert result.history[-1].iteration == most


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("most", [1, 2, 3, 7, 12])
def test_stops_at_the_evaluations_and_never_passes_them(name, most):
    problem = Rosenbrock()
    result = run(Limits(max_evaluations=most), problem, name=name)
    assert result.stop is Stop.EVALUATIONS
    assert problem.evaluations == most


def test_the_callback_sees_every_record_and_cancels():
    seen = []

    def callback(record):
        seen.append(record)
        return record.iteration == 3

    result = run(Limits(), callback=callback)
    assert result.stop is Stop.CANCELLED
    assert tuple(seen) == result.history
    assert len(seen) == 4
    assert result.cost == seen[-1].cost == Rosenbrock().cost(result.x)


def test_a_callback_without_an_answer_goes_on():
    assert run(Limits(), callback=lambda record: None).stop.converged


def test_every_reason_tells_something_else():
    assert len({stop.value for stop in Stop}) == len(Stop) == 7


@pytest.mark.parametrize("x0", [np.zeros((2, 2)), [], [np.nan], [np.inf, 0.0]])
def test_bad_starts(x0):
    with pytest.raises(InvalidInputError, match="x0"):
        minimize(make_solver("oss"), Slope(), x0)


def test_a_start_without_a_cost():
    class Bad(Slope):
        def cost(self, x):
            return np.nan

    with pytest.raises(InvalidInputError, match="finite"):
        minimize(make_solver("oss"), Bad(), np.zeros(2))


@pytest.mark.parametrize(
    "bad",
    [
        {"max_iterations": -1},
        {"max_evaluations": 0},
        {"relative_decrease": -1e-3},
        {"gradient_tolerance": 1.0},
        {"gradient_tolerance": float("nan")},
        {"target_cost": float("nan")},
    ],
)
def test_bad_limits(bad):
    with pytest.raises(InvalidInputError, match=next(iter(bad))):
        Limits(**bad)
