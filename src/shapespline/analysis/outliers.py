"""Outliers of a contour: single points, or a few in a row, that jump off the path and back.

A run is compared with the segment between its neighbours, the worst first (sequential deletion), by
order statistics of the steps near by.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis.noise import noise_level

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour

# Outliers in a row at most: more may be a feature (ANA-06).
LONGEST_RUN = 3
# Steps on each side that say how far apart neighbours lie, by their upper quartile.
NEIGHBOURS = 6
# A run is off the path by this many such steps and by this many times the noise. A feature that is
# sampled as densely as what is around it stays below (LONGEST_RUN + 1) / 2 steps (ANA-06).
STEPS, SIGMAS = 2.5, 6.0


def find_outliers(contour: Contour) -> IntArray:
    """Indices of the points that jump off the path and back.

    A run of up to three points counts if each lies farther from the segment between the points
    around the run than the steps and the noise nearby explain. The worst go first, then the rest
    is looked at again, so that neighbouring outliers do not hide each other.

    Parameters
    ----------
    contour : Contour

    Returns
    -------
    ndarray of int
        Increasing indices of ``contour.points``.

    Notes
    -----
    A spike or hairpin with points along its flanks is kept. The tip of one that is drawn by three
    points or fewer, far longer than the steps around it, cannot be told from an outlier. The ends
    of an open contour are never outliers, nor are points among fewer than 15.

    Examples
    --------
    >>> from shapespline import Contour
    >>> t = np.linspace(0, 2 * np.pi, 100, endpoint=False)
    >>> circle = np.column_stack([np.cos(t), np.sin(t)])
    >>> circle[[20, 60, 61]] *= 1.5
    >>> find_outliers(Contour(circle, closed=True)).tolist()
    [20, 60, 61]
    """
    kept_indices = np.arange(len(contour))
    least = SIGMAS * noise_level(contour)
    while len(kept_indices) > 2 * NEIGHBOURS + LONGEST_RUN - 1:
        runs = _worst_runs(contour.points[kept_indices], contour.closed, least)
        if not len(runs):
            break
        kept_indices = np.delete(kept_indices, runs)
    return np.setdiff1d(np.arange(len(contour)), kept_indices)


def _worst_runs(points: FloatArray, closed: bool, least: float) -> IntArray:
    """Points of the runs that are off by more than any other run near them."""
    n = len(points)
    scores = np.stack([_scores(points, closed, length, least) for length in _lengths()])
    # Of equals the shorter run: what returns to the path is no part of it.
    best = scores.max(axis=0)
    length = 1 + scores.argmax(axis=0)
    around = np.arange(-NEIGHBOURS, NEIGHBOURS + 1)
    nearby = best[(np.arange(n)[:, None] + around) % n].max(axis=1)
    starts = np.flatnonzero((best > 1.0) & (best >= nearby))
    runs = [np.arange(start, start + length[start]) % n for start in starts]
    return np.unique(np.concatenate(runs)) if runs else np.empty(0, dtype=np.int64)


def _lengths() -> range:
    return range(1, LONGEST_RUN + 1)


def _scores(points: FloatArray, closed: bool, length: int, least: float) -> FloatArray:
    """How far the run from each point is off, in parts of what makes an outlier, shape (n,)."""
    n = len(points)
    index = np.arange(n)
    before, after = points[index - 1], points[(index + length) % n]
    chord = after - before
    chord_sq = np.maximum((chord**2).sum(axis=1), np.finfo(float).tiny)
    distance = np.full(n, np.inf)
    for k in range(length):
        at = points[(index + k) % n] - before
        share = np.clip((at * chord).sum(axis=1) / chord_sq, 0.0, 1.0)
        distance = np.minimum(distance, np.hypot(*(at - share[:, None] * chord).T))
    steps = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    offsets = np.concatenate(
        [np.arange(-1 - NEIGHBOURS, -1), np.arange(length, length + NEIGHBOURS)]
    )
    places = index[:, None] + offsets
    if closed:
        nearby = np.quantile(steps[places % n], 0.75, axis=1)
    else:
        inside = (places >= 0) & (places < n - 1)
        around = np.where(inside, steps[places % n], np.nan)
        nearby = np.nanquantile(around, 0.75, axis=1)
    # Where points are missing beside a run, the gap says how far apart they lie.
    apart = np.maximum(nearby, np.sqrt(chord_sq) / (length + 1))
    score = distance / np.maximum(np.maximum(STEPS * apart, least), np.finfo(float).tiny)
    if not closed:
        score[(index == 0) | (index + length >= n)] = 0.0
    return score
