"""Outlines of masks: lines, arcs and smooth curves come back, however the border is given."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from benchmarks.drawn.few_points import is_outline
from benchmarks.drawn.pixel_chains import BORDERS, POINTS, mask_of, off, on_pixels
from benchmarks.drawn.random_plates import STEP, plate
from benchmarks.drawn.truth import sampled
from tests.support.promise import checked
from tests.support.shapes import flower, on_circle

import shapespline as ss
from shapespline.fitting.drawn import DrawnPieces

FLOWER = flower(6000).points
# Of which nothing repeats.
PENTAGON = np.array([(0.0, 0.1), (0.55, 0.0), (1.0, 0.42), (0.7, 0.9), (0.12, 0.7)])
PENTAGON = np.concatenate(
    [np.linspace(a, b, 1000, endpoint=False) for a, b in pairwise([*PENTAGON, PENTAGON[0]])]
)
GIVEN = [(border, points) for border in BORDERS for points in POINTS]


def chain(dense, border="middles of pixels", points="all", pixels=200):
    """The border of a mask, and the outline that it is of."""
    placed = on_pixels(dense, pixels, np.random.default_rng(1))
    return POINTS[points](BORDERS[border](mask_of(placed))), placed


@pytest.mark.parametrize(("border", "points"), GIVEN)
@pytest.mark.parametrize("draw", [0, 1], ids=["turned", "level"])
def test_plates_come_back_from_their_masks(border, points, draw):
    outline = plate("T", draw, regular=True)
    given, _ = chain(sampled(outline, STEP), border, points)
    fit = ss.fit_curve(given, closed=True)
    assert is_outline(fit, outline)
    assert any(one.name == "equal-radius" for one in fit.regularities)


@pytest.mark.parametrize(("border", "points"), GIVEN)
def test_smooth_outlines_do_not_follow_stairs(border, points):
    given, placed = chain(FLOWER, border, points, pixels=300)
    fit = ss.fit_curve(given, closed=True)
    # Stairs alone are off by 0.29 pixels.
    assert off(fit, placed) < 0.2
    assert fit.n_stored_points < 40


def test_circles_are_circles():
    given, placed = chain(on_circle(4000))
    (piece,) = ss.fit_curve(given, closed=True).pieces
    assert piece.arc is not None
    # Their pixels' middles lie inside, by half a pixel in the mean.
    assert piece.arc.radius == pytest.approx(np.ptp(placed[:, 0]) / 2 - 0.5, abs=0.1)


@pytest.mark.parametrize("size", [100, 150, 400])
def test_a_polygon_that_repeats_nothing_has_its_edges(size):
    given, _ = chain(PENTAGON, pixels=size)
    fit = ss.fit_curve(given, closed=True)
    assert [piece.kind for piece in fit.pieces] == ["line"] * 5


def test_within_a_tolerance_stairs_are_points_like_others():
    given, _ = chain(FLOWER, points="at turns", pixels=300)
    for tolerance in (0.1, 1.0):
        assert checked(ss.fit_curve(given, closed=True, tolerance=tolerance), tolerance).kept


def test_nothing_else_is_asked_of_the_polygon(monkeypatch):
    asked = []
    propose = DrawnPieces.propose

    def noted(self, problem, monitor):
        asked.append(len(problem.contour))
        return propose(self, problem, monitor)

    monkeypatch.setattr(DrawnPieces, "propose", noted)
    whole, _ = chain(FLOWER, pixels=300)
    given, _ = chain(FLOWER, points="at turns", pixels=300)
    ss.fit_curve(given, closed=True)
    assert asked == [len(whole)]


def test_named_corners_are_those_of_the_points_that_were_given():
    given, placed = chain(PENTAGON, points="at turns")
    corners = placed[:: len(placed) // 5]
    named = [int(np.hypot(*(given - corner).T).argmin()) for corner in corners]
    fit = ss.fit_curve(given, closed=True, corners=sorted(named))
    sharp = fit.curve(fit.corners)
    assert all(np.hypot(*(sharp - given[k]).T).min() < 2.0 for k in named)  # pixels
