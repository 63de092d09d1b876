"""Strokes of one pen where its ink hides or fills what the medial axis tells: fat pens, icons.

Rendered by counting samples within half a pen's width of known lines, so edges are known to an
eighth of a pixel; a middle is where both sides put it.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.support.each import each
from tests.support.pens import arc, picture, samples
from tests.support.places import ROOT

import shapespline as ss

SIZE = (100, 120)
# An edge is known to an eighth of a pixel by the samples of a pixel, and a corner of 30 degrees
# multiplies that by four.
NEAR = 0.5
# Sides of a thin pen have few pixels between junctions: a bent one meets another within a pixel.
THIN = 1.0


def rectangle(left, top, right, bottom, radius):
    corners = [
        arc(right - radius, top + radius, radius, -90, 0),
        arc(right - radius, bottom - radius, radius, 0, 90),
        arc(left + radius, bottom - radius, radius, 90, 180),
        arc(left + radius, top + radius, radius, 180, 270),
    ]
    return np.concatenate([*corners, corners[0][:1]])


LETTER_N = [[(25, 80), (25, 20), (65, 80), (65, 20)]]
ARROW = [[(30, 55), (50, 80), (70, 55)], [(50, 80), (50, 15)]]
CROSSED = [arc(60, 50, 32, 0, 360), [(15, 15), (105, 85)]]
FRAMES = [rectangle(20, 10, 100, 50, 14), rectangle(20, 50, 100, 90, 14)]
LOCK = [[(20, 45), (100, 45), (100, 90), (20, 90), (20, 45)], arc(60, 45, 22, 180, 360)]
DOLLAR = [[(30, 30), (90, 30)], [(60, 22), (60, 30)], [(60, 30), (60, 85)]]
# 24 degrees: both sides of the corner lead nearly opposite ways.
POINTED = [[(20, 80), (35, 12), (50, 80)]]
DRAWINGS = {
    "N": (LETTER_N, 14.0),
    "arrow": (ARROW, 14.0),
    "crossed ring": (CROSSED, 12.0),
    "frames": (FRAMES, 12.0),
    "lock": (LOCK, 14.0),
    "stub": (DOLLAR, 14.0),
    "pointed": (POINTED, 6.0),
    "thin N": (LETTER_N, 4.0),
    "thin lock": (LOCK, 4.0),
}


def traced(lines, width, size=SIZE):
    """The centre lines, y down as the lines are."""
    shape = ss.trace(picture(lines, width, size), centerline=True)
    return shape, [contour.polyline * (1, -1) + (0, size[0]) for contour in shape]


@each(DRAWINGS)
def test_strokes_lie_where_the_pen_was(name):
    lines, width = DRAWINGS[name]
    shape, found = traced(lines, width)
    true, own = samples(lines), samples(found)
    near = THIN if width < 6.0 else NEAR
    assert cKDTree(own).query(true)[0].max() <= near
    assert cKDTree(true).query(own)[0].max() <= near
    assert np.abs(np.array(shape.widths) - width).max() <= 0.25


@each(DRAWINGS)
def test_no_stroke_is_found_twice(name):
    lines, width = DRAWINGS[name]
    _, found = traced(lines, width)
    length = sum(np.hypot(*np.diff(line, axis=0).T).sum() for line in found)
    true = sum(np.hypot(*np.diff(np.asarray(line), axis=0).T).sum() for line in lines)
    shared = 52.0 if name == "frames" else 0.0  # the straight side that both have
    assert length == pytest.approx(true - shared, rel=0.02)


def test_what_is_filled_by_a_narrow_ring_is_a_ring():
    ring = arc(60, 50, 9, 0, 360)
    shape, found = traced([rectangle(10, 10, 110, 90, 20), ring], 14.0)
    (small,) = (line for line, own in zip(found, shape, strict=True) if own.length < 100)
    assert np.abs(np.hypot(*(small - (60, 50)).T) - 9).max() <= NEAR


def test_one_bit_sides_are_no_strokes_of_their_own():
    # They are too uneven for a pen; taken for one, both sides were strokes: 22.
    lines = DRAWINGS["arrow"][0]
    one_bit = np.where(picture(lines, 10.0, SIZE) < 128, 0, 255).astype(np.uint8)
    assert len(ss.trace(one_bit, centerline=True)) <= 4


def test_dots_beside_strokes_are_kept():
    dots = [[(30, 50), (30.01, 50)], [(80, 50), (80.01, 50)]]
    shape, found = traced([rectangle(10, 10, 110, 90, 20), *dots], 10.0)
    assert len(shape) == 3
    short = [line for line, own in zip(found, shape, strict=True) if own.length < 1]
    assert sorted(float(line.mean(axis=0)[0]) for line in short) == pytest.approx([30, 80], abs=0.1)
    assert shape.widths[-1] == pytest.approx(10, abs=0.25)


def test_a_blot_wider_than_the_pen_is_no_ring():
    # A ring of the pen would leave its middle white.
    blot = picture([[(60, 50), (60.01, 50)]], 44.0, SIZE)
    frame = picture([rectangle(10, 10, 110, 90, 10)], 6.0, SIZE)
    shape = ss.trace(np.minimum(blot, frame), centerline=True)
    assert len(shape) == 2
    assert list(shape)[1].length < 1
    assert shape.widths[1] == pytest.approx(44, abs=0.25)


@each(["fa_gear_256.png", "gameicons_oak-leaf_256.png"])
def test_what_no_pen_has_drawn_stays_few_strokes(name):
    # Read as a pen's the gear was 18 strokes, the leaf 31.
    shape = ss.trace(ROOT / "examples/data/images" / name, centerline=True)
    assert len(shape) <= 8


def test_loops_end_in_one_junction_and_have_points_between():
    loop = [
        [(20, 70), (60, 70)],
        arc(60, 52, 18, 90, 360),
        [(78, 52), (78, 90)],
        [(60, 70), (100, 70)],
    ]
    shape, found = traced(loop, 8.0)
    own = samples(found)
    assert cKDTree(own).query(samples(loop))[0].max() <= NEAR
    assert all(len(contour) >= 2 for contour in shape)


@each([1, 2, 3])
def test_a_scan_keeps_its_strokes(seed):
    lines, width = DRAWINGS["lock"]
    random = np.random.default_rng(seed)
    scan = picture(lines, width, SIZE) * 0.8 + 25 + random.normal(0, 6, SIZE)
    shape = ss.trace(np.clip(scan, 0, 255).astype(np.uint8), centerline=True)
    found = samples([contour.polyline * (1, -1) + (0, SIZE[0]) for contour in shape])
    assert cKDTree(found).query(samples(lines))[0].max() <= 2.0


def test_beside_other_ink_an_end_stays_where_it_is():
    # The end of the upright is five pixels above the bar.
    lines = [[(60, 15), (60, 60)], [(20, 75), (100, 75)]]
    _, found = traced(lines, 10.0)
    assert cKDTree(samples(lines)).query(samples(found))[0].max() <= NEAR


def test_a_bent_stroke_with_square_ends_reaches_them():
    rows, columns = np.mgrid[: 4 * SIZE[0], : 4 * SIZE[1]]
    x, y = (columns + 0.5) / 4 - 60, (rows + 0.5) / 4 - 85
    angle = np.degrees(np.arctan2(-y, x))
    ink = (np.abs(np.hypot(x, y) - 60) <= 7) & (np.abs(angle - 90) <= 50)
    counted = ink.reshape(SIZE[0], 4, SIZE[1], 4).mean(axis=(1, 3))
    (found,) = ss.trace(np.rint(255 * (1 - counted)).astype(np.uint8), centerline=True)
    points = found.points * (1, -1) + (-60, SIZE[0] - 85)
    assert np.abs(np.hypot(*points.T) - 60).max() <= NEAR
    ends = np.degrees(np.arctan2(-points[[0, -1], 1], points[[0, -1], 0]))
    assert np.radians(np.abs(np.sort(ends) - (40, 140))).max() * 60 <= NEAR
