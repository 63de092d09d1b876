"""Edges between what they meet at both ends, whose lengths may be equal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.engines.drawn.joints import PARALLEL, TOUCHES, meeting, onto, unit_of
from shapespline.engines.drawn.segments import LINE

if TYPE_CHECKING:
    from shapespline.engines.drawn.model import Model


def edge_of(model: Model, k: int) -> _kernels.Edge | None:
    """Segment k of a model, where it is a line between elements that it meets."""
    n, closed = len(model.row.found), model.seen.closed
    if model.kind(k) != LINE or n < 3 or not (closed or 0 < k < n - 1):
        return None
    before, after = (k - 1) % n, (k + 1) % n
    if before not in model.at or after not in model.at:
        return None
    begin, end = _met(model, k, before, before), _met(model, k, after, k)
    if begin is None or end is None:
        return None
    return _kernels.Edge(model.at[k], begin, end, TOUCHES)


def _met(model: Model, k: int, m: int, node: int) -> _kernels.End | None:
    """What line k meets behind segment ``node``: segment m.

    Of a circle whether that is after (1) or before (-1) the foot of its centre, or there (0).
    """
    near = model.row.points[model.row.found[node].end]
    o, (tx, ty) = model.at[m], unit_of(float(model.x[model.at[k]])).tolist()
    if model.kind(m) == LINE:
        other = unit_of(float(model.x[o])).tolist()
        return None if abs(tx * other[1] - ty * other[0]) < PARALLEL else _kernels.End(o, True)
    off = meeting(model, k, m, near) - onto(model, k, model.x[o : o + 2])
    along = float(off[0] * tx + off[1] * ty)
    return _kernels.End(o, False, float(np.sign(along)) if along else 0.0)
