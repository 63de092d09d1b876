"""The smoothing start: as many control points as the detail needs."""

from __future__ import annotations

import numpy as np

from shapespline import Contour
from shapespline.engines.least_squares.smoothing import cheapest, sizes_tried, smoothed_to
from shapespline.monitor import Monitor


def test_the_size_grows_with_the_detail():
    def size(petals):
        t = 2 * np.pi * np.arange(400) / 400
        r = 10 + np.cos(petals * t)
        points = np.column_stack([r * np.cos(t), r * np.sin(t)])
        points += np.random.default_rng(1).normal(0, 0.05, points.shape)
        tried = sizes_tried(Contour(points, closed=True), 3, 0.05, monitor=Monitor())
        return cheapest(tried).n_control_points

    assert size(0) < size(3) < size(12)


def test_points_that_scatter_along_the_curve_cost_what_they_are_away():
    # A wing of 4 exact control points, its points by 3 of their steps out of place. A point of n
    # costs 1 in the mean, sqrt(2 / n) one standard deviation of it; a curve of so few control
    # points takes less than 20 of the n = 5000.
    t = np.linspace(0, 1, 5000)[:, None]
    ends = [(0.0, 0.0), (30.0, 60.0), (60.0, 40.0), (100.0, 0.0)]
    bernstein = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    points = sum(b * np.array([p]) for b, p in zip(bernstein, ends, strict=True))
    noise = 3 * np.hypot(*np.diff(points, axis=0).T).mean()
    points += np.random.default_rng(2).normal(0, noise, points.shape)
    wing = Contour(points, closed=False)
    fits = [smoothed_to(size, wing, 3, noise, monitor=Monitor()) for size in (4, 7, 10, 14)]
    away = np.array([fit.cost - 3.5 * fit.n_control_points for fit in fits])
    assert (np.abs(away - 5000) < 5 * np.sqrt(2 * 5000) + 20).all()


def test_a_run_goes_on_beyond_its_ends_as_the_polynomial_that_it_is():
    t = np.linspace(0, 1, 200)
    run = Contour(np.column_stack([10 * t, 10 * t**3]), closed=False)
    found = smoothed_to(5, run, 3, 0.001, monitor=Monitor())
    for end, beyond in ((0, -0.05), (-1, 0.05)):
        coefficients = found.continued(end)
        x, y = beyond ** np.arange(len(coefficients)) @ coefficients
        assert abs(y - 10 * (x / 10) ** 3) < 0.01
        direction = found.tangent(end)
        slope = coefficients[1] / np.hypot(*coefficients[1])
        assert np.abs(slope - direction).max() < 1e-12
