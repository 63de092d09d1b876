"""The single spline by knot engine."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.scale import wiggly
from tests.support.engines import fit_spline
from tests.support.promise import ROUNDING
from tests.support.shapes import flower, moved, on_circle, rectangle, wave
from tests.support.sizes import most_points

from checks import report, two_sided
from shapespline.analysis import NormalizedContour
from shapespline.engines.spline import Fairness, attempts, engine, fairness_of
from shapespline.engines.spline.fairness import INTERVAL_RATIO, SPEED_RATIO
from shapespline.errors import InvalidInputError
from shapespline.geometry import two_sided_distance
from shapespline.monitor import End, Monitor
from shapespline.values.contour import Contour

PEERS = ("hand620_closed", "leaf840_closed", "plane1100_closed", "loop500_open")


def test_what_misses_the_rule_begins_elsewhere_at_last_with_the_polyline(monkeypatch):
    starts, from_polyline = [], []

    def asked(*arguments):
        starts.append(arguments[4])
        return settings(*arguments)

    def noted(*arguments):
        from_polyline.append((search := searched(*arguments)).from_polyline())
        return search

    settings, searched = engine._settings, engine._searched
    broken = Fairness(2 * INTERVAL_RATIO, 1.0, 0, 0)
    monkeypatch.setattr(engine, "_settings", asked)
    monkeypatch.setattr(engine, "_searched", noted)
    monkeypatch.setattr(engine, "fairness_of", lambda *_: broken)
    assert fit_spline(flower(), 0.05).kept
    assert starts == [0, 1, 2]
    assert from_polyline == [False, False, True]


def test_no_spline_of_rough_data_is_tried_for_fewer_points_than_it_may_have():
    rng = np.random.default_rng(4)
    t = np.linspace(0, 2 * np.pi, 600, endpoint=False)
    ring = np.column_stack([np.cos(t), np.sin(t)]) + rng.normal(0, 0.01, (600, 2))
    contour = Contour(ring, closed=True)
    options = {"degree": 3, "effort": "fast", "monitor": Monitor()}
    known = NormalizedContour.of(contour)
    assert not list(attempts(contour, known, 0.005, **options, fewer_than=100))
    heard = len(options["monitor"].history)
    assert heard == 0  # not even begun
    assert next(attempts(contour, known, 0.1, **options, fewer_than=10)).curve.n_control_points < 30


def first_attempt(contour, tolerance, effort):
    """What the engine yields before it is told anything."""
    normalized, monitor = NormalizedContour.of(contour), Monitor()
    options = {"degree": 3, "effort": effort, "monitor": monitor}
    return next(attempts(contour, normalized, tolerance, **options))


@pytest.mark.parametrize("effort", ["fast", "balanced"])
def test_without_hope_less_is_tried_for_as_few_points(monkeypatch, effort):
    contour = Contour(wiggly(200), closed=True)
    fit = first_attempt(contour, 0.1, effort)
    unending = engine.LEVELS["smallest"]
    level = engine.LEVELS[effort]._replace(trying=unending.trying, retrying=unending.retrying)
    monkeypatch.setitem(engine.LEVELS, effort, level)
    patient = first_attempt(contour, 0.1, effort)
    assert fit.counts["trials"] < patient.counts["trials"]
    assert fit.curve.n_control_points == patient.curve.n_control_points


@pytest.mark.parametrize("n", [1500, 4000, 20_000])
def test_many_bends_are_not_cut_across_by_the_first_knots(n):
    # Two dozen knots for 29 waves end in loops, and in more than twice the knots that are needed.
    contour = Contour(wiggly(n), closed=True)
    attempt = first_attempt(contour, 0.1, "fast")
    assert two_sided_distance(attempt.curve, contour).hausdorff_distance <= 0.1
    assert attempt.counts["accepted"] < attempt.curve.n_control_points


def assert_promise(fit, contour):
    """Both distances by the outside checker."""
    assert fit.kept
    step = fit.tolerance / 10
    found = two_sided(fit.spline, contour.points, closed=contour.closed, step=step)
    assert found.larger <= fit.tolerance + ROUNDING * contour.box_diagonal


@pytest.mark.parametrize("percent", [0.1, 0.5])
@pytest.mark.parametrize("name", PEERS)
@pytest.mark.slow
def test_few_points_keep_the_promise_and_the_product_rule(outline, name, percent):
    contour = outline(name)
    fit = fit_spline(contour, percent / 100 * contour.box_diagonal)
    assert_promise(fit, contour)
    assert fit.n_control_points <= most_points(name, percent, "spline alone")
    found = report(fit.spline, contour.points, closed=contour.closed, tolerance=fit.tolerance)
    assert found.interval_ratio <= INTERVAL_RATIO * (1 + 1e-9)
    # Samples of the two lie elsewhere.
    assert found.speed_ratio >= 0.99 * SPEED_RATIO
    assert found.crossings == found.data_crossings
    assert found.hooks == 0
    assert fairness_of(fit.spline, contour).kept


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("shape", [flower(), wave()], ids=["closed", "open"])
@pytest.mark.slow
def test_every_degree_keeps_the_promise(shape, degree):
    fit = fit_spline(shape, 0.02, degree=degree)
    assert fit.spline.degree == degree
    assert_promise(fit, shape)


def test_a_closed_spline_is_smooth_across_its_seam():
    curve = fit_spline(flower(), 0.01).spline
    assert curve.periodic
    begin, end = curve.domain
    step = 1e-9
    for derivative in (0, 1, 2):
        before, after = curve([end - step, begin + step], derivative=derivative)
        jump = np.hypot(*(after - before))
        # The next derivative times the step bounds what is no jump.
        allowed = 4 * step * np.hypot(*curve(curve.breakpoints, derivative=derivative + 1).T).max()
        assert jump <= allowed + 1e-9 * np.hypot(*after)


def test_an_open_spline_ends_where_the_data_end():
    contour = wave()
    curve = fit_spline(contour, 0.05).spline
    assert np.allclose(curve(curve.domain), contour.points[[0, -1]], rtol=0, atol=1e-12 * 20)


def test_a_circle_needs_few_points():
    assert fit_spline(Contour(on_circle(400), closed=True), 0.01).n_control_points <= 7


def test_a_straight_line_needs_four_points():
    line = Contour(np.column_stack([np.linspace(0, 9, 50), np.linspace(0, 3, 50)]), closed=False)
    assert fit_spline(line, 0.01).n_control_points == 4


@pytest.mark.parametrize("shift", [1, 77])
def test_first_point_and_direction_do_not_matter(shift):
    points = flower().points * (1.0, 0.7)
    curve = fit_spline(Contour(points, closed=True), 0.02).spline
    again = fit_spline(Contour(np.roll(points, shift, axis=0), closed=True), 0.02).spline
    assert np.array_equal(curve.knots, again.knots)
    assert np.array_equal(curve.control_points, again.control_points)
    back = fit_spline(Contour(np.roll(points[::-1], shift, axis=0), closed=True), 0.02).spline
    # One of the two runs against the canonical order: the same points in reverse, one rounding of
    # each knot.
    assert sorted(back.control_points.tolist()) == sorted(curve.control_points.tolist())
    at = np.linspace(0.0, 1.0, 101)
    assert back(1.0 - at) == pytest.approx(curve(at), abs=1e-12)


@pytest.mark.parametrize(("scale", "shift"), [(1e-9, 0.0), (1e9, 0.0), (1.0, 1e6)])
def test_size_and_place_of_the_data_do_not_matter(scale, shift):
    contour = wave()
    other = Contour(moved(contour.points, 0.4, scale, (shift, -shift)), closed=False)
    fit = fit_spline(other, 0.05 * scale)
    assert_promise(fit, other)
    assert fit.n_control_points <= 1.1 * fit_spline(contour, 0.05).n_control_points + 1


def test_sparse_polygons_and_spacing_that_varies_a_thousandfold():
    square = Contour([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)
    uneven = np.concatenate([np.linspace(0, 0.01, 30), np.linspace(0.02, 10, 15)])
    bend = Contour(np.column_stack([uneven, np.sin(uneven)]), closed=False)
    for contour in (square, rectangle(8, 5), bend):
        assert_promise(fit_spline(contour, 0.01), contour)


def test_self_intersections_of_the_data_stay():
    t = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    eight = Contour(np.column_stack([np.sin(t), np.sin(2 * t)]), closed=True)
    fit = fit_spline(eight, 0.005)
    assert_promise(fit, eight)
    rule = fairness_of(fit.spline, eight)
    assert rule.n_crossings == rule.n_data_crossings == 1


@pytest.mark.slow
def test_more_effort_never_breaks_the_promise():
    contour = flower(petals=7)
    counts = []
    for effort in ("fast", "balanced", "smallest"):
        fit = fit_spline(contour, 0.01, effort=effort)
        assert_promise(fit, contour)
        counts.append(fit.n_control_points)
    assert counts[1] <= counts[0]


def test_the_callback_sees_the_stages_and_ends_the_search():
    # The first stage removes the cheapest knots, the second insists on the others.
    monitor = Monitor(lambda record: record.iteration == 1)
    fit = fit_spline(flower(), 0.02, monitor=monitor)
    assert monitor.ended is End.CANCELLED
    assert fit.kept
    first, second = (record.cost for record in monitor.history)
    assert first >= second == fit.n_control_points


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ({"tolerance": 0.0}, "tolerance"),
        ({"tolerance": float("nan")}, "tolerance"),
        ({"tolerance": 0.1, "effort": "much"}, "effort"),
        ({"tolerance": 0.1, "degree": 10}, "degree"),
    ],
)
def test_bad_arguments_are_named(arguments, named):
    with pytest.raises(InvalidInputError, match=named):
        fit_spline(flower(), **arguments)


@pytest.mark.slow
@pytest.mark.parametrize("folder", ["airfoils", "icons", "leaves", "strokes", "gps_tracks"])
def test_the_promise_over_the_corpus(more_outlines, folder):
    for name, contour in more_outlines(folder, 12):
        fit = fit_spline(contour, 0.005 * contour.box_diagonal, effort="fast")
        assert fit.kept, name
