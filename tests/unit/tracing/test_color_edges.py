"""Places of borders between colours."""

from __future__ import annotations

import numpy as np

from shapespline.tracing import trace


def test_a_pixel_that_is_half_of_each_colour_bends_no_border():
    # The border passes through the middles of every eighth row's pixels.
    rows = np.arange(80)
    covered = np.clip(20 + rows[:, None] / 8 - np.arange(50), 0.0, 1.0)
    first, second = np.array([160.0, 210.0, 240.0]), np.array([120.0, 190.0, 106.0])
    picture = np.rint(second + covered[:, :, None] * (first - second)).astype(np.uint8)
    assert (picture == (first + second) / 2).all(axis=2).sum() >= 10
    for contour in trace(picture, colors="auto"):
        x, y = contour.points.T
        inner = (x > 1) & (x < 49) & (y > 6) & (y < 74)  # as far as sums across an edge reach
        # Within the largest error of sums across an edge (TRC-03), and a unit of 8 bits.
        off = x[inner] - (20 + (79.5 - y[inner]) / 8)
        assert np.abs(off).max() < 0.007 + 1 / 134
