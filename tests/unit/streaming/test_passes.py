"""Passes over a stream: what a look tells, what is measured, how far they are."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from checks import distance_to_curve
from shapespline.errors import DegenerateContourError, InvalidInputError, ShapesplineError
from shapespline.geometry import CentredCurve
from shapespline.streaming import Passes, PointStream
from shapespline.streaming.passes import SAMPLE
from shapespline.streaming.stream import CHUNK
from shapespline.values import BSplineCurve, Contour, clamped_knots

N = 2 * CHUNK + 7


def walk(n=N):
    return np.cumsum(np.random.default_rng(4).normal(size=(n, 2)), axis=0)


def passes_of(points, progress=None, in_all=1):
    return Passes(PointStream(points), progress, in_all)


def test_a_look_tells_what_all_points_tell():
    points = walk()
    seen = passes_of(points).look()
    assert_array_equal(seen.low, points.min(axis=0))
    assert_array_equal(seen.high, points.max(axis=0))
    assert_array_equal(seen.firsts, points[::CHUNK])
    assert_array_equal(seen.last, points[-1])
    # Every so many-th point, as if there were no chunks.
    stride = -(-N // SAMPLE)
    assert_array_equal(seen.sample, points[::stride])
    parts = np.split(points, [CHUNK, 2 * CHUNK])
    within = [np.hypot(*np.diff(part, axis=0).T).max() for part in parts]
    assert seen.longest_step == pytest.approx(max(within), rel=1e-15)


@pytest.mark.parametrize(("gap", "meet"), [(0.9, True), (1.1, False)])
def test_ends_meet_over_no_more_than_a_step(gap, meet):
    square = np.array([(0.0, 0.0), (1, 0), (1, 1), (0.0, gap)])
    assert passes_of(square).look().ends_meet is meet


def test_what_is_not_finite_is_named_by_its_index():
    points = walk()
    points[CHUNK + 5, 1] = np.inf
    with pytest.raises(InvalidInputError, match=rf"got \[.*inf\] at index {CHUNK + 5};"):
        passes_of(points).look()
    with pytest.raises(DegenerateContourError, match="got none"):
        passes_of(np.zeros((0, 2))).look()


def test_distances_of_all_points_are_measured():
    curve = BSplineCurve(clamped_knots(6, 3), [(0, 0), (2, 3), (4, -3), (6, 3), (8, -3), (9, 0)], 3)
    points = np.random.default_rng(1).uniform(-1, 10, (3000, 2))
    feet = np.empty(3000)
    found = passes_of(points).measure(CentredCurve.of(curve, Contour(points, closed=False)), feet)
    away = distance_to_curve(points, curve, 0.01)
    assert found.largest == pytest.approx((away**2).max(), rel=1e-9)
    assert found.total == pytest.approx((away**2).sum(), rel=1e-9)
    assert np.hypot(*(curve(feet) - points).T) == pytest.approx(away, abs=1e-9)


def test_progress_counts_points_and_ends_the_passes():
    seen = []
    passes = passes_of(walk(), lambda done, total: seen.append((done, total)), in_all=3)
    passes.look()
    assert seen == [(CHUNK, 3 * N), (2 * CHUNK, 3 * N), (N, 3 * N)]
    passes.reach(2)
    passes.look()
    assert seen[-1] == (3 * N, 3 * N)
    ended = passes_of(walk(), lambda done, total: done > CHUNK)
    with pytest.raises(ShapesplineError, match=f"after {2 * CHUNK} of {N} points"):
        ended.look()


def test_what_is_known_is_not_asked_for():
    asked = []

    def note(points, name):
        asked.append(name)
        return name

    found = passes_of(walk()).over_all(note, [("a",), ("b",), ("c",)], {1: "known"})
    assert found == ["a", "known", "c"]
    assert asked == ["a", "c"]
