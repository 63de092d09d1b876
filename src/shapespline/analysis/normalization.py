"""The order, unit and pose in which a contour is fitted, whatever those it was given in.

The order is a canonical form (the greatest rotation and direction of the distances from the mean),
the pose that of the farthest point. Thinning is cone intersection (Williams 1978), one pass over
the points.
"""

from __future__ import annotations

from math import floor, frexp, ldexp
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.analysis.run_averages import averaged
from shapespline.geometry import backwards, nearest_points, reversed_curve
from shapespline.values import Contour, with_points

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import BSplineCurve, Piece

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
# The farthest point of a posed contour lies so far from the origin. Its points lie on a grid of
# this part of the tolerance, but no finer than the second of the size: where a contour lies and
# how large it is changes rounding alone, which the grid hides (ANA-16).
RADIUS = 32.0
GRID, FINEST_GRID, NO_GRID = (2.0**-k for k in (16, 40, 60))
# Lengths beside it keep so many steps of their first binary digit.
LENGTH_STEPS = 2.0**32


class NormalizedContour(NamedTuple):
    """A contour in the order, unit and pose in which it is fitted.

    `of` keeps the axes: ``contour`` has the middle of its box at the origin and a box diagonal
    between 64 and 128, its unit is a power of two, exact. `posed` does not: the mean is the origin,
    the farthest point on the first axis, and a turned, mirrored or scaled contour is the same. The
    order does not depend on where the data begin and which way they run.

    A point p of the data is ``scale * turn @ (p - middle)``. ``order`` (n,) are the indices of the
    points in ``data``, None where the points are none of them. ``reversed`` tells that the data run
    the other way; what is restored runs the way they do. One that was `thinned` holds some of the
    points, or averages, and ``error_used`` is how far its polyline lies from that of all: so much
    of the tolerance is used.

    Examples
    --------
    >>> square = Contour([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)
    >>> turned = Contour([(1, 1), (1, 0), (0, 0), (0, 1)], closed=True)
    >>> a, b = NormalizedContour.of(square), NormalizedContour.of(turned)
    >>> bool((a.contour.points == b.contour.points).all())
    True
    >>> kite = Contour([(0, -3), (2, 0), (0, 1), (-2, 0)], closed=True)
    >>> far = Contour(3.7 * kite.points @ [[0.6, 0.8], [-0.8, 0.6]] + 5, closed=True)
    >>> a, b = NormalizedContour.posed(kite, 0.1), NormalizedContour.posed(far, 0.37)
    >>> bool((a.contour.points == b.contour.points).all())
    True
    """

    contour: Contour
    order: IntArray
    middle: FloatArray
    scale: float
    turn: FloatArray
    reversed: bool
    data: Contour | None
    error_used: float = 0.0

    @classmethod
    def of(cls, contour: Contour) -> NormalizedContour:
        """A contour normalized, its axes as they are."""
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
        work = Contour.trusted(moved, contour.closed, _scaled(contour.accuracy, scale))
        return cls(work, order, middle, scale, np.eye(2), step < 0, contour)

    @classmethod
    def posed(cls, contour: Contour, tolerance: float) -> NormalizedContour:
        """A contour in canonical pose, for a search within a tolerance (data units)."""
        points, closed = contour.points, contour.closed
        moved = np.empty_like(points)
        for fine, finest in ((GRID * tolerance, FINEST_GRID), (0.0, NO_GRID)):
            found = _kernels.PosedContour(points, closed, RADIUS, fine, finest * RADIUS, moved)
            if found.apart:
                break
        else:
            return cls.of(contour)
        order = (found.start + found.step * np.arange(len(points))) % len(points)
        (c, s), side = found.axis, found.side
        turn = np.array([[c, s], [-side * s, side * c]])
        work = Contour.trusted(moved, closed, _scaled(contour.accuracy, found.scale))
        return cls(work, order, np.array(found.middle), found.scale, turn, found.step < 0, contour)

    @classmethod
    def of_working(cls, contour: Contour) -> NormalizedContour:
        """A contour that is in canonical order and unit already."""
        return cls(contour, np.arange(len(contour)), np.zeros(2), 1.0, np.eye(2), False, None)

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
                    data=None,
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
        """Another contour in this unit and pose, in its own order."""
        moved = _turned(contour.points - self.middle, self.turn) * self.scale
        return Contour.trusted(moved, contour.closed, _scaled(contour.accuracy, self.scale))

    def length(self, given: float) -> float:
        """A length of the data in this unit, to so many digits that rounding does not change it."""
        mantissa, exponent = frexp(given * self.scale)
        return ldexp(floor(mantissa * LENGTH_STEPS), exponent) / LENGTH_STEPS

    def direction(self, given: FloatArray) -> FloatArray:
        """A direction (2,) of the data in this pose."""
        return _turned(given[None], self.turn)[0]

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
        """Pieces where the data are and the way they run."""
        placed = self.placed(pieces)
        return backwards(placed) if self.reversed else placed

    def placed(self, pieces: tuple[Piece, ...]) -> tuple[Piece, ...]:
        """Pieces where the data are, in canonical order."""
        points = self.restored_points(np.concatenate([p.control_points for p in pieces]))
        placed = with_points(pieces, points)
        if all(piece.arc is None for piece in pieces):
            return placed
        linear = self.turn.T / self.scale
        return tuple(
            piece._replace(arc=piece.arc and piece.arc.moved(linear, self.middle))
            for piece in placed
        )

    def restored_curve(self, curve: BSplineCurve) -> BSplineCurve:
        """A curve over [0, 1] where the data are and the way they run."""
        control_points = self.restored_points(curve.control_points)
        moved = type(curve).trusted(curve.knots, control_points, curve.degree, curve.periodic)
        return reversed_curve(moved) if self.reversed else moved

    def restored_points(self, points: FloatArray) -> FloatArray:
        """Points in data units; those that are points of the contour are the data's to the bit."""
        restored = _turned(points, self.turn.T) / self.scale + self.middle
        if self.data is not None:
            found = nearest_points(self.contour.points, points)
            same = found.distances == 0.0
            restored[same] = self.data.points[self.order[found.indices[same]]]
        return restored


def _turned(points: FloatArray, turn: FloatArray) -> FloatArray:
    """Rows turned one by one: equal ones stay equal, which products of matrices do not promise."""
    (a, b), (c, d) = turn.tolist()
    x, y = points[:, 0], points[:, 1]
    turned = np.empty(points.shape)
    turned[:, 0], turned[:, 1] = a * x + b * y, c * x + d * y
    return turned


def _scaled(length: float | None, scale: float) -> float | None:
    return None if length is None else length * scale


def canonical_reading(
    points: FloatArray, *, closed: bool, weights: FloatArray | None = None
) -> tuple[int, int]:
    """First index and step, 1 or -1, of an order that depends on the geometry only.

    Closed outlines are read from a point that is farthest from their mean, open ones from the end
    that is farther; of the ways that are left the one is taken whose distances from the mean come
    last in the dictionary, or of equals whose coordinates come first, or whose weights do. So a
    turned or mirrored outline is read like the outline.

    References
    ----------
    Booth 1980 (least rotation).
    """
    if weights is not None:
        weights = np.ascontiguousarray(weights)
    return _kernels.canonical_reading(np.ascontiguousarray(points), closed, weights)
