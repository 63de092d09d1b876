"""The update formulas of the generalised BFGS family, against exact dense arithmetic: direct and
inverse diagonals, the secant direction, the dense inverse, and the two loops of limited memory.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.support.solver_problems import EPS

from shapespline.solvers.quasi_newton import (
    DenseInverse,
    DirectDiagonal,
    FixedDiagonal,
    InverseDiagonal,
    LimitedMemory,
    Pair,
    make_solver,
)

# --- the references, and what rounding they stand ------------------------------------------------


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


# --- diagonals -----------------------------------------------------------------------------------


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


def test_non_secant_direction_uses_the_diagonal_alone():
    rng = np.random.default_rng(0)
    pair, g, scale = pair_of(rng, 4), rng.normal(size=4), rng.uniform(1.0, 2.0, 4)
    direct = DirectDiagonal(scale, False).updated(pair)
    np.testing.assert_array_equal(direct.direction(g), -g / direct.diagonal)
    inverse = InverseDiagonal(scale, False).updated(pair)
    np.testing.assert_array_equal(inverse.direction(g), -g * inverse.diagonal)
    fixed = FixedDiagonal(scale, False).updated(pair)
    np.testing.assert_array_equal(fixed.direction(g), -g / scale)


# --- dense and limited memory --------------------------------------------------------------------


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
