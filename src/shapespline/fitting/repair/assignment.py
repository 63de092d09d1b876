"""Pieces of a curve and the points that each stands for, in the order of the data."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.geometry import chords, nearest
from shapespline.values import BSplineCurve, Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray
    from shapespline.values import Contour, Fit

# Repairs look at curves as polylines within this part of their tolerance (FIT-17).
SAMPLING_PART = 0.002
# A node is first looked for among points whose arc length differs from its own by at most this part
# of the piece before it and so many tolerances (FIT-13).
ALONG, TOLERANCES = 0.3, 4.0


class DataRun(NamedTuple):
    """Points in their order, and how far along their contour each is, past its end and on."""

    points: FloatArray
    along: FloatArray

    def part(self, begin: int, end: int) -> DataRun:
        """The points from one up to another."""
        return DataRun(self.points[begin:end], self.along[begin:end])

    def turned(self, first: int, length: float) -> DataRun:
        """The run of a closed contour of this length from another first point on."""
        along = np.concatenate([self.along[first:], self.along[:first] + length])
        return DataRun(np.roll(self.points, -first, axis=0), along)


class AssignedPiece(NamedTuple):
    """A piece, it as a polyline, and the points ``begin`` up to ``end`` that it stands for."""

    piece: Piece
    line: FloatArray
    begin: int
    end: int

    def shifted(self, by: int) -> AssignedPiece:
        """The part where its points come later."""
        return self._replace(begin=self.begin + by, end=self.end + by)


class PieceAssignment(NamedTuple):
    """The parts of a fit, end to end along its data, and which fit it is."""

    owner: int
    fit: Fit
    data: DataRun
    parts: tuple[AssignedPiece, ...]

    @classmethod
    def of(cls, owner: int, fit: Fit) -> PieceAssignment:
        """The row of a fit; of a closed one from its longest piece on."""
        pieces, contour = pieces_of(fit), fit.contour
        data = DataRun(contour.points, contour.arc_length[: len(contour)])
        if contour.closed:
            lengths = [_length(_chords(piece, fit.tolerance)) for piece in pieces]
            longest = int(np.argmax(lengths))
            pieces = pieces[longest:] + pieces[:longest]
            share = lengths[longest] / sum(lengths)
            begin = _begin(contour, curve_of(pieces[0]), share, fit.tolerance)
            data = data.turned(begin, contour.length)
        return cls(owner, fit, data, located(data, pieces, fit.tolerance))

    @property
    def line(self) -> FloatArray:
        """All pieces as one polyline."""
        return np.concatenate([*(part.line[:-1] for part in self.parts), self.parts[-1].line[-1:]])

    def turned(self, first: int) -> PieceAssignment:
        """The row of a closed fit from another part on."""
        begin, count = self.parts[first].begin, len(self.data.points)
        data = self.data.turned(begin, self.fit.contour.length)
        ahead = [part.shifted(-begin) for part in self.parts[first:]]
        rest = [part.shifted(count - begin) for part in self.parts[:first]]
        return self._replace(data=data, parts=(*ahead, *rest))


def curve_of(piece: Piece) -> BSplineCurve:
    """A piece as a curve."""
    return BSplineCurve(piece.knots, piece.control_points, piece.degree)


def pieces_of(fit: Fit) -> tuple[Piece, ...]:
    """The pieces of a fit; of a closed one that has none the Beziers of its spline."""
    if fit.sections:
        return fit.sections
    spline = fit.spline
    if not fit.contour.closed:
        kind = "bezier" if len(spline.control_points) == fit.degree + 1 else "spline"
        return (Piece(kind, fit.degree, spline.knots, spline.control_points),)
    knots = np.repeat([0.0, 1.0], fit.degree + 1)
    beziers = spline.beziers().points
    return tuple(Piece("bezier", fit.degree, knots, points.copy()) for points in beziers)


def shares_of(x: FloatArray, y: FloatArray, u: FloatArray, v: FloatArray) -> FloatArray:
    """Where on segments (u, v) the points nearest to others are, in parts of the segments.

    The others are (x, y) from where the segments begin. Of a segment without length, such as that
    from the last point to the first of open data whose ends coincide, the part is 0.
    """
    lengths_sq = u * u + v * v
    along = x * u + y * v
    return np.clip(
        np.divide(along, lengths_sq, out=np.zeros_like(along), where=lengths_sq > 0), 0.0, 1.0
    )


def located(
    data: DataRun, pieces: Sequence[Piece], tolerance: float, first: int = 0
) -> tuple[AssignedPiece, ...]:
    """Pieces with the points between their nodes, of data that begin with point ``first``.

    Nodes are looked for along the arc lengths of both.
    """
    curves = [curve_of(piece) for piece in pieces]
    lines = [_chords(piece, tolerance) for piece in pieces]
    lengths = np.array([_length(line) for line in lines])
    count = len(data.along)
    if count:
        lengths *= (data.along[-1] - data.along[0]) / lengths.sum()
    cuts = [0]
    for (before, after), length in zip(pairwise(curves), lengths[:-1], strict=True):
        low, high = _window(data, cuts[-1], length, after.control_points[0], tolerance)
        cuts.append(low + _cut(before, after, data.points[low:high], tolerance))
    cuts.append(count)
    return tuple(
        AssignedPiece(piece, line, first + i, first + k)
        for piece, line, (i, k) in zip(pieces, lines, pairwise(cuts), strict=True)
    )


def line_of(curve: BSplineCurve, tolerance: float, corners: FloatArray) -> FloatArray:
    """A curve as a polyline, finer and finer towards corners: what meets there may cross beside."""
    points, parameters = chords(curve, SAMPLING_PART * tolerance)
    if curve.degree == 1 or not len(corners):
        return points
    most = len(points) + len(corners) * _kernels.MOST_BESIDE_CORNER
    line = np.empty((most, 2))
    count = _kernels.line_to_corners(
        curve.knots,
        curve.degree,
        curve.periodic,
        curve.coefficients,
        points,
        parameters,
        corners,
        line,
    )
    return line[:count]


def _chords(piece: Piece, tolerance: float) -> FloatArray:
    """A piece as a polyline."""
    return line_of(curve_of(piece), tolerance, piece.knots[[0, -1]])


def _length(line: FloatArray) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def _begin(contour: Contour, curve: BSplineCurve, share: float, tolerance: float) -> int:
    """The first of a closed contour's points that goes with a curve along a share of it.

    Across a clearance another place may be as near to where the curve begins, but the points after
    that do not run along the curve.
    """
    lost = nearest(curve, contour.points).distances_sq > tolerance**2
    n_lost = np.concatenate([[0], np.cumsum(np.tile(lost, 2))])
    along = contour.arc_length[:-1]
    ahead = along + 0.5 * share * contour.length
    ends = np.searchsorted(np.concatenate([along, along + contour.length]), ahead)
    lost_ahead = n_lost[ends] - n_lost[: len(contour)]
    # By place of the segment before each point.
    off_sq = np.roll(distances_sq(curve.control_points[0], contour.polyline), 1)
    return int(np.lexsort((off_sq, lost_ahead))[0])


def _window(
    data: DataRun, begin: int, length: float, node: FloatArray, tolerance: float
) -> tuple[int, int]:
    """The points (low, high) among which a piece from one of them on, so long, ends at a node.

    A curve within the tolerance is shorter than data that scatter: the points are looked for
    farther away until some of them are near the node.
    """
    count = len(data.along)
    windows: list[tuple[int, int]] = []
    if not count:
        return 0, 0
    target = data.along[min(begin, count - 1)] + length
    reach = ALONG * length + TOLERANCES * tolerance
    while True:
        at = np.searchsorted(data.along, [target - reach, target + reach])
        low, high = np.maximum(at, begin).tolist()
        windows.append((low, high))
        polyline = data.points[max(low - 1, 0) : high + 1]
        if len(polyline) > 1 and distances_sq(node, polyline).min() <= tolerance**2:
            return low, high
        if low == begin and high == count:
            return windows[0]
        reach *= 2.0


def _cut(before: BSplineCurve, after: BSplineCurve, points: FloatArray, tolerance: float) -> int:
    """How many of some points go with the first of two curves: the fewest too far from their own.

    Where data lie over themselves the nearest place to the node may be another; of cuts that are
    as good the nearest to the node is taken.
    """
    if not len(points):
        return 0
    lost = [nearest(curve, points).distances_sq > tolerance**2 for curve in (before, after)]
    n_lost = np.concatenate([[0], np.cumsum(lost[0].astype(int) - lost[1])])
    fewest = np.flatnonzero(n_lost == n_lost.min())
    node = _behind(after.control_points[0], points)
    return int(fewest[np.abs(fewest - node).argmin()])


def _behind(node: FloatArray, polyline: FloatArray) -> int:
    """The end of the segment of a polyline that is nearest to a node."""
    return int(distances_sq(node, polyline).argmin()) + 1 if len(polyline) > 1 else 0


def distances_sq(node: FloatArray, polyline: FloatArray) -> FloatArray:
    """Squared distances of a node from the segments of a polyline."""
    begins, vectors = polyline[:-1], np.diff(polyline, axis=0)
    feet = begins + shares_of(*(node - begins).T, *vectors.T)[:, None] * vectors
    return np.asarray(((feet - node) ** 2).sum(axis=1))
