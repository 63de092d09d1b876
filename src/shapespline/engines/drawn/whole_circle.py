"""All points of an outline as one circle."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.engines.drawn.judgement import LARGEST
from shapespline.engines.drawn.parts import DrawnArc
from shapespline.geometry import signed_area
from shapespline.values import Arc

if TYPE_CHECKING:
    from shapespline.engines.drawn.observed import Observed
    from shapespline.typing import FloatArray

# A whole circle is within so many deviations in the mean (DRA-06), of measured points, whose errors
# are independent, fewer (DRA-16).
ROUND, ROUND_OF_POINTS = 2.0, 1.3
# What neighbours are off by is alike by chance up to so many deviations of the correlation of as
# many random numbers (DRA-47).
ALIKE = 3.0


class WholeCircle(NamedTuple):
    """A circle, and how far points are off it, each for how sure it is."""

    arc: DrawnArc
    off: FloatArray


def whole_circle(seen: Observed, *, independent: bool = False) -> WholeCircle | None:
    """All points as one circle; ``independent`` if errors may not go on from point to point."""
    points = seen.points
    sure = np.ones(len(points)) if seen.precisions is None else seen.precisions
    cx, cy, r = _kernels.circle_through(points, sure)
    off = (np.hypot(points[:, 0] - cx, points[:, 1] - cy) - r) * np.sqrt(sure)
    most = ROUND if seen.pixel else ROUND_OF_POINTS
    mean, largest = float(np.sqrt((off**2).mean())), float(np.abs(off).max())
    if mean > most * seen.largest_deviation or largest > LARGEST * seen.largest_deviation:
        return None
    if independent and abs(off @ np.roll(off, 1)) > ALIKE * len(off) ** 0.5 * mean**2:
        return None
    arc = Arc((cx, cy), r, 0.0, float(np.copysign(2 * np.pi, signed_area(points))))
    begin = np.array([cx + r, cy])
    return WholeCircle(DrawnArc(arc, begin, begin), off)
