"""Square ends of strokes of few pixels as they were drawn: both corners at once.

Two corners that are nearer to each other than what a pixel's square disturbs show no side between
them. But the two sides that lead there and back do show, farther away, and of all lines across the
stroke the ink of the pixels about tells one: Newton's method for the one number that is left. It is
taken if these pixels agree one by one, and are surer of it than of a round end with as much ink and
of the outline as it was.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.arc_sides import Reaches, next_turns, sides_found
from shapespline.tracing.corners import with_corners
from shapespline.tracing.coverage import border_coverage
from shapespline.tracing.roundings import (
    LONGEST_STEP,
    ROUNDS,
    SURE,
    TOLD,
    TOLD_END,
    TOLD_NOISE,
)
from shapespline.tracing.sides import Corners, Ways, bends_of
from shapespline.tracing.touching import ARC_POINTS, NEARLY_BACK

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.arc_pixels import ArcPixels, Missed
    from shapespline.tracing.touching import Touching
    from shapespline.typing import BoolArray, FloatArray, IntArray

# A stroke is no narrower than this, pixels.
NARROWEST = 0.5
# By how much of the width of a stroke a round end goes beyond a square one with as much ink.
FARTHER = 0.5 - 0.125 * np.pi
# Points of a side between where it shows undisturbed and the end (TRC-48).
BETWEEN = 2
_BETWEEN = np.linspace(0.0, 1.0, BETWEEN + 2)[:, None]
_ACROSS = np.linspace(0.0, 1.0, ARC_POINTS)[:, None]


def squared(
    outlines: Sequence[FloatArray], drawn: Sequence[bool], pixels: ArcPixels, inks: FloatArray
) -> list[FloatArray]:
    """Outlines with the square ends of strokes that the picture shows; all others as they are.

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
    ends = _Ends.of(outlines, np.flatnonzero(drawn), pixels)
    if ends is None:
        return list(outlines)
    closed = [True] * len(outlines)

    def missed(some: Corners, drawn: Corners | None) -> Missed:
        lines = outlines if drawn is None else with_corners(outlines, drawn, closed)
        covered = border_coverage(lines, *pixels.field.shape)
        return pixels.missed(some.runs, covered, inks[some.own])

    # Only those that miss the outline by enough to be surer of another.
    was = missed(ends.square(), None)
    wrong = _surer(np.zeros(len(ends.far)), was.mean, was.seen, pixels.error)
    if not wrong.any():
        return list(outlines)
    ends = ends.chosen(wrong)
    for _ in range(ROUNDS):
        square = ends.square()
        found = missed(square, square)
        step = ends.step_for(found.ink.sum(axis=1))
        ends = ends._replace(far=ends.far + np.clip(step, -LONGEST_STEP, LONGEST_STEP))
    off = found.mean
    worse = np.minimum(missed(square, None).mean, missed(square, ends.round(square)).mean)
    good = off <= TOLD_END + TOLD_NOISE * pixels.error
    good &= _surer(off, worse, found.seen, pixels.error)
    return with_corners(outlines, square.chosen(good), closed)


def _surer(off: FloatArray, worse: FloatArray, seen: IntArray, error: float) -> BoolArray:
    """Whether pixels miss one drawing by so much less than another that it is no chance.

    They are off by no less than what they miss the better one by, and what arcs may miss (TRC-48).
    """
    error_of_each = np.maximum(off, max(error, TOLD))
    return np.asarray((worse**2 - off**2) * seen >= (SURE * error_of_each) ** 2)


class _Ends(NamedTuple):
    """Where outlines lead back between straight sides, and how far out each end lies.

    Attributes
    ----------
    own : ndarray of int, shape (n,)
        The outline of each.
    at, near : ndarray, shape (n,)
        Arc length of its middle, and from there to where its sides show.
    begins, behinds : ndarray, shape (n, 2)
        Where they do.
    touching : Touching
    far : ndarray, shape (n,)
        On the way out.
    """

    own: IntArray
    at: FloatArray
    near: FloatArray
    begins: FloatArray
    behinds: FloatArray
    touching: Touching
    far: FloatArray

    @classmethod
    def of(cls, outlines: Sequence[FloatArray], used: IntArray, pixels: ArcPixels) -> _Ends | None:
        """Of some outlines; None if there are none."""
        if len(used) == 0:
            return None
        ways = Ways([outlines[k] for k in used], [True] * len(used))
        bends = bends_of(ways)
        back = bends.turn >= NEARLY_BACK
        if not back.any():
            return None
        after, ahead = next_turns(bends, ways)
        before = np.argsort(after)
        room = np.minimum(ahead, ahead[before])
        least = np.where(back, 0.0, np.inf)
        reaches = Reaches.of(pixels)
        some, near, touching, _ = sides_found(ways, bends, room, least, reaches, nearest=False)
        reach = np.zeros(len(back))
        reach[some] = near
        overlap = np.minimum(reach, reach[after]) > 0.0
        overlap &= reach + reach[after] > ahead
        good = (np.abs(touching.turns) >= NEARLY_BACK) & ~(overlap | overlap[before])[some]
        if not good.any():
            return None
        some, near, touching = some[good], near[good], touching.chosen(good)
        own, at = bends.own[some], bends.at[some]
        begins, behinds = (
            p + ((ways.at(own, at + sign * near) - p) * u).sum(axis=1)[:, None] * u
            for sign, (p, u) in zip((-1.0, 1.0), touching.sides, strict=True)
        )
        far = (ways.at(own, at) * touching.out).sum(axis=1)
        return cls(used[own], at, near, begins, behinds, touching, far)

    def chosen(self, which: BoolArray) -> _Ends:
        """Some of them."""
        columns = {name: getattr(self, name) for name in self._fields if name != "touching"}
        some = {name: column[which] for name, column in columns.items()}
        return self._replace(touching=self.touching.chosen(which), **some)

    def square(self) -> Corners:
        """Lines across."""
        out = self.touching.out
        one, two = (
            p + ((self.far - (p * out).sum(axis=1)) / (u * out).sum(axis=1))[:, None] * u
            for p, u in self.touching.sides
        )
        return self._with(one[:, None] + _ACROSS * (two - one)[:, None])

    def round(self, square: Corners) -> Corners:
        """Half circles with as much ink as square ends."""
        one, two = square.runs[:, BETWEEN + 1], square.runs[:, -BETWEEN - 2]
        width = np.hypot(*(two - one).T)[:, None]
        apex = 0.5 * (one + two) + FARTHER * width * self.touching.out
        arcs = self.touching.arcs(self.touching.through(apex))
        return self._with(arcs.points(arcs.chord_radii))

    def step_for(self, ink: FloatArray) -> FloatArray:
        """How much farther out ends lie for so many square pixels of ink more."""
        (p1, u1), (p2, _) = self.touching.sides
        off = p2 - p1
        width = np.abs(u1[:, 0] * off[:, 1] - u1[:, 1] * off[:, 0])
        return np.asarray(self.touching.ways * ink / np.maximum(width, NARROWEST))

    def _with(self, points: FloatArray) -> Corners:
        """Points in place of what lies between where the sides show."""
        begin, behind = self.begins[:, None], self.behinds[:, None]
        before = begin + _BETWEEN * (points[:, :1] - begin)
        after = points[:, -1:] + _BETWEEN * (behind - points[:, -1:])
        runs = np.concatenate([before[:, :-1], points, after[:, 1:]], axis=1)
        middle, turns = points[:, ARC_POINTS // 2], np.abs(self.touching.turns)
        return Corners(self.own, middle, turns, self.at - self.near, self.at + self.near, runs)
