"""The family of methods by name: each step against a dense, literal one."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import BSpline, make_lsq_spline
from tests.support import reference
from tests.support.places import DATA
from tests.support.shapes import Case, closures, flower, plain_start, wave

from shapespline import Contour, initial_curve, optimize, read
from shapespline.engines.least_squares import METHODS, named_solver
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.errors import InvalidInputError
from shapespline.solvers import (
    Alternation,
    GaussNewton,
    Limits,
    Prepared,
    VariableProjection,
    make_solver,
    minimize,
)

EPS = reference.EPS
# The kernel damps control points by 1e-12 of their diagonal, so that bare ones have a solution.
BARE = 1e-12
dampings = pytest.mark.parametrize("damping", [0.0, 1e-3, 1.0, 50.0])
some_degrees = pytest.mark.parametrize("degree", [1, 2, 3, 5])


def well_posed(degree, periodic):
    """Data all along a curve on simple knots, with weights."""
    return Case(degree, periodic, n=90, noise=0.2, multiple=False, seed=3)


def joint_reference(case, damping):
    """dP and dt that minimise the linearised residuals, parameters damped; and a condition."""
    jacobian = np.asarray(case.dense().jacobian(), dtype=float)
    root = np.sqrt(case.weights)[:, None]
    residuals = (root * (case.curve(case.parameters) - case.points)).ravel()
    lengths = np.linalg.norm(jacobian[:, 2 * case.m :], axis=0)
    rows = np.zeros((case.n, jacobian.shape[1]))
    rows[np.arange(case.n), 2 * case.m + np.arange(case.n)] = np.sqrt(damping) * lengths
    stacked = np.vstack([jacobian, rows])
    scale = np.linalg.norm(stacked, axis=0)
    scale[scale == 0.0] = 1.0
    step = np.linalg.lstsq(
        stacked / scale, -np.concatenate([residuals, np.zeros(case.n)]), rcond=None
    )[0]
    return step / scale, scale, np.linalg.cond(stacked / scale) ** 2


@pytest.mark.slow
@closures
@some_degrees
@dampings
def test_the_joint_step_solves_the_dense_linearised_problem(degree, periodic, damping):
    case = well_posed(degree, periodic)
    x = case.x()
    found = case.problem().joint_step(x, damping).x - x
    expected, scale, condition = joint_reference(case, damping)
    # Normal equations of the scaled columns: rounding and the damping of bare points, times their
    # condition (Higham 2002, section 10.1).
    bound = condition * (BARE + case.n * EPS) * np.linalg.norm(scale * expected)
    assert np.linalg.norm(scale * (found - expected)) <= bound


@pytest.mark.slow
@closures
@pytest.mark.parametrize(
    ("degree", "damping"),
    # Without damping the step of a polyline is not unique: its points may slide along the lines.
    [(d, damping) for d in (1, 2, 3, 5) for damping in (0.0, 1e-3, 1.0, 50.0) if d > 1 or damping],
)
def test_the_step_of_variable_projection_is_kaufmans(degree, periodic, damping):
    """dt = -(J'J + lambda diag D'D)^-1 J'r with J = (I - Phi Phi^+) D, control points at best."""
    case = well_posed(degree, periodic)
    problem = case.problem()
    x = problem.solved(case.x())
    case.curve = problem.curve(x)
    jacobian = np.asarray(case.dense().jacobian(), dtype=float)
    phi, moves = jacobian[:, : 2 * case.m], jacobian[:, 2 * case.m :]
    root = np.sqrt(case.weights)[:, None]
    residuals = (root * (case.curve(case.parameters) - case.points)).ravel()
    left, singular, _ = np.linalg.svd(phi, full_matrices=False)
    projected = moves - left @ (left.T @ moves)
    lengths = np.linalg.norm(moves, axis=0)
    normal = (projected / lengths).T @ (projected / lengths) + damping * np.eye(case.n)
    expected = -np.linalg.solve(normal, (projected / lengths).T @ residuals) / lengths
    found = problem.unpack(problem.joint_step(x, damping).x - x)[1]
    condition = np.linalg.cond(normal) * (singular[0] / singular[-1]) ** 2
    bound = condition * (BARE + case.n * EPS) * np.linalg.norm(lengths * expected)
    assert np.linalg.norm(lengths * (found - expected)) <= bound


@closures
def test_variable_projection_keeps_control_points_at_their_best(periodic):
    contour = Contour(flower(160).points, periodic)
    start = plain_start(contour, 5)
    problem = CurveProblem(contour.points, start.spline)
    x = problem.pack(start.spline.control_points, start.parameters)
    result = minimize(VariableProjection(), problem, x, limits=Limits(max_iterations=6))
    control_points, parameters = problem.unpack(result.x)
    rows = reference.folded(
        reference.basis_matrix(start.spline.knots, 3, parameters, periodic), len(control_points)
    )
    rows = np.asarray(rows, dtype=float)
    expected = np.linalg.lstsq(rows, contour.points, rcond=None)[0]
    condition = np.linalg.cond(rows) ** 2
    bound = condition * (BARE + len(contour) * EPS) * np.linalg.norm(expected)
    assert np.linalg.norm(control_points - expected) <= bound
    assert (
        result.cost
        < minimize(make_solver("d-bfgs"), problem, x, limits=Limits(max_iterations=6)).cost
    )


