"""Round corners and round ends of few pixels as they were drawn: arcs that the ink around tells.

What is summed along a row or a column tells a curve that is all but straight over a pixel, which an
arc of one to four pixels of radius is not. But its two sides are, farther away, and of all circles
that touch both the ink of the pixels along the arc tells one: Newton's method for the one number
that is left, the whole drawing covered anew each time, so that what lies beside counts, too. It is
taken if the pixels agree one by one, and do so better than with the outline as it was.

Through a lens, in grain and in JPEG files the drawing is spread as the picture is, and an arc is
taken if its pixels agree as well as others do and a corner in its place would not.

Of a stroke along the pixels, two of them wide, a round end and a square one may be the same pixels:
such ends are round where anything else in the picture is.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.arc_sides import (
    LARGEST,
    NEARS,
    SIDES,
    Reaches,
    next_turns,
    sides_found,
)
from shapespline.tracing.corners import UNCERTAIN, UNCERTAIN_BLUR, with_corners
from shapespline.tracing.coverage import border_coverage
from shapespline.tracing.sides import NONE, Corners, Turns, Ways, bends_of, length_of, turns_of
from shapespline.tracing.touching import ARC_POINTS, NEARLY_BACK

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapespline.tracing.arc_pixels import ArcPixels, Missed
    from shapespline.tracing.coverage import Covered
    from shapespline.tracing.touching import Arcs, Touching
    from shapespline.typing import BoolArray, FloatArray, IntArray

# Radii of arcs that are told, pixels: of smaller ones a corner is left (TRC-29).
SMALLEST = 0.65
# There arcs miss the pixels by no more than so many times what the outline does, or what is usual;
# a corner in their place misses them by so many deviations more. Their radius is at least this, so
# much more for each pixel of blur, and they take off a corner so many times the ink that a blur
# leaves unknown there (TRC-47).
NO_WORSE, SURE, SMALLEST_SOFT, SMALLEST_BLURRED, KNOWN = 1.4, 5.0, 1.0, 1.25, 2.0
# Rounds of Newton's method, and their longest step.
ROUNDS, LONGEST_STEP = 3, 1.0
# Shorter steps tell that an arc will not agree with its pixels, if all of them are.
STILL = 0.15
# The pixels along an arc may miss the drawing by so much in the mean, and so many times what pixels
# miss it by usually, and by no more than this part of what they miss it by now (TRC-29).
TOLD, TOLD_NOISE, BETTER = 0.012, 1.5, 0.5
# The many pixels along half a circle may miss it by more, as some renderers draw chords, and by so
# many times what they miss the outline by, which may turn anywhere (TRC-36).
TOLD_END, BETTER_END = 0.025, 1.5
# As much for each pixel of what lies between the arc and the corner in its place; pixels that miss
# an outline by no more agree with it.
OF_CORNER, AGREES = 0.12, 0.006
# Arcs are looked for no farther from a pixel that misses the outline by so much, and so many
# deviations of the noise.
MISSED, MISSED_NOISE, ABOUT = 0.02, 3.0, 2
# From the longest sides, then from the nearest ones that no arc found so far disturbs, in an exact
# picture once more: an arc may be longer than its guess the second time, too (TRC-49).
TRIED = (False, True, True)
# What misses them by more is not tried again from the same sides.
HOPELESS = 0.05
# A turn no farther from the middle of a bend is all of it if it turns by such a part (TRC-50).
SAME, WHOLE = 1.25, 0.8
# Points between each side and its arc.
BETWEEN = 2
_BETWEEN = (np.arange(BETWEEN) + 1.0)[:, None] / (BETWEEN + 1)


def rounded(
    outlines: Sequence[FloatArray],
    drawn: Sequence[bool],
    pixels: ArcPixels,
    inks: FloatArray,
) -> list[FloatArray]:
    """Outlines with the arcs of few pixels that the picture shows; all others as they are.

    Parameters
    ----------
    outlines : sequence of ndarray, shape (n_i, 2)
        Closed, in picture coordinates, ink on the left.
    drawn : sequence of bool
        Which of them lie where the picture's grey tells.
    pixels : ArcPixels
    inks : ndarray, shape (n,)
        What the ink of each is worth, of that of the picture.
    """
    now = border_coverage(outlines, *pixels.field.shape)
    others, found = _rounded(outlines, drawn, pixels, inks, now, turns_of)
    if others is not outlines:
        now = border_coverage(others, *pixels.field.shape)
    rest = partial(_bends_left, done=found.points)
    return list(_rounded(others, drawn, pixels, inks, now, rest)[0])


def _bends_left(ways: Ways, done: FloatArray) -> Turns:
    """All bends, those that one turn makes up or that are done as none, but for half turns."""
    bends, turns = bends_of(ways), turns_of(ways)
    own, at, turn = bends
    left = ~_beside(ways.at(own, at), done)
    if len(turns.own):
        off, which = _nearest_along(ways, bends, turns)
        left &= (off > SAME) | (turns.turn[which] < WHOLE * turn)
    return Turns(own, at, np.where(left | (turn >= NEARLY_BACK), turn, 0.0))


def _beside(points: FloatArray, places: FloatArray) -> BoolArray:
    """Which points lie in the pixel of a place or one beside."""
    around = np.stack(np.meshgrid((-1, 0, 1), (-1, 0, 1)), axis=-1).reshape(9, 2)
    pixels = (np.floor(places)[:, None] + around).reshape(-1, 2)
    x, y = np.floor(points).T
    return np.isin(x + 1j * y, pixels[:, 0] + 1j * pixels[:, 1])


def _nearest_along(ways: Ways, bends: Turns, turns: Turns) -> tuple[FloatArray, IntArray]:
    """How far along its way each bend is from the nearest turn, and which that is."""
    length = ways.lengths
    begins = 3.0 * length.max() * np.arange(len(length))  # once more before each way and behind it
    round_ = length[turns.own]
    places = begins[turns.own] + turns.at + np.outer((-1.0, 0.0, 1.0), round_)
    order = np.argsort(places.ravel())
    places = places.ravel()[order]
    mine = begins[bends.own] + bends.at
    behind = np.clip(np.searchsorted(places, mine), 1, len(places) - 1)
    nearest = np.where(mine - places[behind - 1] < places[behind] - mine, behind - 1, behind)
    return np.abs(places[nearest] - mine), order[nearest] % len(turns.own)


def _rounded(
    outlines: Sequence[FloatArray],
    drawn: Sequence[bool],
    pixels: ArcPixels,
    inks: FloatArray,
    now: Covered,
    turns_in: Callable[[Ways], Turns],
) -> tuple[Sequence[FloatArray], Corners]:
    """Outlines with the arcs in some of their turns, and these; the same if there are none."""
    field, reaches = pixels.field, Reaches.of(pixels)
    wrong_pixels = _wrong_pixels(now, pixels)
    used = _looked_at(outlines, drawn, wrong_pixels)
    found = NONE._replace(runs=np.empty((0, ARC_POINTS + 2 * BETWEEN, 2)))
    if not used:
        return outlines, found
    ways = Ways([outlines[k] for k in used], [True] * len(used))
    turns = turns_in(ways)
    own, at, turn = turns
    if not turn.any():
        return outlines, found
    closed, whose = [True] * len(outlines), np.array(used)[own]
    after, ahead = next_turns(turns, ways)
    room = np.minimum(ahead, ahead[np.argsort(after)])
    reach = np.zeros(len(at))
    clear = False
    left = (turn > 0.0) & wrong_pixels.about(ways.at(own, at))
    hopeless, least = np.zeros(len(at)), np.zeros(len(at))

    def covered(corners: Corners) -> Covered:
        """The drawing with these and what was found so far."""
        return border_coverage(with_corners(outlines, found.joined(corners), closed), *field.shape)

    for nearest in TRIED if pixels.exact else TRIED[:2]:
        some, near, touching, shift = sides_found(
            ways, turns, room, np.where(left, least, np.inf), reaches, nearest=nearest
        )
        ink = inks[whose[some]]
        wrong = _miss(touching.arcs(shift), now, ink, pixels) & (near != hopeless[some])
        left[some] = wrong
        if not wrong.any():
            break
        some, near, touching = some[wrong], near[wrong], touching.chosen(wrong)
        shift, ink = shift[wrong], ink[wrong]
        place = whose[some], at[some]
        arcs, missed = _approached(touching, shift, place, ink, pixels, covered, reaches)
        off, was_off = missed.mean, pixels.missed(arcs.along, now, ink).mean
        if pixels.exact:
            good = _agree(arcs, missed, was_off, pixels)
        else:
            corners = _corners(place, touching, arcs, touching.apexes(arcs), reaches)
            off_corner = pixels.missed(arcs.along, covered(corners), ink).mean
            good = _agree_softly(arcs, missed, was_off, off_corner, pixels)
        least[some] = arcs.half_length + reaches.before
        good &= (near >= least[some]) & (arcs.radii <= LARGEST)
        reach[some] = np.where(good, arcs.half_length + reaches.disturbed, 0.0)
        beside = np.minimum(reach, reach[after]) > 0.0
        overlap = beside & (reach + reach[after] > ahead)
        good &= ~(overlap | overlap[np.argsort(after)])[some]
        reach[some[~good]] = 0.0
        corners = _corners(place, touching, arcs, arcs.points(arcs.radii)[:, 1:-1], reaches)
        is_end = good & (np.abs(arcs.turns) >= NEARLY_BACK)
        clear = clear or bool((good & ~is_end).any())
        if is_end.any() and not clear:
            square = _corners(place, touching, arcs, touching.square_ends(arcs), reaches)
            missed = pixels.missed(arcs.along, covered(square.chosen(is_end)), ink)
            clear = bool((missed.mean > np.maximum(off, AGREES))[is_end].any())
        found = found.joined(corners.chosen(good))
        left[some] = ~good
        # What is far off disturbs what lies beside; where nothing was found, nothing changes.
        hopeless[some] = np.where((off > HOPELESS) | ~good.any(), near, 0.0)
        least[some[off > HOPELESS]] = 0.0
    return (with_corners(outlines, found, closed), found) if clear else (outlines, found)


def _miss(arcs: Arcs, now: Covered, ink: FloatArray, pixels: ArcPixels) -> BoolArray:
    """Where pixels along arcs miss the outline; in a picture that is not exact all may."""
    if not pixels.exact:
        return np.ones(len(ink), dtype=bool)
    return pixels.missed(arcs.along, now, ink).mean > AGREES + TOLD_NOISE * pixels.error


def _agree(arcs: Arcs, missed: Missed, was_off: FloatArray, pixels: ArcPixels) -> BoolArray:
    """Which arcs the pixels of an exact picture agree with, where they missed the outline."""
    off, is_end = missed.mean, np.abs(arcs.turns) >= NEARLY_BACK
    good = off <= most_missed(pixels.error) + (TOLD_END - TOLD) * is_end
    good &= off <= np.where(is_end, BETTER_END, BETTER) * was_off
    seen = missed.seen  # none of an arc beyond the rim
    good &= (seen > 0) & (off <= OF_CORNER * arcs.cut_off / np.sqrt(np.maximum(seen, 1)))
    return good & (arcs.radii >= SMALLEST)


def _agree_softly(
    arcs: Arcs, missed: Missed, was_off: FloatArray, off_corner: FloatArray, pixels: ArcPixels
) -> BoolArray:
    """Which arcs the pixels of other pictures agree with, as well as with the outline.

    Points of that lie where these pixels put them, so it is no better for agreeing, too. A corner
    has to be worse, by more than the blur is not known.
    """
    off, error = missed.mean, pixels.error
    is_end = np.abs(arcs.turns) >= NEARLY_BACK
    good = off <= most_missed(error) + (TOLD_END - TOLD) * is_end
    good &= off <= NO_WORSE * np.maximum(was_off, error)
    good &= (missed.seen > 0) & ((off_corner**2 - off**2) * missed.seen >= (SURE * error) ** 2)
    good &= off**2 - error**2 <= BETTER**2 * np.maximum(off_corner**2 - error**2, 0.0)
    good &= arcs.cut_off >= KNOWN * (UNCERTAIN + UNCERTAIN_BLUR * pixels.blur)
    return good & (arcs.radii >= SMALLEST_SOFT + SMALLEST_BLURRED * pixels.blur)


class _WrongPixels(NamedTuple):
    """Pixels about those that miss a drawing, None for all, and the size of the picture."""

    keys: IntArray | None
    height: int
    width: int

    def about(self, points: FloatArray) -> BoolArray:
        """Which points lie in them."""
        if self.keys is None:
            return np.ones(len(points), dtype=bool)
        row, column = np.floor(self.height - points[:, 1]), np.floor(points[:, 0])
        return np.isin((row * self.width + column).astype(np.int64), self.keys)


def _looked_at(
    outlines: Sequence[FloatArray], drawn: Sequence[bool], wrong_pixels: _WrongPixels
) -> list[int]:
    """Outlines that pass by such pixels, and are long enough for an arc and two sides."""
    shortest = 2 * (NEARS[0] + SIDES[-1])
    starts = np.cumsum([0, *(len(one) for one in outlines)])[:-1]
    wrong = np.logical_or.reduceat(wrong_pixels.about(np.concatenate(outlines)), starts)
    chosen = np.flatnonzero(wrong & np.array(drawn)).tolist()
    return [k for k in chosen if length_of(outlines[k]) >= shortest]


def _wrong_pixels(now: Covered, pixels: ArcPixels) -> _WrongPixels:
    """Where an arc may be missing: anywhere where a drawing never agrees."""
    field = pixels.field
    height, width = field.shape
    if not pixels.exact:
        return _WrongPixels(None, height, width)
    row, column = np.divmod(now.keys, width)
    off = np.abs(field.ink(row, column) - now.part)
    keys = now.keys[off > MISSED + MISSED_NOISE * field.noise]
    beside = np.arange(-ABOUT, ABOUT + 1)
    keys = np.unique(keys[:, None, None] + width * beside[:, None] + beside)
    return _WrongPixels(keys, height, width)


def most_missed(error: float) -> float:
    """What pixels that agree may miss an arc by in the mean, where others do by such an error."""
    return TOLD + TOLD_NOISE * error


def _approached(
    touching: Touching,
    shift: FloatArray,
    place: tuple[IntArray, FloatArray],
    ink: FloatArray,
    pixels: ArcPixels,
    covered: Callable[[Corners], Covered],
    reaches: Reaches,
) -> tuple[Arcs, Missed]:
    """Arcs with the pixels' ink beside them, by Newton's method; what misses them, and where."""
    for _ in range(ROUNDS):
        arcs = touching.arcs(shift)
        corners = _corners(place, touching, arcs, arcs.points(arcs.chord_radii)[:, 1:-1], reaches)
        missed = pixels.missed(arcs.along, covered(corners), ink)
        step = touching.step_for(missed.ink.sum(axis=1), arcs)
        shift = shift + np.clip(step, -LONGEST_STEP, LONGEST_STEP)
        lost = (np.abs(step) <= STILL) & (missed.mean > 2.0 * most_missed(pixels.error))
        if (lost | (touching.arcs(shift).radii < 0.5 * SMALLEST)).all():
            break
    return arcs, missed


def _corners(
    place: tuple[IntArray, FloatArray],
    touching: Touching,
    arcs: Arcs,
    inner: FloatArray,
    reaches: Reaches,
) -> Corners:
    """Arcs instead of what lies between their sides, with other points between their ends."""
    points = arcs.points(arcs.radii)
    begins = points[:, 0] - reaches.disturbed * touching.sides[0][1]
    ends = points[:, -1] + reaches.disturbed * touching.sides[1][1]
    reach = arcs.half_length + reaches.disturbed
    one = begins[:, None] + _BETWEEN * (points[:, 0] - begins)[:, None]
    two = points[:, -1:] + _BETWEEN * (ends - points[:, -1])[:, None]
    runs = np.concatenate([one, points[:, :1], inner, points[:, -1:], two], axis=1)
    apex, (own, at) = points[:, ARC_POINTS // 2], place
    return Corners(own, apex, np.abs(arcs.turns), at - reach, at + reach, runs)
