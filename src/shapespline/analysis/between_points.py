"""The smooth curve through clean points, as far as they tell it: points between them.

What lies between sparse points of a smooth curve is no chord: a curve near all chords is a polygon.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis.noise import EVEN_PART, FEWEST_TO_PREDICT, left_of
from shapespline.validation import distinct
from shapespline.values import Contour

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import FloatArray, IntArray

# A closed curve is followed so many points beyond its ends: what happens there is felt by a factor
# of 0.27 less from point to point.
BEYOND = 24
# The derivative at an end is that of the polynomial through so many points.
AT_ENDS = 4
# More points between two neighbours than these would say that they are no neighbours.
MOST_BETWEEN = 32
# What bulges by more than this part of its chord is no bend that the points resolve.
MOST_BULGE = 0.1
# A chord so many times as long as those beside it was drawn as a line.
LONG_EDGE = 2.0


def with_points_between(
    contour: Contour, corners: IntArray, within: float, farthest: float
) -> Contour:
    """A contour with points between its own, so that its chords stay near the curve through them.

    The curve is the cubic spline with continuous curvature by chord length, from corner to corner,
    where the points bend evenly; elsewhere chords stay.

    Parameters
    ----------
    contour : Contour
    corners : ndarray, shape (k,)
        Indices of points at which the curve may turn, ascending.
    within : float
        How far chords may be from the curve, data units.
    farthest : float
        How far the curve may be from a chord if the neighbours on both sides do not tell it, too.

    Examples
    --------
    >>> t = 2 * np.pi * np.arange(40) / 40
    >>> circle = Contour(np.column_stack([np.cos(t), np.sin(t)]), closed=True)
    >>> dense = with_points_between(circle, np.array([], dtype=int), 1e-4, 0.1)
    >>> bool(abs(np.hypot(*dense.points.T) - 1).max() < 2e-5), len(dense) >= 200
    (True, True)
    """
    points, closed = contour.points, contour.closed
    if _are_dense(contour, corners, within):
        return contour
    if closed and not len(corners):
        row = np.concatenate([points[-BEYOND:], points, points[: BEYOND + 1]])
        filled = _filled(row, within, farthest, min(BEYOND, len(points)))
        return Contour.silently(filled[:-1], True, accuracy=contour.accuracy)
    cuts = corners
    if closed:
        points = np.concatenate([points[corners[0] :], points[: corners[0] + 1]])
        cuts = corners - corners[0]
    cuts = distinct(np.array([0, len(points) - 1]), cuts)
    rows = []
    for a, b in pairwise(cuts.tolist()):
        run = points[a : b + 1]
        filled = _filled(run, within, farthest) if len(run) >= FEWEST_TO_PREDICT else run
        rows.append(filled[:-1])
    row = np.concatenate([*rows, points[-1:]])
    return Contour.silently(row[:-1] if closed else row, closed, accuracy=contour.accuracy)


def _are_dense(contour: Contour, corners: IntArray, within: float) -> bool:
    """Whether chords are near the curve as they are, told by second differences but in corners."""
    row = contour.polyline if contour.closed else contour.points
    bends = np.hypot(*(row[:-2] - 2.0 * row[1:-1] + row[2:]).T)
    inner = corners[(corners > 0) & (corners <= len(bends))]
    bends[inner - 1] = 0.0
    return bool(bends.max(initial=0.0) <= 8.0 * within)


def _filled(points: FloatArray, within: float, farthest: float, beyond: int = 0) -> FloatArray:
    """A row of points with those of its spline between them; some at both ends only guide it."""
    z = points[:, 0] + 1j * points[:, 1]
    u = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(z)))])
    velocity, even = _velocities(u, z), _are_even(points)
    own = slice(beyond, len(z) - beyond)
    z, width, velocity, even = z[own], np.diff(u[own]), velocity[own], even[own]
    slope = np.diff(z) / width
    second = (3.0 * slope - 2.0 * velocity[:-1] - velocity[1:]) / width
    third = (velocity[:-1] + velocity[1:] - 2.0 * slope) / width**2
    # A chord over h strays by h^2 / 8 times the largest second derivative at most.
    bend = np.maximum(np.abs(2.0 * second), np.abs(2.0 * second + 6.0 * third * width))
    off = width**2 * bend / 8.0
    parts = np.clip(np.ceil(np.sqrt(off / within)), 1, MOST_BETWEEN).astype(int)
    either, both = even[:-1] | even[1:], even[:-1] & even[1:]
    told = np.where(off <= farthest, either, both & (off <= MOST_BULGE * width))
    parts[~told | _are_edges(width)] = 1
    at = np.repeat(np.arange(len(width)), parts)
    share = np.arange(len(at)) - np.repeat(np.cumsum(parts) - parts, parts)
    t = width[at] * share / parts[at]
    filled = z[at] + t * (velocity[at] + t * (second[at] + t * third[at]))
    filled = np.append(filled, z[-1])
    return np.column_stack([filled.real, filled.imag])


def _are_edges(width: FloatArray) -> NDArray[np.bool_]:
    """For each chord whether it is long beside both of its neighbours, as drawn edges are."""
    around = np.concatenate([[0.0], width, [0.0]])
    return np.asarray(width > LONG_EDGE * np.maximum(around[:-2], around[2:]))


def _are_even(points: FloatArray) -> NDArray[np.bool_]:
    """For each point whether it and its neighbours bend evenly; of those at the ends not told."""
    even = np.zeros(len(points), dtype=bool)
    cubic, chord = (np.hypot(*left.T) for left in left_of(points))
    even[2:-2] = cubic < EVEN_PART * chord
    return even


def _velocities(u: FloatArray, z: FloatArray) -> FloatArray:
    """Derivatives of the spline at its points, complex: a system of three diagonals."""
    width = np.diff(u)
    slope = np.diff(z) / width
    ends = [_end_velocity(u, z), _end_velocity(u[::-1], z[::-1])]
    before, after = width[1:].tolist(), width[:-1].tolist()
    middle = (2.0 * (width[1:] + width[:-1])).tolist()
    right = (3.0 * (width[1:] * slope[:-1] + width[:-1] * slope[1:])).tolist()
    right[0] -= before[0] * ends[0]
    right[-1] -= after[-1] * ends[1]
    for i in range(1, len(middle)):
        part = before[i] / middle[i - 1]
        middle[i] -= part * after[i - 1]
        right[i] -= part * right[i - 1]
    right[-1] /= middle[-1]
    for i in range(len(middle) - 2, -1, -1):
        right[i] = (right[i] - after[i] * right[i + 1]) / middle[i]
    return np.array([ends[0], *right, ends[1]])


def _end_velocity(u: FloatArray, z: FloatArray) -> complex:
    """The derivative at the first point of the polynomial through the first ones."""
    offsets = u[:AT_ENDS] - u[0]
    powers = np.vander(offsets, increasing=True)
    return complex(np.linalg.solve(powers, z[:AT_ENDS])[1])
