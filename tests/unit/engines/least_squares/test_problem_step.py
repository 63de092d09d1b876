"""The Levenberg-Marquardt step of the least-squares problem, against the dense normal equations:
every degree, held ends and parameters, bare spans, few control points, stray residuals.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from tests.support import reference
from tests.support.shapes import Case, closures, degrees

from shapespline import _kernels
from shapespline.errors import InvalidInputError
from shapespline.values.curve import BSplineCurve
from shapespline.values.knots import clamped_knots

EPS = reference.EPS


# --- against the dense system ------------------------------------------------------------------


def kernel_step(case, damping, *, weighted=True, held=0, ends=False, stray_weight=0.0):
    curve = case.curve
    control_step, parameter_step = np.empty((case.m, 2)), np.empty(case.n)
    problem = _kernels.LeastSquares(
        curve.knots,
        curve.degree,
        curve.periodic,
        case.points,
        case.weights if weighted else None,
        held,
        ends,
        stray_weight,
    )
    result = problem.damped_step(
        curve.control_points, case.parameters, damping, control_step, parameter_step
    )
    return *result, control_step, parameter_step


def assert_step(case, damping, *, held=0, ends=False, stray_weight=0.0, weighted=True):
    """The step solves the dense system of METHOD section 4, to the rounding of a Cholesky.

    Cholesky's x solves (A + dA) x = b with |dA_ik| <= c n eps sqrt(A_ii A_kk) (Higham 2002,
    theorem 10.3). The entries themselves are sums over n points, their rounding relative to
    w N_i N_k and not to the smaller W N_i N_k: g_ii = sum w N_i^2 takes the place of A_ii. Where
    the tangent is in error by a fraction kappa eps, so is W.
    """
    solved, cost, predicted, norm, dP, dt = kernel_step(
        case, damping, held=held, ends=ends, stray_weight=stray_weight, weighted=weighted
    )
    assert solved
    n = case.n
    dense = case.dense(weighted, stray_weight)
    fixed = {0: (), 1: (0, n - 1), 2: range(n)}[held]
    system = reference.damped_system(dense, damping, fixed, ends)
    x = np.concatenate([dP.ravel(), dt]).astype(np.longdouble)
    m2 = 2 * case.m
    w = dense.weights[:, None]
    dr, tangent_off = case.off(dense, 0), case.off(dense, 1)[:n]
    speed = np.sqrt((dense.tangents[:n] ** 2).sum(axis=1)).astype(float)
    kappa = 1 + float((np.sqrt((tangent_off**2).sum(axis=1)) / (EPS * speed)).max())
    unit = EPS * (n + 4 * (2 * case.degree + 1) + 20 * case.degree + 4 * kappa)

    # Control points, the parameters eliminated exactly from the kernel's own dP.
    g = np.repeat((w * dense.basis**2).sum(axis=0), 2)
    g = np.maximum(g, 1e-11 * g.max()) * (1 + damping)
    reduced = system.reduced.copy()
    i = np.arange(m2)
    diagonal = np.diag(reduced).copy()
    reduced[i, i] += damping * (diagonal + np.longdouble(1e-11) * diagonal.max())
    if ends:
        for k in (0, 1, m2 - 2, m2 - 1):
            reduced[k, :] = reduced[:, k] = 0
            reduced[k, k] = 1
        assert_array_equal(dP[[0, -1]], 0)
    residual = np.abs(reduced @ x[:m2] - system.reduced_rhs)
    if case.degree <= 5:
        # Collected as moments: an entry carries the rounding of its span's weights, not of its own.
        # The coefficients of a basis function in u in [-1, 1] sum to 2^degree at most, in size.
        g = np.maximum(g, 4.0**case.degree * float(dense.weights.sum()))
    allowed = unit * np.sqrt(g) * (np.sqrt(g) @ np.abs(x[:m2]))
    allowed += np.repeat(
        (dense.basis.T @ (w * (dr + unit * np.abs(dense.residuals)))).sum(axis=1), 2
    )
    assert (residual <= allowed).all()

    # Parameters from it: the rows of the full system that belong to them.
    rows = np.abs(system.matrix[m2:] @ x - system.rhs[m2:])
    moved = np.abs(dense.residuals[:n]) + dense.basis[:n] @ np.abs(dP)
    size = (w[:n] * (np.abs(dense.tangents[:n]) + tangent_off) * moved).sum(axis=1)
    size += (w[:n] * np.abs(dense.tangents[:n]) * dr[:n] / EPS).sum(axis=1)
    free = np.array([j not in fixed for j in range(n)])
    assert (rows[free] <= (unit * size + EPS * size)[free]).all()
    assert_array_equal(dt[~free], 0)

    # Cost, its prediction, the gradient's norm.
    w1 = dense.weights
    after = dense.residuals + dense.basis @ dP
    after[:n] += dense.tangents[:n] * dt[:, None]
    exact = float(0.5 * (w1 * (after**2).sum(axis=1)).sum())
    sizes = np.abs(dense.residuals) + dense.basis @ np.abs(dP)
    sizes[:n] += np.abs(dense.tangents[:n]) * np.abs(dt)[:, None]
    step_off = dr + unit * sizes
    slack = float((w * (np.abs(after) * step_off + step_off**2)).sum() + unit * exact)
    assert abs(predicted - exact) <= slack
    assert abs(cost - dense.cost) <= float((w * np.abs(dense.residuals) * dr).sum()) + unit * cost
    exact_norm = float(np.sqrt((system.reduced_rhs**2).sum()))
    assert abs(norm - exact_norm) <= float(np.sqrt((allowed**2).sum())) + unit * norm
    return dense, system, x


@degrees
@closures
@pytest.mark.parametrize("damping", [1e-3, 1.0, 1e3])
def test_the_step_solves_the_dense_normal_equations(degree, periodic, damping):
    assert_step(Case(degree, periodic), damping)


@degrees
@pytest.mark.parametrize("more", [1, 2, 3])
def test_few_periodic_control_points_wrap_around(degree, more):
    assert_step(Case(degree, True, m=degree + more), 0.1)


@pytest.mark.parametrize("m", [1, 2, 3])
def test_fewer_periodic_control_points_than_a_span_needs_are_right_or_refused(m):
    case = Case(3, True, m=4)
    knots = np.arange(-3, m + 4) / m
    try:
        case.curve = BSplineCurve(knots, case.curve.control_points[:m], 3, periodic=True)
    except InvalidInputError:
        return
    case.m = m
    exact = (case.dense().jacobian() ** 2).sum(axis=0)[: 2 * m]
    found = case.problem().scale(case.x())[: 2 * m]
    assert (np.abs(found - exact) <= (36 + case.n + 4) * EPS * exact).all()
    if m > 1:  # one point has no tangent
        assert_step(case, 0.1)


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_held_ends_and_parameters(degree):
    case = Case(degree, False)
    assert_step(case, 0.1, held=1)
    assert_step(case, 0.1, held=1, ends=True)
    assert_step(case, 0.1, held=2)
    assert_step(case, 0.1, held=2, ends=True)
    assert_step(Case(degree, True), 0.1, held=2)


def test_without_weights():
    assert_step(Case(3, False), 0.1, weighted=False)
    case = Case(3, True)
    case.weights = np.ones(case.n)
    ones, none = kernel_step(case, 0.1), kernel_step(case, 0.1, weighted=False)
    for a, b in zip(ones, none, strict=True):
        assert_array_equal(a, b)


@pytest.mark.parametrize("degree", [1, 3, 5])
@closures
def test_spans_with_few_or_no_points(degree, periodic):
    case = Case(degree, periodic, m=degree + 12, n=8)
    assert_step(case, 0.01)
    case = Case(degree, periodic, m=degree + 12, n=30)
    case.parameters = 0.4 * case.parameters  # nothing in the rest
    assert_step(case, 0.01)


def test_parameters_on_knots_and_beyond_the_ends_and_periods():
    case = Case(3, False, multiple=False)
    case.parameters[[3, 4, -1]] = [*case.curve.breakpoints[[1, 2]], 1.25]
    case.parameters[0] = -0.1
    case.parameters.sort()
    assert_step(case, 0.1)
    case = Case(3, True, multiple=False)
    case.parameters += 2.75
    assert_step(case, 0.1)


@pytest.mark.slow
@given(
    st.integers(1, 6), st.booleans(), st.integers(0, 10**6), st.floats(1e-4, 1e4), st.integers(0, 9)
)
def test_any_step(degree, periodic, seed, damping, more):
    case = Case(degree, periodic, seed=seed, m=degree + 1 + more, n=25)
    assert_step(case, damping)


def test_the_solution_is_that_of_the_full_system():
    # Where everything is well determined, the solutions agree as well as their residuals.
    case = Case(3, True, m=8, n=60, multiple=False)
    _, system, x = assert_step(case, 1.0)
    full = np.linalg.solve(system.matrix.astype(float), system.rhs.astype(float))
    condition = np.linalg.cond(system.matrix.astype(float))
    assert np.abs(full - x).max() <= 1e3 * EPS * condition * np.abs(full).max()


# --- what becomes of it ------------------------------------------------------------------------


def test_a_small_step_gains_what_it_predicts():
    case = Case(3, True, multiple=False)
    problem, x = case.problem(), case.x()
    before = problem.cost(x)
    off = []
    for damping in (1e3, 1e4, 1e5):
        proposal = problem.damped_step(x, damping)
        gain = before - problem.cost(proposal.x)
        assert gain > 0
        off.append(abs(gain / proposal.predicted_decrease - 1))
    # The step and with it what the linear model leaves out fall like 1 / damping.
    assert off[0] < 0.1
    assert off[1] < 0.2 * off[0]
    assert off[2] < 0.2 * off[1]


def test_where_the_curve_stands_still_parameters_stay():
    still = BSplineCurve(clamped_knots(4, 3), np.ones((4, 2)), 3)
    case = Case(3, False, m=4, n=6)
    case.curve = still
    solved, *_, dt = kernel_step(case, 0.1)
    assert solved
    assert_array_equal(dt, 0)


def test_an_unsolvable_system_is_none():
    case = Case(3, False, m=20, n=3)
    solved, *_ = kernel_step(case, 0.0)
    assert not solved
    assert case.problem().damped_step(case.x(), 0.0) is None


def test_the_trial_parameters_are_in_data_order():
    for periodic in (False, True):
        case = Case(3, periodic, n=200, noise=4.0)
        x = case.x()
        problem = case.problem(ends="free" if periodic else "fixed")
        for damping in (1e-4, 1e-2, 1):
            trial = problem.damped_step(x, damping)
            u = problem.unpack(trial.x)[1]
            assert (np.diff(u) >= 0).all()
            if periodic:
                assert u[-1] <= u[0] + 1
            else:
                assert (u[0], u[-1]) == (case.parameters[0], case.parameters[-1])


# --- stray residuals ---------------------------------------------------------------------------


def test_no_stray_weight_is_the_plain_problem():
    case = Case(3, True)
    plain, zero = case.problem(), case.problem(stray_weight=0.0)
    x = case.x()
    assert plain.cost(x) == zero.cost(x)
    assert_array_equal(plain.damped_step(x, 0.1).x, zero.damped_step(x, 0.1).x)


@pytest.mark.slow
@pytest.mark.parametrize("degree", [1, 2, 3, 5])
@closures
@pytest.mark.parametrize("n", [5, 12, 40])
def test_stray_residuals_are_their_definition(degree, periodic, n):
    case = Case(degree, periodic, n=n, multiple=False)
    problem, x = case.problem(stray_weight=0.3), case.x()
    dense = case.dense(stray_weight=0.3)
    assert len(dense.residuals) > n
    w, r = dense.weights[:, None], np.abs(dense.residuals)
    off = float((w * r * case.off(dense, 0)).sum()) + (len(r) + 40) * EPS * dense.cost
    assert abs(problem.cost(x) - dense.cost) <= off
    assert problem.cost(x) > case.problem().cost(x)
    assert_step(case, 0.1, stray_weight=0.3)
