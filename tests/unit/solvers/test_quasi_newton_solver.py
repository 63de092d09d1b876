"""The loop that runs the generalised BFGS family: every method finds every minimum and keeps an
honest history; units, restarts, skipped updates, bad input, memory, and the same bits again.
"""

from __future__ import annotations

import tracemalloc
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from tests.support.solver_problems import (
    EPS,
    PROBLEMS,
    CircleFit,
    IllScaledQuadratic,
    Rescaled,
    Rosenbrock,
    Slope,
)

from shapespline.errors import InvalidInputError
from shapespline.solvers.iteration import Limits, Stop, minimize
from shapespline.solvers.quasi_newton import METHODS, QuasiNewton, make_solver

TO_THE_GRADIENT = Limits(
    max_iterations=40_000, max_evaluations=400_000, relative_decrease=0.0, gradient_tolerance=1e-6
)
every_method = pytest.mark.parametrize("name", METHODS)
every_problem = pytest.mark.parametrize("make", PROBLEMS, ids=lambda p: p.name)


# --- every problem times every solver ------------------------------------------------------------


def highest_excess(problem, x, gradient_norm):
    """How far the cost may be above the minimum, given the gradient norm.

    With the Hessian H and the start diagonal D the excess is g' H^-1 g / 2, at most
    |g|^2 / (2 least eigenvalue of D^-1/2 H D^-1/2) in the norm of D^-1; H is taken by the
    Gauss-Newton matrix at x, and a factor 4 covers what it leaves out. The rounding of the cost
    comes on top.
    """
    d = np.sqrt(problem.scale(problem.start))
    jac = problem.jacobian(x) / d
    least = np.linalg.eigvalsh(jac.T @ jac)[0]
    return 4.0 * gradient_norm**2 / (2.0 * least) + 100 * EPS * problem.minimum


@every_problem
@every_method
@pytest.mark.parametrize("wolfe", ["strong", "weak"])
@pytest.mark.slow
def test_every_method_finds_every_minimum(make, name, wolfe):
    problem = make()
    before = problem.start.copy()
    result = minimize(
        make_solver(name, wolfe=wolfe), problem, problem.start, limits=TO_THE_GRADIENT
    )
    assert result.stop is Stop.GRADIENT
    last = result.history[-1]
    excess = highest_excess(problem, result.x, last.gradient_norm)
    assert result.cost - problem.minimum <= excess < 1e-6 * result.history[0].cost
    assert result.cost == problem.cost(result.x) == last.cost
    np.testing.assert_array_equal(problem.start, before)


@every_problem
@every_method
@pytest.mark.parametrize("start_diagonal", ["gauss-newton", "identity"])
def test_history_is_honest(make, name, start_diagonal):
    problem = make()
    solver = make_solver(name, start_diagonal=start_diagonal)
    result = minimize(solver, problem, problem.start, limits=Limits(max_iterations=60))
    history = result.history
    assert [r.iteration for r in history] == list(range(len(history)))
    assert all(b.cost <= a.cost for a, b in pairwise(history))
    assert all(b.seconds >= a.seconds for a, b in pairwise(history))
    assert history[-1].evaluations == problem.evaluations
    assert history[0].evaluations == 1
    assert history[0].step == 0.0
    assert all(r.step > 0.0 for r in history[1:-1])
    cost, gradient = problem.cost_and_gradient(result.x)
    identity = start_diagonal == "identity"
    scale = np.ones_like(gradient) if identity else problem.scale(problem.start)
    assert history[-1].cost == cost
    expected = np.sqrt((gradient**2 / scale).sum())
    # A sum of n non-negative terms, three roundings each, and a square root.
    assert abs(history[-1].gradient_norm - expected) <= (gradient.size + 4) * EPS * expected


@every_method
def test_first_direction_is_the_scaled_gradient(name):
    scale, g = np.array([4.0, 0.5, 8.0]), np.array([1.0, -2.0, 3.0])
    kept = g.copy()
    direction = make_solver(name).start(scale).direction(g)
    np.testing.assert_array_equal(direction, -g / scale)  # powers of two: exact
    np.testing.assert_array_equal(g, kept)
    assert not np.shares_memory(direction, g)


def test_scaled_start_beats_the_identity():
    """What METHOD measured: with the identity the diagonal methods crawl on mixed units."""
    counts = [
        minimize(
            make_solver("d-bfgs", start_diagonal=start),
            problem := IllScaledQuadratic(),
            problem.start,
            limits=Limits(relative_decrease=0.0, target_cost=1e-8),
        )
        .history[-1]
        .evaluations
        for start in ("gauss-newton", "identity")
    ]
    assert counts[0] < counts[1]


# --- units ---------------------------------------------------------------------------------------


def without_seconds(result, cost_unit=1.0):
    return [
        (r.iteration, r.cost / cost_unit, r.gradient_norm / cost_unit**0.5, r.evaluations, r.step)
        for r in result.history
    ]


@every_problem
@every_method
def test_units_do_not_matter_with_a_scaled_start(make, name):
    """Powers of two round nothing, so that the iterates agree bit for bit."""
    problem = make()
    units = 2.0 ** (5 * (-1.0) ** np.arange(problem.start.size))
    limits = Limits(max_iterations=25)
    plain = minimize(make_solver(name), problem, problem.start, limits=limits)
    other = Rescaled(problem, units, cost_unit=2.0**-6)
    scaled = minimize(make_solver(name), other, other.start, limits=limits)
    assert without_seconds(plain) == without_seconds(scaled, 2.0**-6)
    np.testing.assert_array_equal(plain.x, scaled.x * units)
    assert plain.stop is scaled.stop
    assert len(plain.history) > 3


