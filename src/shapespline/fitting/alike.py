"""Outlines that are one but for their places, read as one of them is.

Noise, and what corners were taken for in a picture, make outlines that are copies be told by other
pieces. Where the data of some agree, the lines and arcs that most of them have, of these the ones
that tell all of them for the least, stand for those that were read otherwise (DRA-63).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.drawn import PRICE
from shapespline.fitting.across import MISSED, MOST_OUTLINES
from shapespline.fitting.copies import is_as_good, may_be_copy
from shapespline.fitting.motions import Motion, Placed, motion_between
from shapespline.geometry import nearest, polyline_curve
from shapespline.validation import median
from shapespline.values import Contour

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.values import Fit

# Level lines of copies are apart by no more than so many pixels, as their corners are cut off by
# the grid, and so many deviations (DRA-63).
LEVEL_APART, NOISE_APART = 0.4, 2.0
# Lengths of copies differ by less than this part in pictures, and among noisy points (DRA-63).
LENGTHS, NOISY_LENGTHS = 0.03, 0.1
# Lines and arcs of copies may be so many pixels farther from the outline of one, which a picture's
# corners may be off (DRA-63).
FARTHER = 2.0
# Outlines of each reading that are tried, outlines on which they are, and points of these.
EACH, MOST_JUDGED, MOST_POINTS = 3, 8, 400
# Numbers that a line and an arc take; one of so many outlines at least is of these alone where they
# stand for all. Curves follow errors that copies share, and are those of `equal_copies` (DRA-63).
NUMBERS, LEAST = {"l": 2, "a": 3}, 3


def read_alike(fits: Sequence[Fit], tolerance: float | None) -> list[Fit]:
    """The fits, with the pieces of one of some copies for all of them that have others.

    Parameters
    ----------
    fits : sequence of Fit
    tolerance : float or None
        The one asked for.
    """
    able = [k for k, fit in enumerate(fits) if may_be_copy(fit)]
    found = list(fits)
    if not 1 < len(able) <= MOST_OUTLINES:
        return found
    for group in _groups([_Read.of(k, fits[k]) for k in able]):
        for place, fit in group.told_alike(tolerance):
            found[place] = fit
    return found


class _Read(NamedTuple):
    """An outline by its place among all, and the kinds of its pieces wherever they begin."""

    place: int
    placed: Placed
    kinds: str

    @classmethod
    def of(cls, place: int, fit: Fit) -> _Read:
        """A fit; a picture's outline is compared by its level line, which nothing was put into."""
        line = fit.contour.level_line
        own = fit.contour if line is None else Contour.silently(line, closed=True)
        return cls(place, Placed(fit, own), _kinds(fit))

    @property
    def is_traced(self) -> bool:
        """Whether a picture tells it."""
        return self.placed.fit.contour.level_line is not None

    @property
    def is_plain(self) -> bool:
        """Whether it is of lines and arcs alone."""
        return set(self.kinds) <= NUMBERS.keys()

    @property
    def step(self) -> float:
        """From a point of the line to the next; of a picture's a pixel."""
        return median(np.diff(self.placed.line.arc_length))

    @property
    def apart(self) -> float:
        """How far the lines of copies may be apart."""
        if self.is_traced:
            return LEVEL_APART * self.step + NOISE_APART * self.placed.deviation
        return MISSED * self.placed.deviation + 0.5 * self.step

    @property
    def price(self) -> float:
        """Of all numbers of its lines and arcs."""
        return PRICE * sum(NUMBERS[kind] for kind in self.kinds)


def _kinds(fit: Fit) -> str:
    """The first letters of the kinds of pieces, from whichever piece on, whichever way round."""
    row = "".join(piece.kind[0] for piece in fit.pieces)
    return min(way[k:] + way[:k] for way in (row, row[::-1]) for k in range(len(row)))


