"""The order and the unit in which a contour is fitted, whatever those it was given in.

The order is a canonical form (the least rotation and direction in the dictionary), the unit a power
of two. Thinning is cone intersection (Williams 1978), one pass over the points.
"""

from __future__ import annotations

from math import frexp, ldexp
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.analysis.run_averages import averaged
from shapespline.geometry import backwards
from shapespline.values import Contour

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import BSplineCurve, Piece
from shapespline.geometry import reversed_curve

# Thinning leaves out points within this part of the tolerance from the polyline without them, but
# makes no chord longer than this part of the extent. It leaves out none of so few points, and none
# if more than this part of them would stay (ANA-08).
THINNING = 0.01
LONGEST_CHORD = 0.005
FEWEST_POINTS = 500
WORTH_THINNING = 0.7
# More points that do not thin scatter, or show more than anybody can see. Averages stand for them
# if their error is at most this part of the tolerance (ANA-12).
MANY_POINTS = 20_000
MOST_SCATTER = 0.9
# A coast does not thin by little, either, and averages of it lie far away. Parts of the tolerance
# to thin it by, where so small a part of its points stays: of noise most stay (ANA-14).
COARSER_THINNINGS = (0.03, 0.1)
FEW_LEFT = 0.25
# The canonical order compares all readings of an outline by so many distances at once, then two by
# two.
HEAD = 16


class NormalizedContour(NamedTuple):
    """A contour in the order and the unit in which it is fitted.

    ``contour`` has its middle at the origin, a box diagonal between 64 and 128 (the scale is a
    power of two, exact), and an order that does not depend on where the data begin and which way
    they run. ``order`` (n,) are the indices of its points in the data. ``reversed`` tells that the
    data run the other way; what is restored runs the way they do. One that was `thinned` holds some
    of the points, or averages, and ``error_used`` is how far its polyline lies from that of all: so
    much of the tolerance is used.

    Examples
    --------
    >>> square = Contour([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)
    >>> turned = Contour([(1, 1), (1, 0), (0, 0), (0, 1)], closed=True)
    >>> a, b = NormalizedContour.of(square), NormalizedContour.of(turned)
    >>> bool((a.contour.points == b.contour.points).all())
    True
    """

    contour: Contour
    order: IntArray
    middle: FloatArray
    scale: float
    reversed: bool
    error_used: float = 0.0

    @classmethod
    def of(cls, contour: Contour) -> NormalizedContour:
        """A contour normalized."""
        points = contour.points
        start, step = canonical_reading(points, closed=contour.closed)
        order = (start + step * np.arange(len(points))) % len(points)
        scale = ldexp(1.0, 7 - frexp(contour.box_diagonal)[1])
        middle = np.array([x.min() + 0.5 * np.ptp(x) for x in points.T])
        moved = (points[order] - middle) * scale
        same = moved[1:] == moved[:-1]
        if (same[:, 0] & same[:, 1]).any() or (moved[0] == moved[-1]).all():
            # Neighbours so close that they fall together far from the origin: leave the origin.
            middle = np.zeros(2)
            moved = points[order] * scale
        accuracy = None if contour.accuracy is None else contour.accuracy * scale
        work = Contour.trusted(moved, contour.closed, accuracy)
        return cls(work, order, middle, scale, step < 0)

    @classmethod
    def of_working(cls, contour: Contour) -> NormalizedContour:
        """A contour that is in canonical order and unit already."""
        return cls(contour, np.arange(len(contour)), np.zeros(2), 1.0, False)

    def thinned(self, tolerance: float, marked: IntArray) -> NormalizedContour:
        """The same without the points that a search within a tolerance does not need.

        Their distance from what is left is a small part of the tolerance, both ways, or the part
        that many points scatter by; then averages stand for them. If few would go, all stay.
        ``marked`` are indices into ``contour`` of points that stay.
        """
        work, error_used = self.contour, THINNING * tolerance
        if len(work) <= FEWEST_POINTS:
            return self
        marks = np.zeros(len(work.polyline), dtype=np.int64)
        marks[marked] = 1
        kept_indices = self._kept_indices(error_used, marks)
        if len(kept_indices) > MANY_POINTS:
            found = averaged(work.points, work.closed, marked)
            for part in COARSER_THINNINGS:
                coarser = self._kept_indices(part * tolerance, marks)
                if len(coarser) <= FEW_LEFT * len(work) and part * tolerance < found.error_bound:
                    return self._without_others(coarser, part * tolerance)
            if found.error_bound <= MOST_SCATTER * tolerance:
                return self._replace(
                    contour=Contour.trusted(found.nodes, work.closed, work.accuracy),
                    order=self.order[found.indices],
                    error_used=found.error_bound,
                )
        if len(kept_indices) > WORTH_THINNING * len(work):
            return self
        return self._without_others(kept_indices, error_used)

    def _kept_indices(self, distance: float, marks: IntArray) -> IntArray:
        """Indices of points that stay when those within a distance of chords go."""
        found = _kernels.thinned(
            self.contour.polyline, distance, LONGEST_CHORD * self.extent, marks
        )
        kept_indices = np.array(found, dtype=np.int64)
        return kept_indices[:-1] if self.contour.closed else kept_indices

    def _without_others(self, kept_indices: IntArray, error_used: float) -> NormalizedContour:
        """The contour with some of its points only."""
        work = self.contour
        return self._replace(
            contour=Contour.trusted(work.points[kept_indices], work.closed, work.accuracy),
            order=self.order[kept_indices],
            error_used=error_used,
        )

    def taken_over(self, contour: Contour) -> Contour:
        """Another contour in this unit, in its own order."""
        moved = (contour.points - self.middle) * self.scale
        accuracy = None if contour.accuracy is None else contour.accuracy * self.scale
        return Contour.trusted(moved, contour.closed, accuracy)

    @property
    def extent(self) -> float:
        """Twice the largest distance from the points' mean: a size that no turn changes."""
        away = self.contour.points - self.contour.points.mean(axis=0)
        return 2.0 * float(np.sqrt((away**2).sum(axis=1).max()))

    @property
    def new_index(self) -> IntArray:
        """For every point of the data its index in ``contour``, shape (n,), while all are there."""
        index = np.empty(len(self.order), dtype=np.int64)
        index[self.order] = np.arange(len(self.order))
        return index

    def restored(self, pieces: tuple[Piece, ...]) -> tuple[Piece, ...]:
        """Pieces in the unit and direction of the data."""
        linear = np.eye(2) / self.scale
        pieces = tuple(
            piece._replace(
                control_points=piece.control_points / self.scale + self.middle,
                arc=None if piece.arc is None else piece.arc.moved(linear, self.middle),
            )
            for piece in pieces
        )
        return backwards(pieces) if self.reversed else pieces

    def restored_curve(self, curve: BSplineCurve) -> BSplineCurve:
        """A curve over [0, 1] in the unit and direction of the data."""
        control_points = curve.control_points / self.scale + self.middle
        moved = type(curve).trusted(curve.knots, control_points, curve.degree, curve.periodic)
        return reversed_curve(moved) if self.reversed else moved


