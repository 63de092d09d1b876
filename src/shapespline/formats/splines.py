"""Splines as files hold them, made into pieces: any knots, clamped or not, with weights or without.

Rational curves become cubics: a spline of this package has no weights.
"""

from __future__ import annotations

from functools import cache
from math import comb
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats.cubics import halves
from shapespline.formats.pieces import bezier
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
    """The pieces of a spline: itself, or cubics within 1e-9 of its size if it is rational.

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
    return [bezier(cubic) for span in spans for cubic in _cubics(span, tolerance, MOST_HALVINGS)]


def _checked(knots: FloatArray, degree: int) -> FloatArray:
    """Knots that are finite, in order and span a domain."""
    domain = knots[degree : len(knots) - degree]
    if not (np.isfinite(knots).all() and (np.diff(knots) >= 0).all() and domain[0] < domain[-1]):
        raise InvalidInputError("its knots must be finite, not decrease and span a domain")
    return knots


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
    product = _product(cubic - points[0], w) - _product(np.ones((4, 1)), moved)
    if float(np.hypot(*product.T).max()) <= tolerance * w.min():
        yield cubic
    elif halvings == 0:
        raise FormatError("a rational spline has weights so uneven that no cubics can follow it")
    else:
        for half in halves(span):
            yield from _cubics(half, tolerance, halvings - 1)


def _product(one: FloatArray, other: FloatArray) -> FloatArray:
    """Bernstein coefficients of the product of two polynomials, shape (p + q + 1, k)."""
    p, q = len(one) - 1, len(other) - 1
    other = other.reshape(len(other), -1)
    result = np.zeros((p + q + 1, max(one.shape[1], other.shape[1])))
    for i in range(p + 1):
        for j in range(q + 1):
            result[i + j] += _share(p, i, q, j) * one[i] * other[j]
    return result


@cache
def _share(p: int, i: int, q: int, j: int) -> float:
    return comb(p, i) * comb(q, j) / comb(p + q, i + j)
