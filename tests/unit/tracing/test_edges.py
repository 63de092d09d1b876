"""Edges, strokes and corners lie where they were drawn, not where a level line leaves them."""

from __future__ import annotations

import numpy as np
import pytest
from contourpy import contour_generator
from matplotlib.path import Path as MplPath
from scipy.spatial import cKDTree
from tests.support.rendering import SAMPLES, coverage, dark, polygon, strip

import shapespline as ss
from shapespline.tracing import trace
from shapespline.tracing.corners import ANGLES, CUT_OFF
from shapespline.tracing.coverage import border_coverage

# Rounding to 8 bits moves each of some five pixels across an edge by 1/2 of 255, and counting
# samples moves the edge by half of their distance at most.
ROUNDING = 5 * 0.5 / 255 + 0.5 / SAMPLES


@pytest.mark.parametrize("angle", [0.0, 1.0, 5.0, 12.0, 22.0, 35.0, 45.0, 80.0])
def test_a_straight_edge_is_exact_where_its_level_line_is_not(angle):
    normal = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    middle = np.array([30.3, 29.9])
    image = dark(
        coverage(lambda x, y: (x - 30.3) * normal[0] + (y - 29.9) * normal[1] <= 0, 60, 60)
    )
    contour = trace(image, polarity="dark").longest
    inner = np.abs(contour.points - 30).max(axis=1) < 22
    off = (contour.points[inner] - middle) @ normal
    assert np.abs(off).max() <= ROUNDING
    line = contour.level_line[np.abs(contour.level_line - 30).max(axis=1) < 22]
    assert np.abs((line - middle) @ normal).max() > ROUNDING
    assert contour.accuracy == 0.02


@pytest.mark.slow
@pytest.mark.parametrize("width", [1.0, 1.3, 1.7, 2.0])
@pytest.mark.parametrize("angle", [0.0, 3.0, 17.0, 90.0])
@pytest.mark.parametrize("shift", [0.0, 0.25, 0.5])
def test_a_thin_stroke_is_whole_and_as_wide_as_it_was_drawn(width, angle, shift):
    middle = np.array([30 + shift, 30 + shift])
    image = dark(coverage(strip(angle, width, middle), 60, 60))
    image = np.pad(image, ((0, 9), (0, 0)), constant_values=255)
    image[63:67, 5:55] = 0  # what ink is where it covers a pixel
    contour = trace(image, polarity="dark").longest
    middle[1] += 9
    normal = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    inner = contour.points[np.abs(contour.points - (30, 39)).max(axis=1) < 22]
    off = (inner - middle) @ normal
    assert off.min() < 0 < off.max()
    # Of a stroke at an angle the two sides are told apart by their common border: twice as rough.
    assert np.abs(np.abs(off) - 0.5 * width).max() <= 2 * ROUNDING + 0.02


def test_corners_are_put_back():
    corners = np.array([(12.3, 10.7), (50.1, 15.2), (46.4, 48.8), (20.2, 40.6)])
    (contour,) = trace(dark(coverage(polygon(corners), 60, 60)))
    distance = np.hypot(*(contour.points[:, None] - corners).transpose(2, 0, 1)).min(axis=0)
    assert distance.max() <= 0.06
    cut = np.hypot(*(contour.level_line[:, None] - corners).transpose(2, 0, 1)).min(axis=0)
    assert cut.min() > 0.1


@pytest.mark.parametrize("shift", [(0.5, 0.5), (0.4, 0.55), (0.02, 0.5), (0.97, 0.03)])
def test_right_angles_are_put_back_wherever_they_lie_in_a_pixel(shift):
    """In the middle of a pixel a level line cuts off half of its diagonal."""
    corners = np.array([(10, 10), (48, 10), (48, 30), (10, 30)]) + shift
    (contour,) = trace(dark(coverage(polygon(corners), 60, 60)))
    distance = np.hypot(*(contour.points[:, None] - corners).transpose(2, 0, 1)).min(axis=0)
    assert distance.max() <= np.sqrt(2) * ROUNDING


