"""The order and the unit in which a contour is fitted, whatever those it was given in."""

from __future__ import annotations

from math import frexp, ldexp
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.contour import Contour
from shapespline.curve import BSplineCurve
from shapespline.joining import backwards

if TYPE_CHECKING:
    from shapespline.drawing import Piece
    from shapespline.typing import FloatArray, IntArray


class WorkingFrame(NamedTuple):
    """A contour in the order and the unit in which it is fitted.

    ``contour`` has its middle at the origin, a box diagonal between 64 and 128 (the scale is a
    power of two, exact), and an order that does not depend on where the data begin and which way
    they run. ``order`` (n,) are the indices of its points in the data. ``reversed`` tells that the
    data run the other way; what is restored runs the way they do.

    Examples
    --------
    >>> square = Contour([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)
    >>> turned = Contour([(1, 1), (1, 0), (0, 0), (0, 1)], closed=True)
    >>> a, b = WorkingFrame.of(square), WorkingFrame.of(turned)
    >>> bool((a.contour.points == b.contour.points).all())
    True
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
        accuracy = None if contour.accuracy is None else contour.accuracy * scale
        work = Contour(moved, contour.closed, accuracy=accuracy)
        return cls(work, order, middle, scale, backwards)

    @property
    def place(self) -> IntArray:
        """For every point of the data its index in ``contour``, shape (n,)."""
        place = np.empty(len(self.order), dtype=np.int64)
        place[self.order] = np.arange(len(self.order))
        return place

    def restored(self, pieces: tuple[Piece, ...]) -> tuple[Piece, ...]:
        """Pieces in the unit and direction of the data."""
        pieces = tuple(
            piece._replace(control_points=piece.control_points / self.scale + self.middle)
            for piece in pieces
        )
        return backwards(pieces) if self.reversed else pieces

    def restored_curve(self, curve: BSplineCurve) -> BSplineCurve:
        """A curve over [0, 1] in the unit and direction of the data."""
        control_points = curve.control_points / self.scale + self.middle
        moved = BSplineCurve(curve.knots, control_points, curve.degree, curve.periodic)
        return reversed_curve(moved) if self.reversed else moved


def reversed_curve(curve: BSplineCurve) -> BSplineCurve:
    """A curve over [0, 1] that runs the other way."""
    control_points = curve.control_points[::-1]
    if curve.periodic:  # the points beyond the seam have changed sides
        control_points = np.roll(control_points, curve.degree, axis=0)
    knots = np.ascontiguousarray(1.0 - curve.knots[::-1])
    return BSplineCurve(knots, np.ascontiguousarray(control_points), curve.degree, curve.periodic)


def _canonical_order(points: FloatArray, *, closed: bool) -> tuple[IntArray, bool]:
    """Indices in an order that depends on the geometry only, and whether it runs backwards.

    Of all ways to read the points the one whose coordinates come first in the dictionary: closed
    outlines start at a point with the least x, then y, open ones at an end.
    """
    n = len(points)
    index = np.arange(n)
    starts = [0]
    if closed:
        least = np.lexsort((points[:, 1], points[:, 0]))[0]
        starts = np.flatnonzero((points == points[least]).all(axis=1)).tolist()
    readings = [((start + index) % n, False) for start in starts]
    readings += [((start - index) % n, True) for start in (starts if closed else [n - 1])]
    best = readings[0]
    for reading in readings[1:]:
        differ = np.flatnonzero(points[reading[0]] != points[best[0]])
        if len(differ) and points[reading[0]].flat[differ[0]] < points[best[0]].flat[differ[0]]:
            best = reading
    return best
