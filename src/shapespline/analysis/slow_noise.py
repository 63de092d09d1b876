"""Noise that goes on from point to point, as filters of a scanner leave it, or drifts of a hand.

Neighbours are off by about as much as each other, so cubics through them leave less of it than
those through every so many-th point (`noise`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis.noise import left_in_windows
from shapespline.validation import smallest_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# The part of the windows that tells the noise, few enough for bends and corners, and a chi-squared
# variable with 3 degrees of freedom is below that in so many cases (ANA-22).
QUIET, CHI_SQUARED_QUIET = 0.3, 1.423652
# Of fewer points windows of every second one are as long as what bends; of more, what bends leave
# grows by so much faster, and faster, with the distance (ANA-22).
FEWEST, STEADY = 200, 1.05
# Where the quiet windows leave less than that part of the noise they have none to tell (ANA-23).
UNLIKE = 0.5
# Noise at twice the distance that is so many times as large is no chance, and what grows by more
# than that since it was told last is told again; over more steps, or more times what neighbours
# tell, bends do (ANA-22).
SLOW, STILL, MOST_APART, LARGEST = 1.15, 1.08, 5, 4.0


def slow_noise(contour: Contour, level: float) -> Iterator[tuple[float, int]]:
    """Standard deviations of noise that goes on over so many points; none where it does not.

    Parameters
    ----------
    contour : Contour
    level : float
        Its noise level, data units.

    Examples
    --------
    >>> from shapespline.values import Contour
    >>> random = np.random.default_rng(1)
    >>> noise = random.normal(0, 0.01, 400)
    >>> x = np.linspace(0, 40, 400)
    >>> list(slow_noise(Contour(np.column_stack([x, noise]), closed=False), 0.01))
    []
    >>> noise = np.convolve(noise, np.ones(3) / 3, mode="same")
    >>> shaken = Contour(np.column_stack([x, noise]), closed=False)
    >>> [apart for _, apart in slow_noise(shaken, 0.004)]
    [2, 3]
    """
    points, closed = contour.points, contour.closed
    if len(points) < FEWEST:
        return
    noise = [_noise_of(points, closed, apart) for apart in (1, 2, 3)]
    if noise[0] < UNLIKE * level or noise[1] <= SLOW * noise[0]:
        return
    if noise[2] * noise[0] > STEADY * noise[1] ** 2:
        return
    last = noise[0]
    for apart in range(2, MOST_APART + 1):
        if apart > len(noise):
            noise.append(_noise_of(points, closed, apart))
        wider = noise[apart - 1]
        if wider > LARGEST * noise[0]:
            return
        if wider > STILL * last:
            yield wider, apart
            last = wider


def _noise_of(points: FloatArray, closed: bool, apart: int) -> float:
    """What cubics through every so many-th point leave."""
    left = [left_in_windows(points[first::apart], closed) for first in range(apart)]
    return float(np.sqrt(smallest_of(np.concatenate(left), QUIET) / CHI_SQUARED_QUIET))
