"""Crossings: where the curves of a drawing cross themselves or each other, as far as is drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry import crossing_pairs, self_crossings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray

# Segments that are asked together whether they cross others.
CHUNK = 24
# Parts of the size of all that are no step: samples on either side of a knot.
NO_STEP = 1e-7
# So many are marked at most.
MOST = 500


def crossings(lines: Sequence[FloatArray]) -> FloatArray:
    """Outline, x and y of each place where polylines cross, shape (k, 3); of two the first.

    Examples
    --------
    >>> line = np.array([(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 1.0)])
    >>> crossings([line]).round(3).tolist()
    [[0.0, 0.667, 0.667]]
    """
    every = np.concatenate(lines)
    least = NO_STEP * float(np.hypot(*np.ptp(every, axis=0)))
    chunks, places = [], []
    for owner, line in enumerate(lines):
        apart = np.hypot(*np.diff(line, axis=0).T) > least
        points = line[np.append(True, apart)]
        for first in range(0, len(points) - 1, CHUNK):
            chunks.append(points[first : first + CHUNK + 1])
            places.append((owner, first))
    pairs = crossing_pairs(chunks)
    pairs |= {(k, k) for k, chunk in enumerate(chunks) if self_crossings(chunk)}
    found = []
    for i, j in sorted(pairs)[:MOST]:
        (owner, first), (other, begin) = places[i], places[j]
        place, (s, t) = _meeting(chunks[i], chunks[j])
        # Segments that follow each other meet without crossing; a pair within a chunk counts once.
        beyond = np.full(len(s), True) if owner != other else t + begin > s + first + 1
        found += [(owner, x, y) for x, y in place[beyond]]
    return np.array(found[:MOST]).reshape(-1, 3)


def _meeting(one: FloatArray, other: FloatArray) -> tuple[FloatArray, tuple[np.ndarray, ...]]:
    """Where segments of two polylines meet, and which segments do."""
    p, u = one[:-1, None], np.diff(one, axis=0)[:, None]
    q, v = other[None, :-1], np.diff(other, axis=0)[None]
    turn = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    gap = q - p
    with np.errstate(divide="ignore", invalid="ignore"):
        along = (gap[..., 0] * v[..., 1] - gap[..., 1] * v[..., 0]) / turn
        across = (gap[..., 0] * u[..., 1] - gap[..., 1] * u[..., 0]) / turn
    met = np.nonzero((along >= 0) & (along < 1) & (across >= 0) & (across < 1))
    return (p + along[..., None] * u)[met], met
