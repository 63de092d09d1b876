"""The medial axis of ink: the middles of the largest discs within it.

Between points sampled densely on its outline it is their Voronoi diagram, as far as that lies
inside (Brandt and Algazi 1992). Every bump of an outline adds a branch of its own: those that do
not leave the disc of the junction they start from by much are no strokes and fall, the shortest
first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.tracing.strokes.graph import Graph
from shapespline.tracing.strokes.ink import OUTLINE_STEP

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.typing import FloatArray
    from shapespline.values import Shape

# A branch with a loose end is a stroke if it is longer than the disc of its junction is wide, that
# many radii: the corner of a square end is 1.41 away from where its two branches part.
SPUR = 1.6
# Junctions within this part of their radius are one: where two strokes cross there are two of them.
CROSSING = 1.0


def medial_axis(shape: Shape, outlines: Sequence[FloatArray], *, with_spurs: bool = False) -> Graph:
    """Voronoi edges between points of the outlines, as far as they lie inside.

    Parameters
    ----------
    shape : Shape
        As traced.
    outlines : sequence of ndarray, shape (n, 2)
        Points on its outlines, `OUTLINE_STEP` apart.
    with_spurs : bool
        Whether what leads into corners and bumps alone is left.
    """
    graph = _all_of_it(shape, outlines)
    if not with_spurs:
        _prune(graph)
        _merge_junctions(graph)
    return graph


def _all_of_it(shape: Shape, outlines: Sequence[FloatArray]) -> Graph:
    from scipy.spatial import Voronoi

    sites = np.concatenate(outlines)
    ahead = np.arange(1, len(sites) + 1)
    ends = np.cumsum([len(points) for points in outlines])
    ahead[ends - 1] = np.concatenate([[0], ends[:-1]])
    diagram = Voronoi(sites)
    # The edge between two neighbours on an outline passes through it, or ends in a corner.
    beside = np.asarray(diagram.ridge_points)
    across = (ahead[beside[:, 0]] == beside[:, 1]) | (ahead[beside[:, 1]] == beside[:, 0])
    inside = _inside(diagram.vertices, shape)
    pairs = np.asarray(diagram.ridge_vertices)
    kept = ~across & (pairs >= 0).all(axis=1) & inside[pairs[:, 0]] & inside[pairs[:, 1]]
    radii = np.full(len(diagram.vertices), np.inf)
    of = beside[:, 0]
    for end in (0, 1):
        found = np.hypot(*(diagram.vertices[pairs[kept, end]] - sites[of[kept]]).T)
        np.minimum.at(radii, pairs[kept, end], found)
    # A disc that touches a straight side passes half a step beside two of its points.
    least = 0.1 * OUTLINE_STEP
    radii = np.sqrt(np.maximum(radii**2 - (0.5 * OUTLINE_STEP) ** 2, least**2))
    graph = Graph(diagram.vertices.copy(), radii)
    for a, b in pairs[kept].tolist():
        graph.connect(a, b)
    return graph


def _inside(points: FloatArray, shape: Shape) -> NDArray[np.bool_]:
    """Even-odd rule over all outlines at once: whether a ray to the right crosses oddly often."""
    order = np.argsort(points[:, 1], kind="stable")
    heights = points[order, 1]
    crossings = np.zeros(len(points), dtype=np.int64)
    for contour in shape:
        a = contour.points
        b = np.roll(a, -1, axis=0)
        low, high = np.minimum(a[:, 1], b[:, 1]), np.maximum(a[:, 1], b[:, 1])
        first, last = np.searchsorted(heights, low), np.searchsorted(heights, high)
        for k in np.flatnonzero(last > first):
            ahead = order[first[k] : last[k]]
            share = (points[ahead, 1] - a[k, 1]) / (b[k, 1] - a[k, 1])
            crossings[ahead] += a[k, 0] + share * (b[k, 0] - a[k, 0]) > points[ahead, 0]
    return np.asarray(crossings % 2 == 1)


def _prune(axis: Graph) -> None:
    """Take away spurs, the least first; what they leave may be a longer branch, or a spur.

    All spurs of a junction fall together: a square end has two, one to each corner.
    """
    while True:
        spurs: dict[int, list[tuple[float, list[int]]]] = {}
        for node in axis.loose_ends():
            path = axis.walk(node, next(iter(axis.links[node])))
            junction = path[-1]
            reach = (axis.length(path) + float(axis.radii[node])) / float(axis.radii[junction])
            if len(axis.links[junction]) > 2 and reach < SPUR:
                spurs.setdefault(junction, []).append((reach, path))
        if not spurs:
            return
        for junction, found in sorted(spurs.items(), key=lambda item: min(item[1])[0]):
            found.sort()
            if len(found) == len(axis.links[junction]):
                found.pop()  # nothing but spurs: the longest is what there is
            for _, path in found:
                axis.disconnect_all(path)


def _merge_junctions(axis: Graph) -> None:
    """Junctions whose discs nearly coincide become one, half-way between them."""
    merged = True
    while merged:
        merged = False
        for node in axis.junctions():
            for other in list(axis.links[node]):
                path = axis.walk(node, other)
                end = path[-1]
                near = CROSSING * min(axis.radii[node], axis.radii[end])
                if end != node and len(axis.links[end]) > 2 and axis.length(path) < near:
                    _contract(axis, path)
                    merged = True
                    break
            if merged:
                break


def _contract(axis: Graph, path: list[int]) -> None:
    begin, end = path[0], path[-1]
    axis.disconnect_all(path)
    for other in list(axis.links[end]):
        axis.disconnect(end, other)
        if other != begin:
            axis.connect(begin, other)
    axis.points[begin] = 0.5 * (axis.points[begin] + axis.points[end])
