"""Where the border of the ink passes between pixel centres, and how the crossings hang together.

Marching squares (Lorensen and Cline 1987, in the plane) on the signs alone: the picture stays as
it is and nothing as large as it is made of floats.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.errors import DegenerateContourError
from shapespline.monitor import silent
from shapespline.tracing.layer import strips
from shapespline.tracing.threads import ink_and_threads, is_noise

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.monitor import Say
    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray, IntArray

# What the ink of a thread has over a half at least: its outline needs some width to begin with.
BARELY = 0.01
# Where pixels touch by a corner, what there is less of so many pixels around needs less to be one:
# TRC-05.
MINORITY, AROUND = 1.15, 2
# The corners of a cell are numbered 1 (upper left), 2 (upper right), 4 (lower right), 8 (lower
# left), its sides 0 (upper), 1 (right), 2 (lower), 3 (left). By the sum of the corners that are
# ink: the side where the line comes in and the one where it goes out, ink on its left.
WAYS = {
    1: (3, 0), 2: (0, 1), 3: (3, 1), 4: (1, 2), 6: (0, 2), 7: (3, 2), 8: (2, 3),
    9: (2, 0), 11: (2, 1), 12: (1, 3), 13: (1, 0), 14: (0, 3),
}  # fmt: skip
# Two opposite corners are ink: two lines, around ink that is apart or ink that is joined.
APART = {5: ((3, 0), (1, 2)), 10: ((0, 1), (2, 3))}
JOINED = {5: ((1, 0), (3, 2)), 10: ((0, 3), (2, 1))}


class Crossings(NamedTuple):
    """Pairs of neighbouring pixels, one of them ink and the other not.

    Attributes
    ----------
    row, column : ndarray of int, shape (n,)
        The left or upper pixel of each pair; -1 lies outside the picture.
    upright : ndarray of bool, shape (n,)
        Whether the two lie one above the other; else side by side.
    ink_first : ndarray of bool, shape (n,)
        Whether the left or upper one is the ink.
    loops : list of ndarray of int
        Crossings along each outline, ink on the left for who walks there with y up.
    """

    row: IntArray
    column: IntArray
    upright: BoolArray
    ink_first: BoolArray
    loops: list[IntArray]

    def chosen(self, index: IntArray) -> Crossings:
        """Some of them, without their order."""
        columns = self.row[index], self.column[index], self.upright[index], self.ink_first[index]
        return Crossings(*columns, [])

    def at_rim(self, height: int, width: int) -> BoolArray:
        """Which of them lie between the picture and what is outside."""
        last = np.where(self.upright, self.row == height - 1, self.column == width - 1)
        first = np.where(self.upright, self.row < 0, self.column < 0)
        return np.asarray(first | last)

    def excesses(self, field: Field) -> tuple[FloatArray, FloatArray]:
        """What the first and the second pixel have over a half; at least a little for ink."""
        first = field.coverage(self.row, self.column) - 0.5
        second = field.coverage(self.row + self.upright, self.column + ~self.upright) - 0.5
        sign = np.where(self.ink_first, 1.0, -1.0)
        first = np.where(sign * first > 0, first, sign * BARELY)
        return first, np.where(sign * second < 0, second, -sign * BARELY)

    def places(self, height: int, shares: FloatArray) -> FloatArray:
        """Points, y up, a share of the way from the first pixel's centre to the second's."""
        x = self.column + 0.5 + np.where(self.upright, 0.0, shares)
        y = height - (self.row + 0.5 + np.where(self.upright, shares, 0.0))
        return np.column_stack([x, y])


def crossings(field: Field, say: Say = silent) -> Crossings:
    """Crossings of the border of the ink; what touches the rim is closed along it.

    Parameters
    ----------
    field : Field
    say : callable
        Told how far it is.

    Raises
    ------
    DegenerateContourError
        If there are so many that the picture is noise.
    """
    height, width = field.shape
    found: list[tuple[NDArray[Any], ...]] = []
    count = 0
    for rows in strips((height + 1, width)):
        if rows.start:
            say(f"looking for edges, row {rows.start} of {height}")
        found.append(_of_strip(field, rows))
        count += len(found[-1][0]) + len(found[-1][1])
        if is_noise(count, height * width):
            looked_at = 2 * min(rows.stop, height) * width
            raise DegenerateContourError(
                f"{count} of {looked_at} pairs of neighbouring pixels differ: the picture is noise"
                " or a pattern as fine as its pixels; blur it, scale it down or choose another"
                " level"
            )
    say(f"following {count} crossings")
    beside, below, ink_beside, ink_below, cells, codes = map(
        np.concatenate, zip(*found, strict=True)
    )
    found.clear()
    row, column = np.concatenate([np.stack(np.divmod(beside, width + 1)),
                                  np.stack(np.divmod(below, width + 2))], axis=1)  # fmt: skip
    numbers = np.concatenate([beside, (height + 2) * (width + 1) + below])
    return Crossings(
        row - 1,
        column - 1,
        np.arange(count) >= len(beside),
        np.concatenate([ink_beside, ink_below]),
        _loops(_following(cells, codes, numbers, field)),
    )


def _of_strip(field: Field, rows: slice) -> tuple[NDArray[Any], ...]:
    """What lies in some rows of the picture with a rim around it.

    Crossings side by side, and one above the other; for each whether its first pixel is ink; cells
    that something crosses, and which of their corners are ink.
    """
    height, width = field.shape
    inner = slice(max(rows.start - 1, 0), min(rows.stop, height))
    above, under = int(rows.start == 0), int(rows.stop > height)
    padded = np.pad(ink_and_threads(field, inner), ((above, under), (1, 1)))
    code = padded[:-1, :-1].astype(np.uint8)
    for corner, bit in ((padded[:-1, 1:], 2), (padded[1:, 1:], 4), (padded[1:, :-1], 8)):
        code += corner * np.uint8(bit)
    cells = np.flatnonzero((code != 0) & (code != 15))
    codes = code.ravel()[cells]
    del code
    beside = np.flatnonzero(padded[:-1, :-1] != padded[:-1, 1:])
    below = np.flatnonzero(padded[:-1] != padded[1:])
    ink_beside = padded[:-1, :-1].ravel()[beside]
    ink_below = padded[:-1].ravel()[below]
    first = rows.start
    return (
        beside + first * (width + 1), below + first * (width + 2), ink_beside, ink_below,
        cells + first * (width + 1), codes,
    )  # fmt: skip


def _following(cells: IntArray, codes: IntArray, numbers: IntArray, field: Field) -> IntArray:
    """For each crossing the next one on its line."""
    height, width = field.shape
    row, column = np.divmod(cells, width + 1)
    upper = row * (width + 1) + column
    left = (height + 2) * (width + 1) + row * (width + 2) + column
    sides = (upper, left + 1, upper + width + 1, left)
    following = np.full(len(numbers), -1)

    def link(which: IntArray, ways: tuple[int, int]) -> None:
        came, goes = (np.searchsorted(numbers, sides[side][which]) for side in ways)
        following[came] = goes

    for kind, ways in WAYS.items():
        link(np.flatnonzero(codes == kind), ways)
    for kind in APART:
        saddle = np.flatnonzero(codes == kind)
        if not len(saddle):  # as in most pictures
            continue
        # The rim holds no ink, so that the four pixels of a saddle lie in the picture.
        r, c = row[saddle] - 1, column[saddle] - 1
        joined = _joined(field, r, c)
        for table, which in ((JOINED, saddle[joined]), (APART, saddle[~joined])):
            for ways in table[kind]:
                link(which, ways)
    return following


def _joined(field: Field, row: IntArray, column: IntArray) -> BoolArray:
    """Whether the ink of two pixels that touch by a corner is one; the upper left of four is given.

    The mean of the four tells, in favour of what there is less of around: a thread has no more
    (as the rule that Selinger's potrace calls "minority").
    """
    near = np.mean([field.coverage(row + i, column + j) for i in (0, 1) for j in (0, 1)], axis=0)
    reach = range(-AROUND, AROUND + 2)
    wide = np.mean([field.coverage(row + i, column + j) for i in reach for j in reach], axis=0)
    return near - 0.5 >= MINORITY * (wide - 0.5)


def _loops(following: IntArray) -> list[IntArray]:
    """Cycles of a permutation."""
    ahead = following.tolist()
    seen = bytearray(len(ahead))
    loops = []
    for start, done in enumerate(seen):
        if done:
            continue
        loop, here = [], start
        while not seen[here]:
            seen[here] = 1
            loop.append(here)
            here = ahead[here]
        loops.append(np.array(loop))
    return loops
