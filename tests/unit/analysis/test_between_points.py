"""with_points_between: the smooth curve between sparse points, chords where they tell none."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.shapes import on_circle

from shapespline.analysis.between_points import with_points_between
from shapespline.values import Contour

NONE = np.array([], dtype=np.int64)


@pytest.mark.parametrize("count", [24, 60])
@pytest.mark.parametrize("closed", [True, False])
def test_points_lie_on_the_curve_that_was_sampled(count, closed):
    contour = Contour(on_circle(count), closed)
    dense = with_points_between(contour, NONE, 1e-5, 0.1)
    assert len(dense) > 4 * count
    off = np.abs(np.hypot(*dense.points.T) - 1.0)
    # A cubic spline by chord length strays by the fourth power of the step over 384, times the
    # fourth derivative, here 1; of open data the ends are told by cubics, 9 / 16 / 24 of it.
    step = 2 * np.pi / count
    assert off.max() < step**4 * (2 / 384 if closed else 9 / 16 / 24)


def test_own_points_stay_to_the_bit():
    contour = Contour(on_circle(30), True)
    dense = with_points_between(contour, NONE, 1e-4, 0.1)
    ours = {tuple(point) for point in dense.points.tolist()}
    assert all(tuple(point) in ours for point in contour.points.tolist())


def test_corners_stay_corners():
    t = np.linspace(0, np.pi, 25)
    half_disc = np.column_stack([np.cos(t), np.sin(t)])
    contour = Contour(half_disc, closed=True)
    dense = with_points_between(contour, np.array([0, 24]), 1e-4, 0.1)
    # Nothing lies beyond the diameter.
    assert dense.points[:, 1].min() >= -1e-15
    assert len(dense) > 100


def test_a_corner_that_nobody_named_is_not_swung_around():
    x = np.linspace(-1, 1, 41)
    roof = Contour(np.column_stack([x, 1 - np.abs(x)]), closed=False)
    dense = with_points_between(roof, NONE, 1e-4, 1e-3)
    off = np.abs(dense.points[:, 1] - (1 - np.abs(dense.points[:, 0])))
    assert off.max() <= 1e-3


def test_few_points_are_left_as_they_are():
    contour = Contour([(0, 0), (1, 0.2), (2, 0)], closed=False)
    assert (with_points_between(contour, NONE, 1e-6, 1.0).points == contour.points).all()


def test_dense_points_are_left_as_they_are():
    contour = Contour(on_circle(400), True)
    # A chord's sagitta is an eighth of the second difference, h^2.
    sagitta = (2 * np.pi / 400) ** 2 / 8
    assert with_points_between(contour, NONE, 1.01 * sagitta, 0.1) is contour
    assert len(with_points_between(contour, NONE, 0.9 * sagitta, 0.1)) == 800
