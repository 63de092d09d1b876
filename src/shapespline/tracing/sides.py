"""Where the sides of a line that turns meet, as they would without what disturbs them.

Beyond what a pixel's square reaches from a corner its sides show undisturbed: lines or parabolas
through them by least squares, and Newton's method for the point where two of them meet.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.tracing.softness import SHARP

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.softness import Softness
    from shapespline.typing import BoolArray, FloatArray, IntArray

# A turn of more, between chords that begin and end so many pixels before and behind.
LEAST_TURN = np.radians(22.0)
CHORD = (1.0, 3.4)
# Steps along a way at which that is looked at, and between which the direction of a side is told.
STEP, LONG_STEP = 0.25, 2.0
# Candidates nearer than this are one; sides are looked at as far as this, and over no less.
SAME_CORNER, SIDE, SHORTEST_SIDE = 1.6, 6.0, 0.9
# Where a side of that length bends too much a shorter one is tried, if no other corner is near
# (TRC-19).
SHORT_SIDE = 3.5
# A side is disturbed this far from the corner: half a pixel for its column, or more where columns
# next to it see the corner, and what the other side's square reaches over. Where that leaves no
# side, less is tried: the level line turns before an acute corner, and all is counted from there.
DISTURBED, SQUARE, LEAST_DISTURBED = (0.75, 1.25, 1.75, -0.5), 0.5, 0.5
# A blur disturbs what has the other side within so many of its deviations; of sides that meet in
# tips no farther than of this turn (TRC-20).
BLURRED, MOST_TURN = 2.5, np.radians(150.0)
# Root mean square distance in pixels of a side to a line and a parabola. The line is taken where it
# is not so many times worse.
SMOOTH, TIE, TIE_FACTOR = 0.05, 0.004, 1.5
# Of soft edges: for each pixel of blur, as parabolas through what is far from a corner lead astray;
# and so many times their scatter sides may be off (TRC-20).
TIE_BLURRED, SCATTERED = 0.01, 1.5
SAMPLES, ROUNDS = 9, 4
# Sides that are still farther apart (pixels) where they are nearest do not meet (TRC-13).
MEET = 0.01
_SHARES = np.linspace(0.0, 1.0, SAMPLES)
_POWERS = _SHARES[:, None] ** np.arange(3)
# Coefficients of least squares, those beyond the degree nothing.
_SOLVED = {
    degree: np.pad(np.linalg.pinv(_POWERS[:, : degree + 1]), ((0, 2 - degree), (0, 0)))
    for degree in (1, 2)
}
# Points of each side between the corner and where the side shows undisturbed.
BETWEEN = 2
# Decimals of a pixel that a corner's place has.
DIGITS = 9


class Corners(NamedTuple):
    """Corners: the outline of each, place, turn, and the arc lengths where its sides take over.

    ``runs`` are the points from one side to the other, the corner in their middle.
    """

    own: IntArray
    points: FloatArray
    turns: FloatArray
    begins: FloatArray
    ends: FloatArray
    runs: FloatArray

    def chosen(self, which: BoolArray) -> Corners:
        """Some of them."""
        return Corners(self.own[which], *(column[which] for column in self[1:]))

    def joined(self, other: Corners) -> Corners:
        """Both, in order along their outlines."""
        parts = [np.concatenate(pair) for pair in zip(self, other, strict=True)]
        order = np.lexsort((parts[3] + parts[4], parts[0]))
        return Corners(*(part[order] for part in parts))

    def by_outline(self, count: int) -> list[Corners]:
        """Those of each outline."""
        parts = np.searchsorted(self.own, np.arange(1, count))
        columns = [np.split(column, parts) for column in self[1:]]
        own = np.split(self.own, parts)
        return [Corners(*part) for part in zip(own, *columns, strict=True)]


NONE = Corners(
    np.empty(0, dtype=np.int64),
    np.empty((0, 2)),
    np.empty(0),
    np.empty(0),
    np.empty(0),
    np.empty((0, 2 * BETWEEN + 1, 2)),
)


class Turns(NamedTuple):
    """Where ways turn: the way, the arc length, and by how much, radians."""

    own: IntArray
    at: FloatArray
    turn: FloatArray


class Ways:
    """Outlines and open lines side by side: places by arc length, of many at once.

    Attributes
    ----------
    lengths : ndarray, shape (k,)
    closed : ndarray of bool, shape (k,)
    """

    def __init__(self, lines: Sequence[FloatArray], closed: Sequence[bool]) -> None:
        whole = [
            np.concatenate([line, line[:1]]) if ring else line
            for line, ring in zip(lines, closed, strict=True)
        ]
        stations = [stations_of(line) for line in whole]
        self.lengths = np.array([s[-1] for s in stations])
        self.closed = np.array(closed)
        self._points, self._s = np.concatenate(whole), np.concatenate(stations)
        # A way begins a pixel after the one before it ends.
        self._starts = np.concatenate([[0.0], np.cumsum(self.lengths + 1.0)[:-1]])
        self._global = self._s + np.repeat(self._starts, [len(s) for s in stations])
        self._turnings: dict[float, tuple[IntArray, IntArray, IntArray, FloatArray]] = {}

    def at(self, own: IntArray, where: FloatArray) -> FloatArray:
        """Points of some ways at arc lengths; beyond the end of an open one its end."""
        length = self.lengths[own]
        where = np.where(self.closed[own], where % length, np.clip(where, 0.0, length))
        right = np.searchsorted(self._global, self._starts[own] + where, side="right")
        left = np.clip(right - 1, 0, len(self._s) - 2)
        begin, end = self._s[left], self._s[left + 1]
        span = np.where(end > begin, end - begin, 1.0)  # the last point of a way ends none
        share = np.where(end > begin, where - begin, 0.0) / span
        a, b = self._points[left], self._points[left + 1]
        return np.asarray(a + share[..., None] * (b - a))

    def turning(self, blur: float) -> tuple[IntArray, IntArray, IntArray, FloatArray]:
        """By how much they turn at each step: the way, where its steps begin, how many, angles."""
        if blur not in self._turnings:
            self._turnings[blur] = self._turning(blur)
        return self._turnings[blur]

    def _turning(self, blur: float) -> tuple[IntArray, IntArray, IntArray, FloatArray]:
        counts = np.ceil(self.lengths / STEP).astype(np.int64)
        own = np.repeat(np.arange(len(counts)), counts)
        starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        at = STEP * (np.arange(len(own)) - starts[own])
        near, far = np.array(CHORD) + blur
        before = self.at(own, at - near) - self.at(own, at - far)
        after = self.at(own, at + far) - self.at(own, at + near)
        turn = _turn(before, after)
        # Nothing turns where a side leaves an open line.
        turn[~self.closed[own] & ((at < far) | (at > self.lengths[own] - far))] = 0.0
        return own, starts, counts, turn


def meetings(
    ways: Ways, turns: Turns, disturbed: float, side: float = SIDE, soft: Softness = SHARP
) -> Corners:
    """Where the sides of ways meet, if they are disturbed as far as that, and by a blur.

    Sides that are looked at less far than usual must show undisturbed all of it.
    """
    own, at, turn = turns
    if len(own) == 0:
        return NONE
    for _ in range(ROUNDS):
        spread = BLURRED * soft.blur / np.sin(np.clip(turn, 0.5 * np.pi, MOST_TURN))
        near = np.maximum(disturbed + SQUARE * np.tan(0.5 * turn), LEAST_DISTURBED) + spread
        behind, ahead = _room(ways, own, at, near)
        far = np.minimum(side + spread, np.stack([behind, ahead]))
        wide = (far - near).min(axis=0)
        sides, fits = _sides(ways, own, at, near, far, soft)
        runs, turn, off, apart = _meeting(sides, near)
        at = at + np.clip(off, -SAME_CORNER, SAME_CORNER)
        fit = fits.all(axis=0)
        # Corners that change places are none.
        columns: tuple[Any, ...] = (own, at, near, wide, runs, turn, apart, fit)
        while (swapped := (np.diff(at) < 0) & (np.diff(own) == 0)).any():
            kept = ~(np.append(swapped, False) | np.append(False, swapped))
            columns = tuple(column[kept] for column in columns)
            own, at = columns[:2]
        own, at, near, wide, runs, turn, apart, fit = columns
    # The sides of a stroke's round end run side by side and meet nowhere.
    good = fit & (wide >= SHORTEST_SIDE) & (turn > LEAST_TURN) & (apart <= MEET)
    if side < SIDE:
        good &= wide >= side - near
    # Edges along the rows and columns meet on whole numbers, but for a rounding.
    runs = np.round(runs, DIGITS)
    return Corners(own, runs[:, BETWEEN], turn, at - near, at + near, runs).chosen(good)


def stations_of(points: FloatArray) -> FloatArray:
    """Arc length at each vertex of an open line."""
    steps = np.diff(points, axis=0)
    return np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])


def length_of(points: FloatArray) -> float:
    """Of an open line."""
    steps = np.diff(points, axis=0)
    return float(np.hypot(steps[:, 0], steps[:, 1]).sum())


def _room(
    ways: Ways, own: IntArray, at: FloatArray, near: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Arc length from each candidate to where the ones before and after it disturb, or an end."""
    first, last = np.searchsorted(own, own), np.searchsorted(own, own, side="right") - 1
    index, length, closed = np.arange(len(own)), ways.lengths[own], ways.closed[own]
    before = np.where(index > first, at[np.maximum(index - 1, 0)],
                      np.where(closed, at[last] - length, 0.0))  # fmt: skip
    after = np.where(index < last, at[np.minimum(index + 1, len(own) - 1)],
                     np.where(closed, at[first] + length, length))  # fmt: skip
    # What is beside a sharp corner disturbs as far as its own turn lets it.
    left = near[np.where(index > first, index - 1, np.where(closed, last, index))]
    right = near[np.where(index < last, index + 1, np.where(closed, first, index))]
    return at - before - left, after - at - right


