"""What a run leaves for other programs: read back, every table and curve is that of the run."""

from __future__ import annotations

import csv
import io
import runpy
from xml.etree import ElementTree

import numpy as np
import pytest
from tests.support.shapes import flower, wave

from shapespline import LITERAL, Contour, optimize, read
from shapespline.errors import InvalidInputError
from shapespline.paper import film, initial_curve, run_paper
from shapespline.paper.files import DATA_FILES, FILM, data_files
from shapespline.paper.film import MOST_FRAMES, chosen_frames
from shapespline.solvers import Limits

SHORT = Limits(max_iterations=12)


@pytest.fixture(scope="module", params=["sensible", "literal", "open"])
def run(request):
    if request.param == "literal":
        return run_paper(flower(200), 6, reading=LITERAL, limits=SHORT, snapshots=1)
    contour = flower(200) if request.param == "sensible" else wave()
    return run_paper(contour, 6, limits=SHORT, snapshots=1)


@pytest.fixture(scope="module")
def files(run, tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")
    contents = data_files(run)
    assert tuple(contents) == (*DATA_FILES, FILM)
    for name, data in contents.items():
        (folder / name).write_bytes(data)
    return folder


def columns(path):
    rows = list(csv.DictReader(io.StringIO(path.read_text())))
    return {name: [row[name] for row in rows] for name in rows[0]}


def numbers(table, *names):
    return np.array([[float(value) for value in table[name]] for name in names]).T


def test_points_and_parameters(run, files):
    table = columns(files / "points.csv")
    expected = run.contour.polyline[: len(run.start.parameters)]
    np.testing.assert_array_equal(numbers(table, "x", "y"), expected)
    np.testing.assert_array_equal(numbers(table, "t")[:, 0], run.start.parameters)


def test_h_and_its_maxima(run, files):
    table, cpda = columns(files / "h.csv"), run.start.cpda
    np.testing.assert_array_equal(
        numbers(table, "H_raw", "H", "H_signed").T, [cpda.raw, cpda.values, cpda.signed]
    )
    np.testing.assert_array_equal(np.flatnonzero(numbers(table, "is_maximum")), cpda.maxima)
    np.testing.assert_array_equal(numbers(table, "x", "y"), run.start.samples.points)


def test_frames(run, files):
    table = columns(files / "frames.csv")
    np.testing.assert_array_equal(numbers(table, "sample")[:, 0], run.start.stations)
    np.testing.assert_array_equal(
        numbers(table, "tangent_x", "tangent_y"), run.start.frames.tangents
    )
    np.testing.assert_array_equal(numbers(table, "normal_x", "normal_y"), run.start.frames.normals)


def test_control_points_and_convergence(run, files):
    table = columns(files / "control-points.csv")
    of = np.array(table["curve"])
    for name, spline in (("initial", run.start.spline), ("final", run.fit.spline)):
        np.testing.assert_array_equal(numbers(table, "x", "y")[of == name], spline.control_points)
    history = columns(files / "convergence.csv")
    np.testing.assert_array_equal(
        numbers(history, "cost", "paper_error", "evaluations"),
        [[r.cost, r.paper_error, r.evaluations] for r in run.fit.history],
    )


def test_curves_in_every_format(run, files):
    for name, spline in (("initial", run.start.spline), ("final", run.fit.spline)):
        [fit] = read(files / f"{name}-curve.json").fits
        assert fit.control_points.tobytes() == spline.control_points.tobytes()
        assert fit.knots.tobytes() == spline.knots.tobytes()
        [curve] = runpy.run_path(str(files / f"{name}-curve.py"))["curves"]
        at = np.linspace(0, 1, 50)
        np.testing.assert_allclose(curve(at), spline(at), atol=1e-12 * run.contour.box_diagonal)
        ElementTree.parse(files / f"{name}-curve.svg")


def test_the_film_begins_with_the_start_and_ends_with_the_fit(run, files):
    root = ElementTree.parse(files / FILM).getroot()
    [animation] = root.iter("{http://www.w3.org/2000/svg}animate")
    frames = animation.get("values").split(";")
    distinct = list(dict.fromkeys(frames))
    assert len(distinct) == len(run.fit.snapshots) <= MOST_FRAMES
    for frame, snapshot in ((distinct[0], run.start.spline), (distinct[-1], run.fit.spline)):
        x, y = (float(value) for value in frame[1 : frame.index("C")].split())
        first = snapshot([snapshot.domain[0]])[0]
        low, high = run.contour.points.min(axis=0), run.contour.points.max(axis=0)
        both = np.concatenate([run.fit.control_points, [low, high]])
        low, high = both.min(axis=0), both.max(axis=0)
        border = 0.05 * (high - low).max()
        assert x == pytest.approx(first[0] - low[0] + border, rel=1e-4)  # six digits
        assert y == pytest.approx(high[1] + border - first[1], rel=1e-4)


@pytest.mark.parametrize("count", [1, 2, 40, 41, 100, 5000])
def test_frames_grow_apart(count):
    chosen = chosen_frames(count)
    assert chosen[0] == 0
    assert chosen[-1] == count - 1
    assert len(chosen) <= MOST_FRAMES + 1
    steps = np.diff(chosen)
    assert (steps > 0).all()
    if count > 1000:
        assert steps[0] == 1
        assert steps[-1] > 10


def test_a_film_needs_curves():
    with pytest.raises(InvalidInputError, match="run must hold snapshots: make it with run_paper"):
        film(run_paper(flower(200), 6, limits=SHORT))


@pytest.mark.slow
@pytest.mark.parametrize("every", [1, 5, 100])
@pytest.mark.parametrize(
    "method", ["d-bfgs", "levenberg-marquardt", "insertion-removal", "differential-evolution"]
)
def test_snapshots_are_the_curves_of_their_iterations(every, method):
    contour = flower(160)
    start = initial_curve(contour, 6)
    limits = Limits(max_iterations=60, max_evaluations=150)
    plain = optimize(contour, start, method, limits=limits)
    fit = optimize(contour, start, method, limits=limits, snapshots=every)
    assert fit.control_points.tobytes() == plain.control_points.tobytes()
    assert plain.snapshots == ()
    kept = [snapshot.iteration for snapshot in fit.snapshots]
    last = fit.history[-1].iteration
    assert kept == sorted({*range(0, last + 1, every), last})
    assert fit.snapshots[-1].spline.n_control_points == fit.n_control_points
    # Moved to the middle of the data and back.
    off = fit.snapshots[-1].spline.control_points - fit.control_points
    assert np.abs(off).max() <= 1e-12 * contour.box_diagonal


def test_closed_films_of_high_degree_are_drawn():
    run = run_paper(Contour(flower(160).points, True), 6, degree=5, limits=SHORT, snapshots=4)
    ElementTree.fromstring(film(run).decode())
