"""Hooks, near-cusps, radii, inflections, turns, knots: curves of which they are known."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from checks.shape import NEAR_CUSP
from scipy.interpolate import BSpline, make_interp_spline
from tests.checks.test_distance import circle, ring

from checks import (
    data_turn,
    hooks,
    inflections,
    interval_ratio,
    smallest_radius,
    speed_ratio,
    turns,
)


def bezier(*points):
    degree = len(points) - 1
    return BSpline(np.repeat([0.0, 1.0], degree + 1), np.array(points, dtype=float), degree)


def through(points):
    """A cubic through points, the parameters by the lengths of the chords."""
    at = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    return make_interp_spline(at / at[-1], points)


def line(*corners, n=50):
    parts = [np.linspace(a, b, n, endpoint=False) for a, b in pairwise(corners)]
    return np.concatenate([*parts, [corners[-1]]])


CUSP = bezier((0, 0), (3, 2), (0, 2), (3, 0))  # x stands still at u = 1/2, and y, too
EIGHT = np.linspace(0, 2 * np.pi, 201)


# --- hooks -------------------------------------------------------------------------------------


def test_a_circle_has_no_hook_as_long_as_it_is_larger_than_the_tolerance():
    assert len(hooks(circle(), ring(60), closed=True, tolerance=0.1)) == 0
    # Within one tolerance of arc length it turns by 2 rad, the data within three by more.
    assert len(hooks(circle(), ring(60), closed=True, tolerance=2.0)) == 0


@pytest.mark.parametrize("angle", [0.0, 1.0, 2.0, 3.0, 4.0, 5.0])
def test_a_curve_that_turns_back_at_the_end_of_a_line_has_a_hook(angle):
    turned = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    tip = np.array([(9.95, 0.0), (10.02, 0.0), (10.02, 0.04), (9.95, 0.04)]) @ turned
    curve = [bezier((0, 0), tip[0]), bezier(*tip)]
    data = line((0, 0), (10, 0)) @ turned
    (place,) = hooks(curve, data, closed=False, tolerance=0.2)
    assert np.hypot(*(place - tip[2])) <= 0.2
    assert len(hooks(curve[0], data, closed=False, tolerance=0.2)) == 0


def test_a_corner_of_the_data_is_no_hook():
    corner = [(0.0, 0.0), (10.0, 0.0), (3.0, 1.0)]
    curve = [bezier(*corner[:2]), bezier(*corner[1:])]
    assert len(hooks(curve, line(*corner), closed=False, tolerance=0.2)) == 0
    assert len(hooks(curve, np.array(corner), closed=False, tolerance=0.2)) == 0
    # Without its corner the same curve has one.
    cut = line((0, 0), (9.0, 0.1), (10.0, 0.3), (9.9, 0.5))[:100]
    assert len(hooks(curve, cut, closed=False, tolerance=0.05)) == 1


@pytest.mark.parametrize(
    "way",
    [
        [(0, 0), (10, 0), (10, 5), (5, 0.1), (4, 5)],  # a corner beside a side passed before
        [(5, -5), (5, 0), (5, 3), (5, 0), (10, 0)],  # the data go to and fro, then turn
    ],
)
def test_each_pass_of_the_data_counts(way):
    data, place = np.array(way, dtype=float), np.array([(4.9, -0.1)])
    nearest, passes = (
        data_turn(data, place, closed=False, reach=1.0, near=near) for near in (0.0, 0.3)
    )
    assert nearest == pytest.approx(0.0)
    assert passes > np.radians(89)


def test_a_hook_at_the_seam_of_a_closed_curve_is_one():
    # Around a square, with a small loop out and back in the middle of the side where it begins.
    way = np.array([(5, 0), (10, 0), (10, 10), (0, 10), (0, 0), (5.02, 0.0)], dtype=float)
    back = np.array([(5.02, 0.0), (5.02, 0.01), (5.0, 0.01), (5.0, 0.0)])
    parts = [bezier(*ends) for ends in (*pairwise(way), *pairwise(back))]
    data = line((5, 0), (10, 0), (10, 10), (0, 10), (0, 0), (5, 0))[:-1]
    (place,) = hooks(parts, data, closed=True, tolerance=0.1)
    assert np.hypot(*(place - (5, 0))) <= 0.1
    way[-1] = way[0]
    square = [bezier(*ends) for ends in pairwise(way)]
    assert len(hooks(square, data, closed=True, tolerance=0.1)) == 0


def test_a_cusp_where_the_data_go_round_is_a_hook():
    data = CUSP(np.linspace(0, 1, 400))
    assert len(hooks(CUSP, data, closed=False, tolerance=0.05)) == 0
    cap = data[np.abs(np.linspace(0, 1, 400) - 0.5) > 0.2]
    assert len(hooks(CUSP, cap[:100], closed=False, tolerance=0.05)) == 1


# --- speed, radius, inflections ----------------------------------------------------------------


def test_a_circle():
    for radius in (1e-6, 1.0, 1e6):
        curve = circle(radius=radius)
        # Of the second derivative of the interpolating cubic: (2 pi / 64)^2 / 12 of it.
        assert smallest_radius(curve) == pytest.approx(radius, rel=0.002)
        assert speed_ratio(curve) == pytest.approx(1.0, rel=0.002)
        assert inflections(curve) == 0
        assert interval_ratio(curve) == pytest.approx(1.0)


def test_a_cusp_stands_still():
    assert speed_ratio(CUSP) <= NEAR_CUSP / 4
    assert smallest_radius(CUSP) < 1e-3
    # Control points a little apart: the slowest place is known by hand.
    near = bezier((0, 0), (2.9, 2), (0.1, 2), (3, 0))
    u = np.linspace(0, 1, 100_001)
    speed = np.hypot(*near(u, nu=1).T)
    assert speed_ratio(near) == pytest.approx(speed.min() / np.median(speed), rel=0.05)
    assert speed_ratio([bezier((0, 0), (1, 0)), CUSP]) == speed_ratio(CUSP)


def test_the_radius_of_a_parabola_at_its_vertex():
    parabola = bezier((-1, 1), (0, -1), (1, 1))  # y = x^2
    assert smallest_radius(parabola) == pytest.approx(0.5, rel=1e-3)
    assert smallest_radius(bezier((0, 0), (1, 1))) == np.inf


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        (np.column_stack([np.sin(EIGHT), np.sin(2 * EIGHT)])[30:-5], 1),
        (np.column_stack([np.linspace(0.3, 9.1, 300), np.sin(np.linspace(0.3, 9.1, 300))]), 2),
        (np.column_stack([np.linspace(0, 1, 50), np.linspace(0, 2, 50)]), 0),
    ],
)
def test_inflections(points, expected):
    # An eight bends the other way where it crosses, on either way; one is cut off. A sine bends the
    # other way at every pi.
    assert inflections(through(points)) == expected


def test_an_inflection_at_a_joint_counts_and_lines_do_not():
    up, down = bezier((0, 0), (1, 1), (2, 1)), bezier((3, 1), (4, 1), (5, 2))
    straight = bezier((2, 1), (3, 1))
    assert inflections([up, straight, down]) == 1
    assert inflections([straight]) == 0


# --- turns, knots ------------------------------------------------------------------------------


def test_turns_by_hand():
    corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
    square = [bezier(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
    assert turns(square, closed=True) == pytest.approx(np.full(4, np.pi / 2))
    assert turns(square[::-1][1:], closed=False).shape == (2,)
    # Control points that coincide at an end: the direction is that to the next other one.
    still = bezier((0, 0), (1, 1), (2, 1), (2, 1))
    go_on = bezier((2, 1), (2, 1), (3, 1), (4, 2))
    assert turns([still, go_on], closed=False) == pytest.approx([0.0], abs=1e-12)


def test_knots_by_hand():
    curve = BSpline([0, 0, 0, 1, 1, 4, 6, 6, 6], np.zeros((6, 2)), 2)
    assert interval_ratio(curve) == 3.0
    assert interval_ratio([curve, bezier((0, 0), (1, 1))]) == 3.0
