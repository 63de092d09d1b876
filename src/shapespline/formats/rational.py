"""Rational Beziers: products of their polynomials, and those that are arcs of circles."""

from __future__ import annotations

from functools import cache
from math import atan2, comb
from typing import TYPE_CHECKING

import numpy as np

from shapespline.values import FULL_TURN, Arc, Piece

if TYPE_CHECKING:
    from shapespline.typing import FloatArray

# Radians: a sweep that is longer than a turn by less is a turn.
TURN_ROUNDING = 1e-9


def arc_of(span: FloatArray, tolerance: float) -> Piece | None:
    """A rational Bezier as the arc that it is, None if it is none.

    With the curve r = a / w it is one where |a - c w|^2 - R^2 w^2 vanishes: the largest coefficient
    of this polynomial over R and the square of the least weight bounds how far r leaves the circle.

    Parameters
    ----------
    span : ndarray, shape (p + 1, 3)
        Homogeneous control points (x w, y w, w) with positive weights.
    tolerance : float
        Largest distance between the curve and the circle.

    Examples
    --------
    >>> h = np.sqrt(0.5)
    >>> quarter = arc_of(np.array([(1, 0, 1), (h, h, h), (0, 1, 1)]), 1e-9)
    >>> round(quarter.arc.radius, 9), round(quarter.arc.sweep / np.pi, 9)
    (1.0, 0.5)
    >>> arc_of(np.array([(1, 0, 1), (1, 1, 1), (0, 1, 1)]), 1e-9) is None
    True
    """
    first = span[0, :2] / span[0, 2]
    weights = span[:, 2]
    # About the first point, so that its place costs no accuracy.
    moved = np.column_stack([span[:, :2] - weights[:, None] * first, weights])
    with np.errstate(all="ignore"):  # numbers without squares are no circle
        centre = _centre(moved)
        radius = float(np.hypot(*centre))
        away = moved[:, :2] - weights[:, None] * centre
        off = product(away[:, :1], away[:, :1]) + product(away[:, 1:], away[:, 1:])
        off -= radius**2 * product(weights, weights)
        if not np.abs(off).max() <= tolerance * radius * weights.min() ** 2:
            return None
    points = _points(moved, np.linspace(0.0, 1.0, 8 * len(span))) - centre
    angles = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    sweep = float(angles[-1] - angles[0])
    if not (np.diff(angles) * sweep > 0).all() or abs(sweep) > FULL_TURN + TURN_ROUNDING:
        return None
    sweep = max(-FULL_TURN, min(FULL_TURN, sweep))
    x, y = (first + centre).tolist()
    arc = Arc((x, y), radius, atan2(-centre[1], -centre[0]), sweep)
    return Piece.of_arc(arc, begin=first, end=span[-1, :2] / span[-1, 2])


def _centre(span: FloatArray) -> FloatArray:
    """Centre of the circle through the origin and two points of a rational Bezier."""
    (x, y), (u, v) = _points(span, np.array([1 / 3, 2 / 3]))
    one, other = x * x + y * y, u * u + v * v
    across: FloatArray = np.array([v * one - y * other, x * other - u * one])
    return across / (2 * (x * v - y * u))


def _points(span: FloatArray, parameters: FloatArray) -> FloatArray:
    """Points of a rational Bezier, shape (k, 2)."""
    p = len(span) - 1
    t = parameters[:, None]
    basis = np.hstack([comb(p, i) * t**i * (1 - t) ** (p - i) for i in range(p + 1)])
    values = basis @ span
    return values[:, :2] / values[:, 2:]


def product(one: FloatArray, other: FloatArray) -> FloatArray:
    """Bernstein coefficients of the product of two polynomials, shape (p + q + 1, k)."""
    p, q = len(one) - 1, len(other) - 1
    one, other = one.reshape(len(one), -1), other.reshape(len(other), -1)
    result = np.zeros((p + q + 1, max(one.shape[1], other.shape[1])))
    for i in range(p + 1):
        for j in range(q + 1):
            result[i + j] += _share(p, i, q, j) * one[i] * other[j]
    return result


@cache
def _share(p: int, i: int, q: int, j: int) -> float:
    return comb(p, i) * comb(q, j) / comb(p + q, i + j)
