"""Threads: strokes about as wide as a pixel, which a level alone would tear into beads.

Such a stroke covers two pixels by half where it runs along their common border, so that neither is
ink. Across it, though, its grey adds up to its width, and that is what tells it. The ground between
two strokes is looked at in the same way.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray, IntArray

# So many crossings are traced in any case. Beyond, a picture of whose pairs of neighbours more than
# this part differs is refused: of pure noise it is a half, of a page of small print a tenth.
FEW_CROSSINGS, CROSSED_PART = 200_000, 0.2
# Pixels that lack no more than this of a half may belong to a thread.
LACKS = 0.2
# A thread is this wide if nothing else is known of it, and lacks no more than this; where it goes
# on as ink before and behind, it may be thinner and paler.
WIDE, PALE, NECK = 0.9, 0.1, 0.55
# Ground on both sides of a thread has less ink; ink along it may be deeper by this part of what the
# ground is paler: with more, the pixel lies between two things.
GROUND, DEEPER = 0.25, 0.5


def is_noise(count: int, n_pixels: int) -> bool:
    """Whether so many pairs of neighbours, one of them ink, are more than drawings have."""
    return count > max(FEW_CROSSINGS, CROSSED_PART * 2 * n_pixels)


def ink_and_threads(field: Field, rows: slice) -> BoolArray:
    """Which pixels of some rows are ink, none that a thread of ground crosses, threads among them.

    In noise there are none to be looked for.
    """
    values = field.values[rows]
    ink = field.is_ink(values)
    if is_noise(int((ink[1:] != ink[:-1]).sum() + (ink[:, 1:] != ink[:, :-1]).sum()), ink.size):
        return ink
    wide = LACKS * field.contrast
    row, column = np.nonzero((values >= field.cut - wide) & (values < field.cut + wide))
    del values
    for part in np.array_split(np.arange(len(row)), len(row) // 200_000 + 1):
        around = _around(field, rows.start + row[part], column[part])
        was = ink[row[part], column[part]]
        thread = np.where(was, is_thread(1.0 - around), is_thread(around))
        ink[row[part], column[part]] = was ^ thread
    return ink


def _around(field: Field, row: IntArray, column: IntArray) -> FloatArray:
    """Coverage of five by five pixels around each."""
    offsets = np.arange(-2, 3)
    return field.coverage(
        row[:, None, None] + offsets[:, None], column[:, None, None] + offsets[None, :]
    )


def is_thread(around: FloatArray) -> BoolArray:
    """Whether the pixel in the middle lies on a thread, along either axis.

    Parameters
    ----------
    around : ndarray, shape (n, 5, 5)
        Parts of pixels that are of what a thread is of.
    """
    return _runs_down(around) | _runs_down(np.swapaxes(around, 1, 2))


def _runs_down(around: FloatArray) -> BoolArray:
    """Whether a thread runs through the middle pixel from above to below."""
    across = around[:, 2]
    middle, left, right = across[:, 2], across[:, 1], across[:, 3]
    # It is the fullest pixel of its row, or as full as one of its neighbours.
    crest = (middle >= left - 0.02) & (middle >= right - 0.02) & (np.minimum(left, right) < GROUND)
    crest &= (across[:, 0] < GROUND) & (across[:, 4] < GROUND)
    width = np.clip(across, 0.0, None).sum(axis=1)
    above, below = around[:, 1, 1:4].max(axis=1), around[:, 3, 1:4].max(axis=1)
    paler = middle - 0.5 * (np.minimum(left, right) + np.minimum(across[:, 0], across[:, 4]))
    deeper = 0.5 * (above + below) - middle
    neck = (above >= 0.5) & (below >= 0.5) & (width >= NECK)
    whole = (width >= WIDE) & (middle >= 0.5 - PALE)
    return np.asarray(crest & (neck | whole) & (deeper <= DEEPER * paler))
