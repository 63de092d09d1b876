"""Distances of the outside checker: by hand, and every pair tried."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.interpolate import BSpline, make_interp_spline

from checks import distance_to_curve, distance_to_polyline, polyline_of, two_sided

EPS = np.finfo(float).eps


def by_definition(points, polyline):
    """Distance of every point to every side, the smallest."""
    a, d = polyline[:-1], np.diff(polyline, axis=0)
    offset = points[:, None] - a
    at = np.clip((offset * d).sum(axis=2) / np.maximum((d**2).sum(axis=1), 1e-300), 0, 1)
    return np.sqrt(((offset - at[..., None] * d) ** 2).sum(axis=2)).min(axis=1)


def ring(n, radius=1.0):
    t = 2 * np.pi * np.arange(n) / n
    return radius * np.column_stack([np.cos(t), np.sin(t)])


def circle(n=64, radius=1.0):
    """A cubic through so many points of a circle, off by (2 pi / n)^4 / 384 of its radius."""
    t = np.linspace(0, 1, n + 1)
    points = radius * np.column_stack([np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)])
    points[-1] = points[0]
    return make_interp_spline(t, points, bc_type="periodic")


@pytest.mark.parametrize("seed", range(8))
def test_to_a_polyline_every_pair_tried(seed):
    rng = np.random.default_rng(seed)
    # Sides of very different lengths, some of none.
    sides = rng.normal(size=(60, 2)) * 10.0 ** rng.uniform(-3, 1, (60, 1))
    sides[::7] = 0
    polyline = np.cumsum(sides, axis=0)
    points = rng.uniform(polyline.min() - 5, polyline.max() + 5, (400, 2))
    found = distance_to_polyline(points, polyline)
    assert found == pytest.approx(by_definition(points, polyline), rel=1e-13, abs=1e-14)


def test_to_a_polyline_where_everything_is_as_near():
    polyline = ring(500)[np.r_[:500, 0]]
    away = distance_to_polyline(np.array([(0.0, 0.0), (1e-9, 0.0)]), polyline)
    assert away == pytest.approx(np.cos(np.pi / 500), abs=2e-9)
    one = distance_to_polyline(np.array([(0.0, 3.0), (4.0, 0.0)]), np.array([(0.0, 0.0), (1, 0)]))
    assert one.tolist() == [3.0, 3.0]


def test_a_circle_against_its_polygon():
    curve, n = circle(), 40
    found = two_sided(curve, ring(n), closed=True, step=0.001)
    wrong = (2 * np.pi / 64) ** 4 / 384 * 1.1
    assert found.forward <= wrong
    sagitta = 1 - np.cos(np.pi / n)
    # Short of the sagitta by what half a step hides of its top, and the cubic's own error.
    assert sagitta - 0.001**2 / 8 - wrong <= found.reverse <= sagitta + wrong
    assert found.larger == found.reverse


@pytest.mark.parametrize("off", [1e-6, 0.01, 0.3])
def test_a_moved_line_is_off_by_its_move(off):
    line = BSpline([0, 0, 1, 1], [(0.0, off), (10.0, off)], 1)
    data = np.column_stack([np.linspace(0, 10, 50), np.zeros(50)])
    found = two_sided(line, data, closed=False, step=0.01)
    assert found == pytest.approx((off, off), rel=1e-9)


def test_each_side_sees_what_the_other_misses():
    data = np.column_stack([np.linspace(0, 10, 11), np.zeros(11)])
    short = BSpline([0, 0, 1, 1], [(0.0, 0.0), (7.0, 0.0)], 1)
    assert two_sided(short, data, closed=False, step=0.01) == pytest.approx((3.0, 0.0))
    spike = BSpline(
        [0, 0, 0.5, 0.55, 0.6, 1, 1], [(0, 0), (5.2, 0), (5.5, 2), (5.8, 0), (10, 0)], 1
    )
    forward, reverse = two_sided(spike, data, closed=False, step=0.01)
    assert forward == pytest.approx(0.0, abs=1e-12)
    assert 2.0 - 0.005 <= reverse <= 2.0


def test_a_curve_of_several_parts_is_one_curve():
    square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (0.0, 0.0)]
    parts = [([0, 0, 1, 1], np.array(ends), 1) for ends in pairwise(square)]
    points = np.array([(2.0, -1.0), (5.0, 5.0), (2.0, 2.0)])
    assert distance_to_curve(points, parts, 0.01) == pytest.approx([1, np.sqrt(2), 2], rel=1e-12)
    assert len(polyline_of(parts)) == 4 * 65
    found = two_sided(parts, np.array(square[:-1]), closed=True, step=0.01)
    assert found.larger <= 8 * EPS


def test_of_two_branches_the_nearer_counts():
    # Samples of the farther branch lie nearer than those of the nearer one.
    t = np.linspace(0, 1, 400)
    curve = make_interp_spline(t, np.column_stack([np.cos(9 * t), 0.05 * np.sin(18 * t)]))
    points = np.column_stack([np.linspace(-0.9, 0.9, 77), np.full(77, 0.011)])
    dense = curve(np.linspace(0, 1, 20_001))
    expected = by_definition(points, dense)
    # Sides of 6e-4 on radii above 0.05 hide an eighth of their square over the radius.
    assert distance_to_curve(points, curve, 0.01) == pytest.approx(expected, abs=1e-6)