def test_a_narrow_notch_with_a_blunt_end_gets_no_long_tip():
    """Its sides would meet 1.6 pixels farther, where no more than 0.4 square pixels differ."""

    def inside(x, y):
        left = 23.8 + (y - 34.1) * np.tan(np.radians(17.0))
        notch = (y < 34.1) & (x > left) & (x < 24.3)
        return (np.abs(x - 30) < 25) & (np.abs(y - 30) < 25) & ~notch

    contour = trace(dark(coverage(inside, 60, 60)), polarity="dark").longest
    near = contour.points[np.abs(contour.points[:, 0] - 24.3) < 2]
    assert near[near[:, 1] < 50, 1].max() <= 34.1 + 0.5


@pytest.mark.parametrize(
    ("degrees", "turn", "radius", "shift"), [(50, 72, 0.7, 0), (30, 120, 0.5, 0.6)]
)
def test_a_rounded_finger_gets_no_tip(degrees, turn, radius, shift):
    """Sides that are looked at from nearer than usual may not miss as much ink (TRC-07)."""
    half, along = np.radians(degrees) / 2, np.radians(turn)
    ahead = np.array([np.cos(along), np.sin(along)])
    tip = np.array([32 + shift, 32 + 0.3 * shift])
    middle = tip + ahead * radius / np.sin(half)

    def finger(x, y):
        s = (x - tip[0]) * ahead[0] + (y - tip[1]) * ahead[1]
        across = np.abs((y - tip[1]) * ahead[0] - (x - tip[0]) * ahead[1])
        beyond = s >= radius / np.tan(half) * np.cos(half)  # where the rounding has ended
        rounding = np.hypot(x - middle[0], y - middle[1]) <= radius
        return (across <= s * np.tan(half)) & (s <= 22) & (beyond | rounding)

    (contour,) = trace(dark(coverage(finger, 64, 64)))
    rounded = radius / np.sin(half) - radius
    # No more than half of what the rounding took comes back.
    assert np.hypot(*(contour.points - tip).T).min() >= 0.5 * rounded


def wedge(angle, direction, corner, size):
    """A sector of straight sides within a square picture, counter-clockwise."""
    far = 4 * size
    rays = direction + 0.5 * angle * np.array([-1, 0, 1])
    points = [corner, *(corner + far * np.column_stack([np.cos(rays), np.sin(rays)]))]
    for axis, sign, limit in ((0, 1, 0), (0, -1, size), (1, 1, 0), (1, -1, size)):
        before, clipped = points[-1], []
        for point in points:
            gaps = sign * (before[axis] - limit), sign * (point[axis] - limit)
            if (gaps[0] > 0) != (gaps[1] > 0):
                clipped.append(before + gaps[0] / (gaps[0] - gaps[1]) * (point - before))
            if gaps[1] > 0:
                clipped.append(point)
            before = point
        points = clipped
    return np.array(points)


@pytest.mark.parametrize("degrees", [15.0, 20.0, 30.0, 37.5, 45.0, 60.0, 75.0, 90.0, 120.0, 150.0])
def test_no_level_line_is_farther_from_a_corner_than_the_table_says(degrees):
    random, size, farthest = np.random.default_rng(int(degrees)), 18, 0.0
    rows = np.arange(size)
    for turn in (0.0, np.radians(0.5 * degrees), *random.uniform(0, 2 * np.pi, 58)):
        corner = 0.5 * size + random.uniform(-0.5, 0.5, 2)
        outline = wedge(np.radians(degrees), turn, corner, size)
        keys, part, _ = border_coverage([outline], size, size)
        cover = np.array(
            [
                [MplPath(outline).contains_point((c + 0.5, size - r - 0.5)) for c in rows]
                for r in rows
            ],
            dtype=float,
        )
        cover.reshape(-1)[keys] = part
        lines = contour_generator(rows + 0.5, size - rows - 0.5, cover).lines(0.5)
        line = ss.Contour(max(lines, key=len), closed=False).resampled(4000).points
        farthest = max(farthest, np.hypot(*(line - corner).T).min())
    assert farthest <= np.interp(degrees, ANGLES, CUT_OFF)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["tee", "comb", "gear 18", "puzzle"])
