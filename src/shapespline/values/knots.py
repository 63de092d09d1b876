"""Knot vectors: clamped and periodic, their Greville abscissae, and what makes one valid.

A knot vector is the full non-decreasing array, ``n_coefficients + degree + 1`` long; its domain is
``[knots[degree], knots[n_coefficients]]``. *Clamped* knots repeat both ends ``degree + 1`` times,
*periodic* ones continue beyond the domain with the period.
"""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.errors import DegenerateContourError, InvalidInputError, OrderError
from shapespline.validation import float_array, whole_number

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike, FloatArray

MAX_DEGREE = _kernels.MAX_DEGREE


# Knots of what is found are whole parts of this: then 1 - u is exact, and a curve turned around
# twice is the same (PIE-25).
KNOT_GRID = 2.0**52


def on_grid(knots: FloatArray) -> FloatArray:
    """Knots over [0, 1] rounded to whole parts of `KNOT_GRID`.

    Examples
    --------
    >>> knots = on_grid(np.array([0.0, 1 / 3, 1.0]))
    >>> bool((1.0 - (1.0 - knots) == knots).all())
    True
    """
    return np.asarray(np.rint(knots * KNOT_GRID) / KNOT_GRID)


def check_degree(degree: int) -> int:
    """The degree as an int, or an error that names the range."""
    number = whole_number(degree)
    if number is None or not 1 <= number <= MAX_DEGREE:
        raise InvalidInputError(f"degree must be an integer from 1 to {MAX_DEGREE}, got {degree!r}")
    return number


def check_count(n_control_points: int, degree: int) -> int:
    """The number of control points as an int, at least degree + 1."""
    number = whole_number(n_control_points)
    if number is None:
        raise InvalidInputError(f"n_control_points must be an integer, got {n_control_points!r}")
    if number < degree + 1:
        raise DegenerateContourError(
            f"n_control_points must be at least degree + 1 = {degree + 1},"
            f" got {n_control_points}; raise it or lower the degree"
        )
    return number


def clamped_knots(
    n_control_points: int, degree: int, interior: ArrayLike | None = None
) -> FloatArray:
    """Clamped knot vector over [0, 1].

    Parameters
    ----------
    n_control_points : int
        At least ``degree + 1``.
    degree : int
        1 to 9.
    interior : array_like, shape (n_control_points - degree - 1,), optional
        Interior knots; equally spaced when not given, as in the paper's section 6.

    Examples
    --------
    >>> clamped_knots(5, 3).tolist()
    [0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0]
    """
    degree = check_degree(degree)
    n_interior = check_count(n_control_points, degree) - degree - 1
    if interior is None:
        inner = np.arange(1, n_interior + 1) / (n_interior + 1)
    else:
        inner = float_array(interior, "interior")
        if inner.shape != (n_interior,):
            raise InvalidInputError(
                f"interior must hold {n_interior} knots for {n_control_points} control points of"
                f" degree {degree}, got shape {inner.shape}"
            )
    knots = np.concatenate([np.zeros(degree + 1), inner, np.ones(degree + 1)])
    check_knots(knots, degree, periodic=False)
    return knots


def periodic_knots(
    n_control_points: int, degree: int, breakpoints: ArrayLike | None = None
) -> FloatArray:
    """Periodic knot vector over [0, 1] for ``n_control_points`` distinct control points.

    Parameters
    ----------
    n_control_points : int
        At least ``degree + 1``.
    degree : int
        1 to 9.
    breakpoints : array_like, shape (n_control_points + 1,), optional
        Knots of one period, from 0 to 1; equally spaced when not given.

    Examples
    --------
    >>> periodic_knots(4, 2).tolist()
    [-0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5]
    """
    degree = check_degree(degree)
    m = check_count(n_control_points, degree)
    period = (
        np.arange(m + 1) / m if breakpoints is None else float_array(breakpoints, "breakpoints")
    )
    if period.shape != (m + 1,) or period[0] != 0.0 or period[-1] != 1.0:
        raise InvalidInputError(
            f"breakpoints must be {m + 1} knots from 0 to 1, got shape {period.shape}"
        )
    before, after = period[-degree - 1 : -1] - 1.0, period[1 : degree + 1] + 1.0
    knots = np.concatenate([before, period, after])
    check_knots(knots, degree, periodic=True)
    return knots


