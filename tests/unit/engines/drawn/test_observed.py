"""What is known of the errors of points: the last digit of a table."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.few_points import fitted, is_outline
from benchmarks.drawn.random_plates import STEP, plate, points_of
from benchmarks.drawn.truth import sampled

import shapespline as ss
from shapespline.engines.drawn.observed import LAST_DIGIT, Observed


def ring(count, phase, decimals):
    angle = 2 * np.pi * np.arange(count) / count + phase
    return (100 + 88 * np.column_stack([np.cos(angle), np.sin(angle)])).round(decimals)


# Each was a spline of five points: what rounding leaves of neighbours is a pattern that cubics
# follow, and shows as little as half of it.
@pytest.mark.parametrize(
    ("count", "phase", "decimals"),
    [(240, 0.0, 2), (240, 0.07, 2), (204, 0.0, 2), (260, 0.0, 1), (232, 0.3, 1)],
)
def test_a_circle_of_so_many_decimals_is_one(count, phase, decimals):
    fit = ss.fit_curve(ring(count, phase, decimals), closed=True, tolerance=0.3)
    assert [piece.kind for piece in fit.pieces] == ["arc"]
    # Half a step of both moves a radius by (|cos| + |sin|) / 2 of it, 2 / pi in the mean.
    assert fit.pieces[0].arc.radius == pytest.approx(88, abs=10.0**-decimals * 2 / np.pi)


@pytest.mark.parametrize("scale", [1.0, 0.5, 1e6])
@pytest.mark.parametrize("decimals", [1, 2])
def test_points_are_known_to_their_last_digit(decimals, scale):
    points = scale * ring(240, 0.0, decimals)
    seen = Observed.of(ss.Contour(points, closed=True), None)
    rounding = scale * 10.0**-decimals / 12**0.5
    assert seen.deviation >= rounding * (1 - 1e-9)
    assert not seen.exact


def test_points_on_a_grid_that_are_exact_stay_so():
    side = np.arange(0, 50, 0.1)
    corner = np.zeros_like(side)
    square = np.concatenate(
        [
            np.column_stack([side, corner]),
            np.column_stack([corner + 50, side]),
            np.column_stack([50 - side, corner + 50]),
            np.column_stack([corner, 50 - side]),
        ]
    )
    seen = Observed.of(ss.Contour(square.round(2), closed=True), None)
    assert seen.exact
    assert seen.deviation == LAST_DIGIT * 50


@pytest.mark.parametrize(("form", "draw"), [("L", 1), ("U", 3), ("box", 1), ("steps", 3)])
def test_arcs_between_level_edges_are_rounded_as_well(form, draw):
    # Level edges stay exact whatever they are rounded to: the plates were up to 87 pieces.
    outline = plate(form, draw, regular=True)
    dense = sampled(outline, STEP)
    points = points_of(dense, 400, 0.0, np.random.default_rng(0))
    assert is_outline(fitted(points.round(1), None), outline)


def test_more_decimals_than_count_are_none():
    seen = Observed.of(ss.Contour(ring(240, 0.0, 9), closed=True), None)
    assert seen.deviation == pytest.approx(LAST_DIGIT * 176, rel=0.01)


@pytest.mark.parametrize(("accuracy", "deviation"), [(0.1, 0.1), (0.07, 0.3 * 0.07)])
def test_errors_that_go_on_are_as_large_as_a_grainy_picture_says(accuracy, deviation):
    """A circle of 60 pixels that waves slowly shows next to nothing between neighbours."""
    angle = 2 * np.pi * np.arange(377) / 377
    radius = 60 + 0.05 * np.sin(23 * angle)
    points = radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    seen = Observed.of(ss.Contour(points, closed=True), accuracy)
    assert seen.deviation == pytest.approx(deviation)
