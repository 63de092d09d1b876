"""Which pixels show the ground: of figures as large as their pictures the corners."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.rendering import coverage, dark, tile

import shapespline as ss
from shapespline.tracing import trace

SIDE = 60


def window(x, y):
    """A square with round corners and a square hole."""
    return tile(SIDE, 14)(x, y) & ~((np.abs(x - SIDE / 2) < 8) & (np.abs(y - SIDE / 2) < 8))


COLOR, SECOND, LIGHT = np.array([(20.0, 60, 200), (230, 190, 40), (250, 240, 200)])


def pictures():
    cover = coverage(window, SIDE, SIDE)
    upper = np.broadcast_to(np.arange(SIDE)[:, None, None] < SIDE / 2, (SIDE, SIDE, 3))
    two, light = np.where(upper, COLOR, SECOND), np.where(upper, SECOND, LIGHT)
    opaque = 255 * cover[..., None]
    yield "grey", dark(cover)
    yield "float", 1000 * (1 - cover) + 7
    yield "16 bits", 257 * dark(cover).astype(np.uint16)
    yield "colour", 255 + cover[..., None] * (COLOR - 255)
    yield "clear ground", np.dstack([np.zeros((SIDE, SIDE, 3)), opaque])
    yield "colours on clear ground", np.dstack([two, opaque])
    yield "light colours on clear ground", np.dstack([light, opaque])


PICTURES = dict(pictures())


@pytest.mark.parametrize("name", PICTURES)
def test_paper_shows_in_the_corners_of_a_figure_that_fills_its_picture(name):
    picture = PICTURES[name]
    if picture.dtype == float and name != "float":
        picture = np.rint(picture).astype(np.uint8)
    shape = trace(picture)
    assert shape.parents == (-1, 0)
    sizes = [np.ptp(contour.points, axis=0).max() for contour in shape]
    np.testing.assert_allclose(sizes, [SIDE, 16], atol=0.1)


def test_light_figures_on_dark_ground_stay_so():
    def letter(x, y):
        return (np.abs(x - 30) < 6) & (np.abs(y - 30) < 20)

    def cross(x, y):
        return np.minimum(np.abs(x - y), np.abs(x + y - SIDE)) < 5

    figure = coverage(letter, SIDE, SIDE)
    framed = np.pad(np.pad(figure, 70), 1, constant_values=1.0)  # thinner than the rim that is seen
    for cover, n_outlines in ((figure, 1), (framed, 3)):
        assert len(trace(255 - dark(cover))) == n_outlines
    # Dark in the corners, light on most of the rim: the rim tells.
    (outline,) = trace(dark(coverage(cross, SIDE, SIDE)))
    assert ss.geometry.signed_area(outline.points) < 0.5 * SIDE**2


def test_opaque_is_ink_whatever_the_rim_is():
    opaque = np.full((SIDE, SIDE), 255, dtype=np.uint8)
    opaque[20:40, 20:40] = 0
    shape = trace(np.dstack([np.zeros((SIDE, SIDE, 3), dtype=np.uint8), opaque]))
    assert shape.parents == (-1, 0)
    assert_array_equal(np.ptp(shape.contours[0].points, axis=0), [SIDE, SIDE])
