"""Edges of equal length: an equation between two lines and what they meet at both ends."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.drawn.joints import PARALLEL, TOUCHES, meeting, onto, unit_of
from shapespline.engines.drawn.segments import LINE

if TYPE_CHECKING:
    from shapespline.engines.drawn.model import Model
    from shapespline.typing import FloatArray


class End(NamedTuple):
    """What a line meets: the line or circle with unknowns at ``at``.

    ``side`` of a circle is 1 or -1 where the line meets it after or before the foot of its centre,
    0 where it touches it there.
    """

    at: int
    is_line: bool
    side: float = 0.0


class Edge(NamedTuple):
    """A line with unknowns at ``at`` between what it meets."""

    at: int
    begin: End
    end: End

    @classmethod
    def of(cls, model: Model, k: int) -> Edge | None:
        """Segment k of a model, where it is a line between elements that it meets."""
        n, closed = len(model.row.found), model.seen.closed
        if model.kind(k) != LINE or n < 3 or not (closed or 0 < k < n - 1):
            return None
        before, after = (k - 1) % n, (k + 1) % n
        if before not in model.at or after not in model.at:
            return None
        begin, end = _met(model, k, before, before), _met(model, k, after, k)
        return None if begin is None or end is None else cls(model.at[k], begin, end)

    def length(self, x: FloatArray) -> tuple[float, dict[int, float]]:
        """How long it is in its direction, and the slopes over its unknowns."""
        (far, there), (near, here) = self._along(x, self.end), self._along(x, self.begin)
        slopes = {i: there.get(i, 0.0) - here.get(i, 0.0) for i in there | here}
        return far - near, slopes

    def _along(self, x: FloatArray, end: End) -> tuple[float, dict[int, float]]:
        """Where along the line it meets something, and the slopes of that."""
        a, b = self.at, end.at
        phi, d = float(x[a]), float(x[a + 1])
        if end.is_line:
            c, s = cos(phi - x[b]), sin(phi - x[b])
            along = (float(x[b + 1]) - d * c) / s
            turn = d - along * c / s
            return along, {a: turn, a + 1: -c / s, b: -turn, b + 1: 1 / s}
        c, s = cos(phi), sin(phi)
        u, v, r = (float(one) for one in x[b : b + 3])
        foot, off = c * u + s * v, c * v - s * u - d
        # Along the line from the foot half a chord, whose slope over ``off`` this is.
        half = end.side * sqrt(max(r * r - off * off, (TOUCHES * r) ** 2)) if end.side else 0.0
        slope = -off / half if half else 0.0
        slopes = {
            a: off + d - slope * foot,
            a + 1: -slope,
            b: c - slope * s,
            b + 1: s + slope * c,
            b + 2: r / half if half else 0.0,
        }
        return foot + half, slopes


def _met(model: Model, k: int, m: int, node: int) -> End | None:
    """What line k meets behind segment ``node``: segment m."""
    near = model.row.points[model.row.found[node].end]
    o, (tx, ty) = model.at[m], unit_of(float(model.x[model.at[k]])).tolist()
    if model.kind(m) == LINE:
        other = unit_of(float(model.x[o])).tolist()
        return None if abs(tx * other[1] - ty * other[0]) < PARALLEL else End(o, True)
    off = meeting(model, k, m, near) - onto(model, k, model.x[o : o + 2])
    along = float(off[0] * tx + off[1] * ty)
    return End(o, False, float(np.sign(along)) if along else 0.0)


@dataclass(frozen=True)
class EqualLengths:
    """Two edges are equally long."""

    a: Edge
    b: Edge

    @cached_property
    def index(self) -> tuple[int, ...]:
        """The unknowns that it joins, each once."""
        joined: list[int] = []
        for edge in (self.a, self.b):
            joined += (edge.at, edge.at + 1)
            for end in (edge.begin, edge.end):
                joined += range(end.at, end.at + (2 if end.is_line else 3))
        return tuple(dict.fromkeys(joined))

    def value(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """h, and its Jacobian."""
        (one, slopes), (other, its) = self.a.length(x), self.b.length(x)
        row = [slopes.get(i, 0.0) - its.get(i, 0.0) for i in self.index]
        return np.array([one - other]), np.array([row])
