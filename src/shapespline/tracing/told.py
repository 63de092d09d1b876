"""Told pixels: which pixels of a picture tell a colour of the palette by themselves, and which.

Those are even ones, which hardly differ from their eight neighbours. All others are mixtures.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.layer import strips
from shapespline.tracing.mixtures import nearest_color

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from shapespline.typing import BoolArray, FloatArray, IntArray

# Neighbours of an even pixel differ by no more, of 255 in each channel.
EVEN = 10
# Pixels that are looked at together.
TOGETHER = 1_000_000


class Told(NamedTuple):
    """Pixels that tell a colour.

    Attributes
    ----------
    pixels : ndarray of bool, shape (h, w)
        Which they are.
    labels : ndarray of int8, shape (h, w)
        Index of the colour that each tells.
    n_colors : int
        How many colours there are.
    """

    pixels: BoolArray
    labels: NDArray[np.int8]
    n_colors: int

    @classmethod
    def by_even(cls, picture: NDArray[np.uint8], even: BoolArray, colors: FloatArray) -> Told:
        """By even pixels, each the nearest of some colours."""
        labels = np.zeros(even.shape, dtype=np.int8)
        for rows in strips(even.shape, TOGETHER):
            own = even[rows]
            labels[rows][own] = nearest_color(picture[rows][own].astype(np.float64), colors)
        return cls(even, labels, len(colors))

    def others(self) -> Iterator[tuple[IntArray, IntArray]]:
        """Rows and columns of pixels that tell none, a strip at a time."""
        for rows in strips(self.pixels.shape, TOGETHER):
            row, column = np.nonzero(~self.pixels[rows])
            if len(row):
                yield row + rows.start, column

    def around(self, at: tuple[IntArray, IntArray], reach: int) -> BoolArray:
        """Which colours are told within so many pixels of some of a strip, shape (n, n_colors)."""
        if len(at[0]) == 0:
            return np.zeros((0, self.n_colors), dtype=bool)
        above = max(int(at[0].min()) - reach, 0)
        seen = slice(above, int(at[0].max()) + 1 + reach)
        # A bit for each colour.
        label = self.labels[seen].astype(np.uint64)
        bits = np.where(self.pixels[seen], np.uint64(1) << label, np.uint64(0))
        for side in (bits, bits.T):
            alone = side.copy()
            for step in range(1, reach + 1):
                side[step:] |= alone[:-step]
                side[:-step] |= alone[step:]
        near = bits[at[0] - above, at[1]]
        known = (near[:, None] >> np.arange(self.n_colors, dtype=np.uint64)) & np.uint64(1)
        return known.astype(bool)


def even_pixels(pixels: NDArray[np.uint8]) -> BoolArray:
    """Pixels that hardly differ from their eight neighbours."""
    from scipy import ndimage

    even = np.empty(pixels.shape[:2], dtype=bool)
    for rows in strips(even.shape, TOGETHER):
        above = max(rows.start - 1, 0)
        seen = pixels[above : rows.stop + 1]
        spread = [
            ndimage.maximum_filter(channel, 3) - ndimage.minimum_filter(channel, 3)
            for channel in np.moveaxis(seen, -1, 0)
        ]
        own = slice(rows.start - above, rows.stop - above)
        even[rows] = np.max(spread, axis=0)[own] <= EVEN
    return even
