"""Piece: a line, an arc, a Bezier or a spline, end to end with its neighbours."""

from __future__ import annotations

from itertools import accumulate, pairwise, starmap
from math import dist
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.values.arc import Arc, deviation
from shapespline.values.equality import hashed, same

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import ArrayLike, FloatArray


# A joint is smooth when it turns by no more than this, radians: a degree, which neither the eye nor
# a milling machine sees. The other thresholds of joints are made of it.
SMOOTH_TURN = np.radians(1.0)
# A joint that turns more is a corner; rounding adds less to a joint that keeps the degree.
CORNER_TURN = 1.01 * SMOOTH_TURN
# Tangents that are one agree to rounding, radians.
EXACT_TURN = 1e-9
# A map whose singular values differ by less than this part is a similarity.
SAME_FACTOR = 1e-12


class Piece(NamedTuple):
    """A line, an arc, a Bezier or a spline, end to end with its neighbours.

    ``kind`` is one of ``"line"``, ``"arc"``, ``"bezier"`` and ``"spline"``. The knots and control
    points of an arc are those of its twin (`Arc.twin`), the spline that stands for it in a curve;
    ``arc`` is the arc itself, None of other kinds.
    """

    kind: str
    degree: int
    knots: FloatArray
    control_points: FloatArray
    arc: Arc | None = None

    @classmethod
    def of_arc(
        cls,
        arc: Arc,
        tolerance: float | None = None,
        *,
        begin: ArrayLike | None = None,
        end: ArrayLike | None = None,
    ) -> Piece:
        """An arc as a piece.

        Parameters
        ----------
        arc : Arc
        tolerance : float, optional
            Of the fit that it is in; see `Arc.n_beziers`.
        begin, end : array_like, shape (2,), optional
            The ends as the neighbours have them, to the bit; those of the arc, which differ from
            them by rounding, if not given.

        Examples
        --------
        >>> piece = Piece.of_arc(Arc((0, 0), 1.0, 0.0, np.pi), end=(-1, 0))
        >>> piece.kind, piece.n_stored, piece.control_points[-1].tolist()
        ('arc', 2, [-1.0, 0.0])
        """
        knots, points = arc.twin(arc.n_beziers(tolerance))
        return cls("arc", 3, knots, points, arc).meeting(begin, end)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Piece) and all(map(same, self, other))

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(tuple(map(hashed, self)))

    @property
    def polygon_length(self) -> float:
        """Length of the control polygon."""
        return sum(starmap(dist, pairwise(self.control_points.tolist())))

    @property
    def n_stored(self) -> int:
        """Distinct points that a file stores of it, its beginning not counted: of an arc two."""
        return len(self.control_points) - 1 if self.arc is None else 2

    @property
    def n_beziers(self) -> int:
        """Number of its spans, each of which a Bezier is."""
        return int(np.count_nonzero(np.diff(self.knots)))

    @property
    def twin_error(self) -> float:
        """Bound of the distance between an arc and its twin, data units; 0 for other kinds."""
        if self.arc is None:
            return 0.0
        inner = self.arc.radius * deviation(abs(self.arc.sweep) / self.n_beziers)
        moved = self.control_points[[0, -1]] - (self.arc.begin, self.arc.end)
        return inner + float(np.hypot(moved[:, 0], moved[:, 1]).max())

    def meeting(self, begin: ArrayLike | None = None, end: ArrayLike | None = None) -> Piece:
        """The same with its ends, one or both, at given points, a rounding away.

        What an arc's ends are moved by the twin between them takes part in, so that it stays
        smooth.
        """
        points = self.control_points.copy()
        if self.arc is not None:
            share = np.linspace(0.0, 1.0, len(points))[:, None]
            first = 0.0 if begin is None else np.asarray(begin) - points[0]
            last = 0.0 if end is None else np.asarray(end) - points[-1]
            points += (1 - share) * first + share * last
        if begin is not None:
            points[0] = begin
        if end is not None:
            points[-1] = end
        return self._replace(control_points=points)

    def moved(self, linear: FloatArray, shift: FloatArray) -> Piece:
        """The image under p -> linear p + shift; an arc is one after similarities only.

        Parameters
        ----------
        linear : ndarray, shape (2, 2)
        shift : ndarray, shape (2,)
        """
        points = np.ascontiguousarray(self.control_points @ linear.T + shift)
        if self.arc is None:
            return self._replace(control_points=points)
        largest, smallest = np.linalg.svd(linear, compute_uv=False).tolist()
        if largest - smallest > SAME_FACTOR * largest:
            return Piece("spline", self.degree, self.knots, points)
        return self._replace(control_points=points, arc=self.arc.moved(linear, shift))


def with_points(pieces: Sequence[Piece], points: FloatArray) -> tuple[Piece, ...]:
    """Pieces with other control points: as many for each, those of all in one row.

    Examples
    --------
    >>> side = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[0.0, 0], [1, 0]]))
    >>> moved = with_points([side, side], np.array([[0.0, 0], [2, 0], [2, 0], [2, 5]]))
    >>> [piece.control_points.tolist() for piece in moved]
    [[[0.0, 0.0], [2.0, 0.0]], [[2.0, 0.0], [2.0, 5.0]]]
    """
    ends = accumulate((len(piece.control_points) for piece in pieces), initial=0)
    return tuple(
        Piece(piece.kind, piece.degree, piece.knots, points[begin:end], piece.arc)
        for piece, (begin, end) in zip(pieces, pairwise(ends), strict=True)
    )