def test_gauss_newton_takes_the_longest_halved_step_that_armijo_allows():
    case = well_posed(3, False)
    problem, x = case.problem(), case.x()
    for _ in range(4):
        state = GaussNewton().init(problem, x)
        direction = problem.joint_step(x, 0.0).x - x
        cost, gradient = problem.cost_and_gradient(x)
        slope = float(gradient @ direction)
        lengths = [0.5**k for k in range(31)]
        expected = next(
            a
            for a in lengths
            if problem.cost(x + a * direction) < cost
            and problem.cost(x + a * direction) <= cost + 1e-4 * a * min(slope, 0.0)
        )
        following = GaussNewton().step(problem, state, 100)
        assert following.step == expected
        np.testing.assert_array_equal(following.x, x + expected * direction)
        x = following.x


def test_l_bfgs_from_the_feet_is_l_bfgs_from_the_feet():
    contour = flower(160)
    start = plain_start(contour, 5)
    problem = CurveProblem(contour.points, start.spline)
    x = problem.pack(start.spline.control_points, start.parameters)
    feet = problem.projected(x)
    dense = start.spline(np.linspace(0, 1, 20_001))
    nearest = np.sqrt(((contour.points[:, None] - dense[None]) ** 2).sum(axis=2).min(axis=1))
    curve, parameters = problem.curve(feet), problem.unpack(feet)[1]
    off = np.hypot(*(curve(parameters) - contour.points).T)
    # A sample every 1/20000 of 64 units of length is 0.0032 / 2 away at most.
    assert (off <= nearest + 100 * EPS).all()
    assert (nearest - off <= 0.002).all()
    limits = Limits(max_iterations=20)
    solver, name = named_solver("l-bfgs-feet")
    assert isinstance(solver, Prepared)
    assert name == "l-bfgs-feet"
    found = minimize(solver, problem, x, limits=limits)
    expected = minimize(make_solver("l-bfgs"), problem, feet, limits=limits)
    np.testing.assert_array_equal(found.x, expected.x)


def test_feet_on_a_curve_that_crosses_itself_stay_with_their_neighbours():
    contour = read(DATA / "outlines" / "loop500_open.csv", closed=False).longest
    start = initial_curve(contour, 12, n_control_points=9)
    problem = CurveProblem(contour.points, start.spline, ends="fixed", stray_weight=0.1)
    x = problem.pack(start.spline.control_points, start.parameters)
    # The nearest feet of some points lie on the other branch: neighbours drift apart.
    assert problem.cost(problem._at_nearest_feet(x)) > problem.cost(x)
    assert problem.cost(problem.projected(x)) < problem.cost(x)
    # Where nothing between the points counts, the nearest feet are the projection.
    alone = CurveProblem(contour.points, start.spline, ends="fixed")
    np.testing.assert_array_equal(alone.projected(x), alone._at_nearest_feet(x))
    # Every metric ends where Levenberg-Marquardt ends, up to the last decrease that counts; the
    # point distance converges linearly and is given ten times the steps.
    limits = Limits(max_iterations=1000, max_evaluations=5000, relative_decrease=1e-9)
    joint = optimize(contour, start, "levenberg-marquardt", limits=limits)
    for method in ("pdm", "tdm", "sdm"):
        fit = optimize(contour, start, method, limits=limits)
        assert fit.history[-1].cost == pytest.approx(joint.history[-1].cost, rel=1e-6)


def test_linear_d_bfgs_starts_from_the_linear_fit():
    contour = wave()
    start = plain_start(contour, 8)
    fit = optimize(contour, start, "linear-d-bfgs", ends="free", limits=Limits(max_iterations=0))
    parameters, knots = start.parameters, start.spline.knots
    expected = make_lsq_spline(parameters, contour.points, knots, k=3).c
    rows = BSpline.design_matrix(parameters, knots, 3).toarray()
    bound = np.linalg.cond(rows) ** 2 * (BARE + 200 * EPS) * np.linalg.norm(expected)
    assert np.linalg.norm(fit.control_points - expected) <= bound


@pytest.mark.slow
@pytest.mark.parametrize("metric", ["point", "tangent", "squared"])
def test_feet_of_the_alternating_methods_are_feet_on_the_whole_curve(metric):
    """Every fourth point of the palm: local Newton steps left 24 of 155 on a wrong branch."""
    palm = read(DATA / "paper" / "palm620.csv", closed=True).longest
    contour = Contour(palm.points[::4], closed=True)
    start = initial_curve(contour, 4)
    problem = CurveProblem(contour.points, start.spline, stray_weight=0.1)
    x = problem.pack(start.control_points, start.parameters)
    result = minimize(Alternation(metric), problem, x, limits=Limits(max_iterations=30))
    curve, parameters = problem.curve(result.x), problem.unpack(result.x)[1]
    dense = curve(np.linspace(0, 1, 20_001))
    nearest = np.sqrt(((contour.points[:, None] - dense[None]) ** 2).sum(axis=2).min(axis=1))
    off = np.hypot(*(curve(parameters) - contour.points).T)
    assert (off <= nearest + 100 * EPS * contour.box_diagonal).all()


def test_unknown_methods_name_those_that_exist():
    for method in ("newton", None, 3):
        with pytest.raises(
            InvalidInputError, match="method must be one of levenberg-marquardt"
        ) as e:
            named_solver(method)
        assert all(name in str(e.value) for name in METHODS)


def test_every_name_makes_a_solver():
    for name in METHODS:
        solver, found = named_solver(name)
        assert found == name
        assert named_solver(solver) == (solver, type(solver).__name__)
