"""The cheapest reading of measured points, found from another one step by step."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.directed import rows_along
from shapespline.engines.drawn.estimated import estimated, settled
from shapespline.engines.drawn.judgement import is_short
from shapespline.engines.drawn.nearby import rows_nearby

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from shapespline.engines.drawn.estimated import Estimated
    from shapespline.engines.drawn.model import Model
    from shapespline.engines.drawn.segments import Segments


def descended(best: Estimated, *, wide: bool = False) -> Estimated:
    """The cheapest of readings nearby, as long as one is cheaper (DRA-38).

    ``wide`` with all that noise allows (DRA-48).
    """
    while True:
        nearby = rows_nearby(best.model)
        rows = chain([best.model.row], nearby) if wide > best.wide else nearby
        cheapest = min([best, *_read(best.model, rows, wide=wide)], key=_cost)
        if cheapest is best:
            return best
        best = cheapest


def widest(best: Estimated) -> Estimated:
    """The cheapest with all that noise allows, from one of two readings on.

    That which is known, and one whose edges run along the directions that it tells (DRA-50).
    """
    best = descended(best, wide=True)
    others = list(_read(best.model, rows_along(best.model), wide=True))
    if not others:
        return best
    other = descended(min(others, key=_cost), wide=True)
    return min(best, other, key=_cost)


def _read(model: Model, rows: Iterable[Segments], *, wide: bool) -> Iterator[Estimated]:
    """The readings of rows that hold as they are."""
    for row in rows:
        found = estimated(model, row, np.inf, wide=wide, whole=True)
        if found is None:
            continue
        # Without what speaks for it all that noise allows would make anything cheap.
        if found.told or (is_short(found.model, np.inf) and not wide):
            yield settled(found, np.inf)


def _cost(one: Estimated) -> float:
    return one.whole_cost
