"""How sure each point is where noise is not the same everywhere: rough stretches, stray points.

Local noise is what cubics through neighbours leave in windows about a point (`noise`). A stray
point is one that neither the points before it, nor those behind it, nor both tell, or one that lies
beside a line through points on both sides.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis.noise import (
    CHI_SQUARED_MEDIAN,
    FEWEST_POINTS,
    HALF_WINDOW,
    left_in_windows,
)

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour

# Windows on either side of a point that tell its noise; logarithms of that which scatter by more
# are no chance (ANA-22).
BESIDE, UNEVEN = 24, 0.3
# A line through so many points before a point, or behind it, or a parabola through so many on both
# sides, tells where it is; so does a line through those before it and the next one. Strays are
# looked for one by one in so many points on either side (ANA-22).
LINE, PARABOLA = np.arange(1, 6), np.array([-3, -2, -1, 1, 2, 3])
ACROSS, REACH = np.array([-3, -2, -1, 1, 2]), 4
# A point that is off by so many deviations is less sure, by the fourth power of how many times
# that; one that is off by more tells that there are such, and by still more nothing else
# (ANA-22).
SURE, STRAY, LOST = 2.5, 3.0, 4.0
# Points are on a line if they leave so many deviations of one (ANA-22).
FITS = 2.0
# No point is surer than that, or less sure (ANA-22).
SUREST, LEAST_SURE = 16.0, 1e-3


def precisions(contour: Contour, noise: float) -> FloatArray | None:
    """Precision of each point over that of most; None where noise is the same everywhere.

    Parameters
    ----------
    contour : Contour
    noise : float
        Its noise level, data units.

    Examples
    --------
    >>> from shapespline.values import Contour
    >>> random = np.random.default_rng(1)
    >>> points = np.column_stack([np.linspace(0, 10, 200), random.normal(0, 0.01, 200)])
    >>> precisions(Contour(points, closed=False), 0.01) is None
    True
    >>> points[60, 1] += 0.1
    >>> found = precisions(Contour(points, closed=False), 0.01)
    >>> int(found.argmin()), bool(found[60] < 0.02), float(np.median(found))
    (60, True, 1.0)
    """
    if len(contour) < FEWEST_POINTS or not noise > 0.0:
        return None
    points, closed = contour.points, contour.closed
    # A stretch may be exact.
    local = np.maximum(_local_noise(points, closed) / noise, SUREST**-0.5)
    uneven = float(np.log(np.minimum(local, SUREST**0.5)).std()) >= UNEVEN
    if not uneven:
        local = np.ones(len(points))
    found = local**-2
    off = _off(points, closed, noise * local)
    strays = off > SURE
    if not uneven and float(off.max()) < STRAY:
        return None
    found[strays] *= (SURE / off[strays]) ** 4
    found[off > LOST] = LEAST_SURE
    return np.maximum(found, LEAST_SURE)


def _local_noise(points: FloatArray, closed: bool) -> FloatArray:
    """Noise about each point: by the median of the windows beside it."""
    left = left_in_windows(points, closed)
    if closed:
        wide = np.pad(left, BESIDE, mode="wrap")
    else:
        wide = np.pad(left, BESIDE + HALF_WINDOW, mode="reflect")
    about = np.lib.stride_tricks.sliding_window_view(wide, 2 * BESIDE + 1)
    return np.asarray(np.sqrt(np.median(about, axis=1) / CHI_SQUARED_MEDIAN))


def _off(points: FloatArray, closed: bool, noise: FloatArray) -> FloatArray:
    """How far each point is from where its neighbours tell it, over their own errors.

    Strays beside each other hide each other: the one that is off by most goes first.
    """
    off, kept = np.zeros(len(points)), np.arange(len(points))
    while True:
        off[kept] = _off_at_once(points[kept], closed, noise[kept])
        wide = np.pad(off[kept], REACH, mode="wrap" if closed else "edge")
        largest = np.lib.stride_tricks.sliding_window_view(wide, 2 * REACH + 1).max(axis=1)
        left = kept[(off[kept] <= LOST) | (off[kept] < largest)]
        if len(left) == len(kept) or len(left) < FEWEST_POINTS:
            return off
        kept = left


def _off_at_once(points: FloatArray, closed: bool, noise: FloatArray) -> FloatArray:
    """The same among these points: at least, but for what a line through both sides tells.

    0 where the points before it or those behind it are on no line: bends leave as much.
    """
    least = np.full(len(points), np.inf)
    for offsets, degree in ((-LINE, 1), (LINE, 1), (PARABOLA, 2)):
        told = _with_all(offsets, len(points), closed)
        off, rest = _told(points, told, offsets, degree, noise)
        again = np.flatnonzero(rest > FITS)
        if degree == 1:
            off[again] = 0.0
        # One of them may be a stray, but two side by side are what was drawn.
        rest = np.full(len(again), FITS)
        for k in np.flatnonzero(np.abs(offsets) > 1):
            other, left = _told(points, told[again], np.delete(offsets, k), degree, noise)
            fits = left < rest
            rest[fits], off[again[fits]] = left[fits], other[fits]
        least[told] = np.minimum(least[told], off)
    for offsets in (ACROSS, -ACROSS):
        told = _with_all(offsets, len(points), closed)
        off, rest = _told(points, told, offsets, 1, noise)
        lost = (rest <= FITS) & (off > LOST)
        least[told[lost]] = np.maximum(least[told[lost]], off[lost])
    return least


def _with_all(offsets: IntArray, n: int, closed: bool) -> IntArray:
    """Indices of the points that have neighbours at all offsets."""
    index = np.arange(n)
    return index if closed else index[-min(offsets.min(), 0) : n - max(offsets.max(), 0)]


def _told(
    points: FloatArray, told: IntArray, offsets: IntArray, degree: int, noise: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """How far points are off a line or parabola through others, and what these leave of it.

    Both in deviations, the first one with the error of the curve.
    """
    vander = np.vander(offsets.astype(float), degree + 1)
    powers = np.linalg.pinv(vander)
    beside = points[(told[:, None] + offsets) % len(points)]
    found = np.einsum("ck,ikd->icd", powers, beside)
    slope, place = found[:, -2], found[:, -1]
    (x, y), (u, v) = (points[told] - place).T, slope.T
    speed = np.maximum(np.hypot(u, v), np.finfo(float).tiny)
    error = float(np.sqrt(1.0 + (powers[-1] ** 2).sum()))
    off = np.abs(x * v - y * u) / (speed * error * noise[told])
    left = beside - np.einsum("kc,icd->ikd", vander, found)
    across = (left[..., 0] * v[:, None] - left[..., 1] * u[:, None]) / speed[:, None]
    rest = np.sqrt((across**2).sum(axis=1) / (len(offsets) - degree - 1))
    return off, rest / noise[told]
