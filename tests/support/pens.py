"""Pictures of strokes of a round pen, whose middles are known."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree

# Samples of a pixel, each way.
FINE = 4


def picture(lines, width, size):
    """Black on white: a pixel is as dark as the part of its samples that a pen has been at."""
    height, breadth = size
    rows, columns = np.mgrid[: height * FINE, : breadth * FINE]
    points = (np.column_stack([columns.ravel(), rows.ravel()]) + 0.5) / FINE
    off, _ = cKDTree(samples(lines)).query(points, distance_upper_bound=0.5 * width)
    ink = np.isfinite(off).reshape(height, FINE, breadth, FINE).mean(axis=(1, 3))
    return np.rint(255 * (1 - ink)).astype(np.uint8)


def arc(x, y, radius, begin, end, count=91):
    """Points on an arc, angles in degrees."""
    t = np.radians(np.linspace(begin, end, count))
    return np.column_stack([x + radius * np.cos(t), y + radius * np.sin(t)])


def samples(lines, step=0.1):
    """Points along polylines."""
    found = []
    for line in lines:
        for a, b in pairwise(np.asarray(line, dtype=float)):
            count = max(2, int(np.hypot(*(b - a)) / step) + 1)
            found.append(a + np.linspace(0, 1, count)[:, None] * (b - a))
    return np.concatenate(found)
