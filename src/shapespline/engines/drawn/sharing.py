"""Points shared anew by the nodes between the elements that were found."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.ends import nodes_of
from shapespline.engines.drawn.joints import turn_at
from shapespline.engines.drawn.segments import SMOOTH

if TYPE_CHECKING:
    from shapespline.engines.drawn.model import Model
    from shapespline.engines.drawn.segments import Segments

# Points are shared anew so often, and an element keeps so many of them (DRA-25).
SHARINGS, LEAST_SHARED = 3, 3
# Of pictures those whose points are off by no more than this part of a pixel (DRA-65).
SHARP = 0.01


def shared_anew(model: Model) -> Model:
    """The estimate of points that belong to the elements between whose nodes they lie.

    Segments are found without joints, so some points beside a tangent one are on its wrong side.
    Those of a blurred or noisy picture stay with the elements that they were found with.
    """
    blurred = model.seen.deviation > SHARP * model.seen.pixel > 0.0
    for _ in range(0 if blurred else SHARINGS):
        row = _between_nodes(model)
        if row is model.row or min(j - i for i, j, _ in row.found) < LEAST_SHARED:
            break
        again = replace(model, row=row, x=model.x.copy())
        again.solve()
        if not again.chi_sq < model.chi_sq:
            break
        model = again
    return model


def _between_nodes(model: Model) -> Segments:
    """The row whose segments end in the points nearest to the nodes of tangent elements."""
    row, n, closed = model.row, len(model.row.found), model.seen.closed
    last = len(row.points) - 1
    begins = [segment.begin for segment in row.found]
    for k, node in nodes_of(model).items():
        m = (k + 1) % n
        if k not in model.at or m not in model.at or k == m or (m == 0 and not closed):
            continue
        if turn_at(model, k, m, node) > SMOOTH:
            continue
        at, before, after = row.found[k].end, row.found[k], row.found[m]
        near = np.arange(at - (at - before.begin) // 2, at + (after.end - after.begin) // 2 + 1)
        points = row.points[near % last if closed else near]
        begins[m] = int(near[np.argmin(np.hypot(*(points - node).T))])
    if begins == [segment.begin for segment in row.found]:
        return row
    if closed:
        return row.cut_at([begin % last for begin in begins])
    parts = zip(begins, [*begins[1:], last], row.found, strict=True)
    return row._replace(found=tuple(s._replace(begin=i, end=j) for i, j, s in parts))
