"""Where an edge was drawn, read from all the grey across it: partial area effect.

A pixel of a picture holds the part of its square that is ink. Along a column of pixels across an
edge these parts add up to the ink of the column; a straight edge therefore passes the middle of the
column at that height, whatever its angle, and whatever a symmetric blur has done since (Trujillo-
Pino, Krissian, Alemán-Flores and Santana-Cedrés, "Accurate subpixel edge location based on partial
area effect", Image and Vision Computing 31, 2013). The level line between two pixel centres is off
by up to 0.086 pixels there, in waves that no averaging takes away.

Of a stroke too thin for its ink to show in full, the width is the sum, and its two sides lie where
the sums to either side of a line within its fullest pixel put them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray

# Pixels on either side of a crossing that are looked at.
REACH = 6
OFFSETS = np.arange(1 - REACH, REACH + 1)
# Two neighbours are even if they differ by no more than this part of the contrast, and by no more
# than so many deviations of its noise.
EVEN, EVEN_NOISE = 0.006, 4.0
# Above this noise the sum over an edge is less certain than the level line that it would mend.
NOISIEST = 0.02
# Two even parts with less than this part of the picture's contrast between them are no edge.
LEAST_STEP = 0.25
# Grey so many pixels from an edge and less belongs to it, if it is at the rim of the picture
# (TRC-23).
RIM_REACH = 2
# Pixels that a place may move along its row or column, and how far ground on both sides of a
# stroke may differ.
FARTHEST, SAME_GROUND = 0.7, 0.08
# A stroke whose ink is wider shows it, and its sides are edges.
WIDEST_STROKE = 3.2


class Edges(NamedTuple):
    """Place of each crossing, as a share of the way between its pixels, and whether it is known."""

    shares: FloatArray
    known: BoolArray


def no_edges(shares: FloatArray) -> Edges:
    """Crossings that stay on the level line."""
    return Edges(shares, np.zeros(len(shares), dtype=bool))


def level_shares(field: Field, found: Crossings) -> FloatArray:
    """Where linear interpolation between two pixel centres puts the level.

    Ink that does not reach the level, of a thread, reaches it barely. What is cut off by the rim
    ends there; beside what ends before lies ground (TRC-23).
    """
    first, second = found.excesses(field)
    at_rim, ends = found.at_rim(*field.shape), ends_at_rim(field, found)
    first = np.where(ends & ~found.ink_first, -0.5, first)
    second = np.where(ends & found.ink_first, -0.5, second)
    cut_off = at_rim & ~ends
    return np.where(cut_off, 0.5, first / np.where(cut_off, 1.0, first - second))


def ends_at_rim(field: Field, found: Crossings) -> BoolArray:
    """Crossings between the picture and what is outside, of ink that ends in a pixel of the rim.

    That one has less of it than the next one inside. Ink that the rim cuts off fills both alike.
    """
    ends = found.at_rim(*field.shape)
    part = found.chosen(np.flatnonzero(ends))
    steps = np.where(part.ink_first, -1, 1)
    # The pixel of the rim is the first of the two or the second.
    row = part.row + np.where(part.upright & ~part.ink_first, 1, 0)
    column = part.column + np.where(part.upright | part.ink_first, 0, 1)
    inside = field.coverage(
        row + np.where(part.upright, steps, 0), column + np.where(part.upright, 0, steps)
    )
    ends[ends] = inside - field.coverage(row, column) > EVEN + EVEN_NOISE * field.noise
    return ends


def drawn_shares(field: Field, found: Crossings, shares: FloatArray) -> Edges:
    """Where the grey across each crossing puts the edge; its share as it is where it does not fit.

    Parameters
    ----------
    field : Field
    found : Crossings
    shares : ndarray, shape (n,)
        Of the level line.
    """
    out, known = shares.copy(), np.zeros(len(shares), dtype=bool)
    if field.noise > NOISIEST:
        return Edges(out, known)
    even = EVEN + EVEN_NOISE * field.noise
    for chunk in np.array_split(np.arange(len(shares)), len(shares) // 100_000 + 1):
        part = found.chosen(chunk)
        at_rim = part.at_rim(*field.shape)
        profiles = _with_ground_outside(profiles_across(field, part), field, part, even)
        place = places_across(profiles, even)
        # What is no plain edge at the rim is cut off there.
        place[at_rim] = places_across(profiles[at_rim], even, pure=True)
        # A place counts pixels from the far end of the ground; half-way between the two centres
        # it is the REACH.
        ahead = np.where(part.ink_first, REACH - place, place - REACH) + 0.5
        moved = np.abs(ahead - shares[chunk])
        # No place at all is NaN, and no nearer than that.
        known[chunk] = (moved <= FARTHEST) & (~at_rim | ends_at_rim(field, part))
        out[chunk] = np.where(known[chunk], ahead, shares[chunk])
    return Edges(out, known)


def places_across(profiles: FloatArray, even: float, *, pure: bool = False) -> FloatArray:
    """Where edges lie, in pixels from the far end of the ground; NaN where the grey fits none.

    Parameters
    ----------
    profiles : ndarray, shape (n, 2 REACH)
        Parts of pixels that are ink, from ground to ink, the edge in the middle.
    even : float
        Neighbours that differ by no more are alike.
    pure : bool
        Whether only edges between bare ground and full ink count, and strokes.
    """
    place = _edge(profiles, even, pure=True)
    for other in (
        _stroke(profiles, even),
        2 * REACH - _stroke(1.0 - profiles[:, ::-1], even),
        *(() if pure else (_edge(profiles, even, pure=False),)),
    ):
        place = np.where(np.isnan(place), other, place)
    return place


def half_way(profiles: FloatArray, near: int) -> FloatArray:
    """Where profiles pass a half nearest to their middle, in pixels from the ground's far end.

    NaN where they do not within so many pixels before and behind their middle two.
    """
    before = np.arange(REACH - 1 - near, REACH + near)  # pixels on the ground's side of a place
    first, second = profiles[:, before] - 0.5, profiles[:, before + 1] - 0.5
    met = (first < 0) & (second >= 0)
    places = before + 0.5 + np.where(met, first / np.where(met, first - second, 1.0), np.inf)
    nearest = places[np.arange(len(places)), np.argmin(np.abs(places - REACH), axis=1)]
    return np.where(met.any(axis=1), nearest, np.nan)


def profiles_across(field: Field, found: Crossings) -> FloatArray:
    """Coverage across each crossing, from ground to ink, shape (n, 2 REACH)."""
    row = found.row[:, None] + np.where(found.upright[:, None], OFFSETS, 0)
    column = found.column[:, None] + np.where(found.upright[:, None], 0, OFFSETS)
    profiles = field.coverage(row, column)
    profiles[found.ink_first] = profiles[found.ink_first, ::-1]
    return profiles


def _with_ground_outside(
    profiles: FloatArray, field: Field, found: Crossings, even: float
) -> FloatArray:
    """Profiles that end in an edge at the rim, with bare ground outside the picture.

    What the rim shows goes on there, but grey that an edge puts into its pixels does not (TRC-23).
    """
    height, width = field.shape
    first = np.where(found.upright, found.row, found.column)
    size = np.where(found.upright, height, width)
    # Pixels of the picture on the side of the ground; the one at the rim has this place.
    rim = REACH - np.where(found.ink_first, size - 1 - first, first + 1)
    at_edge = (rim >= REACH - RIM_REACH) & (rim < REACH)
    lines, places = np.arange(len(profiles)), np.clip(rim, 0, REACH - 1)
    at_edge &= profiles[lines, places + 1] - profiles[lines, places] > even
    at_edge |= rim == REACH  # nothing on that side
    outside = at_edge[:, None] & (np.arange(2 * REACH) < rim[:, None])
    return np.where(outside, 0.0, profiles)


def _edge(profiles: FloatArray, even: float, *, pure: bool) -> FloatArray:
    """Places of edges between even ground and even ink; NaN for what is none.

    A single pixel that is ground or ink alone is even, too. Of ``pure`` edges all are: a stroke of
    a pixel's width may cover two neighbours alike, and neither in full.
    """
    steps = np.diff(profiles, axis=1)
    ground_like, ink_like = np.abs(profiles) <= even, np.abs(profiles - 1.0) <= even
    if pure:
        low_end, high_end = ground_like[:, :REACH], ink_like[:, REACH:]
    else:
        flat = np.abs(steps) <= even
        low_end = ground_like[:, :REACH].copy()
        low_end[:, 1:] |= flat[:, : REACH - 1]
        high_end = ink_like[:, REACH:].copy()
        high_end[:, :-1] |= flat[:, REACH:]
    lines = np.arange(len(profiles))
    low = REACH - 1 - np.argmax(low_end[:, ::-1], axis=1)
    high = REACH + np.argmax(high_end, axis=1)
    ground, ink = profiles[lines, low], profiles[lines, high]
    at = np.arange(2 * REACH)
    between = (at >= low[:, None]) & (at <= high[:, None])
    rise = ink - ground
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(between, (profiles - ground[:, None]) / rise[:, None], 0.0).sum(axis=1)
    rising = (steps >= -even) | ~(between[:, 1:] & between[:, :-1])
    fits = low_end.any(axis=1) & high_end.any(axis=1) & (rise >= LEAST_STEP) & rising.all(axis=1)
    return np.where(fits, high + 1.0 - share, np.nan)


def _stroke(profiles: FloatArray, even: float) -> FloatArray:
    """Places of the near side of strokes narrower than their grey; NaN for what is none."""
    steps = np.diff(profiles, axis=1)
    flat = np.abs(steps) <= even
    lines = np.arange(len(profiles))
    low = REACH - 2 - np.argmax(flat[:, REACH - 2 :: -1], axis=1)
    ground = profiles[lines, low + 1]
    at = np.arange(2 * REACH)
    # Even ground again, behind the crest.
    back = flat & (np.abs(profiles[:, :-1] - ground[:, None]) <= SAME_GROUND) & (at[:-1] > REACH)
    high = np.argmax(back, axis=1)
    beyond = profiles[lines, high]
    within = (at > low[:, None]) & (at <= high[:, None])
    base = 0.5 * (ground + beyond)
    ink = np.where(within, (profiles - base[:, None]) / np.maximum(1.0 - base, 0.5)[:, None], 0.0)
    width = ink.sum(axis=1)
    crest = np.argmax(np.where(within, profiles, -np.inf), axis=1)
    # Both sides are measured from a line within the fullest pixel: at its far border if the stroke
    # goes on beyond it only, in its middle if it does so on both sides alike.
    beside = np.pad(np.maximum(ink, 0.0), ((0, 0), (1, 1)))
    left, right = beside[lines, crest], beside[lines, crest + 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(left + right > 0, right / (left + right), 0.5)
    near = np.where(at < crest[:, None], ink, 0.0).sum(axis=1) + part * ink[lines, crest]
    crest = crest[:, None]
    wrong = (steps < -even) & (at[:-1] < crest) | (steps > even) & (at[:-1] >= crest)
    single = ~(wrong & within[:, 1:] & within[:, :-1]).any(axis=1)
    fits = flat[lines, low] & back.any(axis=1) & single & (np.abs(ground) <= 3 * SAME_GROUND)
    fits &= (width > 0) & (base < 0.5) & (width <= WIDEST_STROKE)
    return np.where(fits, crest[:, 0] + part - near, np.nan)
