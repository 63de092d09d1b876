"""fit_curve of points with errors: known ones by sigma, wild ones by a loss."""

from __future__ import annotations

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from tests.support.shapes import flower

import shapespline as ss
from shapespline.engines.least_squares import FINAL_LIMITS, STARTS
from shapespline.fitting import Request, Settings

N, ERROR = 150, 0.05
TRUTH = flower(4000).points
RNG = np.random.default_rng(0)
SHAKEN = flower(N).points + RNG.normal(0, ERROR, (N, 2))
BAD = RNG.choice(N, 8, replace=False)
WILD = SHAKEN.copy()
WILD[BAD] += RNG.normal(0, 2.0, (8, 2))


def off(fit):
    """Root mean square distance of a curve to the truth."""
    return np.sqrt(((fit.points(500)[:, None] - TRUTH) ** 2).sum(axis=2).min(axis=1).mean())


def fitted(points, **options):
    return ss.fit_curve(points, closed=True, **options)


def test_a_given_size_is_what_optimize_makes_of_the_same_start():
    contour = ss.Contour(SHAKEN, closed=True)
    sigma = np.linspace(0.03, 0.08, N)
    fit = fitted(contour, n_control_points=20, sigma=sigma)
    weights = sigma**-2.0 / (sigma**-2.0).mean()
    start = STARTS["balanced"](contour, 20, 3, weights)
    other = ss.optimize(contour, start, sigma=sigma, stray_weight=0.0, limits=FINAL_LIMITS)
    assert_allclose(fit.control_points, other.control_points, rtol=0, atol=1e-9)
    assert_allclose(fit.covariance, other.covariance, rtol=1e-6)


def test_known_errors_choose_the_size_and_tell_a_band():
    fit = fitted(SHAKEN, sigma=ERROR)
    known = fit.uncertainty
    # Four deviations of chi squared beside its mean.
    assert abs(known.chi_squared - known.degrees_of_freedom) < 4 * np.sqrt(2 * 150)
    assert off(fit) < ERROR
    assert fit.band(0.95).half_width.max() < 4 * ERROR
    # Errors that are called ten times larger leave fewer bends proven.
    assert fitted(SHAKEN, sigma=20 * ERROR).n_control_points < fit.n_control_points


@pytest.mark.slow
@pytest.mark.parametrize("options", [{}, {"n_control_points": 24}])
def test_outliers_do_not_bend_the_curve(options):
    bent = fitted(WILD, **(options or {"form": "spline"}))
    assert off(bent) > 5 * ERROR
    assert off(fitted(WILD, loss="tukey", **options)) < ERROR
    assert off(fitted(WILD, loss="huber", sigma=ERROR, **options)) < ERROR


def test_ends_are_fitted_unless_they_are_fixed():
    x = np.linspace(0, 10, 120)
    points = np.column_stack([x, np.sin(x) + RNG.normal(0, 0.1, 120)])
    free = ss.fit_curve(points, closed=False, sigma=0.1, n_control_points=9)
    held = ss.fit_curve(points, closed=False, sigma=0.1, n_control_points=9, ends="fixed")
    assert (held.control_points[[0, -1]] == points[[0, -1]]).all()
    assert (free.control_points[[0, -1]] != points[[0, -1]]).any(axis=1).all()


def test_errors_of_outliers_leave_with_them():
    sigma = np.linspace(0.03, 0.08, N)
    request = Request.of(WILD, True, Settings(sigma=sigma, loss="tukey", outliers=True))
    assert len(request.left_out)
    assert_array_equal(request.sigma, np.delete(sigma, request.left_out))
    again = Request.from_dict(json.loads(json.dumps(request.to_dict())))
    assert again.loss == "tukey"
    assert_array_equal(again.sigma, request.sigma)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"sigma": -1.0}, "sigma must be positive and finite"),
        ({"sigma": [1.0, 2.0]}, r"sigma must be a length, or have shape \(n,\)"),
        ({"sigma": np.zeros((N, 2, 2))}, "singular"),
        ({"sigma": 0.1, "n_control_points": 80}, "no degree of freedom"),
        ({"loss": "cauchy"}, "loss must be"),
        ({"sigma": 0.1, "tolerance": 1}, "not within a tolerance"),
        ({"loss": "huber", "weights": np.ones(N)}, "not beside weights"),
        ({"sigma": 0.1, "effort": "fast"}, "effort does not act with sigma"),
    ],
)
def test_what_would_not_act_is_refused_before_any_work(monkeypatch, options, sentence):
    monkeypatch.setattr("shapespline.fitting.curve.solve", None)
    with pytest.raises(ss.InvalidInputError, match=sentence):
        fitted(SHAKEN, **options)


def test_a_shape_takes_one_length():
    shape = ss.Shape([ss.Contour(SHAKEN, True), ss.Contour(SHAKEN + 30, True)])
    drawing = ss.fit_shape(shape, sigma=ERROR, n_control_points=20)
    assert all(fit.uncertainty is not None for fit in drawing)
    with pytest.raises(ss.InvalidInputError, match="sigma must be one length for the 2 contours"):
        ss.fit_shape(shape, sigma=np.full(N, ERROR))


def test_a_callback_ends_all_rounds():
    calls = []
    fit = fitted(WILD, loss="tukey", n_control_points=20, callback=lambda r: calls.append(r) or 1)
    assert fit.status == ss.Status.CANCELLED
    assert len(calls) < 5
