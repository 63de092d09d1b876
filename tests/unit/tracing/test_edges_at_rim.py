"""Figures as large as their pictures: nothing of them is cut, and paper around them is no ink."""

from __future__ import annotations

import io

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from PIL import Image
from scipy.spatial import cKDTree
from tests.support.rendering import coverage, dark, polygon, tile

import shapespline as ss
from shapespline.tracing import trace

SIDE = 60
TILE = tile(SIDE, 14)
# The parts of a pixel that are counted by samples of a 32nd come to a quarter of one more or less
# along an edge, rounding to 8 bits to 1/510 a pixel over the few that an edge greys.
READ = 1 / 64


def disc(x, y):
    return np.hypot(x - SIDE / 2, y - SIDE / 2) <= SIDE / 2


def ends_before(x, y):
    """A tile a part of a pixel smaller on two sides."""
    return TILE(x * SIDE / (SIDE - 0.3), y * SIDE / (SIDE - 0.6))


def turned_square(x, y):
    return np.abs(x - SIDE / 2) + np.abs(y - SIDE / 2) <= SIDE / 2


def window(x, y):
    """A tile with a square hole."""
    return TILE(x, y) & ~((np.abs(x - SIDE / 2) < 8) & (np.abs(y - SIDE / 2) < 8))


def corner_piece(x, y):
    """On more than half of the rim, on two corners."""
    return ((x < 25) | (y > SIDE - 25)) & TILE(x, y)


FIGURES = {
    "disc": disc,
    "tile": TILE,
    "ends before": ends_before,
    "turned square": turned_square,
    "window": window,
    "corner piece": corner_piece,
}


@pytest.mark.parametrize("name", FIGURES)
def test_cut_to_the_figure_a_picture_shows_the_same(name):
    cover = coverage(FIGURES[name], SIDE, SIDE)
    cut, wide = trace(dark(cover)), trace(dark(np.pad(cover, 9)))
    assert cut.parents == wide.parents
    for one, other in zip(cut, wide, strict=True):
        assert one.accuracy == other.accuracy
        for a, b in ((one.points, other.points - 9), (other.points - 9, one.points)):
            closed = ss.Contour.silently(b, closed=True).resampled(8000).points
            # Corners at the rim are proven by less of the picture, and put back alike.
            assert cKDTree(closed).query(a)[0].max() < 2 * READ
    size = np.array([SIDE, SIDE])
    assert all(((c.points >= 0) & (c.points <= size)).all() for c in cut)


def test_a_circle_that_fills_its_picture_is_one():
    drawing = ss.fit_shape(trace(dark(coverage(disc, SIDE, SIDE))))
    (arc,) = drawing.fits[0].pieces
    assert arc.kind == "arc"
    assert abs(arc.arc.radius - SIDE / 2) < READ
    assert np.hypot(*np.subtract(arc.arc.centre, SIDE / 2)) < READ


def test_what_is_cut_off_ends_at_the_rim_to_the_bit():
    def slope(x, y):
        return y < 0.3 * x + 20

    (outline,) = trace(dark(coverage(slope, SIDE, SIDE)))
    points = outline.points
    inner = points[((points > 1.5) & (points < SIDE - 1.5)).all(axis=1)]
    off = (inner[:, 1] - 0.3 * inner[:, 0] - 20) / np.hypot(1, 0.3)
    assert np.abs(off).max() < READ
    along = (points[:, 0] > 1.5) & (points[:, 0] < SIDE - 1.5) & (points[:, 1] < 1.5)
    assert along.sum() > SIDE - 5
    assert_array_equal(points[along, 1], 0.0)
    assert {(0.0, 0.0), (float(SIDE), 0.0)} <= set(map(tuple, points.tolist()))


def test_a_scan_cut_to_the_figure_does_not_leave_it():
    corners = [(0.2, 20), (59.8, 4), (50, 56), (8, 50)]
    sharp = 40 + 0.7 * dark(coverage(polygon(corners), SIDE, SIDE)).astype(float)
    grain = np.random.default_rng(4).normal(0, 6, sharp.shape)
    stream = io.BytesIO()
    Image.fromarray(np.rint(np.clip(sharp + grain, 0, 255)).astype(np.uint8)).save(stream, "JPEG")
    (outline,) = trace(np.asarray(Image.open(stream)))
    assert outline.points.min() >= 0
    assert outline.points.max() <= SIDE
