"""Knots at equal parts of what bends and of what is missed."""

import numpy as np
import pytest
from tests.support.shapes import flower, wave

from checks import distance_to_curve
from shapespline import Contour
from shapespline.engines.least_squares.starts.equidistribution import (
    balanced_start,
    bending_parameters,
)
from shapespline.values import BSplineCurve, periodic_knots


def test_bending_parameters_grow_and_spread_the_bends():
    contour = Contour([(0, 0), (10, 0), (10, 10), (0, 10)], closed=True).resampled(400)
    parameters = bending_parameters(contour)
    steps = np.diff(parameters)
    assert (steps > 0).all()
    assert 0 <= parameters[0] < parameters[-1] < 1
    # At a corner the knots lie closer than in the middle of a side.
    assert steps[100] > 1.5 * steps[50]


def test_rounds_only_improve(outline):
    contour = outline("hand620_closed")

    def cost(rounds):
        start = balanced_start(contour, 30, 3, rounds=rounds)
        return ((start.spline(start.parameters) - contour.points) ** 2).sum()

    assert cost(6) < 0.9 * cost(0)


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("degree", [1, 3, 5])
def test_parameters_stay_in_order_and_ends_where_they_are(closed, degree):
    contour = flower(200) if closed else wave(200)
    found = balanced_start(contour, 18, degree)
    assert found.spline.periodic is closed
    assert found.spline.n_control_points == 18
    # What closed data begin with may lie before the seam of the curve.
    steps = np.diff(found.parameters)
    assert (steps >= 0).all()
    assert np.ptp(found.parameters) <= 1
    if not closed:
        ends = found.spline([0.0, 1.0])
        assert ends == pytest.approx(contour.points[[0, -1]], abs=1e-12 * 20)
    off = np.hypot(*(found.spline(found.parameters) - contour.points).T)
    away = distance_to_curve(contour.points, found.spline, 0.05)
    assert (off >= away * (1 - 1e-9) - 1e-12).all()


def test_errors_are_spread_over_the_spans():
    """Half of the outline is wavy: with equal spans all of the error is there."""
    t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    r = 10 + np.where(t < np.pi, 1.5 * np.sin(8 * t) ** 2, 0.0)
    contour = Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)

    def in_halves(parameters, spline):
        off = ((spline(parameters) - contour.points) ** 2).sum(axis=1)
        return off[t < np.pi].sum() / off.sum(), off.sum()

    even = arc_length_fit(contour, 24)
    uneven_part, before = in_halves(*even)
    found = balanced_start(contour, 24, 3)
    part, after = in_halves(found.parameters, found.spline)
    assert after < 0.5 * before
    assert part < uneven_part


def arc_length_fit(contour, count):
    """Parameters in proportion to the arc length, and the least-squares curve on even knots."""
    u = contour.arc_length[: len(contour)] / contour.length
    knots = periodic_knots(count, 3)
    columns = [
        BSplineCurve(knots, np.column_stack([unit, unit]), 3, periodic=True)(u)[:, 0]
        for unit in np.eye(count)
    ]
    points = np.linalg.lstsq(np.column_stack(columns), contour.points, rcond=None)[0]
    return u, BSplineCurve(knots, points, 3, periodic=True)
