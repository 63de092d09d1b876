"""Data beside a narrow clearance: points moved from its other side, so that curves stay apart.

A curve within w of points that were moved by no more than the rest of a tolerance keeps it to the
points as they were. Where two sides are nearer to each other than 2 w their points move apart until
they are not. Elsewhere they move towards the curve that they had, by their part of its distance: it
stays within w of them and need not become another.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.fitting.repair.assignment import DataRun
    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# Two places of an outline lie across a clearance if the way along it is so many times their
# distance.
AROUND = 4.0


class Sides:
    """The sides of all contours, in a tree of boxes."""

    def __init__(self, contours: Sequence[Contour]) -> None:
        polylines = [contour.polyline for contour in contours]
        self._sides = _kernels.Sides(
            np.concatenate(polylines),
            np.concatenate([contour.arc_length for contour in contours]),
            np.cumsum([0, *map(len, polylines)]),
            np.array([contour.length if contour.closed else np.inf for contour in contours]),
        )

    def across(self, data: DataRun, own: int, *, reach: float, least: float) -> FloatArray:
        """Vectors to the points of contour ``own`` from what is nearest across a clearance.

        They are infinite where nothing is within reach, at the least so far along the outline.
        """
        vectors = np.empty_like(data.points)
        self._sides.across(data.points, data.along, own, reach, AROUND, least, vectors)
        return vectors


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
