"""Free-form runs of measured points: edges stay straight, corners sharp and in their place."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from benchmarks.attack.shapes import drawn
from benchmarks.drawn.profiles import PROFILES, clean_profile, noisy_profile
from benchmarks.drawn.truth import Line, sampled
from scipy.spatial import cKDTree

import shapespline as ss
from checks import distance_to_curve, distance_to_polyline, polyline_of
from shapespline.engines.drawn import Drawn, DrawnArc, DrawnLine, FreeRun
from shapespline.fitting.measured_runs import MeasuredRuns
from shapespline.monitor import Monitor
from shapespline.values import Arc, Contour, Regularity


def noisy(name: str, noise: float, n: int, draw: int) -> tuple[np.ndarray, np.ndarray]:
    drawn = noisy_profile(name, draw, 10)
    return next((points, dense) for key, points, dense in drawn if key == (noise, n))


@pytest.mark.parametrize(
    ("name", "noise", "n", "draw"),
    [
        ("cover", 0.1, 200, 1),  # one spline of 18 points, no corner
        ("cover", 0.1, 1000, 0),  # edges cut in two, lines in the wave
        ("knife", 0.1, 1000, 6),
        ("flag", 0.1, 200, 2),
        ("lute", 0.5, 1000, 0),
        ("saddle (aside)", 0.02, 1000, 3),
        ("spade (aside)", 0.02, 1000, 4),
    ],
)
def test_edges_and_corners_of_a_profile_are_those_of_the_drawing(name, noise, n, draw):
    points, dense = noisy(name, noise, n, draw)
    fit = ss.fit_curve(points, closed=True)
    kinds = [piece.kind for piece in fit.pieces]
    assert kinds.count("line") == sum(isinstance(one, Line) for one in PROFILES[name])
    assert "arc" not in kinds
    # The curve is nearer to the truth than its points; a corner is where edge and curve meet, known
    # to some deviations and a part of a step.
    size = float(np.hypot(*np.ptp(dense, axis=0)))
    far = cKDTree(dense).query(fit.curve(np.linspace(0, 1, 3000)))[0]
    sigma, step = 0.01 * noise * size, float(np.hypot(*np.diff(points, axis=0).T).mean())
    assert np.sqrt((far**2).mean()) < sigma
    assert far.max() < 3.0 * sigma + 0.3 * step


def test_level_edges_beside_curves_are_level_to_the_bit():
    points, _ = noisy("cover", 0.5, 1000, 0)
    fit = ss.fit_curve(points, closed=True)
    lines = [piece.control_points for piece in fit.pieces if piece.kind == "line"]
    level = [line for line in lines if (line[0] == line[1]).any()]
    assert len(level) == 3
    told = {k for one in fit.regularities if one.name == "axis-parallel" for k in one.pieces}
    assert all(
        (fit.pieces[k].control_points[0] == fit.pieces[k].control_points[1]).any() for k in told
    )


def test_the_curve_is_one_without_gaps_and_both_distances_are_measured():
    points, _ = noisy("flag", 0.1, 1000, 3)
    fit = ss.fit_curve(points, closed=True)
    around = [*fit.pieces, fit.pieces[0]]
    for before, after in pairwise(around):
        assert np.array_equal(before.control_points[-1], after.control_points[0])
    far = cKDTree(fit.curve(np.linspace(0, 1, 60_000))).query(points)[0].max()
    assert fit.max_distance == pytest.approx(far, abs=2e-3)


OUTLINES = Path(__file__).parents[3] / "examples" / "data" / "outlines"
RUNS = MeasuredRuns(degree=3, noise=0.05, monitor=Monitor())


def wave(n: int = 80, height: float = 6.0) -> np.ndarray:
    """From (0, 0) to (40, 0), up at its beginning and down at its end, noise of 0.05."""
    x = np.linspace(0, 40, n)
    points = np.column_stack([x, height * np.sin(np.pi * x / 40)])
    return points + np.random.default_rng(4).normal(0, 0.05, points.shape)


def test_a_corner_is_moved_to_where_edge_and_run_cross():
    # The edge's data end half a step short of the corner in (0, 0), the run begins where they end.
    edge = DrawnLine(np.array([0.0, 30.0]), np.array([0.0, 0.4]))
    run = FreeRun(np.concatenate([[edge.end], wave()[1:]]), (None, None))
    moved = RUNS.meeting(Drawn((edge, run), (), is_told=True, n_unknowns=2), closed=False)
    line, free = moved.parts
    assert isinstance(line, DrawnLine)
    assert isinstance(free, FreeRun)
    # Three standard errors of a curve of ten points at its end, where it is least known.
    assert np.hypot(*line.end) < 3 * 0.05
    assert line.end[0] == 0.0  # on the level edge to the bit
    assert np.array_equal(line.end, free.points[0])


def test_a_corner_on_an_arc_stays_on_its_circle_and_turns_its_sweep():
    arc = Arc((-10.0, 0.0), 10.0, -1.5, 1.46)
    element = DrawnArc(arc, arc.begin, arc.end)
    run = FreeRun(np.concatenate([[arc.end], wave()[1:]]), (None, None))
    moved = RUNS.meeting(Drawn((element, run), (), is_told=True, n_unknowns=3), closed=False).parts[
        0
    ]
    assert isinstance(moved, DrawnArc)
    assert moved.arc.radius == 10.0
    assert np.allclose(moved.arc.end, moved.end, atol=1e-12)
    assert np.array_equal(moved.begin, arc.begin)
    # The circle meets the wave in (0, 0), where it goes straight up.
    assert np.hypot(*moved.end) < 3 * 0.05 + 0.1


def test_corners_of_an_outline_that_is_its_own_image_stay_where_they_are():
    edge = DrawnLine(np.array([0.0, 30.0]), np.array([0.0, 0.4]))
    run = FreeRun(np.concatenate([[edge.end], wave()[1:]]), (None, None))
    drawn = Drawn((edge, run), (Regularity("mirror", (0,), 0.0, 2),), is_told=True, n_unknowns=2)
    assert RUNS.meeting(drawn, closed=False) is drawn


def test_a_run_begins_and_ends_along_its_tangents():
    u, v = np.array([0.9, 0.44]), np.array([0.9, -0.42])
    u, v = u / np.hypot(*u), v / np.hypot(*v)
    points = wave()
    pieces = RUNS.smoothed(FreeRun(points, (u, v)))
    begin = pieces[0].control_points[1] - pieces[0].control_points[0]
    end = pieces[-1].control_points[-1] - pieces[-1].control_points[-2]
    assert abs(begin[0] * u[1] - begin[1] * u[0]) < 1e-12 * np.hypot(*begin)
    assert abs(end[0] * v[1] - end[1] * v[0]) < 1e-12 * np.hypot(*end)
    assert np.array_equal(pieces[0].control_points[0], points[0])
    assert np.array_equal(pieces[-1].control_points[-1], points[-1])


def test_a_corner_within_a_run_stays_one():
    # Two arches that meet in a cusp: a corner no line tells of.
    arch = wave(height=25.0)
    points = np.concatenate([arch, arch[1:] + np.array([40.0, 0.0])])
    pieces = RUNS.smoothed(FreeRun(points, (None, None)))
    assert len(pieces) == 2
    # Known to some deviations and a part of a step, 1.1.
    assert np.hypot(*(pieces[0].control_points[-1] - [40.0, 0.0])) < 3 * 0.05 + 0.3


@pytest.mark.parametrize("name", ["knife", "lute", "saddle (aside)"])
def test_corners_between_clean_points_are_where_edge_and_curve_cross(name):
    # A short line cut each corner that no point happened to lie in, up to a step away from it.
    outline = PROFILES[name]
    points = ss.Contour(sampled(outline, 0.01), closed=True).resampled(200).points
    fit = ss.fit_curve(points, closed=True)
    step = float(np.hypot(*np.diff(points, axis=0).T).mean())
    nodes = cKDTree([piece.control_points[0] for piece in fit.pieces])
    edges = [one for one in outline if isinstance(one, Line)]
    off = nodes.query([end for one in edges for end in (one.begin, one.end)])[0]
    # The fourth difference of the cubics at the step leaves less than a hundredth of it.
    assert off.max() < 0.01 * step
    assert min(piece.polygon_length for piece in fit.pieces) > 2.0 * step


def test_directions_that_noise_hides_tell_no_drawing():
    # Sides of fingers, level to two degrees, were taken for drawn, with 14 corners, some on tips.
    (hand,) = ss.read(OUTLINES / "hand620_closed.csv")
    points = hand.resampled(300).points
    points = points + np.random.default_rng(1).normal(0, 0.002 * hand.box_diagonal, points.shape)
    fit = ss.fit_curve(points, closed=True)
    assert fit.method != "drawn"
    assert len(fit.corners) < 14


@pytest.mark.parametrize(
    ("name", "n", "within", "draw"),
    [
        ("cover", 2000, 0.001, 1),
        ("knife", 500, 0.005, 2),
        ("saddle (aside)", 200, 0.005, 6),
        ("flag", 2000, 0.005, 7),
        ("spade (aside)", 2000, 0.001, 0),
        ("knife", 500, None, 3),
        ("saddle (aside)", 2000, None, 4),
        ("spade (aside)", 200, None, 1),
        # One edge or two of any direction: nothing but that they are straight to the last digit.
        ("hull (aside)", 500, None, 7),
        ("flag", 2000, None, 8),
        ("lute", 200, None, 6),
    ],
)
def test_clean_points_of_a_profile_give_its_own_edges_and_no_bits_beside(name, n, within, draw):
    contour = clean_profile(name, draw, 10, n)
    size = contour.box_diagonal
    fit = ss.fit_curve(contour, tolerance=within and within * size)
    kinds = [piece.kind for piece in fit.pieces]
    assert kinds.count("line") == sum(isinstance(one, Line) for one in PROFILES[name])
    assert "arc" not in kinds
    assert min(piece.polygon_length for piece in fit.pieces) > 0.02 * size
    if within:
        far = distance_to_curve(contour.points, fit.curve, 1e-4 * size).max()
        along = distance_to_polyline(polyline_of(fit.curve, 1e-4 * size), contour.polyline).max()
        assert max(far, along) <= within * size


def test_a_corner_that_a_tolerance_does_not_reach_stays_within_it():
    # Half a step from the chords, five tolerances.
    contour = clean_profile("saddle (aside)", 3, 10, 200)
    within = 0.0005 * contour.box_diagonal
    fit = ss.fit_curve(contour, tolerance=within)
    along = distance_to_polyline(polyline_of(fit.curve, 0.1 * within), contour.polyline).max()
    assert along <= within


@pytest.mark.parametrize(("within", "moves"), [(np.inf, True), (0.5, True), (0.1, False)])
def test_a_corner_is_moved_within_the_tolerance_only(within, moves):
    # (0, 0) is 0.2 from the chord from the edge's last point to the run's first.
    x = np.linspace(0.25, 40, 80)
    edge = DrawnLine(np.array([0.0, 30.0]), np.array([0.0, 0.4]))
    points = np.column_stack([x, 6 * np.sin(np.pi * x / 40)])
    run = FreeRun(np.concatenate([[edge.end], points]), (None, None))
    drawn = Drawn((edge, run), (), is_told=True, n_unknowns=2)
    runs = MeasuredRuns(degree=3, noise=1e-9, monitor=Monitor(), clean=True, within=within)
    end = runs.meeting(drawn, closed=False).parts[0].end
    # Where they cross the cubic through four points is off by its fourth derivative.
    assert np.allclose(end, (0, 0) if moves else (0, 0.4), atol=1e-4)


def tip(first: float, within: float) -> tuple[np.ndarray, np.ndarray]:
    """A run of two arches that meet in (40, 0), sampled from ``first`` on, before and after."""
    x = np.arange(first, 79.0)
    points = np.column_stack([x, 12 * np.abs(np.sin(np.pi * x / 40))])
    edge = DrawnLine(np.array([first, 30.0]), points[0])
    runs = MeasuredRuns(degree=3, noise=1e-9, monitor=Monitor(), clean=True, within=within)
    drawn = Drawn((edge, FreeRun(points, (None, None))), (), is_told=True, n_unknowns=2)
    return points, runs.meeting(drawn, closed=False).parts[1].points


def test_a_corner_within_a_run_of_clean_points_is_put_between_two_of_them():
    points, found = tip(0.3, np.inf)
    (k,) = np.flatnonzero((points[:-1, 0] < 40) & (points[1:, 0] > 40)) + 1
    # Cubics over a step are off by some (pi / 40)^4 of the height.
    assert np.allclose(found, np.insert(points, k, (40.0, 0.0), axis=0), atol=2e-3)


@pytest.mark.parametrize(("first", "within"), [(0.0, np.inf), (0.3, 0.1)])
def test_a_corner_that_is_a_point_or_beyond_the_tolerance_is_not_put_in(first, within):
    # In (40, 0) itself; 0.4 from the chord between its neighbours.
    points, found = tip(first, within)
    assert np.array_equal(points[1:], found[1:])


@pytest.mark.parametrize(("offset", "corners"), [(0.0, 0), (0.4, 1)])
def test_a_corner_that_turns_as_its_curves_do_is_put_in_where_no_point_is(offset, corners):
    x = np.arange(offset, 79.0) - 40
    points = np.column_stack([x, 12 - 1.2 * np.maximum(x, 0) - x**2 / 200])
    edge = DrawnLine(points[0] + [0, 30.0], points[0])
    runs = MeasuredRuns(degree=3, noise=1e-9, monitor=Monitor(), clean=True)
    drawn = Drawn((edge, FreeRun(points, (None, None))), (), is_told=True, n_unknowns=2)
    assert len(runs.meeting(drawn, closed=False).parts[1].points) == len(points) + corners


def test_no_corner_is_put_into_a_smooth_run():
    x = np.linspace(0.2, 40, 13)
    points = np.column_stack([x, 12 * np.sin(np.pi * x / 20)])  # up to 25 degrees a step
    edge = DrawnLine(np.array([0.2, 30.0]), points[0])
    runs = MeasuredRuns(degree=3, noise=1e-9, monitor=Monitor(), clean=True)
    drawn = Drawn((edge, FreeRun(points, (None, None))), (), is_told=True, n_unknowns=2)
    assert len(runs.meeting(drawn, closed=False).parts[1].points) == len(points)


TREAD = [(0, 0), (3, 0)]


def test_stairs_tell_of_no_corners_beyond_them():
    # Three points a tread, corners between them: four in a row hold one.
    stairs = [(3.0 * k + dx, -3.0 * k - dy) for k in range(6) for dx, dy in TREAD]
    points = Contour.silently(np.array(stairs), closed=False).resampled(34).points
    edge = DrawnLine(points[0] + [-30.0, 0.0], points[0])
    runs = MeasuredRuns(degree=3, noise=1e-9, monitor=Monitor(), clean=True)
    drawn = Drawn((edge, FreeRun(points, (None, None))), (), is_told=True, n_unknowns=2)
    assert np.array_equal(runs.meeting(drawn, closed=False).parts[1].points, points)


@pytest.mark.parametrize("seed", [90143, 90530])
def test_a_run_meets_no_line_that_has_no_length(seed):
    # Noise in the heights alone, of few digits: lines without an inside are read, and dropped.
    shape, random = drawn(seed, None), np.random.default_rng([seed, 7])
    points = np.array(shape.points, dtype=float)
    deviation = 10.0 ** random.uniform(-5, -1.5) * np.hypot(*np.ptp(points, axis=0))
    errors = random.normal(0, deviation, points.shape)
    errors[:, 0] = 0.0
    measured = deviation * np.round((points + errors) / deviation)
    contour = Contour.silently(measured, shape.closed)
    assert ss.fit_curve(contour).n_stored_points > 1
