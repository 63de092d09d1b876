"""Corners of a contour: by hand on polygons, rounded polygons, smooth curves and noise."""

import numpy as np
import pytest
from tests.support.shapes import moved, on_circle, rectangle

from shapespline.analysis.corners import find_corners
from shapespline.values.contour import Contour


def stadium(radius=5.0, side=20.0, spacing=0.25):
    """Two straight sides joined by half circles: four tangent joins, no corner."""
    n_side, n_arc = round(side / spacing), round(np.pi * radius / spacing)
    x = np.linspace(0, side, n_side, endpoint=False)
    angle = -np.pi / 2 + np.pi * np.arange(n_arc) / n_arc
    right = np.column_stack([side + radius * np.cos(angle), radius * np.sin(angle)])
    bottom = np.column_stack([x, np.full(n_side, -radius)])
    top = np.column_stack([side - x, np.full(n_side, radius)])
    left = np.column_stack([-radius * np.cos(angle), -radius * np.sin(angle)])
    return Contour(np.concatenate([bottom, right, top, left]), closed=True)


def polygon(corners, per_side):
    """Points along a closed polygon, each corner one of them."""
    corners = np.asarray(corners, dtype=float)
    t = np.arange(per_side)[:, None] / per_side
    sides = [a + t * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    return Contour(np.concatenate(sides), closed=True)


def test_corners_of_a_rectangle_are_its_four_vertices():
    assert find_corners(rectangle(40, 20)).indices.tolist() == [0, 40, 60, 100]


@pytest.mark.parametrize("n", [3, 4, 5, 6, 8])
def test_corners_of_a_regular_polygon_are_its_vertices(n):
    contour = polygon(on_circle(n, 10.0), 30)
    found = find_corners(contour)
    assert found.indices.tolist() == [30 * k for k in range(n)]
    assert found.turns[found.indices] == pytest.approx(2 * np.pi / n, rel=1e-9)


def test_turns_below_the_threshold_are_no_corners():
    assert len(find_corners(polygon(on_circle(20, 10.0), 30)).indices) == 0


def test_a_line_that_runs_into_an_arc_is_no_corner():
    assert len(find_corners(stadium()).indices) == 0


def test_a_circle_has_no_corner():
    assert len(find_corners(Contour(on_circle(200, 7.0), closed=True)).indices) == 0


def test_the_ends_of_an_open_line_are_no_corners():
    x = np.linspace(0, 1, 50)
    assert len(find_corners(Contour(np.column_stack([x, 0 * x]), closed=False)).indices) == 0


def test_a_corner_between_two_arcs_is_found():
    angle = np.linspace(np.pi / 4, 3 * np.pi / 4, 60, endpoint=False)
    arc = np.column_stack([np.cos(angle), np.sin(angle)])
    arc -= arc[0]
    back = arc[-1] + (arc[-1] - arc[-2]) - arc
    lens = Contour(10 * np.concatenate([arc, back]), closed=True)
    assert find_corners(lens).indices.tolist() == [0, 60]


@pytest.mark.parametrize("n", [40, 80, 150])
@pytest.mark.parametrize("aspect", [3, 5])
def test_the_tip_of_an_ellipse_is_a_bend_even_of_few_points(n, aspect):
    tips = Contour(on_circle(n, 10.0) * [1.0, 1.0 / aspect], closed=True)
    assert len(find_corners(tips, 0.02).indices) == 0


def test_bends_of_few_points_are_no_corners_but_a_way_back_is():
    # Nine points a wave: all of its bends were corners (ANA-18).
    x = np.arange(70.0)
    wave = np.column_stack([x, 2 * np.sin(2 * np.pi * x / 9 + 0.3)])
    assert not len(find_corners(Contour(wave, closed=False)).indices)
    there_and_back = np.concatenate([wave, wave[-2::-1]])
    assert find_corners(Contour(there_and_back, closed=False)).indices.tolist() == [69]
    # The folds of a zigzag are, but for those too near to an end.
    zigzag = np.column_stack([x, 3 * np.abs(x % 10 - 5)])
    assert find_corners(Contour(zigzag, closed=False)).indices.tolist() == [*range(10, 61, 5)]


def test_a_corner_between_two_points_stays_one():
    cut = polygon([(0, 0), (40, 0), (40, 30), (0, 30)], 40)
    middles = 0.5 * (cut.points + np.roll(cut.points, -1, axis=0))
    found = find_corners(Contour(middles, closed=True), 0.02).indices
    assert len(found) == 4
    assert (np.minimum(found % 40, 39 - found % 40) == 0).all()


@pytest.mark.parametrize("seed", range(5))
def test_noise_makes_no_corners_and_hides_none(seed):
    rng = np.random.default_rng(seed)
    clean = rectangle(100, 60, spacing=0.5)
    noisy = Contour(clean.points + rng.normal(0, 0.05, clean.points.shape), closed=True)
    found = find_corners(noisy).indices
    assert len(found) == 4
    n = len(clean)
    for corner in (0, 100, 160, 260):
        gap = np.abs(found - corner)
        assert np.minimum(gap, n - gap).min() <= 4


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_corners_are_invariant_under_similarity(scale):
    points = rectangle(40, 20).points
    image = Contour(moved(points, 0.3, scale, (3 * scale, -scale)), closed=True)
    assert find_corners(image).indices.tolist() == [0, 40, 60, 100]


def test_corners_move_with_the_start():
    shifted = Contour(np.roll(rectangle(40, 20).points, 7, axis=0), closed=True)
    assert find_corners(shifted).indices.tolist() == [7, 47, 67, 107]
