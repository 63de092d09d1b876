"""What rounding to the last digit of a table or a file leaves of points."""

from __future__ import annotations

from math import ceil, inf
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis.noise import CHI_SQUARED_MEDIAN, FEWEST_POINTS, left_in_windows
from shapespline.validation import median

if TYPE_CHECKING:
    from shapespline.typing import BoolArray, FloatArray

# Rounding to steps deviates by a step over this. Steps beyond this part of the extent, or of what
# lies between neighbours, are no rounding (DRA-46, DRA-47). How near to whole numbers of steps
# points lie; how many differences tell it.
ROUNDED, COARSEST, COARSE, ON_GRID, MOST_DIFFERENCES = 12.0**0.5, 1e-3, 0.1, 1e-3, 256
# Windows that leave less than that of what rounding does are exact, those that leave so many times
# as much have corners; so many of the others tell how much it leaves (DRA-59).
EXACT, CORNERS, FEWEST_BENT = 1e-6, 2.0, 24
# Points on the straight way between their neighbours, but for a turn of so much, were put there.
STRAIGHT = 1e-9


def rounded(points: FloatArray, closed: bool, finest: float) -> float:
    """Standard deviation of coordinates that are all whole numbers of one step; else 0.

    The step is what coordinates that are next to each other differ by, by Euclid's algorithm; finer
    ones than `finest` are none. Points straight between their neighbours do not count: those that
    were put on edges have digits of their own.

    Examples
    --------
    >>> angle = np.pi * np.arange(50) / 25
    >>> circle = 5 * np.column_stack([np.cos(angle), np.sin(angle)])
    >>> bool(np.isclose(rounded(circle.round(2), True, 1e-4), 0.01 / 12**0.5))
    True
    >>> rounded(circle, True, 1e-4)
    0.0
    """
    points = points[_turning(points, closed)]
    if len(points) < 2:
        return 0.0
    offsets = points - points[0]
    between = np.diff(np.sort(offsets, axis=None))
    between = between[between > finest]
    step = inf
    for rest in between[:: ceil(len(between) / MOST_DIFFERENCES) or 1].tolist():
        while rest > finest:
            step, rest = rest, abs(step - rest * round(step / rest)) if step < inf else 0.0
    apart = median(np.hypot(*np.diff(points, axis=0).T))
    if step > max(COARSEST * float(np.ptp(points, axis=0).max()), COARSE * apart):
        return 0.0
    counts = offsets / step
    return step / ROUNDED if (np.abs(counts - np.round(counts)) <= ON_GRID).all() else 0.0


def left_by_rounding(points: FloatArray, closed: bool, rounding: float) -> float:
    """What rounding leaves of local cubics where it leaves any: level edges are exact nevertheless.

    `rounding` is what `rounded` tells. 0 of few points, or where few windows of them bend by no
    more than it makes them.

    Examples
    --------
    >>> angle = np.pi * np.arange(100) / 50
    >>> circle = 5 * np.column_stack([np.cos(angle), np.sin(angle)])
    >>> rounding = 0.01 / 12**0.5
    >>> bool(0.8 < left_by_rounding(circle.round(2), True, rounding) / rounding < 1.2)
    True
    >>> left_by_rounding(np.column_stack([angle, 0 * angle]), False, rounding)
    0.0
    """
    if not rounding or len(points) < FEWEST_POINTS:
        return 0.0
    left = np.sqrt(left_in_windows(points, closed) / CHI_SQUARED_MEDIAN) / rounding
    bent = left[(left > EXACT) & (left < CORNERS)]
    return rounding * median(bent) if len(bent) >= FEWEST_BENT else 0.0


def _turning(points: FloatArray, closed: bool) -> BoolArray:
    """Whether the way turns at each point, or ends there."""
    row = np.concatenate([points[-1:], points, points[:1]]) if closed else points
    along = np.diff(row, axis=0)
    (ax, ay), (bx, by) = along[:-1].T, along[1:].T
    turns = np.abs(ax * by - ay * bx) > STRAIGHT * (np.hypot(ax, ay) * np.hypot(bx, by))
    turns |= ax * bx + ay * by < 0.0
    return turns if closed else np.concatenate([[True], turns, [True]])
