"""Foot points: normal or at an end, no sample nearer, known cases."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from tests.support.reference import EPS
from tests.support.shapes import random_curve

from shapespline.errors import InvalidInputError
from shapespline.geometry.nearest import PointsByX, nearest, nearest_points, nondecreasing
from shapespline.values.curve import BSplineCurve


def dense_distances(curve, queries, per_span=400):
    u = np.concatenate([np.linspace(a, b, per_span) for a, b in pairwise(curve.breakpoints)])
    samples = curve(u)
    return np.array([np.sqrt(((samples - q) ** 2).sum(axis=1).min()) for q in queries])


@pytest.mark.parametrize("degree", range(1, 10))
@pytest.mark.parametrize("periodic", [False, True], ids=["clamped", "periodic"])
def test_no_sample_is_nearer(degree, periodic):
    rng = np.random.default_rng([degree, periodic])
    curve = random_curve(rng, degree, degree + 7, periodic=periodic)
    queries = rng.uniform(-14, 14, (150, 2))
    found = nearest(curve, queries)
    distance = np.sqrt(found.distances_sq)
    begin, end = curve.domain
    assert ((found.parameters >= begin) & (found.parameters <= end)).all()
    # The distance is that of the curve point at the parameter. Beziers and the curve differ by
    # 10 p roundings of coordinates up to 14 each; the parameter is rounded, too.
    speed = curve(np.linspace(begin, end, 300), 1)
    off = 20 * degree * EPS * 14 + 2 * EPS * np.hypot(*speed.T).max() * 2
    actual = np.hypot(*(curve(found.parameters) - queries).T)
    assert np.abs(actual - distance).max() <= off
    assert (distance <= dense_distances(curve, queries) + off).all()


@pytest.mark.parametrize("degree", [2, 3, 5, 9])
def test_the_residual_is_normal_to_the_curve_or_the_foot_is_an_end_or_corner(degree):
    rng = np.random.default_rng(degree)
    curve = random_curve(rng, degree, degree + 6, multiple=False)
    queries = rng.uniform(-14, 14, (200, 2))
    u, _ = nearest(curve, queries)
    residuals, tangents = curve(u) - queries, curve(u, 1)
    speed = np.hypot(*tangents.T)
    slope = np.abs((residuals * tangents).sum(axis=1))
    bend = np.abs((residuals * curve(u, 2)).sum(axis=1)) + speed**2
    # Newton's method stops where the parameter no longer moves by rounding, or after 8 steps with
    # a quadratic convergence that has passed 1e-8 before: then within 1e-8 of the parameter's.
    at_end = (u == 0) | (u == 1)
    assert (slope[~at_end] <= 1e-8 * bend[~at_end]).all()
    assert 5 < at_end.sum() < 150
    outwards = np.where(u == 0, 1, -1) * (residuals * tangents).sum(axis=1)
    assert (outwards[at_end] >= 0).all()


def test_by_hand():
    corner = BSplineCurve([0, 0, 0.5, 1, 1], [(0, 0), (2, 0), (2, 2)], 1)
    queries = [(1, -3), (5, -4), (2, 1), (-1, 0), (3, 9), (1, 0.25)]
    u, distances_sq = nearest(corner, queries)
    assert u.tolist() == [0.25, 0.5, 0.75, 0, 1, 0.25]
    assert distances_sq.tolist() == [9, 25, 0, 1, 50, 0.0625]


def test_points_of_the_curve_find_themselves():
    curve = random_curve(np.random.default_rng(7), 3, 12, multiple=False)
    u = np.linspace(0, 1, 101)
    found = nearest(curve, curve(u))
    assert np.sqrt(found.distances_sq).max() <= 40 * EPS * 10
    assert np.abs(curve(found.parameters) - curve(u)).max() <= 80 * EPS * 10


def test_branches_that_come_near_are_told_apart():
    # A hairpin whose arms are 0.02 apart: a local search would keep to its arm.
    hairpin = BSplineCurve(
        [0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1],
        [(0, 0.01), (10, 0.01), (20, 0.01), (20, -0.01), (10, -0.01), (0, -0.01)],
        2,
    )
    x = np.repeat(np.linspace(0.5, 12, 40), 2)
    y = np.tile([0.003, -0.003], 40)
    found = nearest(hairpin, np.column_stack([x, y]))
    assert (np.sign(hairpin(found.parameters)[:, 1]) == np.sign(y)).all()
    assert np.sqrt(found.distances_sq).max() == pytest.approx(0.007, abs=1e-12)


def test_the_centre_of_a_circle_like_arc():
    # The quarter circle's usual cubic: all distances from the centre within 2.8e-4 of 1.
    k = 4 / 3 * np.tan(np.pi / 8)
    arc = BSplineCurve([0] * 4 + [1] * 4, [(1, 0), (1, k), (k, 1), (0, 1)], 3)
    found = nearest(arc, [(0, 0)])
    assert np.sqrt(found.distances_sq[0]) <= dense_distances(arc, [(0, 0)], 4000)[0] + 8 * EPS


def test_a_cusp_and_a_curve_that_stands_still():
    cusp = BSplineCurve([0] * 4 + [1] * 4, [(0, 0), (1, 1), (0, 1), (1, 0)], 3)
    found = nearest(cusp, [(0.5, 2.0), (0.5, 0.75)])
    assert_array_equal(found.parameters, [0.5, 0.5])
    assert found.distances_sq.tolist() == [1.25**2, 0]
    still = BSplineCurve([0, 0, 0.5, 1, 1], [(1, 1), (1, 1), (1, 1)], 1)
    assert nearest(still, [(4, 5)]).distances_sq.tolist() == [25]


def test_far_from_the_curve():
    curve = random_curve(np.random.default_rng(1), 3, 9)
    queries = np.array([(1e8, 0), (0, -1e8), (-3e7, 4e7)])
    distance = np.sqrt(nearest(curve, queries).distances_sq)
    assert (distance <= dense_distances(curve, queries) * (1 + 8 * EPS)).all()


@pytest.mark.slow
@given(st.integers(0, 10**6), st.integers(1, 5), st.booleans())
def test_each_query_alone_gives_the_same(seed, degree, periodic):
    rng = np.random.default_rng(seed)
    curve = random_curve(rng, degree, degree + 4, periodic=periodic)
    queries = rng.uniform(-12, 12, (20, 2))
    together = nearest(curve, queries)
    alone = np.array([np.ravel(nearest(curve, [q])) for q in queries])
    # The hint changes the order of the search: equal distances may have two foot points.
    assert np.abs(alone[:, 1] - together.distances_sq).max() <= 1e-12 * 24**2


def test_one_point_and_none():
    line = BSplineCurve([0, 0, 1, 1], [(0, 0), (4, 0)], 1)
    assert nearest(line, np.empty((0, 2))).parameters.shape == (0,)
    assert nearest(line, [(1, 0)]).parameters.tolist() == [0.25]


@pytest.mark.parametrize("bad", [[(0.0, np.nan)], np.zeros((2, 3)), [("a", "b")]])
def test_bad_queries(bad):
    line = BSplineCurve([0, 0, 1, 1], [(0, 0), (4, 0)], 1)
    with pytest.raises(InvalidInputError, match="points must"):
        nearest(line, bad)


# --- order -------------------------------------------------------------------------------------


def test_nondecreasing_by_hand():
    ordered = np.array([0.0, 0.2, 0.2, 0.9])
    assert nondecreasing(ordered) is ordered
    assert nondecreasing(np.array([0.3, 0.1, 0.2])).tolist() == [0.1, 0.2, 0.3]
    assert nondecreasing(np.array([0.9, 1.2, 1.1]), 1.0).tolist() == [0.9, 1.1, 1.2]
    assert nondecreasing(np.array([0.0, 0.5, 1.25]), 1.0).tolist() == [0, 0.5, 1]


@given(st.lists(st.floats(-2, 2), min_size=1, max_size=30))
def test_sorting_moves_least(values):
    values = np.array(values)
    found = nondecreasing(values)
    assert (np.diff(found) >= 0).all()
    assert_array_equal(np.sort(values), found)
    # Any other non-decreasing rearrangement or running maximum moves more in the maximum norm.
    assert np.abs(found - values).max() <= np.abs(np.maximum.accumulate(values) - values).max()
    within = nondecreasing(values, 1.0)
    assert (np.diff(within) >= 0).all()
    assert within[-1] <= within[0] + 1


def test_points_of_an_uneven_curve_lie_on_it():
    """Where the speed changes a thousandfold within a piece Newton's method needs its time.

    With 8 steps a point was missed by 2e-3 of a curve 25 long.
    """
    curve = random_curve(np.random.default_rng(0), 5, 8, multiple=False)
    points = curve(np.linspace(0, 1, 200))
    assert np.sqrt(nearest(curve, points).distances_sq).max() < 1e-12


@pytest.mark.parametrize("step", [1, -1])
def test_a_piece_that_turns_back_beside_its_end_has_no_foot_there_alone(step):
    # Whoever came from the points before began at the end, a minimum of its own, and stayed there.
    turned = [(-7e-5, -4e-5), (-5.6e-4, 6e-5), (2.354, -3e-5)]
    curve = BSplineCurve([0, 0, 0, 1, 1, 1], turned, degree=2)
    x = np.linspace(0, 2.3, 20)[::step]
    found = nearest(curve, np.column_stack([x, 0 * x]))
    assert np.sqrt(found.distances_sq.max()) < 1e-4


@pytest.mark.parametrize("seed", range(5))
def test_the_nearest_of_points_is_the_first_of_all_as_near(seed):
    rng = np.random.default_rng(seed)
    # On a lattice many are as near; far beside it none of the first looked at is.
    points = rng.integers(0, 12, (300, 2)).astype(float)
    places = np.concatenate([rng.uniform(-5, 17, (40, 2)), points[:10]])
    found = nearest_points(points, places)
    far = np.hypot(*(points - places[:, None]).transpose(2, 0, 1))
    assert (found.indices == far.argmin(axis=1)).all()
    assert (found.distances == far.min(axis=1)).all()


def test_points_between_are_in_their_order():
    points = np.random.default_rng(0).uniform(0, 1, (50, 2))
    found = PointsByX.of(points).between(0.2, 0.7)
    assert (found == points[(points[:, 0] >= 0.2) & (points[:, 0] <= 0.7)]).all()
