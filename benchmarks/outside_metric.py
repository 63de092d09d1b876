"""Two-sided distance by dense sampling, with nothing of shapespline's own in it.

Curves are scipy BSplines; samples lie no farther apart than a tenth of the tolerance, segments are
found through a k-d tree. What it returns is a lower bound of the distance, short of it by at most
half a sample step: enough to catch a promise that is broken.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

Array = NDArray[np.float64]
MOST_SAMPLES = 2_000_000
FEWEST_A_SPAN = 64
# Samples beside which the nearest point of a curve is looked for.
BRANCHES = 4


class TwoSided(NamedTuple):
    """Largest distances: data to curve, curve to data polyline; data units."""

    forward: float
    reverse: float

    @property
    def larger(self) -> float:
        """The two-sided distance."""
        return max(self)


def curve_samples(curve: BSpline, step: float) -> tuple[Array, Array]:
    """Parameters and points on a curve about ``step`` apart or closer, ends of spans included."""
    breaks = np.unique(curve.t[curve.k : len(curve.t) - curve.k])
    coarse = curve(_spread(breaks, np.full(len(breaks) - 1, FEWEST_A_SPAN)))
    chords = np.hypot(*np.diff(coarse, axis=0).T).reshape(len(breaks) - 1, FEWEST_A_SPAN)
    # Twice the mean speed allows for the fastest part of a span.
    count = np.clip(2 * chords.sum(axis=1) / step, FEWEST_A_SPAN, MOST_SAMPLES / len(breaks))
    parameters = _spread(breaks, count.astype(int))
    return parameters, curve(parameters)


def _spread(breaks: Array, counts: NDArray[np.int_]) -> Array:
    parts = [
        np.linspace(a, b, n, endpoint=False)
        for a, b, n in zip(breaks[:-1], breaks[1:], counts, strict=True)
    ]
    return np.concatenate([*parts, breaks[-1:]])


def distance_to_polyline(points: Array, polyline: Array, step: float) -> Array:
    """Distance of each point to a polyline, shape (k,)."""
    a, d = polyline[:-1], np.diff(polyline, axis=0)
    length = np.hypot(d[:, 0], d[:, 1])
    counts = np.clip(np.ceil(length / step), 1, 10_000).astype(int)
    owner = np.repeat(np.arange(len(a)), counts)
    within = np.concatenate([np.arange(n) / n for n in counts])
    _, nearest = cKDTree(a[owner] + within[:, None] * d[owner]).query(points, k=3)
    best = np.full(len(points), np.inf)
    for near in np.atleast_2d(nearest.T):
        for segment in (owner[np.minimum(near, len(owner) - 1)],):
            for at in (segment, np.maximum(segment - 1, 0), np.minimum(segment + 1, len(a) - 1)):
                along = ((points - a[at]) * d[at]).sum(axis=1) / np.maximum(length[at] ** 2, 1e-300)
                foot = a[at] + np.clip(along, 0, 1)[:, None] * d[at]
                best = np.minimum(best, np.hypot(*(points - foot).T))
    return best


def distance_to_curve(points: Array, curve: BSpline, step: float) -> Array:
    """Distance of each point to a curve: the nearest samples, then Newton's method beside them.

    Several, since of two branches that meet the one with the nearest sample may be farther.
    """
    parameters, samples = curve_samples(curve, step)
    _, near = cKDTree(samples).query(points, k=BRANCHES)
    return np.min([_beside(points, curve, parameters, at) for at in near.T], axis=0)


def _beside(points: Array, curve: BSpline, parameters: Array, at: NDArray[np.int_]) -> Array:
    """Distance to the curve between the neighbours of one sample for each point."""
    u = parameters[at]
    low = parameters[np.maximum(at - 1, 0)]
    high = parameters[np.minimum(at + 1, len(parameters) - 1)]
    best = np.hypot(*(curve(u) - points).T)
    for _ in range(5):
        off, velocity = curve(u) - points, curve(u, nu=1)
        speed_sq = (velocity**2).sum(axis=1)
        bend = np.maximum(speed_sq + (off * curve(u, nu=2)).sum(axis=1), 0.1 * speed_sq)
        u = np.clip(u - (off * velocity).sum(axis=1) / np.maximum(bend, 1e-300), low, high)
        best = np.minimum(best, np.hypot(*(curve(u) - points).T))
    return best


def two_sided(curve: BSpline, points: Array, *, closed: bool, step: float) -> TwoSided:
    """Distances between a curve and the data, sampled about ``step`` apart."""
    polyline = np.concatenate([points, points[:1]]) if closed else points
    _, samples = curve_samples(curve, step)
    reverse = distance_to_polyline(samples, polyline, step)
    return TwoSided(float(distance_to_curve(points, curve, step).max()), float(reverse.max()))
