"""Bezier pieces cut where a coordinate turns: the parts on which it only rises or falls."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve

# Halvings of an interval of parameters: to the last bit of a number between 0 and 1.
HALVINGS = 60


def bezier_at(pieces: FloatArray, u: FloatArray) -> FloatArray:
    """Points of Beziers at parameters of each (de Casteljau), shape (s, k, d).

    Parameters
    ----------
    pieces : ndarray, shape (s, degree + 1, d)
    u : ndarray, shape (s, k)

    Examples
    --------
    >>> bezier_at(np.array([[[0.0], [2.0], [0.0]]]), np.array([[0.0, 0.5]])).tolist()
    [[[0.0], [1.0]]]
    """
    share = u[:, :, None, None]
    work = np.broadcast_to(pieces[:, None], (len(pieces), u.shape[1], *pieces.shape[1:]))
    while work.shape[2] > 1:
        work = (1 - share) * work[:, :, :-1] + share * work[:, :, 1:]
    return work[:, :, 0]


def critical_parameters(values: FloatArray) -> FloatArray:
    """Where polynomials turn in [0, 1]: zeros of their derivatives, in order, shape (s, degree).

    The zeros of a polynomial lie one by one between those of its derivative, where bisection finds
    them; so do theirs, down to degree one. Places that are no zeros are filled with ends of the
    intervals, so that all numbers lie in [0, 1] and every turn is among them.

    Parameters
    ----------
    values : ndarray, shape (s, degree + 1)
        Bernstein coefficients.

    Examples
    --------
    >>> critical_parameters(np.array([[0.0, 1.0, 0.0]])).tolist()
    [[0.5, 1.0]]
    """
    return _zeros(np.diff(values, axis=1))


def _zeros(values: FloatArray) -> FloatArray:
    """Zeros in [0, 1] where the polynomials change sign, and ends of intervals, shape (s, n)."""
    n_pieces, count = values.shape
    if count == 1:
        return np.ones((n_pieces, 1))
    ends = np.concatenate([np.zeros((n_pieces, 1)), _zeros(np.diff(values, axis=1))], axis=1)
    low, high = ends[:, :-1].copy(), ends[:, 1:].copy()
    pieces = values[..., None]
    falls = bezier_at(pieces, low)[..., 0] > bezier_at(pieces, high)[..., 0]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        before = (bezier_at(pieces, middle)[..., 0] > 0) == falls
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return np.concatenate([high, np.ones((n_pieces, 1))], axis=1)


def monotone_parts(curve: BSplineCurve, axis: int) -> FloatArray:
    """Beziers of a curve, cut where the coordinate turns, shape (k, degree + 1, 2).

    Neighbours share their end to the bit, and of a closed curve the last and the first do: so a
    line that passes through such a point crosses one of both.
    """
    pieces = curve.beziers().points
    turns = critical_parameters(pieces[..., axis])
    cuts = np.concatenate([np.zeros((len(pieces), 1)), turns, np.ones((len(pieces), 1))], axis=1)
    parts = np.stack(
        [_between(pieces, a, b) for a, b in zip(cuts.T[:-1], cuts.T[1:], strict=True)], axis=1
    )[cuts[:, 1:] > cuts[:, :-1]]
    parts[1:, 0] = parts[:-1, -1]
    parts[0, 0] = parts[-1, -1] if _closes(curve) else parts[0, 0]
    return parts


def _closes(curve: BSplineCurve) -> bool:
    points = curve.control_points
    return curve.periodic or bool((points[0] == points[-1]).all())


def _between(pieces: FloatArray, begin: FloatArray, end: FloatArray) -> FloatArray:
    """The Beziers of the parts between two parameters of each (blossoms, Ramshaw 1989)."""
    degree = pieces.shape[1] - 1
    points = []
    for k in range(degree + 1):
        work = pieces
        for r in range(degree):
            share = (end if r < k else begin)[:, None, None]
            work = (1 - share) * work[:, :-1] + share * work[:, 1:]
        points.append(work[:, 0])
    return np.stack(points, axis=1)