def turns_of(ways: Ways, soft: Softness = SHARP) -> Turns:
    """Where ways turn most; corners of blurred ones take longer."""
    own, starts, counts, turn = ways.turning(soft.blur)
    reach = round((SAME_CORNER + soft.blur) / STEP)
    sharp = np.abs(turn)
    highest = sharp.copy()
    for shift in range(1, reach + 1):
        for way in (-shift, shift):
            index = np.arange(len(own)) - starts[own] + way
            highest = np.maximum(highest, sharp[starts[own] + index % counts[own]])
    index = np.flatnonzero((sharp >= highest - 1e-6) & (sharp > LEAST_TURN))
    if len(index) == 0:
        return Turns(np.empty(0, dtype=np.int64), np.empty(0), np.empty(0))
    # Of a flat top the middle.
    apart = (np.diff(index) > reach) | (np.diff(own[index]) > 0)
    groups = np.split(index, np.flatnonzero(apart) + 1)
    middles, of = [], []
    begin = 0
    while begin < len(groups):
        one, end = own[groups[begin][0]], begin
        while end < len(groups) and own[groups[end][0]] == one:
            end += 1
        mine, n, first = groups[begin:end], counts[one], starts[one]
        if len(mine) > 1 and mine[0][0] - first + n - (mine[-1][-1] - first) <= reach:
            mine[0] = np.concatenate([mine.pop() - n, mine[0]])
        middles += [group.mean() - first for group in mine]
        of += [one] * len(mine)
        begin = end
    which, middle = np.array(of), np.array(middles)
    angle = np.abs(turn[starts[which] + np.round(middle).astype(int)])
    return Turns(which, STEP * middle, angle)


