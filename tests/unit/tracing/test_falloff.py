"""Photographs of prints: the light is taken off, edges and colours are those of the print."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from scipy.ndimage import gaussian_filter
from tests.support.rendering import coverage, polygon

from shapespline import InvalidInputError, PictureWarning
from shapespline.tracing import layer, trace
from shapespline.tracing.falloff import without_falloff

SIZE = 200
QUADRILATERAL = np.array([(42.3, 40.7), (160.1, 48.2), (142.4, 158.8), (54.2, 140.6)])
PAPER, INK = np.array([247.0, 244, 236]), np.array([200.0, 40, 30])
LIGHTS = {
    "vignette": lambda x, y: 0.97 - 0.12 * (x**2 + y**2),
    "lamp": lambda x, y: np.exp(-0.25 * (1 + x)),
}
INSIDE = coverage(polygon(QUADRILATERAL), SIZE, SIZE)


def light(name):
    y, x = np.mgrid[-1 : 1 : SIZE * 1j, -1 : 1 : SIZE * 1j]
    return LIGHTS[name](x, y)


def printed(blur=1.0):
    """Red ink on cream paper, out of focus."""
    sharp = PAPER + INSIDE[..., None] * (INK - PAPER)
    return gaussian_filter(sharp, (blur, blur, 0.0))


def seen(picture, grain=1.5, seed=0):
    noise = np.random.default_rng(seed).normal(0.0, grain, picture.shape)
    return np.rint(np.clip(picture + noise, 0, 255)).astype(np.uint8)


def farthest(points):
    """Of points from the quadrilateral's sides."""
    off = []
    for a, b in zip(QUADRILATERAL, np.roll(QUADRILATERAL, -1, axis=0), strict=True):
        along = (b - a) / np.hypot(*(b - a))
        t = np.clip((points - a) @ along, 0.0, np.hypot(*(b - a)))
        off.append(np.hypot(*(points - a - t[:, None] * along).T))
    return float(np.min(off, axis=0).max())


def corners_missed(points):
    """How far the nearest point is from each corner, the largest."""
    return max(float(np.hypot(*(points - corner).T).min()) for corner in QUADRILATERAL)


@pytest.mark.parametrize("name", LIGHTS)
@pytest.mark.parametrize("kind", ["uint8", "uint16", "float", "grey"])
def test_what_was_printed_comes_out(name, kind, monkeypatch):
    picture = seen(printed() * light(name)[..., None])
    if kind == "uint16":
        picture = picture.astype(np.uint16) * 257
    elif kind == "float":
        picture = picture / 255
    elif kind == "grey":
        picture = picture[..., 0]
    even = without_falloff(picture)
    assert even is not None
    assert even.dtype == picture.dtype
    full = {"uint16": 65535.0, "float": 1.0}.get(kind, 255.0)
    expected = printed()[..., 0] if kind == "grey" else printed()
    # As the brightest place shows it; grain, and the polynomial's own error of half a per cent.
    ratio = (even / full)[INSIDE == 0] / (expected * light(name).max() / 255)[INSIDE == 0]
    assert abs(float(ratio.mean()) - 1) < 0.005
    assert float(ratio.std()) < 3 * 1.5 / 200
    assert float(even.max()) <= full
    monkeypatch.setattr(layer, "STRIP", 900)  # a few rows
    assert_array_equal(without_falloff(picture), even)


@pytest.mark.parametrize(
    "picture",
    [
        seen(printed()),
        # A sky that was drawn: its channels do not change alike.
        seen(printed(0.0) * np.linspace([0.6, 0.8, 1.0], [1.0, 1.0, 1.0], SIZE)[:, None], 0.0),
        # Ink on most of the rim, noise, shades all over, next to nothing.
        np.random.default_rng(1).integers(0, 256, (SIZE, SIZE, 3)).astype(np.uint8),
        seen(np.tile(np.linspace(10, 250, SIZE), (SIZE, 1)), 0.0),
        seen(printed() * light("vignette")[..., None])[:20, :20],
        np.zeros((SIZE, SIZE, 3), np.uint8),
    ],
    ids=["even", "sky", "noise", "ramp", "small", "black"],
)
def test_what_is_no_light_stays(picture):
    assert without_falloff(picture) is None


@pytest.mark.parametrize("name", LIGHTS)
def test_outlines_in_uneven_light_lie_where_they_were_printed(name):
    picture = seen(printed() * light(name)[..., None])
    with pytest.warns(PictureWarning, match="unevenly lit"):
        contour = trace(picture).longest
    # Four deviations of what grain scatters a level line by: 1.5 of 150, over a slope of 0.38.
    assert farthest(contour.points) < 4 * 0.01 / 0.38 + 0.05
    assert corners_missed(contour.points) < 0.2
    assert 0.03 < contour.accuracy < 0.07
    uncorrected = trace(picture, local="off").longest
    assert corners_missed(uncorrected.points) > 0.2


@pytest.mark.parametrize("name", LIGHTS)
def test_areas_of_colours_do_so_too(name):
    picture = seen(printed() * light(name)[..., None])
    with pytest.warns(PictureWarning, match="unevenly lit"):
        shape = trace(picture, colors="auto")
    colors = [one for one in shape.colors if one]
    assert len(colors) == 2  # and no shades of the paper
    brightest = light(name).max()
    for color, expected in zip(colors, (PAPER, INK), strict=True):
        rgb = np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)])
        assert np.abs(rgb - brightest * expected).max() < 3
    (area,) = (c for c, color in zip(shape, shape.colors, strict=True) if color == colors[1])
    assert farthest(area.points) < 4 * 0.01 / 0.38 + 0.05
    assert corners_missed(area.points) < 0.2
    assert 0.03 < area.accuracy < 0.07
    assert corners_missed(area.level_line) > 0.5
    with pytest.warns(PictureWarning, match="went to their neighbours"):
        shades = trace(picture, colors="auto", local="off")
    assert len({one for one in shades.colors if one}) > 2


def test_colours_take_no_window():
    with pytest.raises(InvalidInputError, match="local='off'"):
        trace(seen(printed()), colors=2, local=40)


def test_blurred_colours_are_seen_by_their_lightness():
    """Colour of half the pixels, as JPEG keeps it, moves no edge."""
    from io import BytesIO

    from PIL import Image

    held = BytesIO()
    Image.fromarray(seen(printed())).save(held, "JPEG", quality=88, subsampling=2)
    picture = np.asarray(Image.open(held))
    for colors in (None, 2):
        shape = trace(picture, colors=colors)
        contour = shape.contours[-1]
        assert corners_missed(contour.points) < 0.25
        assert farthest(contour.points) < 0.2
