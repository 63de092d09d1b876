"""Short lines that touch two arcs which the segments of a picture let meet at an angle.

Points beside a node do not count: a line of few pixels may lie between them.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.ends import ON, nodes_of, off_by
from shapespline.engines.drawn.joints import turn_at
from shapespline.engines.drawn.missed_arcs import BREAK, FEWEST, row_with
from shapespline.engines.drawn.segments import ARC, LINE

if TYPE_CHECKING:
    from shapespline.engines.drawn.model import Model
    from shapespline.engines.drawn.segments import Segments

# Arcs that a short line joins seem to meet at no larger an angle, and the squares of its points'
# distances are so much smaller than from the arcs (DRA-66).
STEEPEST, BETTER = float(np.radians(90.0)), 0.25


def with_missed_lines(model: Model) -> Segments:
    """The row with a line between two arcs that both touch it, where its points lie on it."""
    row, n, closed = model.row, len(model.row.found), model.seen.closed
    begins, kinds = ([segment[at] for segment in row.found] for at in (0, 2))
    lines: dict[int, tuple[int, int]] = {}
    for k in range(n if closed else n - 1):
        m = (k + 1) % n
        if k == m or kinds[k] != ARC or kinds[m] != ARC:
            continue
        if BREAK[0] < turn_at(model, k, m, nodes_of(model)[k]) < STEEPEST:
            line = _line_between(model, k, m)
            if line is not None:
                begin, begins[m] = line
                lines[k] = begin, LINE
    return row_with(row, begins, kinds, lines, closed=closed) if lines else row


def _line_between(model: Model, k: int, m: int) -> tuple[int, int] | None:
    """First and last point of the line that touches two arcs, if all between lie on it."""
    (cx, cy, r), (ex, ey, s) = model.unknowns(k), model.unknowns(m)
    r, s = r * model.ways[k], s * model.ways[m]  # of a centre to the left of the line, or not
    apart = hypot(ex - cx, ey - cy)
    if apart <= abs(s - r):
        return None
    # Over the line the second centre is higher than the first by s - r.
    across = (s - r) / apart
    along = (1.0 - across * across) ** 0.5
    ux, uy = (ex - cx) / apart, (ey - cy) / apart
    normal = np.array([across * ux - along * uy, across * uy + along * ux])
    direction = np.array([normal[1], -normal[0]])
    touches = np.array([cx, cy]) - r * normal, np.array([ex, ey]) - s * normal
    node, stations = nodes_of(model)[k], model.row.stations
    (i, j, _), (p, q, _) = model.row.found[k], model.row.found[m]
    before, after = (float(direction @ (touch - node)) for touch in touches)
    begin = int(np.searchsorted(stations, stations[j] + before, side="right")) - 1
    end = int(np.searchsorted(stations, stations[p] + after))
    if not (i < begin < j and p < end < q) or j - begin + end - p < FEWEST:
        return None
    points = np.vstack([model.row.points[begin + 1 : j], model.row.points[p:end]])
    off = np.abs((points - touches[0]) @ normal)
    by_arcs = np.minimum(*(np.abs(off_by(model, one, points)) for one in (k, m)))
    nearer = float(off @ off) < BETTER * float(by_arcs @ by_arcs)
    return (begin, end) if nearer and off.max() <= ON * model.seen.largest_deviation else None
