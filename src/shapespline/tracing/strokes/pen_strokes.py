"""Strokes of one pen: what both sides of the ink tell of where it went, alone and together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.tracing.strokes.course import Turn, turned
from shapespline.tracing.strokes.hidden import lead_on
from shapespline.tracing.strokes.pen_edges import pen_edges
from shapespline.tracing.strokes.pen_net import pen_net
from shapespline.tracing.strokes.stroke import stroke_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scipy.spatial import cKDTree

    from shapespline.tracing.strokes.graph import Branch
    from shapespline.tracing.strokes.pen import Pen
    from shapespline.tracing.strokes.stroke import Stroke
    from shapespline.typing import FloatArray

# Within this part of the radius and a pixel of a corner its sides are rounded; its place, where
# they meet, is within this part and half a pixel.
MIXED, FARTHEST = 0.5, 0.5


def pen_strokes(outlines: Sequence[FloatArray], pen: Pen, tree: cKDTree) -> list[Stroke]:
    """Strokes that a pen made of one part of the ink; none if it can have made none.

    Parameters
    ----------
    outlines : sequence of ndarray, shape (n, 2)
        Points of its outline and those of its holes, the ink on their left.
    pen : Pen
    tree : cKDTree
        Points of all outlines.
    """
    edges, first_end = [], 0
    for outline in outlines:
        edges += pen_edges(outline, pen, tree, first_end)
        first_end += len(outline)
    if not edges:
        return []
    strokes = []
    net = pen_net(edges, pen)
    lead_on(net, pen, tree)
    for branch in net.graph.branches():
        around = _opened(branch) if branch.is_ring else branch
        last = len(around.points) - 1
        # Of a corner at the end of a line nothing is known but its place.
        turns = [
            Turn(at, MIXED * pen.radius + 1.0, FARTHEST * pen.radius + 0.5, is_corner=True)
            for at in around.corners
            if 0 < at < last
        ]
        stroke = stroke_of(branch, *turned(around.points, turns, pen.radius), tree)
        if stroke is not None:
            strokes.append(stroke)
    return strokes


def _opened(ring: Branch) -> Branch:
    """A ring that begins far from its corners."""
    count = len(ring.points) - 1
    corners = sorted({at % count for at in ring.corners})
    if not corners:
        return ring
    gaps = np.diff(corners, append=corners[0] + count)
    widest = int(np.argmax(gaps))
    start = int(corners[widest] + gaps[widest] // 2) % count
    points = np.roll(ring.points[:-1], -start, axis=0)
    return ring._replace(
        points=np.concatenate([points, points[:1]]),
        corners=tuple((at - start) % count for at in corners),
    )
