"""Weights within a tolerance: heavier points are kept closer, the promise for the rest stands."""

from __future__ import annotations

import numpy as np
import pytest

import shapespline as ss
from checks import two_sided
from shapespline.fitting.repair.weights import Limits, weighted
from shapespline.geometry.nearest import nearest

N = 400
T = np.linspace(0, 2 * np.pi, N, endpoint=False)
FLOWER = (10 + np.sin(5 * T) + 0.3 * np.cos(11 * T))[:, None] * np.column_stack(
    [np.cos(T), np.sin(T)]
)
TOLERANCE = 0.1
HEAVY = slice(100, 140)


def heavy(weight: float, at: slice = HEAVY) -> np.ndarray:
    weights = np.ones(N)
    weights[at] = weight
    return weights


def distances(fit: ss.Fit) -> np.ndarray:
    return np.sqrt(nearest(fit.spline, FLOWER).distances_sq)


@pytest.mark.slow
@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("weight", [3.0, 20.0])
@pytest.mark.parametrize("options", [{}, {"corners": "free"}, {"form": "spline"}])
def test_heavy_points_are_kept_closer(closed, weight, options):
    fit = ss.fit_curve(
        FLOWER, closed=closed, tolerance=TOLERANCE, weights=heavy(weight), effort="fast", **options
    )
    assert fit.kept
    assert (distances(fit) * heavy(weight)).max() <= TOLERANCE
    metric = two_sided(fit.curve, FLOWER, closed=closed, step=TOLERANCE / 10)
    assert metric.larger <= fit.tolerance == TOLERANCE


def test_pieces_elsewhere_stay_as_they_were():
    # With corners there are pieces: the sides of a square, bent.
    side = np.linspace(0, 1, 100, endpoint=False)
    bent = np.column_stack([10 * side, np.sin(np.pi * side) + 0.15 * np.sin(5 * np.pi * side)])
    turns = [np.array([[c, s], [-s, c]]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    corners = [(0, 0), (10, 0), (10, 10), (0, 10)]
    points = np.concatenate(
        [bent @ turn + np.array(at) for turn, at in zip(turns, corners, strict=True)]
    )
    weights = np.ones(len(points))
    weights[130:170] = 10.0
    even = ss.fit_curve(points, closed=True, tolerance=0.02)
    fit = ss.fit_curve(points, closed=True, tolerance=0.02, weights=weights)
    everywhere = ss.fit_curve(points, closed=True, tolerance=0.002)
    assert fit.kept
    assert np.sqrt(nearest(fit.spline, points[130:170]).distances_sq).max() <= 0.002
    assert even.n_stored_points < fit.n_stored_points < everywhere.n_stored_points
    same = [
        piece
        for piece in fit.pieces
        if any(np.array_equal(piece.control_points, other.control_points) for other in even.pieces)
    ]
    assert len(same) >= len(even.pieces) // 2


def test_even_and_light_weights_change_nothing():
    even = ss.fit_curve(FLOWER, closed=True, tolerance=TOLERANCE)
    for weights in (np.ones(N), heavy(0.01)):
        fit = ss.fit_curve(FLOWER, closed=True, tolerance=TOLERANCE, weights=weights)
        np.testing.assert_array_equal(fit.spline.control_points, even.spline.control_points)


def test_of_points_that_coincide_the_heaviest_counts():
    twice = ss.Contour.silently(np.repeat(FLOWER, 2, axis=0), closed=True)
    weights = np.ones(2 * N)
    weights[1::2] = heavy(10.0)
    fit = ss.fit_curve(twice, tolerance=TOLERANCE, weights=weights, effort="fast")
    assert fit.kept
    assert (distances(fit) * heavy(10.0)).max() <= TOLERANCE


def test_held_ends_and_points_stay():
    weights = heavy(10.0)
    fit = ss.fit_curve(
        FLOWER, closed=False, tolerance=TOLERANCE, weights=weights, through=[50], effort="fast"
    )
    assert fit.kept
    assert distances(fit)[50] <= 1e-12 * 20
    assert (distances(fit) * weights).max() <= TOLERANCE


def test_weights_are_checked_before_any_work():
    for weights, message in (
        (np.ones(3), r"weights must have shape \(400,\)"),
        (-np.ones(N), "weights must be positive"),
        (np.full(N, np.nan), "weights must be positive"),
    ):
        with pytest.raises(ss.InvalidInputError, match=message):
            ss.fit_curve(FLOWER, closed=True, tolerance=TOLERANCE, weights=weights)


def test_what_is_not_kept_is_said():
    fit = ss.fit_curve(FLOWER, closed=True, tolerance=TOLERANCE, effort="fast")
    limits = Limits.of(heavy(1e6), fit.contour, TOLERANCE)
    told = weighted(fit, limits, None, lambda *_: fit)
    n_missed = np.count_nonzero(distances(fit) * heavy(1e6) > TOLERANCE)
    assert n_missed > 30
    assert told.status != ss.Status.KEPT
    assert f"but {n_missed} points are farther away than tolerance / weight" in told.status.value
    np.testing.assert_array_equal(told.spline.control_points, fit.spline.control_points)


def test_few_points_of_a_great_weight_are_gone_through():
    at = [20, 200, 310]
    weights = np.ones(N)
    weights[at] = 1e9
    fit = ss.fit_curve(FLOWER, closed=True, tolerance=TOLERANCE, weights=weights)
    through = ss.fit_curve(FLOWER, closed=True, tolerance=TOLERANCE, through=at)
    assert fit.kept
    assert distances(fit)[at].max() <= 1e-9 * TOLERANCE
    assert fit.n_stored_points <= 2 * through.n_stored_points


@pytest.mark.parametrize("at", [(113, 122), (160, 192), (30, 31)])
@pytest.mark.parametrize("degree", [2, 3])
def test_a_stroke_drawn_there_and_back_begins_where_it_did(at, degree):
    # An open row whose ends coincide is not a closed outline: its first point stays the first.
    x = np.linspace(0, 10, 120)
    there = np.column_stack([x, np.sin(3 * x) + 0.4 * np.cos(7 * x)])
    stroke = np.concatenate([there, there[-2::-1]])
    weights = np.ones(len(stroke))
    weights[list(at)] = 5.0
    fit = ss.fit_curve(stroke, closed=False, tolerance=0.3, weights=weights, degree=degree)
    assert fit.kept
    assert not fit.contour.closed
    ends = fit.spline.beziers().points[[0, -1], [0, -1]]
    assert np.hypot(*(ends - stroke[[0, -1]]).T).max() <= 0.3
    heavy_ones = np.sqrt(nearest(fit.spline, stroke[list(at)]).distances_sq)
    assert heavy_ones.max() <= 0.3 / 5