def test_units_do_matter_with_the_identity():
    problem, limits = CircleFit(), Limits(max_iterations=25)
    other = Rescaled(problem, np.full(3, 8.0))
    solver = make_solver("d-bfgs", start_diagonal="identity")
    plain = minimize(solver, problem, problem.start, limits=limits)
    scaled = minimize(solver, other, other.start, limits=limits)
    assert without_seconds(plain) != without_seconds(scaled)


# --- restarts and skipped updates ----------------------------------------------------------------


@dataclass(frozen=True)
class Uphill:
    """Descends when fresh and climbs after its first update."""

    log: list
    sign: float = -1.0

    def direction(self, gradient):
        return self.sign * gradient

    def updated(self, pair):
        self.log.append(pair)
        return Uphill(self.log, 1.0)


def test_a_direction_that_climbs_restarts_from_the_start_diagonal():
    starts, log = [], []

    def start(scale):
        starts.append(scale)
        return Uphill(log)

    problem = CircleFit()
    result = minimize(
        QuasiNewton(start, "identity"), problem, problem.start, limits=Limits(max_iterations=5)
    )
    assert result.stop is Stop.ITERATIONS
    assert len(starts) == 5  # at the start, and before each of the iterations 2 to 5
    assert len(log) == 5
    assert all(pair.rho == pair.s @ pair.y > 0.0 for pair in log)


@dataclass(frozen=True)
class Faint:
    """Points down the hill, but after its first update too faintly to move x."""

    length: float = 1.0

    def direction(self, gradient):
        return -self.length * gradient

    def updated(self, pair):
        return Faint(1e-40)


def test_a_search_without_a_lower_point_restarts_within_the_budget():
    free = CircleFit()
    solver = QuasiNewton(lambda scale: Faint(), "identity")
    result = minimize(solver, free, free.start, limits=Limits(max_iterations=2))
    assert result.history[2].cost < result.history[1].cost
    used = result.history[2].evaluations
    for most in range(1, used):
        problem = CircleFit()
        minimize(solver, problem, problem.start, limits=Limits(max_evaluations=most))
        assert problem.evaluations == most


def test_an_update_without_curvature_is_skipped():
    log = []
    solver = QuasiNewton(lambda scale: Uphill(log))
    result = minimize(solver, Slope(), np.zeros(2), limits=Limits(max_iterations=1))
    assert result.stop is Stop.ITERATIONS
    assert result.cost < 0.0
    assert log == []


# --- input ---------------------------------------------------------------------------------------


def test_unknown_names_are_answered_by_the_names():
    with pytest.raises(InvalidInputError, match=r"d-bfgs-inverse-ns.*l-bfgs.*'newton'"):
        make_solver("newton")
    with pytest.raises(InvalidInputError, match="gauss-newton, identity"):
        make_solver("oss", start_diagonal="ones")
    with pytest.raises(InvalidInputError, match="strong, weak"):
        make_solver("oss", wolfe="exact")
    with pytest.raises(InvalidInputError, match="memory"):
        make_solver("l-bfgs", memory=0)


def test_dense_bfgs_refuses_what_it_cannot_hold():
    with pytest.raises(InvalidInputError, match="l-bfgs"):
        minimize(make_solver("bfgs"), Slope(), np.zeros(5001))


@pytest.mark.parametrize("bad", [np.zeros(2), np.array([1.0, np.nan]), np.ones(3), -np.ones(2)])
def test_bad_scales(bad):
    class Bad(Slope):
        def scale(self, x):
            return bad

    with pytest.raises(InvalidInputError, match="scale"):
        minimize(make_solver("oss"), Bad(), np.zeros(2))


# --- memory and repeatability --------------------------------------------------------------------


class Separable:
    """A cheap large problem that keeps one vector of its own and makes one a call."""

    def __init__(self, n):
        self.curvature = np.linspace(1.0, 50.0, n)

    def cost(self, x):
        return self.cost_and_gradient(x)[0]

    def cost_and_gradient(self, x):
        gradient = self.curvature * x
        return 0.5 * float(gradient @ x), gradient

    def scale(self, x):
        return np.full_like(x, 7.0)


@pytest.mark.parametrize("name", [m for m in METHODS if m not in ("bfgs", "l-bfgs")])
def test_few_vectors_are_alive_at_the_peak(name):
    n = 100_000
    problem, x0 = Separable(n), np.cos(np.arange(n))
    tracemalloc.start()
    try:
        minimize(make_solver(name), problem, x0, limits=Limits(max_iterations=8))
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    # 12 vectors beyond the caller's x0, and a tenth of one for everything that is small.
    assert peak <= 12.1 * 8 * n


@every_method
def test_same_input_same_bits(name):
    def bits():
        problem, limits = Rosenbrock(), Limits(max_iterations=30)
        result = minimize(make_solver(name), problem, problem.start, limits=limits)
        return result.x.tobytes(), [
            r._replace(paper_error=0.0, seconds=0.0) for r in result.history
        ]

    assert bits() == bits()
