"""Inks of strokes too thin to have even pixels."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image, ImageDraw

from shapespline.tracing.palette import palette_of

SIZE, LARGER = (120, 80), 8
BRIGHT = ("#ff0000", "#00aa00", "#0000ff", "#000000")
GREYS = ("#000000", "#808080", "#c8c8c8")
REDS = ("#7f0000", "#d00000", "#ff8080")


def lines(colors, width, ground="#ffffff"):
    """Slanted lines, one below the other."""
    n = LARGER
    image = Image.new("RGB", (SIZE[0] * n, SIZE[1] * n), ground)
    draw = ImageDraw.Draw(image)
    for k, color in enumerate(colors):
        ends = (8 * n, (8 + 18 * k) * n), (112 * n, (15 + 19 * k) * n)
        draw.line(ends, fill=color, width=round(width * n))
    return np.asarray(image.resize(SIZE, Image.Resampling.BOX))


def rgb(color):
    return np.array(list(bytes.fromhex(color[1:])), dtype=float)


@pytest.mark.parametrize("width", [2, 3])
@pytest.mark.parametrize("colors", [BRIGHT, GREYS, REDS])
def test_of_lines_that_cover_pixels_the_inks_are_found_exactly(colors, width):
    # A line of two pixels covers some wholly, whatever its angle.
    for wanted in ("auto", len(colors) + 1):
        found = palette_of(lines(colors, width), wanted).colors
        assert len(found) == len(colors) + 1
        for color in (*colors, "#ffffff"):
            assert np.abs(found - rgb(color)).max(axis=1).min() == 0.0


def test_an_ink_that_covers_no_pixel_is_no_paler_than_its_fullest_ones():
    # Such a line lies within a row of pixels somewhere; Pillow draws slanted ones a sample thinner.
    found = palette_of(lines(BRIGHT, 1), "auto").colors
    assert len(found) == 5
    for color in BRIGHT:
        assert np.abs(found - rgb(color)).max(axis=1).min() <= 255 / LARGER + 1


def test_thin_parts_of_letters_are_no_ink_of_their_own():
    # Strokes of 0.6 pixels beside one of three: their fullest pixels are grey.
    picture = np.full((60, 60, 3), 255, dtype=np.uint8)
    picture[10:50, 10:13] = 0
    picture[10:50:8, 13:17] = 102
    found = palette_of(picture, "auto").colors
    assert sorted(found[:, 0].tolist()) == [0.0, 255.0]
