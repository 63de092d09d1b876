"""Hooks beside data, by hand and by the outside check."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.shapes import flower

import checks
from shapespline.geometry import chords_for_hooks, hooks
from shapespline.values import BSplineCurve

STRAIGHT = np.array([(0.0, 0.0), (10.0, 0.0)])


@pytest.mark.parametrize("tolerance", [0.05, 0.2, 1.0])
@pytest.mark.parametrize("degrees", [60, 89, 91, 170])
def test_a_turn_is_a_hook_beyond_a_right_angle(degrees, tolerance):
    angle = np.radians(degrees)
    way = np.array([(0.0, 0.0), (5.0, 0.0), (5.0 + np.cos(angle), np.sin(angle))])
    assert len(hooks(way, STRAIGHT, tolerance, closed=False)) == (degrees > 90)


@pytest.mark.parametrize("degrees", [88, 96, 110])
def test_a_bend_is_one_however_long_the_curve_is(degrees):
    # Chords that go by the distance from the curve alone are few where a long curve bends.
    half = np.radians(degrees / 2)
    before, after = -np.array([np.cos(half), np.sin(half)]), np.array([np.cos(half), -np.sin(half)])
    control = [200 * before, 100 * before, 0.7 * before, (0, 0)]
    control += [0.7 * after, 100 * after, 200 * after]
    bent = BSplineCurve([0, 0, 0, 1, 1, 2, 2, 3, 3, 3], control, degree=2)
    data = np.array([(-900.0, 0.0), (900.0, 0.0)])
    assert len(hooks(chords_for_hooks(bent, 1.0), data, 1.0, closed=False)) == (degrees > 90)


def test_a_turn_with_the_data_is_none():
    corner = np.array([(0.0, 0.0), (5.0, 0.0), (4.0, 1.0)])
    assert len(hooks(corner, corner, 1.0, closed=False)) == 0
    assert len(hooks(corner, STRAIGHT, 1.0, closed=False)) == 1
    # A turn in steps that are longer than the tolerance is none either.
    wide = np.array([(0.0, 0.0), (5.0, 0.0), (5.0, 2.0), (3.0, 2.0)])
    assert len(hooks(wide, STRAIGHT, 1.0, closed=False)) == 0
    assert len(hooks(wide, np.array([(3.0, 3.0)]), 9.0, closed=False)) == 0


@pytest.mark.parametrize("folded", [False, True])
@pytest.mark.parametrize("at", [40, 55, 130, 145])
def test_as_many_as_the_outside_check_finds(at, folded):
    data = flower(300).polyline
    tolerance = 0.01 * float(np.hypot(*np.ptp(data, axis=0)))
    ahead = (data[at + 1] - data[at]) / np.hypot(*(data[at + 1] - data[at]))
    left = np.array([-ahead[1], ahead[0]])
    fold = data[at] + tolerance * np.array([[0.3], [0.1]]) * (left - ahead)
    way = np.concatenate([data[: at + 1], fold if folded else fold[:0], data[at + 1 :]])
    knots = np.concatenate([[0], np.arange(len(way)), [len(way) - 1]])
    seen = checks.hooks((knots, way, 1), flower(300).points, closed=True, tolerance=tolerance)
    assert bool(len(seen)) == folded
    assert bool(len(hooks(way, data, tolerance, closed=True))) == folded


def test_where_data_pass_twice_the_pass_that_turns_counts():
    fold = np.array([(0.0, 0.0), (5.0, 0.0), (5.0, 0.4), (0.0, 0.4)])
    passing = np.array([(9.0, 0.1), (-3.0, 0.1)])
    beside = np.concatenate([passing, [(-3.0, -9.0)], fold - (0.0, 0.2)])
    assert len(hooks(fold, passing, 1.0, closed=False)) == 1
    assert len(hooks(fold, beside, 1.0, closed=False)) == 0


def test_a_hook_at_the_seam_of_a_closed_curve():
    ring = flower(300).polyline
    tolerance = 0.01 * float(np.hypot(*np.ptp(ring, axis=0)))
    ahead = (ring[1] - ring[0]) / np.hypot(*(ring[1] - ring[0]))
    spur = ring[0] - 0.4 * tolerance * ahead
    way = np.concatenate([[spur], ring[:-1], [spur + 0.1 * tolerance * ahead, spur]])
    assert len(hooks(ring, ring, tolerance, closed=True)) == 0
    places = hooks(way, ring, tolerance, closed=True)
    assert len(places) > 0
    assert np.hypot(*(places - ring[0]).T).max() < tolerance


def test_a_stroke_that_ends_where_it_began_has_no_seam():
    # Its ends meet at an angle, which excuses no hook beside its first point.
    stroke = np.array([(0.0, 0.0), (9.0, 0.0), (9.0, 0.4), (0.0, 0.0)])
    way = np.concatenate([[(0.0, 0.0), (0.5, 0.1), (0.3, 0.1)], stroke[1:]])
    assert len(hooks(way, stroke, 1.0, closed=False)) > 0
    assert len(hooks(way, stroke, 1.0, closed=True)) == 0
