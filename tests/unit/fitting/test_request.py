"""Request: what settings mean for one contour; outliers and repeated points renumbered once."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.shapes import flower, wave

import shapespline as ss
from shapespline.fitting import Request, Settings
from shapespline.fitting.goals import Estimate, OfSize, Within
from shapespline.fitting.solve import solve
from shapespline.monitor import Monitor


def request(points, closed=None, **options):
    return Request.of(points, closed, Settings(**options))


@pytest.mark.parametrize(
    ("options", "goal"),
    [
        ({"tolerance": 0.25}, Within(0.25)),
        ({"n_control_points": 12, "knots": "uniform"}, OfSize(12, "uniform")),
        ({}, Estimate()),
    ],
)
def test_the_goal_is_what_was_said(options, goal):
    assert request(wave(), **options).goal == goal


def test_a_part_of_the_box_is_that_of_the_points_that_stay():
    points = wave().points.copy()
    points[50] += (0.0, 30.0)
    asked = request(points, False, tolerance="1%", outliers=True)
    assert asked.left_out.tolist() == [50]
    rest = ss.Contour(np.delete(points, 50, axis=0), closed=False)
    assert asked.goal == Within(0.01 * rest.box_diagonal)


def test_indices_count_the_points_that_were_given():
    points = np.insert(wave().points, 5, wave().points[5], axis=0)
    with pytest.warns(ss.DroppedPointsWarning):
        asked = request(points, False, tolerance=0.1, through=[4, 60], corners=[100])
    assert_array_equal(asked.contour.points[asked.constraints.through], points[[4, 60]])
    assert_array_equal(asked.contour.points[asked.style.corners], points[[100]])


def test_indices_follow_their_points_when_outliers_go():
    points = wave().points.copy()
    points[50] += (0.0, 30.0)
    weights = np.arange(1.0, len(points) + 1)
    options = {"through": [20, 120], "corners": [49, 90], "weights": weights}
    asked = request(points, False, tolerance=0.1, outliers=True, **options)
    assert_array_equal(asked.contour.points[asked.constraints.through], points[[20, 120]])
    assert_array_equal(asked.contour.points[asked.style.corners], points[[49, 90]])
    assert_array_equal(asked.weights, np.delete(weights, 50))
    with pytest.raises(ss.InvalidInputError, match=r"through must hold no outliers, got \[50\]"):
        request(points, False, tolerance=0.1, outliers=True, through=[50])


def test_an_end_among_the_points_to_go_through_fixes_the_ends():
    assert not request(wave(), tolerance=0.1).constraints.ends
    assert request(wave(), tolerance=0.1, through=[0]).constraints.ends
    assert not request(flower(), tolerance=0.1, through=[0]).constraints.ends


def test_a_part_keeps_its_ends_and_the_style():
    asked = request(flower(), tolerance=0.1, corners=[3], effort="fast", degree=4, symmetric=True)
    row = ss.Contour(flower().points[10:40], closed=False)
    part = asked.part(row, 0.05, (np.array([3.0, 4.0]), None), [7, 5, 7])
    assert part.goal == Within(0.05)
    assert part.constraints.ends
    assert part.constraints.through.tolist() == [5, 7]
    assert part.constraints.tangents[0].tolist() == [0.6, 0.8]
    assert part.constraints.tangents[1] is None
    assert (part.style.degree, part.style.corners, part.effort) == (4, "auto", "fast")
    assert not part.symmetric
    free = request(flower(), tolerance=0.1, corners="free").part(row, 0.05, (np.ones(2), None))
    assert free.constraints.tangents == (None, None)  # joints are free there


def test_closer_keeps_what_was_kept():
    asked = request(wave(), tolerance=0.1, through=[30], weights=np.ones(len(wave())))
    closer = asked.closer(0.02, np.array([0, 60]))
    assert closer.goal == Within(0.02)
    assert closer.constraints.through.tolist() == [0, 30, 60]
    assert closer.constraints.ends
    assert closer.weights is None


@pytest.mark.parametrize(
    "options",
    [
        {"tolerance": 0.05, "through": [30], "end_tangents": ((1, 0.5), None), "effort": "fast"},
        {"tolerance": 0.05, "corners": [20, 80], "weights": np.linspace(1, 2, 200)},
        {"n_control_points": 14, "method": "d-bfgs"},
        {"outliers": True, "corners": None},
    ],
)
def test_a_request_comes_back_from_a_dictionary(options):
    import json

    points = wave().points[:200].copy()
    points[50] += (0.0, 30.0) if "outliers" in options else 0.0
    asked = request(points, False, **options)
    back = Request.from_dict(json.loads(json.dumps(asked.to_dict())))
    fit, again = (solve(one, Monitor()) for one in (asked, back))
    assert_array_equal(fit.control_points, again.control_points)
    assert_array_equal(fit.outliers, again.outliers)


def test_what_does_not_go_with_the_points_is_said():
    with pytest.raises(ss.InvalidInputError, match="through must be indices below"):
        request(wave(), tolerance=0.1, through=[5000])
    with pytest.raises(ss.InvalidInputError, match="end_tangents act on open curves only"):
        request(flower(), tolerance=0.1, end_tangents=((1, 0), None))
    with pytest.raises(ss.InvalidInputError, match="at most the number of distinct points"):
        request([(0, 0), (1, 0), (2, 1), (3, 0)], False, n_control_points=5)
    with pytest.raises(ss.DegenerateContourError, match=r"at least degree \+ 1 = 4"):
        request([(0, 0), (1, 0), (2, 1)], False, n_control_points=4)


def test_the_warning_of_shuffled_points_is_at_the_callers_line():
    shuffled = np.random.default_rng(1).permutation(flower(400).points)
    with pytest.warns(ss.ShuffledPointsWarning) as caught:
        ss.fit_curve(shuffled, closed=True, tolerance=3.0, effort="fast", time_limit=1.0)
    assert caught[0].filename == __file__


@pytest.mark.parametrize("call", [ss.Contour, lambda points: ss.fit_curve(points, tolerance=0.1)])
def test_the_warning_of_dropped_points_is_at_the_callers_line(call):
    with pytest.warns(ss.DroppedPointsWarning) as caught:
        call([(0, 0), (1, 0), (1, 0), (2, 1)])
    assert caught[0].filename == __file__
