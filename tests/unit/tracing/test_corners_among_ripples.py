"""Pictures saved as JPEG: ripples beside the edges, which leave sharp corners sharp."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image
from scipy.spatial import cKDTree
from tests.support.rendering import coverage, dark, polygon, tile

from shapespline.studio.examples import example_bytes
from shapespline.tracing import trace
from shapespline.tracing.corners import Missing
from shapespline.tracing.crossings import crossings
from shapespline.tracing.inks import softness_of
from shapespline.tracing.layer import Layer
from shapespline.tracing.seeing import cut_field
from shapespline.tracing.sides import Corners
from shapespline.tracing.softness import Softness

SIDE = 120
# Turned by 8, 21 and 33 degrees; corners anywhere within a pixel.
SQUARES = [
    [(60.3 + 44 * np.cos(a), 59.6 + 44 * np.sin(a)) for a in np.radians(turn + 90 * np.arange(4.0))]
    for turn in (8, 21, 33)
]


def saved(picture, quality):
    stream = io.BytesIO()
    Image.fromarray(picture).save(stream, "JPEG", quality=quality)
    return np.asarray(Image.open(stream))


def on_edges(outline):
    """Points all along a closed outline."""
    ahead = np.roll(outline, -1, axis=0)
    return np.concatenate(
        [a + np.linspace(0, 1, 20)[:, None] * (b - a) for a, b in zip(outline, ahead, strict=True)]
    )


@pytest.mark.parametrize("quality", [75, 90])
@pytest.mark.parametrize("corners", SQUARES, ids=["8", "21", "33"])
def test_corners_are_put_back(corners, quality):
    (outline,) = trace(saved(dark(coverage(polygon(corners), SIDE, SIDE)), quality))
    # The level line is 0.42 pixels from a right angle in the mean.
    assert cKDTree(on_edges(outline.points)).query(corners)[0].max() < 0.15


# A sharp corner lies (sqrt 2 - 1) radii from a round one: of two pixels, 0.83.
@pytest.mark.parametrize(("radius", "quality", "near"), [(2, 50, 0.42), (3, 90, 0.2), (6, 90, 0.2)])
def test_roundings_stay_round(radius, quality, near):
    cover = np.pad(coverage(tile(64, radius), 64, 64), 10)
    (outline,) = trace(saved(dark(cover), quality))
    inner = np.abs(outline.points - 42) - (32 - radius)
    round_off = np.abs(np.hypot(*np.maximum(inner, 0).T) - radius)[(inner > 0).all(axis=1)]
    assert np.abs(outline.points - 42).max() < 32 + near
    assert round_off.max() < near


def ripples(picture):
    field = cut_field(Layer(picture), False)
    return softness_of(field, crossings(field)).rippled


@pytest.mark.parametrize("corners", SQUARES, ids=["8", "21", "33"])
def test_a_rendered_picture_has_none(corners):
    picture = dark(coverage(polygon(corners), SIDE, SIDE))
    assert not ripples(picture)
    assert ripples(saved(picture, 90))
    assert ripples(saved(picture, 95))


@pytest.mark.parametrize(
    ("turn", "missing", "beside", "rippled", "expected"),
    [
        # Of a right angle without ripples what a rounding of half a pixel takes, and 0.03.
        (90, 0.08, 0.0, False, True),
        (90, 0.1, 0.1, False, False),
        # Five deviations of the ripples in each of seven times seven pixels.
        (90, 0.35, 0.008, True, True),
        (90, 0.35, 0.006, True, False),
        # No more than a rounding of 1.5 pixels, and of a tip no more than 1.5 pixels of it.
        (90, 0.55, 0.1, True, True),
        (90, 0.6, 0.1, True, False),
        (150, 1.2, 0.1, True, True),
        (150, 1.3, 0.1, True, False),
    ],
)
def test_what_a_corner_may_miss(turn, missing, beside, rippled, expected):
    one, wide = np.zeros(1), np.full(1, 10.0)
    corners = Corners(
        np.zeros(1, dtype=np.int64), np.zeros((1, 2)), np.radians([turn]), -wide, wide, one
    )
    found = Missing(np.array([missing]), np.array([beside]))
    assert found.fits(corners, Softness(rippled=rippled), 0.0).tolist() == [expected]


def test_ground_and_ink_beside_their_levels_are_no_ripples():
    # All pixels of one grey are off by the same part of the contrast.
    picture = np.asarray(Image.open(io.BytesIO(example_bytes("gear"))))
    assert not ripples(picture)
    assert ripples(saved(picture, 90))
