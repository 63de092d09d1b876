"""The published pipeline: its literal constants, its error, its report, and one claim about it."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from scipy.interpolate import BSpline
from tests.support.places import DATA
from tests.support.shapes import flower, wave

from shapespline import LITERAL, SENSIBLE, Contour, initial_curve, optimize
from shapespline.errors import FormatError, InvalidInputError, ShapesplineError
from shapespline.paper import report as paper_report
from shapespline.paper import run as paper
from shapespline.paper.report import FIGURES, TABLES, check_folder, write_report
from shapespline.paper.run import paper_error, run_paper
from shapespline.solvers.iteration import Limits
from shapespline.solvers.quasi_newton import InverseDiagonal

LENGTH = 4


@pytest.fixture(scope="module")
def blob():
    """A closed outline without symmetry, with maxima of irregular heights."""
    t = 2 * np.pi * np.arange(97) / 97
    r = 10 + 2 * np.cos(5 * t) + 0.7 * np.sin(3 * t + 0.4) + 0.1 * np.sin(17 * t)
    return Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)


@pytest.fixture(scope="module")
def literal(blob):
    return run_paper(blob, LENGTH, literal=True, limits=Limits(max_iterations=3))


@pytest.fixture
def asked(monkeypatch):
    """What run_paper asks of optimize."""
    calls = []

    def spy(contour, start, method, **arguments):
        calls.append((method, arguments))
        return optimize(contour, start, method, **arguments)

    monkeypatch.setattr(paper, "optimize", spy)
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
    h = np.array([(raw[r - 1] + raw[r] + raw[(r + 1) % n]) / 3 for r in range(n)])
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
    assert len(expected) > 10
    np.testing.assert_allclose(start.control_points[1:-1], expected, rtol=1e-11)
    assert (start.control_points[0] == blob.points[0]).all()
    assert (start.control_points[-1] == blob.points[-1]).all()


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
    n1 = len(blob) - 1
    np.testing.assert_allclose(literal.start.parameters, np.arange(n1 + 1) / n1, atol=1e-15)


def test_literal_reading_is_unsigned_with_window_3_and_no_threshold(blob, literal):
    cpda = literal.start.cpda
    assert (cpda.window, cpda.floor) == (3, 0.0)
    np.testing.assert_allclose(cpda.raw, distances_by_definition(blob.points, LENGTH), rtol=1e-11)
    assert (LITERAL.signed, LITERAL.prominence, LITERAL.offset) == (False, None, "squared")


def test_literal_solver_is_algorithm_1(blob, asked):
    run_paper(blob, LENGTH, literal=True, limits=Limits(max_iterations=1))
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
    run = run_paper(blob, LENGTH, literal=True, limits=Limits(max_iterations=1))
    start, step = run.start, run.fit.history[1].step
    spline = start.spline
    residuals = spline(start.parameters) - blob.points
    basis = BSpline.design_matrix(start.parameters, spline.knots, spline.degree).toarray()
    moved = run.fit.control_points - start.control_points
    gradient = basis.T @ residuals
    # The data are moved about their middle while computing: a few roundings of their size.
    np.testing.assert_allclose(moved, -step * gradient, atol=1e-13 * blob.box_diagonal)


def test_sensible_run_is_periodic_direct_strong_and_from_gauss_newton(blob, asked):
    run = run_paper(blob, LENGTH)
    [(method, arguments)] = asked
    assert method == "d-bfgs"
    assert arguments["ends"] is None
    assert arguments["stray_weight"] == 0.1
    assert run.fit.spline.periodic
    assert run.fit.method == "d-bfgs"
    assert not run.literal


@pytest.mark.parametrize("literal", [True, False])
def test_other_methods_and_open_data(literal):
    run = run_paper(wave(), 6, literal=literal, method="levenberg-marquardt")
    assert run.fit.method == "levenberg-marquardt"
    assert not run.fit.spline.periodic
    assert run.final_error < run.start_error


# The error and the number of control points


def test_error_divides_the_sum_over_all_points_by_n1(blob, literal):
    start, n1 = literal.start, len(blob) - 1
    curve = start.curve
    squares = [
        float(np.sum((curve(start.parameters[j]) - blob.points[j]) ** 2)) for j in range(n1 + 1)
    ]
    assert literal.start_error == pytest.approx((sum(squares) / n1) ** 0.5, rel=1e-12)
    assert literal.start_error == pytest.approx(literal.fit.history[0].paper_error, rel=1e-9)
    assert literal.final_error == literal.fit.history[-1].paper_error
    assert paper_error(blob, start.spline, start.parameters) == literal.start_error


def test_sensible_gaps_are_halved_until_none_is_wider_than_half_the_mean_was(blob):
    maxima = run_paper(blob, LENGTH, n_control_points=0).start
    filled = run_paper(blob, LENGTH).start

    def gaps(start):
        return np.diff([*start.stations, start.stations[0] + len(start.samples)])

    assert set(maxima.stations) <= set(filled.stations)
    assert len(filled.stations) > len(maxima.stations)
    # Whole points: halving an odd gap leaves one point more on one side.
    assert gaps(filled).max() <= np.ceil(0.5 * gaps(maxima).mean())


def test_sensible_even_gaps_are_halved_once():
    assert run_paper(flower(), 8).start.n_control_points == 20


@pytest.mark.parametrize("n", [40, 41])
def test_number_of_control_points_is_at_least_the_one_asked_for(blob, n):
    assert run_paper(blob, LENGTH, n_control_points=n).fit.n_control_points == n


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


@pytest.fixture(scope="module")
def sensible(blob):
    return run_paper(blob, LENGTH)


@pytest.mark.parametrize("which", ["literal", "sensible"])
@pytest.mark.slow
def test_report_is_complete_and_readable(which, tmp_path, request):
    pytest.importorskip("matplotlib")
    run = request.getfixturevalue(which)
    folder = tmp_path / "figures"
    paths = write_report(run, folder)
    assert [path.name for path in paths] == [*FIGURES, *TABLES]
    assert sorted(folder.iterdir()) == sorted(paths)
    for name in FIGURES:
        with Image.open(folder / name) as picture:
            picture.load()
            assert min(picture.size) > 400
    text = (folder / "report.md").read_text()
    assert all(f"]({name})" in text for name in FIGURES)
    rows = list(csv.reader(io.StringIO((folder / "table.csv").read_text())))
    table = {row[0]: row[1:] for row in rows}
    assert all(len(row) == 3 for row in rows)
    assert table["reading"][0] == which
    diagonal = run.contour.box_diagonal
    for quantity, value in (
        ("start error E_0", run.start_error),
        ("final error E", run.final_error),
        ("rms distance", run.fit.rms_distance),
        ("maximum distance", run.fit.max_distance),
        ("two-sided distance", run.fit.hausdorff_distance),
    ):
        absolute, relative = map(float, table[quantity])
        assert absolute == pytest.approx(value, rel=1e-5)  # six digits
        assert relative == pytest.approx(value / diagonal, rel=1e-5)
        assert f"| {quantity} | {table[quantity][0]} |" in text
    assert int(table["control points"][0]) == run.fit.n_control_points
    assert "iterations" in table["end"][0]


@pytest.mark.slow
def test_report_is_the_same_twice_and_replaces_an_older_one(sensible, tmp_path):
    pytest.importorskip("matplotlib")
    first = [path.read_bytes() for path in write_report(sensible, tmp_path / "a")]
    (tmp_path / "a" / "table.csv").write_text("old")
    assert first == [path.read_bytes() for path in write_report(sensible, tmp_path / "a")]


def test_missing_parent_is_one_sentence_and_leaves_nothing(sensible, tmp_path):
    with pytest.raises(FormatError, match="does not exist; create it first") as raised:
        write_report(sensible, tmp_path / "missing" / "figures")
    assert isinstance(raised.value, ShapesplineError)
    assert "\n" not in str(raised.value)
    assert not list(tmp_path.iterdir())


def test_file_in_the_place_of_the_folder_is_left_alone(sensible, tmp_path):
    file = tmp_path / "figures"
    file.write_text("mine")
    with pytest.raises(FormatError, match="it is a file"):
        write_report(sensible, file)
    assert file.read_text() == "mine"


def test_folder_that_cannot_be_written_is_refused_before_any_work(tmp_path, monkeypatch):
    monkeypatch.setattr(paper_report.os, "access", lambda *_: False)  # root may write everywhere
    with pytest.raises(FormatError, match="write-protected"):
        check_folder(tmp_path / "figures")
    with pytest.raises(FormatError, match="write-protected"):
        check_folder(tmp_path)


@pytest.mark.slow
def test_figure_that_fails_leaves_nothing(sensible, tmp_path, monkeypatch):
    from shapespline.paper import figures as figures

    pytest.importorskip("matplotlib")

    def fail(*_, **__):
        raise MemoryError

    monkeypatch.setattr(figures, "plot_convergence", fail)
    with pytest.raises(MemoryError):
        write_report(sensible, tmp_path / "figures")
    assert not list(tmp_path.iterdir())


# The predecessor's stand-in, and the claim


def test_predecessor_inserts_until_it_is_as_near_or_twice_as_large(blob):
    from benchmarks import predecessor

    first = initial_curve(blob, LENGTH, reading=replace(SENSIBLE, offset="none"))
    same = predecessor.predecessor_start(blob, LENGTH, np.inf, SENSIBLE)
    assert same.n_inserted == 0
    assert (same.spline.control_points == blob.points[first.dominant]).all()
    better = predecessor.predecessor_start(blob, LENGTH, 0.5 * same.error, SENSIBLE)
    assert better.n_inserted > 0
    assert better.error < same.error
    assert len(better.spline.control_points) == len(first.dominant) + better.n_inserted
    assert better.n_inserted <= len(first.dominant)


@pytest.mark.slow
@pytest.mark.parametrize("counted", [False, True], ids=["default", "number of the literal start"])
def test_direct_d_bfgs_needs_less_than_a_tenth_of_the_literal_evaluations(counted):
    """From the sensible start to the error that the literal run ends at."""
    if not (DATA / "paper").exists():
        pytest.skip("the outlines of the published examples are not there")
    contour = Contour(np.loadtxt(DATA / "paper" / "leaf840.csv", delimiter=","), closed=True)
    literal = run_paper(contour, 2, literal=True)
    # Not the evaluations until it stops: those to within 1 % of where it does.
    near = next(r for r in literal.fit.history if r.paper_error <= 1.01 * literal.final_error)
    start = run_paper(
        contour, 2, n_control_points=literal.fit.n_control_points if counted else None
    ).start
    target = 0.5 * literal.final_error**2 * (len(contour) - 1)
    fit = optimize(contour, start, "d-bfgs", limits=Limits(target_cost=target))
    assert fit.history[-1].paper_error <= literal.final_error
    assert fit.history[-1].evaluations < 0.1 * near.evaluations
