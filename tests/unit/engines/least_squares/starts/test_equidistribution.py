"""Knots at equal parts of what bends and of what is missed."""

import numpy as np

from shapespline import Contour
from shapespline.engines.least_squares.starts.equidistribution import (
    balanced_start,
    bending_parameters,
)


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
