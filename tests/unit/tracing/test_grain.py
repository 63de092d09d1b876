"""Outlines of grainy pictures are averaged along themselves, and keep their corners and places."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.support.rendering import coverage, polygon
from tests.unit.tracing.test_softness import QUADRILATERAL, scanned, softness

from shapespline.tracing import trace
from shapespline.tracing.grain import averaged, squarely

SCATTER = 0.15


def ring(radius, n, scatter=0.0, seed=0):
    angle = 2 * np.pi * np.arange(n) / n
    radii = radius + np.random.default_rng(seed).normal(0.0, scatter, n)
    return radii[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


def square(side, scatter=0.0, seed=0):
    """A point each pixel, noise across the sides, corners at multiples of the side."""
    at = np.arange(side) + 0.5
    zero = 0 * at
    sides = [(at, zero), (zero + side, at), (side - at, zero + side), (zero, side - at)]
    points = np.concatenate([np.column_stack(one) for one in sides])
    off = np.random.default_rng(seed).normal(0.0, scatter, len(points))
    across = np.repeat([(0, 1), (1, 0), (0, 1), (1, 0)], side, axis=0)
    return points + off[:, None] * across


def off_square(points, side):
    beyond = np.abs(points - 0.5 * side) - 0.5 * side
    outside = np.hypot(*np.maximum(beyond, 0.0).T)
    return np.abs(outside + np.minimum(beyond.max(axis=1), 0.0))


def nothing_stays(points):
    return np.zeros(len(points), dtype=bool)


def test_a_ring_has_the_deviation_of_the_largest_window():
    points = ring(300.0, 1900, SCATTER)
    out = averaged(points, SCATTER, nothing_stays(points))
    off = np.hypot(*out.T) - 300.0
    # Least squares over 33 points leave 9 / (4 * 33) of the variance in their middle, and a bit
    # more; the deviation over 1900 / 33 independent places is known to a tenth, three of them.
    assert off.std() < 1.3 * SCATTER * np.sqrt(9 / 4 / 33)
    assert abs(off.mean()) < 4 * SCATTER / np.sqrt(len(points))


@pytest.mark.parametrize("radius", [12.0, 20.0, 60.0])
def test_circles_keep_their_radius(radius):
    """What parabolas leave beyond the fourth power of the angle is t^6 r / 720 and less."""
    points = ring(radius, round(2 * np.pi * radius))
    out = averaged(points, 1e-3, nothing_stays(points))
    assert np.hypot(*out.T) == pytest.approx(radius, abs=3e-3)
    # The circle is even for any noise: the largest window, half the circle at most, is taken.
    far = averaged(points, 1.0, nothing_stays(points))
    half = max(h for h in (2, 4, 8, 16) if 2 * (2 * h + 1) <= len(points))
    assert np.hypot(*far.T) == pytest.approx(radius, abs=radius * (half / radius) ** 6 / 720)


def test_sides_of_a_square_are_even_and_its_corners_stay():
    side = 60
    points = square(side, SCATTER)
    out = averaged(points, SCATTER, nothing_stays(points))
    from_corner = np.abs(points % side - 0.5 * side).min(axis=1)  # of the nearest, 30 - distance
    far, near = from_corner < 30 - 16, from_corner > 30 - 3
    assert np.sqrt((off_square(out[far], side) ** 2).mean()) < 0.5 * SCATTER
    assert off_square(out[near], side).max() < 4 * SCATTER
    # No parabola over a corner: farther than the smallest window no side bends.
    clear = ~near
    assert off_square(out[clear], side).max() < 3 * SCATTER


def test_sides_without_noise_are_exact():
    points = square(40)
    out = averaged(points, 1e-6, nothing_stays(points))
    away = np.abs(points % 40 - 20).min(axis=1) <= 20 - 2.5
    assert off_square(out[away], 40).max() < 1e-6


def test_a_pixel_alone_does_not_keep_its_place():
    points = ring(100.0, 628, 0.2 * SCATTER)
    points[100] *= 1 + 8 * SCATTER / 100.0
    out = averaged(points, SCATTER, nothing_stays(points))
    # The middle of five has 17 / 35 of its own weight.
    assert abs(np.hypot(*out[100]) - 100.0) < 8 * SCATTER * 17 / 35 + SCATTER


def test_what_has_to_stay_does_and_is_no_part_of_windows():
    points = square(60, SCATTER)
    stay = points[:, 1] < 1
    out = averaged(points, SCATTER, stay)
    assert np.array_equal(out[stay], points[stay])
    beside = np.roll(stay, 2) | np.roll(stay, -2)
    assert np.array_equal(out[beside], points[beside])
    free = ~(np.roll(stay, 4) | np.roll(stay, -4) | stay)
    assert (out[free] != points[free]).any(axis=1).all()


def test_few_points_stay():
    points = ring(1.2, 9, SCATTER)
    assert np.array_equal(averaged(points, SCATTER, nothing_stays(points)), points)


def test_many_points_are_the_same_in_parts(monkeypatch):
    points = ring(300.0, 1900, SCATTER)
    whole = averaged(points, SCATTER, nothing_stays(points))
    monkeypatch.setattr("shapespline.tracing.grain.TOGETHER", 300)
    assert np.array_equal(averaged(points, SCATTER, nothing_stays(points)), whole)


def test_rows_and_columns_tell_what_they_are_passed_squarely_by():
    points = square(60, 4 * SCATTER)
    level = np.repeat([True, False, True, False], 60)
    middle = np.abs(points % 60 - 30).min(axis=1) < 20
    told = squarely(points, level)  # crossings of columns on level sides
    assert told[middle].all()
    assert not squarely(points, ~level)[middle].any()


@pytest.mark.parametrize("blur", [0.8, 1.2])
@pytest.mark.parametrize("grain", [6.0, 12.0, 16.0])
def test_scans_have_even_edges_and_corners(blur, grain):
    picture = scanned(polygon(QUADRILATERAL), blur, grain)
    contour = trace(picture, min_area=20).longest
    scatter = softness(picture).scatter
    sides = np.linspace(QUADRILATERAL, np.roll(QUADRILATERAL, -1, axis=0), 4000, axis=1)
    truth = cKDTree(sides.reshape(-1, 2))
    far = cKDTree(QUADRILATERAL).query(contour.points)[0] > 6
    off, level = truth.query(contour.points[far])[0], truth.query(contour.level_line)[0]
    assert np.sqrt((off**2).mean()) < 0.55 * np.sqrt((level**2).mean())
    # Lines through a dozen points whose middle is ten pixels from their corner are off by as much
    # as one point is there.
    assert cKDTree(contour.points).query(QUADRILATERAL)[0].max() < 3.5 * scatter
    assert contour.accuracy == pytest.approx(max(0.04, scatter), rel=1e-9)


def test_a_grainy_edge_at_the_rim_ends_there():
    """What is cut off by the rim is no edge: it stays on it, to the bit."""
    inside = lambda x, y: (x > 40.3) & (y > 30.2)  # noqa: E731
    contour = trace(scanned(inside, 1.2, 12.0)).longest
    points = contour.points
    rim = contour.level_line[np.isin(contour.level_line, (0.0, 120.0)).any(axis=1)]
    away = cKDTree([(40.3, 120.0), (120.0, 30.2), (120.0, 120.0)]).query(rim)[0] > 12
    assert away.sum() > 100
    assert {tuple(one) for one in rim[away].tolist()} <= {tuple(one) for one in points.tolist()}
    assert {(120.0, 120.0)} <= {tuple(one) for one in points.tolist()}
    ends = points[np.isin(points, (0.0, 120.0)).any(axis=1)]
    assert ends[:, 0].min() == pytest.approx(40.3, abs=1.0)
    assert ends[:, 1].min() == pytest.approx(30.2, abs=1.0)


def test_areas_of_grainy_colours_share_even_borders():
    """Two inks side by side on paper: their border, and each one's own."""
    left = coverage(lambda x, y: (np.abs(x - 40) <= 20) & (np.abs(y - 60) <= 35), 120, 120)
    right = coverage(lambda x, y: (x > 60) & (x <= 95) & (np.abs(y - 60) <= 35), 120, 120)
    paper, red, blue = (
        np.array(one, float) for one in ((245, 240, 225), (190, 40, 50), (30, 50, 140))
    )
    picture = paper + left[..., None] * (red - paper) + right[..., None] * (blue - paper)
    from scipy.ndimage import gaussian_filter

    rng = np.random.default_rng(4)
    picture = gaussian_filter(picture, (1.2, 1.2, 0)) + rng.normal(0, 10, picture.shape)
    shape = trace(np.rint(np.clip(picture, 0, 255)).astype(np.uint8), colors=3)
    # The border of both inks is one, to the bit, from junction to junction.
    rows = [{tuple(point) for point in contour.points.tolist()} for contour in shape]
    shared = [one & other for k, one in enumerate(rows) for other in rows[k + 1 :]]
    between = np.array([point for both in shared for point in both if abs(point[0] - 60) < 1.5])
    assert len(between) > 40
    assert np.ptp(between[:, 1]) == pytest.approx(70.0, abs=2.0)
    edges = np.array([20.0, 60.0, 95.0])
    offs = []
    for contour in shape:
        points = contour.points
        upright = (np.abs(points[:, 1] - 60) < 25) & (points[:, 0] > 5) & (points[:, 0] < 115)
        offs.append(np.abs(points[upright, 0, None] - edges).min(axis=1))
    off = np.concatenate(offs)
    assert len(off) > 100
    # Noise of 10 over the weakest contrast, 175, and the slope of an edge blurred by 1.2.
    scatter = 10 / 175 * np.sqrt(2 / 3) * np.sqrt(2 * np.pi * (1.2**2 + 1 / 12))
    assert np.sqrt((off**2).mean()) < 0.6 * scatter


