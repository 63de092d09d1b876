"""The generalised BFGS family against its definitions, and the loop that runs it."""

from __future__ import annotations

import tracemalloc
from dataclasses import astuple, dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.solver_problems import (
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
from shapespline.solvers.quasi_newton import (
    METHODS,
    DenseInverse,
    DirectDiagonal,
    FixedDiagonal,
    InverseDiagonal,
    LimitedMemory,
    Pair,
    QuasiNewton,
    make_solver,
)

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


# --- the update formulas, against exact dense arithmetic -----------------------------------------


def exact(a):
    return np.vectorize(Fraction, otypes=[object])(a)


def direct_update(B, s, y):
    """Eq. 8 of the paper, dense."""
    Bs = B @ s
    return B + np.outer(y, y) / (y @ s) - np.outer(Bs, Bs) / (s @ Bs)


def inverse_update(H, s, y):
    """Eq. 11 of the paper, dense (its first factor transposed, as Sherman-Morrison gives it)."""
    V = exact(np.eye(s.size, dtype=int)) - np.outer(y, s) / (y @ s)
    return V.T @ H @ V + np.outer(s, s) / (y @ s)


def pair_of(rng, n):
    """A step and a change of gradient of positive curvature, as floats."""
    root = rng.normal(size=(n, n)) + 2.0 * np.eye(n)
    s = rng.normal(size=n) * 10.0 ** rng.uniform(-3, 3)
    y = root.T @ (root @ s)
    return Pair(s, y, float(s @ y))


def cancellation(pair):
    """Rounding of rho in units of eps: n |s|'|y| / rho."""
    return pair.s.size * float(np.abs(pair.s) @ np.abs(pair.y)) / pair.rho


def direction_bound(inverse_diagonal, pair, g):
    """The direction's formula with every sign turned to plus, times its count of roundings.

    a, q, z, y'z/rho and the sum lose n + n|s|'|y|/rho + 6 units at most, each of the three stages.
    """
    s, y = np.abs(pair.s), np.abs(pair.y)
    a = s @ np.abs(g) / pair.rho
    hq = inverse_diagonal * (np.abs(g) + a * y)
    total = hq + s * (a + y @ hq / pair.rho)
    return 3.0 * (g.size + cancellation(pair) + 6.0) * EPS * total


def assert_within(actual, expected, bound):
    """Compare floats with exact fractions."""
    error = np.abs((exact(actual) - expected).astype(float))
    assert (error <= bound).all(), (error / bound).max()


@pytest.mark.parametrize("seed", range(5))
def test_the_two_dense_updates_are_inverses(seed):
    """Υ and Ω of the paper belong together (the reference itself, in exact arithmetic)."""
    rng = np.random.default_rng(seed)
    pair = pair_of(rng, 4)
    b, s, y = exact(rng.uniform(0.1, 10.0, 4)), exact(pair.s), exact(pair.y)
    product = direct_update(np.diag(b), s, y) @ inverse_update(np.diag(1 / b), s, y)
    assert (product == np.eye(4, dtype=int)).all()


@pytest.mark.parametrize("kind", [FixedDiagonal, DirectDiagonal, InverseDiagonal])
@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 10_000), n=st.integers(2, 6))
def test_secant_direction(kind, seed, n):
    """D = -H+ g with H+ of Eq. 11 from the diagonal of the step before."""
    rng = np.random.default_rng(seed)
    diagonal, g, pair = 10.0 ** rng.uniform(-3, 3, n), rng.normal(size=n), pair_of(rng, n)
    model = kind(diagonal).updated(pair)
    assert model.diagonal is diagonal  # one update behind
    h = exact(diagonal) if kind is InverseDiagonal else 1 / exact(diagonal)
    expected = -inverse_update(np.diag(h), exact(pair.s), exact(pair.y)) @ exact(g)
    assert_within(model.direction(g), expected, direction_bound(h.astype(float), pair, g))