def check_knots(knots: FloatArray, degree: int, *, periodic: bool) -> None:
    """Raise unless the array is a valid clamped or periodic knot vector for the degree.

    Interior multiplicities may reach the degree (a corner), not more: the curve stays continuous.
    """
    degree = check_degree(degree)
    if knots.ndim != 1 or len(knots) < 2 * degree + 2:
        raise InvalidInputError(
            f"knots must be one array of at least 2 (degree + 1) = {2 * degree + 2} values,"
            f" got shape {knots.shape}"
        )
    ends_are_finite = isfinite(knots[0]) and isfinite(knots[-1])
    if not (ends_are_finite and (knots[1:] >= knots[:-1]).all()):
        if not np.isfinite(knots).all():
            raise InvalidInputError("knots must be finite, got NaN or infinity")
        at = int(np.flatnonzero(np.diff(knots) < 0)[0])
        raise OrderError(
            f"knots must not decrease, got {knots[at]} before {knots[at + 1]} at {at}; sort them"
        )
    domain = knots[degree : len(knots) - degree]
    if not domain[0] < domain[-1]:
        raise InvalidInputError(f"knots must span a domain, got only {domain[0]}")
    if periodic:
        period = domain[-1] - domain[0]
        m = len(domain) - 1
        if m < degree + 1:
            raise DegenerateContourError(
                f"knots must have at least degree + 1 = {degree + 1} control points in a period,"
                f" got {m}; lower the degree"
            )
        # Knots that were shifted by the period carry one rounding each.
        slack = 4 * np.finfo(float).eps * (np.abs(knots).max() + period)
        if np.abs(knots[m:] - knots[: len(knots) - m] - period).max() > slack:
            raise InvalidInputError(
                "knots must repeat with the period of the domain for a periodic curve;"
                " make them with periodic_knots"
            )
        # The seam is an ordinary knot: count its multiplicity over one period, on both sides of it.
        inner = np.sort(np.where(domain == domain[-1], domain[0], domain))[1:]
    else:
        for end, name in ((knots[: degree + 1], "first"), (knots[-degree - 1 :], "last")):
            if end[0] != end[-1]:
                raise InvalidInputError(
                    f"knots must repeat the {name} value degree + 1 = {degree + 1} times"
                    f" (clamped), got {end.tolist()}"
                )
        inner = domain[1:-1]
        if len(inner) and (inner[0] == domain[0] or inner[-1] == domain[-1]):
            raise InvalidInputError(
                f"knots must repeat their ends exactly degree + 1 = {degree + 1} times, got more"
            )
    if len(inner) > degree and (inner[degree:] == inner[:-degree]).any():
        repeated = float(inner[np.flatnonzero(inner[degree:] == inner[:-degree])[0]])
        raise InvalidInputError(
            f"knots must not repeat more than degree = {degree} times inside,"
            f" got more at {repeated}"
        )


def greville_abscissae(knots: FloatArray, degree: int) -> FloatArray:
    """Averages of ``degree`` consecutive knots, one for each coefficient.

    The parameter at which a control point pulls most: a spline whose coefficients are its Greville
    abscissae is the identity (de Boor, A Practical Guide to Splines, chapter IX).

    Examples
    --------
    >>> greville_abscissae(clamped_knots(4, 3), 3).round(6).tolist()
    [0.0, 0.333333, 0.666667, 1.0]
    """
    sums = np.cumsum(np.concatenate([[0.0], knots]))
    n_coefficients = len(knots) - degree - 1
    return (sums[degree + 1 : degree + 1 + n_coefficients] - sums[1 : 1 + n_coefficients]) / degree
