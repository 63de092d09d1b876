"""What a drawing repeats: tangency, directions, centres, radii, each only where the data allow it.

Every regularity is an equation that is tested against the covariance of the estimate (Wald's test)
and, once taken, conditions both (a Kalman step), so later tests use what earlier ones taught. After
each family all is estimated anew; if an element fits badly the family is given back.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot, pi, remainder
from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.engines.drawn.joints import meeting, turn_at
from shapespline.engines.drawn.lengths import edge_of
from shapespline.engines.drawn.segments import ARC, LINE
from shapespline.engines.drawn.symmetry import symmetries
from shapespline.values import Regularity

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Sequence

    from shapespline._kernels import Equation
    from shapespline.engines.drawn.model import Misfit, Model
    from shapespline.typing import FloatArray

NAMES = (
    "tangent",
    "rotation",
    "mirror",
    "axis-parallel",
    "parallel",
    "perpendicular",
    "concentric",
    "equal-radius",
    "collinear",
    "equal-length",
    "equal-copies",
    "equal-spacing",
)
# Squared standard errors that an equation may be off by, a tangent joint by more; nats by which it
# must be a surprise (DRA-04).
LARGEST, LARGEST_TANGENT, LEAST_SURPRISE = 9.0, 16.0, 1.0
# Of the square of an error that one equation may have each of several may have this part (DRA-04).
EACH_OF_SEVERAL = 0.75
# Joints that turn by less, radians, may be tangent; directions, radians, and radii, parts, that may
# agree. Edges of small letters in a picture lean by more, and a few noisy points by as much as
# their error allows (DRA-48).
TANGENT_TURN, DIRECTIONS, RADII = 0.35, 0.03, 0.25
OF_PICTURES, HARDLY_TANGENT = 0.05, 1.0
# Deviations by which lengths that agree may differ: what flat corners tell is no witness
# (DRA-21).
LENGTHS = 3.0
# An element fits badly after a family of regularities if its misfit, in deviations, grows by more
# than these allow (DRA-04).
WORSE_PART, WORSE_BY, ANYHOW = 1.5, 0.7, 1.5
# Equations are met when none is off by more, in parts of the extent.
MET = 1e-8
# Variances below this part of the largest are none: the equation follows from others.
IMPLIED = 1e-10


@dataclass(eq=False)
class Search:
    """Tests equations on a model and takes those that hold."""

    model: Model
    allowed: Collection[str]
    wide: bool = False  # whether what is hardly known may be off by as much as its error
    covariance: FloatArray = field(default_factory=lambda: np.empty((0, 0)))
    found: list[Regularity] = field(default_factory=list)
    _known_at: FloatArray | None = None  # the estimate whose covariance it is
    _apart: set[int] = field(default_factory=set)  # elements that are tangent to none

    def run(self) -> list[Regularity]:
        """All families in turn; the model holds the estimate under what was taken."""
        model = self.model
        if not len(model.x):
            return []
        model.solve()
        self._family("tangent", self._tangents)
        if "rotation" in self.allowed or "mirror" in self.allowed:
            for name, order, off in symmetries(model, self.allowed, fits_badly):
                self.found.append(Regularity(name, tuple(model.at), off, order))
        self._family("axis-parallel", self._directions)
        self._family("concentric", self._centres)
        self._family("equal-radius", self._radii)
        self._family("collinear", self._collinear)
        self._family("equal-length", self._lengths)
        return self.found

    def _family(self, name: str, tried: Callable[[], Iterator[Regularity]]) -> None:
        """The equations of one family that hold; where an element fits badly none of them.

        Tangency is about two elements, not all: of measured points one may have a neighbour's,
        and the others are tried without it (DRA-43).
        """
        model = self.model
        if name not in self.allowed and name != "axis-parallel":
            return
        kept, before = (model.x, list(model.constraints)), model.misfits()
        while True:
            if self._known_at is not model.x:
                self.covariance = model.covariance()
            taken = list(tried())
            # Equations that hold condition it with the estimate; where none does it stays.
            self._known_at = model.x if model.x is kept[0] else None
            if not taken:
                return
            model.solve()
            bad = badly_fitting(model, before)
            if not bad:
                self.found += taken
                return
            model.x, model.constraints = kept[0], list(kept[1])
            joined = {k for one in taken for k in one.pieces}
            if name != "tangent" or model.seen.pixel or not bad & joined:
                return
            self._apart |= bad

    def takes(self, equation: Equation, span: float | None, largest: float = LARGEST) -> bool:
        """Whether an equation holds; then estimate and covariance are conditioned by it.

        ``span`` is the range that its value could have: that it is nothing must be a surprise.
        """
        model = self.model
        limits = _kernels.EquationLimits(
            largest=largest,
            largest_each=EACH_OF_SEVERAL,
            span=span or 0.0,
            least_surprise=LEAST_SURPRISE,
            implied=IMPLIED,
            met=MET * model.extent,
        )
        x = model.x.copy()
        if not _kernels.take_equation(x, self.covariance, equation, limits):
            return False
        model.x = x
        model.constraints.append(equation)
        return True

    def _tangents(self) -> Iterator[Regularity]:
        model, n = self.model, len(self.model.row.found)
        for k in range(n if model.seen.closed else n - 1):
            m = (k + 1) % n
            if k == m or k not in model.at or m not in model.at:
                continue
            if k in self._apart or m in self._apart:
                continue
            equation = tangency(model, k, m)
            if equation is None:
                continue
            near = model.row.points[model.row.found[k].end]
            turn = turn_at(model, k, m, meeting(model, k, m, near))
            most = HARDLY_TANGENT if self.wide else TANGENT_TURN
            if turn < most and self.takes(equation, None, LARGEST_TANGENT):
                yield Regularity("tangent", (k, m), float(np.degrees(turn)))

    def _directions(self) -> Iterator[Regularity]:
        near = OF_PICTURES if self.model.seen.pixel else DIRECTIONS
        heads: list[int] = []
        for k in self._best_known(LINE, 0):
            found = self._direction(k, heads, near)
            if found is None and self.wide:
                found = self._direction(k, heads, pi / 4)
            if found is None:
                heads.append(k)
                continue
            yield found
            if found.name == "axis-parallel":
                heads.insert(0, k)

    def _direction(self, k: int, heads: Sequence[int], most: float) -> Regularity | None:
        """What the direction of a line agrees with up to an angle: an axis or that of a head."""
        model, quarter = self.model, pi / 2
        o, own = model.at[k], model.unknowns(k)[0]
        turn = round(own / quarter) * quarter
        off = own - turn
        level = "axis-parallel" in self.allowed and abs(off) < most
        if level and self.takes(_kernels.Difference((o,), (), turn), quarter):
            return Regularity("axis-parallel", (k,), float(np.degrees(off)))
        for head in heads:
            p, other = model.at[head], model.unknowns(head)[0]
            turns = round((own - other) / quarter)
            name = "perpendicular" if turns % 2 else "parallel"
            off = own - other - turns * quarter
            if name not in self.allowed or abs(off) >= most:
                continue
            if self.takes(_kernels.Difference((o,), (p,), turns * quarter), quarter):
                return Regularity(name, (head, k), float(np.degrees(off)))
        return None

    def _centres(self) -> Iterator[Regularity]:
        model = self.model
        heads: list[int] = []
        for k in self._best_known(ARC, 2):
            o = model.at[k]
            for head in heads:
                p = model.at[head]
                off = hypot(*(model.x[o : o + 2] - model.x[p : p + 2]))
                if off > 0.5 * min(model.x[o + 2], model.x[p + 2]):
                    continue
                if self.takes(_kernels.Difference((o, o + 1), (p, p + 1)), model.extent):
                    yield Regularity("concentric", (head, k), off)
                    break
            else:
                heads.append(k)

    def _radii(self) -> Iterator[Regularity]:
        model = self.model
        heads: list[int] = []
        for k in self._best_known(ARC, 2):
            o = model.at[k] + 2
            for head in heads:
                p = model.at[head] + 2
                off = float(model.x[o] - model.x[p])
                if not self.wide and abs(off) > RADII * model.x[p]:
                    continue
                if self.takes(_kernels.Difference((o,), (p,)), 0.5 * model.extent):
                    yield Regularity("equal-radius", (head, k), off)
                    break
            else:
                heads.append(k)

    def _collinear(self) -> Iterator[Regularity]:
        model, lines = self.model, self._best_known(LINE, 0)
        for i, k in enumerate(lines):
            for head in lines[:i]:
                o, p = model.at[k], model.at[head]
                turn = float(model.x[o] - model.x[p])
                if abs(remainder(turn, pi)) > MET:
                    continue
                sign = 1.0 if np.cos(turn) > 0 else -1.0
                off = float(model.x[o + 1] - sign * model.x[p + 1])
                if abs(off) > 0.001 * model.extent + 10 * self.model.seen.deviation:
                    continue
                equation = _kernels.Difference((o + 1,), (p + 1,), sign=sign)
                if self.takes(equation, model.extent):
                    yield Regularity("collinear", (head, k), off)
                    break

    def _lengths(self) -> Iterator[Regularity]:
        model = self.model
        edges = {k: edge for k in model.at if (edge := edge_of(model, k)) is not None}
        heads: dict[int, list[int]] = {}
        furthest: dict[int, float] = {}
        # Any two of many may agree by chance: each has its part of the range.
        span = model.extent / max(len(edges), 1)
        at, known = model.x, dict[int, float]()

        def length(k: int) -> float:
            nonlocal at
            if at is not model.x:  # an equation was taken
                at = model.x
                known.clear()
            if k not in known:
                known[k] = edges[k].length(model.x)
            return known[k]

        for k in sorted(edges, key=lambda k: -length(k)):
            for head, own in heads.items():
                off = length(k) - length(head)
                if abs(off) > LENGTHS * model.seen.deviation:
                    continue
                if self.takes(_kernels.EqualLengths(edges[head], edges[k]), span):
                    own.append(k)
                    furthest[head] = max(furthest.get(head, 0.0), abs(off))
                    break
            else:
                heads[k] = [k]
        for head, own in heads.items():
            # Those of a rectangle, or of what is turned onto itself, follow from the rest.
            if len(own) > 1 and furthest[head] > MET * model.extent:
                yield Regularity("equal-length", tuple(sorted(own)), furthest[head])

    def _best_known(self, kind: int, offset: int) -> list[int]:
        """Elements of a kind, first those whose unknown at an offset is known best."""
        model, variances = self.model, np.diag(self.covariance)
        own = [k for k in model.at if model.kind(k) == kind]
        return sorted(own, key=lambda k: float(variances[model.at[k] + offset]))


def tangency(model: Model, k: int, m: int) -> Equation | None:
    """The equation that two neighbours are tangent; None for two lines."""
    if model.kind(k) == LINE:
        if model.kind(m) == LINE:
            return None
        return _kernels.LineTouches(model.at[k], model.at[m], model.ways[m])
    if model.kind(m) == LINE:
        return _kernels.LineTouches(model.at[m], model.at[k], model.ways[k])
    return _kernels.CirclesTouch(model.at[k], model.at[m], model.ways[k] == model.ways[m])


def fits_badly(model: Model, before: dict[int, Misfit]) -> bool:
    """Whether equations are not met, or an element fits worse than noise explains."""
    return bool(badly_fitting(model, before))


def badly_fitting(model: Model, before: dict[int, Misfit]) -> set[int]:
    """Elements that fit worse than noise explains, all of them where equations are not met."""
    if not model.meets_constraints(MET * model.extent):
        return set(model.at)
    anyhow = ANYHOW * model.seen.largest_deviation / model.seen.deviation
    bad: set[int] = set()
    for k, now in model.misfits().items():
        old = before[k].mean
        if not now.mean <= max(WORSE_PART * old, old + WORSE_BY, anyhow):
            bad.add(k)
    return bad