@pytest.mark.parametrize("secant", [True, False])
@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 10_000), n=st.integers(2, 6))
def test_direct_diagonal(secant, seed, n):
    """Diagonal, trace and determinant of Eq. 8, and the convergence theory's two conditions."""
    rng = np.random.default_rng(seed)
    b, pair, other = 10.0 ** rng.uniform(-3, 3, n), pair_of(rng, n), pair_of(rng, n)
    model = DirectDiagonal(b, secant).updated(pair)
    model = model.updated(other) if secant else model
    dense = direct_update(np.diag(exact(b)), exact(pair.s), exact(pair.y))
    bs = b * pair.s
    size = b + pair.y**2 / pair.rho + bs**2 / (bs @ pair.s)
    bound = (n + cancellation(pair) + 8.0) * EPS * size  # every term's roundings
    bound = bound + 1e-12 * b  # the floor
    assert_within(model.diagonal, np.diag(dense), bound)
    assert (model.diagonal > 0.0).all()
    trace = sum(np.diag(dense))
    assert abs(float(sum(exact(model.diagonal)) - trace)) <= bound.sum()
    s = exact(pair.s)
    determinant = np.prod(exact(b)) * (exact(pair.y) @ s) / (s @ (exact(b) * s))
    slack = float(np.sum(bound / model.diagonal))  # relative change of a product, first order
    assert float(np.prod(exact(model.diagonal)) / determinant) >= 1.0 - 2.0 * slack


@pytest.mark.parametrize("secant", [True, False])
@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 10_000), n=st.integers(2, 6))
def test_inverse_diagonal(secant, seed, n):
    """The diagonal of Eq. 11; it is never below the inverse of the direct one."""
    rng = np.random.default_rng(seed)
    d, pair, other = 10.0 ** rng.uniform(-3, 3, n), pair_of(rng, n), pair_of(rng, n)
    model = InverseDiagonal(d, secant).updated(pair)
    model = model.updated(other) if secant else model
    s, y, rho = pair.s, pair.y, pair.rho
    dense = inverse_update(np.diag(exact(d)), exact(s), exact(y))
    size = d * (1.0 + np.abs(s * y) / rho) ** 2 + s**2 * (d @ y**2) / rho**2 + s**2 / rho
    bound = 2.0 * (n + cancellation(pair) + 8.0) * EPS * size
    assert_within(model.diagonal, np.diag(dense), bound)
    direct = DirectDiagonal(1.0 / d, False).updated(pair).diagonal
    direct_size = 1.0 / d + y**2 / rho + (s / d) ** 2 / (s @ (s / d))
    direct_error = (n + cancellation(pair) + 9.0) * EPS * direct_size + 1e-12 / d
    assert (model.diagonal + bound >= 1.0 / (direct + direct_error)).all()


def test_direct_diagonal_stays_positive_where_one_entry_is_all_of_the_step():
    s = np.array([0.0, 3.0, 0.0])
    pair = Pair(s, np.array([1.0, 1e-12, 0.0]), 3e-12)
    diagonal = DirectDiagonal(np.array([1.0, 1e6, 7.0]), False).updated(pair).diagonal
    assert (diagonal > 0.0).all()
    assert diagonal[2] == 7.0


@every_method
def test_first_direction_is_the_scaled_gradient(name):
    scale, g = np.array([4.0, 0.5, 8.0]), np.array([1.0, -2.0, 3.0])
    kept = g.copy()
    direction = make_solver(name).start(scale).direction(g)
    np.testing.assert_array_equal(direction, -g / scale)  # powers of two: exact
    np.testing.assert_array_equal(g, kept)
    assert not np.shares_memory(direction, g)


