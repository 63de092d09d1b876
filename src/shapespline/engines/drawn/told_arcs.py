"""Arcs that points of a picture tell exactly: tracing put them where the ink of the pixels says.

They are a few pixels long, and most of that is so near to their ends that points elsewhere would be
blunted there and do not count; no search for segments finds them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import FloatArray

# Points that share a circle with their neighbours to this part of its radius, so many in a row, of
# a radius of no more pixels: a circle so exact is no chance (DRA-39).
SAME_CIRCLE, LEAST_ALIKE, LARGEST = 1e-6, 5, 8.0


def told_arcs(points: FloatArray, pixel: float) -> list[tuple[int, int]]:
    """First and last point of each arc of a closed outline, the last one maybe beyond its end."""
    n = len(points)
    if n < LEAST_ALIKE + 2:
        return []
    a, b = np.roll(points, 1, axis=0) - points, np.roll(points, -1, axis=0) - points
    double = 2.0 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    u, v = (a**2).sum(axis=1), (b**2).sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        off = np.stack([b[:, 1] * u - a[:, 1] * v, a[:, 0] * v - b[:, 0] * u], axis=1)
        off /= double[:, None]
    radius = np.hypot(*off.T)
    middle = points + off
    with np.errstate(invalid="ignore"):
        apart = np.hypot(*(np.roll(middle, -1, axis=0) - middle).T)
        # Between a point and the next one.
        same = (apart <= SAME_CIRCLE * radius) & (radius <= LARGEST * pixel)
    if same.all() or not same.any():  # a whole circle, or none
        return []
    first = int(np.flatnonzero(~same)[0]) + 1
    begins = np.flatnonzero(np.diff(np.roll(same, -first).astype(int), prepend=0) == 1)
    ends = np.flatnonzero(np.diff(np.roll(same, -first).astype(int), append=0) == -1) + 1
    # The points on either side are of the circle, too.
    return [
        ((first + int(i) - 1) % n, (first + int(i) - 1) % n + int(j - i) + 2)
        for i, j in zip(begins, ends, strict=True)
        if j - i + 1 >= LEAST_ALIKE
    ]
