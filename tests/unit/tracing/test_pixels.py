"""Which value of a pixel counts: channels, alpha, what differs from the rim, a colour, any type."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.tracing import trace


def glyph(shape=(40, 40)):
    cover = np.zeros(shape)
    cover[10:30, 15:25] = 1.0
    cover[10:30, 14] = 0.25
    return cover


def painted(foreground, background, cover, dtype=np.uint8):
    mixed = cover[..., None] * np.array(foreground) + (1 - cover[..., None]) * np.array(background)
    return np.rint(mixed).astype(dtype)


EXPECTED = trace(np.rint(255 * glyph()).astype(np.uint8), level=127.5)


@pytest.mark.parametrize(
    ("foreground", "background"),
    [
        ((0, 0, 0), (255, 255, 255)),
        ((255, 255, 255), (0, 0, 0)),
        ((200, 30, 30), (30, 117, 30)),  # of the same lightness: 77.7 and 77.7
        ((255, 255, 0), (255, 255, 255)),
        ((0, 0, 90), (0, 0, 0)),
    ],
)
def test_what_differs_from_the_rim_is_found_in_any_colour(foreground, background):
    shape = trace(painted(foreground, background, glyph()))
    # Rounding of the grey seam: half a unit of at least 90, over one pixel.
    assert np.allclose(shape.longest.points, EXPECTED.longest.points, atol=1 / 90)


@pytest.mark.parametrize("colour", [(0, 0, 0), (255, 255, 255), (90, 200, 20)])
@pytest.mark.parametrize("hidden", [0, 255])
def test_one_colour_on_a_transparent_ground_is_its_alpha(colour, hidden):
    cover = glyph()
    image = painted(colour, (hidden,) * 3, np.ceil(cover))
    image = np.dstack([image, np.rint(255 * cover).astype(np.uint8)])
    assert np.array_equal(trace(image).longest.points, EXPECTED.longest.points)
    assert np.array_equal(trace(image, channel="alpha").longest.points, EXPECTED.longest.points)


@pytest.mark.parametrize("colours", [((0, 0, 0), (120, 0, 0)), ((255, 255, 255), (255, 255, 160))])
def test_several_colours_on_a_transparent_ground_are_laid_on_what_shows_them(colours):
    cover = glyph()
    image = painted(colours[0], colours[0], cover)
    image[:20] = colours[1]
    image = np.dstack([image, np.rint(255 * cover).astype(np.uint8)])
    points = trace(image).longest.points
    assert np.abs(points.min(axis=0) - EXPECTED.longest.points.min(axis=0)).max() < 0.5
    assert np.abs(points.max(axis=0) - EXPECTED.longest.points.max(axis=0)).max() < 0.5


def test_channels():
    image = painted((255, 100, 0), (0, 100, 255), glyph())
    for channel in ("red", "blue", "grey"):
        points = trace(image, channel=channel).longest.points
        assert np.allclose(points, EXPECTED.longest.points, atol=0.02)
    with pytest.raises(DegenerateContourError, match="every pixel has the value 100"):
        trace(image, channel="green")


@pytest.mark.parametrize(
    ("dtype", "scale"), [(np.uint16, 257), (np.int64, 1), (np.float32, 1 / 255), (np.float64, 100)]
)
def test_the_unit_of_the_picture_does_not_matter(dtype, scale):
    image = (np.rint(255 * glyph()) * scale).astype(dtype)
    assert np.allclose(trace(image).longest.points, EXPECTED.longest.points, atol=0.01)
    found = trace(image, level=127.5 * scale)
    assert np.allclose(found.longest.points, EXPECTED.longest.points, atol=0.01)


def test_a_boolean_mask_has_its_edges_half_way():
    points = trace(glyph() > 0.5).longest.points
    assert points.min(axis=0).tolist() == [15, 10]
    assert points.max(axis=0).tolist() == [25, 30]


def blots():
    """Red on the left, green in the middle, on white."""
    image = np.full((40, 90, 3), 255, dtype=np.uint8)
    image[10:30, 10:30] = (220, 20, 20)
    image[10:30, 40:70] = (20, 160, 20)
    return image


@pytest.mark.parametrize(
    ("color", "box"),
    [
        ("#dc1414", (10, 10, 30, 30)),
        ("rgb(20,160,20)", (40, 10, 70, 30)),
        ("@50,20", (40, 10, 70, 30)),
        ("@15,15", (10, 10, 30, 30)),
    ],
)
def test_the_shape_of_a_colour(color, box):
    (contour,) = trace(blots(), color=color)
    # The level between two colours lies somewhere in the one pixel between their centres.
    assert np.abs(contour.points.min(axis=0) - box[:2]).max() <= 0.5
    assert np.abs(contour.points.max(axis=0) - box[2:]).max() <= 0.5


@pytest.mark.parametrize("color", ["reddish", "@1", "@90,0", "@-1,0", 7])
def test_colours_that_are_none(color):
    with pytest.raises(InvalidInputError, match="color"):
        trace(blots(), color=color)


def test_one_way_to_see_ink():
    with pytest.raises(InvalidInputError, match="color excludes channel and polarity"):
        trace(blots(), color="red", channel="green")
