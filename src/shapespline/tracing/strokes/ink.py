"""Ink as points along its outlines, and which parts of it hang together."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour, Shape

# Pixels between points on an outline.
OUTLINE_STEP = 0.5


class Ink(NamedTuple):
    """Outlines as rows of points at even steps, with the ink on their left.

    Attributes
    ----------
    outlines : list of ndarray, shape (n, 2)
    parts : list of int
        For each outline the part that it belongs to: holes go with what they are in.
    tree : cKDTree
        All points.
    part_of_point : ndarray of int
    """

    outlines: list[FloatArray]
    parts: list[int]
    tree: cKDTree
    part_of_point: IntArray

    @classmethod
    def of(cls, shape: Shape) -> Ink:
        """The ink within closed outlines and outside their holes."""
        from scipy.spatial import cKDTree

        outlines = [_points(contour, shape.is_hole(k)) for k, contour in enumerate(shape)]
        parts = [shape.parents[k] if shape.is_hole(k) else k for k in range(len(outlines))]
        lengths = [len(points) for points in outlines]
        return cls(outlines, parts, cKDTree(np.concatenate(outlines)), np.repeat(parts, lengths))

    def part_at(self, place: FloatArray) -> int:
        """The part whose outline is nearest."""
        return int(self.part_of_point[self.tree.query(place)[1]])

    def outlines_of(self, part: int) -> list[FloatArray]:
        """The outline of a part and those of its holes."""
        return [
            points for points, own in zip(self.outlines, self.parts, strict=True) if own == part
        ]


def _points(contour: Contour, is_hole: bool) -> FloatArray:
    points = contour.resampled(max(8, round(contour.length / OUTLINE_STEP))).points
    x, y = points.T
    is_left = float(x @ np.roll(y, -1) - np.roll(x, -1) @ y) > 0
    return points if is_left != is_hole else points[::-1]
