"""The published pipeline: its literal constants, its error, its report, and one claim about it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import BSpline
from tests.support.places import DATA
from tests.support.shapes import flower, wave

from shapespline import LITERAL, SENSIBLE, Contour, initial_curve, optimize
from shapespline.engines.least_squares import measured
from shapespline.errors import InvalidInputError
from shapespline.fitting import optimization
from shapespline.paper.run import paper_error, run_paper
from shapespline.solvers.iteration import Limits
from shapespline.solvers.quasi_newton import DirectDiagonal, InverseDiagonal

LENGTH = 4


@pytest.fixture(scope="module")
def literal(blob):
    return run_paper(blob, LENGTH, reading=LITERAL, limits=Limits(max_iterations=3))


@pytest.fixture
def asked(monkeypatch):
    """What optimize asks of the engine."""
    calls = []

    def spy(contour, start, solver, model, arguments):
        calls.append((solver, vars(arguments)))
        return measured(contour, start, solver, model, arguments)

    monkeypatch.setattr(optimization, "measured", spy)
    return calls


# The literal constants, from the paper's text and not from the code


def distances_by_definition(points, length):
    """H_r: the unsigned distances of Q_r to the lines through Q_{r-L+s} and Q_{r+s}, summed."""
    n = len(points)
    sums = np.zeros(n)
    for r in range(n):
        for s in range(1, length):
            a, b = points[(r - length + s) % n], points[(r + s) % n]
            (ux, uy), (vx, vy) = b - a, points[r] - a
            sums[r] += abs(ux * vy - uy * vx) / np.hypot(ux, uy)
    return sums


def literal_inner_points(points, length):
    """The paper's section 4 word for word: P_r = Q - (max H) H N at every local maximum."""
    n = len(points)
    raw = distances_by_definition(points, length)
    h = np.array([sum(raw[(r + i) % n] for i in range(-2, 3)) / 5 for r in range(n)])
    at = [r for r in range(1, n - 1) if h[r - 1] < h[r] > h[r + 1]]

    def unit(v):
        return v / np.hypot(*v)

    def tangent(r):
        return unit(points[(r + 1) % n] - points[(r - 1) % n])

    return np.array(
        [points[r] - h.max() * h[r] * unit(tangent(r + 1) - tangent(r - 1)) for r in at]
    )


def test_literal_control_points_are_those_of_the_text(blob, literal):
    start = literal.start
    expected = literal_inner_points(blob.points, LENGTH)
    assert len(expected) == 10
    np.testing.assert_allclose(start.control_points[1:-1], expected, rtol=1e-11)
    assert (start.control_points[0] == blob.points[0]).all()
    assert (start.control_points[-1] == blob.points[0]).all()  # Q_n of a closed shape is Q_0


def test_literal_offset_is_a_squared_length(blob):
    inner, scaled = (
        initial_curve(Contour(f * blob.points, closed=True), LENGTH, reading=LITERAL)
        for f in (1, 4)
    )
    stations = blob.points[inner.stations]
    offset = inner.control_points[1:-1] - stations
    np.testing.assert_allclose(scaled.control_points[1:-1] - 4 * stations, 16 * offset, rtol=1e-9)


def test_literal_curve_is_clamped_on_uniform_knots_with_uniform_parameters(blob, literal):
    spline, m, k = literal.start.spline, literal.start.n_control_points - 1, 4
    inside = [(j + 1) / (m - k + 2) for j in range(m - k + 1)]
    np.testing.assert_allclose(spline.knots, [*[0] * k, *inside, *[1] * k], atol=1e-15)
    assert not spline.periodic
    n1 = len(blob)
    np.testing.assert_allclose(literal.start.parameters, np.arange(n1 + 1) / n1, atol=1e-15)


def test_literal_reading_is_unsigned_with_window_5_and_no_threshold(blob, literal):
    cpda = literal.start.cpda
    assert (cpda.window, cpda.floor) == (5, 0.0)
    np.testing.assert_allclose(cpda.raw, distances_by_definition(blob.points, LENGTH), rtol=1e-11)
    assert (LITERAL.signed, LITERAL.prominence, LITERAL.offset) == (False, None, "squared")


