"""Straight sides beside the turns of outlines, and circles that touch two of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.touching import Touching

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.arc_pixels import ArcPixels
    from shapespline.tracing.sides import Turns, Ways
    from shapespline.typing import FloatArray, IntArray

# Larger radii, pixels, are told by the points of their arcs (TRC-29, TRC-49).
LARGEST = 11.0
# Lengths along the outline from the middle of an arc to where its sides are looked at, which it has
# to end before by so much; how far sides are looked at, how far from the next turn they end, and
# how far they may be from a line in the mean (TRC-29).
NEARS, BEFORE = (1.7, 2.1, 2.5, 3.0, 3.6, 4.3, 5.2, 6.3, 7.5), 0.35
SIDES, CLEAR, STRAIGHT = (4.0, 2.0, 1.0), 1.25, 0.015
# In pictures that are not exact sides are looked at as far as this first, and no nearer than so
# many times what pixels are off by; all lengths grow by so much for each pixel of blur (TRC-47).
LONG_SIDES, STEADY, SPREAD = (20.0, 10.0, 6.0), 100.0, 1.5
# Points of sides are disturbed so far beyond an arc: its pixels reach there.
DISTURBED = 0.8
# Points of each side.
SAMPLES = 9
_SHARES = np.linspace(0.0, 1.0, SAMPLES)


class Reaches(NamedTuple):
    """How far arcs disturb the outline, and from where to where and how straight its sides are."""

    nears: Sequence[float]
    before: float
    sides: Sequence[float]
    clear: float
    straight: float
    disturbed: float

    @classmethod
    def of(cls, pixels: ArcPixels) -> Reaches:
        """In a picture."""
        if pixels.exact:
            return cls(NEARS, BEFORE, SIDES, CLEAR, STRAIGHT, DISTURBED)
        spread = SPREAD * pixels.blur
        nears = [near + spread for near in NEARS]
        sides = [side for side in (*LONG_SIDES, *SIDES) if side >= STEADY * pixels.error]
        straight = STRAIGHT + pixels.error
        return cls(nears, BEFORE + spread, sides, CLEAR + spread, straight, DISTURBED + spread)


def next_turns(turns: Turns, ways: Ways) -> tuple[IntArray, FloatArray]:
    """The turn behind each one along its outline, and how far behind."""
    own, at, _ = turns
    k, first = np.arange(len(own)), np.searchsorted(own, own)
    last = np.searchsorted(own, own, side="right") - 1
    after = np.where(k < last, k + 1, first)
    return after, at[after] - at + np.where(k < last, 0.0, ways.lengths[own])


def sides_found(
    ways: Ways,
    turns: Turns,
    room: FloatArray,
    least: FloatArray,
    reaches: Reaches,
    *,
    nearest: bool,
) -> tuple[IntArray, FloatArray, Touching, FloatArray]:
    """Turns whose sides are straight, from where, circles that touch them, and their numbers.

    From the longest sides that allow a circle through the outline's middle, or from the ``nearest``
    ones, but no nearer than ``least``. ``room`` is there to the next turn.
    """
    own, at, _ = turns
    # All lengths and distances at once.
    tried = np.meshgrid(reaches.sides, reaches.nears, np.flatnonzero(least < np.inf), indexing="ij")
    size, near, some = (np.ravel(one.swapaxes(0, int(nearest))) for one in tried)
    used = near >= least[some]
    used &= near + size <= room[some] - reaches.clear
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
        fit &= ((x * u[:, 1:] - y * u[:, :1]) ** 2).mean(axis=1) <= reaches.straight**2
        sides.append((middle, u))
    near, some = near[fit], some[fit]
    touching = Touching([(p[fit], u[fit]) for p, u in sides])
    number = touching.through(ways.at(own[some], at[some]))
    arcs = touching.arcs(number)
    good = np.flatnonzero((near >= arcs.half_length + reaches.before) & (arcs.radii <= LARGEST))
    # Of each turn what comes first.
    some, which = np.unique(some[good], return_index=True)
    good = good[which]
    return some, near[good], touching.chosen(good), number[good]
