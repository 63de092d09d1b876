"""What rounding to the last digit leaves of points."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline.analysis.last_digit import ROUNDED, rounded


def ring(count, radius, decimals):
    angle = 2 * np.pi * np.arange(count) / count + 0.1
    points = 20 + radius * np.column_stack([np.cos(angle), np.sin(angle)])
    return points if decimals is None else points.round(decimals)


@pytest.mark.parametrize("decimals", [1, 2, 3])
@pytest.mark.parametrize("scale", [1.0, 0.3, 1e6])
def test_the_step_is_that_of_the_last_digit(decimals, scale):
    found = rounded(scale * ring(48, 88.0, decimals), True, scale * 1e-4)
    # Sums of a hundred digits know a step to a part of 1e-9 at least.
    assert found == pytest.approx(scale * 10.0**-decimals / ROUNDED, rel=1e-9)


def test_points_with_all_their_digits_have_none():
    assert rounded(ring(48, 88.0, None), True, 1e-3) == 0.0


def test_a_finer_step_than_counts_is_none():
    assert rounded(ring(48, 88.0, 6), True, 1e-3) == 0.0


def test_a_small_hole_is_rounded_too():
    # A step of a thousandth of it and more: it is what lies between neighbours that is large.
    assert rounded(ring(36, 1.5, 2), True, 1e-5) == pytest.approx(0.01 / ROUNDED, rel=1e-9)


def test_stairs_of_pixels_are_none():
    corners = np.repeat(np.arange(20), 2)
    stairs = np.column_stack([corners[1:], corners[:-1]]).astype(float)
    assert rounded(stairs, False, 1e-4) == 0.0


def test_points_that_were_put_on_edges_do_not_count():
    points = ring(24, 30.0, 2)
    share = np.arange(3)[:, None] / 3
    after = np.roll(points, -1, axis=0)
    filled = np.concatenate([a + share * (b - a) for a, b in zip(points, after, strict=True)])
    assert rounded(filled, True, 1e-4) == rounded(points, True, 1e-4) > 0.0


def test_a_straight_row_tells_none():
    row = np.column_stack([0.01 * np.arange(1000), np.zeros(1000)])
    assert rounded(row, False, 1e-5) == 0.0


def test_points_too_near_to_each_other_to_turn_tell_none():
    assert rounded(1e-200 * ring(24, 30.0, 2), True, 1e-205) == 0.0
