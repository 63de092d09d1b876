"""A pen: the half of the width that strokes have, and how evenly they have it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable

    from shapespline.tracing.strokes.graph import Branch

# This part of the length of all strokes has the radii that are nearest to each other: the rest may
# be junctions and bends, where discs are larger (TRC-26).
USUAL_PART = 0.4
# Radii that differ by more than this part are no pen's.
LARGEST_SPREAD = 0.3


class Pen(NamedTuple):
    """A round pen, in pixels.

    Attributes
    ----------
    radius : float
    spread : float
        Between the smallest and the largest of its usual radii.
    """

    radius: float
    spread: float

    @property
    def slack(self) -> float:
        """How much nearer to an outline than its radius its middle may be."""
        return max(0.35, 0.05 * self.radius, 3.0 * self.spread)

    @property
    def apart(self) -> float:
        """How far the middle told by one side of a stroke may be from that of the other."""
        return min(max(0.5, 0.05 * self.radius, 6.0 * self.spread), max(0.5, 0.35 * self.radius))


def usual_pen(branches: Iterable[Branch]) -> Pen | None:
    """The pen of most of the branches of a medial axis; None if there is none."""
    branches = list(branches)
    if not branches:
        return None
    steps = np.concatenate([np.hypot(*np.diff(b.points, axis=0).T) for b in branches])
    radii = np.concatenate([b.radii[:-1] for b in branches])
    order = np.argsort(radii)
    radii, along = radii[order], np.concatenate([[0.0], np.cumsum(steps[order])])
    last = np.searchsorted(along[1:], along[:-1] + USUAL_PART * along[-1] - 1e-9 * along[-1])
    first = np.flatnonzero(last < len(radii))
    widths = radii[last[first]] - radii[first]
    at = int(np.argmin(widths))
    low, high = int(first[at]), int(last[first[at]]) + 1
    weights = np.diff(along)[low:high]
    if not weights.sum() > 0.0:
        return None
    pen = Pen(float(np.average(radii[low:high], weights=weights)), float(widths[at]))
    return pen if pen.spread <= LARGEST_SPREAD * pen.radius else None
