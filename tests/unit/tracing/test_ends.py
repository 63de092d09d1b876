"""Ends of strokes of two to five pixels: square ones come back with both corners, round ones stay.

The corners of an end of four pixels are nearer to each other than the squares of pixels disturb.
"""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.few_points import is_outline
from benchmarks.drawn.stroke_ends import corners_off, drawn_at, fits_of
from benchmarks.drawn.tables import rendered
from tests.support.rendering import coverage, dark, polygon

import shapespline as ss

PLACE = 2


def is_as_drawn(shape, turn, picture, near):
    outline = drawn_at(shape, turn, PLACE)
    fits = fits_of(outline, picture)
    as_drawn = len(fits) == 1 and is_outline(fits[0], outline)
    return as_drawn and corners_off(outline, fits).max() < near


@pytest.mark.parametrize(
    ("shape", "turn", "picture", "near"),
    [
        ("bar 2", 17.0, "exact coverage", 0.05),
        ("bar 3", 17.0, "exact coverage", 0.05),
        ("comb 3", 0.0, "exact coverage", 0.05),
        ("comb 4", 17.0, "exact coverage", 0.05),
        ("I 4", 17.0, "exact coverage", 0.1),
        ("bar 3", 17.0, "JPEG 90", 0.1),
        ("comb 4", 17.0, "JPEG 90", 0.1),
        ("bar 4", 17.0, "blurred by 0.5", 0.1),
        ("bar 4", 0.0, "blurred by 0.7, grain of 4, JPEG 90", 0.2),
        ("bar 5", 0.0, "blurred by 0.7, grain of 4, JPEG 90", 0.2),
    ],
)
def test_square_ends_have_both_corners(shape, turn, picture, near):
    assert is_as_drawn(shape, turn, picture, near)


@pytest.mark.parametrize("picture", ["exact coverage", "JPEG 90"])
@pytest.mark.parametrize("turn", [0.0, 17.0])
@pytest.mark.parametrize("shape", ["round 3", "round 4", "round 5"])
def test_round_ends_stay_round(shape, turn, picture):
    # Half a circle and the lines beside it meet at no angle: its joints scatter along them.
    assert is_as_drawn(shape, turn, picture, 1.0)


@pytest.mark.parametrize("turn", [0.0, 17.0])
def test_round_ends_in_a_light_scan_are_no_square_ones(turn):
    # Pixels agree with both; they are surer of half a circle with as much ink.
    outline = drawn_at("round 3", turn, PLACE)
    (fit,) = fits_of(outline, "blurred by 0.7, grain of 4, JPEG 90")
    assert is_outline(fit, outline)


def test_tips_and_blunt_ends_get_no_square_ends():
    for tip in (1.0, 2.0):
        corners = np.array(
            [(-12, -2), (12, -2), (12 + tip, -0.4), (12 + tip, 0.4), (12, 2), (-12, 2)]
        )
        corners = corners @ np.array([[0.96, 0.28], [-0.28, 0.96]]) + (24.3, 23.6)
        (contour,) = ss.trace(dark(coverage(polygon(corners), 48, 48)))
        far = (contour.points - (24.3, 23.6)) @ (0.96, 0.28)
        assert far.max() < 12 + tip + 0.1


def test_teeth_of_a_gear_of_few_pixels_have_their_corners():
    outlines, picture = rendered("gear 24", 64)
    fits = ss.fit_shape(ss.trace(picture), character="drawn").fits
    off = np.concatenate([corners_off(outline, fits) for outline in outlines])
    assert (off < 0.5).mean() > 0.95
