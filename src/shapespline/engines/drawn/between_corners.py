"""Rows of noisy points with one element or one free-form run between two corners.

Several lines and arcs follow any curve among noise for less than a free-form run costs by itself;
what they are together, a smooth curve, its own least squares tell (DRA-42).
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from shapespline.analysis import NOISE_BAND, find_corners
from shapespline.engines.drawn.segments import ARC, FREE, LINE, Segment
from shapespline.values import Contour

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.engines.drawn.observed import Observed
    from shapespline.engines.drawn.segments import Segments

# An element has all points between two corners if it has this part of them; it is kept beside
# free-form runs if it has that part (DRA-42).
ALL, LONG = 0.9, 0.25
# A corner of the data is where segments meet if that is no more points away, and what lies between
# two nodes is no run of its own if it has no more points (DRA-42).
NEAR = 4


def rows_between_corners(seen: Observed, row: Segments) -> Iterator[Segments]:
    """Rows with long elements and free-form runs between corners, or one line or run each.

    None without corners.
    """
    last = len(row.points) - 1
    points = row.points[:last] if seen.closed else row.points
    found = find_corners(Contour.silently(points, seen.closed), NOISE_BAND * seen.deviation)
    nodes = {_nearest_node(row, int(corner)) for corner in found.indices}
    if seen.closed:
        begins = sorted({node % last for node in nodes})
        corners = [*begins, begins[0] + last] if begins else []
    else:
        corners = sorted({0, *nodes, last})
    for part, kinds in ((LONG, (LINE, ARC)), (ALL, (LINE,))):
        parts = [one for i, j in pairwise(corners) for one in _between(row, i, j, part, kinds)]
        if parts:
            own = row._replace(found=tuple(parts))
            yield own.cut_at([one.begin % last for one in parts]) if seen.closed else own


def _nearest_node(row: Segments, corner: int) -> int:
    """Where segments meet beside a corner, the corner if that is nowhere near."""
    nodes = [begin for begin, _, _ in row.found] + [row.found[-1].end]
    nearest = min(nodes, key=lambda node: abs(node - corner))
    return nearest if abs(nearest - corner) <= NEAR else corner


def _between(row: Segments, i: int, j: int, part: float, kinds: Sequence[int]) -> list[Segment]:
    """Elements that have a part of the points between two corners, free-form runs between them."""
    last = row.found[-1].end
    found: list[Segment] = []
    at = i
    for lap in (0, last):
        for begin, end, kind in row.found:
            first, final = max(begin + lap, i), min(end + lap, j)
            if kind not in kinds or final - first < part * (j - i):
                continue
            if final - first >= ALL * (j - i):
                return [Segment(i, j, kind)]
            if first - at > NEAR:
                found.append(Segment(at, first, FREE))
                at = first
            found.append(Segment(at, final, kind))
            at = final
    if j - at > NEAR or not found:
        found.append(Segment(at, j, FREE))
    else:
        found[-1] = found[-1]._replace(end=j)
    return found
