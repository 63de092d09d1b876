"""What the points of a contour can show: their noise, and a band about what lies behind them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis.noise import noise_level
from shapespline.validation import median

if TYPE_CHECKING:
    from shapespline.values import Contour

# Clean data cannot show, and nobody can see, less than this part of the median distance between
# points; the length lies within these parts of the box diagonal.
SAMPLING_PART = 0.1
BOX_PARTS = (0.0005, 0.001)
# A band about the data is so many standard deviations wide. Noise that the source knows, a
# picture's, is bounded and alike from point to point: three are enough.
NOISE_BAND, ACCURACY_BAND = 4.0, 3.0


class Resolution(NamedTuple):
    """What the points of a contour can show, data units.

    ``noise`` is the standard deviation across the outline; ``band`` a distance within which every
    point lies of the outline behind them; ``clean`` whether the sampling or the source sets it,
    and not the noise.
    """

    noise: float
    band: float
    clean: bool


def resolution(contour: Contour) -> Resolution:
    """What the points of a contour can show.

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
    noise = noise_level(contour)
    step = median(np.diff(contour.arc_length))
    least, most = (part * contour.box_diagonal for part in BOX_PARTS)
    floor = min(max(SAMPLING_PART * step, least), most)
    known = contour.accuracy or 0.0
    if noise <= known:
        return Resolution(noise, max(floor, ACCURACY_BAND * known), True)
    band = max(floor, NOISE_BAND * noise)
    return Resolution(noise, band, band == floor)
