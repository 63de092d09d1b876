"""Light that falls off over a picture, told by its ground, and the picture without it.

A lens darkens the corners, a lamp the far side; what is seen is the print times the light on it.
Where most of the rim is ground, and even blocks of its colour follow one smooth function, in all
channels alike, all pixels are divided by that: level lines lie half-way again, and colours are
those of the print.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.tracing.ground import POWERS, Grid, SmoothGround
from shapespline.tracing.layer import strips

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import BoolArray, FloatArray, IntArray

# Blocks along the longer side, least pixels along theirs, and how many of those are looked at.
BLOCKS, LEAST_SIZE, LOOKED_AT = 48, 4, 8
# A block is even if what it holds spreads by no more than this part of the full scale, or so many
# times as far as blocks usually do; of the ground, if its channels are those of the rim times one
# factor, this nearly, and that is no smaller than this, nor larger than its inverse (TRC-21).
EVEN, EVEN_USUAL, TINT, DARKEST = 0.06, 2.5, 0.08, 0.4
# Blocks belong to the ground that are off it by no more than so many deviations, or this part.
DEVIATIONS, LEAST_OFF, ROUNDS = 4.0, 0.01, 8
# Light is told if its logarithm changes by more than this, and less than that; if blocks are off
# it by no more than a part of that, and this much; if so many of the even ones show it, so many in
# each quarter, and so many at the rim are ground (TRC-21).
LEAST_CHANGE, MOST_CHANGE, OFF_PART, MOST_OFF = 0.03, 0.7, 0.05, 0.015
MOST_EVEN, QUARTER, MOST_RIM = 0.3, 0.15, 0.5


def without_falloff(pixels: NDArray[Any]) -> NDArray[Any] | None:
    """The picture as an even light shows it; None where no light is told.

    Parameters
    ----------
    pixels : ndarray, shape (h, w) or (h, w, 3)
        Of 0 (black) to the full scale.
    """
    light = _falloff(pixels)
    if light is None:
        return None
    even = np.empty(pixels.shape, pixels.dtype)
    whole = pixels.dtype.kind == "u"
    most = np.iinfo(pixels.dtype).max if whole else np.inf
    columns = np.arange(pixels.shape[1])[None, :]
    for rows in strips(pixels.shape):
        factor = np.exp(-light(np.arange(pixels.shape[0])[rows, None], columns))
        part = pixels[rows] * (factor if pixels.ndim == 2 else factor[..., None])
        even[rows] = np.rint(np.minimum(part, most)) if whole else part
    return even


def _falloff(pixels: NDArray[Any]) -> SmoothGround | None:
    """Logarithm of the light, 0 where it is brightest; None where none is told."""
    size = max(max(pixels.shape[:2]) / BLOCKS, LEAST_SIZE)
    grid = Grid.of(pixels.shape, size)
    n_rows, n_columns = (len(edges) - 1 for edges in grid)
    rim = np.ones((n_rows, n_columns), dtype=bool)
    rim[1:-1, 1:-1] = False
    if rim.sum() < 2 * len(POWERS):
        return None
    full = float(np.iinfo(pixels.dtype).max) if pixels.dtype.kind == "u" else 1.0
    first, _ = _blocks(pixels, grid, rim)
    if not np.ptp(first, axis=0).max() > LEAST_CHANGE * DARKEST * full:  # most are flat
        return None
    at_rim = rim.ravel()
    middle, spread = _blocks(pixels, grid, np.ones_like(rim))
    even = spread <= max(EVEN * full, EVEN_USUAL * float(np.median(spread)))
    if not even[at_rim].any():
        return None
    # Channels of each block, of the rim's.
    part = middle / np.maximum(np.median(middle[at_rim & even], axis=0), 1e-2 * full)
    mean = np.maximum(part.mean(axis=1), 1e-9)
    same = np.abs(part / mean[:, None] - 1.0).max(axis=1) < TINT
    ground = even & same & (mean > DARKEST) & (mean < 1 / DARKEST)
    if ground[at_rim].sum() < MOST_RIM * at_rim.sum():
        return None
    return _through(np.log(mean), ground, ground & at_rim, even, grid)


def _through(
    value: FloatArray, ground: BoolArray, first: BoolArray, even: BoolArray, grid: Grid
) -> SmoothGround | None:
    """The light through blocks that may be ground, told from the first of them on."""
    used = first
    for _ in range(ROUNDS):
        if used.sum() < 2 * len(POWERS):
            return None
        found = SmoothGround.through(value, used, grid)
        fitted = grid.powers @ found.coefficients
        off = np.abs(value - fitted)
        spread = 1.4826 * float(np.median(off[used]))
        kept = ground & (off <= max(DEVIATIONS * spread, LEAST_OFF))
        if (kept == used).all():
            break
        used = kept
    change = float(np.ptp(fitted))
    halves = np.array_split(used.reshape(len(grid.rows) - 1, -1), 2)
    quarters = [part.mean() for half in halves for part in np.array_split(half, 2, axis=1)]
    told = LEAST_CHANGE < change < MOST_CHANGE and spread <= min(OFF_PART * change, MOST_OFF)
    if not (told and used.sum() >= MOST_EVEN * even.sum() and min(quarters) >= QUARTER):
        return None
    brightest = np.zeros(len(POWERS))
    brightest[0] = fitted.max()
    return replace(found, coefficients=found.coefficients - brightest)


def _blocks(pixels: NDArray[Any], grid: Grid, which: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Median of the pixels of some blocks, channel by channel, and how far most of them spread."""
    rows, columns = (_looked_at(edges) for edges in grid)
    r, c = np.nonzero(which)
    seen = pixels[rows[r][:, :, None], columns[c][:, None, :]]
    seen = np.sort(seen.reshape(len(r), LOOKED_AT**2, -1), axis=1).astype(np.float64)
    tenth = LOOKED_AT**2 // 10
    return seen[:, LOOKED_AT**2 // 2], (seen[:, -1 - tenth] - seen[:, tenth]).max(axis=1)


def _looked_at(edges: IntArray) -> IntArray:
    """Rows or columns of each block that are looked at."""
    shares = (np.arange(LOOKED_AT) + 0.5) / LOOKED_AT
    return np.asarray((edges[:-1, None] + shares * np.diff(edges)[:, None]).astype(np.int64))
