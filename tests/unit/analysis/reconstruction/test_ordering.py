"""Unordered points: the order of clean ones comes back, noise is thinned, nonsense is refused."""

from __future__ import annotations

import itertools
import warnings

import numpy as np
import pytest
from tests.support.shapes import flower, on_circle
from tests.support.toothed import comb

import shapespline as ss
from shapespline.analysis.reconstruction.ordering import looks_shuffled


def adjacent(order, closed):
    pairs = {frozenset(pair) for pair in itertools.pairwise(order)}
    return pairs | {frozenset((order[-1], order[0]))} if closed else pairs


def recovered(points, closed, seed=0):
    """Part of the true neighbours found in shuffled points, and the ordering."""
    shuffle = np.random.default_rng(seed).permutation(len(points))
    found = ss.order_points(points[shuffle])
    pairs = set()
    for indices, contour in zip(found.indices, found.shape, strict=True):
        pairs |= adjacent(shuffle[indices].tolist(), contour.closed)
    true = adjacent(list(range(len(points))), closed)
    return len(true & pairs) / len(true), found


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["hand620_closed", "leaf840_closed", "plane1100_closed", "mdi_fan_c0"]
)
def test_clean_outlines_come_back(outline, name):
    contour = outline(name)
    part, found = recovered(contour.points, contour.closed)
    assert part == 1
    assert found.confidence > 0.95
    assert len(found.shape) == 1
    assert found.shape.contours[0].closed == contour.closed
    assert (found.noise, len(found.outliers)) == (0.0, 0)


@pytest.mark.slow
def test_the_whole_corpus(all_outlines):
    """Exact on all but self-crossing, slit-like and noisy ones: those are named."""
    hard = {"loop500_open", "mdi_fish_c0", "naca2412", "naca4412"}
    for name, contour in all_outlines:
        if name in hard or "_n0.2_" in name or "_n1_" in name:
            continue
        points = np.unique(contour.points, axis=0, return_index=True)[1]
        part, _ = recovered(contour.points[np.sort(points)], contour.closed)
        assert part == 1, name


def test_open_curves_stay_open():
    t = np.linspace(0, 3 * np.pi, 300)
    spiral = np.column_stack([t * np.cos(t), t * np.sin(t)])
    part, found = recovered(spiral, closed=False)
    assert part == 1
    assert not found.shape.contours[0].closed


def test_several_outlines_nested_and_apart():
    rings = [10 * on_circle(200), 4 * on_circle(80), 2 * on_circle(50) + (30, 0)]
    points = np.concatenate(rings)[np.random.default_rng(2).permutation(330)]
    found = ss.order_points(points)
    assert [len(contour) for contour in found.shape] == [200, 80, 50]
    assert found.shape.parents == (-1, 0, -1)
    assert all(contour.closed for contour in found.shape)


