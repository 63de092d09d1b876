"""Edges of JPEG's colours, which it keeps of every other pixel, are no colours of their own."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image
from tests.support.rendering import coverage, tile

from shapespline.tracing.palette import palette_of
from shapespline.tracing.told import EVEN

SIDE = 96
WHITE = np.array([255.0, 255, 255])


def ring(x, y):
    away = np.hypot(x - 48, y - 48)
    return tile(SIDE, 20)(x, y) & ~((away < 26) & (away > 14))


def picture(color, ground):
    cover = coverage(ring, SIDE, SIDE)[..., None]
    return np.rint(np.array(ground) + cover * (np.array(color) - ground)).astype(np.uint8)


def as_jpeg(pixels, quality):
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, "JPEG", quality=quality, subsampling=2)
    return np.asarray(Image.open(stream))


@pytest.mark.parametrize("quality", [75, 92])
@pytest.mark.parametrize("color", [(231, 60, 40), (14, 100, 187), (20, 140, 60)])
def test_a_jpeg_has_the_colours_of_what_it_shows(color, quality):
    found = palette_of(as_jpeg(picture(color, WHITE), quality), "auto").colors
    assert len(found) == 2
    # Pixels that differ by no more are even, and ringing is in their mean.
    for wanted in (color, WHITE):
        assert np.abs(found - wanted).max(axis=1).min() <= EVEN


def test_thin_strokes_between_colours_keep_theirs():
    navy, blue = np.array([20.0, 30, 90]), np.array([110.0, 150, 250])
    pixels = picture(navy, WHITE)
    pixels[:, 47:49] = blue  # two pixels wide, lighter than navy and darker than white
    found = palette_of(pixels, "auto").colors
    assert np.abs(found - blue).max(axis=1).min() <= 1
    assert len(found) == 3
