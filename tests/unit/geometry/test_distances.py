"""Two-sided distances: the bound is a bound, and tight."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import directed_hausdorff
from tests.support import reference
from tests.support.shapes import flower, on_circle, random_curve, wave

from checks import distance_to_curve, distance_to_polyline, polyline_of, sampling_error
from shapespline.geometry.distances import FLOOR, RELATIVE_GAP, two_sided_distance
from shapespline.paper.initial import initial_curve
from shapespline.values.contour import Contour
from shapespline.values.curve import BSplineCurve
from shapespline.values.knots import clamped_knots, periodic_knots

EPS = reference.EPS


class Sampled(NamedTuple):
    """Distances by the outside checker; the reverse one too small by ``slack`` at most.

    Where several branches meet the forward ones may be too large by as much.
    """

    forward: np.ndarray
    reverse: float
    slack: float


def sampled_distances(curve, contour, step):
    reverse = distance_to_polyline(polyline_of(curve, step), contour.polyline).max()
    forward = distance_to_curve(contour.points, curve, step)
    return Sampled(forward, reverse, sampling_error(curve, step))


def assert_bound(curve, contour):
    """Certified is no less than what any sample has, and no more than 0.1 % above it."""
    found = two_sided_distance(curve, contour)
    sampled = sampled_distances(curve, contour, contour.box_diagonal / 500)
    rounding = 64 * EPS * max(np.abs(contour.points).max(), np.abs(curve.control_points).max())
    assert found.reverse_distance >= sampled.reverse - rounding
    floor = FLOOR * contour.box_diagonal
    most = (sampled.reverse + sampled.slack) * (1 + RELATIVE_GAP) + floor + rounding
    assert found.reverse_distance <= most
    assert found.max_distance <= sampled.forward.max() + rounding
    assert found.max_distance >= sampled.forward.max() - sampled.slack - rounding
    rms = np.sqrt(np.mean(sampled.forward**2))
    assert rms - sampled.slack - rounding <= found.rms_distance <= rms + rounding
    assert found.hausdorff_distance == max(found.max_distance, found.reverse_distance)
    return found, sampled


def wiggle(rng, curve, n, noise, closed):
    """Data along a curve."""
    u = np.sort(rng.uniform(*curve.domain, n))
    return Contour(curve(u) + rng.normal(0, noise, (n, 2)), closed)


@pytest.mark.slow
@pytest.mark.parametrize("degree", range(1, 10))
@pytest.mark.parametrize("periodic", [False, True], ids=["clamped", "periodic"])
@pytest.mark.parametrize("noise", [1e-6, 0.3])
def test_random_curves_and_polylines(degree, periodic, noise):
    rng = np.random.default_rng([degree, periodic])
    curve = random_curve(rng, degree, degree + 6, periodic=periodic)
    contour = wiggle(rng, curve, 80, noise, periodic)
    assert_bound(curve, contour)


@pytest.mark.slow
@given(st.integers(0, 10**6), st.integers(1, 4), st.booleans(), st.integers(4, 30))
@settings(max_examples=30)
def test_any_curve_against_any_polyline(seed, degree, periodic, n):
    rng = np.random.default_rng(seed)
    curve = random_curve(rng, degree, degree + 3, periodic=periodic)
    assert_bound(curve, Contour(rng.uniform(-10, 10, (n, 2)), bool(seed % 2)))


@pytest.mark.parametrize(
    "points",
    [
        [(0, 0), (1, 1), (0, 1), (1, 0)],  # cusp
        [(0, 0), (3, 2), (-2, 2), (1, 0)],  # loop
        [(0, 0), (0, 0), (0, 0), (1, 0)],  # stands still at its start
        [(0, 0), (2, 0), (-1, 0), (1, 0)],  # turns back on itself
    ],
)
def test_cusps_loops_and_standstill(points):
    curve = BSplineCurve([0] * 4 + [1] * 4, points, 3)
    found, _ = assert_bound(curve, Contour([(0, 0), (0.5, 0.1), (1, 0)], False))
    assert found.reverse_distance > 0.05


def test_by_hand():
    # The parabola y = 4 x (1 - x) over its chord: one above it; the chord's middle and its
    # quarters are 0.5, sqrt(...) away from it.
    parabola = BSplineCurve([0, 0, 0, 1, 1, 1], [(0, 0), (0.5, 2), (1, 0)], 2)
    found = two_sided_distance(parabola, Contour([(0, 0), (1, 0)], False))
    assert 1 <= found.reverse_distance <= 1.001 + 1e-9
    assert found.max_distance <= 32 * EPS
    found = two_sided_distance(parabola, Contour([(0, 0), (0.5, 0), (1, 0)], False))
    # Nearest to (1/2, 0): with s = x - 1/2, minimise s^2 + (1 - 4 s^2)^2: s^2 = 7/32, 15/64.
    assert found.max_distance == pytest.approx(np.sqrt(15) / 8, abs=32 * EPS)
    assert found.rms_distance == pytest.approx(np.sqrt(15 / 64 / 3), abs=32 * EPS)
    assert found.parameters[[0, 2]].tolist() == [0, 1]
    assert abs(found.parameters[1] - 0.5) == pytest.approx(np.sqrt(7 / 32), abs=1e-8)


def test_an_excursion_between_two_points_is_seen():
    # Data within 0 of the curve, and a loop of the curve far from the data.
    data = [(0, 0), (1, 0), (2, 0), (3, 0)]
    knots = [0, 0, 0.2, 0.4, 0.5, 0.6, 0.8, 1, 1]
    curve = BSplineCurve(knots, [(0, 0), (1, 0), (1.5, 0), (1.5, 7), (1.5, 0), (2, 0), (3, 0)], 1)
    found = two_sided_distance(curve, Contour(data, False))
    assert found.max_distance < 64 * EPS
    assert 7 <= found.reverse_distance <= 7.007 + 1e-8


def test_the_tails_and_the_closing_piece_count():
    line = Contour([(0, 0), (1, 0), (2, 0)], False)
    overshoots = BSplineCurve([0, 0, 1, 1], [(-3, 0), (4, 0)], 1)
    assert two_sided_distance(overshoots, line).reverse_distance == pytest.approx(3, rel=2e-3)
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    around = BSplineCurve(periodic_knots(4, 1), square, 1, periodic=True)
    assert two_sided_distance(around, Contour(square, True)).hausdorff_distance < 1e-8
    found = two_sided_distance(around, Contour(square, False))
    assert found.reverse_distance == pytest.approx(2, rel=2e-3)
    u_shape = BSplineCurve(clamped_knots(4, 1), square, 1)
    found = two_sided_distance(u_shape, Contour(square, True))
    assert found.hausdorff_distance < 1e-8  # the data points and the curve agree
    found = two_sided_distance(u_shape, Contour([*square, (0, 2)], True))
    assert found.max_distance == pytest.approx(2, abs=64 * EPS)


@pytest.mark.parametrize("periodic", [False, True])
def test_a_curve_on_its_data(periodic):
    rng = np.random.default_rng(3)
    points = np.cumsum(rng.uniform(-1, 1, (40, 2)), axis=0)
    knots = (periodic_knots if periodic else clamped_knots)(40, 1)
    curve = BSplineCurve(knots, points, 1, periodic)
    contour = Contour(points, periodic)
    found = two_sided_distance(curve, contour)
    assert found.hausdorff_distance <= FLOOR * contour.box_diagonal + 64 * EPS * 40
    assert found.rms_distance <= 64 * EPS * 40


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("shift", [(0, 0), (1e9, -1e9)])
def test_place_and_unit(scale, shift):
    if scale < 1 and shift[0]:
        return  # nothing of the shape is left in doubles there
    rng = np.random.default_rng(5)
    curve = random_curve(rng, 3, 12)
    contour = wiggle(rng, curve, 60, 0.2, False)
    there = BSplineCurve(curve.knots, scale * curve.control_points + shift, 3)
    data = Contour(scale * contour.points + shift, False)
    assert_bound(there, data)
    here, found = two_sided_distance(curve, contour), two_sided_distance(there, data)
    # Coordinates rounded at the size of the place; the bound is anywhere within 0.1 %.
    rounding = 16 * EPS * np.abs(data.points).max()
    assert abs(found.max_distance - scale * here.max_distance) <= rounding
    gap = RELATIVE_GAP * scale * here.reverse_distance
    assert abs(found.reverse_distance - scale * here.reverse_distance) <= gap + rounding


def test_more_points_than_one_block_and_duplicates_at_corners():
    contour = Contour(on_circle(5000, 3.0), True)
    start = initial_curve(contour, length=40)
    found = two_sided_distance(start.spline, contour)
    radius = np.hypot(*start.spline(np.linspace(0, 1, 5000)).T)
    assert found.max_distance == pytest.approx(np.abs(radius - 3).max(), rel=1e-3)


@pytest.mark.parametrize(
    "name", ["leaf840_closed", "hand620_closed", "loop500_n1_open", "fa_gear_c0", "naca4412"]
)
@pytest.mark.slow
def test_real_shapes(outline, name):
    contour = outline(name)
    start = initial_curve(contour, length=6)
    found, sampled = assert_bound(start.spline, contour)
    u = np.linspace(0, 1, 3000)
    reverse = directed_hausdorff(start.spline(u), contour.resampled(20_000).points)[0]
    step = contour.length / 20_000 + 1e-9
    assert found.reverse_distance >= reverse - step
    assert sampled.reverse >= reverse - step - sampled.slack


@pytest.mark.slow
def test_many_more_shapes(more_outlines):
    for folder in ("icons", "glyphs", "airfoils"):
        for _, contour in more_outlines(folder, 12):
            if 20 < len(contour) < 3000:
                assert_bound(initial_curve(contour, length=4).spline, contour)


def test_flower_and_wave():
    for contour in (flower(), wave()):
        assert_bound(initial_curve(contour, length=8).spline, contour)
