"""fit_curve: points in, verified Fit out."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.balance import STRAY_WEIGHT, balanced_start
from shapespline.contour import Contour
from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.knots import check_count, check_degree
from shapespline.optimization import checked_weights, optimize
from shapespline.solvers.iteration import Limits

if TYPE_CHECKING:
    from shapespline.drawing import Fit
    from shapespline.optimization import Callback
    from shapespline.typing import ArrayLike, FloatArray

# Sizes tried when none is given grow by this factor ...
SIZE_FACTOR = 1.25
# ... up to this part of the number of points, and in this many rounds of balancing each.
LARGEST_PART = 0.25
SEARCH_ROUNDS = 2
# Deviation, in parts of the median distance between points, that the sampling itself may hide.
SAMPLING_FLOOR = 0.01
# Points that the search for a size looks at: more tell it nothing new.
SEARCH_POINTS = 10_000
# The start has been balanced already: what is left falls by 1e-4 and less.
FINAL_LIMITS = Limits(max_iterations=300, max_evaluations=1000, relative_decrease=1e-4)
# Sizes in a row that do not lower the criterion before the search ends; not before this size, for
# an outline with many features shows nothing until there is a control point for each.
SEARCH_PATIENCE = 3
SEARCH_AT_LEAST = 64


def fit_curve(
    points: ArrayLike | Contour,
    *,
    closed: bool | None = None,
    n_control_points: int | None = None,
    degree: int = 3,
    weights: ArrayLike | None = None,
    method: str = "levenberg-marquardt",
    callback: Callback | None = None,
) -> Fit:
    """Fit a B-spline curve to ordered points.

    Parameters and control points are optimised together from a start that spreads the control
    points by the bending of the outline and the errors of a few short fits. A closed outline gets
    a periodic curve, without seam; an open one a clamped curve through its first and last point.

    Parameters
    ----------
    points : array_like, shape (n, 2), or Contour
        In order along the outline, data units.
    closed : bool, optional
        Whether the last point joins the first; found from the data when not given.
    n_control_points : int, optional
        Number of control points, ``degree + 1`` to n. Chosen by an information criterion when not
        given: more control points as long as the error falls by more than they cost, down to the
        noise or what the sampling can show.
    degree : int
        1 to 9.
    weights : array_like, shape (n,), optional
        One positive weight per point.
    method : str
        See `optimize`.
    callback : callable, optional
        Called with every Iteration of the final run; a true answer cancels it.

    Returns
    -------
    Fit
        Its distances are verified both ways; ``tolerance`` is the one that it keeps.

    Raises
    ------
    InvalidInputError, DegenerateContourError
        If the points, the weights or a number is not usable; the message says which and why.

    Examples
    --------
    >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    >>> ellipse = np.column_stack([3 * np.cos(t), np.sin(t)])
    >>> fit = fit_curve(ellipse, closed=True, n_control_points=8)
    >>> fit.n_control_points, fit.closed, fit.hausdorff_distance < 0.01
    (8, True, True)
    """
    degree = check_degree(degree)
    if not isinstance(points, Contour):
        points = Contour(points, closed)
    elif closed is not None and closed != points.closed:
        points = Contour.silently(points.points[points.source], closed)
    contour = points
    summed = checked_weights(weights, contour)
    if len(contour) < degree + 1:
        raise DegenerateContourError(
            f"points must hold at least degree + 1 = {degree + 1} distinct points for degree"
            f" {degree}, got {len(contour)}; add points or lower the degree"
        )
    if n_control_points is None:
        count = chosen_count(contour, degree, summed)
    else:
        count = check_count(n_control_points, degree)
        if count > len(contour):
            raise InvalidInputError(
                f"n_control_points must be at most the number of distinct points, {len(contour)},"
                f" got {count}; lower it"
            )
    start = balanced_start(contour, count, degree, summed)
    return optimize(
        contour,
        start,
        method,
        weights=weights,
        stray_weight=STRAY_WEIGHT,
        limits=FINAL_LIMITS,
        callback=callback,
    )


def chosen_count(contour: Contour, degree: int, weights: FloatArray | None = None) -> int:
    """Number of control points that the Bayesian information criterion favours.

    Minimises n log(rms^2 + floor^2) + 2 m log n over sizes m that grow by a quarter, where the
    floor is what the sampling cannot show (Schwarz 1978), up to a quarter of the number of points;
    on a resampled outline where there are more than 10 000.
    """
    if len(contour) > SEARCH_POINTS and weights is None:
        contour = contour.resampled(SEARCH_POINTS)
    n = len(contour)
    steps = np.diff(contour.arc_length)
    floor_sq = (SAMPLING_FLOOR * float(np.median(steps))) ** 2
    largest = max(degree + 1, int(LARGEST_PART * n))
    size, best_size, best, misses = degree + 1, degree + 1, np.inf, 0
    while size <= largest and (size <= SEARCH_AT_LEAST or misses < SEARCH_PATIENCE):
        start = balanced_start(contour, size, degree, weights, rounds=SEARCH_ROUNDS)
        residuals = start.spline(start.parameters) - contour.points
        criterion = n * np.log((residuals**2).sum() / n + floor_sq) + 2 * size * np.log(n)
        if criterion < best:
            best_size, best, misses = size, criterion, 0
        else:
            misses += 1
        size = max(size + 1, round(SIZE_FACTOR * size))
    return best_size
