"""Segments as elements under the regularities that they keep, and what they cost to tell."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from shapespline.engines.drawn.beginnings import without_beginnings
from shapespline.engines.drawn.ends import NEIGHBOURS, nodes_of, on_between
from shapespline.engines.drawn.joints import turn_at
from shapespline.engines.drawn.judgement import (
    HOPELESS,
    is_enough,
    is_told,
    may_be_short,
    misfitting,
)
from shapespline.engines.drawn.model import Model
from shapespline.engines.drawn.regularities import NAMES, Search
from shapespline.engines.drawn.repeats import free_runs
from shapespline.engines.drawn.segments import (
    ARC_ARC_CORNER,
    ARC_ARC_SMOOTH,
    FREE,
    FREE_OF_POINTS,
    LINE,
    LINE_LINE_SMOOTH,
    PRICE,
    SMOOTH,
    Segment,
    supported,
)
from shapespline.engines.drawn.sharing import shared_anew

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.engines.drawn.segments import Segments
    from shapespline.values import Regularity

# An outline of more elements than these that contradict their points is none that was drawn, which
# takes long to find out (DRA-10).
MOST_WRONG = 30
# An element costs so many parameters beside its own where readings of other numbers of them are
# compared: there are many of these (DRA-38).
ELEMENT = 0.5


class Estimated(NamedTuple):
    """Elements with the regularities that they keep, and whether these tell of a drawing.

    ``wide`` if all that noise allows was taken.
    """

    model: Model
    found: list[Regularity]
    told: bool
    wide: bool

    @property
    def cost(self) -> float:
        """Misfit and the price of what regularities leave free."""
        return 0.5 * self.model.chi_sq + PRICE * self.model.n_free

    @property
    def whole_cost(self) -> float:
        """The cost with that of free-form runs, of joints that are seldom drawn, of each element.

        By which readings of measured points are compared that differ in these. Points of free-form
        runs are as far off as others.
        """
        row = self.model.row
        more = FREE_OF_POINTS * free_runs(row) + ELEMENT * len(row.found)
        n_free = sum(j - i for i, j, kind in row.found if kind == FREE)
        free_chi_sq = self.model.chi_sq * n_free / (row.found[-1].end - n_free)
        price = PRICE * (more + sum(_joint_prices(self.model)))
        return self.cost + 0.5 * free_chi_sq + price


def estimated(
    model: Model, row: Segments, tolerance: float, *, wide: bool = False, whole: bool = False
) -> Estimated | None:
    """The elements of segments under their regularities, those that fit badly left out.

    ``wide`` takes what noise allows, not only what is nearly met (DRA-48). ``whole`` leaves none
    out: None where one fits badly.
    """
    seen, ends, n_wrong = model.seen, model.ends, 0
    while n_wrong < min(len(row.found), MOST_WRONG):
        if not is_enough(row):
            return None
        model = Model.of(seen, row, model, ends)
        bad = misfitting(model, tolerance, each_alone=True)  # which is soon done
        if not bad:
            found = Search(model, NAMES, wide).run()
            bad = misfitting(model, tolerance)
            told = is_told(model, found, tolerance, HOPELESS if bad else 1.0)
            if not bad:
                return Estimated(model, found, told, wide)
            if not told and not may_be_short(model, tolerance):
                return None
        n_wrong += len(bad)
        if whole or n_wrong >= MOST_WRONG:
            return None
        row = supported(_without(model, bad, tolerance), seen.closed)
    return None


def settled(best: Estimated, tolerance: float) -> Estimated:
    """The estimate after points were shared anew, if that costs less.

    Without a tolerance rows are compared as they are after that: one with an arc that has points of
    its neighbours may seem the cheaper one (DRA-37).
    """
    row = shared_anew(best.model).row
    if row is best.model.row:
        return best
    other = estimated(best.model, row, tolerance, wide=best.wide, whole=True)
    return best if other is None or other.cost >= best.cost else other


def begun(best: Estimated, tolerance: float) -> Estimated:
    """The estimate without elements that are the beginning of a free-form run, if that holds."""
    row = without_beginnings(best.model.row, best.model.seen)
    if row is best.model.row:
        return best
    other = estimated(best.model, row, tolerance, wide=best.wide, whole=True)
    if other is None:
        return best
    return settled(other, tolerance)._replace(told=best.told)


def _joint_prices(model: Model) -> Iterator[float]:
    """Those of joints between lines or between arcs, in parameters."""
    found, nodes = model.row.found, nodes_of(model)
    for k in range(len(found) if model.seen.closed else len(found) - 1):
        m = (k + 1) % len(found)
        if k == m or found[k].kind != found[m].kind or found[k].kind == FREE:
            continue
        smooth = turn_at(model, k, m, nodes[k]) <= SMOOTH
        if found[k].kind == LINE:
            yield LINE_LINE_SMOOTH if smooth else 0.0
        else:
            yield ARC_ARC_SMOOTH if smooth else ARC_ARC_CORNER


def _without(model: Model, bad: list[int], tolerance: float) -> Segments:
    """The row with some segments free-form, or only those of their ends that miss their points."""
    found: list[Segment] = []
    for k, segment in enumerate(model.row.found):
        if k not in bad:
            found.append(segment)
            continue
        first, last = on_between(model, k, tolerance)
        if last - first < NEIGHBOURS or (first, last) == (segment.begin, segment.end):
            first = last  # all of it
        cuts = (segment.begin, FREE), (first, segment.kind), (last, FREE), (segment.end, FREE)
        found += [Segment(i, j, kind) for (i, kind), (j, _) in pairwise(cuts) if i < j]
    return model.row._replace(found=tuple(found))