def test_literal_solver_is_algorithm_1(blob, asked):
    run_paper(blob, LENGTH, reading=LITERAL, limits=Limits(max_iterations=1))
    [(solver, arguments)] = asked
    assert (solver.start_diagonal, solver.wolfe) == ("identity", "weak")
    model = solver.start(np.ones(5))
    assert isinstance(model, InverseDiagonal)
    assert model.secant
    assert (model.diagonal == 1.0).all()
    assert arguments["ends"] == "free"
    assert arguments["stray_weight"] == 0.0


def test_literal_first_step_is_steepest_descent(blob):
    """H_0 = I, and nothing is held: neither the end parameters nor the end control points."""
    run = run_paper(blob, LENGTH, reading=LITERAL, limits=Limits(max_iterations=1))
    start, step = run.start, run.fit.history[1].step
    spline = start.spline
    residuals = spline(start.parameters) - blob.polyline
    basis = BSpline.design_matrix(start.parameters, spline.knots, spline.degree).toarray()
    moved = run.fit.control_points - start.control_points
    gradient = basis.T @ residuals
    # The data are moved about their middle while computing: a few roundings of their size.
    np.testing.assert_allclose(moved, -step * gradient, atol=1e-13 * blob.box_diagonal)


def test_sensible_run_is_periodic_direct_strong_and_from_gauss_newton(blob, asked):
    run = run_paper(blob, LENGTH)
    [(solver, arguments)] = asked
    assert (solver.start_diagonal, solver.wolfe) == ("gauss-newton", "strong")
    assert type(solver.start(np.ones(5))) is DirectDiagonal
    assert arguments["ends"] is None
    assert arguments["stray_weight"] == 0.1
    assert run.fit.spline.periodic
    assert run.fit.method == "d-bfgs"
    assert run.reading == SENSIBLE


@pytest.mark.parametrize("reading", [LITERAL, SENSIBLE])
def test_other_methods_and_open_data(reading):
    run = run_paper(wave(), 6, reading=reading, method="levenberg-marquardt")
    assert run.fit.method == "levenberg-marquardt"
    assert not run.fit.spline.periodic
    assert run.final_error < run.start_error


# The error and the number of control points


def test_error_divides_the_sum_over_all_points_by_n1(blob, literal):
    start, n1 = literal.start, len(blob)
    curve = start.curve
    squares = [
        float(np.sum((curve(start.parameters[j]) - blob.points[j % n1]) ** 2))
        for j in range(n1 + 1)
    ]
    assert literal.start_error == pytest.approx((sum(squares) / n1) ** 0.5, rel=1e-12)
    assert literal.start_error == pytest.approx(literal.fit.history[0].paper_error, rel=1e-9)
    assert literal.final_error == literal.fit.history[-1].paper_error
    assert paper_error(blob, start.spline, start.parameters) == literal.start_error


def test_sensible_gaps_are_halved_until_none_is_wider_than_half_the_mean_was(blob):
    maxima, filled = (
        initial_curve(blob, LENGTH, reading=replace(SENSIBLE, start=f"cpda-{stations}"))
        for stations in ("maxima", "halved")
    )

    def gaps(start):
        return np.diff([*start.stations, start.stations[0] + len(start.samples)])

    assert set(maxima.stations) <= set(filled.stations)
    assert len(filled.stations) > len(maxima.stations)
    # Whole points: halving an odd gap leaves one point more on one side.
    assert gaps(filled).max() <= np.ceil(0.5 * gaps(maxima).mean())
    assert initial_curve(blob, LENGTH).n_control_points == len(filled.stations)


def test_sensible_even_gaps_are_halved_once():
    assert run_paper(flower(), 8).start.n_control_points == 20


@pytest.mark.slow
@pytest.mark.parametrize("n", [9, 40, 41])
def test_number_of_control_points_is_the_one_asked_for(blob, n):
    assert run_paper(blob, LENGTH, n_control_points=n).fit.n_control_points == n


