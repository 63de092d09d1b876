"""Round corners and round ends of few pixels as they were drawn: arcs that the ink around tells.

What is summed along a row or a column tells a curve that is all but straight over a pixel, which an
arc of one to four pixels of radius is not. But its two sides are, farther away, and of all circles
that touch both the ink of the pixels along the arc tells one: Newton's method for the one number
that is left, the whole drawing covered anew each time, so that what lies beside counts, too. It is
taken if the pixels agree one by one, and do so better than with the outline as it was.

Of a stroke along the pixels, two of them wide, a round end and a square one may be the same pixels:
such ends are round where anything else in the picture is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.corners import around, with_corners
from shapespline.tracing.coverage import border_coverage
from shapespline.tracing.sides import NONE, Corners, Turns, Ways, bends_of, length_of, turns_of
from shapespline.tracing.touching import ARC_POINTS, NEARLY_BACK, Arcs, Touching

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapespline.tracing.coverage import Covered
    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray, IntArray

# Radii of arcs that are told, pixels: of smaller ones a corner is left, larger ones are told by
# their own points (TRC-29).
SMALLEST, LARGEST = 0.65, 8.0
# Lengths along the outline from the middle of an arc to where its sides are looked at, which it has
# to end before by so much; how far sides are looked at, how far from the next turn they end, and
# how far they may be from a line in the mean (TRC-29).
NEARS, BEFORE = (1.7, 2.1, 2.5, 3.0, 3.6, 4.3, 5.2, 6.3, 7.5), 0.35
SIDES, CLEAR, STRAIGHT = (4.0, 2.0, 1.0), 1.25, 0.015
# Points of sides are disturbed so far beyond an arc: its pixels reach there.
DISTURBED = 0.8
# Rounds of Newton's method, and their longest step.
ROUNDS, LONGEST_STEP = 3, 1.0
# Shorter steps tell that an arc will not agree with its pixels, if all of them are.
STILL = 0.15
# Pixels whose middle is so near to an arc tell it, of those so near to its own middle. They may
# miss the drawing by so much in the mean, and so many deviations of the noise, and by no more than
# this part of what they miss it by now (TRC-29).
ALONG, REACH = 1.1, 7
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
# What misses them by more is not tried again from the same sides.
HOPELESS = 0.05
# Points of each side, and between it and its arc.
SAMPLES, BETWEEN = 9, 2
_SHARES = np.linspace(0.0, 1.0, SAMPLES)
_BETWEEN = (np.arange(BETWEEN) + 1.0)[:, None] / (BETWEEN + 1)


def rounded(
    outlines: Sequence[FloatArray], drawn: Sequence[bool], field: Field, inks: FloatArray
) -> list[FloatArray]:
    """Outlines with the arcs of few pixels that the picture shows; all others as they are.

    Parameters
    ----------
    outlines : sequence of ndarray, shape (n_i, 2)
        Closed, in picture coordinates, ink on the left.
    drawn : sequence of bool
        Which of them lie where the picture's grey tells.
    field : Field
    inks : ndarray, shape (n,)
        What the ink of each is worth, of that of the picture.
    """
    now = border_coverage(outlines, *field.shape)
    some = _rounded(outlines, drawn, field, inks, now, turns_of)
    if some is not outlines:
        now = border_coverage(some, *field.shape)
    return list(_rounded(some, drawn, field, inks, now, _half_turns_of))


def _half_turns_of(ways: Ways) -> Turns:
    """All turns, those that do not lead back as none: the others may have several middles."""
    own, at, turn = bends_of(ways)
    return Turns(own, at, np.where(turn >= NEARLY_BACK, turn, 0.0))


def _rounded(
    outlines: Sequence[FloatArray],
    drawn: Sequence[bool],
    field: Field,
    inks: FloatArray,
    now: Covered,
    turns_in: Callable[[Ways], Turns],
) -> Sequence[FloatArray]:
    """Outlines with the arcs in some of their turns; the same if there are none."""
    wrong_pixels = _wrong_pixels(now, field)
    used = _looked_at(outlines, drawn, wrong_pixels)
    if not used:
        return outlines
    ways = Ways([outlines[k] for k in used], [True] * len(used))
    turns = turns_in(ways)
    own, at, turn = turns
    if not turn.any():
        return outlines
    closed, whose = [True] * len(outlines), np.array(used)[own]
    after, ahead = _next(turns, ways)
    room = np.minimum(ahead, ahead[np.argsort(after)])
    reach = np.zeros(len(at))
    found = NONE._replace(runs=np.empty((0, ARC_POINTS + 2 * BETWEEN, 2)))
    clear = False
    left = wrong_pixels.about(ways.at(own, at)) & (turn > 0.0)
    hopeless, least = np.zeros(len(at)), np.zeros(len(at))

    def covered(corners: Corners) -> Covered:
        """The drawing with these and what was found so far."""
        return border_coverage(with_corners(outlines, found.joined(corners), closed), *field.shape)

    for nearest in (False, True):
        some, near, touching, shift = _sides_found(
            ways, turns, room, np.where(left, least, np.inf), nearest=nearest
        )
        arcs, ink = touching.arcs(shift), inks[whose[some]]
        off = _mean(*_missed(arcs, field, now, ink))
        wrong = (off > AGREES + TOLD_NOISE * field.noise) & (near != hopeless[some])
        left[some] = wrong
        if not wrong.any():
            break
        some, near, touching = some[wrong], near[wrong], touching.chosen(wrong)
        shift, ink = shift[wrong], ink[wrong]
        place = whose[some], at[some]
        arcs, missed, along = _approached(touching, shift, place, ink, field, covered)
        off, was_off = _mean(missed, along), _mean(*_missed(arcs, field, now, ink))
        is_end = np.abs(arcs.turns) >= NEARLY_BACK
        good = off <= most_missed(field) + (TOLD_END - TOLD) * is_end
        good &= off <= np.where(is_end, BETTER_END, BETTER) * was_off
        seen = along.sum(axis=1)  # none of an arc beyond the rim
        good &= (seen > 0) & (off <= OF_CORNER * arcs.cut_off / np.sqrt(np.maximum(seen, 1)))
        least[some] = arcs.half_length + BEFORE
        good &= (near >= least[some]) & (arcs.radii >= SMALLEST) & (arcs.radii <= LARGEST)
        reach[some] = np.where(good, arcs.half_length + DISTURBED, 0.0)
        beside = np.minimum(reach, reach[after]) > 0.0
        overlap = beside & (reach + reach[after] > ahead)
        good &= ~(overlap | overlap[np.argsort(after)])[some]
        reach[some[~good]] = 0.0
        corners = _corners(place, touching, arcs, arcs.points(arcs.radii)[:, 1:-1])
        is_end &= good
        clear = clear or bool((good & ~is_end).any())
        if is_end.any() and not clear:
            square = _corners(place, touching, arcs, touching.square_ends(arcs))
            missed, along = _missed(arcs, field, covered(square.chosen(is_end)), ink)
            clear = bool((_mean(missed, along) > np.maximum(off, AGREES))[is_end].any())
        found = found.joined(corners.chosen(good))
        left[some] = ~good
        # What is far off disturbs what lies beside; where nothing was found, nothing changes.
        hopeless[some] = np.where((off > HOPELESS) | ~good.any(), near, 0.0)
        least[some[off > HOPELESS]] = 0.0
    return with_corners(outlines, found, closed) if clear else outlines


class _WrongPixels(NamedTuple):
    """Pixels about those that miss a drawing, and the size of the picture."""

    keys: IntArray
    height: int
    width: int

    def about(self, points: FloatArray) -> BoolArray:
        """Which points lie in them."""
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


def _wrong_pixels(now: Covered, field: Field) -> _WrongPixels:
    """Where an arc may be missing."""
    height, width = field.shape
    row, column = np.divmod(now.keys, width)
    off = np.abs(field.ink(row, column) - now.part)
    keys = now.keys[off > MISSED + MISSED_NOISE * field.noise]
    beside = np.arange(-ABOUT, ABOUT + 1)
    keys = np.unique(keys[:, None, None] + width * beside[:, None] + beside)
    return _WrongPixels(keys, height, width)


def _next(turns: Turns, ways: Ways) -> tuple[IntArray, FloatArray]:
    """The turn behind each one along its outline, and how far behind."""
    own, at, _ = turns
    k, first = np.arange(len(own)), np.searchsorted(own, own)
    last = np.searchsorted(own, own, side="right") - 1
    after = np.where(k < last, k + 1, first)
    return after, at[after] - at + np.where(k < last, 0.0, ways.lengths[own])


def _sides_found(
    ways: Ways, turns: Turns, room: FloatArray, least: FloatArray, *, nearest: bool
) -> tuple[IntArray, FloatArray, Touching, FloatArray]:
    """Turns whose sides are straight, from where, circles that touch them, and their numbers.

    From the longest sides that allow a circle through the outline's middle, or from the ``nearest``
    ones, but no nearer than ``least``. ``room`` is there to the next turn.
    """
    own, at, _ = turns
    # All lengths and distances at once.
    tried = np.meshgrid(SIDES, NEARS, np.flatnonzero(least < np.inf), indexing="ij")
    size, near, some = (np.ravel(one.swapaxes(0, int(nearest))) for one in tried)
    used = near >= least[some]
    used &= near + size <= room[some] - CLEAR
    near, size, some = near[used], size[used], some[used]
    sides, fit = [], np.ones(len(some), dtype=bool)
    for sign in (-1.0, 1.0):
        t = near[:, None] + _SHARES * size[:, None]
        seen = ways.at(np.broadcast_to(own[some, None], t.shape), at[some, None] + sign * t)
        middle = seen.mean(axis=1)
        x, y = (seen - middle[:, None]).transpose(2, 0, 1)
        along = sign * (seen[:, -1] - seen[:, 0])
        angle = 0.5 * np.arctan2(2 * (x * y).sum(axis=1), (x**2 - y**2).sum(axis=1))
        u = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        u *= np.where((u * along).sum(axis=1) < 0, -1.0, 1.0)[:, None]
        fit &= ((x * u[:, 1:] - y * u[:, :1]) ** 2).mean(axis=1) <= STRAIGHT**2
        sides.append((middle, u))
    near, some = near[fit], some[fit]
    touching = Touching([(p[fit], u[fit]) for p, u in sides])
    number = touching.through(ways.at(own[some], at[some]))
    arcs = touching.arcs(number)
    good = np.flatnonzero((near >= arcs.half_length + BEFORE) & (arcs.radii <= LARGEST))
    # Of each turn what comes first.
    some, which = np.unique(some[good], return_index=True)
    good = good[which]
    return some, near[good], touching.chosen(good), number[good]


def most_missed(field: Field) -> float:
    """What pixels that agree may miss an arc by in the mean."""
    return TOLD + TOLD_NOISE * field.noise


def _approached(
    touching: Touching,
    shift: FloatArray,
    place: tuple[IntArray, FloatArray],
    ink: FloatArray,
    field: Field,
    covered: Callable[[Corners], Covered],
) -> tuple[Arcs, FloatArray, BoolArray]:
    """Arcs with the pixels' ink beside them, by Newton's method; what misses them, and where."""
    for _ in range(ROUNDS):
        arcs = touching.arcs(shift)
        corners = _corners(place, touching, arcs, arcs.points(arcs.chord_radii)[:, 1:-1])
        missed, along = _missed(arcs, field, covered(corners), ink)
        step = touching.step_for(missed.sum(axis=1), arcs)
        shift = shift + np.clip(step, -LONGEST_STEP, LONGEST_STEP)
        lost = (np.abs(step) <= STILL) & (_mean(missed, along) > 2.0 * most_missed(field))
        if (lost | (touching.arcs(shift).radii < 0.5 * SMALLEST)).all():
            break
    return arcs, missed, along


def _corners(
    place: tuple[IntArray, FloatArray], touching: Touching, arcs: Arcs, inner: FloatArray
) -> Corners:
    """Arcs instead of what lies between their sides, with other points between their ends."""
    points = arcs.points(arcs.radii)
    begins = points[:, 0] - DISTURBED * touching.sides[0][1]
    ends = points[:, -1] + DISTURBED * touching.sides[1][1]
    reach = arcs.half_length + DISTURBED
    one = begins[:, None] + _BETWEEN * (points[:, 0] - begins)[:, None]
    two = points[:, -1:] + _BETWEEN * (ends - points[:, -1])[:, None]
    runs = np.concatenate([one, points[:, :1], inner, points[:, -1:], two], axis=1)
    apex, (own, at) = points[:, ARC_POINTS // 2], place
    return Corners(own, apex, np.abs(arcs.turns), at - reach, at + reach, runs)


def _missed(
    arcs: Arcs, field: Field, covered: Covered, ink: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """What pixels have and a drawing does not, and which of them are along the arcs."""
    height, width = field.shape
    points = arcs.points(arcs.radii)
    r, c, inside = around(0.5 * (points.min(axis=1) + points.max(axis=1)), field.shape, REACH)
    x_off = (c[:, 0] + 0.5)[:, None] - points[..., :1]
    y_off = (height - r[:, :, 0] - 0.5)[:, None] - points[..., 1:]
    near = (y_off[..., None] ** 2 + x_off[:, :, None] ** 2).min(axis=1)
    along = inside & (near <= ALONG**2)
    r, c = np.clip(r, 0, height - 1), np.clip(c, 0, width - 1)
    missed = field.ink(r, c) / ink[:, None, None] - covered.at(r, c, width)
    size = (len(r), (2 * REACH + 1) ** 2)
    return np.where(along, missed, 0.0).reshape(size), along.reshape(size)


def _mean(missed: FloatArray, along: BoolArray) -> FloatArray:
    """Root mean square over the pixels that count."""
    return np.sqrt((missed**2).sum(axis=1) / np.maximum(along.sum(axis=1), 1))
