"""The elements of an estimate as parts, end to end between their nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.ends import (
    SMOOTH_END,
    cut_off,
    first_on,
    last_on,
    misses,
    nodes_of,
    off_by,
    sweep_of,
)
from shapespline.engines.drawn.joints import direction_at
from shapespline.engines.drawn.merging import merged
from shapespline.engines.drawn.parts import Drawn, DrawnArc, DrawnLine, FreeRun
from shapespline.engines.drawn.segments import LINE
from shapespline.engines.drawn.sides import go_on
from shapespline.values import Arc

if TYPE_CHECKING:
    from shapespline.engines.drawn.model import Model
    from shapespline.engines.drawn.parts import Part
    from shapespline.typing import FloatArray
    from shapespline.values import Regularity

# What is kept by arcs, too, that are led through their nodes: they are moved alike (DRA-40).
WHOLE = ("mirror", "rotation")
# Data within so many steps of a node tell its direction.
DIRECTION_STEPS = 4


def assembled(model: Model, found: list[Regularity], tolerance: float, told: bool) -> Drawn:
    """Elements between their nodes, free-form runs between them."""
    segments, nodes = model.row.found, nodes_of(model)
    n = len(segments)
    begins = {k: nodes[k - 1] for k in model.at}
    ends = {k: nodes[k] for k in model.at}
    for k in model.at:
        m = (k + 1) % n if model.seen.closed else k + 1
        if m in model.at and m != k:
            ends[k], begins[m] = cut_off(model, k, m, nodes[k], tolerance)
    parts: list[Part] = []
    place: dict[int, int] = {}
    k = 0
    while k < n:
        if k in model.at:
            place[k] = len(parts)
            parts.append(_element(model, k, begins[k], ends[k]))
            m = (k + 1) % n if model.seen.closed else k + 1
            if m in model.at and (begins[m] != ends[k]).any():
                parts.append(DrawnLine(ends[k], begins[m]))
            k += 1
            continue
        last = k
        while last + 1 < n and last + 1 not in model.at:
            last += 1
        parts.append(_free_run(model, k, last, nodes))
        k = last + 1
    cut = {k for k in model.at if (begins[k] != nodes[k - 1]).any() or (ends[k] != nodes[k]).any()}
    moved = {k for k in model.at if misses(model, k, begins[k], ends[k])}
    kept = tuple(
        one._replace(pieces=tuple(place[s] for s in one.pieces))
        for one in found
        if (one.name != "equal-length" or cut.isdisjoint(one.pieces))
        and (one.name in WHOLE or moved.isdisjoint(one.pieces))
    )
    off = [] if model.seen.pixel else [off_by(model, k, model.counted(k)[0]) for k in model.at]
    drawn = Drawn(tuple(parts), kept, told, model.n_free, errors_go_on=go_on(off))
    return merged(drawn, closed=model.seen.closed)


def _element(model: Model, k: int, begin: FloatArray, end: FloatArray) -> DrawnLine | DrawnArc:
    if model.kind(k) == LINE:
        return DrawnLine(begin, end)
    o = model.at[k]
    centre, radius = model.x[o : o + 2], float(model.x[o + 2])
    first, sweep = sweep_of(model, k, begin, end)
    if misses(model, k, begin, end):
        return DrawnArc(Arc.through(begin, end, sweep), begin, end)
    return DrawnArc(Arc((float(centre[0]), float(centre[1])), radius, first, sweep), begin, end)


def _free_run(model: Model, k: int, last: int, nodes: dict[int, FloatArray]) -> FreeRun:
    """The data of segments k to last, from node to node."""
    row, n = model.row, len(model.row.found)
    closed = model.seen.closed
    before, after = ((k - 1) % n, (last + 1) % n) if closed else (k - 1, last + 1)
    i, j = row.found[k].begin, row.found[last].end
    points = row.points[i : j + 1]
    if before in model.at:
        left = row.points[last_on(model, before) : row.found[before].end]
        points = np.concatenate([left, points])
    if after in model.at:
        right = row.points[row.found[after].begin + 1 : first_on(model, after) + 1]
        points = np.concatenate([points, right])
    points = points.copy()
    if model.ends is not None and k == 0:
        points[0] = model.ends[0]
    if model.ends is not None and last == n - 1:
        points[-1] = model.ends[1]
    tangents: list[FloatArray | None] = [None, None]
    reach = min(DIRECTION_STEPS, len(points) - 1)
    if before in model.at:
        points[0] = nodes[(k - 1) if k > 0 else -1]
        tangents[0] = _smooth(direction_at(model, before, points[0]), points[reach] - points[0])
    if after in model.at:
        points[-1] = nodes[last]
        tangents[1] = _smooth(
            direction_at(model, after, points[-1]), points[-1] - points[-1 - reach]
        )
    return FreeRun(points, (tangents[0], tangents[1]))


def _smooth(tangent: FloatArray, chord: FloatArray) -> FloatArray | None:
    """The tangent, if data go on along it."""
    turn = np.arctan2(tangent[0] * chord[1] - tangent[1] * chord[0], tangent @ chord)
    return tangent if abs(float(turn)) < SMOOTH_END else None
