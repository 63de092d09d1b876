"""fit_curve at a number of control points: what a caller gets, checked from outside."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.shapes import flower

from checks import sampling_error, two_sided
from shapespline import (
    Contour,
    DegenerateContourError,
    DroppedPointsWarning,
    InvalidInputError,
    Status,
    fit_curve,
)

# Root mean square and two-sided distance at an equal number of control points, box diagonal 100:
# the best joint fit of other programs, one-sided (rms, maximum), which ours must beat both ways.
EQUAL_COUNT = [
    ("hand620_closed", 36, 0.104, 0.62),
    ("leaf840_closed", 70, 0.044, 0.26),
    ("loop500_open", 24, 0.016, 0.26),
]


@pytest.mark.parametrize(("name", "count", "rms", "farthest"), EQUAL_COUNT)
def test_equal_count_beats_the_best_joint_fit_known(outline, name, count, rms, farthest):
    fit = fit_curve(outline(name), n_control_points=count)
    assert fit.n_control_points == fit.n_stored_points == count
    assert fit.rms_distance < rms
    assert fit.hausdorff_distance < farthest
    assert fit.status == Status.KEPT
    assert fit.kept


@pytest.mark.slow
@pytest.mark.parametrize("name", ["hand620_closed", "loop500_open", "fa_gear_c0", "naca2412"])
def test_the_reported_distances_are_those_of_a_dense_sampling(outline, name):
    contour = outline(name)
    fit = fit_curve(contour, n_control_points=24)
    step = contour.box_diagonal / 2000
    found = two_sided(fit.curve, contour.points, closed=contour.closed, step=step)
    slack = sampling_error(fit.curve, step)
    rounding = 64 * np.finfo(float).eps * np.abs(contour.points).max()
    # A sample is at most the slack away from the nearest curve point, and never nearer than it.
    assert found.forward - slack <= fit.max_distance <= found.forward + rounding
    assert found.reverse <= fit.hausdorff_distance
    # Tight to 0.1 % of the true distance, which lies between the samples.
    assert fit.hausdorff_distance <= 1.001 * max(found.forward, found.reverse + slack)


def test_a_closed_fit_is_periodic_and_an_open_one_meets_its_ends():
    contour = flower(200)
    assert fit_curve(contour.points, n_control_points=20).spline.periodic
    arc = contour.points[:90]
    fit = fit_curve(arc, n_control_points=12)
    assert not fit.closed
    assert_array_equal(fit.control_points[[0, -1]], arc[[0, -1]])


def test_semi_closed_data_keep_their_corner():
    t = np.linspace(0, 2 * np.pi, 121)
    drop = np.column_stack([np.cos(t) * np.sin(t / 2) ** 2, np.sin(t) * np.sin(t / 2)])
    drop[-1] = drop[0]
    fit = fit_curve(drop, closed=False, n_control_points=12)
    assert fit.closed
    assert not fit.spline.periodic
    assert_array_equal(fit.control_points[0], fit.control_points[-1])
    assert fit.corners.tolist() == [0.0]
    assert fit.n_stored_points == 11


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("degree", range(1, 10))
@pytest.mark.slow
def test_every_degree(degree, closed):
    contour = Contour(flower(240).points[: None if closed else 200], closed=closed)
    fit = fit_curve(contour, n_control_points=30, degree=degree)
    assert fit.degree == fit.curve.k == degree
    # A polygon of 30 sides on five petals of radius 10 errs by about 10 (2 pi / 30)^2 / 8 of the
    # bend, 0.1 to 0.5; everything smoother does better.
    assert fit.hausdorff_distance < (1.0 if degree == 1 else 0.3)


def test_weights_pull():
    points = flower(160).points.copy()
    points[40] *= 1.2
    weights = np.ones(160)
    weights[40] = 1e4
    light = fit_curve(points, n_control_points=12)
    heavy = fit_curve(points, n_control_points=12, weights=weights)

    def off(fit):
        return np.hypot(*(fit.spline(fit.parameters[40:41])[0] - points[40]))

    assert off(heavy) < 0.2 * off(light)


def test_repeated_points_keep_their_parameters():
    points = np.repeat(flower(100).points, [2] + [1] * 99, axis=0)
    with pytest.warns(DroppedPointsWarning, match="dropped 1 of 101 points"):
        fit = fit_curve(points, closed=True, n_control_points=12)
    assert fit.parameters.shape == (101,)
    assert fit.parameters[0] == fit.parameters[1]
    assert len(fit.contour) == 100


def test_callback_sees_every_iteration_and_cancels():
    seen = []

    def stop_at_three(iteration):
        seen.append(iteration)
        return iteration.iteration == 3

    fit = fit_curve(flower(160), n_control_points=12, method="d-bfgs", callback=stop_at_three)
    assert [record.iteration for record in seen] == [0, 1, 2, 3]
    assert fit.status == Status.CANCELLED
    assert len(fit.history) == 4


def test_other_methods_end_near_the_default(outline):
    contour = outline("loop500_open")
    best = fit_curve(contour, n_control_points=16)
    for method in ("d-bfgs", "l-bfgs"):
        fit = fit_curve(contour, n_control_points=16, method=method)
        assert fit.method == method
        # They start at the same balanced curve and can only lower its cost.
        assert fit.history[-1].cost <= fit.history[0].cost
        assert fit.rms_distance < 3 * best.rms_distance


@pytest.mark.parametrize("n", [4, 5, 6, 8, 12])
def test_few_points(n):
    angles = 2 * np.pi * np.arange(n) / n
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    for count in range(4, n + 1):
        fit = fit_curve(ring, closed=True, n_control_points=count)
        assert np.isfinite(fit.hausdorff_distance)
        # n points on a circle and the polygon between them: no curve need leave it by a radius.
        assert fit.hausdorff_distance < 1.0
    # Nothing known of so few: the polygon.
    assert fit_curve(ring, closed=True).n_stored_points == n


def test_fewer_points_than_a_spline_needs():
    triangle = [(0, 0), (1, 0), (0, 1)]
    assert fit_curve(triangle, closed=True).n_stored_points == 3
    with pytest.raises(DegenerateContourError, match=r"at least degree \+ 1 = 4 distinct points"):
        fit_curve(triangle, n_control_points=4)


# --- bad input ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"n_control_points": 3}, DegenerateContourError, r"at least degree \+ 1 = 4, got 3"),
        ({"n_control_points": 161}, InvalidInputError, "at most the number of distinct points"),
        ({"n_control_points": 4.5}, InvalidInputError, "n_control_points must be an integer"),
        ({"degree": 10}, InvalidInputError, "degree must be an integer from 1 to 9, got 10"),
        ({"weights": np.ones(3)}, InvalidInputError, r"weights must have shape \(160,\)"),
        ({"weights": -np.ones(160)}, InvalidInputError, "weights must be positive"),
        ({"method": "newton"}, InvalidInputError, "method must be one of"),
    ],
)
def test_bad_arguments(arguments, error, message):
    with pytest.raises(error, match=message):
        fit_curve(flower(160), **{"n_control_points": 12, **arguments})


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.full((9, 2), np.nan), "points must be finite"),
        (np.zeros((2, 40)), r"got \(2, 40\); transpose it\?"),
        ([(0, 0)] * 9, "distinct points"),
    ],
)
def test_bad_points(points, message):
    with pytest.raises(InvalidInputError, match=message):
        fit_curve(points)