@pytest.mark.slow
def test_similar_outlines_have_the_same_sensible_run(blob):
    once, twice = (run_paper(Contour(f * blob.points, closed=True), LENGTH) for f in (1, 8))
    assert twice.start_error == 8 * once.start_error
    assert twice.final_error == pytest.approx(8 * once.final_error, rel=1e-12)


@pytest.mark.parametrize("arguments", [{"method": "newton"}, {"degree": 0}])
def test_bad_arguments_raise(blob, arguments):
    with pytest.raises(InvalidInputError):
        run_paper(blob, LENGTH, **arguments)
    with pytest.raises(InvalidInputError):
        run_paper(blob, 1)


# The report


# The claim of this project


@pytest.mark.slow
@pytest.mark.parametrize("counted", [False, True], ids=["default", "number of the literal start"])
def test_direct_d_bfgs_needs_less_than_a_tenth_of_the_literal_evaluations(counted):
    """From the sensible start to the error that the literal run ends at."""
    if not (DATA / "paper").exists():
        pytest.skip("the outlines of the published examples are not there")
    contour = Contour(np.loadtxt(DATA / "paper" / "leaf840.csv", delimiter=","), closed=True)
    literal = run_paper(contour, 2, reading=LITERAL)
    # Not the evaluations until it stops: those to within 1 % of where it does.
    near = next(r for r in literal.fit.history if r.paper_error <= 1.01 * literal.final_error)
    start = run_paper(
        contour, 2, n_control_points=literal.fit.n_control_points if counted else None
    ).start
    target = 0.5 * literal.final_error**2 * (len(contour) - 1)
    fit = optimize(contour, start, stray_weight=0.0, limits=Limits(target_cost=target))
    assert fit.history[-1].paper_error <= literal.final_error
    assert fit.history[-1].evaluations < 0.1 * near.evaluations


# One reading, one curve: API, run and command agree to the bit


OWN = replace(LITERAL, window=7, prominence=0.05, start="cpda-halved", max_evaluations=300)


@pytest.mark.slow
@pytest.mark.parametrize("reading", [SENSIBLE, replace(LITERAL, max_evaluations=300), OWN])
@pytest.mark.parametrize("method", [None, "levenberg-marquardt", "l-bfgs"])
def test_initial_curve_and_optimize_are_the_run(blob, reading, method):
    run = run_paper(blob, LENGTH, reading=reading, method=method)
    start = initial_curve(blob, LENGTH, reading=reading)
    fit = optimize(blob, start) if method is None else optimize(blob, start, method)
    assert run.start.control_points.tobytes() == start.control_points.tobytes()
    assert run.start.parameters.tobytes() == start.parameters.tobytes()
    assert run.fit.control_points.tobytes() == fit.control_points.tobytes()
    assert run.fit.knots.tobytes() == fit.knots.tobytes()
    assert run.fit.method == fit.method == (method or reading.method)


def test_a_literal_closed_curve_comes_back_to_where_it_began(blob):
    start = initial_curve(blob, LENGTH, reading=LITERAL)
    assert (start.control_points[[0, -1]] == blob.points[0]).all()
    assert len(start.parameters) == len(blob) + 1
    opened = initial_curve(blob, LENGTH, reading=replace(LITERAL, closing_point=False))
    assert (opened.control_points[-1] == blob.points[-1]).all()
    assert len(opened.parameters) == len(blob)


def test_weights_of_a_literal_start_count_the_first_point_twice(blob):
    start = initial_curve(blob, LENGTH, reading=LITERAL)
    limits = Limits(max_iterations=3)
    weights = 1.0 + np.arange(len(blob)) / len(blob)
    fit = optimize(blob, start, weights=weights, limits=limits)
    residuals = start.spline(start.parameters) - blob.polyline
    cost = 0.5 * float(np.append(weights, weights[0]) @ (residuals**2).sum(axis=1))
    assert fit.history[0].cost == pytest.approx(cost, rel=1e-12)


@pytest.mark.parametrize("n", [2, 98, 10.5, "ten"])
def test_numbers_of_control_points_that_no_curve_has(blob, n):
    with pytest.raises(InvalidInputError, match="n_control_points must be from degree"):
        initial_curve(blob, LENGTH, n_control_points=n)
