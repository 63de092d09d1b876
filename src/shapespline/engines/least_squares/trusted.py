"""A start that outliers do not bend: made from the points that are near it (trimmed squares).

A curve that once ran out to an outlier stays there when the outlier loses its weight: nothing pulls
it back, for a bulge between points costs nothing. So points that jump, and then those that are far
from the start itself, have no part in it; they get their place between their neighbours.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import find_outliers
from shapespline.engines.least_squares.losses import LOSSES, NORMAL_MEDIAN
from shapespline.engines.least_squares.solve import parameters_in_order
from shapespline.engines.least_squares.starts.equidistribution import Balanced
from shapespline.validation import median
from shapespline.values import Contour

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.engines.least_squares.solve import Start
    from shapespline.typing import BoolArray, FloatArray

    # A start of some points with their weights.
    Make = Callable[[Contour, FloatArray | None], Start]

# Rounds of leaving points out, and the deviations beyond which that is done: Tukey's (LSQ-07).
ROUNDS, FAR = 3, LOSSES["tukey"]


class Trusted(NamedTuple):
    """A start for all points, their distances to it in standard deviations, (n,)."""

    start: Balanced
    standardized: FloatArray


def trusted_start(
    contour: Contour, make: Make, weights: FloatArray | None, noise: float | None = None
) -> Trusted:
    """The start that most points agree on.

    Parameters
    ----------
    contour : Contour
    make : callable
        A start of an outline and the weights of its points.
    weights : ndarray, shape (n,), or None
    noise : float, optional
        Standard deviation of a point of weight one, data units; by the median of the distances if
        these are larger, or if it is not known.
    """
    kept = np.ones(len(contour), dtype=bool)
    kept[find_outliers(contour)] = False
    for _ in range(ROUNDS):
        start = start_of_some(contour, make, weights, kept)
        z = standardized(contour, start, weights, noise)
        scale = max(1.0, median(z) / NORMAL_MEDIAN)
        near = kept & (z <= FAR * scale)
        if (near == kept).all():
            break
        kept = near
    return Trusted(start, z)


def standardized(
    contour: Contour, start: Start, weights: FloatArray | None, noise: float | None
) -> FloatArray:
    """Distances of the points to their places on a start, in deviations, (n,)."""
    away = np.hypot(*(start.spline(start.parameters) - contour.points).T)
    away = away if weights is None else away * np.sqrt(weights)
    scale = median(away) / NORMAL_MEDIAN if noise is None else noise
    return away / max(scale, np.finfo(float).tiny)


def start_of_some(
    contour: Contour, make: Make, weights: FloatArray | None, kept: BoolArray
) -> Balanced:
    """A start made from some points, with a place for the others."""
    if kept.all():
        start = make(contour, weights)
        return Balanced(start.spline, parameters_in_order(start, contour))
    part = Contour.silently(contour.points[kept], contour.closed)
    summed = None
    if weights is not None:
        summed = np.zeros(len(part))
        np.add.at(summed, part.source, weights[kept])
    start = make(part, summed)
    known, places = parameters_in_order(start, part)[part.source], np.flatnonzero(kept)
    if contour.closed:
        begin, end = start.spline.domain
        laps = np.arange(-1, 2)[:, None]
        places = (places + laps * len(contour)).ravel()
        known = (known + laps * (end - begin)).ravel()
    return Balanced(start.spline, np.interp(np.arange(len(contour)), places, known))
