"""Thin inks: the colours of strokes too thin to have even pixels, from what they mix to.

An ink and what it mixes to with the colour around it lie on a line from that; the ink is the far
end (as in colour-line models: Omer & Werman 2004).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.tracing.cores import APART, NEARBY, are_cores, full
from shapespline.tracing.mixtures import MIXED, off_mixture, unmixed
from shapespline.tracing.smeared import are_smeared
from shapespline.tracing.told import Told

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import BoolArray, FloatArray

# Edges of JPEG's colours are looked for between even pixels so far away; of what is no mixture this
# part is theirs where it is theirs at all; they ring by so much (TRC-25).
SMEARED, MOST_SMEARED, RINGING = 8, 0.6, 30.0
# So many pixels, and this part of the picture, that are no mixtures have a colour of their own:
# that of this part of them, the farthest from the colours around them (TRC-33).
THIN, THIN_PART, FARTHEST_PART = 6, 1e-5, 0.1
# So many values tell where most of them are.
SAMPLE = 1000
# Cores that an ink within so many pixels mixes to may be of it; so many times as many to which none
# does have a colour of their own (TRC-33).
AROUND, CLEARLY = 8, 4
# With more of an ink than this a stroke is of it (TRC-33).
FULL_PART = 0.75


def with_thin_inks(
    pixels: NDArray[np.uint8], even: BoolArray, colors: FloatArray, most: int
) -> FloatArray:
    """Colours with the inks of strokes too thin to have even pixels, so many at most.

    First those of pixels that no two colours mix to, then those of strokes that might be a mixture.
    """
    least = max(THIN, THIN_PART * even.size)
    inks = np.empty((0, 3))
    for _ in range(most):  # inks may take each other's place
        told = Told.by_even(pixels, even, colors)
        new = _new_ink(*_strange(pixels, told, colors), colors, least)
        if new is None:
            new = _new_ink(*_pale(pixels, told, colors), colors, CLEARLY * least)
        if new is None:
            return colors
        grounds = colors[len(inks) :]
        inks = inks[[not _is_shade(ink, new, grounds) for ink in inks]]
        if len(inks) + len(grounds) == most:
            # In place of the rarest, if that is a shade of another.
            apart = np.sqrt(((colors[:-1] - colors[-1]) ** 2).mean(axis=1)).min()
            if apart > 3 * APART or len(grounds) == 1:
                return colors
            grounds = grounds[:-1]
        inks = np.concatenate([[new], inks])
        colors = np.concatenate([inks, grounds])
    return colors


def _is_shade(ink: FloatArray, new: FloatArray, grounds: FloatArray) -> bool:
    """Whether an ink is what a new one mixes to where it covers almost all."""
    found = (off_mixture(ink[None], ground, new) for ground in grounds)
    return any(off[0] <= MIXED**2 * 3 and FULL_PART < share[0] < 1.0 for off, share in found)


def _new_ink(
    strange: FloatArray, nearby: BoolArray, colors: FloatArray, least: float
) -> FloatArray | None:
    """The colour of the ink that most of what is farthest from the palette is of, if there is one.

    An ink and what it mixes to lie on a line from the colour around it; its colour is the far end.
    """
    while len(strange) >= least:
        off = np.sqrt(((strange[:, None] - colors) ** 2).mean(axis=2))
        off = np.where(nearby | ~nearby.any(axis=1, keepdims=True), off, np.inf)
        ground, off = off.argmin(axis=1), off.min(axis=1)
        farthest = np.flatnonzero(off >= np.quantile(off, 1 - FARTHEST_PART))
        seed = farthest[_most_alike(strange[farthest])]
        along = strange[seed] - colors[ground[seed]]
        way = strange - colors[ground[seed]]
        share = way @ along / (along @ along)
        beside = np.sqrt(((way - share[:, None] * along) ** 2).mean(axis=1))
        own = (ground == ground[seed]) & (beside <= MIXED)
        most = own & (share >= 0.5)
        far = most & (share >= np.quantile(share[most], 1 - FARTHEST_PART))
        new = np.median(strange[far], axis=0)
        apart = np.sqrt(((colors - new) ** 2).mean(axis=1)).min()
        if own.sum() >= least and apart >= APART:
            return new
        strange, nearby = strange[~own], nearby[~own]
    return None


def _most_alike(values: FloatArray) -> int:
    """Which of some values has most others around it, of a sample."""
    step = len(values) // SAMPLE + 1
    some = values[::step]
    apart = ((some[:, None] - some) ** 2).mean(axis=2)
    return int(np.argmax((apart <= APART**2).sum(axis=1))) * step


def _strange(
    pixels: NDArray[np.uint8], even: Told, colors: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """Values that no two colours mix to, and which colours are near each.

    Where most of them are seen to be smeared edges, what may be one is.
    """
    found, near = [np.empty((0, 3))], [np.empty((0, len(colors)), dtype=bool)]
    smeared = [np.empty(0, dtype=bool)]
    for where in even.others():
        values, nearby = pixels[where].astype(np.float64), even.around(where, NEARBY)
        is_strange = unmixed(values, nearby, colors)[2]
        found.append(values[is_strange])
        near.append(nearby[is_strange])
        around = even.around((where[0][is_strange], where[1][is_strange]), SMEARED)
        smeared.append(are_smeared(values[is_strange], around, colors, MIXED))
    values, nearby, edges = np.concatenate(found), np.concatenate(near), np.concatenate(smeared)
    if len(edges) and edges.mean() >= MOST_SMEARED:
        kept = ~are_smeared(values, np.ones_like(nearby), colors, RINGING)
        values, nearby = values[kept], nearby[kept]
    return values, nearby


def _pale(
    pixels: NDArray[np.uint8], even: Told, colors: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """Cores of strokes that are mixtures with an ink that is nowhere around; as _strange.

    Near two even colours there are none: edges of a JPEG ring.
    """
    every = even._replace(pixels=even.pixels.copy(), labels=even.labels.copy())
    for where in even.others():
        every.labels[where], every.pixels[where] = full(pixels[where].astype(np.float64), colors)
    found, near = [np.empty((0, 3))], [np.empty((0, len(colors)), dtype=bool)]
    for where in even.others():
        nearby = even.around(where, NEARBY)
        own = np.flatnonzero(are_cores(pixels, where, nearby, colors))
        own = own[even.around((where[0][own], where[1][own]), SMEARED).sum(axis=1) == 1]
        at, nearby = (where[0][own], where[1][own]), nearby[own]
        values, around = pixels[at].astype(np.float64), every.around(at, AROUND)
        first, second, is_strange, least = unmixed(values, nearby, colors)
        each = np.arange(len(own))
        almost = ~around[each, first] & (least < 1.0 - FULL_PART)
        alone = ~is_strange & ~almost & ~(around[each, first] & around[each, second])
        found.append(values[alone])
        near.append(nearby[alone])
    return np.concatenate(found), np.concatenate(near)
