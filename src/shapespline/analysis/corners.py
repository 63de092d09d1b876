"""Corners of a contour: where its direction jumps, at more than one length and above its noise.

A line that runs into an arc is no corner: the two tangents at a point are those of parabolas
fitted to either side of it (one-sided local quadratic least squares), so that a bend of the outline
itself does not count, only a jump.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.analysis.noise import bends_evenly, noise_level
from shapespline.validation import median
from shapespline.values import Contour

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import FloatArray, IntArray

# A corner of the data turns at least this much over the lengths below, radians; what turns less
# than the second has a low turn, and is not looked at again. Neither is about joints of a curve:
# those are smooth by the values' `SMOOTH_TURN` (PIE-13, PIE-22).
LEAST_TURN, LOW_TURN = np.radians(25.0), np.radians(8.0)
# The test looks at a length on either side: at least so many median steps and tolerances (ANA-03).
STEPS = 5.0
TOLERANCES = 8.0
# A bend that is round within the first number of tolerances is no corner. The test looks so near
# where that is less than the second part of the length above (ANA-04).
CLOSE_TOLERANCES, CLOSER = 2.0, 0.65
# A parabola over a length L sampled at spacing d with noise sigma has a slope error of about
# sigma sqrt(d / L^3) times a constant; this one makes it a small part of LEAST_TURN.
NOISE_FACTOR = 132.0
# Lengths beyond this part of the outline look past its features.
LONGEST_PART = 0.125
# Neighbours on each side that are averaged for the arc length, until the noise in a difference is
# this part of a step.
HALF_WINDOWS = (1, 2, 4, 8, 16, 32)
QUIET_STEP = 0.3
# Of more points the test first looks at every so many-th.
MOST_POINTS = 10_000
# Around a bend that the points resolve the curvature changes by no more than this part of its peak
# from one to the next; at a corner it springs up, and where a line runs into an arc (ANA-05).
GRADUAL_PART = 0.45
# Of points that bend evenly one in fewer than so many is no corner: they are sparse for what they
# follow. But what turns by more than a bend of three points is a way back (ANA-18).
SPARSE_EVERY, WAY_BACK = 12, np.radians(135.0)
# Corners keep this part of the length apart.
APART = 0.6


class Corners(NamedTuple):
    """Where a contour turns abruptly.

    ``indices`` (k,) are increasing; ``turns`` (n,) is the turn of every point over ``length``, in
    radians; where that is not low the smallest of those over several lengths (0 where they
    disagree in sign, and around a bend).
    """

    indices: IntArray
    turns: FloatArray
    length: float


def find_corners(contour: Contour, tolerance: float = 0.0) -> Corners:
    """Corners of a contour.

    Parameters
    ----------
    contour : Contour
    tolerance : float
        What is smaller than a few tolerances is no feature, data units.

    Examples
    --------
    >>> from shapespline import Contour
    >>> side = np.linspace(0, 1, 20, endpoint=False)
    >>> x = np.concatenate([side, 1 + 0 * side, 1 - side, 0 * side])
    >>> square = Contour(np.column_stack([x, np.roll(x, 20)]), closed=True)
    >>> find_corners(square).indices.tolist()
    [0, 20, 40, 60]
    """
    sigma = noise_level(contour)
    if len(contour) > MOST_POINTS:
        return _found_coarsely(contour, tolerance, sigma)
    return _found(contour, tolerance, sigma)


def _found(contour: Contour, tolerance: float, sigma: float) -> Corners:
    """Corners among all points."""
    stations = _stations(contour, sigma)
    spacing, total = median(np.diff(stations)), float(stations[-1])
    noise_length = (NOISE_FACTOR * sigma * np.sqrt(spacing)) ** (2 / 3)
    longest = LONGEST_PART * total
    shortest = max(STEPS * spacing, noise_length)
    length = min(max(shortest, TOLERANCES * tolerance), longest)
    fine = tangent_jumps(contour, length, stations, np.arange(len(contour)))
    others = [min(2.0 * length, longest)]
    if (close := max(shortest, CLOSE_TOLERANCES * tolerance)) < CLOSER * length:
        others.append(close)
    turns = np.abs(fine)
    abrupt = np.flatnonzero(turns >= LOW_TURN)
    for other in others:
        again = tangent_jumps(contour, other, stations, abrupt)
        agree = again * fine[abrupt] > 0
        turns[abrupt] = np.where(agree, np.minimum(turns[abrupt], np.abs(again)), 0.0)
    lap = total if contour.closed else np.inf
    along = stations[: len(contour)]
    indices = _separated_maxima(turns, along, lap, APART * length)
    if close == shortest:  # no look from nearer
        are_bends = _are_bends(contour, indices)
        for bend in indices[are_bends]:
            turns[_gaps(along, along[bend], lap) <= length] = 0.0
        indices = indices[~are_bends]
    if len(indices) * SPARSE_EVERY > len(contour) and bends_evenly(contour.polyline):
        turns[(turns >= LOW_TURN) & (turns < WAY_BACK)] = 0.0
        indices = indices[turns[indices] > 0.0]
    return Corners(indices, turns, length)


def _found_coarsely(contour: Contour, tolerance: float, sigma: float) -> Corners:
    """Corners among every so many-th point, moved to the farthest point near by."""
    n, stride = len(contour), -(-len(contour) // MOST_POINTS)
    coarse = Contour.trusted(np.ascontiguousarray(contour.points[::stride]), contour.closed)
    found = _found(coarse, tolerance, sigma)
    indices = []
    for middle in stride * found.indices:
        near = np.arange(middle - 2 * stride, middle + 2 * stride + 1)
        near = near % n if contour.closed else np.clip(near, 0, n - 1)
        begin, end = contour.points[near[0]], contour.points[near[-1]]
        (x, y), (dx, dy) = (contour.points[near] - begin).T, end - begin
        indices.append(int(near[np.abs(x * dy - y * dx).argmax()]))
    turns = found.turns.repeat(stride)[:n]
    return Corners(np.unique(np.array(indices, dtype=np.int64)), turns, found.length)


def _stations(contour: Contour, sigma: float) -> FloatArray:
    """Arc length at the vertices of the polyline, shape of ``contour.arc_length``.

    Noise makes a polyline longer than the outline it stands for. So neighbours are averaged until
    the noise that is left in their differences is small against the steps.
    """
    steps, width = np.diff(contour.arc_length), 1
    for half in HALF_WINDOWS:
        quiet = np.sqrt(2.0) * sigma / width <= QUIET_STEP * median(steps)
        width = 2 * half + 1
        if quiet or width > len(contour) // 4:
            break
        steps = _averaged_steps(contour, half)
    # Averaging may stall at the ends; a station must not repeat.
    least = 1e-3 * float(steps.mean())
    return np.concatenate([[0.0], np.cumsum(np.maximum(steps, least))])


def _averaged_steps(contour: Contour, half: int) -> FloatArray:
    """Lengths of the steps between averages of ``half`` neighbours on each side and the point."""
    n, width = len(contour), 2 * half + 1
    index = np.arange(-half, n + half)
    index = index % n if contour.closed else np.clip(index, 0, n - 1)
    sums = np.cumsum(np.concatenate([np.zeros((1, 2)), contour.points[index]]), axis=0)
    means = (sums[width:] - sums[:-width]) / width
    if contour.closed:
        means = np.concatenate([means, means[:1]])
    return np.hypot(*np.diff(means, axis=0).T)


def tangent_jumps(
    contour: Contour, length: float, stations: FloatArray, at: IntArray
) -> FloatArray:
    """Signed angle between the one-sided tangents at some points, radians, shape of ``at``."""
    points = contour.points
    if contour.closed:
        at = at + len(contour)
        lap, total = stations[:-1], stations[-1]
        stations = np.concatenate([lap - total, lap, lap + total])
        points = np.concatenate([points, points, points])
    turns = np.empty(len(at))
    _kernels.corner_turns(points, np.ascontiguousarray(stations), at, length, turns)
    return turns


def _are_bends(contour: Contour, corners: IntArray) -> NDArray[np.bool_]:
    """Whether the curvature rises and falls so gradually around corners that these are bends."""
    if not len(corners):
        return np.zeros(0, dtype=bool)
    steps = np.diff(contour.polyline, axis=0)
    if contour.closed:
        steps = np.concatenate([steps[-1:], steps])
    (x, y), lengths = steps.T, np.hypot(*steps.T)
    turns = np.arctan2(x[:-1] * y[1:] - y[:-1] * x[1:], x[:-1] * x[1:] + y[:-1] * y[1:])
    curvature = 2.0 * turns / (lengths[:-1] + lengths[1:])
    if not contour.closed:
        curvature = np.pad(curvature, 1)
    half = int(STEPS)
    around = corners[:, None] + np.arange(-half, half + 1)
    near = curvature.take(around, mode="wrap" if contour.closed else "clip")
    jumps = np.abs(np.diff(near, axis=1)).max(axis=1)
    return jumps <= GRADUAL_PART * np.abs(near[:, half - 1 : half + 2]).max(axis=1)


def _separated_maxima(turns: FloatArray, along: FloatArray, lap: float, apart: float) -> IntArray:
    """Points that turn enough and most within ``apart`` along the outline, the sharpest first."""
    enough = np.flatnonzero(turns >= LEAST_TURN)
    along, turns = along[enough], turns[enough]
    # Most turn less than the one before or behind.
    close, rise = np.diff(along) <= apart, np.diff(turns)
    less = np.zeros(len(enough), dtype=bool)
    less[:-1] |= close & (rise > 0)
    less[1:] |= close & (rise < 0)
    peaks = np.flatnonzero(~less)
    chosen: list[int] = []
    for i in peaks[np.argsort(-turns[peaks], kind="stable")].tolist():
        gaps = _gaps(along, along[i], lap)
        if (gaps[chosen] > apart).all() and turns[i] >= turns[gaps <= apart].max():
            chosen.append(i)
    return np.sort(enough[chosen])


def _gaps(along: FloatArray, place: float, lap: float) -> FloatArray:
    """Distances from a place along the outline, the shorter way round a closed one."""
    gaps = np.abs(along - place)
    return np.minimum(gaps, lap - gaps)
