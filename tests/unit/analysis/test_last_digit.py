"""What rounding to the last digit leaves of points."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline.analysis.last_digit import (
    CORNERS,
    FEWEST_BENT,
    ROUNDED,
    left_by_rounding,
    rounded,
)


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


def slot(count, decimals):
    """Two level edges and two half circles, whose places are no whole numbers of steps."""
    side = np.linspace(0, 1, count, endpoint=False)
    angle = np.pi * (side - 0.5)
    parts = [
        (40 * side, 0 * side - 10.03),
        (40 + 10.03 * np.cos(angle), 10.03 * np.sin(angle)),
        (40 - 40 * side, 0 * side + 10.03),
        (-10.03 * np.cos(angle), -10.03 * np.sin(angle)),
    ]
    return np.concatenate([np.column_stack(part) for part in parts]).round(decimals)


@pytest.mark.parametrize("closed", [True, False])
def test_level_edges_do_not_hide_what_rounding_leaves_of_arcs(closed):
    # More than half of the windows are exact; a median of uniform errors is near their deviation.
    points = np.concatenate([slot(60, 1), [(60.0 + k, -10.0) for k in range(200)]])
    rounding = 0.1 / ROUNDED
    assert left_by_rounding(points, closed, rounding) == pytest.approx(rounding, rel=0.3)


def test_few_windows_and_corners_tell_nothing_of_rounding():
    few = slot(60, 1)[: 60 + FEWEST_BENT // 4]
    assert left_by_rounding(np.concatenate([few, few[-1] + [[0.0, 1.0]]]), False, 0.1) == 0.0
    x = np.arange(200.0)
    saw = 10.0 * CORNERS * np.column_stack([x, np.abs(x % 4 - 2)])
    assert left_by_rounding(saw, False, 1.0) == 0.0
    assert left_by_rounding(slot(60, 1), True, 0.0) == 0.0
    assert left_by_rounding(slot(12, 1), True, 0.1) == 0.0