def canonical_reading(
    points: FloatArray, *, closed: bool, weights: FloatArray | None = None
) -> tuple[int, int]:
    """First index and step, 1 or -1, of an order that depends on the geometry only.

    Closed outlines are read from a point that is farthest from their mean, open ones from the end
    that is farther; of the ways that are left the one is taken whose distances from the mean come
    first in the dictionary, or of equals whose coordinates do, or whose weights do. So a turned or
    mirrored outline is read like the outline, but for rounding.
    """
    away = np.empty(len(points))
    _kernels.centroid_distances_sq(points, away)
    farthest = away.max() if closed else max(away[0], away[-1])
    starts = np.flatnonzero(away == farthest).tolist()
    last = len(points) - 1
    readings = [(start, 1) for start in starts if closed or start == 0]
    readings += [(start, -1) for start in starts if closed or start == last]
    readings = _first_in_head(away, np.array(readings))
    best = readings[0]
    keys = (away[:, None], points) if weights is None else (away[:, None], points, weights[:, None])
    for reading in readings[1:]:
        if _comes_first(keys, reading, best):
            best = reading
    return best


def _first_in_head(away: FloatArray, readings: IntArray) -> list[tuple[int, int]]:
    """The readings that are first by their first few distances: of a circle many start alike."""
    for k in range(HEAD):
        if len(readings) == 1:
            break
        at = (readings[:, 0] + k * readings[:, 1]) % len(away)
        readings = readings[away[at] == away[at].min()]
    return [(int(start), int(step)) for start, step in readings]


def _comes_first(keys: Sequence[FloatArray], a: tuple[int, int], b: tuple[int, int]) -> bool:
    """Whether one way to read rows, from a start by steps, stands before another."""
    for rows in keys:
        n, begin, end = len(rows), 0, 16
        while begin < n:
            index = np.arange(begin, min(end, n))
            mine, yours = (rows[(start + step * index) % n].ravel() for start, step in (a, b))
            differ = np.flatnonzero(mine != yours)
            if len(differ):
                return bool(mine[differ[0]] < yours[differ[0]])
            begin, end = end, 2 * end
    return False
