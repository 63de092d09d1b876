"""Thinning before a search: what is left stands for all, both ways; where a reading begins."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.scattered import noisy_walk
from tests.support.shapes import flower, moved, on_circle, rectangle

from checks import distance_to_polyline
from shapespline import Contour, _kernels
from shapespline.analysis.normalization import (
    FEWEST_POINTS,
    THINNING,
    WORTH_THINNING,
    NormalizedContour,
    _first_in_head,
    canonical_reading,
)
from shapespline.values import BSplineCurve, Piece

NONE_MARKED = np.empty(0, dtype=np.int64)


@pytest.mark.slow
@pytest.mark.parametrize("distance", [1e-4, 1e-2, 0.3])
@pytest.mark.parametrize(
    "points",
    [
        flower(3000).polyline,
        rectangle(200, 100, 0.1).polyline,
        on_circle(700, 5.0),
        noisy_walk(1500, 0.003),
        noisy_walk(1500, 0.2),
        np.array([[0.0, 0], [1, 0], [2, 0], [1, 0], [0, 0], [0, 1]]),  # goes back on itself
        np.array([[0.0, 0], [1, 1]]),
    ],
)
def test_both_polylines_lie_within_the_distance(points, distance):
    kept = np.array(_kernels.thinned(np.ascontiguousarray(points), distance, np.inf, None))
    assert kept[0] == 0
    assert kept[-1] == len(points) - 1
    assert (np.diff(kept) > 0).all()
    # Rounding of the cone's cross products, relative to the largest squares in them.
    enough = distance + 1e-12
    share = np.linspace(0, 1, 40)[:, None]
    # Each chord by its own stretch of the data, so that a point far along the outline is no excuse.
    for a, b in pairwise(kept):
        stretch = points[a : b + 1]
        assert distance_to_polyline(stretch, points[[a, b]]).max() <= enough
        chord = points[a] + share * (points[b] - points[a])
        assert distance_to_polyline(chord, stretch).max() <= enough


def test_no_chord_is_too_long_and_marks_stay():
    points = np.column_stack([np.linspace(0, 10, 1001), np.zeros(1001)])
    marked = np.zeros(1001, dtype=np.int64)
    marked[[17, 503, 504]] = 1
    assert len(_kernels.thinned(points, 0.01, np.inf, None)) == 2
    kept = _kernels.thinned(points, 0.01, 0.5, marked)
    assert {17, 503, 504} <= set(kept)
    # 0.5 is 50 steps, up to the rounding of their sum.
    assert np.diff(kept).max() <= 50
    assert len(kept) <= 1000 / 49 + 4


def test_a_dense_outline_thins_to_what_its_bends_need():
    sizes = [len(_kernels.thinned(flower(n).polyline, 0.001, np.inf, None)) for n in (4000, 64000)]
    assert sizes[1] <= sizes[0] * 1.02


def test_a_thinned_frame_tells_which_points_are_left():
    contour = flower(4000)
    frame = NormalizedContour.of(contour)
    thin = frame.thinned(0.05 * frame.scale, np.array([5, 77]))
    assert len(thin.contour) <= WORTH_THINNING * len(contour)
    assert {5, 77} <= set(np.flatnonzero(np.isin(frame.order, thin.order)))
    assert thin.error_used == pytest.approx(THINNING * 0.05 * frame.scale)
    back = thin.contour.points / thin.scale + thin.middle
    assert back == pytest.approx(contour.points[thin.order], abs=1e-13)


def test_small_or_rough_outlines_stay_whole():
    small = NormalizedContour.of(flower(FEWEST_POINTS))
    assert small.thinned(1.0, NONE_MARKED) is small
    rough = NormalizedContour.of(Contour(noisy_walk(3000, 0.2), closed=False))
    assert rough.thinned(0.01, NONE_MARKED) is rough


def test_where_a_circle_begins_is_found_at_once():
    t = 2 * np.pi * np.arange(1_000_000) / 1_000_000
    points = np.column_stack([np.cos(t), np.sin(t)])
    away = np.empty(len(points))
    _kernels.centroid_distances_sq(points, away)
    starts = np.flatnonzero(away == away.max())
    assert len(starts) > 1000  # all of them as far from the mean, to the last bit
    readings = np.array([(start, step) for start in starts for step in (1, -1)])
    assert len(_first_in_head(away, readings)) <= 2
    start, step = canonical_reading(points, closed=True)
    turned = np.roll(points, 123_456, axis=0)
    assert canonical_reading(turned, closed=True) == ((start + 123_456) % len(points), step)


@pytest.mark.parametrize("scale", [1e-9, 1.0, 3e7])
@pytest.mark.parametrize("shift", [(0.0, 0.0), (12.0, -7.0)])
def test_the_middle_is_the_origin_and_the_size_a_power_of_two_away(scale, shift):
    contour = Contour(moved(flower().points, 0.3, scale, np.multiply(scale, shift)), closed=True)
    normalized = NormalizedContour.of(contour)
    assert 64 <= normalized.contour.box_diagonal < 128
    assert np.frexp(normalized.scale)[0] == 0.5
    middle = normalized.contour.points.min(axis=0) + normalized.contour.points.max(axis=0)
    assert np.abs(middle).max() <= 4 * np.finfo(float).eps * 128
    # Nothing but the subtraction of the middle is rounded.
    back = normalized.contour.points / normalized.scale + normalized.middle
    rounding = 4 * np.finfo(float).eps * np.abs(contour.points).max()
    assert np.abs(back - contour.points[normalized.order]).max() <= rounding
    assert_array_equal(normalized.order[normalized.new_index], np.arange(len(contour)))


def test_neighbours_that_would_fall_together_stay_apart():
    points = np.array([(0.0, 0.0), (0.0, 1e-10), (1.0, 1e7), (-1.0, 1e7)])
    normalized = NormalizedContour.of(Contour(points, closed=True))
    steps = np.diff(normalized.contour.polyline, axis=0)
    assert (steps != 0).any(axis=1).all()
    assert_array_equal(normalized.contour.points / normalized.scale, points[normalized.order])


@pytest.mark.parametrize("closed", [True, False])
def test_the_reading_does_not_depend_on_where_and_which_way_the_data_run(closed):
    points = flower(90).points * (1.0, 0.6) + np.sin(flower(90).points[::-1]) * 0.1
    expected = NormalizedContour.of(Contour(points, closed)).contour.points
    ways = [points[::-1]]
    if closed:
        ways += [np.roll(points, 31, axis=0), np.roll(points[::-1], 7, axis=0)]
    for way in ways:
        found = NormalizedContour.of(Contour(way, closed))
        assert_array_equal(found.contour.points, expected)


def test_what_is_found_is_restored_where_the_data_are_and_the_way_they_run():
    points = moved(flower(90).points * (1.0, 0.6), 0.4, 3.0, (50.0, -20.0))
    for given in (points, points[::-1]):
        normalized = NormalizedContour.of(Contour(given, closed=False))
        ends = normalized.contour.points[[0, -1]]
        line = Piece("line", 1, np.array([0.0, 0, 1, 1]), ends)
        (piece,) = normalized.restored((line,))
        assert piece.control_points == pytest.approx(given[[0, -1]], rel=1e-14)
        curve = BSplineCurve([0, 0, 1, 1], ends, 1)
        again = normalized.restored_curve(curve)([0.0, 1.0])
        assert again == pytest.approx(given[[0, -1]], rel=1e-14)
