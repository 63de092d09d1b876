"""The order and the unit in which an outline is fitted, whatever those of the data."""

from __future__ import annotations

from math import frexp, ldexp
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.contour import Contour
from shapespline.joining import backwards

if TYPE_CHECKING:
    from shapespline.drawing import Piece
    from shapespline.typing import FloatArray, IntArray


class WorkingFrame(NamedTuple):
    """A contour in the order and the unit in which it is fitted.

    ``contour`` has its middle at the origin, a box diagonal between 64 and 128 (the scale is a
    power of two, exact), and an order that does not depend on where the data begin and which way
    they run. ``order`` (n,) are the indices of its points in the data.
    """

    contour: Contour
    order: IntArray
    middle: FloatArray
    scale: float
    reversed: bool

    @classmethod
    def of(cls, contour: Contour) -> WorkingFrame:
        """The frame of a contour."""
        points = contour.points
        order, backwards = _canonical_order(points, closed=contour.closed)
        scale = ldexp(1.0, 7 - frexp(contour.box_diagonal)[1])
        middle = points.min(axis=0) + 0.5 * np.ptp(points, axis=0)
        moved = (points[order] - middle) * scale
        if (moved == np.roll(moved, -1, axis=0)).all(axis=1).any():
            # Neighbours so close that they fall together far from the origin: leave the origin.
            middle = np.zeros(2)
            moved = points[order] * scale
        return cls(Contour(moved, contour.closed), order, middle, scale, backwards)

    def restored(self, pieces: tuple[Piece, ...]) -> tuple[Piece, ...]:
        """Pieces in the unit of the data, running the way the data run."""
        pieces = tuple(
            piece._replace(control_points=piece.control_points / self.scale + self.middle)
            for piece in pieces
        )
        return backwards(pieces) if self.reversed else pieces


def _canonical_order(points: FloatArray, *, closed: bool) -> tuple[IntArray, bool]:
    """Indices in an order that depends on the geometry only, and whether it runs backwards.

    Closed outlines start at the point with the least x, then y, and go on to the lesser of its
    neighbours; open ones start at the lesser end.
    """
    n = len(points)
    index = np.arange(n)
    if not closed:
        ends = [points[0].tolist(), points[-1].tolist()]
        if ends[0] == ends[1]:
            ends = [points[1].tolist(), points[-2].tolist()]
        backwards = ends[1] < ends[0]
        return (index[::-1] if backwards else index), backwards
    least = np.lexsort((points[:, 1], points[:, 0]))[0]
    ties = np.flatnonzero((points == points[least]).all(axis=1))

    def neighbours(i: int) -> list[list[float]]:
        return [points[(i + 1) % n].tolist(), points[i - 1].tolist()]

    start = min((int(i) for i in ties), key=lambda i: sorted(neighbours(i)))
    after, before = neighbours(start)
    backwards = before < after
    return (start + (-index if backwards else index)) % n, backwards
