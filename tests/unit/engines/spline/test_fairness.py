"""How fair a spline is, against the outside checker and by hand."""

import numpy as np
import pytest
from tests.support.make_fit import blob, wave
from tests.support.shapes import flower

import shapespline as ss
from checks import interval_ratio, polyline_of, self_crossings, speed_ratio
from shapespline.engines.spline import Fairness, fairness_of
from shapespline.engines.spline.fairness import INTERVAL_RATIO, SPEED_RATIO
from shapespline.values import BSplineCurve, Contour, clamped_knots


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("make", [blob, wave])
def test_as_an_outside_checker_finds(make, seed):
    curve = make(11, seed=seed)
    found = fairness_of(curve, flower())
    assert found.interval_ratio == pytest.approx(interval_ratio(curve), rel=1e-12)
    # The samples of the two lie elsewhere, 64 a span.
    assert found.speed_ratio == pytest.approx(speed_ratio(curve), rel=0.05)
    assert found.n_crossings == self_crossings(polyline_of(curve, 0.01))
    assert found.n_data_crossings == 0


def test_crossings_are_those_of_the_data_or_too_many():
    t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    eight = Contour(np.column_stack([np.sin(t), np.sin(2 * t)]), closed=True)
    loop = [(0, 0), (6, 6), (6, -6), (0, 6), (-6, -6), (-6, 6), (0, 0)]
    curve = BSplineCurve(clamped_knots(7, 3), loop, 3)
    assert fairness_of(curve, eight).n_data_crossings == 1
    n = fairness_of(curve, flower()).n_crossings
    assert n == self_crossings(polyline_of(curve, 0.01)) > 0
    assert not fairness_of(curve, flower()).kept


def test_a_near_cusp_is_not_fair_and_a_corner_is_no_cusp():
    way = [(0.0, 0.0), (3.0, 2.0), (0.0, 2.0), (3.0, 0.0)]
    cusp = BSplineCurve(clamped_knots(4, 3), way, 3)
    assert fairness_of(cusp, flower()).speed_ratio < SPEED_RATIO
    corner = BSplineCurve(clamped_knots(3, 1, [0.5]), [(0, 0), (1, 0), (1, 1)], 1)
    assert fairness_of(corner, flower()).speed_ratio == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("fairness", "kept"),
    [
        (Fairness(INTERVAL_RATIO, SPEED_RATIO, 1, 1), True),
        (Fairness(1.01 * INTERVAL_RATIO, 1.0, 0, 0), False),
        (Fairness(1.0, 0.99 * SPEED_RATIO, 0, 0), False),
        (Fairness(1.0, 1.0, 2, 1), False),
        (Fairness(1.0, 1.0, 0, 1), True),
    ],
)
def test_the_rule(fairness, kept):
    assert fairness.kept is kept


@pytest.mark.parametrize("degree", range(1, 10))
def test_a_curve_of_one_span_is_as_fair_as_any(degree):
    """It has fewer knots than a corner inside a curve of that degree takes."""
    x = np.linspace(0.0, 1.0, degree + 1)
    points = np.column_stack([x, 0 * x])
    curve = BSplineCurve(np.repeat([0.0, 1.0], degree + 1), points, degree)
    found = fairness_of(curve, Contour(np.column_stack([x, 0 * x]), closed=False))
    assert found.speed_ratio == pytest.approx(1.0)
    assert found.n_crossings == 0


def test_an_open_path_that_ends_where_it_began_is_fitted_by_one_span():
    path = np.array([(0.0, 0.0), (0.0, 1.0), (2.0, 0.0), (0.0, 0.0)])
    fit = ss.fit_curve(
        path, closed=False, tolerance=0.005 * 5**0.5, effort="fast", degree=5, corners="free"
    )
    assert fit.kept


def test_a_curve_may_be_slow_into_its_own_corners():
    """Two cubics, each at rest where they meet: beyond a twentieth of each they are 0.29 fast."""
    arm = np.array([0.0, 0.0, 1.0, 2.0])
    points = np.concatenate(
        [np.column_stack([arm[::-1], 0 * arm]), np.column_stack([0 * arm, arm])[1:]]
    )
    knots = np.repeat([0.0, 0.5, 1.0], [4, 3, 4])
    data = np.array([(2.0, 0.0), (0.0, 0.0), (0.0, 2.0)])
    found = fairness_of(BSplineCurve(knots, points, 3), Contour(data, closed=False))
    t = (np.arange(64) + 0.5) / 64
    speed = 6 * t * (1 - t) + 3 * t**2
    assert found.speed_ratio == pytest.approx(speed[t > 0.05].min() / np.median(speed), rel=0.02)