def bends_of(ways: Ways) -> Turns:
    """Middles of stretches of closed ways that turn to one side, and by how much they do in all.

    A round end of some pixels turns as much in several places of which its middle may be none.
    """
    _, starts, counts, turn = ways.turning(SHARP.blur)
    sides = np.where(np.abs(turn) > LEAST_TURN, np.sign(turn), 0.0)
    which, begins, ends = [], [], []
    for k, (first, n) in enumerate(zip(starts.tolist(), counts.tolist(), strict=True)):
        mine = sides[first : first + n]
        cuts = np.flatnonzero(mine != np.roll(mine, 1))
        if len(cuts) < 2:  # nothing turns, or all
            continue
        bends = mine[cuts] != 0.0
        begin, end = cuts[bends], np.append(cuts[1:], cuts[0] + n)[bends]
        if begin[-1] + end[-1] >= 2 * n:  # its middle lies behind the beginning
            begin, end = (np.append(one[-1] - n, one[:-1]) for one in (begin, end))
        begins.append(begin)
        ends.append(end)
        which += [k] * len(begin)
    if not which:
        return Turns(np.empty(0, dtype=np.int64), np.empty(0), np.empty(0))
    of, first, last = np.array(which), STEP * np.concatenate(begins), STEP * np.concatenate(ends)
    half = 0.5 * LONG_STEP
    before, after = (ways.at(of, at + half) - ways.at(of, at - half) for at in (first, last))
    return Turns(of, 0.5 * (first + last), np.abs(_turn(before, after)))


