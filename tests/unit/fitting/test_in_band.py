"""Clean points without a tolerance: the curve through them; noise makes it no better."""

from __future__ import annotations

import numpy as np
import pytest

import shapespline as ss
from shapespline.analysis import resolution
from shapespline.geometry import nearest
from shapespline.values import Contour


def ellipse(t):
    return np.column_stack([50 * np.cos(t), 30 * np.sin(t)])


def wave(t):
    radius = 40 + 5 * np.sin(5 * t + 0.3)
    return radius[:, None] * np.column_stack([np.cos(t), 0.8 * np.sin(t)])


def rms_to_truth(curve, points):
    """Of the curve that was found from the truth, dense."""
    fit = ss.fit_curve(points, closed=True)
    truth = curve(np.linspace(0, 2 * np.pi, 2000, endpoint=False))
    return float(np.sqrt(nearest(fit.spline, truth).distances_sq.mean()))


@pytest.mark.parametrize("curve", [ellipse, wave])
@pytest.mark.parametrize("count", [100, 500])
def test_cleaner_data_never_give_a_worse_curve(curve, count):
    points = curve(np.linspace(0, 2 * np.pi, count, endpoint=False))
    rng = np.random.default_rng(0)
    errors = [
        rms_to_truth(curve, points + rng.normal(0, noise, points.shape))
        for noise in (0.0, 0.05, 0.2)  # up to 0.2 % of the size
    ]
    assert errors == sorted(errors)


def test_sparse_points_are_followed_nearer_than_their_chords():
    points = ellipse(np.linspace(0, 2 * np.pi, 100, endpoint=False))
    contour = Contour(points, closed=True)
    shown = resolution(contour)
    assert shown.clean
    assert shown.told < shown.band
    fit = ss.fit_curve(contour)
    off = float(np.sqrt(nearest(fit.spline, points).distances_sq.max()))
    # Points between them are exact to far less.
    assert off <= 1.001 * shown.told
    # So near to the chords there is a polygon only.
    sagitta = 50 * (1 - np.cos(np.pi / 100))
    assert fit.hausdorff_distance > 0.9 * sagitta > shown.told
    assert fit.n_stored_points < 16


@pytest.mark.parametrize("curve", [ellipse, wave])
def test_start_and_direction_change_nothing(curve):
    points = curve(np.linspace(0, 2 * np.pi, 120, endpoint=False))
    fit = ss.fit_curve(points, closed=True)
    for other in (np.roll(points, 37, axis=0), points[::-1]):
        again = ss.fit_curve(other, closed=True)
        assert again.n_stored_points == fit.n_stored_points
        ours = sorted(map(tuple, fit.spline.control_points.tolist()))
        assert sorted(map(tuple, again.spline.control_points.tolist())) == ours
