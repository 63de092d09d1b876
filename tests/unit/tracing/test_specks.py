"""What was drawn stays, what noise makes goes, and what went is told."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from scipy import ndimage
from tests.support.rendering import coverage, dark, word

import shapespline as ss
from shapespline.errors import DegenerateContourError, PictureWarning
from shapespline.tracing import trace


def parts_and_holes(shape):
    holes = sum(shape.is_hole(index) for index in range(len(shape)))
    return len(shape) - holes, holes


@pytest.mark.slow
@pytest.mark.parametrize("corner", [(600.0, 400.0), (600.3, 400.7), (600.5, 400.5)])
def test_a_dot_of_two_pixels_stays_in_a_large_picture(corner):
    def inside(x, y):
        dot = (x >= corner[0]) & (x < corner[0] + 2) & (y >= corner[1]) & (y < corner[1] + 2)
        return dot | (np.hypot(x - 610, y - 395) < 3)

    cover = np.zeros((800, 1200))
    cover[380:420, 590:630] = coverage(lambda x, y: inside(x + 590, y + 380), 40, 40)
    shape = trace(dark(cover))
    assert len(shape) == 2
    assert shape.left_out == ()


@pytest.mark.parametrize(
    ("text", "height", "expected"),
    [("jäger & söhne", 16, (16, 6)), ("Größe: 36 %", 24, (14, 5)), ("fig. 8a-e", 12, (9, 5))],
)
def test_small_letters_keep_their_dots_and_counters(text, height, expected):
    assert parts_and_holes(trace(word(text, height))) == expected
    # On a large sheet just as well.
    sheet = np.full((900, 1400), 255, dtype=np.uint8)
    letters = word(text, height)
    sheet[300 : 300 + letters.shape[0], 200 : 200 + letters.shape[1]] = letters
    assert parts_and_holes(trace(sheet)) == expected


@pytest.mark.slow
def test_grain_goes_and_is_counted():
    rng = np.random.default_rng(7)
    ramp = np.linspace(60, 200, 300)[None, :] * np.ones((200, 1))  # passes the level slowly
    image = np.where(coverage(lambda x, y: np.hypot(x - 40, y - 40) < 20, 200, 300) > 0.5, 20, ramp)
    image = np.rint(np.clip(image + rng.normal(0, 6, image.shape), 0, 255)).astype(np.uint8)
    with pytest.warns(PictureWarning, match=r"specks below \d+ square pixels? left out"):
        shape = trace(image, local="off")
    everything = trace(image, local="off", min_area=0)
    assert len(everything) > 50
    assert len(shape) < 8
    assert len(shape.left_out) == len(everything) - len(shape)
    assert everything.left_out == ()


@pytest.mark.slow
def test_texture_goes_and_small_letters_beside_it_stay():
    """Random grain of all sizes that passes the level, and a word, in a picture with some noise."""
    rng = np.random.default_rng(3)
    letters = 255.0 - word("jäger: ii", 16)
    clean = np.zeros((120, 160))
    clean[70 : 70 + letters.shape[0], 20 : 20 + letters.shape[1]] = letters
    grain = ndimage.gaussian_filter(rng.normal(0, 1, clean.shape), 0.7)
    textured = clean.copy()
    textured[10:50, 10:150] = 70 + 150 * grain[10:50, 10:150]
    noisy = [
        255 - np.rint(np.clip(image + rng.normal(0, 4, clean.shape), 0, 255)).astype(np.uint8)
        for image in (clean, textured)
    ]
    alone = trace(noisy[0], level=127)
    assert parts_and_holes(alone) == parts_and_holes(trace(word("jäger: ii", 16)))
    with pytest.warns(PictureWarning, match="as noise or texture"):
        shape = trace(noisy[1], level=127)
    below = [contour for contour in shape if contour.points[:, 1].max() < 55]
    assert len(below) == len(alone)
    # Of the grain most is gone, and what is larger than grain has stayed.
    everything = trace(noisy[1], level=127, min_area=0)
    assert len(everything) > 200
    assert len(shape) - len(below) < 0.15 * (len(everything) - len(below))
    # The same grain as a clean drawing shows it is a drawing: a stipple.
    stipple = np.zeros((60, 160), dtype=np.uint8)
    stipple[5:55:5, 5:155:5] = 255
    assert len(trace(stipple, polarity="light")) == 300


def test_what_a_given_area_leaves_out_is_listed_too():
    image = np.zeros((100, 100), dtype=np.uint8)
    image[20:60, 20:60] = 255
    image[80:84, 80:84] = 255
    shape = trace(image, min_area=100)
    assert len(shape) == len(shape.left_out) == 1
    assert shape.left_out[0].points.mean(axis=0) == pytest.approx([82, 18])


@pytest.mark.slow
@pytest.mark.parametrize("size", [60, 1200])
def test_pure_noise_ends_in_a_sentence(size):
    image = np.random.default_rng(1).integers(0, 256, (size, size)).astype(np.uint8)
    if size == 1200:
        with pytest.raises(DegenerateContourError, match="noise"):
            trace(image)
        with pytest.raises(DegenerateContourError, match="noise"):
            trace(image, min_area=0)
    else:  # a small one is traced if that is wanted
        assert len(trace(image, min_area=0)) > 100


def test_what_was_left_out_is_drawn_on_request(shapespline, tmp_path):
    image = np.zeros((100, 100), dtype=np.uint8)
    image[20:60, 20:60] = 255
    image[80:84, 80:84] = 255
    picture, output = tmp_path / "two.png", tmp_path / "noise.svg"
    Image.fromarray(image).save(picture)
    assert shapespline("trace", picture, "--min-area", 99, "--left-out", "-o", output)[0] == 0
    (found,) = ss.read(output)
    assert found.contour.points.mean(axis=0) == pytest.approx([82, 18])
    code, _, err = shapespline("trace", picture, "--left-out", "-o", output)
    assert code == 1
    assert "nothing was left out" in err


def test_a_hole_whose_rim_is_grey_by_half_stays():
    """All the pixels beside its level line lie on the level: the hole is told by those behind."""

    def frame(x, y):
        return np.abs(np.maximum(np.abs(x - 20), np.abs(y - 20)) - 4.5) < 3.0

    assert parts_and_holes(trace(dark(coverage(frame, 40, 40)))) == (1, 1)
