"""Cost, gradient and scale of the least-squares problem, against dense matrices and difference
quotients from the definitions; what it costs to stray; packing, and bad ends.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support import reference
from tests.support.shapes import Case, closures, degrees

from shapespline.engines.least_squares.problem import DIAGONAL_FLOOR, CurveProblem
from shapespline.errors import InvalidInputError
from shapespline.values.curve import BSplineCurve
from shapespline.values.knots import clamped_knots, periodic_knots

EPS = reference.EPS


# --- cost and gradient -------------------------------------------------------------------------


@degrees
@closures
@pytest.mark.parametrize("weighted", [False, True])
def test_cost_and_gradient_are_those_of_the_definition(degree, periodic, weighted):
    case = Case(degree, periodic)
    dense, problem, x = case.dense(weighted), case.problem(weighted), case.x()
    cost, gradient = problem.cost_and_gradient(x)
    of_points, of_parameters = problem.unpack(gradient)
    w, r = dense.weights[:, None], np.abs(dense.residuals)
    dr, dt = case.off(dense, 0), case.off(dense, 1)
    rounded = (case.n + 8) * EPS  # n sums and a few products
    # |d(w r^2 / 2)| = w r dr.
    assert abs(cost - dense.cost) <= float((w * r * dr).sum() + rounded * dense.cost)
    assert abs(problem.cost(x) - cost) <= rounded * cost
    exact_points, exact_parameters = dense.gradient()
    off = dense.basis.T @ (w * (dr + (6 * degree * EPS + rounded) * r))
    assert (np.abs(of_points - exact_points) <= off).all()
    t = np.abs(dense.tangents)
    off = (w * (dr * t + r * dt + 8 * EPS * r * t)).sum(axis=1)
    assert (np.abs(of_parameters - exact_parameters) <= off).all()


@pytest.mark.parametrize("degree", [1, 2, 3, 5, 9])
@closures
@pytest.mark.slow
def test_the_gradient_is_the_difference_quotient_of_the_cost(degree, periodic):
    case = Case(degree, periodic, n=12, multiple=False)
    problem, x = case.problem(), case.x()
    cost, gradient = problem.cost_and_gradient(x)

    # In extended precision, for one coordinate at a time; steps far inside the spans.
    def exact_cost(z):
        points, parameters = z[: 2 * case.m].reshape(-1, 2), z[2 * case.m :]
        r = (
            reference.evaluated(case.curve.knots, points, degree, parameters, periodic)
            - case.points
        )
        return 0.5 * (case.weights[:, None] * r**2).sum()

    gap = np.abs(case.parameters[:, None] - case.curve.knots).min()
    step = min(1e-4, gap / 2)
    coarse = reference.central_difference(exact_cost, x, step)
    fine = reference.central_difference(exact_cost, x, step / 2)
    # The error of central differences falls by 4 with half the step: that of the finer is a third
    # of the change. Rounding: of the cost in extended precision over the step, and of the kernel.
    rounding = 200 * float(np.finfo(np.longdouble).eps) * cost / step
    kernel = 500 * degree * EPS * np.abs(gradient).max()
    assert (np.abs(gradient - fine) <= np.abs(coarse - fine) + rounding + kernel).all()


@pytest.mark.parametrize("ends", ["fixed", "fitted", "free"])
def test_what_is_held_has_no_gradient(ends):
    case = Case(3, False)
    free = case.problem().cost_and_gradient(case.x())[1]
    problem = case.problem(ends=ends)
    of_points, of_parameters = problem.unpack(problem.cost_and_gradient(case.x())[1])
    free_points, free_parameters = problem.unpack(free.copy())
    if ends == "fixed":
        free_points[[0, -1]] = 0
    if ends != "free":
        free_parameters[[0, -1]] = 0
    assert_array_equal(of_points, free_points)
    assert_array_equal(of_parameters, free_parameters)


@pytest.mark.slow
@degrees
@closures
@pytest.mark.parametrize("more", [1, 2, 6])
def test_the_scale_is_the_diagonal_of_the_gauss_newton_matrix(degree, periodic, more):
    case = Case(degree, periodic, m=degree + more)
    dense = case.dense()
    found = case.problem().scale(case.x())
    exact = (dense.jacobian() ** 2).sum(axis=0)
    off = (12 * degree + case.n + 4) * EPS * exact
    w = dense.weights[:, None]
    t, dt = np.abs(dense.tangents), case.off(dense, 1)
    off[2 * case.m :] += (2 * w * t * dt + w * dt**2).sum(axis=1)
    for block in (slice(0, 2 * case.m), slice(2 * case.m, None)):
        floored = np.maximum(exact[block], DIAGONAL_FLOOR * exact[block].max())
        assert (np.abs(found[block] - floored) <= off[block] + 1e-24 * floored.max()).all()


def test_the_scale_is_floored_where_there_are_no_data():
    knots = clamped_knots(12, 3)
    curve = BSplineCurve(knots, np.random.default_rng(0).uniform(0, 1, (12, 2)), 3)
    u = np.linspace(0, 0.2, 20)
    problem = CurveProblem(curve(u), curve)
    found = problem.scale(problem.pack(curve.control_points, u))
    of_points = found[:24:2]
    assert of_points[-1] == DIAGONAL_FLOOR * of_points.max()
    still = BSplineCurve([0, 0, 1, 1], [(1, 1), (1, 1)], 1)
    problem = CurveProblem(np.array([[0.0, 0], [1, 0], [2, 1]]), still)
    x = problem.pack(still.control_points, np.array([0, 0.5, 1]))
    assert problem.scale(x)[4:].tolist() == [1, 1, 1]


def test_long_data_are_summed_in_chunks_to_the_same_value():
    case = Case(3, True, n=5000)
    dense = case.dense(weighted=False)
    w, r = dense.weights[:, None], np.abs(dense.residuals)
    off = float((w * r * case.off(dense, 0)).sum()) + (1024 + 5 + 8) * EPS * dense.cost
    assert abs(case.problem(weighted=False).cost(case.x()) - dense.cost) <= off


# --- stray residuals ---------------------------------------------------------------------------


def test_dense_data_have_no_stray_residuals():
    knots = periodic_knots(8, 3)
    curve = BSplineCurve(knots, np.random.default_rng(0).uniform(-5, 5, (8, 2)), 3, periodic=True)
    u = np.arange(80) / 80  # a tenth of a span apart
    points = curve(u) + 0.3
    x = np.concatenate([curve.control_points.ravel(), u])
    plain, held = CurveProblem(points, curve), CurveProblem(points, curve, stray_weight=1.0)
    assert plain.cost(x) == held.cost(x)
    sparse = np.arange(40) / 40  # a fifth
    x = np.concatenate([curve.control_points.ravel(), sparse])
    points = curve(sparse) + 0.3
    plain, held = CurveProblem(points, curve), CurveProblem(points, curve, stray_weight=1.0)
    assert held.cost(x) > plain.cost(x)


@closures
def test_parameters_that_were_thrown_about_get_few_stray_samples(periodic):
    """A line search tries them, and refuses them; every gap wants as many as the whole domain."""
    case = Case(3, periodic, n=90, multiple=False)
    knots, parameters = case.curve.knots, case.parameters.copy()
    parameters[::2] += 1000 * (knots[-4] - knots[3])
    strays = reference.stray_residuals(knots, 3, case.points, parameters, 0.3, periodic)
    assert len(strays) <= 8 * 9 * (len(np.unique(knots[3:-3])) - 1)
    problem = CurveProblem(case.points, case.curve, stray_weight=0.3)
    plain = CurveProblem(case.points, case.curve)
    x = plain.pack(case.curve.control_points, parameters)
    off = case.curve(np.array([s.parameter for s in strays])) - [s.target for s in strays]
    expected = 0.5 * (np.array([s.weight for s in strays]) * (off**2).sum(axis=1)).sum()
    # A parameter 1000 domains away keeps three digits less.
    assert problem.cost(x) - plain.cost(x) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
@closures
@pytest.mark.parametrize("held", [False, True])
@pytest.mark.slow
def test_the_gradient_of_the_stray_residuals_is_their_difference_quotient(degree, periodic, held):
    case = Case(degree, periodic, n=9, multiple=False)
    ends = "fixed" if held and not periodic else "free"
    problem, x = case.problem(stray_weight=0.3, ends=ends), case.x()
    cost, gradient = problem.cost_and_gradient(x)
    assert abs(cost - problem.cost(x)) <= 200 * EPS * cost
    knots, weights = case.curve.knots, case.weights[:, None]

    def exact_cost(z):
        points, parameters = z[: 2 * case.m].reshape(-1, 2), z[2 * case.m :]
        strays = reference.stray_residuals(
            knots, degree, case.points, parameters, np.longdouble(0.3), periodic
        )
        u = np.array([*parameters, *(s.parameter for s in strays)])
        targets = np.array([*case.points, *(s.target for s in strays)])
        w = np.array([*weights[:, 0], *(s.weight for s in strays)])
        r = reference.evaluated(knots, points, degree, u, periodic) - targets
        return 0.5 * (w[:, None] * r**2).sum()

    # One sample may lie near a knot; there the difference quotient of a curve of degree 1 is off
    # by the step over its distance: both steps see it alike, or the finer one sees less.
    coarse = reference.central_difference(exact_cost, x, 1e-6)
    fine = reference.central_difference(exact_cost, x, 5e-7)
    rounding = 500 * float(np.finfo(np.longdouble).eps) * cost / 5e-7
    kernel = 2000 * degree * EPS * np.abs(fine).max()
    if ends == "fixed":
        moves = np.ones(len(x), dtype=bool)
        moves[[0, 1, 2 * case.m - 2, 2 * case.m - 1, 2 * case.m, -1]] = False
        assert_array_equal(gradient[~moves], 0)
    else:
        moves = slice(None)
    off = np.abs(gradient - fine)[moves]
    assert (off <= (np.abs(coarse - fine) + rounding + kernel)[moves]).all()


# --- the problem as a value --------------------------------------------------------------------


def test_pack_and_unpack():
    case = Case(2, False)
    problem, x = case.problem(), case.x()
    points, parameters = problem.unpack(x)
    assert_array_equal(points, case.curve.control_points)
    assert_array_equal(parameters, case.parameters)
    assert_array_equal(problem.pack(points, parameters), x)
    assert_array_equal(problem.curve(x).control_points, points)
    assert_array_equal(problem.curve(x).knots, case.curve.knots)


def test_bad_ends():
    case = Case(3, False)
    with pytest.raises(InvalidInputError, match="ends must be one of fixed, fitted, free, "):
        case.problem(ends="loose")
    with pytest.raises(InvalidInputError, match="ends must be 'free' for a periodic curve"):
        Case(3, True).problem(ends="fitted")
