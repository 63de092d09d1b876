"""Inks: what the ink of each outline is worth, where a picture has several of unlike strength.

One cut for the whole picture lies half-way between the ground and one of them. The outlines of
blurred edges lie half-way between the ground and their own, which their profiles show where strokes
are wide enough.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.tracing.edges import REACH, half_way, profiles_across
from shapespline.tracing.level import picture_level
from shapespline.tracing.softness import ENOUGH, EVEN, EVEN_NOISE, Softness

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.typing import FloatArray

# Of so many pixels into the ink the last three tell what it is worth where they are even; so much
# of an outline has to show it. What differs from the ink of the picture by more than this part is
# another (TRC-22).
DEEP, INNER, SHOWN, DIFFERENT = 7, 3, 0.2, 0.08
# Outlines of so many crossings tell inks; one that so small a part of them has is rare (TRC-22).
LONG, RARE = 12, 0.02
# Pixels on either side of a crossing in which its place is looked for.
NEAR = 3


def inks_of(field: Field, part: Crossings, lengths: Sequence[int]) -> FloatArray:
    """Ink of outlines of so many crossings each, of that of the picture.

    Of thin strokes it is the least ink of others that is no less than their middle.
    """
    profiles = _into_ink(field, part)
    inner = profiles[:, -INNER:]
    even = np.ptp(inner, axis=1) <= EVEN + EVEN_NOISE * field.noise
    even &= (profiles > 0.5).all(axis=1)  # of a thin stroke they are ground
    most = profiles.max(axis=1)
    shown, middles = np.full(len(lengths), np.nan), np.empty(len(lengths))
    uncertain = np.ones(len(lengths))
    begin = 0
    for k, length in enumerate(lengths):
        own = slice(begin, begin + length)
        begin += length
        middles[k] = np.median(most[own])
        if even[own].sum() >= max(1.0, SHOWN * length):
            shown[k] = np.median(inner[own][even[own]])
            uncertain[k] = even[own].sum() ** -0.5
    told = ~np.isnan(shown)
    if not told.any():
        return np.ones(len(lengths))
    known = np.sort(shown[told])
    least = known[np.minimum(np.searchsorted(known, middles - DIFFERENT), len(known) - 1)]
    found = np.where(told, shown, least)
    other = np.abs(found - 1.0) > DIFFERENT + EVEN_NOISE * field.noise * uncertain
    return np.where(other, found, 1.0)


def _into_ink(field: Field, part: Crossings) -> FloatArray:
    """Coverage of the pixels of ink behind each crossing, as far as is looked, shape (n, DEEP)."""
    steps = np.arange(1, DEEP + 1)
    along = np.where(part.ink_first[:, None], 1 - steps, steps)
    row = part.row[:, None] + np.where(part.upright[:, None], along, 0)
    column = part.column[:, None] + np.where(part.upright[:, None], 0, along)
    return field.coverage(row, column)


def softness_of(field: Field, found: Crossings) -> Softness:
    """How soft the edges of long outlines are."""
    part, inks = _long(field, found)
    return Softness.of(field, part, inks)


def _long(field: Field, found: Crossings) -> tuple[Crossings, FloatArray]:
    """Crossings of long outlines, as many as tell enough, and the ink of each."""
    loops = [loop for loop in found.loops if len(loop) >= LONG]
    loops = loops[:: sum(map(len, loops)) // ENOUGH + 1]
    lengths = [len(loop) for loop in loops]
    part = found.chosen(np.concatenate([np.empty(0, dtype=np.int64), *loops]))
    return part, np.repeat(inks_of(field, part, lengths), lengths)


def cut_between_inks(field: Field, found: Crossings) -> Field | None:
    """The picture cut for an ink between its weakest and its strongest; None of one ink.

    Half-way to a weak one the outlines of a strong one run together.
    """
    part, inks = _long(field, found)
    if not Softness.of(field, part, inks).on_level:
        return None
    ends = np.quantile(inks, (RARE, 1.0 - RARE))
    between = float(np.sqrt(ends.prod()))
    if abs(between - 1.0) <= 0.5 * DIFFERENT:
        return None
    more = 0.5 * (between - 1.0) * field.contrast
    middle = field.middle + (more if field.light else -more)
    return replace(
        field,
        cut=picture_level(field.values, middle).cut,
        contrast=between * field.contrast,
        noise=field.noise / between,
        middle=middle,
    )


def moved_to_own(field: Field, part: Crossings, shares: FloatArray, inks: FloatArray) -> FloatArray:
    """Shares of crossings moved to where the values lie half-way to their own ink.

    Parameters
    ----------
    field : Field
    part : Crossings
    shares : ndarray, shape (n,)
        Of the level line of the picture.
    inks : ndarray, shape (n,)
        What the ink of each is worth.
    """
    which = np.flatnonzero((inks != 1.0) & ~part.at_rim(*field.shape))
    moved = shares.copy()
    if len(which) == 0:
        return moved
    some = part.chosen(which)
    places = half_way(profiles_across(field, some) / inks[which, None], NEAR)
    ahead = np.where(some.ink_first, REACH - places, places - REACH) + 0.5
    moved[which] = np.where(np.isnan(ahead), shares[which], ahead)
    return moved
