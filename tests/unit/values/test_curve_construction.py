"""What a BSplineCurve is made from and holds: its attributes, scipy's splines to and fro, clamped,
unclamped or periodic, and the knots, control points and parameters it refuses.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from scipy.interpolate import BSpline, splprep
from tests.support.reference import EPS
from tests.support.shapes import closures, degrees, on_circle, some_curve

from shapespline.errors import InvalidInputError, OrderError
from shapespline.values.curve import BSplineCurve
from shapespline.values.knots import clamped_knots, periodic_knots

# --- attributes --------------------------------------------------------------------------------


def test_attributes():
    ring = BSplineCurve(periodic_knots(4, 2), np.eye(4, 2), 2, periodic=True)
    assert ring.n_control_points == 4
    assert ring.coefficients.tolist() == ring.control_points[[0, 1, 2, 3, 0, 1]].tolist()
    assert ring.domain == (0, 1)
    assert ring.breakpoints.tolist() == [0, 0.25, 0.5, 0.75, 1]
    assert ring.greville.tolist() == [-0.125, 0.125, 0.375, 0.625]
    for array in (ring.knots, ring.control_points):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def test_the_curve_owns_its_arrays():
    knots, points = np.array([0.0, 0, 1, 1]), np.array([[0.0, 0], [1, 1]])
    curve = BSplineCurve(knots, points, 1)
    knots[:], points[:] = 7, 7
    assert curve(0.5).tolist() == [[0.5, 0.5]]


# --- scipy -------------------------------------------------------------------------------------


@degrees
@closures
def test_to_scipy_and_back_changes_nothing(degree, periodic):
    curve = some_curve(degree, periodic)
    back = BSplineCurve.from_scipy(curve.to_scipy())
    assert_array_equal(back.knots, curve.knots)
    assert_array_equal(back.control_points, curve.control_points)
    assert (back.degree, back.periodic) == (degree, periodic)


@degrees
def test_a_periodic_curve_is_periodic_in_scipy(degree):
    curve = some_curve(degree, periodic=True)
    u = np.arange(16) / 16
    scale = degree * np.abs(curve.control_points).max() * 8 * EPS
    assert np.abs(curve.to_scipy()(u + 3) - curve(u)).max() <= scale


@degrees
@pytest.mark.parametrize("seed", range(4))
def test_unclamped_splines_are_clamped_by_knot_insertion(degree, seed):
    rng = np.random.default_rng([degree, seed])
    n = degree + 1 + int(rng.integers(0, 9))
    knots = np.arange(n + degree + 1) + rng.uniform(0, 0.9, n + degree + 1)
    if seed == 3 and n > degree + 2:  # a double knot at an end of the domain
        knots[degree + 1] = knots[degree] if degree > 1 else knots[degree + 1]
        knots[n - 1] = knots[n] if degree > 1 else knots[n - 1]
    spline = BSpline(knots, rng.uniform(-1, 1, (n, 2)), degree)
    curve = BSplineCurve.from_scipy(spline)
    assert curve.domain == (knots[degree], knots[n])
    assert not curve.periodic
    # scipy reads the end of the domain in an empty span if its knot is double.
    u = np.linspace(*curve.domain, 60)[:-1]
    # At most 2 p insertions of 4 roundings of convex combinations, and both evaluations.
    off = (8 * degree + 2 * (7 * degree + 3)) * EPS
    assert np.abs(curve(u) - spline(u)).max() <= off


@pytest.mark.parametrize("smoothing", [0, 0.01])
@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
def test_splprep_of_closed_data(degree, smoothing):
    points = on_circle(41, 2.0)
    points = np.concatenate([points, points[:1]])
    (knots, columns, k), _ = splprep(points.T, k=degree, s=smoothing, per=1)
    spline = BSpline(knots, np.column_stack(columns), k)
    curve = BSplineCurve.from_scipy(spline)
    u = np.linspace(0, 1, 200)
    assert np.abs(curve(u) - spline(u)).max() <= 2 * (8 * degree + 2 * (7 * degree + 3)) * EPS
    periodic = BSplineCurve.from_scipy(
        BSpline(knots, np.column_stack(columns), k, extrapolate="periodic")
    )
    # With fewer control points than a span needs it cannot be one of ours.
    assert periodic.periodic == (len(knots) - 2 * degree - 1 > degree)
    assert np.abs(periodic(u) - spline(u)).max() <= 2 * (8 * degree + 2 * (7 * degree + 3)) * EPS


def test_scipy_splines_with_spare_coefficients_or_other_dimensions():
    knots = clamped_knots(5, 3)
    padded = np.zeros((9, 2))
    padded[:5] = np.arange(10).reshape(5, 2)
    curve = BSplineCurve.from_scipy(BSpline(knots, padded, 3))
    assert_array_equal(curve.control_points, padded[:5])
    with pytest.raises(InvalidInputError, match=r"spline must have plane values.*\(5, 2\)"):
        BSplineCurve.from_scipy(BSpline(knots, np.zeros((5, 3)), 3))
    with pytest.raises(InvalidInputError, match="degree must be an integer from 1 to 9, got 0"):
        BSplineCurve.from_scipy(BSpline([0, 1, 2], np.zeros((2, 2)), 0))


def test_a_spline_that_extrapolates_periodically_but_does_not_close_is_clamped():
    spline = BSpline(periodic_knots(6, 3), np.eye(9, 2), 3, extrapolate="periodic")
    curve = BSplineCurve.from_scipy(spline)
    assert not curve.periodic
    u = np.arange(50) / 50
    assert np.abs(curve(u) - spline(u)).max() <= (8 * 3 + 2 * (7 * 3 + 3)) * EPS


# --- errors ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("knots", "points", "degree", "error", "message"),
    [
        ([0, 0, 1, 1], [(0, 0)], 1, InvalidInputError, r"shape \(2, 2\) for 4 knots .* \(1, 2\)"),
        ([0, 0, 1, 1], [0, 1], 1, InvalidInputError, r"control_points must have shape \(2, 2\)"),
        ([0, 0, 1, 1], [(0, 0), (np.nan, 0)], 1, InvalidInputError, "control_points must be fin"),
        ([0, 0, 1, 1], [(0, 0), (0, 1)], 0, InvalidInputError, "degree must be"),
        ([0, 1, 0, 1], [(0, 0), (0, 1)], 1, OrderError, "knots must not decrease"),
        (["a", 0, 1, 1], [(0, 0), (0, 1)], 1, InvalidInputError, "knots must be"),
        ([0, 0, 1, 1], [("a", 0), (0, 1)], 1, InvalidInputError, "control_points must be"),
        (None, [(0, 0), (0, 1)], 1, InvalidInputError, "knots must be"),
        ([0, 0, 1, 1], [(0, 0), (0, 1, 2)], 1, InvalidInputError, "control_points must be"),
    ],
)
def test_bad_curves(knots, points, degree, error, message):
    with pytest.raises(error, match=message):
        BSplineCurve(knots, points, degree)


def test_bad_parameters():
    line = BSplineCurve([0, 0, 1, 1], [(0, 0), (3, 4)], 1)
    with pytest.raises(InvalidInputError, match="derivative must not be negative, got -1"):
        line([0.5], derivative=-1)
    for bad in (np.nan, np.inf, -np.inf):
        for curve in (line, BSplineCurve(periodic_knots(3, 1), np.eye(3, 2), 1, periodic=True)):
            # Either is honest: an error, or nothing that looks like a point.
            try:
                found = curve([bad])
            except InvalidInputError:
                continue
            assert not np.isfinite(found).all()
