"""The Wolfe conditions hold where a search claims success, and failures are honest."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.support.solver_problems import EPS, PROBLEMS

from shapespline.errors import InvalidInputError
from shapespline.solvers.line_search import dot, wolfe_search

C1, C2 = 1e-4, 0.9


def curve(function, derivative):
    """A cost of one variable as a search sees it."""
    return lambda x: (float(function(x[0])), np.array([float(derivative(x[0]))]))


def search(function, x=0.0, direction=1.0, **options):
    x, direction = np.array([float(x)]), np.array([float(direction)])
    cost, gradient = function(x)
    return wolfe_search(function, x, cost, gradient, direction, **options)


def assert_wolfe(function, x, direction, found, wolfe, c1=C1, c2=C2):
    """Eq. 6 of the paper, evaluated again at the step found; no slack, as the search has none."""
    cost, gradient = function(x)
    slope = float(gradient @ direction)
    new_cost, new_gradient = function(x + found.step * direction)
    new_slope = float(new_gradient @ direction)
    assert new_cost == found.cost
    np.testing.assert_array_equal(new_gradient, found.gradient)
    assert new_cost <= cost + c1 * found.step * slope
    if wolfe == "strong":
        assert abs(new_slope) <= c2 * abs(slope)
    else:
        assert new_slope >= c2 * slope


@pytest.mark.parametrize("wolfe", ["strong", "weak"])
@given(
    a=st.floats(-3, 3),
    b=st.floats(0.01, 5),
    c=st.floats(0.1, 10),
    log_length=st.floats(-6, 6),
    constants=st.sampled_from([(1e-4, 0.9), (0.4, 0.5), (1e-4, 0.1)]),
)
def test_wolfe_conditions_hold(wolfe, a, b, c, log_length, constants):
    """A wavy, coercive cost and directions over twelve decades of length."""

    def function(x):
        cost = 0.5 * float(b * x @ x) + a * math.sin(c * x[0])
        return cost, b * x + np.array([a * c * math.cos(c * x[0]), 0.0])

    x = np.array([1.0, 2.0])
    cost, gradient = function(x)
    direction = -(10.0**log_length) * gradient
    slope = -float(gradient @ gradient)
    if not math.hypot(*gradient) > 1e-3:
        return
    c1, c2 = constants
    found = wolfe_search(
        function, x, cost, gradient, direction, wolfe=wolfe, c1=c1, c2=c2, max_evaluations=100
    )
    assert slope < 0.0
    assert found.success
    assert_wolfe(function, x, direction, found, wolfe, c1, c2)


@pytest.mark.parametrize("wolfe", ["strong", "weak"])
@pytest.mark.parametrize("make", PROBLEMS, ids=lambda p: p.name)
def test_wolfe_conditions_hold_on_every_problem(make, wolfe):
    problem = make()
    x = problem.start
    cost, gradient = problem.cost_and_gradient(x)
    problem.evaluations = 0
    found = wolfe_search(problem.cost_and_gradient, x, cost, gradient, -gradient, wolfe=wolfe)
    assert found.success
    assert found.evaluations == problem.evaluations
    assert_wolfe(problem.cost_and_gradient, x, -gradient, found, wolfe)


def test_weak_takes_a_rising_slope_that_strong_refuses():
    # f = (x - 0.55)^4 at x = 1.04: the slope has turned, and is 0.7 of the first in size.
    function = curve(lambda t: (t - 0.55) ** 4, lambda t: 4 * (t - 0.55) ** 3)
    weak = search(function, wolfe="weak", c2=0.5, first_step=1.04)
    assert (weak.step, weak.evaluations) == (1.04, 1)
    strong = search(function, wolfe="strong", c2=0.5, first_step=1.04)
    assert strong.success
    assert strong.evaluations > 1
    assert abs(strong.gradient[0]) <= 0.5 * 4 * 0.55**3


def test_first_step_is_tried_first():
    function = curve(lambda t: (t - 1.0) ** 2, lambda t: 2.0 * (t - 1.0))
    found = search(function)
    assert (found.step, found.cost, found.evaluations, found.success) == (1.0, 0.0, 1, True)


@pytest.mark.parametrize("first_step", [1e-6, 1e6])
def test_a_quadratic_is_hit_by_interpolation(first_step):
    # Extrapolation by 4 needs log4(1e6) = 10 trials; the margin of 0.01 needs 3 plus the hit.
    function = curve(lambda t: (t - 1.0) ** 2, lambda t: 2.0 * (t - 1.0))
    found = search(function, first_step=first_step, c2=0.1)
    assert found.success
    assert found.evaluations <= (12 if first_step < 1 else 5)


@pytest.mark.parametrize("bad", [math.inf, math.nan, -math.inf])
def test_values_that_are_not_finite_shrink_the_step(bad):
    def function(x):
        if x[0] > 1e-3:
            return bad, np.array([math.nan])
        return float((x[0] - 9e-4) ** 2), 2.0 * (x - 9e-4)

    found = search(function)
    assert found.success
    assert 0.0 < found.step <= 1e-3
    assert_wolfe(function, np.zeros(1), np.ones(1), found, "strong")
    assert found.evaluations <= 6  # 1, 0.1, 0.01, 0.001 and at most two in between; not ten halves


def test_extrapolation_hits_a_quadratic():
    function = curve(lambda t: (t - 3.0) ** 2, lambda t: 2.0 * (t - 3.0))
    found = search(function, c2=0.1)
    assert (found.step, found.evaluations) == (3.0, 2)


def test_a_bracket_shrinks_even_where_interpolation_stalls():
    """A kink with a slope of -1 before and 1000 behind: the cubic creeps from one side.

    Two trials lose a third of the bracket or the third one halves it, at worst a factor 0.81 a
    trial. Slopes within 0.1 lie 1.7e-4 wide (the second derivative is 1200 there), and
    log(1.7e-4) / log(0.81) = 41. Interpolation alone takes 67.
    """

    def bend(t):
        return math.hypot(t - 0.3, 1e-4)

    function = curve(
        lambda t: -t + 500.5 * (bend(t) + t - 0.3),
        lambda t: -1.0 + 500.5 * ((t - 0.3) / bend(t) + 1.0),
    )
    found = search(function, c2=0.1, max_evaluations=100)
    assert found.success
    assert found.evaluations <= 41


def test_budget_returns_the_best_point_with_decrease():
    def function(x):  # falls for ever, so no curvature condition holds
        return -x[0], np.array([-1.0])

    calls = []
    found = search(lambda x: (calls.append(x), function(x))[1], max_evaluations=5)
    assert not found.success
    assert found.evaluations == 5 == len(calls) - 1  # one call was the start
    assert found.cost == min(-x[0] for x in calls)
    assert found.cost == function(np.array([found.step]))[0]


def test_wrong_gradient_gives_step_zero_and_the_start_back():
    gradient = np.array([-1.0])  # says downhill, where the cost rises
    found = wolfe_search(lambda x: (float(x[0]), gradient), np.zeros(1), 0.0, gradient, np.ones(1))
    assert (found.step, found.cost, found.success) == (0.0, 0.0, False)
    assert found.gradient is gradient
    assert found.evaluations <= 30


def test_round_off_ends_the_search_early():
    # Near the minimum of 1 + t^2 the promised decrease, 1e-20, is far below eps * 1; the trial at
    # a step 1e8 times too long shows a rise, the bracket then holds nothing that could show.
    function = curve(lambda t: 1.0 + t * t, lambda t: 2.0 * t)
    found = search(function, x=1e-10, direction=-1e-10, first_step=1e4)
    assert found.cost <= 1.0
    assert found.evaluations <= 6
    stuck = search(curve(lambda t: 1.0 + abs(t), lambda t: -1e-17), first_step=1.0)
    assert (stuck.step, stuck.success, stuck.evaluations) == (0.0, False, 1)


def test_decrease_by_rounding_alone_is_none():
    """A gradient of the wrong sign: x + step d = x at last, where the cost does not rise."""
    function = curve(lambda t: t * t, lambda t: -2.0 * t)
    found = search(function, x=1.0)
    assert (found.step, found.cost, found.success) == (0.0, 1.0, False)


@pytest.mark.parametrize(
    ("options", "word"),
    [
        ({"c1": 0.9, "c2": 0.1}, "c1 and c2"),
        ({"first_step": 0.0}, "first_step"),
        ({"first_step": math.inf}, "first_step"),
        ({"direction": -1.0}, "direction"),
        ({"direction": math.nan}, "direction"),
    ],
)
def test_bad_arguments(options, word):
    function = curve(lambda t: (t - 1.0) ** 2, lambda t: 2.0 * (t - 1.0))
    with pytest.raises(InvalidInputError, match=word):
        search(function, **options)


@pytest.mark.parametrize("n", [1, 8192, 8193, 50_000])
def test_dot_is_the_inner_product(n):
    rng = np.random.default_rng(n)
    a, b = rng.normal(size=n), rng.normal(size=n)
    exact = math.fsum(a * b)  # each product rounds once: eps/2 |a_i b_i|
    assert abs(dot(a, b) - exact) <= n * EPS * float(np.abs(a) @ np.abs(b))
    assert dot(a, np.zeros(n)) == 0.0
    unit = np.zeros(n)
    unit[-1] = 1.0
    assert dot(a, unit) == a[-1]