def test_a_sharp_corner_is_kept():
    side = np.linspace(0, 1, 40, endpoint=False)[:, None]
    corners = np.array([(0.0, 0), (10, 5.0), (10, -5.0)])  # a tip of 53 degrees
    points = np.concatenate(
        [a + side * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    )
    part, _ = recovered(points, closed=True)
    assert part == 1


def test_outliers_far_off_are_left_out():
    rng = np.random.default_rng(5)
    ring = 10 * on_circle(300)
    strays = rng.uniform(-40, 40, (9, 2))
    strays = strays[np.abs(np.hypot(*strays.T) - 10) > 4]
    found = ss.order_points(np.concatenate([strays, ring]))
    assert set(found.outliers.tolist()) == set(range(len(strays)))
    assert len(found.shape) == 1
    assert len(found.indices[0]) == 300


@pytest.mark.slow
def test_a_noisy_band_gives_its_middle():
    rng = np.random.default_rng(3)
    ring = 10 * on_circle(600)
    noisy = ring + 0.2 * rng.standard_normal(ring.shape)
    found = ss.order_points(rng.permutation(noisy))
    assert len(found.shape) == 1
    assert found.shape.contours[0].closed
    radius = np.hypot(*found.shape.contours[0].points.T)
    # Each parabola averages a dozen points and more: less than half the noise is left, of which
    # nine in ten are within 1.65 sigma. A stray has
    # too few around it and stays where it is, within 4 sigma.
    assert np.quantile(np.abs(radius - 10), 0.9) < 1.65 * 0.1
    assert np.abs(radius - 10).max() < 0.8
    # The noise across the ring is 0.2; parabolas take a part of it along.
    assert 0.1 < found.noise < 0.3
    assert len(found.indices[0]) + len(found.outliers) == 600


def test_results_can_be_fitted():
    points = np.random.default_rng(1).permutation(flower(240).points)
    fit = ss.fit_curve(ss.order_points(points).shape.longest, tolerance=0.05)
    assert fit.kept


@pytest.mark.slow
def test_nonsense_is_refused():
    rng = np.random.default_rng(4)
    with pytest.raises(ss.OrderError, match="no order"):
        ss.order_points(rng.uniform(0, 1, (400, 2)))
    for wrong in ([(0, 0), (0, 0), (1, 1)], [1, 2, 3], [(0, np.nan), (1, 1), (2, 0)]):
        with pytest.raises(ss.InvalidInputError):
            ss.order_points(wrong)


def test_points_on_a_line():
    x = np.random.default_rng(6).permutation(np.arange(50.0))
    found = ss.order_points(np.column_stack([x, 2 * x]))
    assert np.abs(np.diff(found.shape.longest.points[:, 0])).tolist() == [1.0] * 49


def test_shuffled_points_are_noticed():
    points = flower(200).points
    with warnings.catch_warnings():
        warnings.simplefilter("error", ss.ShuffledPointsWarning)
        ss.fit_curve(points, closed=True, n_control_points=20)
    with pytest.warns(ss.ShuffledPointsWarning, match="order_points"):
        ss.fit_curve(np.random.default_rng(0).permutation(points), closed=True, n_control_points=20)


def test_no_false_alarm_on_the_corpus(all_outlines):
    for name, contour in all_outlines:
        assert not looks_shuffled(contour), name
        if len(contour) >= 30:
            shuffled = np.random.default_rng(0).permutation(contour.points)
            assert looks_shuffled(ss.Contour(shuffled, closed=True)), name


def test_reading_unordered_points(tmp_path):
    ring = 10 * on_circle(100)
    shuffled = np.random.default_rng(7).permutation(ring)
    np.savetxt(tmp_path / "cloud.csv", shuffled, delimiter=",")
    np.save(tmp_path / "cloud.npy", shuffled)
    for name in ("cloud.csv", "cloud.npy"):
        (contour,) = ss.read(tmp_path / name, unordered=True)
        assert contour.closed
        assert contour.length == pytest.approx(200 * 10 * np.sin(np.pi / 100), rel=1e-9)


@pytest.mark.parametrize("count", [300, 1000, 3000])
@pytest.mark.parametrize("seed", [0, 1, 4])
def test_points_at_random_places_of_a_curve_stay_together(count, seed):
    """Steps are exponential: of 3000 some are ten times the median."""
    angle = np.random.default_rng(seed).uniform(0, 2 * np.pi, count)
    ring = np.column_stack([np.cos(angle), 0.6 * np.sin(angle)])
    found = ss.order_points(ring)
    assert len(found.shape) == 1
    assert len(found.shape.longest) >= count - 2  # of two at one place one may be left out
    around = np.unwrap(np.arctan2(*(found.shape.longest.points / [1.0, 0.6]).T[::-1]))
    steps = np.diff(around)
    assert (steps > 0).all() or (steps < 0).all()


def test_even_points_stay_open_across_a_gap():
    angle = np.random.default_rng(1).permutation(np.linspace(0, 0.95 * 2 * np.pi, 300))
    (contour,) = ss.order_points(np.column_stack([np.cos(angle), np.sin(angle)])).shape
    assert not contour.closed


def test_a_comb_is_in_order():
    assert not looks_shuffled(ss.Contour(comb(20, 1.0, 30.0), closed=False))
