"""Where runs of pieces meet: which of their ends are joined."""

from __future__ import annotations

import math
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from shapespline.formats.places import places

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Piece

# Ends at one place at most among which pairs are looked for: more are a star, no outline.
MOST_AT_ONE_PLACE = 64
# Radians: turns that differ by less are the same.
SAME_TURN = 1e-6


def joints(runs: Sequence[Sequence[Piece]], near: float) -> IntArray:
    """For each end (2 i the start of run i, 2 i + 1 its end) the one it is joined to, or -1.

    Two ends alone at a place are joined. A run with a loose end closes nothing, and is set aside
    as long as there are others at the place. Where more than two are left, those are joined first
    that go on straightest; what comes back to where it began is closed, and frees the place for
    others. Of runs set aside, more than two at a place
    stay apart.

    Parameters
    ----------
    runs : sequence of sequences of Piece
    near : float
        Ends within this distance are one place.
    """
    graph = _Graph(runs, near)
    for end in range(0, 2 * len(runs), 2):
        graph.close(end)
    graph.settle(range(len(graph.free)))
    for one, other in graph.pairs():
        if graph.is_free(one) and graph.is_free(other):
            graph.join(one, other)
    graph.take_back()
    return graph.partner


class _Graph:
    """The places, the free ends at each, and what has been joined."""

    def __init__(self, runs: Sequence[Sequence[Piece]], near: float) -> None:
        self.runs = runs
        self.place, is_crumb = places(runs, near)
        self.partner = np.full(2 * len(runs), -1)
        # The other end of all that an end is joined to.
        self.far = np.arange(2 * len(runs)) ^ 1
        self.free: list[set[int]] = [set() for _ in range(int(self.place.max()) + 1)]
        for end, place in enumerate(self.place.tolist()):
            if not is_crumb[end // 2]:
                self.free[place].add(end)
        self.aside: list[int] = []

    def is_free(self, end: int) -> bool:
        """Whether an end is neither joined nor set aside."""
        return end in self.free[self.place[end]]

    def close(self, end: int) -> bool:
        """Join the two ends of what has come back to where it began."""
        other = int(self.far[end])
        if self.place[end] != self.place[other] or not self.is_free(end):
            return False
        self._tie(end, other)
        return True

    def join(self, one: int, other: int) -> None:
        """Join two ends at a place, and what follows from it."""
        begin = int(self.far[one])
        if begin != other:
            self._tie(one, other)
        self.close(begin)
        self.settle([int(self.place[one]), int(self.place[begin])])

    def _tie(self, one: int, other: int) -> None:
        self.partner[one], self.partner[other] = other, one
        begin, end = int(self.far[one]), int(self.far[other])
        self.far[begin], self.far[end] = end, begin
        self.free[self.place[one]] -= {one, other}

    def settle(self, places: Iterable[int]) -> None:
        """Set aside what has a loose end, then join two ends that are alone at a place."""
        waiting = list(places)
        alone: list[int] = []
        while waiting or alone:
            if waiting:
                at = waiting.pop()
                if len(self.free[at]) == 1:
                    waiting.append(self._set_aside(min(self.free[at])))
                elif len(self.free[at]) == 2:
                    alone.append(at)
                continue
            at = alone.pop()
            if len(self.free[at]) == 2:
                one, other = sorted(self.free[at])
                begin = int(self.far[one])
                self._tie(one, other)
                if self.close(begin):
                    waiting.append(int(self.place[begin]))

    def _set_aside(self, end: int) -> int:
        """Take a chain with a loose end away, and return the place of its other end."""
        other = int(self.far[end])
        for loose in (end, other):
            self.free[self.place[loose]].discard(loose)
        self.aside += [end, other]
        return int(self.place[other])

    def pairs(self) -> list[tuple[int, int]]:
        """Free ends at one place, in the order in which they are to be joined."""
        found = [
            (round(self._turn(one, other) / SAME_TURN), one, other)
            for free in self.free
            if 2 < len(free) <= MOST_AT_ONE_PLACE
            for one, other in combinations(sorted(free), 2)
            if one ^ 1 != other
        ]

        return [(one, other) for _, one, other in sorted(found)]

    def _turn(self, one: int, other: int) -> float:
        """Angle by which the way from one end on to the other turns."""
        (x, y), (u, v) = self._direction(one), self._direction(other)
        return abs(math.atan2(y * u - x * v, -(x * u + y * v)))

    def _direction(self, end: int) -> FloatArray:
        """The way from an end into its run."""
        run = self.runs[end // 2]
        line = run[-1].control_points[::-1] if end % 2 else run[0].control_points
        away = line - line[0]
        return away[int(np.flatnonzero(away.any(axis=1))[0])]

    def take_back(self) -> None:
        """Join what was set aside where two ends of it are alone."""
        for end in self.aside:
            self.free[self.place[end]].add(end)
        for free in self.free:
            if len(free) == 2:
                self._tie(*sorted(free))
