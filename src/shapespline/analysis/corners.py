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
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray

# What a corner turns at least, and what turns so little that it is not looked at again, radians;
# `analysis/corners.hpp` says why.
LEAST_TURN, LOW_TURN = _kernels.LEAST_TURN, _kernels.LOW_TURN
# Of more points the test first looks at every so many-th.
MOST_POINTS = 10_000
# Of points that bend evenly one in fewer than so many is no corner: they are sparse for what they
# follow. But what turns by more than a bend of three points is a way back (ANA-18).
SPARSE_EVERY, WAY_BACK = 12, np.radians(135.0)


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
    turns = np.empty(len(contour))
    found, length = _kernels.find_corners(
        contour.points, contour.closed, contour.arc_length, sigma, tolerance, turns
    )
    indices = np.array(found, dtype=np.int64)
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
