"""The level follows the light where one alone would not do; options steer what is looked at."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.rendering import word

from shapespline.errors import InvalidInputError, PictureWarning
from shapespline.tracing import trace


def lit(light, text="No. 9 gä", noise=1.0):
    """A word and a bar under a light, as a factor for each pixel."""
    letters = word(text, 40, margin=40).astype(float)
    letters[8:24, 30:150] = 0
    rows, columns = letters.shape
    y, x = np.mgrid[-1 : 1 : rows * 1j, -1 : 1 : columns * 1j]
    grain = np.random.default_rng(0).normal(0, noise, letters.shape)
    image = (40 + 0.8 * letters) * light(x, y) + grain
    return np.rint(np.clip(image, 0, 255)).astype(np.uint8)


LIGHTS = {
    "from the left": lambda x, y: 0.68 - 0.32 * x,
    "vignette": lambda x, y: 1 - 0.36 * (x**2 + y**2),
}


def counted(shape):
    holes = sum(shape.is_hole(index) for index in range(len(shape)))
    return len(shape) - holes, holes


@pytest.mark.slow
@pytest.mark.parametrize("light", LIGHTS.values(), ids=LIGHTS.keys())
def test_uneven_light_is_found_and_told(light):
    expected = (9, 4)  # N, o, dot, 9, g, a, its two dots and the bar; counters of o, 9, g and a
    assert counted(trace(lit(lambda x, y: 1.0))) == expected
    with pytest.warns(PictureWarning, match="unevenly lit"):
        shape = trace(lit(light))
    assert counted(shape) == expected
    assert counted(trace(lit(light), local="off", min_area=10)) != expected


def test_grain_on_soft_level_edges_is_no_uneven_light():
    from scipy.ndimage import gaussian_filter

    image = np.full((160, 200), 255.0)
    image[40:120, 30:170] = 0
    image[[39, 120], 30:170] = 128  # which grain lets the level line cross again and again
    grain = np.random.default_rng(3).normal(0, 12.0, image.shape)
    image = np.clip(20 + 0.8 * gaussian_filter(image, 1.2) + grain, 0, 255)
    shape = trace(np.rint(image).astype(np.uint8))
    assert len(shape) == 1
    low, high = shape.contours[0].points.min(axis=0), shape.contours[0].points.max(axis=0)
    # Edges at 30, 170 and half-way through rows 39 and 120; four deviations of grain over a slope.
    assert np.abs(np.concatenate([low, high]) - [30, 39.5, 170, 120.5]).max() < 4 * 0.2


@pytest.mark.parametrize("size", [(60, 60), (200, 300)])
def test_of_two_inks_that_tell_as_much_the_shorter_border_is_taken(size):
    ramp = np.tile(np.linspace(0, 255, size[1]).astype(np.uint8), (size[0], 1))
    for image in (ramp, ramp[:, ::-1], 255 - ramp):
        with pytest.warns(PictureWarning, match="unevenly lit"):
            assert len(trace(image)) == 1


@pytest.mark.parametrize("size", [(200, 1000), (500, 1000), (200, 2048)])
def test_the_steps_of_a_ramp_are_no_ink(size):
    """Where 8 bits round a ramp they leave bands, which are edges of one step each."""
    height, width = size
    ramp = np.tile(np.rint(np.linspace(0, 255, width)).astype(np.uint8), (height, 1))
    shape = trace(ramp)
    assert len(shape) == 1
    assert np.ptp(shape.contours[0].points, axis=0).tolist() == [width / 2, height]


def test_a_way_that_is_noise_is_passed_over():
    ramp = np.tile(np.rint(np.linspace(0, 255, 500)).astype(np.uint8), (500, 1))
    with pytest.warns(PictureWarning, match="unevenly lit"):
        assert len(trace(ramp)) == 1


def test_a_window_does_the_same_where_it_always_shows_ground():
    image = lit(LIGHTS["from the left"], noise=0.0)
    assert counted(trace(image, polarity="dark", local=80, min_area=6)) == (9, 4)


def test_light_on_dark_and_dark_on_light_in_one_picture():
    letters = word("gä 8", 40, margin=10)
    image = np.vstack([letters, 255 - letters])
    shape = trace(image, polarity="dark")
    height = letters.shape[0]
    depth = [shape.is_hole(index) for index in range(len(shape))]
    upper = [contour.points[:, 1].min() >= height - 0.5 for contour in shape]
    # g, a, two dots and 8 above as ink, and as holes of the dark half below.
    assert sum(u and not hole for u, hole in zip(upper, depth, strict=True)) == 5
    assert sum(not u and hole for u, hole in zip(upper, depth, strict=True)) == 5


def test_inverted_the_ground_is_the_shape():
    image = word("o", 30)
    plain, inverted = trace(image), trace(image, invert=True)
    assert counted(plain) == (1, 1)
    assert counted(inverted) == (2, 1)


def test_a_crop_is_a_picture_of_its_own():
    image = word("ab", 30)
    part = trace(image, crop=(2, 3, 20, 30), min_area=0)
    cut = trace(image[3:33, 2:22], min_area=0)
    assert [c.points.tolist() for c in part] == [c.points.tolist() for c in cut]
    assert part.frame == (0, 0, 20, 30)
    text = trace(image, crop="2,3,20,30", min_area=0)
    assert [c.points.tolist() for c in text] == [c.points.tolist() for c in cut]


@pytest.mark.slow
def test_a_blur_takes_a_screen_away():
    y, x = np.mgrid[:120, :120]
    disc = np.hypot(x - 60, y - 60) < 35
    image = np.where((x + y) % 4 < np.where(disc, 3, 1), 0, 255).astype(np.uint8)
    assert counted(trace(image, blur=3.0)) == (1, 0)


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ({"blur": -1}, "blur must be a number of pixels"),
        ({"local": "on"}, "local must be auto, off or a window"),
        ({"local": 2}, "window of at least 4 pixels"),
        ({"local": 50, "level": 100}, "leave out local, or level"),
        ({"crop": "1,2,3"}, "column,row,width,height"),
        ({"crop": "a,b,c,d"}, "column,row,width,height"),
        ({"crop": (0, 0, 5000, 5)}, "does not lie within the picture"),
        ({"crop": (-1, 0, 5, 5)}, "does not lie within the picture"),
    ],
)
def test_options_that_cannot_be(options, complaint):
    with pytest.raises(InvalidInputError, match=complaint):
        trace(word("a", 20), **options)


def test_a_colour_is_not_found_in_the_edges_of_others():
    letters = word("gä 8", 40, margin=10)
    image = np.repeat(letters[:, :, None], 3, axis=2)
    image[:9, :9] = 255
    image[2:8, 2:8] = 200, 30, 30
    (contour,) = trace(image, color="#c81e1e")
    height = letters.shape[0]
    assert contour.points.min(axis=0) == pytest.approx([2, height - 8], abs=0.05)
    assert contour.points.max(axis=0) == pytest.approx([8, height - 2], abs=0.05)
