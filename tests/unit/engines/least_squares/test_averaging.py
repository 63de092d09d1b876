"""The mean of smooth curves of several sizes."""

from __future__ import annotations

import numpy as np
import pytest

from checks import distance_to_polyline
from shapespline import Contour
from shapespline.engines.least_squares import averaging
from shapespline.engines.least_squares.averaging import DEARER, WITHIN, averaged
from shapespline.engines.least_squares.smoothing import sizes_tried, smoothed_to
from shapespline.geometry import nearest
from shapespline.monitor import Monitor

NOISE = 0.3


def petals(n, noise, seed=0, closed=True):
    """An outline of which few noisy points do not tell how many control points it takes."""
    t = np.linspace(0, 2 * np.pi if closed else 1.5 * np.pi, n, endpoint=not closed)
    r = 10 + np.cos(5 * t) + 0.5 * np.cos(9 * t)
    points = np.column_stack([r * np.cos(t), r * np.sin(t)])
    points += np.random.default_rng(seed).normal(0, noise, points.shape)
    return Contour(points, closed)


def found_of(contour):
    return sizes_tried(contour, 3, NOISE, monitor=Monitor())


def rms(curve, truth):
    return np.sqrt(nearest(curve, truth.points).distances_sq.mean())


@pytest.mark.parametrize("closed", [True, False])
def test_the_mean_of_curves_is_between_them(closed):
    contour = petals(100, NOISE, closed=closed)
    first, second = (smoothed_to(m, contour, 3, NOISE, monitor=Monitor()) for m in (16, 20))
    # As dear as each other they count alike, and so much cheaper than others that these do not.
    pair = [first._replace(cost=-1e6), second._replace(cost=-1e6)]
    mean = averaged(pair, contour, 3, NOISE, monitor=Monitor())
    places = np.linspace(0, 1, len(mean.outline.points) + closed)[: len(mean.outline.points)]
    half = 0.5 * np.sqrt(nearest(second.start.spline, first.start.spline(places)).distances_sq)
    assert half.max() > 0.1 * NOISE
    for one in pair:
        away = np.sqrt(nearest(one.start.spline, mean.outline.points).distances_sq)
        assert (away <= half * (1 + 1e-9)).all()


def test_one_spline_tells_the_mean_within_a_part_of_its_error():
    contour = petals(100, NOISE)
    tried = found_of(contour)
    mean = averaged(tried, contour, 3, NOISE, monitor=Monitor())
    size = min(tried, key=lambda one: one.cost).n_control_points
    assert rms(mean.start.spline, mean.outline) <= WITHIN * NOISE * np.sqrt(size / 100)
    assert size <= mean.start.spline.n_control_points <= 1.6 * size


def test_what_costs_far_more_counts_for_nothing():
    contour = petals(100, NOISE)
    first, second = found_of(contour)[-2:]
    far = second._replace(cost=first.cost + DEARER * np.log(1.1e3))
    assert averaged([first, far], contour, 3, NOISE, monitor=Monitor()) is None


def test_a_straight_line_is_no_mean():
    x = np.linspace(0, 100, 100)
    points = np.column_stack([x, np.zeros(100)])
    points += np.random.default_rng(1).normal(0, NOISE, points.shape)
    contour = Contour(points, closed=False)
    assert averaged(found_of(contour), contour, 3, NOISE, monitor=Monitor()) is None


def test_the_mean_is_nearer_than_the_cheapest():
    truth = petals(1000, 0.0)
    ratios = []
    for seed in range(16):
        contour = petals(100, NOISE, seed)
        tried = found_of(contour)
        cheapest = min(tried, key=lambda one: one.cost).start.spline
        mean = averaged(tried, contour, 3, NOISE, monitor=Monitor())
        ratios.append(np.log(rms(mean.start.spline, truth) / rms(cheapest, truth)))
    # By more than two standard errors of the draws.
    assert np.mean(ratios) + 2 * np.std(ratios) / np.sqrt(len(ratios)) < 0.0


def test_where_a_closed_curve_begins_moves_its_mean_less_with_knots_moved_on(monkeypatch):
    def apart(parts):
        """Between the means of the same points begun half a span on, over seeds."""
        monkeypatch.setattr(averaging, "MOVED", parts)
        found = []
        for seed in range(8):
            contour = petals(100, NOISE, seed)
            later = Contour(np.roll(contour.points, -3, axis=0), closed=True)
            one, other = (
                averaged(found_of(c), c, 3, NOISE, monitor=Monitor()).outline
                for c in (contour, later)
            )
            found.append(np.sqrt((distance_to_polyline(one.points, other.polyline) ** 2).mean()))
        return np.array(found)

    moved, kept = apart(averaging.MOVED), apart(())
    assert np.median(moved / kept) < 0.75
