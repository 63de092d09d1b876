"""Straight runs of a contour: which parts of it were drawn as lines.

Chords at two tolerances (cone intersection) tell a line from an arc: a line stays one chord.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.analysis.noise import noise_level
from shapespline.validation import median
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray

# A straight run has more than so many points, which spread across a line by at most this part of
# the tolerance. One smooth spline would bend it (ANA-10, FIT-08).
FEWEST_STRAIGHT, STRAIGHT_PART = 8, 0.1
# A chord is a straight run, and not one of a row along an arc, if this part of it stays one chord
# at a fiftieth of the distance (an arc makes seven, an inflection four), and if it is longer than
# so many tolerances.
FINER, ONE_CHORD, LEAST_TOLERANCES = 0.02, 0.6, 10.0
# An edge so many times as long as the median edge was drawn as a line (ANA-11).
LONG_EDGE = 8.0
# So is one that many times as long as the median, if at each end it turns by more than that or the
# next one is that many times shorter: no chord of an arc is so. Points in so many parts of it tell
# that it is straight (ANA-21).
LONGER, CORNER, PARTS = 3.0, np.radians(20.0), 3
# At twice the distance of points a cubic leaves sixteen times as much of a bend, but as much of
# scatter as before; beyond this factor it was a bend.
BEND_GROWTH = 4.0


def filled(contour: Contour) -> Contour:
    """The contour with points along edges far longer than most: those were drawn as lines.

    Examples
    --------
    >>> x = np.append(np.linspace(0, 1, 50), 9.0)
    >>> len(filled(Contour(np.column_stack([x, 0 * x]), closed=False)))
    66
    """
    polyline = contour.polyline
    steps = np.hypot(*np.diff(polyline, axis=0).T)
    parts = np.where(steps > LONG_EDGE * median(steps), 2 * FEWEST_STRAIGHT, 1)
    if (parts == 1).all():
        return contour
    points = in_parts(polyline, parts, contour.closed)
    return Contour.trusted(points, contour.closed, contour.accuracy)


def with_points_on_lines(points: FloatArray, closed: bool) -> FloatArray:
    """The points, and some on each edge that was drawn as a line, whose ends alone are given.

    Examples
    --------
    >>> angle = np.linspace(0, np.pi, 19)
    >>> arch = np.column_stack([np.cos(angle), np.sin(angle)])
    >>> side = np.array([(-1.0, -2.0), (1.0, -2.0)])
    >>> len(with_points_on_lines(np.concatenate([arch, side]), True))
    27
    """
    polyline = np.concatenate([points, points[:1]]) if closed else points
    along = np.diff(polyline, axis=0)
    steps = np.hypot(*along.T)
    long = steps > LONGER * median(steps)
    if not long.any():
        return points
    (ax, ay), (bx, by) = np.roll(along, 1, axis=0).T, along.T
    sharp = np.abs(np.arctan2(ax * by - ay * bx, ax * bx + ay * by)) > CORNER
    if not closed:
        sharp[0] = True
    at_begin = sharp | (LONGER * np.roll(steps, 1) < steps)
    at_end = np.roll(sharp, -1) | (LONGER * np.roll(steps, -1) < steps)
    return in_parts(polyline, np.where(long & at_begin & at_end, PARTS, 1), closed)


def in_parts(polyline: FloatArray, parts: IntArray, closed: bool) -> FloatArray:
    """The points of a polyline with each of its edges in so many equal parts.

    Examples
    --------
    >>> corner = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 3.0)])
    >>> in_parts(corner, np.array([2, 1]), closed=False).tolist()
    [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 3.0]]
    """
    begins = np.repeat(np.arange(len(parts)), parts)
    share = np.concatenate([np.arange(count) / count for count in parts.tolist()])
    points = polyline[begins] + share[:, None] * np.diff(polyline, axis=0)[begins]
    return points if closed else np.concatenate([points, polyline[-1:]])


def has_straight_runs(contour: Contour, tolerance: float) -> bool:
    """Whether some of the data are straight, or too noisy to tell.

    Examples
    --------
    >>> side = np.linspace(0, 1, 20, endpoint=False)
    >>> x = np.concatenate([side, 1 + 0 * side, 1 - side, 0 * side])
    >>> has_straight_runs(Contour(np.column_stack([x, np.roll(x, 20)]), closed=True), 0.01)
    True
    """
    contour = filled(contour)
    width = STRAIGHT_PART * tolerance
    if _is_noisy(contour, 0.5 * FINER * width):
        return True
    polyline = contour.polyline
    fine = _chords(polyline, FINER * width)
    coarse = fine[_chords(polyline[fine], width)]
    lengths = _lengths(polyline, coarse)
    longest = np.zeros(len(lengths))
    inside = np.searchsorted(coarse, 0.5 * (fine[1:] + fine[:-1]), side="right") - 1
    np.maximum.at(longest, inside, _lengths(polyline, fine))
    runs = (np.diff(coarse) > FEWEST_STRAIGHT) & (longest >= ONE_CHORD * lengths)
    return bool((runs & (lengths >= LEAST_TOLERANCES * tolerance)).any())


def _is_noisy(contour: Contour, level: float) -> bool:
    """Whether the points scatter by more than a level.

    What a cubic leaves of few points on a smooth curve looks like scatter, but grows with the
    fourth power of their distance, which scatter does not.
    """
    found = noise_level(contour)
    if not found > level:
        return False
    half = Contour.trusted(contour.points[::2], contour.closed, contour.accuracy)
    return noise_level(half) < BEND_GROWTH * found


def _chords(polyline: FloatArray, distance: float) -> IntArray:
    """Indices of vertices whose chords lie within a distance of the polyline."""
    return np.array(_kernels.thinned(polyline, distance, np.inf, None), dtype=np.int64)


def _lengths(polyline: FloatArray, vertices: IntArray) -> FloatArray:
    return np.hypot(*np.diff(polyline[vertices], axis=0).T)
