"""Ends, end tangents and points that a fit keeps exactly."""

import numpy as np
import pytest
from tests.support.promise import checked
from tests.support.shapes import flower, moved, wave

from shapespline import Contour, InvalidInputError, Status, fit_curve

TOLERANCE = 0.02


def direction(vector):
    return np.asarray(vector, dtype=float) / np.hypot(*vector)


def end_directions(fit):
    derivative = fit.curve.derivative()
    return direction(derivative(0.0)), direction(derivative(1.0))


def true_wave_tangents():
    """Of tests.shapes.wave at both ends, by its formula."""
    tangents = []
    for t in (0.0, 1.0):
        slope = 3 * (7 * np.cos(7 * t) * (1 - 0.5 * t) - 0.5 * np.sin(7 * t))
        tangents.append((20.0, slope))
    return tangents


def angle_bound(fit):
    """Rounding of coordinates up to 20 over the arm that makes a direction."""
    ends = fit.spline.control_points
    arm = min(np.hypot(*(ends[1] - ends[0])), np.hypot(*(ends[-1] - ends[-2])))
    return 8 * 20 * np.finfo(float).eps / arm


@pytest.mark.parametrize("angle", [0.0, 2.0, 20.0])  # degrees off the data's own tangent
@pytest.mark.parametrize("which", [(True, True), (True, False), (False, True)])
@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.slow
def test_end_tangents_are_exact(angle, which, backwards):
    contour = wave(600)
    begin, end = (moved([t], np.radians(angle))[0] for t in true_wave_tangents())
    points, wanted = contour.points, (begin, end)
    if backwards:
        points, wanted = points[::-1], (-end, -begin)
    wanted = tuple(t if on else None for t, on in zip(wanted, which, strict=True))
    fit = fit_curve(points, closed=False, tolerance=TOLERANCE, end_tangents=wanted)
    checked(fit, TOLERANCE)
    for found, asked in zip(end_directions(fit), wanted, strict=True):
        if asked is not None:
            assert found == pytest.approx(direction(asked), abs=angle_bound(fit))
    assert fit.curve([0.0, 1.0]) == pytest.approx(points[[0, -1]], abs=1e-12)
    free = fit_curve(points, closed=False, tolerance=TOLERANCE)
    # At most a cubic, a point of the joint and one of the rest for each direction asked for.
    assert fit.n_stored_points <= free.n_stored_points + 5 * sum(which)


def test_a_tangent_that_no_search_meets_is_met_by_a_turn():
    # Three points leave nothing to turn with.
    points = [(0, 0), (1, 1), (2, 0)]
    fit = fit_curve(points, closed=False, tolerance=1e-3, end_tangents=((0, -1), None))
    assert fit.status == Status.KEPT
    x, y = fit.spline([0.0], derivative=1)[0]
    assert y < 0
    assert abs(x) < 1e-9 * abs(y)


@pytest.mark.parametrize("contour", [wave(600), flower(600)], ids=["open", "closed"])
def test_the_curve_goes_through_points(contour):
    through = [7, 150, 151, 400]
    fit = fit_curve(contour, tolerance=TOLERANCE, through=through)
    checked(fit, TOLERANCE)
    nodes = np.array([piece.control_points[0] for piece in fit.pieces])
    for point in contour.points[through]:
        assert (nodes == point).all(axis=1).any()
    # And smoothly: the joints turn by less than what fits promise.
    for before, after in zip(fit.pieces[:-1], fit.pieces[1:], strict=True):
        u = before.control_points[-1] - before.control_points[-2]
        v = after.control_points[1] - after.control_points[0]
        assert abs(np.arctan2(u[0] * v[1] - u[1] * v[0], u @ v)) < np.radians(1.01)


def test_through_an_end_fixes_the_ends():
    contour = wave(600)
    fit = fit_curve(contour, tolerance=TOLERANCE, through=[0])
    assert fit.curve([0.0, 1.0]) == pytest.approx(contour.points[[0, -1]], abs=1e-12)


@pytest.mark.slow
def test_through_many_of_many_points():
    contour = flower(20_000)
    through = np.arange(0, 20_000, 1000)
    fit = fit_curve(contour, tolerance=TOLERANCE, through=through)
    checked(fit, TOLERANCE)
    nodes = np.array([piece.control_points[0] for piece in fit.pieces])
    distances = np.hypot(*(nodes[:, None] - contour.points[through]).T)
    assert (distances.min(axis=1) == 0).all()


@pytest.mark.slow
def test_outliers_and_nodes():
    points = wave(400).points.copy()
    points[100] += (0, 3.0)
    fit = fit_curve(points, closed=False, tolerance=TOLERANCE, outliers=True, through=[99, 200])
    assert fit.outliers.tolist() == [100]
    nodes = np.array([piece.control_points[0] for piece in fit.pieces])
    assert all((nodes == points[i]).all(axis=1).any() for i in (99, 200))
    with pytest.raises(InvalidInputError, match="through must hold no outliers"):
        fit_curve(points, closed=False, tolerance=TOLERANCE, outliers=True, through=[100])


@pytest.mark.parametrize(
    ("points", "arguments", "message"),
    [
        (flower(), {"end_tangents": ((1, 0), None)}, "open curves only"),
        (wave(), {"end_tangents": ((0, 0), None)}, "end_tangents must be a pair"),
        (wave(), {"end_tangents": (1, 0)}, "end_tangents must be a pair"),
        (wave(), {"end_tangents": "north"}, "end_tangents must be a pair"),
        (wave(), {"end_tangents": ((1, 0),)}, "end_tangents must be a pair"),
        (wave(), {"end_tangents": ((1, 0), None), "corners": "free"}, "corners='free'"),
        (wave(), {"through": [200]}, "indices below 200"),
        (wave(), {"through": [0.5]}, "indices of points"),
        (wave(), {"through": "all"}, "indices of points"),
        (wave(), {"through": [3], "form": "spline"}, "form='pieces'"),
        (wave(), {"through": [3], "tolerance": None}, "within a tolerance"),
        (wave(), {"through": [3], "tolerance": None, "n_control_points": 9}, "within a tolerance"),
    ],
)
def test_bad_arguments(points, arguments, message):
    with pytest.raises(InvalidInputError, match=message):
        fit_curve(points, **{"tolerance": TOLERANCE, **arguments})


def test_semi_closed_outlines_have_end_tangents_too():
    loop = flower(600).polyline
    contour = Contour(loop, closed=False)
    fit = fit_curve(contour, tolerance=TOLERANCE, end_tangents=((0, 1), (0, 1)))
    checked(fit, TOLERANCE)
    for found in end_directions(fit):
        assert found == pytest.approx([0, 1], abs=angle_bound(fit))