def test_non_secant_direction_uses_the_diagonal_alone():
    rng = np.random.default_rng(0)
    pair, g, scale = pair_of(rng, 4), rng.normal(size=4), rng.uniform(1.0, 2.0, 4)
    direct = DirectDiagonal(scale, False).updated(pair)
    np.testing.assert_array_equal(direct.direction(g), -g / direct.diagonal)
    inverse = InverseDiagonal(scale, False).updated(pair)
    np.testing.assert_array_equal(inverse.direction(g), -g * inverse.diagonal)
    fixed = FixedDiagonal(scale, False).updated(pair)
    np.testing.assert_array_equal(fixed.direction(g), -g / scale)


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 10_000), n=st.integers(2, 6))
def test_dense_inverse(seed, n):
    rng = np.random.default_rng(seed)
    d, pair = 10.0 ** rng.uniform(-2, 2, n), pair_of(rng, n)
    model = DenseInverse(np.diag(d)).updated(pair)
    np.testing.assert_array_equal(model.matrix, model.matrix.T)
    s, y, rho = np.abs(pair.s), np.abs(pair.y), pair.rho
    expected = inverse_update(np.diag(exact(d)), exact(pair.s), exact(pair.y))
    w = (0.5 * s * (1.0 + y @ (d * y) / rho) + d * y) / rho
    size = np.diag(d) + np.outer(s, w) + np.outer(w, s)
    bound = (3.0 * n + 3.0 * cancellation(pair) + 12.0) * EPS * size
    assert_within(model.matrix, expected, bound)
    g = rng.normal(size=n)
    expected = -exact(model.matrix) @ exact(g)
    bound = n * EPS * (np.abs(model.matrix) @ np.abs(g))
    assert_within(model.direction(g), expected, bound)


@pytest.mark.parametrize("count", [1, 3, 6])
@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 10_000))
def test_two_loops_equal_the_dense_recursion(count, seed):
    """Limited memory is Eq. 9's recursion over the last pairs; here 4 of up to 6."""
    rng = np.random.default_rng(seed)
    n, capacity = 5, 4
    start, g = 10.0 ** rng.uniform(-1, 1, n), rng.normal(size=n)
    pairs = [pair_of(rng, n) for _ in range(count)]
    model = LimitedMemory(start, capacity)
    for pair in pairs:
        model = model.updated(pair)
    kept, last = pairs[-capacity:], pairs[-1]
    assert model.pairs == tuple(kept)
    expected_scale = float(last.s @ last.y) / float(last.y @ (last.y / start))
    assert abs(model.scale - expected_scale) <= 3 * (n + 3) * EPS * expected_scale + EPS * (
        cancellation(last) * expected_scale
    )
    H = np.diag(Fraction(model.scale) / exact(start))
    for pair in kept:
        H = inverse_update(H, exact(pair.s), exact(pair.y))
    # The two loops with every sign turned to plus; each of the 2m stages loses as in one secant.
    q, a = np.abs(g), []
    for pair in reversed(kept):
        a.append(np.abs(pair.s) @ q / pair.rho)
        q = q + a[-1] * np.abs(pair.y)
    q = q * model.scale / start
    for pair, coefficient in zip(kept, reversed(a), strict=True):
        q = q + np.abs(pair.s) * (coefficient + np.abs(pair.y) @ q / pair.rho)
    units = n + max(map(cancellation, kept)) + 6.0
    assert_within(model.direction(g), -H @ exact(g), 2 * len(kept) * 1.5 * units * EPS * q)


def test_limited_memory_equals_bfgs_on_a_quadratic():
    """With exact line searches the two take parallel directions, to the same points."""
    rng = np.random.default_rng(3)
    n, condition = 6, 10.0
    basis = np.linalg.qr(rng.normal(size=(n, n)))[0]
    A = basis * np.geomspace(1.0, condition, n) @ basis.T
    start = np.diag(A).copy()
    models = [make_solver("bfgs").start(start), make_solver("l-bfgs", memory=n).start(start)]
    xs = [np.ones(n), np.ones(n)]
    for _ in range(n - 1):
        directions = []
        for i, model in enumerate(models):
            g = A @ xs[i]
            d = model.direction(g)
            s = -(g @ d) / (d @ A @ d) * d
            models[i], xs[i] = model.updated(Pair(s, A @ s, float(s @ A @ s))), xs[i] + s
            directions.append(d / np.linalg.norm(d))
        # Conjugate gradients lose a factor of the condition number a step and its square once
        # the gradient, relative to the first, has fallen to 1/condition.
        assert np.linalg.norm(directions[0] - directions[1]) <= n * n * condition**2 * EPS * 10
    assert len(models[1].pairs) == n - 1


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
        return result.x.tobytes(), [astuple(r)[:-1] for r in result.history]

    assert bits() == bits()
