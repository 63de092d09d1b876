"""The smoothing start: as many control points as the detail needs."""

from __future__ import annotations

import numpy as np

from shapespline import Contour
from shapespline.engines.least_squares.smoothing import smoothed
from shapespline.monitor import Monitor


def test_the_size_grows_with_the_detail():
    def size(petals):
        t = 2 * np.pi * np.arange(400) / 400
        r = 10 + np.cos(petals * t)
        points = np.column_stack([r * np.cos(t), r * np.sin(t)])
        points += np.random.default_rng(1).normal(0, 0.05, points.shape)
        return smoothed(Contour(points, closed=True), 3, 0.05, monitor=Monitor()).n_control_points

    assert size(0) < size(3) < size(12)