@dataclass(eq=False)
class _Group:
    """Outlines that are copies of the first, and the motion that maps this onto each."""

    members: list[_Read]
    motions: list[Motion]

    @classmethod
    def of(cls, first: _Read) -> _Group:
        """One outline alone."""
        return cls([first], [Motion(np.eye(2), np.zeros(2), is_mirror=False)])

    def takes(self, other: _Read) -> bool:
        """Whether an outline is a copy, which is a member then."""
        head, apart = self.members[0], max(self.members[0].apart, other.apart)
        lengths = LENGTHS if head.is_traced else NOISY_LENGTHS
        motion = motion_between(head.placed, other.placed, apart, lengths)
        if motion is None:
            return False
        motion = motion.nearer(head.placed, other.placed)
        if not _agree(head.placed, motion, other.placed, apart):
            return False
        self.members.append(other)
        self.motions.append(motion)
        return True

    def told_alike(self, tolerance: float | None) -> Iterator[tuple[int, Fit]]:
        """New fits of those that are told otherwise than most, by their places."""
        best = self._best()
        if best is None:
            return
        head = self.members[best]
        for k, one in enumerate(self.members):
            motion = self._motion(best, k)
            if not _is_off(head, motion, one):
                continue
            fit = head.placed.as_fit_of(one.placed, motion, tolerance)
            near = one.kinds != head.kinds and _is_near(fit, head, one)
            if fit.kept and (near or is_as_good(fit, head.placed, one.placed)):
                yield one.place, fit

    def _best(self) -> int | None:
        """The member whose lines and arcs stand for all; None if all have them, or few any."""
        readings: dict[str, list[int]] = {}
        for k, one in enumerate(self.members):
            if one.is_plain:
                readings.setdefault(one.kinds, []).append(k)
        if LEAST * sum(map(len, readings.values())) < len(self.members):
            return None
        head, *others = self.members
        if not any(map(partial(_is_off, head), self.motions[1:], others)):
            return None
        most = max(map(len, readings.values()))
        tried = (k for alike in readings.values() if len(alike) == most for k in alike[:EACH])
        return min(tried, key=self._cost)

    def _cost(self, k: int) -> float:
        """What the pieces of one cost in the mean of some: misfit, and the price of numbers."""
        judged = range(min(len(self.members), MOST_JUDGED))
        return self.members[k].price + float(np.mean([self._misfit(k, m) for m in judged]))

    def _misfit(self, k: int, m: int) -> float:
        """Half of chi squared of the pieces of one as those of another."""
        other = self.members[m].placed
        curve = self.members[k].placed.spline_at(self._motion(k, m), other)
        contour = other.fit.contour
        every = len(contour) // MOST_POINTS + 1
        off_sq = nearest(curve, contour.points[::every]).distances_sq / other.deviation**2
        return 0.5 * every * float(off_sq.sum())

    def _motion(self, k: int, m: int) -> Motion:
        """From one member to another."""
        return self.motions[m].after(self.motions[k].back())


def _is_off(head: _Read, motion: Motion, other: _Read) -> bool:
    """Whether an outline is of other pieces than one, or its joints are not where those are."""
    if other.kinds != head.kinds:
        return True
    shown, own = (
        np.array([piece.control_points[0] for piece in pieces])
        for pieces in (head.placed.pieces_at(motion, other.placed), other.placed.fit.pieces)
    )
    if len(own) < 2:
        return False
    off = np.hypot(*(shown[:, None] - own).transpose(2, 0, 1)).min(axis=1)
    return bool(off.max() > MISSED * max(head.placed.deviation, other.placed.deviation))


def _is_near(fit: Fit, head: _Read, other: _Read) -> bool:
    """Whether lines and arcs of one are no farther from a picture's outline than corners may be."""
    old, own = other.placed.fit, head.placed.fit
    far = max(old.hausdorff_distance, own.hausdorff_distance) + FARTHER * other.step
    return other.is_traced and fit.hausdorff_distance <= far


def _agree(head: Placed, motion: Motion, other: Placed, apart: float) -> bool:
    """Whether points of either line are nowhere farther from the other."""
    ways = (head, motion, other), (other, motion.back(), head)
    return all(
        nearest(polyline_curve(to.line), one.images(one.some, way, to)).distances_sq.max()
        <= apart**2
        for one, way, to in ways
    )


def _groups(outlines: Sequence[_Read]) -> list[_Group]:
    """Outlines of lines and arcs with all that are copies of one of them."""
    groups: list[_Group] = []
    for one in sorted(outlines, key=lambda one: not one.is_plain):
        if not any(group.takes(one) for group in groups) and one.is_plain:
            groups.append(_Group.of(one))
    return groups
