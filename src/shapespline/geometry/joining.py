"""Pieces laid end to end, exactly: lines, Beziers and splines of mixed degree as one B-spline.

Every piece is raised to one degree, exactly (by blossoms, Ramshaw 1989), and pieces are laid end to
end on [0, 1]. A node without common tangent is a knot of full multiplicity; where the tangents
agree the widths of the parameter intervals are chosen so that the speeds agree too, the curve is C1
and one knot less.
"""

from __future__ import annotations

from itertools import combinations, pairwise
from math import atan2
from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.errors import InvalidInputError
from shapespline.values import EXACT_TURN, BSplineCurve, Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray


def turn_between(before: Piece, after: Piece) -> float:
    """Signed angle from the end of one piece to the start of the next, radians.

    Examples
    --------
    >>> right = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[0.0, 0], [1, 0]]))
    >>> up = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[1.0, 0], [1, 1]]))
    >>> round(float(np.degrees(turn_between(right, up))), 6)
    90.0
    """
    (ax, ay), (bx, by) = before.control_points[-2:].tolist()
    (cx, cy), (dx, dy) = after.control_points[:2].tolist()
    ux, uy, vx, vy = bx - ax, by - ay, dx - cx, dy - cy
    return atan2(ux * vy - uy * vx, ux * vx + uy * vy)


def turns_of(pieces: Sequence[Piece], closed: bool) -> list[float]:
    """Signed turns between neighbours, radians; of a closed curve that at the seam comes first.

    Examples
    --------
    >>> from shapespline import fit_curve
    >>> square = fit_curve([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True, tolerance=0.01)
    >>> np.abs(np.degrees(turns_of(square.pieces, closed=True))).round(6).tolist()
    [90.0, 90.0, 90.0, 90.0]
    """
    seam = [(pieces[-1], pieces[0])] if closed and pieces else []
    return [turn_between(before, after) for before, after in (*seam, *pairwise(pieces))]


def joined(pieces: Sequence[Piece], degree: int | None = None) -> BSplineCurve:
    """All pieces as one clamped B-spline over [0, 1]: the same curve.

    Parameters
    ----------
    pieces : sequence of Piece
        End to end, each clamped over [0, 1] and at most of the degree.
    degree : int, optional
        1 to 9; the highest among the pieces when not given.

    Examples
    --------
    >>> right = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[0.0, 0], [1, 0]]))
    >>> up = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([[1.0, 0], [1, 1]]))
    >>> corner = joined([right, up], 3)
    >>> corner.knots.tolist()
    [0.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0, 1.0]
    >>> corner([0.25, 0.5]).tolist()
    [[0.5, 0.0], [1.0, 0.0]]
    """
    if degree is None:
        degree = max(piece.degree for piece in pieces)
    for piece in pieces:
        _check(piece, degree)
    row = [
        piece if len(piece.control_points) == piece.degree + 1 else elevated(piece, degree)
        for piece in pieces
    ]
    found = _kernels.JoinedPieces(
        [piece.degree for piece in row],
        [len(piece.control_points) for piece in row],
        np.concatenate([piece.knots for piece in row], dtype=np.float64),
        np.concatenate([piece.control_points for piece in row], dtype=np.float64),
        degree,
        EXACT_TURN,
    )
    points = np.empty((found.n_points, 2))
    knots = np.empty(len(points) + degree + 1)
    found.write(knots, points)
    return BSplineCurve(knots, points, degree)


def _check(piece: Piece, degree: int) -> None:
    """Raise unless the knots of a piece, which a file may hold, are as many as it needs."""
    n = len(piece.control_points)
    if not (1 <= piece.degree <= min(degree, n - 1) and len(piece.knots) == n + piece.degree + 1):
        raise InvalidInputError(
            f"pieces must have a degree of 1 to {degree}, more control points than that and as many"
            f" knots as both and one, got degree {piece.degree}, {n} control points and"
            f" {len(piece.knots)} knots"
        )


def elevated(piece: Piece, degree: int) -> Piece:
    """The same piece with a higher degree, exact up to rounding.

    Control point i is the blossom at degree consecutive knots, and the blossom of a polynomial
    read with a higher degree is the mean of its own over all choices of arguments (Ramshaw 1989).
    """
    p = piece.degree
    if p == degree:
        return piece
    if len(piece.control_points) == p + 1:
        knots = np.repeat(piece.knots[[0, -1]], degree + 1)
        points = np.empty((degree + 1, 2))
        _kernels.elevated(
            np.ascontiguousarray(piece.control_points, dtype=np.float64), degree, points
        )
        return Piece("bezier", degree, knots, points)
    breakpoints, counts = np.unique(piece.knots, return_counts=True)
    knots = np.repeat(breakpoints, counts + degree - p)
    points = np.empty((len(knots) - degree - 1, 2))
    for i in range(len(points)):
        # Any span of the support will do: the first that is not empty.
        begin = knots[i + 1 : i + degree + 1].min()
        span = int(np.searchsorted(piece.knots, begin, side="right")) - 1
        span = min(span, len(piece.control_points) - 1)
        choices = combinations(knots[i + 1 : i + degree + 1], p)
        points[i] = np.mean([blossom(piece, span, arguments) for arguments in choices], axis=0)
    points[0], points[-1] = piece.control_points[0], piece.control_points[-1]
    return Piece("spline", degree, knots, points)


def blossom(piece: Piece, span: int, arguments: tuple[float, ...]) -> FloatArray:
    """Polar form of the polynomial of one span (de Boor's algorithm with mixed arguments)."""
    p, knots = piece.degree, piece.knots
    work = piece.control_points[span - p : span + 1].copy()
    for r, u in enumerate(arguments, start=1):
        low, high = knots[span - p + r : span + 1], knots[span + 1 : span + p + 2 - r]
        share = ((u - low) / (high - low))[:, None]
        work = (1 - share) * work[:-1] + share * work[1:]
    return work[0]
