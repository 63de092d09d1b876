"""Lines and circles of an outline in one vector of unknowns, estimated under equations.

Unknowns of a line are its direction of travel and its offset along the left normal, of a circle the
centre and the radius; equations and the method that meets them are in the kernel.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from shapespline import _kernels
from shapespline.engines.drawn.segments import ARC, FREE, LINE, PRICE, longest_gap

if TYPE_CHECKING:
    from shapespline._kernels import Equation
    from shapespline.engines.drawn.observed import Observed
    from shapespline.engines.drawn.segments import Segments
    from shapespline.typing import FloatArray

# Rounds, and the step that ends them in parts of the extent.
ROUNDS, LEAST_STEP = 8, 1e-11
# An equation follows from others if it leaves less than this part of its entries (DRA-41).
IMPLIED = 1e-6
# No step is longer than this part of the extent, or of the largest circle: the centre of a nearly
# straight arc is far, and moves far (DRA-34).
LONGEST_STEP = 0.3
# Short pieces count points nearer to their nodes, by this part.
SHORT, NEARER = 8.0, 0.5
# Leverage of the last of many points, times their number: of a parabola for an arc (DRA-15).
END_LEVERAGE, LARGEST_LEVERAGE = {LINE: 4.0, ARC: 9.0}, 0.9

# First point, number of steps and kind of a segment.
Key: TypeAlias = tuple[int, int, int]


class Misfit(NamedTuple):
    """Of one element: chi squared, what its points count, the largest distance of one of them."""

    chi_sq: float
    n_counted: float
    largest: float

    @property
    def mean(self) -> float:
        """Root mean square in deviations."""
        return float(np.sqrt(self.chi_sq / max(self.n_counted, 1e-9)))


@dataclass(eq=False)
class Model:
    """Elements of an outline: lines (direction, offset) and circles (centre, radius).

    ``at[k]`` is where the unknowns of segment k begin in ``x``; ``ways[k]`` is 1 for arcs that turn
    left, else -1. ``ends`` (2, 2) are those of an open outline, where they are held: the first and
    the last element pass through them.
    """

    seen: Observed
    row: Segments
    x: FloatArray = field(default_factory=lambda: np.empty(0))
    at: dict[int, int] = field(default_factory=dict)
    ways: dict[int, float] = field(default_factory=dict)
    constraints: list[Equation] = field(default_factory=list)
    alone: dict[Key, tuple[float, ...]] = field(default_factory=dict)
    beside: set[Key] = field(default_factory=set)
    ends: FloatArray | None = None
    # What was found at a vector of unknowns, which is never changed in place.
    _listed: tuple[FloatArray, list[float]] | None = None
    known_nodes: tuple[FloatArray, dict[int, FloatArray]] | None = None
    _known_misfits: tuple[FloatArray, dict[int, Misfit]] | None = None

    @classmethod
    def of(
        cls,
        seen: Observed,
        row: Segments,
        before: Model | None = None,
        ends: FloatArray | None = None,
    ) -> Model:
        """Each element fitted alone; what an earlier model of the same points knows is taken."""
        model = cls(seen, row, ends=ends)
        if before is not None:
            model.alone, model.beside = before.alone, before.beside
        x: list[float] = []
        for k, (i, j, kind) in enumerate(row.found):
            if kind == FREE:
                continue
            model.at[k] = len(x)
            key = model._key(k)
            if key not in model.alone:
                own = _kernels.line_through if kind == LINE else _kernels.circle_through
                model.alone[key] = own(*model.counted(k))
                if model._begins_beside(k):
                    model.beside.add(key)
                    model.alone[key] = own(*model.counted(k))
            x += model.alone[key]
            if kind == ARC:
                model.ways[k] = _way(row.points[i : j + 1], np.array(x[-3:-1]))
        model.x = np.array(x)
        if ends is not None:
            for k, (px, py) in zip((0, len(row.found) - 1), ends.tolist(), strict=True):
                if k in model.at:
                    held = _kernels.PassesThrough(model.at[k], model.kind(k) == LINE, px, py)
                    model.constraints.append(held)
        return model

    def kind(self, k: int) -> int:
        """What segment k is."""
        return self.row.found[k].kind

    def unknowns(self, k: int) -> list[float]:
        """Those of segment k."""
        if self._listed is None or self._listed[0] is not self.x:
            self._listed = self.x, self.x.tolist()
        o = self.at[k]
        return self._listed[1][o : o + (2 if self.kind(k) == LINE else 3)]

    @property
    def n_own(self) -> int:
        """How many unknowns belong to elements."""
        return max((o + 2 + (self.kind(k) == ARC) for k, o in self.at.items()), default=0)

    @cached_property
    def lengths(self) -> list[float]:
        """Of the data of each segment."""
        s = self.row.stations.tolist()
        return [s[j] - s[i] for i, j, _ in self.row.found]

    @cached_property
    def extent(self) -> float:
        """Of the outline."""
        return 2.0 * self.seen.box[1]

    def _key(self, k: int) -> Key:
        """Which points a segment has and what it is, wherever the row begins."""
        i, j, kind = self.row.found[k]
        return ((self.row.first + i) % len(self.seen.points), j - i, kind)

    def _begins_beside(self, k: int) -> bool:
        """Whether the first point of a segment belongs to the one before it alone (DRA-15).

        A corner may lie between two points, if no picture blunted it. Chi squared without that
        point is less by the square of its residual over one minus its leverage.
        """
        (i, j, kind), s = self.row.found[k], self.row.stations
        if self.seen.skip or j <= i + 2 or s[i + 1] - s[i] >= longest_gap(self.seen):
            return False
        x, (px, py) = self.alone[self._key(k)], self.row.points[i]
        if kind == LINE:
            off = np.cos(x[0]) * py - np.sin(x[0]) * px - x[1]
        else:
            off = np.hypot(px - x[0], py - x[1]) - x[2]
        leverage = min(END_LEVERAGE[kind] / (j - i + 1), LARGEST_LEVERAGE)
        return float(off / self.seen.deviation) ** 2 > 2.0 * PRICE * (1.0 - leverage)

    def span(self, k: int) -> tuple[int, int]:
        """First and last point that count for segment k."""
        i, j, kind = self.row.found[k]
        s, skip = self.row.stations, self.seen.skip
        if not skip:
            return i + (self._key(k) in self.beside), j
        if s[j] - s[i] < SHORT * skip:
            skip *= NEARER
        least = 3 if kind == LINE else 5
        a = int(np.searchsorted(s, s[i] + skip))
        b = int(np.searchsorted(s, s[j] - skip, side="right")) - 1
        if b - a + 1 < least:
            a, b = min(i + 1, j), max(j - 1, i)
        return (i, j) if b - a + 1 < least else (a, b)

    def counted(self, k: int) -> tuple[FloatArray, FloatArray]:
        """Points and weights of segment k."""
        a, b = self.span(k)
        return self.row.points[a : b + 1], self.row.weights[a : b + 1]

    @cached_property
    def _elements(self) -> _kernels.Elements:
        """The points that count, of all elements."""
        data = [self.counted(k) for k in self.at]
        numbers = [len(weights) for _, weights in data]
        weights = counts = np.concatenate([weights for _, weights in data])
        if self.seen.precisions is not None:
            counts = np.full(len(weights), 1.0 / self.seen.apart)
        return _kernels.Elements(
            [self.kind(k) == LINE for k in self.at],
            list(self.at.values()),
            np.cumsum([0, *numbers])[:-1].tolist(),
            np.concatenate([points for points, _ in data]),
            weights,
            counts,
            self.seen.deviation,
        )

    def misfits(self) -> dict[int, Misfit]:
        """Misfit of each element."""
        known = self._known_misfits
        if known is None or known[0] is not self.x:
            found = zip(self.at, self._elements.misfits(self.x), strict=True)
            known = self._known_misfits = self.x, {k: Misfit(*one) for k, one in found}
        return known[1]

    @property
    def chi_sq(self) -> float:
        """Of all elements."""
        return sum(misfit.chi_sq for misfit in self.misfits().values())

    def solve(self, rounds: int = ROUNDS) -> None:
        """The best estimate under the constraints."""
        if not len(self.x):
            return
        limits = _kernels.EstimateLimits(
            rounds=rounds,
            extent=self.extent,
            least_step=LEAST_STEP,
            longest_step=LONGEST_STEP,
            implied=IMPLIED,
        )
        x = self.x.copy()
        _kernels.estimate(self._elements, self.constraints, x, limits)
        self.x = x

    def _meeting_steps(self) -> _kernels.MeetingSteps:
        """The steps that meet the constraints, linearised."""
        return _kernels.MeetingSteps(self._elements, self.constraints, self.x, self.extent, IMPLIED)

    def meets_constraints(self, within: float) -> bool:
        """Whether no equation is off by more."""
        values = _kernels.equation_values(self.constraints, self.x)
        return all(abs(value) <= within for value in values)

    @property
    def n_free(self) -> int:
        """How many numbers the constraints leave free."""
        return self._meeting_steps().n_free()

    def covariance(self) -> FloatArray:
        """Of the estimate under all constraints, systematic errors added."""
        n, own_end = len(self.x), self.n_own
        found, weights = np.zeros((n, n)), np.zeros((n, n))
        found[range(own_end, n), range(own_end, n)] = (10 * self.extent) ** 2
        weights[range(own_end, n), range(own_end, n)] = (10 * self.extent) ** -2
        floors = np.full((len(self.at), 3), self.seen.floor)
        s = self.row.stations
        for row, k in enumerate(self.at):
            i, j, kind = self.row.found[k]
            if kind == LINE:
                floors[row, 0] = 2 * self.seen.floor / max(float(s[j] - s[i]), 1e-300)
        self._elements.covariance(self.x, floors, found, weights)
        if self.constraints:
            self._meeting_steps().covariance(weights, found)
        return found


def _way(points: FloatArray, centre: FloatArray) -> float:
    out = points - centre
    turn = np.arctan2(
        out[:-1, 0] * out[1:, 1] - out[:-1, 1] * out[1:, 0], (out[:-1] * out[1:]).sum(axis=1)
    )
    return 1.0 if turn.sum() > 0 else -1.0
