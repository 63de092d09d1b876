"""Splines as files hold them, made into pieces: any knots, clamped or not, with weights or without.

Rational curves become arcs where they are parts of circles, else cubics: a spline of this package
has no weights.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats.cubics import halves
from shapespline.formats.pieces import bezier, joined_arcs
from shapespline.formats.rational import arc_of, product
from shapespline.values import BSplineCurve, Piece, check_degree, clamped_ends

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.typing import ArrayLike, FloatArray

# How far the cubics may lie from a rational curve, of the diagonal of its control points' box
# (FMT-03).
RATIONAL_TOLERANCE = 1e-9
# Halvings of a span at most; a spline that needs more has weights of no use.
MOST_HALVINGS = 12


def spline_pieces(
    degree: int, knots: ArrayLike, control_points: ArrayLike, weights: ArrayLike | None = None
) -> list[Piece]:
    """The pieces of a spline: itself, or arcs and cubics within 1e-9 of its size if it is rational.

    Parameters
    ----------
    degree : int
    knots : array_like, shape (m + degree + 1,)
        Non-decreasing, clamped or not, over any interval.
    control_points : array_like, shape (m, 2)
    weights : array_like, shape (m,), optional

    Raises
    ------
    FormatError
        If the numbers do not make a spline, or a weight is not positive.

    Examples
    --------
    >>> (arch,) = spline_pieces(2, [3, 3, 3, 5, 5, 5], [(0, 0), (1, 2), (2, 0)])
    >>> arch.kind, arch.knots.tolist()
    ('bezier', [0.0, 0.0, 0.0, 1.0, 1.0, 1.0])
    """
    t, points = np.array(knots, dtype=np.float64), np.array(control_points, dtype=np.float64)
    if points.ndim != 2 or len(points) <= degree or len(t) != len(points) + degree + 1:
        raise FormatError(
            f"a spline of degree {degree} must have degree + 1 knots more than control points,"
            f" found {len(t)} knots and {len(points)} control points"
        )
    w = np.ones(len(points)) if weights is None else np.array(weights, dtype=np.float64)
    if w.shape != (len(points),) or not (np.isfinite(w).all() and (w > 0).all()):
        raise FormatError("a rational spline must have a positive weight for each control point")
    try:
        check_degree(degree)
        homogeneous = np.column_stack([points * w[:, None], w])
        t, homogeneous = clamped_ends(_checked(t, degree), homogeneous, degree)
        t = (t - t[0]) / (t[-1] - t[0])
        if np.ptp(w) <= 4 * np.finfo(float).eps * w.max():
            curve = BSplineCurve(t, homogeneous[:, :2] / w[0], degree)
            kind = "line" if degree == 1 else "bezier"
            kind = "spline" if len(curve.breakpoints) > 2 else kind
            return [Piece(kind, degree, curve.knots, curve.control_points)]
        above = BSplineCurve(t, homogeneous[:, :2], degree).beziers().points
        below = BSplineCurve(t, homogeneous[:, [2, 2]], degree).beziers().points[..., :1]
    except InvalidInputError as error:
        raise FormatError(f"a spline cannot be used: {error}") from error
    tolerance = RATIONAL_TOLERANCE * float(np.hypot(*np.ptp(points, axis=0)))
    spans = np.concatenate([above, below], axis=2)
    return joined_arcs([piece for span in spans for piece in _pieces(span, tolerance)])


def _checked(knots: FloatArray, degree: int) -> FloatArray:
    """Knots that are finite, in order and span a domain."""
    domain = knots[degree : len(knots) - degree]
    if not (np.isfinite(knots).all() and (np.diff(knots) >= 0).all() and domain[0] < domain[-1]):
        raise InvalidInputError("its knots must be finite, not decrease and span a domain")
    return knots


def _pieces(span: FloatArray, tolerance: float) -> list[Piece]:
    """An arc if a rational Bezier is one, else cubics."""
    points = span[:, :2] / span[:, 2:]
    arc = arc_of(span, RATIONAL_TOLERANCE * float(np.hypot(*np.ptp(points, axis=0))))
    if arc is not None:
        return [arc]
    return [bezier(cubic) for cubic in _cubics(span, tolerance, MOST_HALVINGS)]


def _cubics(span: FloatArray, tolerance: float, halvings: int) -> Iterator[FloatArray]:
    """Cubics with the ends and end derivatives of a rational Bezier, or of its halves.

    ``span`` (p + 1, 3) are homogeneous control points. With the curve r = a / w and a cubic h the
    polynomial h w - a has degree p + 3, and its largest coefficient over the least weight bounds
    the distance of h and r at equal parameters.
    """
    p = len(span) - 1
    points, w = span[:, :2] / span[:, 2:], span[:, 2]
    begin = p * w[1] / w[0] * (points[1] - points[0])
    end = p * w[-2] / w[-1] * (points[-1] - points[-2])
    cubic = np.array([points[0], points[0] + begin / 3, points[-1] - end / 3, points[-1]])
    # About the first point, so that its place costs no accuracy.
    moved = span[:, :2] - w[:, None] * points[0]
    off = product(cubic - points[0], w) - product(np.ones((4, 1)), moved)
    if float(np.hypot(*off.T).max()) <= tolerance * w.min():
        yield cubic
    elif halvings == 0:
        raise FormatError("a rational spline has weights so uneven that no cubics can follow it")
    else:
        for half in halves(span):
            yield from _cubics(half, tolerance, halvings - 1)
