"""Data beside a narrow clearance: points moved from its other side, so that curves stay apart.

A curve within w of points that were moved by no more than the rest of a tolerance keeps it to the
points as they were. Where two sides are nearer to each other than 2 w their points move apart until
they are not. Elsewhere they move towards the curve that they had, by their part of its distance: it
stays within w of them and need not become another.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.fitting.repair.assignment import shares_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.fitting.repair.assignment import DataRun
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour

# Two places of an outline lie across a clearance if the way along it is so many times their
# distance.
AROUND = 4.0
# So many pairs of a point and a segment are looked at in one go.
CHUNK = 20_000


class Sides(NamedTuple):
    """The segments of all contours: where they begin, their vectors, how far along, and whose.

    ``lengths`` (of whole contours) are infinite where these are open.
    """

    begins: FloatArray
    vectors: FloatArray
    along: FloatArray
    owners: IntArray
    lengths: FloatArray

    @classmethod
    def of(cls, contours: Sequence[Contour]) -> Sides:
        """The segments of these contours."""
        counts = [len(contour.polyline) - 1 for contour in contours]
        lengths = [contour.length if contour.closed else np.inf for contour in contours]
        return cls(
            np.concatenate([contour.polyline[:-1] for contour in contours]),
            np.concatenate([np.diff(contour.polyline, axis=0) for contour in contours]),
            np.concatenate([contour.arc_length[:-1] for contour in contours]),
            np.repeat(np.arange(len(contours)), counts),
            np.repeat(lengths, counts),
        )

    def beside(self, points: FloatArray, reach: float) -> Sides:
        """Those that come within reach of the box of some points."""
        ends = self.begins + self.vectors
        low, high = points.min(axis=0) - reach, points.max(axis=0) + reach
        near = (np.minimum(self.begins, ends) <= high).all(axis=1)
        near &= (np.maximum(self.begins, ends) >= low).all(axis=1)
        return Sides(*(column[near] for column in self))

    def across(self, data: DataRun, own: int, least: float) -> FloatArray:
        """Vectors to the points of contour ``own`` from what is nearest across a clearance.

        They are infinite where nothing is, at the least so far along the outline.
        """
        step = max(1, CHUNK // len(self.begins))
        parts = [data.part(k, k + step) for k in range(0, len(data.points), step)]
        return np.concatenate([self._across(part, own, least) for part in parts])

    def _across(self, data: DataRun, own: int, least: float) -> FloatArray:
        (px, py), (bx, by), (ux, uy) = data.points.T, self.begins.T, self.vectors.T
        x, y = px[:, None] - bx, py[:, None] - by
        shares = shares_of(x, y, ux, uy)
        x -= shares * ux
        y -= shares * uy
        distances = np.sqrt(x * x + y * y)
        mine = self.owners == own
        along = np.fmod(data.along, self.lengths[mine][0]) if mine.any() else data.along
        ways = np.abs(along[:, None] - (self.along + shares * np.hypot(ux, uy)))
        # Of two ways round a closed outline the shorter.
        ways = np.where(mine, np.minimum(ways, self.lengths - ways), np.inf)
        distances[ways <= np.maximum(AROUND * distances, least)] = np.inf
        nearest = (np.arange(len(x)), distances.argmin(axis=1))
        vectors = np.column_stack([x[nearest], y[nearest]])
        return np.where(np.isinf(distances[nearest])[:, None], np.inf, vectors)


def moved(
    points: FloatArray, feet: FloatArray, across: FloatArray, within: float, room: float
) -> FloatArray:
    """Points moved by no more than ``room``, for a curve within ``within`` of them.

    ``feet`` are the nearest points of the curve that they had, within the sum of both; ``across``
    the vectors from what lies across a clearance.
    """
    offsets = room / (room + within) * (feet - points)
    gaps = np.hypot(*across.T)
    near = (gaps > 0) & (gaps < 2 * within)
    away = across[near] / gaps[near, None]
    lacking = within - 0.5 * gaps[near] - (offsets[near] * away).sum(axis=1)
    offsets[near] += np.maximum(lacking, 0.0)[:, None] * away
    lengths = np.hypot(*offsets.T)
    far = lengths > room
    offsets[far] *= (room / lengths[far])[:, None]
    return points + offsets
