"""Two-sided distance by dense sampling.

The distance from a point to a polyline is exact to rounding, the one to a curve too large by half a
sample step at most. The largest distance of a curve from data is that of its samples: short of the
truth by half a step at most, enough to catch a promise that is broken.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from checks.curves import Array, polyline_of, samples, splines

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.interpolate import BSpline

# Samples beside which the nearest point is looked for.
BRANCHES = 4
# Pairs of a point and a side that are tried without a tree.
FEW = 20_000
# Parts that are looked at for a point, more of them only where these leave a doubt.
NEAREST = (3, 12, 48)
# Parts of all segments of a polyline together, at most, for each of its segments.
PARTS = 4
TINY = 1e-300


class TwoSided(NamedTuple):
    """Largest distances: data to curve, curve to data polyline; data units."""

    forward: float
    reverse: float

    @property
    def larger(self) -> float:
        """The two-sided distance."""
        return max(self)


def two_sided(curve: Any, points: Array, *, closed: bool, step: float) -> TwoSided:
    """Distances between a curve and the data, sampled about ``step`` apart."""
    polyline = np.concatenate([points, points[:1]]) if closed else points
    reverse = distance_to_polyline(polyline_of(curve, step), polyline)
    return TwoSided(float(distance_to_curve(points, curve, step).max()), float(reverse.max()))


def distance_to_polyline(points: Array, polyline: Array) -> Array:
    """Distance of each point to a polyline, shape (k,).

    Sides are cut into parts, and found by the middles of the parts through a k-d tree. A part
    beyond the nearest few is at least so far away as the last of those, less half its own length.
    Where that leaves a doubt, more of them are tried, at last every part within reach.
    """
    sides = _Sides(polyline[:-1], np.diff(polyline, axis=0))
    n = len(sides.begin)
    if n * len(points) <= FEW:
        every = sides.distances(np.repeat(points, n, axis=0), np.tile(np.arange(n), len(points)))
        return every.reshape(len(points), n).min(axis=1)
    owner, middles, half = sides.parts()
    tree = cKDTree(middles)
    best, doubtful = np.full(len(points), np.inf), np.arange(len(points))
    for n_near in NEAREST:
        n_near = min(n_near, len(owner))
        away, near = tree.query(points[doubtful], k=range(1, n_near + 1))
        for parts in near.T:
            found = sides.distances(points[doubtful], owner[parts])
            best[doubtful] = np.minimum(best[doubtful], found)
        doubtful = doubtful[best[doubtful] > away[:, -1] - half]
        if not len(doubtful) or n_near == len(owner):
            return best
    for index in doubtful:
        around = owner[tree.query_ball_point(points[index], best[index] + half * (1 + 1e-9))]
        if len(around):
            found = sides.distances(points[index], np.unique(around))
            best[index] = min(best[index], found.min())
    return best


class _Sides(NamedTuple):
    """Sides of a polyline: where they begin, and the way along them."""

    begin: Array
    along: Array

    def distances(self, points: Array, which: NDArray[np.int_]) -> Array:
        """Distance of each point to one side."""
        offset, side = points - self.begin[which], self.along[which]
        at = (offset * side).sum(axis=1) / np.maximum((side**2).sum(axis=1), TINY)
        return np.hypot(*(offset - np.clip(at, 0, 1)[:, None] * side).T)

    def parts(self) -> tuple[NDArray[np.int_], Array, float]:
        """Side and middle of every part, and half the length of the longest."""
        length = np.hypot(*self.along.T)
        longest = length.sum() / (PARTS * len(length))
        counts = np.maximum(np.ceil(length / max(longest, TINY)), 1).astype(int)
        owner = np.repeat(np.arange(len(length)), counts)
        share = np.concatenate([(np.arange(n) + 0.5) / n for n in counts])
        middles = self.begin[owner] + share[:, None] * self.along[owner]
        return owner, middles, 0.5 * float((length / counts).max())


def distance_to_curve(points: Array, curve: Any, step: float) -> Array:
    """Distance of each point to a curve: the nearest samples, then Newton's method beside them."""
    return np.min([_to_spline(points, spline, step) for spline in splines(curve)], axis=0)


def _to_spline(points: Array, spline: BSpline, step: float) -> Array:
    parameters, dense = samples(spline, step)
    # Several, since of two branches that meet the one with the nearest sample may be farther.
    _, near = cKDTree(dense).query(points, k=BRANCHES)
    return np.min([_beside(points, spline, parameters, at) for at in near.T], axis=0)


def _beside(points: Array, spline: BSpline, parameters: Array, at: NDArray[np.int_]) -> Array:
    """Distance to the curve between the neighbours of one sample for each point."""
    u = parameters[at]
    low = parameters[np.maximum(at - 1, 0)]
    high = parameters[np.minimum(at + 1, len(parameters) - 1)]
    best = np.hypot(*(spline(u) - points).T)
    for _ in range(5):
        off, velocity = spline(u) - points, spline(u, nu=1)
        speed_sq = (velocity**2).sum(axis=1)
        bend = np.maximum(speed_sq + (off * spline(u, nu=2)).sum(axis=1), 0.1 * speed_sq)
        u = np.clip(u - (off * velocity).sum(axis=1) / np.maximum(bend, TINY), low, high)
        best = np.minimum(best, np.hypot(*(spline(u) - points).T))
    return best
