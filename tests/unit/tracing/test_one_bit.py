"""Black and white cut from grainy greys: edges are straight, corners sharp; clean steps stay."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.support.rendering import coverage, polygon
from tests.unit.tracing.test_softness import QUADRILATERAL, SHAPES, scanned

import shapespline as ss
from shapespline.tracing import trace
from shapespline.tracing.one_bit import are_ragged

CORNERS = 1.6 * QUADRILATERAL
SIZE = 192


def bits(inside, blur, grain, seed=0):
    return np.where(scanned(inside, blur, grain, SIZE, seed) > 122, 255, 0).astype(np.uint8)


def columns(heights):
    """Crossings of the columns of a level outline, and which lie in columns."""
    points = np.column_stack([np.arange(len(heights)) + 0.5, np.asarray(heights, dtype=float)])
    return points, np.ones(len(points), dtype=bool)


@pytest.mark.parametrize(("grain", "off"), [(8.0, 0.2), (14.0, 0.2), (20.0, 0.25)])
def test_edges_of_ragged_bits_are_nearer_than_their_steps(grain, off):
    contour = trace(bits(polygon(CORNERS), 1.0, grain), min_area=20).longest
    sides = np.linspace(CORNERS, np.roll(CORNERS, -1, axis=0), 4000, axis=1).reshape(-1, 2)
    truth = cKDTree(sides)
    far = cKDTree(CORNERS).query(contour.points)[0] > 6
    found = np.sqrt((truth.query(contour.points[far])[0] ** 2).mean())
    level = np.sqrt((truth.query(contour.level_line)[0] ** 2).mean())
    assert found < min(off, 0.7 * level)
    assert contour.accuracy == 0.25


@pytest.mark.parametrize("grain", [8.0, 14.0])
def test_a_quadrilateral_of_ragged_bits_has_four_lines(grain):
    right = 0
    for seed in range(6):
        contour = trace(bits(polygon(CORNERS), 1.0, grain, seed), min_area=20).longest
        fit = ss.fit_curve(contour)
        corners = np.array([piece.control_points[0] for piece in fit.pieces])
        right += [piece.kind for piece in fit.pieces] == ["line"] * 4
        assert cKDTree(corners).query(CORNERS)[0].max() < 2.0
    assert right >= 5


@pytest.mark.parametrize("inside", SHAPES.values(), ids=SHAPES.keys())
def test_clean_bits_keep_their_steps(inside):
    image = np.where(coverage(inside, 120, 120) > 0.5, 0, 255).astype(np.uint8)
    contour = trace(image).longest
    assert np.array_equal(contour.points, contour.level_line)
    assert contour.accuracy == 0.25


def test_raggedness_is_of_single_columns():
    steps = np.repeat(np.arange(40), 10)
    clean = np.concatenate([steps, steps[::-1]])
    assert not are_ragged([columns(clean)])
    # Corners of a step that go back at once are none: a tooth of a single column is one of many.
    ragged = clean.copy()
    at = np.arange(24, 800, 40)
    ragged[at] += 1
    assert are_ragged([columns(ragged)])
    few = clean.copy()
    few[at[:6]] += 1
    assert not are_ragged([columns(few)])
    assert are_ragged([columns(clean), columns(ragged)])
    assert not are_ragged([])


def test_higher_steps_are_no_grain():
    """A comb of teeth two pixels high, one wide, was drawn."""
    comb = np.zeros(400)
    comb[::8] = 2
    assert not are_ragged([columns(comb)])


def test_a_saw_of_single_pixels_was_drawn():
    """Grain lets pixels stick out of rows that go on; a saw has none."""
    assert not are_ragged([columns(np.arange(400) % 2)])
