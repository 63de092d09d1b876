"""Where curvature jumps from one element to the next, as along no smooth curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.ends import data_length, nodes_of
from shapespline.engines.drawn.joints import turn_at
from shapespline.engines.drawn.segments import CORNER, LINE

if TYPE_CHECKING:
    from shapespline.engines.drawn.model import Model

# A curve whose curvature grows steadily by k over a length L misses its best arc by a cubic: by
# k L^2 / 317.5, root mean square. Where it jumps that is more than the elements miss, in the
# geometric mean of all joints, and so much of the points' deviation at each (DRA-52).
STEADY, LEAST_SHOWN = 317.5, 0.25


def jump_clearly(model: Model) -> bool:
    """Whether all of an outline is elements that meet in corners or where curvature jumps.

    Elements that follow a smooth curve are as long as its errors allow: what their curvatures
    differ by is what they miss it by. From an edge to its fillet it is much more. One joint at
    least is smooth, for corners say nothing.
    """
    seen, n = model.seen, len(model.row.found)
    if len(model.at) != n or n < 2:
        return False
    nodes, misfits = nodes_of(model), model.misfits()
    lengths = [data_length(model, k) for k in range(n)]
    bends = [
        0.0 if model.kind(k) == LINE else model.ways[k] / model.unknowns(k)[2] for k in range(n)
    ]
    steady, missed = [], []
    for k in range(n if seen.closed else n - 1):
        m = (k + 1) % n
        if turn_at(model, k, m, nodes[k]) <= CORNER:
            shorter = min(lengths[k], lengths[m])
            steady.append(abs(bends[k] - bends[m]) * shorter**2 / STEADY / seen.deviation)
            missed.append(max(misfits[k].mean, misfits[m].mean))
    if not steady or min(steady) < LEAST_SHOWN:
        return False
    return bool(np.log(steady).sum() >= np.log(np.maximum(missed, 1e-9)).sum())
