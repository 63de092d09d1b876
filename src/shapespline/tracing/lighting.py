"""Uneven lighting: the ground of a picture as it would be without ink, and the picture on it.

Light falls off smoothly: towards the corners (vignette), or away from a lamp. What the ground is
worth is read from blocks of pixels, each by its lightest tenth (its darkest, where the ink is
light); a polynomial through them leaves out blocks that ink fills. Dark ink is a part of the light
that falls on it, so the picture is divided by its ground; from light ink the ground is subtracted.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.tracing.ground import POWERS, Grid, SmoothGround
from shapespline.tracing.layer import Layer, places_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.tracing.layer import Key
    from shapespline.typing import FloatArray, IntArray

    # What the ground is worth at rows and columns.
    Ground: TypeAlias = Callable[[IntArray, IntArray], FloatArray]

# Blocks along the longer side, and the part of a block's pixels that show its ground.
BLOCKS, GROUND_PART = 48, 0.1
# How often blocks of ink are told anew, and how many median deviations below the ground they are.
ROUNDS, BELOW = 8, 3.0
# A level line runs along an edge if the values across it differ by this part of the contrast within
# so many pixels. Lines of which more than this part runs along none show that one level is wrong;
# another way is better if it leaves less than this, and less than this part of what there was
# (TRC-17).
EDGE, REACH, ALONG_NOTHING, BETTER = 0.35, 3, 0.12, 0.6
# An edge of ink is at least so many steps of the picture's whole values high: what a ground leaves
# of one or two is how its light was rounded (TRC-41).
LEAST_STEPS = 3


def part_along_nothing(field: Field, found: Crossings) -> float:
    """Part of the level lines that runs along no edge of the picture."""
    differences = _differences(field.coverage, found, field.shape)
    return float((differences < EDGE).mean()) if len(differences) else 0.0


def are_steps(values: Layer, found: Crossings) -> bool:
    """Whether most edges are no higher than what rounding to whole values leaves of light."""
    if not values.is_whole:
        return False
    height, width = values.shape

    def near(row: IntArray, column: IntArray) -> FloatArray:
        inside = np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)
        return values[inside].astype(np.float64)

    differences = _differences(near, found, values.shape)
    return len(differences) > 0 and float(np.median(differences)) < LEAST_STEPS


def _differences(
    at: Callable[[IntArray, IntArray], FloatArray], found: Crossings, shape: tuple[int, int]
) -> FloatArray:
    """By how much values differ near crossings inside the picture, of many at every so many."""
    inner = np.flatnonzero(~found.at_rim(*shape))
    part = found.chosen(inner[:: len(inner) // 200_000 + 1])
    offsets, row, column = np.arange(1 - REACH, REACH + 1), part.row[:, None], part.column[:, None]
    # Along rows and along columns: noise lets the line of a level edge cross both.
    across, along = at(row + offsets, column), at(row, column + offsets)
    return np.maximum(np.ptp(across, axis=1), np.ptp(along, axis=1))


class EvenlyLit(Layer):
    """A picture on an even ground: 1 where the ink is dark, 0 where it is light."""

    def __init__(self, values: Layer, light: bool, ground: Ground) -> None:
        super().__init__(values)
        self._light, self._ground = light, ground

    def __getitem__(self, key: Key) -> FloatArray:
        """Values of a part, as numpy indexes it."""
        ground = self._ground(*places_of(key, self.shape))
        values = super().__getitem__(key)
        return np.asarray(values - ground if self._light else values / ground, dtype=np.float64)


def evenly_lit(values: Layer, light: bool, window: float | None = None) -> EvenlyLit:
    """The picture on its ground.

    Parameters
    ----------
    values : Layer
    light : bool
        Whether the ink is lighter than the ground.
    window : float, optional
        Pixels within which there is ground everywhere, and over which its light may change; if not
        given, it changes slowly over the whole picture.

    Raises
    ------
    InvalidInputError
        If the window is smaller than 4 pixels.
    """
    height, width = values.shape
    size = max(height, width) / BLOCKS if window is None else 0.5 * window
    if window is not None and not window >= 4:
        raise InvalidInputError(f"local must be a window of at least 4 pixels, got {window}")
    grid = Grid.of((height, width), size)
    quantile = GROUND_PART if light else 1.0 - GROUND_PART
    blocks = np.array(
        [
            [np.quantile(values[a:b, c:d], quantile) for c, d in pairwise(grid.columns)]
            for a, b in pairwise(grid.rows)
        ]
    )
    of_blocks = _smooth_ground if window is None else _near_ground
    ground = of_blocks(blocks, grid, light)
    least = 1e-3 * float(blocks.max()) + 1e-12
    if light:
        return EvenlyLit(values, light, ground)
    return EvenlyLit(values, light, lambda rows, columns: np.maximum(ground(rows, columns), least))


def _smooth_ground(blocks: FloatArray, grid: Grid, light: bool) -> Ground:
    """A polynomial through the blocks of ground."""
    seen, powers = blocks.ravel(), grid.powers
    used = np.ones(len(seen), dtype=bool)
    for _ in range(ROUNDS):
        ground = SmoothGround.through(seen, used, grid)
        off = (seen - powers @ ground.coefficients) * (-1.0 if light else 1.0)
        spread = 1.4826 * float(np.median(np.abs(off[used]))) + 1e-9 * float(np.ptp(seen))
        kept = off > -BELOW * spread
        if kept.sum() < 2 * len(POWERS) or (kept == used).all():
            break
        used = kept
    return ground


def _near_ground(blocks: FloatArray, grid: Grid, light: bool) -> Ground:
    """Between blocks that each take the best ground of their neighbours."""
    from scipy import ndimage

    best = (ndimage.minimum_filter if light else ndimage.maximum_filter)(blocks, 3, mode="nearest")
    best = ndimage.gaussian_filter(best, 0.7, mode="nearest")

    def ground(rows: IntArray, columns: IntArray) -> FloatArray:
        at = [
            np.interp(index + 0.5, middle, np.arange(len(middle)))
            for index, middle in zip((rows, columns), grid.centres, strict=True)
        ]
        return np.asarray(ndimage.map_coordinates(best, np.broadcast_arrays(*at), order=1))

    return ground