def test_corners_of_drawings_are_put_back(name):
    """A corner that fails takes no other with it; sides that are disturbed farther are tried."""
    from benchmarks.drawn.tables import rendered
    from benchmarks.drawn.truth import turn_of

    outlines, picture = rendered(name, 256)
    points = np.concatenate([contour.points for contour in trace(picture)])
    off = [
        np.hypot(*(points - before.end).T).min()
        for outline in outlines
        for before, after in zip(outline, outline[1:] + outline[:1], strict=True)
        if abs(turn_of(before, after)) > 60
    ]
    # One of 140: its tooth's tip is bent within the reach of a side.
    assert np.count_nonzero(np.array(off) > 0.1) <= (name == "gear 18")


@pytest.mark.parametrize(("length", "half"), [(30, 9), (33, 12)])
def test_the_end_of_a_stroke_of_two_pixels_stays(length, half):
    """Its sides meet nowhere: they were taken for a corner of 180 degrees, 2.5 pixels back."""
    image = np.full((length + 8, 2 * half + 8), 255, dtype=np.uint8)
    image[3:5, 4 : 4 + 2 * half] = 0
    image[4 : 4 + length, 3 + half : 5 + half] = 0
    image[4 + length, 3 + half : 5 + half] = 48
    image[3:5, [3, 4 + 2 * half]] = 48
    (contour,) = trace(image)
    # Of the last row 48 of 255 is ground.
    assert contour.points[:, 1].min() == pytest.approx(3 + 48 / 255, abs=0.02)


def test_a_fit_tells_its_distance_to_the_level_line():
    corners = np.array([(12.3, 10.7), (50.1, 15.2), (46.4, 48.8), (20.2, 40.6)])
    (contour,) = trace(dark(coverage(polygon(corners), 60, 60)))
    fit = ss.fit_curve(contour, tolerance=0.05)
    assert fit.hausdorff_distance <= 0.05
    line = ss.Contour(contour.level_line, closed=True).resampled(8000).points
    curve = fit.curve(np.linspace(0, 1, 4001))
    apart = max(cKDTree(line).query(curve)[0].max(), cKDTree(curve).query(line)[0].max())
    # Samples are 0.04 apart at most, and the bound is tight to a thousandth.
    assert apart - 0.04 <= fit.source_distance <= 1.01 * apart + 0.04
    assert fit.source_distance > 0.1
    assert ss.fit_curve(corners, closed=True, tolerance=0.05).source_distance is None


def test_a_rounding_of_two_pixels_stays_round():
    def inside(x, y):
        dx, dy = np.maximum(np.abs(x - 30) - 13, 0), np.maximum(np.abs(y - 30) - 13, 0)
        return np.hypot(dx, dy) <= 2

    (contour,) = trace(dark(coverage(inside, 60, 60)))
    # The corner of the square around it is (sqrt(2) - 1) 2 = 0.83 outside.
    beyond = np.abs(contour.points - 30) - 13
    rounded = (beyond > 0).all(axis=1)
    assert np.hypot(*beyond[rounded].T).max() <= 2 + 0.1


def test_a_rectangle_on_the_pixel_grid_is_exact():
    image = np.full((30, 40), 255, dtype=np.uint8)
    image[5:20, 10:30] = 0
    (contour,) = trace(image)
    assert contour.accuracy == 0.02
    corners = {(10.0, 10.0), (30.0, 10.0), (30.0, 25.0), (10.0, 25.0)}
    assert corners <= {tuple(point) for point in contour.points.tolist()}
    on_edge = (np.isin(contour.points[:, 0], (10, 30))) | (np.isin(contour.points[:, 1], (10, 25)))
    assert on_edge.all()


@pytest.mark.parametrize(("noise", "least"), [(8.0, 0.07), (20.0, 0.09)])
def test_in_noise_the_level_line_stays(noise, least):
    rng = np.random.default_rng(3)
    image = 205 - 150 * coverage(lambda x, y: np.hypot(x - 30, y - 30) <= 18, 60, 60)
    image = np.rint(np.clip(image + rng.normal(0, noise, image.shape), 0, 255)).astype(np.uint8)
    contour = trace(image, min_area=20, local="off").longest
    assert contour.accuracy == pytest.approx(least, abs=0.005)
    off = np.hypot(*(contour.points - 30).T) - 18
    assert np.sqrt((off**2).mean()) < 1.5 * contour.accuracy
    assert np.array_equal(contour.points, contour.level_line)
