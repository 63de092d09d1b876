"""The size of a least-squares fit when the caller gives none."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.balance import balanced_start
from shapespline.solvers.iteration import Limits

if TYPE_CHECKING:
    from shapespline.contour import Contour
    from shapespline.typing import FloatArray

# Sizes tried grow by this factor ...
SIZE_FACTOR = 1.25
# ... up to this part of the number of points, and in this many rounds of balancing each.
LARGEST_PART = 0.25
SEARCH_ROUNDS = 2
# Deviation, in parts of the median distance between points, that the sampling itself may hide.
SAMPLING_FLOOR = 0.01
# Points that the search for a size looks at: more tell it nothing new.
SEARCH_POINTS = 10_000
# Sizes in a row that do not lower the criterion before the search ends; not before this size, for
# an outline with many features shows nothing until there is a control point for each.
SEARCH_PATIENCE = 3
SEARCH_AT_LEAST = 64
# The start of a least-squares fit has been balanced already: what is left falls by 1e-4 and less.
FINAL_LIMITS = Limits(max_iterations=300, max_evaluations=1000, relative_decrease=1e-4)


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
