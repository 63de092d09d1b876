"""How much of each pixel closed outlines cover, exactly, for the pixels that they pass through.

Every edge is cut at the lines between pixels. What is left of it lies in one pixel, which it covers
to its right by its height times its mean distance from the right side, and all pixels farther to
the right by its height: signed areas, added up along each row (as font rasterisers do).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray, IntArray


class Covered(NamedTuple):
    """How much of each pixel is covered.

    Attributes
    ----------
    keys : ndarray of int, shape (n,)
        Pixels on the border, row times width plus column, ascending.
    part : ndarray, shape (n,)
        How much of each.
    behind : ndarray, shape (n,)
        How much of those behind it in its row, up to the next one.
    """

    keys: IntArray
    part: FloatArray
    behind: FloatArray

    def at(self, row: IntArray, column: IntArray, width: int) -> FloatArray:
        """The part of some pixels that is covered."""
        key = row * width + column
        place = np.searchsorted(self.keys, key, "right") - 1
        before = self.keys[np.maximum(place, 0)]
        same_row = (place >= 0) & (before // width == row)
        covered = np.where(before == key, self.part[place], self.behind[place])
        return np.where(same_row, covered, 0.0)


def border_coverage(outlines: Sequence[FloatArray], height: int, width: int) -> Covered:
    """How much of each pixel is covered.

    Parameters
    ----------
    outlines : sequence of ndarray, shape (n_i, 2)
        Closed, y up, ink on the left; none leaves the picture.
    height, width : int
        Of the picture, pixels.

    Examples
    --------
    >>> square = np.array([(0.5, 0.25), (2.0, 0.25), (2.0, 1.0), (0.5, 1.0)])
    >>> keys, part, behind = border_coverage([square], 1, 3)
    >>> keys.tolist(), part.tolist(), behind.tolist()
    ([0, 1, 2], [0.375, 0.75, 0.0], [0.75, 0.75, 0.0])
    """
    begins = np.concatenate(outlines)
    ends = np.concatenate([np.roll(points, -1, axis=0) for points in outlines])
    for axis in (0, 1):
        begins, ends = _cut(begins, ends, axis)
    middle = 0.5 * (begins + ends)
    column = np.clip(np.floor(middle[:, 0]), 0, width - 1).astype(np.int64)
    row = np.clip(np.floor(height - middle[:, 1]), 0, height - 1).astype(np.int64)
    # Where the ink is on the left and y up, an edge that runs down has it on its right.
    drop = begins[:, 1] - ends[:, 1]
    keys, place = np.unique(row * width + column, return_inverse=True)
    partly = np.bincount(place, drop * (column + 1 - middle[:, 0]), len(keys))
    beyond = np.cumsum(np.bincount(place, drop, len(keys)))
    # From the start of its row: all edges before it, less those of the rows above.
    first = np.searchsorted(keys, keys // width * width)
    before = np.concatenate([[0.0], beyond])
    return Covered(keys, before[:-1] - before[first] + partly, beyond - before[first])


def _cut(begins: FloatArray, ends: FloatArray, axis: int) -> tuple[FloatArray, FloatArray]:
    """Edges cut where a coordinate is whole, edge by edge."""
    a, b = begins[:, axis], ends[:, axis]
    low, high = np.minimum(a, b), np.maximum(a, b)
    first = np.floor(low).astype(np.int64) + 1
    count = np.maximum(np.ceil(high).astype(np.int64) - first, 0)
    edge = np.repeat(np.arange(len(begins)), count + 1)
    start = np.concatenate([[0], np.cumsum(count + 1)[:-1]])
    number = np.arange(len(edge)) - start[edge]
    rising = (b > a)[edge]
    at = np.where(rising, first[edge] + number - 1, first[edge] + count[edge] - number)
    span = (b - a)[edge]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(number == 0, 0.0, (at - a[edge]) / span)
    following = np.append(share[1:], 1.0)
    following[np.append(number[1:] == 0, True)] = 1.0
    along = (ends - begins)[edge]
    return begins[edge] + share[:, None] * along, begins[edge] + following[:, None] * along
