"""The damping policy: what is accepted, how the damping moves, when it gives up."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from tests.support.solver_problems import EPS, PROBLEMS, CircleFit, Rosenbrock

from shapespline.errors import InvalidInputError
from shapespline.solvers.iteration import Limits, Stop, minimize
from shapespline.solvers.levenberg_marquardt import LevenbergMarquardt, Proposal

every_problem = pytest.mark.parametrize("make", PROBLEMS, ids=lambda p: p.name)


@every_problem
def test_finds_every_minimum(make):
    problem = make()
    before = problem.start.copy()
    limits = Limits(relative_decrease=1e-15, gradient_tolerance=1e-9)
    result = minimize(LevenbergMarquardt(), problem, problem.start, limits=limits)
    assert result.stop.converged or result.stop is Stop.NO_DECREASE
    # The excess over the minimum is quadratic in the gradient, here (1e-9)^2 of the start's
    # cost up to the conditioning (1e4 at most), or the rounding of the sum that is left.
    excess = 1e-14 * result.history[0].cost + 100 * EPS * problem.minimum
    assert result.cost - problem.minimum <= excess
    assert result.history[-1].iteration <= 40
    np.testing.assert_array_equal(problem.start, before)


@every_problem
def test_history_is_honest(make):
    problem = make()
    result = minimize(LevenbergMarquardt(), problem, problem.start, limits=Limits())
    history = result.history
    assert all(b.cost < a.cost for a, b in pairwise(history[:-1]))
    assert history[-1].cost == result.cost == problem.cost(result.x)
    assert history[-1].evaluations == problem.evaluations - 1  # the line above made one
    gradient = problem.cost_and_gradient(result.x)[1]
    expected = math.sqrt((gradient**2 / problem.scale(result.x)).sum())
    cost, jac = result.cost, problem.jacobian(result.x)
    noise = jac.shape[0] * EPS * math.sqrt(2 * cost * jac.shape[1])  # of J'r, in the scaled norm
    assert abs(history[-1].gradient_norm - expected) <= noise + 20 * EPS * expected


class Scripted:
    """Moves x by -1 a step; answers each trial with the next cost and promise of a script."""

    def __init__(self, trials, first=100.0, promise=10.0):
        self.costs = iter([first, *trials])
        self.promise = promise
        self.dampings = []

    def cost(self, x):
        return next(self.costs)

    def damped_step(self, x, damping):
        self.dampings.append(damping)
        return Proposal(x - 1.0, self.promise, 1.0)


def dampings(trials, **options):
    """Run a script to its end and return the dampings that were asked for."""
    problem = Scripted(trials, **options)
    limits = Limits(max_evaluations=len(trials) + 1, relative_decrease=0.0)
    result = minimize(LevenbergMarquardt(start_damping=1.0), problem, [0.0], limits=limits)
    assert result.stop is Stop.EVALUATIONS
    return problem.dampings, result


@pytest.mark.parametrize(
    ("gain", "turn"),
    [
        (10.0, 1.0 / 3.0),  # ratio 1: the model was right
        (50.0, 1.0 / 3.0),  # better than promised is no worse than right
        (5.0, 1.0),  # ratio 1/2: as it is
        (1.0, 1.0 + 0.8**3),  # ratio 0.1
    ],
)
def test_the_damping_follows_the_gain_ratio(gain, turn):
    asked, result = dampings([100.0 - gain])
    # 2 gain / promise - 1, its cube and the difference: below eight roundings of numbers near 1.
    assert asked[0] == 1.0
    assert abs(asked[1] - turn) <= 8 * EPS
    assert result.history[1].step == 1.0
    assert result.x[0] == -1.0


def test_a_gain_far_beyond_the_promise_does_not_overflow():
    asked, _ = dampings([90.0], promise=1e-300)
    assert asked == [1.0, 1.0 / 3.0]


def test_rejected_steps_raise_the_damping_ever_faster_and_an_accepted_one_resets():
    asked, result = dampings([100.0, math.nan, math.inf, 95.0, 95.0, 95.0])
    assert asked == [1.0, 2.0, 8.0, 64.0, 64.0, 128.0, 512.0]
    assert [r.cost for r in result.history] == [100.0, 95.0, 95.0]
    assert result.history[1].evaluations == 5
    assert result.history[1].step == 64.0
    assert result.x[0] == -1.0


def test_a_failed_factorisation_raises_the_damping():
    class Stubborn(CircleFit):
        refused = 0

        def damped_step(self, x, damping):
            if damping < 0.5:
                self.refused += 1
                return None
            return super().damped_step(x, damping)

    problem = Stubborn()
    result = minimize(LevenbergMarquardt(), problem, problem.start)
    assert problem.refused >= 2
    assert result.stop.converged
    # Damping 0.5 and more: linear convergence by a factor of about 1/3 a step, stopped when the
    # cost falls by 1e-9 of itself, so that about as much is left.
    assert result.cost - problem.minimum <= 1e-8 * problem.minimum


def test_gives_up_when_every_factorisation_fails():
    class Broken(CircleFit):
        def damped_step(self, x, damping):
            return None if x is not self.first else super().damped_step(x, damping)

        def cost(self, x):
            self.first = getattr(self, "first", x)
            return super().cost(x)

    problem = Broken()
    result = minimize(LevenbergMarquardt(), problem, problem.start)
    assert result.stop is Stop.NO_DECREASE
    assert result.history[1].cost < result.history[0].cost
    assert result.history[-1].cost == result.history[1].cost

    class Hopeless(CircleFit):
        def damped_step(self, x, damping):
            return None

    with pytest.raises(InvalidInputError, match="start elsewhere"):
        minimize(LevenbergMarquardt(), Hopeless(), problem.start)


def test_gives_up_when_the_damping_explodes():
    class WrongWay(Rosenbrock):
        def damped_step(self, x, damping):
            right = super().damped_step(x, damping)
            return Proposal(2.0 * x - right.x, right.predicted_decrease, right.gradient_norm)

    problem = WrongWay()
    result = minimize(LevenbergMarquardt(), problem, problem.start)
    assert result.stop is Stop.NO_DECREASE
    np.testing.assert_array_equal(result.x, problem.start)
    assert result.history[-1].evaluations == problem.evaluations
    # 1e-3 2^(k(k+1)/2) > 1e16 for k = 11.
    assert problem.evaluations == 12


def test_a_promise_below_the_rounding_of_the_cost_ends_the_run_at_once():
    problem = Scripted([100.0], promise=1e-15)
    result = minimize(LevenbergMarquardt(), problem, [0.0])
    assert (result.stop, len(problem.dampings)) == (Stop.NO_DECREASE, 1)


@pytest.mark.parametrize("most", [1, 2, 3, 8])
def test_the_evaluations_are_never_passed(most):
    problem = Rosenbrock()
    limits = Limits(max_evaluations=most)
    result = minimize(LevenbergMarquardt(), problem, problem.start, limits=limits)
    assert result.stop is Stop.EVALUATIONS
    assert problem.evaluations == most


def test_other_reasons():
    problem = Rosenbrock()

    def stop(limits=None, callback=None):
        return minimize(
            LevenbergMarquardt(), problem, problem.start, limits=limits, callback=callback
        )

    assert stop(Limits(target_cost=1.0)).stop is Stop.TARGET
    assert stop(Limits(reached=lambda x: True)).stop is Stop.TARGET
    assert stop(Limits(max_iterations=2)).stop is Stop.ITERATIONS
    assert stop(Limits(gradient_tolerance=1e-4)).stop is Stop.GRADIENT
    cancelled = stop(callback=lambda record: record.iteration == 2)
    assert (cancelled.stop, len(cancelled.history)) == (Stop.CANCELLED, 3)
    circle = CircleFit()
    limits = Limits(relative_decrease=1e-3, gradient_tolerance=0.0)
    assert minimize(LevenbergMarquardt(), circle, circle.start, limits=limits).stop is Stop.DECREASE


@pytest.mark.parametrize("bad", [0.0, -1.0, math.inf, math.nan])
def test_bad_start_damping(bad):
    with pytest.raises(InvalidInputError, match="start_damping"):
        LevenbergMarquardt(start_damping=bad)
