"""Lines and arcs of some points that are the beginning of a free-form run beside them.

A run is looked for at some points only, and a quintic follows no long one; so an element may fill
the gap between a corner and where the run is found to begin, told by nothing but its own fit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.engines.drawn.segments import (
    ARC,
    ARC_PARAMETERS,
    CORNER,
    CORNER_STEPS,
    FREE,
    LINE,
    LINE_PARAMETERS,
    PRICE,
    off_line,
)

if TYPE_CHECKING:
    from shapespline.engines.drawn.observed import Observed
    from shapespline.engines.drawn.segments import Segment, Segments
    from shapespline.typing import FloatArray

# Coefficients of a quintic, which follows what a run begins with (DRA-44).
QUINTIC = 6


def without_beginnings(row: Segments, seen: Observed) -> Segments:
    """The row of measured points with what is the beginning of a free-form run as part of it.

    An element from a corner that runs smoothly on into a free-form curve was drawn if it saves its
    parameters: if one quintic over both, as far again as the element, misses points by more
    (DRA-44).
    """
    n = len(row.found)
    if seen.pixel:
        return row
    begun = []
    for k, element in enumerate(row.found):
        before, after = row.found[k - 1], row.found[(k + 1) % n]
        if element.kind == FREE or n < 3 or not (seen.closed or 0 < k < n - 1):
            continue
        if (before.kind == FREE) != (after.kind == FREE):
            free = before if before.kind == FREE else after
            if _goes_on(row, element, free, seen.deviation):
                begun.append(k)
    if not begun:
        return row
    found = [s._replace(kind=FREE) if k in begun else s for k, s in enumerate(row.found)]
    row = row._replace(found=tuple(found))
    whole = next((k for k, s in enumerate(found) if s.kind != FREE), 0)
    return row.turned(whole) if seen.closed else row


def _goes_on(row: Segments, element: Segment, free: Segment, deviation: float) -> bool:
    """Whether a quintic over an element and as much of the run beside it explains both for less."""
    i, j, kind = element
    length = min(j - i, free.end - free.begin)
    # From the corner on; the point there may be the neighbour's, before which its last ones lie.
    if (free.begin - j) % (len(row.points) - 1) == 0:
        places, way = ((i - CORNER_STEPS, i), (i + 1, j), (j, j + length)), 1
    else:
        places, way = ((j, j + CORNER_STEPS), (i, j - 1), (i - length, i)), -1
    edge, own, run = (_points_of(row, *place)[::way].copy() for place in places)
    into = run[: CORNER_STEPS + 1][-1] - run[0]
    if _turn(edge[-1] - edge[0], _direction(own, kind, edge[-1])) <= CORNER:
        return False
    if _turn(own[-1] - own[-CORNER_STEPS - 1 :][0], into) > CORNER:
        return False
    apart = _misfit_of(own, kind) + _quintic_misfit(run)
    together = _quintic_misfit(np.concatenate([own, run[1:]]))
    # Its own parameters, and that it runs on smoothly.
    saved = (LINE_PARAMETERS if kind == LINE else ARC_PARAMETERS) + 1.0
    return together - apart <= 2.0 * PRICE * saved * deviation**2


def _points_of(row: Segments, begin: int, end: int) -> FloatArray:
    """Points of a row, of a closed outline's beyond its ends, too."""
    n = len(row.points)
    if begin >= 0 and end < n:
        return row.points[begin : end + 1]
    return row.points[np.arange(begin, end + 1) % (n - 1)]


def _turn(u: FloatArray, v: FloatArray) -> float:
    """Angle between two directions; 0 where one is none."""
    return abs(float(np.arctan2(u[0] * v[1] - u[1] * v[0], u @ v)))


def _direction(points: FloatArray, kind: int, at: FloatArray) -> FloatArray:
    """Of the line or the circle through some points, beside a place before them."""
    chord = points[-1] - points[0]
    if kind == LINE or len(points) < 3:
        return chord
    x, y, _ = _kernels.circle_through(points, np.ones(len(points)))
    tangent = np.array([y - at[1], at[0] - x])
    return tangent if tangent @ chord > 0 else -tangent


def _misfit_of(points: FloatArray, kind: int) -> float:
    """Sum of squares that a line or a circle leaves of points."""
    if len(points) <= 2 + (kind == ARC):
        return 0.0
    if kind == LINE:
        across = off_line(points)
    else:
        x, y, radius = _kernels.circle_through(points, np.ones(len(points)))
        across = np.hypot(points[:, 0] - x, points[:, 1] - y) - radius
    return float(across @ across)


def _quintic_misfit(points: FloatArray) -> float:
    """Sum of squares that a quintic in arc length leaves of points."""
    if len(points) <= QUINTIC:
        return 0.0
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    powers = np.vander(2.0 * stations / stations[-1] - 1.0, QUINTIC)
    left = points - powers @ np.linalg.lstsq(powers, points, rcond=None)[0]
    return float((left**2).sum())