def _turn(before: FloatArray, after: FloatArray) -> FloatArray:
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.arctan2(cross, (before * after).sum(axis=1))


def _sides(
    ways: Ways, own: IntArray, at: FloatArray, near: FloatArray, far: FloatArray, soft: Softness
) -> tuple[FloatArray, BoolArray]:
    """Polynomials of degree 2 in the distance from each corner behind and ahead, and which fit.

    ``far`` (2, k) is how far either side is looked at. Shapes (2, k, 3, 2) and (2, k).
    """
    count, far = len(at), far.ravel()
    own, at, near = np.tile(own, 2), np.tile(at, 2), np.tile(near, 2)
    sign = np.repeat([-1.0, 1.0], count)[:, None]
    span = np.maximum(far - near, SHORTEST_SIDE)
    t = near[:, None] + _SHARES * span[:, None]
    seen = ways.at(np.broadcast_to(own[:, None], t.shape), at[:, None] + sign * t)
    line, line_off = _fitted(seen, 1)
    bent, bent_off = _fitted(seen, 2)
    tie = TIE + TIE_BLURRED * soft.blur + soft.scatter
    straight = line_off <= TIE_FACTOR * bent_off + tie
    c0, c1, c2 = np.moveaxis(np.where(straight[:, None, None], line, bent), 1, 0)
    # From a share of the side to the distance from the corner.
    begin, unit = (near / span)[:, None], 1 / span[:, None]
    fitted = [c0 - begin * c1 + begin**2 * c2, unit * (c1 - 2 * begin * c2), unit**2 * c2]
    off, most = np.where(straight, line_off, bent_off), SMOOTH + SCATTERED * soft.scatter
    return np.stack(fitted, axis=1).reshape(2, count, 3, 2), (off <= most).reshape(2, count)


def _fitted(seen: FloatArray, degree: int) -> tuple[FloatArray, FloatArray]:
    """Least squares polynomials of degree 2 at most, and the root mean square of what is left."""
    fitted = _SOLVED[degree] @ seen
    return fitted, np.sqrt(((_POWERS @ fitted - seen) ** 2).sum(axis=2).mean(axis=1))


def _meeting(
    sides: FloatArray, near: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Where pairs of sides, of shape (2, k, 3, 2), meet, by Newton's method.

    The points that run there from where each side shows, `near` before and behind; turn; how far
    along; how far apart still.
    """
    c0, c1, c2 = np.moveaxis(sides, 2, 0)
    t = np.zeros((*c0.shape[:2], 1))

    def value(t: FloatArray) -> FloatArray:
        return np.asarray(c0 + t * (c1 + t * c2))

    def slope(t: FloatArray) -> FloatArray:
        return np.asarray(c1 + 2 * t * c2)

    for _ in range(6):
        (one, two), (a, b) = value(t), slope(t)
        gap = two - one
        det = b[:, 0] * a[:, 1] - a[:, 0] * b[:, 1]
        det = np.where(np.abs(det) < 1e-9, 1e-9, det)
        t[0, :, 0] += (b[:, 0] * gap[:, 1] - b[:, 1] * gap[:, 0]) / det
        t[1, :, 0] += (a[:, 0] * gap[:, 1] - a[:, 1] * gap[:, 0]) / det
        t = np.clip(t, -SIDE, SIDE)
    ends, (a, b) = value(t), slope(t)
    apart = np.hypot(*(ends[0] - ends[1]).T)
    turn = np.abs(_turn(-a, b))
    shares = np.arange(1, BETWEEN + 1) / (BETWEEN + 1)
    between = [value(t + share * (near[:, None] - t)) for share in shares]
    before, behind = [one[0] for one in between[::-1]], [one[1] for one in between]
    runs = np.stack([*before, 0.5 * (ends[0] + ends[1]), *behind], axis=1)
    return runs, turn, 0.5 * (t[1, :, 0] - t[0, :, 0]), apart
