"""How sure each point is where noise is not the same everywhere: rough stretches, stray points.

Local noise is what cubics through neighbours leave in windows about a point (`noise`). A stray
point is one that neither the points before it, nor those behind it, nor both tell, or one that lies
beside a line through points on both sides.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
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
# sides, tells where it is; that it is lost a line through three before it and two behind it, or the
# other way round, tells, too (ANA-22).
LINE, PARABOLA = np.arange(1, 6), np.array([-3, -2, -1, 1, 2, 3])
ACROSS = np.array([-3, -2, -1, 1, 2])
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

    Strays near each other hide each other, so what is told without those that were found counts.
    But two side by side are what was drawn: not for the neighbours of a stray.
    """
    n = len(points)
    off, kept, beside = np.zeros(n), np.arange(n), np.zeros(n, dtype=bool)
    while True:
        told = ~beside[kept]
        off[kept[told]] = _off_at_once(points[kept], closed, noise[kept])[told]
        goes = off[kept] > LOST
        if not goes.any() or len(kept) - goes.sum() < FEWEST_POINTS:
            return off
        next_to = kept[goes, None] + [-1, 1]
        beside[next_to % n if closed else next_to.clip(0, n - 1)] = True
        kept = kept[~goes]


def _off_at_once(points: FloatArray, closed: bool, noise: FloatArray) -> FloatArray:
    """The same among these points: at least, but for what a line through both sides tells."""
    n, least = len(points), np.full(len(points), np.inf)
    told = _with_all(PARABOLA, n, closed)
    least[told], _ = _told(points, told, PARABOLA, 2, noise)
    for offsets in (-LINE, LINE):
        told = _with_all(offsets, n, closed)
        least[told] = np.minimum(least[told], _off_line(points, told, offsets, noise))
    for offsets in (ACROSS, -ACROSS):
        told = _with_all(offsets, n, closed)
        off, rest = _told(points, told, offsets, 1, noise)
        lost = (rest <= FITS) & (off > LOST)
        least[told[lost]] = np.maximum(least[told[lost]], off[lost])
    return least


def _off_line(
    points: FloatArray, told: IntArray, offsets: IntArray, noise: FloatArray
) -> FloatArray:
    """How far points are off a line through those on one side.

    One of these that is not next to it may be a stray. 0 where they are on no line: bends leave as
    much.
    """
    off, rest = _told(points, told, offsets, 1, noise)
    again = np.flatnonzero(rest > FITS)
    if not len(again):
        return off
    off[again], rest = 0.0, np.full(len(again), FITS)
    for k in range(1, len(offsets)):
        others, one = np.delete(offsets, k), (told[again] + offsets[k]) % len(points)
        other, left = _told(points, told[again], others, 1, noise)
        away, _ = _told(points, one, others - offsets[k], 1, noise)
        fits = (left < rest) & (away > LOST)
        rest[fits], off[again[fits]] = left[fits], other[fits]
    return off


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
    rows = _least_squares(tuple(offsets.tolist()), degree)
    off, rest = np.empty(len(told)), np.empty(len(told))
    _kernels.told_by_others(points, told, offsets, rows, noise, off, rest)
    return off, rest


@cache
def _least_squares(offsets: tuple[int, ...], degree: int) -> FloatArray:
    """What makes the coefficients of a polynomial of what is at some offsets."""
    rows = np.linalg.pinv(np.vander(np.array(offsets, dtype=float), degree + 1))
    return np.ascontiguousarray(rows)
