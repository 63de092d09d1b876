"""PDM, TDM, SDM and held parameters: minima, honesty, and what each metric stands for."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.interpolate import make_lsq_spline
from tests.support.make_fit import wave
from tests.support.shapes import flower
from tests.support.solver_problems import EPS, PROBLEMS, IllScaledQuadratic

from shapespline import Contour, fit_curve
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.geometry.nearest import nearest
from shapespline.solvers.alternation import Alternation
from shapespline.solvers.fixed_parameters import FixedParameters
from shapespline.solvers.iteration import Limits, Stop, minimize
from shapespline.solvers.levenberg_marquardt import Proposal
from shapespline.values.curve import BSplineCurve
from shapespline.values.knots import periodic_knots

METRICS = ("point", "tangent", "squared")
every_problem = pytest.mark.parametrize("make", PROBLEMS, ids=lambda p: p.name)
every_metric = pytest.mark.parametrize("metric", METRICS)
TIGHT = Limits(relative_decrease=1e-15, gradient_tolerance=1e-9)


def circle_problem(radius=2.0, n_points=90, n_control_points=12, away=0.3):
    """Data on a circle around a periodic cubic that is nearly one."""
    angle = 2 * np.pi * np.arange(n_control_points) / n_control_points
    ring = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    curve = BSplineCurve(periodic_knots(n_control_points, 3), ring, 3, periodic=True)
    at = 2 * np.pi * np.arange(n_points) / n_points
    points = (radius + away) * np.column_stack([np.cos(at), np.sin(at)])
    problem = CurveProblem(points, curve)
    x = problem.projected(problem.pack(ring, nearest(curve, points).parameters))
    return problem, x


@every_problem
@every_metric
def test_finds_every_minimum(make, metric):
    problem = make()
    result = minimize(Alternation(metric), problem, problem.start, limits=TIGHT)
    assert result.stop.converged or result.stop is Stop.NO_DECREASE
    # As for Levenberg-Marquardt: quadratic in the gradient, or the rounding of what is left.
    excess = 1e-14 * result.history[0].cost + 100 * EPS * problem.minimum
    assert result.cost - problem.minimum <= excess


@every_problem
@every_metric
def test_history_is_honest(make, metric):
    problem = make()
    result = minimize(Alternation(metric), problem, problem.start)
    assert all(b.cost <= a.cost for a, b in pairwise(result.history))
    assert result.history[-1].cost == result.cost == problem.cost(result.x)


@every_problem
def test_held_parameters_never_raise_the_cost(make):
    problem = make()
    result = minimize(FixedParameters(), problem, problem.start)
    assert all(b.cost <= a.cost for a, b in pairwise(result.history))


def test_held_parameters_solve_a_linear_problem_in_one_step():
    problem = IllScaledQuadratic()
    result = minimize(FixedParameters(), problem, problem.start)
    # The one damping, 1e-12, leaves that part of the start.
    assert result.cost <= 1e-20 * result.history[0].cost
    assert result.stop.converged


class Stubborn:
    """Falls only once the damping is large; counts what was asked."""

    def __init__(self, needed):
        self.needed, self.dampings = needed, []

    def cost(self, x):
        return float(x[0])

    def projected(self, x):
        return x

    def metric_step(self, x, metric, damping):
        self.dampings.append(damping)
        if damping == 0.0:
            return None
        return Proposal(x + (-1.0 if damping >= self.needed else 1.0), 1.0, 1.0)


def test_rejected_steps_raise_the_damping_and_accepted_ones_lower_it():
    problem = Stubborn(1e-2)
    solver = Alternation("point")
    state = solver.step(problem, solver.init(problem, np.array([5.0])), 100)
    assert state.cost == 4.0
    assert problem.dampings[1:] == pytest.approx([0.0, 1e-4, 1e-3, 1e-2])
    assert state.step == pytest.approx(1e-2)
    assert state.damping == pytest.approx(1e-3)


def test_gives_up_when_the_damping_explodes_or_the_budget_ends():
    solver = Alternation("point")
    for most, expected in ((1000, True), (3, True)):
        problem = Stubborn(1e99)
        state = solver.step(problem, solver.init(problem, np.array([5.0])), most)
        assert state.stalled is expected
        assert state.cost == 5.0
        assert state.evaluations <= 1 + most


# --- on curves ---------------------------------------------------------------------------------


def test_a_projection_shortens_every_residual():
    curve = wave()
    rng = np.random.default_rng(3)
    u = np.sort(rng.uniform(0, 1, 60))
    points = curve(u) + rng.normal(0, 0.3, (60, 2))
    problem = CurveProblem(points, curve, ends="free")
    x = problem.pack(curve.control_points, np.clip(u + rng.normal(0, 0.01, 60), 0, 1))
    before = ((curve(problem.unpack(x)[1]) - points) ** 2).sum(axis=1)
    t = problem.unpack(problem.projected(x))[1]
    after = ((curve(t) - points) ** 2).sum(axis=1)
    assert (after <= before).all()
    assert ((t >= 0) & (t <= 1)).all()
    assert (after >= nearest(curve, points).distances_sq - 1e-12).all()


def test_ends_that_are_held_stay():
    curve = wave()
    points = curve(np.linspace(0.1, 0.9, 30))
    problem = CurveProblem(points, curve, ends="fitted")
    x = problem.pack(curve.control_points, np.linspace(0, 1, 30))
    t = problem.unpack(problem.projected(x))[1]
    assert (t[0], t[-1]) == (0.0, 1.0)


@pytest.mark.parametrize(("away", "expected"), [(0.3, 0.3 / (0.3 + 2.0)), (-0.3, 0.0)])
def test_the_squared_distance_counts_the_tangent_on_the_outer_side(away, expected):
    problem, x = circle_problem(away=away)
    along = problem._along(x, "squared")
    # The cubic lies up to k h^2 / 6 inside its control points, and its curvature varies as much.
    h = 2 * np.pi / 12
    if expected == 0.0:
        assert (along == 0.0).all()
    else:
        assert along == pytest.approx(expected, abs=h**2)


def test_the_squared_distance_form_is_that_of_the_distance_itself():
    # Moving the whole curve by v changes d^2 of a datum outside it to second order as the form
    # says: (r . N)^2 + d / (d + rho) (r . T)^2, here against distances found anew.
    problem, x = circle_problem(away=0.5, n_control_points=24)
    control_points, t = problem.unpack(x)
    curve = problem.curve(x)
    j, small = 7, 1e-3
    tangent = curve(t[j : j + 1], derivative=1)[0]
    tangent /= np.hypot(*tangent)
    part = problem._along(x, "squared")[j]
    moved = BSplineCurve(curve.knots, control_points + small * tangent, 3, periodic=True)
    datum = problem.points[j : j + 1]
    gained = nearest(moved, datum).distances_sq[0] - nearest(curve, datum).distances_sq[0]
    # Third-order terms are of the size of small^3 over the radius.
    assert gained == pytest.approx(part * small**2, abs=small**3)


@every_metric
def test_other_metrics_are_all_or_nothing(metric):
    problem, x = circle_problem()
    along = problem._along(x, metric)
    assert ((along >= 0.0) & (along <= 1.0)).all()
    if metric != "squared":
        assert (along == (metric == "point")).all()


@every_metric
def test_each_metric_finds_the_circle(metric):
    problem, x = circle_problem()
    result = minimize(Alternation(metric), problem, x, limits=Limits(max_iterations=60))
    assert result.cost < 1e-3 * problem.cost(x)


def test_held_parameters_are_the_linear_fit_of_scipy():
    curve = wave()
    u = np.linspace(0, 1, 80)
    points = curve(u) + np.random.default_rng(4).normal(0, 0.2, (80, 2))
    problem = CurveProblem(points, curve)
    result = minimize(FixedParameters(), problem, problem.pack(curve.control_points, u))
    expected = make_lsq_spline(u, points, curve.knots, k=3).c
    # Damping and the rounding of normal equations of condition below 1e6.
    assert problem.unpack(result.x)[0] == pytest.approx(expected, abs=1e-8)


# --- knots for comparison ----------------------------------------------------------------------


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("knots", ["balanced", "dominant", "uniform"])
@pytest.mark.parametrize("method", ["levenberg-marquardt", "sdm", "fixed-parameters"])
def test_every_knot_choice_makes_the_count_asked_for(closed, knots, method):
    contour = flower(240) if closed else Contour(flower(240).points[:200], closed=False)
    fit = fit_curve(contour, n_control_points=17, knots=knots, method=method)
    assert fit.n_control_points == 17
    assert fit.closed == closed
    assert fit.rms_distance < 0.05 * contour.box_diagonal


def test_dominant_knots_are_dense_where_the_outline_bends():
    contour = Contour([(0, 0), (10, 0), (10, 10), (0, 10)], closed=True).resampled(400)
    spline = fit_curve(
        contour, n_control_points=24, knots="dominant", method="fixed-parameters"
    ).spline
    gaps = np.diff(spline.breakpoints)
    middles = spline(spline.breakpoints[:-1] + 0.5 * gaps)
    to_corner = np.abs(np.abs(middles - 5.0) - 5.0).max(axis=1)
    near, far = gaps[to_corner < 1.0], gaps[to_corner > 2.5]
    assert near.mean() < 0.5 * far.mean()


def test_dominant_knots_do_better_than_uniform_ones_with_held_parameters(outline):
    for name, count in (("hand620_closed", 36), ("leaf840_closed", 70), ("loop500_open", 24)):
        dominant, uniform = (
            fit_curve(outline(name), n_control_points=count, knots=k, method="fixed-parameters")
            for k in ("dominant", "uniform")
        )
        assert dominant.rms_distance < uniform.rms_distance
