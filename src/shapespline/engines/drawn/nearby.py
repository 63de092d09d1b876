"""Rows that differ from another one in a few segments: what a search for the cheapest goes through.

Segments are found without their joints and without what a drawing repeats. A fillet that its own
points hardly tell is cheap where its radius is that of others, and so is a short edge that is level
(DRA-38).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.engines.drawn.fillets import (
    FEWEST_ESTIMATED,
    rows_with_likely_fillets,
    rows_with_other_radii,
)
from shapespline.engines.drawn.segments import ARC, LINE, Segment

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.engines.drawn.model import Model
    from shapespline.engines.drawn.segments import Segments

# Parts of two arcs that an edge between them may take, and the fewest steps that it has (DRA-38).
TAKEN, FEWEST_STEPS = (0.2, 0.35, 0.5), 2


def rows_nearby(model: Model) -> Iterator[Segments]:
    """Rows with more fillets, with other radii, or with an edge between two arcs."""
    yield from rows_with_likely_fillets(model)
    yield from rows_with_other_radii(model)
    yield from _rows_with_one_edge(model)


def _rows_with_one_edge(model: Model) -> Iterator[Segments]:
    """Rows with an edge between two arcs each, shorter and longer ones."""
    n = len(model.row.found)
    for k in range(n if model.seen.closed else n - 1):
        m = (k + 1) % n
        if k == m or not model.row.found[k].kind == model.row.found[m].kind == ARC:
            continue
        row, at = (model.row.turned(k), 0) if model.seen.closed else (model.row, k)
        before, after = row.found[at : at + 2]
        for part in TAKEN:
            i = round(before.end - part * (before.end - before.begin))
            j = round(after.begin + part * (after.end - after.begin))
            if min(i - before.begin, after.end - j) < FEWEST_ESTIMATED or j - i < FEWEST_STEPS:
                continue
            parts = before._replace(end=i), Segment(i, j, LINE), after._replace(begin=j)
            yield row._replace(found=(*row.found[:at], *parts, *row.found[at + 2 :]))
