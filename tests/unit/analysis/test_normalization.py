"""Thinning before a search: what is left stands for all, both ways; where a reading begins."""

from itertools import pairwise

import numpy as np
import pytest
from tests.support.scattered import noisy_walk
from tests.support.shapes import flower, on_circle, rectangle

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

NONE_MARKED = np.empty(0, dtype=np.int64)


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
