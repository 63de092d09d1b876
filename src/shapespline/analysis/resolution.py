"""What the points of a contour can show: their noise, and a band about what lies behind them."""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis.noise import left_out, scatter
from shapespline.analysis.pixel_chains import GOING_ON, STAIRS, pixel_of
from shapespline.validation import median

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# Clean data cannot show, and nobody can see, less than this part of the median distance between
# points; the length lies within these parts of the box diagonal.
SAMPLING_PART = 0.1
BOX_PARTS = (0.0005, 0.001)
# What clean points tell of each other is not known to less than this part of the box diagonal
# (FIT-36).
LEAST_PART, TOLD_BAND = 0.0001, 3.0
# What lies between points is known 16 times as well as points that are left out; a quarter of that
# allows for places that bend more (FIT-36).
TOLD_PART = 0.25
# Of vertices that were drawn none is left out: the band is this part of the shortest edge.
VERTEX_PART = 0.01
# A band about the data is so many standard deviations wide. Noise that the source knows, a
# picture's, is bounded and alike from point to point: three are enough.
NOISE_BAND, ACCURACY_BAND = 4.0, 3.0
# Bends of a few pixels leave so many times a picture's accuracy (FIT-37).
LETTERS = 4.0


# Steps of an outline are seen between means of so many points, a twentieth of few. They are short
# below this part of the noise: points that are averaged show less of what they are on (FIT-23,
# FIT-26).
SMOOTHED, FEWEST_AVERAGED, SHORT = 9, 60, 0.8


class Resolution(NamedTuple):
    """What the points of a contour can show, data units.

    ``noise`` is the standard deviation across the outline; ``band`` a distance within which every
    point lies of the outline behind them; ``clean`` whether the sampling or the source sets it,
    and not the noise; ``told`` a distance within which clean points tell each other, and so what
    lies between them, where that is less than the band.
    """

    noise: float
    band: float
    clean: bool
    told: float = np.inf


def resolution(contour: Contour, *, of_picture: bool = False) -> Resolution:
    """What the points of a contour can show.

    What is left of small letters ``of_picture`` is no noise, up to four times its accuracy.

    Examples
    --------
    >>> from shapespline.values import Contour
    >>> angle = 2 * np.pi * np.arange(400) / 400
    >>> circle = np.column_stack([np.cos(angle), np.sin(angle)])
    >>> resolution(Contour(circle, closed=True)).clean
    True
    >>> shaken = circle + np.random.default_rng(1).normal(0, 0.01, circle.shape)
    >>> resolution(Contour(shaken, closed=True)).clean
    False
    """
    noise, of_vertices = scatter(contour)
    steps = np.diff(contour.arc_length)
    if of_vertices:
        return Resolution(noise, VERTEX_PART * float(steps.min()), True)
    step = median(steps)
    least, most = (part * contour.box_diagonal for part in BOX_PARTS)
    floor = min(max(SAMPLING_PART * step, least), most)
    if pixel := pixel_of(contour):
        band = max(floor, NOISE_BAND * max(noise, STAIRS * pixel))
        return Resolution(GOING_ON * pixel, band, False)
    known = contour.accuracy or 0.0
    if noise <= (LETTERS if of_picture else 1.0) * known:
        return Resolution(noise, max(floor, ACCURACY_BAND * noise), True)
    band = max(floor, NOISE_BAND * noise)
    if band > floor:
        return Resolution(noise, band, False)
    told = max(LEAST_PART * contour.box_diagonal, TOLD_BAND * noise, TOLD_PART * left_out(contour))
    return Resolution(noise, band, True, min(band, told))


def means_of(points: FloatArray, width: int) -> FloatArray:
    """Means of so many neighbours each; the last one of those that are left over, too.

    Examples
    --------
    >>> means_of(np.array([(0.0, 0.0), (2.0, 0.0), (4.0, 2.0), (6.0, 2.0), (8.0, 2.0)]), 2).tolist()
    [[1.0, 0.0], [6.0, 2.0]]
    """
    begins = np.arange(0, len(points) - width + 1, width)
    counts = np.diff(np.append(begins, len(points)))
    return np.add.reduceat(points, begins, axis=0) / counts[:, None]


def neighbours_to_average(points: FloatArray, closed: bool, deviation: float) -> int:
    """How many neighbours are averaged for steps longer than their noise, 1 for none.

    The arc length of dense noisy points is the noise's, not the outline's, and so are the points of
    a curve that are nearest to them.
    """
    k = min(SMOOTHED, len(points) // 20)
    if len(points) <= FEWEST_AVERAGED:
        return 1
    wide = np.concatenate([points[-k:], points, points[:k]]) if closed else points
    sums = np.cumsum(wide, axis=0)
    soft = (sums[k:] - sums[:-k]) / k
    step = median(np.hypot(*(soft[k:] - soft[:-k]).T)) / k
    if step >= SHORT * deviation:
        return 1
    return ceil((deviation / step) ** (2 / 3))
