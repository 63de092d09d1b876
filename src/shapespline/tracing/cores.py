"""Cores of strokes: pixels that tell the colour of a stroke too thin to have even ones.

They are farther from the ground than the eight pixels around them. So what lies beside a stroke is
mixed of its ink and the ground, and never of a third colour that happens to lie between them.
"""

from __future__ import annotations

from itertools import permutations
from typing import TYPE_CHECKING

import numpy as np

from shapespline.tracing.mixtures import MIXED, nearest_color, off_mixture
from shapespline.tracing.told import EVEN, Told

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import BoolArray, FloatArray, IntArray

# Even pixels within so many pixels are nearby.
NEARBY = 2
# Colours are no shades of each other from here (root mean square over the channels, of 255).
APART = 14.0
# A stroke that may be mixed with an ink so near is a paler part of it (TRC-34).
BESIDE = 4
SQUARE = np.array([(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)])


def with_cores(pixels: NDArray[np.uint8], even: Told, colors: FloatArray) -> Told:
    """Told pixels with the cores of strokes.

    What is paler than an ink beside it, and may be mixed with it, tells none.
    """
    found = []
    for where in even.others():
        nearby = even.around(where, NEARBY)
        own = np.flatnonzero(are_cores(pixels, where, nearby, colors))
        at = (where[0][own], where[1][own])
        label, is_full = full(pixels[at].astype(np.float64), colors)
        found.append((at[0][is_full], at[1][is_full], label[is_full], nearby[own][is_full]))
    told = even._replace(pixels=even.pixels.copy(), labels=even.labels.copy())
    for row, column, label, _ in found:
        told.pixels[row, column], told.labels[row, column] = True, label
    every = told._replace(pixels=told.pixels.copy())
    for row, column, label, nearby in found:
        beside = every.around((row, column), BESIDE)
        pale = np.zeros(len(row), dtype=bool)
        values = pixels[row, column].astype(np.float64)
        for ground, ink in permutations(range(len(colors)), 2):
            own = np.flatnonzero(nearby[:, ground] & beside[:, ink] & (label != ink))
            off, share = off_mixture(values[own], colors[ground], colors[ink])
            pale[own] |= (off <= MIXED**2 * 3) & (share < 1.0)
        told.pixels[row[pale], column[pale]] = False
    return told


def full(values: FloatArray, colors: FloatArray) -> tuple[IntArray, BoolArray]:
    """The nearest colour of each value, and whether it is a shade of it."""
    label = nearest_color(values, colors)
    return label, ((values - colors[label]) ** 2).mean(axis=1) <= APART**2


def are_cores(
    pixels: NDArray[np.uint8],
    at: tuple[IntArray, ...],
    nearby: BoolArray,
    colors: FloatArray,
) -> BoolArray:
    """Which pixels are farther from each even colour nearby than the eight around them.

    Parameters
    ----------
    pixels : ndarray of uint8, shape (h, w, 3)
    at : tuple of ndarray of int, shape (n,)
        Rows and columns of pixels.
    nearby : ndarray of bool, shape (n, k)
        Which colours are even near each; where there is none is no core.
    colors : ndarray, shape (k, 3)
    """
    height, width = pixels.shape[:2]
    found = np.asarray(nearby.any(axis=1))
    for part in np.array_split(np.arange(len(found)), len(found) // 100_000 + 1):
        row = np.clip(at[0][part, None] + SQUARE[:, 0], 0, height - 1)
        column = np.clip(at[1][part, None] + SQUARE[:, 1], 0, width - 1)
        around = pixels[row, column].astype(np.float64)
        values = pixels[at[0][part], at[1][part]].astype(np.float64)
        for k, color in enumerate(colors):
            own = np.flatnonzero(nearby[part, k] & found[part])
            way = values[own] - color
            far = np.sqrt((way**2).sum(axis=1))
            ahead = ((around[own] - color) * way[:, None]).sum(axis=2).max(axis=1)
            core = (far >= APART * np.sqrt(3)) & (ahead <= far * (far + EVEN))
            found[part[own]] = core
    return found
