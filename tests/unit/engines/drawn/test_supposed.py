"""Few points, whose noise nobody knows: what lines and arcs tell of it."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.few_points import (
    COUNTS,
    SHAPES,
    exported,
    fitted,
    is_outline,
    is_right,
    measured,
    organic,
    shaken,
)
from benchmarks.drawn.measuring import WAYS
from benchmarks.drawn.measuring import measured as measured_as
from benchmarks.drawn.profiles import noisy_profile
from benchmarks.drawn.random_plates import STEP, plate, points_of
from benchmarks.drawn.truth import sampled
from benchmarks.quality import own_corpus

import shapespline as ss
from shapespline.engines.drawn.engine import as_drawn
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.supposed import OF_STEP_ROUND, drifting, suppositions, unsure

CIRCLE = SHAPES["circle"]
# Within a tolerance strays are followed, and corners in gaps are cut by a chord within it.
BEYOND = ("1 % strays", "5 % missing", "uneven steps")


def kinds(fit):
    return [piece.kind for piece in fit.pieces]


@pytest.mark.parametrize("noise", [0.0002, 0.0005, 0.001])
@pytest.mark.parametrize("count", COUNTS)
def test_a_circle_of_few_shaken_points_is_one(count, noise):
    points = measured(CIRCLE, count, noise, np.random.default_rng(count))
    deviation = noise * float(np.hypot(*np.ptp(points, axis=0)))
    for tolerance in (None, 0.005):
        fit = fitted(points, tolerance)
        assert kinds(fit) == ["arc"]
        # Radius and centre of n points are known to about sqrt(2 / n) deviations, three allowed.
        off = 3 * deviation * (2 / count) ** 0.5
        assert fit.pieces[0].arc.radius == pytest.approx(30, abs=off)
        assert fit.pieces[0].arc.centre == pytest.approx((20, 15), abs=off)


@pytest.mark.parametrize("name", ["slot", "plate"])
@pytest.mark.parametrize("digits", [None, 3, 2])
def test_vertices_as_programs_export_them_are_lines_and_arcs(name, digits):
    for chords in (6, 12, 24):
        assert is_right(exported(SHAPES[name], chords, digits), SHAPES[name], None)


@pytest.mark.parametrize("name", ["bay", "tab"])
def test_edges_of_which_the_ends_alone_are_given_are_lines(name):
    # Two corners are round, two sharp: the price of an edge with two points is that of more.
    for chords in (12, 24):
        assert is_right(exported(SHAPES[name], chords, 2), SHAPES[name], None)
        assert is_right(exported(SHAPES[name], chords, 2), SHAPES[name], 0.005)


@pytest.mark.parametrize("name", ["slot", "bay", "rectangle"])
def test_few_shaken_points_are_lines_and_arcs(name):
    points = measured(SHAPES[name], 60, 0.0005, np.random.default_rng(1))
    assert is_right(points, SHAPES[name], None)


@pytest.mark.parametrize("name", list(organic()))
@pytest.mark.parametrize("noise", [0.0, 0.001])
def test_what_has_no_arcs_gets_none(name, noise):
    at = organic()[name]
    for count in COUNTS:
        points = shaken(at, count, noise, np.random.default_rng(count))
        assert "arc" not in kinds(fitted(points, None))


@pytest.mark.parametrize("noise", [0.003, 0.01])
@pytest.mark.parametrize("count", [24, 40])
def test_open_rows_of_few_points_are_lines_and_arcs(count, noise):
    angle, x = np.linspace(0, np.pi / 2, count), np.linspace(0, 20, count)
    rows = {
        "arc": np.column_stack([10 * np.cos(angle), 10 * np.sin(angle)]),
        "line": np.column_stack([x, 0.3 * x]),
    }
    for kind, row in rows.items():
        for seed in range(3):
            points = row + np.random.default_rng(seed).normal(0, noise, row.shape)
            fit = ss.fit_curve(ss.Contour(points, closed=False))
            assert kinds(fit) == [kind]


@pytest.mark.parametrize(("count", "narrower"), [(20, 0.99), (24, 0.993), (24, 0.996), (48, 0.996)])
def test_a_nearly_round_ellipse_is_no_circle(count, narrower):
    # What a circle leaves goes on from point to point.
    angle = 2 * np.pi * np.arange(count) / count
    points = np.column_stack([30 * np.cos(angle), 30 * narrower * np.sin(angle)])
    found = as_drawn(ss.Contour(points, closed=True))
    assert found is None or not found.is_told


@pytest.mark.parametrize("count", [16, 24])
def test_a_leaf_repeats_nothing(count):
    # Three or four arcs are as near to so few points as cubics are, but leave too many numbers.
    (leaf,) = (one.contour for one in own_corpus() if one.name == "leaf840_closed")
    found = as_drawn(leaf.resampled(count))
    assert found is None or not found.is_told


@pytest.mark.parametrize("draw", range(6))
def test_the_nodes_of_few_clean_points_are_where_they_were(draw):
    # One point off, an arc of six points has one of an edge.
    points = measured(SHAPES["slot"], 24, 0.0, np.random.default_rng(draw))
    assert is_right(points, SHAPES["slot"], None)


def test_points_that_tell_their_noise_are_not_supposed_to_have_more():
    points = measured(CIRCLE, 200, 0.001, np.random.default_rng(0))
    contour = ss.Contour(points, closed=True)
    assert not list(suppositions(contour, Observed.of(contour, None)))


def test_suppositions_grow_up_to_what_a_circle_may_have():
    contour = ss.Contour(measured(CIRCLE, 24, 0.001, np.random.default_rng(0)), closed=True)
    seen = Observed.of(contour, None)
    found = list(suppositions(contour, seen))
    deviations = [one.seen.deviation for one in found]
    assert deviations == sorted(deviations)
    assert seen.deviation < deviations[0]
    assert deviations[-1] <= OF_STEP_ROUND * seen.step
    assert [one.n_each for one in found] == sorted((one.n_each for one in found), reverse=True)


def test_points_of_a_file_are_exact_but_for_their_digits():
    points = exported(SHAPES["plate"], 12, None)
    exact = ss.Contour(points, closed=True, accuracy=0.0)
    assert not list(suppositions(exact, Observed.of(exact, None)))
    rounded = ss.Contour(points.round(2), closed=True, accuracy=0.0)
    found = list(suppositions(rounded, Observed.of(rounded, None)))
    assert found
    assert all(one.by_rounding for one in found)


def test_what_lines_and_arcs_tell_of_errors_is_told():
    points = measured(CIRCLE, 48, 0.001, np.random.default_rng(0))
    contour = ss.Contour(points, closed=True)
    found = as_drawn(contour)
    # To a factor of two, and what 48 points leave open: 10 %, of which three times.
    noise = 0.001 * contour.box_diagonal
    assert 0.35 * noise < found.supposed < 2.6 * noise
    clean = ss.Contour(measured(CIRCLE, 48, 0.0, np.random.default_rng(0)), closed=True)
    assert as_drawn(clean).supposed == 0.0


def plate_measured(way, form, *, regular, noise=0.001):
    """A plate and points of it, measured in some way."""
    outline = plate(form, 0, regular=regular)
    random = np.random.default_rng([0, *form.encode()])
    return outline, measured_as(sampled(outline, STEP), way, noise, random)


@pytest.mark.parametrize("regular", [True, False])
@pytest.mark.parametrize("way", WAYS)
def test_lines_and_arcs_come_back_however_they_were_measured(way, regular):
    outline, points = plate_measured(way, "L", regular=regular)
    fit = fitted(points, None)
    assert is_outline(fit, outline)


@pytest.mark.parametrize("way", [way for way in WAYS if way not in BEYOND])
def test_and_within_a_tolerance_that_is_no_less_than_what_points_are_off_by(way):
    outline, points = plate_measured(way, "L", regular=True, noise=0.0005)
    fit = fitted(points, 0.005)
    assert fit.kept
    assert is_outline(fit, outline)


def test_a_corner_in_a_gap_of_noisy_points_is_where_its_edges_meet():
    outline, points = plate_measured("uneven steps", "T", regular=True)
    assert is_outline(fitted(points, None), outline)


@pytest.mark.parametrize(
    ("form", "draw", "regular"),
    [("U", 0, True), ("Z", 0, False), ("L", 3, True), ("U", 2, True), ("L", 2, False)],
)
def test_points_of_small_fillets_are_no_strays(form, draw, regular):
    # Without them an arc of few points less would tell the plate.
    outline = plate(form, draw, regular=regular)
    random = np.random.default_rng([draw, *form.encode()])
    points = points_of(sampled(outline, STEP), 200, 0.0002, random)
    assert is_outline(fitted(points, None), outline)


@pytest.mark.parametrize(("form", "draw"), [("U", 0), ("box", 2)])
def test_a_reading_that_leaves_elements_out_is_not_cheaper(form, draw):
    outline = plate(form, draw, regular=False)
    random = np.random.default_rng([draw, *form.encode()])
    points = measured_as(sampled(outline, STEP), "3 % measured twice", 0.001, random)
    assert is_outline(fitted(points, None), outline)


def test_errors_that_go_on_may_be_larger_than_neighbours_tell_both_ways():
    outline = plate("box", 1, regular=True)
    random = np.random.default_rng([1, *b"box"])
    points = measured_as(sampled(outline, STEP), "means of three", 0.003, random)
    assert is_outline(fitted(points, None), outline)


@pytest.mark.parametrize("way", ["1 % strays", "half three times as rough", "going on by 0.7"])
def test_other_errors_make_no_arcs_of_what_is_none(way):
    for outline in own_corpus():
        if outline.name not in ("leaf840_closed", "hand620_closed"):
            continue
        dense = outline.contour.resampled(4000).points
        points = measured_as(dense, way, 0.002, np.random.default_rng(1))
        assert "arc" not in kinds(ss.fit_curve(points, closed=True))


def test_noisy_points_that_are_alike_are_supposed_to_be_nothing_else():
    _, points = plate_measured("even steps, alike", "L", regular=True)
    contour = ss.Contour(points, closed=True)
    assert not list(unsure(contour, Observed.of(contour, None)))
    assert as_drawn(contour).precisions is None


def test_errors_that_go_on_are_independent_only_so_many_points_apart():
    _, points = plate_measured("means of three", "L", regular=True)
    contour = ss.Contour(points, closed=True)
    seen = Observed.of(contour, None)
    found = list(drifting(contour, seen))
    assert [one.seen.apart for one in found] == list(range(2, 2 + len(found)))
    for one in found:
        # n points of errors that go on tell as much as a part of them with larger ones.
        part = (seen.deviation / one.seen.deviation) ** 2 / one.seen.apart
        assert one.precisions == pytest.approx(part)


@pytest.mark.parametrize("draw", [3, 7])
def test_a_curve_that_is_off_its_arcs_is_no_error_that_goes_on(draw):
    (points,) = [
        points
        for sampling, points, _ in noisy_profile("spade (aside)", draw, 10)
        if sampling == (0.02, 200)
    ]
    found = kinds(ss.fit_curve(points, closed=True))
    assert found.count("line") == 5
    assert "arc" not in found
