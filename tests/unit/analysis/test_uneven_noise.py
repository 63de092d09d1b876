"""How sure points are whose noise is not the same everywhere."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from shapespline.analysis import precisions
from shapespline.analysis.uneven_noise import ACROSS, LEAST_SURE, LINE, PARABOLA, SUREST, _told
from shapespline.values import Contour

NOISE = 0.05
SQUARE = [(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)]


def square(n_each=60):
    """Points along the sides of a square."""
    t = np.arange(n_each)[:, None] / n_each
    corners = np.array(SQUARE)
    return np.concatenate([a + t * (b - a) for a, b in pairwise([*corners, corners[0]])])


def shaken(points, seed, noise=NOISE):
    return points + np.random.default_rng(seed).normal(0, 1, points.shape) * noise


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("seed", range(10))
def test_points_with_the_same_noise_are_alike_whatever_corners_they_have(seed, closed):
    assert precisions(Contour(shaken(square(), seed), closed), NOISE) is None


@pytest.mark.parametrize("closed", [True, False])
def test_strays_are_not_sure_and_their_neighbours_are(closed):
    points = shaken(square(), 1)
    strays = [17, 95, 200]  # in the middle of edges, across each of which they lie
    points[strays] += [(0.0, 1.0), (1.0, 0.0), (-1.0, 0.0)]
    found = precisions(Contour(points, closed), NOISE)
    assert np.flatnonzero(found < 0.05).tolist() == strays
    assert found[strays] == pytest.approx(LEAST_SURE)
    assert np.median(found) == 1.0


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("apart", [2, 3, 4])
def test_strays_near_each_other_do_not_hide_each_other(apart, closed):
    points = shaken(square(), 2)
    strays = [30, 30 + apart]
    points[strays] += [(0.0, 1.0), (0.0, 0.8)]
    found = precisions(Contour(points, closed), NOISE)
    assert np.flatnonzero(found < 0.05).tolist() == strays


@pytest.mark.parametrize("first", [0, 30, 31])
def test_the_neighbours_of_a_stray_are_none(first):
    # They are off what the others tell with it.
    points = shaken(square(), 2)
    points[30] += (0.0, 5.0)
    found = precisions(Contour(np.roll(points, -first, axis=0), closed=True), NOISE)
    assert np.flatnonzero(found < 1.0).tolist() == [(30 - first) % len(points)]


@pytest.mark.parametrize("at", [58, 62])
def test_a_stray_beside_a_corner_is_one(at):
    # The points on its other side are on no line, but those next to it are on one across it.
    points = shaken(square(), 2)
    points[at] += (0.6, -0.6)
    found = precisions(Contour(points, closed=True), NOISE)
    assert np.flatnonzero(found < 0.05).tolist() == [at]


def test_two_points_side_by_side_are_what_was_drawn():
    points = shaken(square(), 2)
    points[[30, 31]] += (0.0, 0.6)
    assert precisions(Contour(points, closed=True), NOISE) is None


@pytest.mark.parametrize("seed", range(8))
def test_bends_are_no_strays(seed):
    # A fillet of three points beside edges of many: each is far from what its neighbours tell.
    t = np.linspace(0, 10, 100)
    turn = np.array([(10.6, 0.2), (10.9, 0.6), (11.0, 1.1)])
    points = np.concatenate(
        [np.column_stack([t, 0 * t]), turn, np.column_stack([11 + 0 * t, 2 + t])]
    )
    assert precisions(Contour(shaken(points, seed, 0.002), closed=False), 0.002) is None


@pytest.mark.parametrize("closed", [True, False])
def test_a_rough_half_is_less_sure_by_the_ratio_of_variances(closed):
    points = square(100)
    rough = np.where(np.arange(len(points)) < len(points) // 2, 4.0, 1.0)[:, None] * NOISE
    found = precisions(Contour(shaken(points, 3, rough), closed), 2.0 * NOISE)
    # Windows tell a deviation to about 0.2 of it (ANA-22), their median to a third of that.
    ratio = np.median(found[:150]) / np.median(found[250:])
    assert np.sqrt(1 / ratio) == pytest.approx(4.0, rel=0.2)
    assert found.max() <= SUREST


@pytest.mark.parametrize("closed", [True, False])
def test_an_exact_half_is_as_sure_as_any(closed):
    points = square(100)
    exact = np.where(np.arange(len(points)) < len(points) // 2, 0.0, 1.0)[:, None] * NOISE
    found = precisions(Contour(shaken(points, 3, exact), closed), NOISE)
    assert found[100] == found.max() == SUREST
    assert np.isfinite(found).all()


def test_few_points_and_exact_ones_tell_nothing():
    points = shaken(square(10), 1)
    assert precisions(Contour(points, closed=True), NOISE) is None
    assert precisions(Contour(square(), closed=True), 0.0) is None


@pytest.mark.parametrize(("offsets", "degree"), [(PARABOLA, 2), (LINE, 1), (-LINE, 1), (ACROSS, 1)])
def test_what_neighbours_tell_is_the_formula(offsets, degree):
    random = np.random.default_rng(7)
    points, noise = shaken(square(), 7), random.uniform(0.5, 2.0, 240) * NOISE
    told = np.sort(random.choice(240, 100, replace=False))
    vander = np.vander(offsets.astype(float), degree + 1)
    beside = points[(told[:, None] + offsets) % 240]
    found = np.einsum("ck,ikd->icd", np.linalg.pinv(vander), beside)
    (u, v), (x, y) = found[:, -2].T, (points[told] - found[:, -1]).T
    speed, error = np.hypot(u, v), np.sqrt(1 + (np.linalg.pinv(vander)[-1] ** 2).sum())
    left = beside - np.einsum("kc,icd->ikd", vander, found)
    across = (left[..., 0] * v[:, None] - left[..., 1] * u[:, None]) / speed[:, None]
    free = len(offsets) - degree - 1
    off, rest = _told(points, told, offsets, degree, noise)
    # Sums of six coordinates up to 20, differences over deviations of a fortieth.
    assert off == pytest.approx(np.abs(x * v - y * u) / (speed * error * noise[told]), abs=1e-9)
    assert rest == pytest.approx(np.sqrt((across**2).sum(axis=1) / free) / noise[told], abs=1e-9)
