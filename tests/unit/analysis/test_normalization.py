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
    GRID,
    RADIUS,
    THINNING,
    WORTH_THINNING,
    NormalizedContour,
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
    # All points are as far from the mean, up to rounding, and come again a million times: what
    # compares them two by two would not end.
    t = 2 * np.pi * np.arange(1_000_000) / 1_000_000
    points = np.column_stack([np.cos(t), np.sin(t)])
    start, step = canonical_reading(points, closed=True)
    turned = np.roll(points, 123_456, axis=0)
    assert canonical_reading(turned, closed=True) == ((start + 123_456) % len(points), step)
    back = canonical_reading(points[::-1], closed=True)
    assert back == (len(points) - 1 - start, -step)


def greatest_readings(points, closed):
    """By the definition: readings whose distances from the mean come last in the dictionary."""
    away = ((points - points.mean(axis=0)) ** 2).sum(axis=1)
    ranks = np.round(away / away.max() * 2**32)
    n = len(points)
    starts = [(s, d) for s in range(n) for d in (1, -1)] if closed else [(0, 1), (n - 1, -1)]
    keys = {(s, d): tuple(ranks[(s + d * np.arange(n)) % n].tolist()) for s, d in starts}
    return {reading for reading, key in keys.items() if key == max(keys.values())}


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("seed", range(12))
def test_the_reading_is_the_greatest_of_all(seed, closed):
    rng = np.random.default_rng(seed)
    # Few whole numbers, once or repeated around a turn: many distances are equal.
    points = rng.integers(0, 3, (rng.integers(4, 9), 2)).astype(float)
    points += np.arange(len(points))[:, None] * (seed % 2)
    if seed % 3 == 0:
        points = np.concatenate([points - 1.5, 1.5 - points])
    assert canonical_reading(points, closed=closed) in greatest_readings(points, closed)


def test_weights_tell_readings_apart_that_points_do_not():
    row = np.array([[0.0, 0], [1, 1], [2, 0], [1, 1], [0, 0]])
    weights = np.array([1.0, 2, 1, 3, 1])
    assert canonical_reading(row, closed=False, weights=weights) == (0, 1)
    assert canonical_reading(row, closed=False, weights=weights[::-1].copy()) == (4, -1)


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


def kinds_of_outlines():
    rng = np.random.default_rng(3)
    walk = np.cumsum(rng.normal(0, 1, (150, 2)), axis=0)
    t = 2 * np.pi * np.arange(240) / 240
    chain = np.round(40 * np.column_stack([np.cos(t), 0.6 * np.sin(t)]))
    chain = chain[(chain != np.roll(chain, 1, axis=0)).any(axis=1)]
    yield "walk", walk, False
    yield "closed walk", walk, True
    yield "circle", np.column_stack([np.cos(t), np.sin(t)]), True
    yield "flower", flower(90).points, True
    yield "pixels", chain, True
    yield "there and back", np.concatenate([walk[:60], walk[58:0:-1]]), True
    yield "line", np.column_stack([t, 2 * t]), False
    yield "rectangle", rectangle(60, 40).points, True


@pytest.mark.parametrize(("name", "points", "closed"), list(kinds_of_outlines()))
def test_turned_mirrored_and_scaled_outlines_are_posed_alike(name, points, closed):
    once = NormalizedContour.posed(Contour(points, closed), 0.01)
    radius = np.hypot(*once.contour.points.T).max()
    assert radius == pytest.approx(RADIUS, abs=1e-5)
    for angle, scale, mirrored in ((0.7, 1.0, False), (2.9, 3.7, True), (0.0, 1e-7, True)):
        other = moved(
            points * (-1.0, 1.0) if mirrored else points, angle, scale, (0.1 * scale, -0.3 * scale)
        )
        again = NormalizedContour.posed(Contour(other, closed), scale * 0.01)
        assert_array_equal(again.contour.points, once.contour.points)
        assert again.length(scale * 0.01) == once.length(0.01)


@pytest.mark.parametrize("backwards", [False, True])
def test_posed_points_are_restored_to_the_bit_others_to_the_grid(backwards):
    points = moved(flower(90).points * (1.0, 0.6), 0.4, 3.0, (50.0, -20.0))
    given = points[:: -1 if backwards else 1]
    normalized = NormalizedContour.posed(Contour(given, closed=False), 0.05)
    own = normalized.contour.points
    assert_array_equal(normalized.data.points, given)
    line = Piece("line", 1, np.array([0.0, 0, 1, 1]), own[[3, 40]])
    (piece,) = normalized.restored((line,))
    ends = given[normalized.order[[3, 40]]]
    assert_array_equal(piece.control_points, ends[::-1] if normalized.reversed else ends)
    # A half of the grid in each coordinate, and a grid is no wider than its part of the tolerance.
    curve = BSplineCurve([0, 0, 1, 1], own[[3, 40]] + [[1.0, 0.0]], 1)
    found = normalized.restored_curve(curve)([0.0, 1.0])
    away = np.hypot(*(found - (ends[::-1] if normalized.reversed else ends)).T)
    grid = GRID * 0.05
    assert away * normalized.scale == pytest.approx(1.0, abs=grid * normalized.scale)
    assert np.hypot(*normalized.direction(np.array([0.6, 0.8]))) == pytest.approx(1.0)


def test_neighbours_nearer_than_the_grid_stay_apart_in_a_pose():
    points = np.array([(0.0, 0.0), (1e-7, 0.0), (3.0, 0.0), (3.0, 2.0)])
    normalized = NormalizedContour.posed(Contour(points, closed=True), 1.0)
    steps = np.hypot(*np.diff(normalized.contour.polyline, axis=0).T)
    assert steps.min() == pytest.approx(1e-7 * normalized.scale, rel=1e-6)
    # Far from the origin even a turn would let them fall together: the axes are kept.
    far = np.array([(0.0, 0.0), (0.0, 1e-10), (1.0, 1e7), (-1.0, 1e7)])
    kept = NormalizedContour.posed(Contour(far, closed=True), 1.0)
    assert_array_equal(kept.turn, np.eye(2))
    assert (np.diff(kept.contour.polyline, axis=0) != 0).any(axis=1).all()