def test_long_sides_tell_corners():
    """Twelve scans: what sides of 6 pixels tell is off by half as much again."""
    offs = []
    for seed in range(12):
        picture = scanned(polygon(QUADRILATERAL), 1.2, 12.0, seed=seed)
        contour = trace(picture, min_area=20).longest
        offs.append(cKDTree(contour.points).query(QUADRILATERAL)[0])
    scatter = softness(picture).scatter
    assert np.sqrt(np.mean(np.square(offs))) < 1.2 * scatter


def test_arcs_on_long_sides_are_no_lines():
    """The tip of a tooth, 26 pixels of a circle of 130: a line is 0.4 too far out at its ends."""
    inside = lambda x, y: (np.hypot(x - 60, y + 60) <= 130) & (np.abs(x - 60) <= 13) & (y > 20)  # noqa: E731
    tips = np.array([(47.0, -60 + np.sqrt(130**2 - 13**2)), (73.0, -60 + np.sqrt(130**2 - 13**2))])
    out = []
    for seed in range(12):
        contour = trace(scanned(inside, 1.0, 10.0, seed=seed), min_area=20).longest
        near = contour.points[cKDTree(contour.points).query(tips)[1]]
        out.append(near[:, 1] - tips[:, 1])
    assert abs(np.mean(out)) < 0.15
