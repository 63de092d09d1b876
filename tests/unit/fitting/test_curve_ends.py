"""Ends of open curves: free within the tolerance, or exactly the first and last point."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.shapes import flower

from checks import two_sided
from shapespline import Contour, InvalidInputError, fit_curve


def opened(contour):
    return Contour.silently(contour.points[: 2 * len(contour) // 3], closed=False)


def test_fixed_ends_of_many_points_are_the_data():
    t = np.linspace(0, 3, 60_000)  # fitted in passes
    bounces = np.column_stack([10 * t, 3 * np.abs(np.sin(3 * t))])
    fit = fit_curve(bounces, closed=False, tolerance=0.05, ends="fixed")
    assert fit.kept
    assert_array_equal(fit.curve([0.0, 1.0]), bounces[[0, -1]])


@pytest.mark.parametrize("effort", ["fast", "balanced"])
@pytest.mark.parametrize(
    ("form", "corners"), [("pieces", "auto"), ("pieces", "free"), ("spline", "auto")]
)
@pytest.mark.parametrize(
    "name", ["fa_gear_c0", "hand620_closed", "loop500_n0.2_open", "mdi_fan_c0"]
)
@pytest.mark.slow
def test_fixed_ends_are_the_data_to_the_bit(outline, name, form, corners, effort):
    contour = outline(name)
    contour = opened(contour) if contour.closed else contour
    tolerance = 0.002 * contour.box_diagonal
    fit = fit_curve(
        contour, tolerance=tolerance, form=form, corners=corners, effort=effort, ends="fixed"
    )
    assert_array_equal(fit.control_points[[0, -1]], contour.points[[0, -1]])
    assert_array_equal(fit.pieces[0].control_points[0], contour.points[0])
    assert_array_equal(fit.pieces[-1].control_points[-1], contour.points[-1])
    found = two_sided(fit.curve, contour.points, closed=False, step=tolerance / 4)
    assert found.larger <= fit.hausdorff_distance + 1e-9 * contour.box_diagonal
    assert fit.kept


@pytest.mark.parametrize("arguments", [{"n_control_points": 20}, {}])
def test_least_squares_begins_and_ends_in_the_data(arguments):
    contour = opened(flower(300))
    for ends in ("free", "fixed"):
        fit = fit_curve(contour, ends=ends, **arguments)
        assert_array_equal(fit.control_points[[0, -1]], contour.points[[0, -1]])


def test_free_ends_are_free():
    points = opened(flower(300)).points + np.random.default_rng(1).normal(0, 0.05, (200, 2))
    fit = fit_curve(points, closed=False, tolerance=0.2)
    assert (fit.control_points[[0, -1]] != points[[0, -1]]).any()


@pytest.mark.parametrize("seed", [1, 4, 10, 12])
def test_free_ends_stay_near_those_of_the_data(seed):
    # Rough for its tolerance: what is beside the first point may be near a later one, too.
    walk = np.cumsum(np.random.default_rng(seed).normal(0, 1, (40, 2)), axis=0)
    fit = fit_curve(walk, closed=False, tolerance=0.8)
    assert fit.kept
    assert np.hypot(*(fit.control_points[[0, -1]] - walk[[0, -1]]).T).max() <= 0.8


def test_a_closed_curve_has_no_ends():
    contour = flower(200)
    free, fixed = (fit_curve(contour, tolerance=0.1, ends=ends) for ends in ("free", "fixed"))
    assert_array_equal(free.control_points, fixed.control_points)


def test_backwards_the_ends_are_the_same():
    contour = opened(flower(300))
    for points in (contour.points, contour.points[::-1]):
        fit = fit_curve(points, closed=False, tolerance=0.1, ends="fixed")
        assert_array_equal(fit.control_points[[0, -1]], points[[0, -1]])


def test_bad_ends():
    with pytest.raises(InvalidInputError, match="ends must be one of free, fixed, got 'loose'"):
        fit_curve(flower(160), tolerance=0.1, ends="loose")
