"""How far points beside a slit move apart."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.testing import assert_allclose

import shapespline as ss
from shapespline.fitting.repair.assignment import DataRun
from shapespline.fitting.repair.clearance import Sides, moved


def trail(contour):
    return DataRun(contour.points, contour.arc_length[: len(contour)])


def across(contours, own, least=0.0, reach=100.0):
    return Sides(contours).across(trail(contours[own]), own, reach=reach, least=least)


def test_what_lies_across_a_slit_by_hand():
    hairpin = ss.Contour([(0, 0), (4, 0), (8, 0), (8, 1), (4, 1), (0, 1)], closed=False)
    found = across([hairpin], 0)
    # The ways around are 17, 9 and 1: the last is no slit.
    assert_allclose(found[[0, 1, 4, 5]], [(0, -1), (0, -1), (0, 1), (0, 1)])
    assert np.isinf(found[[2, 3]]).all()
    far = across([hairpin], 0, least=10.0)
    assert np.isinf(far).all(axis=1).tolist() == [False, True, True, True, True, False]
    assert np.isinf(across([hairpin], 0, reach=1.0)).all()
    # A closed one is as short the other way around; another outline is always another side.
    ring = ss.Contour(hairpin.points, closed=True)
    assert np.isinf(across([ring], 0)[0]).all()
    other = ss.Contour(hairpin.points + np.array([0, 3]), closed=False)
    assert_allclose(across([ring, other], 0)[3], (0, -2))


def test_what_lies_across_is_the_nearest_of_all_pairs():
    rng = np.random.default_rng(5)
    contours = [ss.Contour(rng.normal(size=(40, 2)), closed=closed) for closed in (True, False)]
    least, reach = 0.5, 0.2
    for own, contour in enumerate(contours):
        found = across(contours, own, least, reach)
        for k, p in enumerate(contour.points):
            best, vector = reach, np.array([np.inf, np.inf])
            for other, whose in enumerate(contours):
                for i, (a, b) in enumerate(pairwise(whose.polyline)):
                    part = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
                    off = p - a - part * (b - a)
                    way = abs(
                        whose.arc_length[i] + part * np.hypot(*(b - a)) - contour.arc_length[k]
                    )
                    if whose.closed:
                        way = min(way, whose.length - way)
                    far = np.hypot(*off)
                    if far < best and (other != own or way > max(4 * far, least)):
                        best, vector = far, off
            assert_allclose(found[k], vector, atol=1e-12)


def test_points_move_apart_and_no_farther_than_the_room():
    within, room = 0.75, 0.25
    points = np.array([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)])
    across = np.array([(0.0, 1.2), (0.0, 0.1), (np.inf, np.inf), (0.0, 9.0)])
    feet = points + np.array([(0.0, -1.0), (0.0, 1.0), (0.0, 1.0), (0.0, -0.5)])
    offsets = moved(points, feet, across, within, room) - points
    # Half the gap, 0.6, and 0.15 more than a quarter towards the curve: beyond what is missing.
    assert_allclose(offsets, [(0, 0.15), (0, 0.25), (0, 0.25), (0, -0.125)], atol=1e-15)
