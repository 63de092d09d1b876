"""Pictures that a lens has spread: the blur is read, the corners are put back, roundings stay."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter
from tests.support.rendering import coverage, polygon

from shapespline.tracing import trace
from shapespline.tracing.crossings import crossings
from shapespline.tracing.inks import softness_of
from shapespline.tracing.layer import Layer
from shapespline.tracing.seeing import cut_field
from shapespline.tracing.softness import SHARP

QUADRILATERAL = np.array([(22.3, 20.7), (100.1, 28.2), (92.4, 98.8), (34.2, 90.6)])
SHAPES = {
    "quadrilateral": polygon(QUADRILATERAL),
    "disc": lambda x, y: np.hypot(x - 60.2, y - 59.7) <= 35,
}


def scanned(inside, blur, grain=0.5, size=120, seed=0):
    """Dark grey on light grey, spread by a lens, under grain (of 255)."""
    image = 224 - 204 * coverage(inside, size, size)
    noise = np.random.default_rng(seed).normal(0, grain, image.shape)
    return np.rint(np.clip(gaussian_filter(image, blur) + noise, 0, 255)).astype(np.uint8)


def softness(image):
    field = cut_field(Layer(image), False)
    return softness_of(field, crossings(field))


@pytest.mark.parametrize("blur", [0.7, 1.0, 1.5])
@pytest.mark.parametrize("inside", SHAPES.values(), ids=SHAPES.keys())
def test_the_blur_is_read_off_the_edges(inside, blur):
    for grain in (0.5, 5.0):
        # What is cut off six pixels from an edge, and grain there, is a part of a variance of one.
        assert softness(scanned(inside, blur, grain)).blur == pytest.approx(blur, rel=0.06)


@pytest.mark.parametrize("inside", SHAPES.values(), ids=SHAPES.keys())
def test_what_is_rendered_is_sharp(inside):
    assert softness(scanned(inside, 0.0)).blur == 0


def test_narrow_strokes_beside_each_other_are_no_blur():
    image = np.full((30, 30), 255, dtype=np.uint8)
    for column in (4, 8, 12, 17, 21):
        image[4:26, column : column + 2] = 0
    assert softness(image).blur == 0


def test_waves_have_no_edges():
    y, x = np.mgrid[:80, :80]
    waves = np.rint(127.5 + 120 * np.sin(0.21 * x) * np.cos(0.17 * y)).astype(np.uint8)
    assert softness(waves) == SHARP


@pytest.mark.parametrize("blur", [0.0, 1.0])
def test_grain_scatters_a_level_line_as_is_said(blur):
    square = polygon([(20, 20), (100, 20), (100, 100), (20, 100)])
    image = scanned(square, blur, grain=9.0)
    points = trace(image, min_area=50).longest.level_line
    side = points[(points[:, 0] > 30) & (points[:, 0] < 90)]  # the lower and the upper one
    side = side[side[:, 0] % 1 == 0.5]
    off = np.abs(side[:, 1] - 60) - 40
    # A hundred places tell a deviation to 7 %; some lie nearer to a pixel than half-way.
    assert softness(image).scatter == pytest.approx(np.sqrt((off**2).mean()), rel=0.35)


@pytest.mark.parametrize("grain", [0.5, 8.0])
@pytest.mark.parametrize("blur", [0.7, 1.0, 1.5])
def test_corners_of_scans_are_put_back(blur, grain):
    image = scanned(SHAPES["quadrilateral"], blur, grain)
    contour = trace(image, min_area=50).longest
    apart = np.hypot(*(contour.points[:, None] - QUADRILATERAL).transpose(2, 0, 1)).min(axis=0)
    cut = np.hypot(*(contour.level_line[:, None] - QUADRILATERAL).transpose(2, 0, 1)).min(axis=0)
    # A line through six places, as far from the corner as they reach, scatters there by twice as
    # much as each of them; two lines, four corners. A tenth of a pixel for what blur does to sides.
    assert apart.max() <= 0.1 + 5 * softness(image).scatter
    assert (apart < cut).all()


@pytest.mark.parametrize("blur", [0.7, 1.0, 1.5])
def test_roundings_of_scans_stay(blur):
    def inside(x, y):
        """A square of 70 with round corners of 6."""
        u, v = np.abs(x - 60), np.abs(y - 60)
        corner = (u > 29) & (v > 29) & (np.hypot(u - 29, v - 29) > 6)
        return (np.maximum(u, v) <= 35) & ~corner

    contour = trace(scanned(inside, blur)).longest
    # Where the diagonals pass a rounding, and where they would pass a corner.
    rounding, corner = np.sqrt(2) * 29 + 6, np.sqrt(2) * 35
    farthest = np.hypot(*(contour.points - 60).T).max()
    assert farthest - rounding < 0.3 * (corner - rounding)
