"""Pictures that were enlarged: told by their differences, and traced as before that."""

from __future__ import annotations

import io

import numpy as np
import pytest
from benchmarks.drawn.tables import rendered
from PIL import Image
from scipy.ndimage import gaussian_filter
from tests.support.rendering import coverage, polygon

import shapespline as ss
from shapespline.tracing import trace
from shapespline.tracing.crossings import crossings
from shapespline.tracing.enlarged import Enlargement
from shapespline.tracing.inks import softness_of
from shapespline.tracing.layer import Layer
from shapespline.tracing.seeing import Seeing, cut_field

CORNERS = np.array([(12.3, 10.7), (70.1, 18.2), (62.4, 72.8), (24.2, 60.6)])
SMALL = np.rint(255 * (1 - coverage(polygon(CORNERS), 84, 84))).astype(np.uint8)
WAYS = Image.Resampling
SMOOTH = [WAYS.BILINEAR, WAYS.BICUBIC, WAYS.LANCZOS]


def enlarged(small, factor, way, quality=None):
    size = (factor * small.shape[1], factor * small.shape[0])
    picture = Image.fromarray(small).resize(size, way)
    if quality is None:
        return np.asarray(picture)
    stream = io.BytesIO()
    picture.save(stream, "JPEG", quality=quality)
    return np.asarray(Image.open(stream))


def told(image):
    return Enlargement.of(cut_field(Layer(image), light=False))


@pytest.mark.parametrize("factor", [2, 3, 4])
@pytest.mark.parametrize("quality", [None, 90])
@pytest.mark.parametrize("way", [WAYS.NEAREST, *SMOOTH])
def test_the_factor_and_copies_are_told(factor, way, quality):
    found = told(enlarged(SMALL, factor, way, quality))
    assert found == Enlargement(factor, copied=way == WAYS.NEAREST)


@pytest.mark.parametrize(
    "image",
    [
        SMALL,
        np.rint(gaussian_filter(SMALL.astype(float), 1.0)).astype(np.uint8),
        np.rint(gaussian_filter(SMALL.astype(float), 2.0)).astype(np.uint8),
        enlarged(SMALL, 1, WAYS.BICUBIC, 75),
        # Blocks that are ink or ground are drawn: a QR code, letters of a game.
        np.kron(np.where(SMALL < 128, 0, 255), np.ones((4, 4))).astype(np.uint8),
        np.kron(127 * (SMALL // 100), np.ones((3, 3), dtype=np.uint8)),
        np.full((84, 84), 7, dtype=np.uint8) + np.uint8(90) * (np.arange(84) > 40),
    ],
    ids=["sharp", "blurred", "much blurred", "JPEG", "blocks", "blocks of three colours", "step"],
)
def test_others_were_not_enlarged(image):
    assert told(image).factor == 1


def test_copies_of_pixels_wave_but_are_no_light():
    _, image = rendered("server", 256, "copied twice")
    for small, large in zip(trace(image[::2, ::2]), trace(image), strict=True):
        np.testing.assert_allclose(large.points, 2.0 * small.points, rtol=0, atol=1e-9)


def test_level_strokes_tell_nothing():
    image = np.full((60, 60), 255, dtype=np.uint8)
    image[10:50, 8:52:4], image[10:50, 9:52:4], image[10:50, 10:52:4] = 190, 90, 190
    assert told(image).factor == 1


def test_a_part_that_blocks_do_not_fill_is_not_undone():
    assert told(enlarged(SMALL, 3, WAYS.BICUBIC)[:-1]).factor == 1


@pytest.mark.parametrize("factor", [2, 3, 4])
@pytest.mark.parametrize("way", [WAYS.BILINEAR, WAYS.BICUBIC])
def test_the_small_picture_comes_back(factor, way):
    field = Enlargement(factor).undone(cut_field(Layer(enlarged(SMALL, factor, way)), light=False))
    off = field.values[:] - SMALL
    # Neither to one side nor to the other, by a hundredth of a pixel: values are rounded; and no
    # softer than linear ways leave it.
    for places in np.mgrid[:84, :84]:
        assert np.abs((places * off).sum() / (255.0 - SMALL).sum()) < 0.01
    assert softness_of(field, crossings(field)).blur == 0.0


@pytest.mark.parametrize("way", [WAYS.NEAREST, *SMOOTH])
def test_only_interpolation_ripples(way):
    field, found = Seeing().field(enlarged(SMALL, 2, way))
    assert softness_of(field, found).rippled == (way != WAYS.NEAREST)


@pytest.mark.parametrize("factor", [2, 3, 4])
def test_copies_are_traced_as_the_picture_that_they_are_of(factor):
    before, after = trace(SMALL), trace(np.kron(SMALL, np.ones((factor, factor), np.uint8)))
    assert after.frame == (0, 0, factor * 84, factor * 84)
    np.testing.assert_array_equal(after.longest.points, factor * before.longest.points)
    np.testing.assert_array_equal(after.longest.level_line, factor * before.longest.level_line)
    assert after.longest.accuracy == factor * before.longest.accuracy


def test_areas_are_those_of_the_picture_that_is_given():
    size = ss.Shape(trace(SMALL)).longest
    area = abs(ss.geometry.signed_area(size.points))
    image = enlarged(SMALL, 2, WAYS.NEAREST)
    assert len(trace(image, min_area=3.9 * area)) == 1
    with pytest.raises(ss.DegenerateContourError, match="no outline encloses"):
        trace(image, min_area=4.1 * area)


# A JPEG of the third has ripples of two kinds: two of its four corners stay cut off.
@pytest.mark.parametrize(
    ("way", "quality"),
    [*((way, None) for way in SMOOTH), (WAYS.BILINEAR, 90), (WAYS.BICUBIC, 90)],
)
def test_corners_are_where_they_were_drawn(way, quality):
    fit = ss.fit_curve(trace(enlarged(SMALL, 2, way, quality)).longest, tolerance=0.35)
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4
    found = np.array([piece.control_points[0] for piece in fit.pieces])
    off = np.hypot(*(found[:, None] - 2 * CORNERS).T).min(axis=0)
    # Half a pixel of the picture that is given, a quarter of the one that was drawn.
    assert off.max() < 0.5


def test_what_is_blurred_by_the_one_who_asks_is_left_as_it_is():
    field, _ = Seeing(blur=3.0).field(enlarged(SMALL, 2, WAYS.NEAREST))
    assert field.scale == 1
