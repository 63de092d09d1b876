"""Long straight edges between curves, of a picture's outline that tells of no drawing otherwise."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.segments import FEW, FREE, LINE, Segment

if TYPE_CHECKING:
    from shapespline.engines.drawn.observed import Observed
    from shapespline.engines.drawn.segments import Segments

# An edge of a picture is straight if its points differ across it by no more deviations, and no arc
# of so many pixels of radius lies as near to them (DRA-68).
LONG, LONG_OFF = 900.0, 3.0


def long_edges(row: Segments, seen: Observed) -> Segments | None:
    """The row of a picture's outline with nothing but long straight edges, None without any."""
    found: list[Segment] = []
    for segment in row.found:
        kind = LINE if segment.kind == LINE and _is_edge(row, segment, seen) else FREE
        if found and kind == FREE == found[-1].kind:
            found[-1] = found[-1]._replace(end=segment.end)
        else:
            found.append(segment._replace(kind=kind))
    edges = [k for k, segment in enumerate(found) if segment.kind == LINE]
    if not edges or len(found) < 2:
        return None
    row = row._replace(found=tuple(found)).turned(edges[0])
    before, last = row.found[-2:]
    if before.kind == last.kind == FREE:  # the row began in the middle of it
        row = row._replace(found=(*row.found[:-2], before._replace(end=last.end)))
    return row


def _is_edge(row: Segments, line: Segment, seen: Observed) -> bool:
    """Whether a line of a picture is so long that no curve lies as near to its points."""
    points = row.points[line.begin + FEW : line.end + 1 - FEW]
    if len(points) < FEW:
        return False
    x, y = points[-1] - points[0]
    length = float(np.hypot(x, y))
    off = float(np.ptp(points @ [-y, x])) / max(length, 1e-300)
    room = LONG_OFF * seen.deviation
    return off <= room and length >= (8.0 * LONG * seen.pixel * room) ** 0.5
