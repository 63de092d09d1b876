"""Centre lines of strokes: open curves that meet in junctions, instead of outlines around the ink.

The centres of the largest discs within a shape are its medial axis; between points sampled densely
on its outline it is their Voronoi diagram, as far as that lies inside (Brandt and Algazi 1992).
Every bump of an outline adds a branch of its own: those that do not leave the disc of the junction
they start from by much are no strokes and fall, the shortest first.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import DegenerateContourError
from shapespline.tracing.strokes import Branch, drawn_strokes
from shapespline.values import Contour, Shape

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from shapespline.typing import FloatArray

# Pixels between points on the outline.
OUTLINE_STEP = 0.5
# A branch with a loose end is a stroke if it is longer than the disc of its junction is wide, that
# many radii: the corner of a square end is 1.41 away from where its two branches part.
SPUR = 1.6
# Junctions within this part of their radius are one: where two strokes cross there are two of them.
CROSSING = 1.0


def centerlines(shape: Shape) -> Shape:
    """Centre lines of the ink within outlines and outside their holes.

    Parameters
    ----------
    shape : Shape
        As traced: closed contours, nested, in pixels.

    Returns
    -------
    Shape
        Open contours from end to end, end to junction or junction to junction, which share their
        junctions to the bit, and closed ones of rings; the longest first. A line ends where the
        pen did: at a square end of the ink, in the middle of a round one. ``widths`` holds the
        usual width of each stroke.

    Raises
    ------
    DegenerateContourError
        If there is no stroke: dots alone have no centre line.

    Examples
    --------
    >>> bar = Contour([(0, 0), (40, 0), (40, 4), (0, 4)], closed=True)
    >>> shape = centerlines(Shape([bar]))
    >>> (line,) = shape
    >>> line.closed, bool(np.abs(line.points[:, 1] - 2).max() < 1e-9), round(line.length, 9)
    (False, True, 40.0)
    >>> round(shape.widths[0], 6)
    4.0
    """
    outlines = [_sites(contour) for contour in shape]
    graph, sites = _medial_axis(shape, outlines), np.concatenate(outlines)
    graph.prune()
    graph.merge_junctions()
    strokes = drawn_strokes(list(graph.branches()), graph.points, graph.radii, sites)
    if not strokes:
        raise DegenerateContourError(
            "no stroke in the picture: what there is has no centre line longer than it is wide;"
            " trace its outline instead"
        )
    lines = [Contour.silently(stroke.points, stroke.closed) for stroke in strokes]
    order = sorted(range(len(lines)), key=lambda index: -lines[index].length)
    return Shape(
        [lines[index] for index in order],
        frame=shape.frame,
        unit=shape.unit,
        widths=[strokes[index].width for index in order],
    )


@dataclass
class _Graph:
    """Nodes with the radii of their discs, and edges both ways."""

    points: FloatArray
    radii: FloatArray
    links: dict[int, set[int]] = field(default_factory=dict)

    def connect(self, a: int, b: int) -> None:
        self.links.setdefault(a, set()).add(b)
        self.links.setdefault(b, set()).add(a)

    def disconnect(self, a: int, b: int) -> None:
        self.links[a].discard(b)
        self.links[b].discard(a)

    def length(self, path: list[int]) -> float:
        return float(np.hypot(*np.diff(self.points[path], axis=0).T).sum())

    def walk(self, begin: int, towards: int) -> list[int]:
        """Nodes from one on, as far as there is one way only; back at the start at the latest."""
        path = [begin, towards]
        while len(self.links[path[-1]]) == 2 and path[-1] != begin:
            (ahead,) = self.links[path[-1]] - {path[-2]} or {path[-2]}
            path.append(ahead)
        return path

    def prune(self) -> None:
        """Take away spurs, the least first; what they leave may be a longer branch, or a spur.

        All spurs of a junction fall together: a square end has two, one to each corner.
        """
        while True:
            spurs: dict[int, list[tuple[float, list[int]]]] = {}
            for node, others in self.links.items():
                if len(others) != 1:
                    continue
                path = self.walk(node, next(iter(others)))
                junction = path[-1]
                reach = (self.length(path) + float(self.radii[node])) / float(self.radii[junction])
                if len(self.links[junction]) > 2 and reach < SPUR:
                    spurs.setdefault(junction, []).append((reach, path))
            if not spurs:
                return
            for junction, found in sorted(spurs.items(), key=lambda item: min(item[1])[0]):
                found.sort()
                if len(found) == len(self.links[junction]):
                    found.pop()  # nothing but spurs: the longest is what there is
                for _, path in found:
                    for a, b in pairwise(path):
                        self.disconnect(a, b)

    def merge_junctions(self) -> None:
        """Junctions whose discs nearly coincide become one, half-way between them."""
        merged = True
        while merged:
            merged = False
            for node in [n for n, others in self.links.items() if len(others) > 2]:
                for other in list(self.links[node]):
                    path = self.walk(node, other)
                    end = path[-1]
                    near = CROSSING * min(self.radii[node], self.radii[end])
                    if end != node and len(self.links[end]) > 2 and self.length(path) < near:
                        self._contract(path)
                        merged = True
                        break
                if merged:
                    break

    def _contract(self, path: list[int]) -> None:
        begin, end = path[0], path[-1]
        for a, b in pairwise(path):
            self.disconnect(a, b)
        for other in list(self.links[end]):
            self.disconnect(end, other)
            if other != begin:
                self.connect(begin, other)
        self.points[begin] = 0.5 * (self.points[begin] + self.points[end])

    def branches(self) -> Iterator[Branch]:
        """Every branch between ends and junctions, then the rings."""
        done: set[tuple[int, int]] = set()
        for node in [n for n, others in self.links.items() if len(others) not in (0, 2)]:
            for other in sorted(self.links[node]):
                if (node, other) not in done:
                    yield self._branch(self.walk(node, other), done)
        for node, others in self.links.items():
            if len(others) == 2 and not any((node, other) in done for other in others):
                yield self._branch(self.walk(node, min(others)), done, is_ring=True)

    def _branch(
        self, path: list[int], done: set[tuple[int, int]], *, is_ring: bool = False
    ) -> Branch:
        for a, b in pairwise(path):
            done |= {(a, b), (b, a)}
        begin, end = (node if len(self.links[node]) > 2 else -1 for node in (path[0], path[-1]))
        return Branch(self.points[path], self.radii[path], (begin, end), is_ring)


def _medial_axis(shape: Shape, outlines: list[FloatArray]) -> _Graph:
    """Voronoi edges between points of the outlines, as far as they lie inside."""
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
    graph = _Graph(diagram.vertices.copy(), radii)
    for a, b in pairs[kept].tolist():
        graph.connect(a, b)
    return graph


def _sites(contour: Contour) -> FloatArray:
    return contour.resampled(max(8, round(contour.length / OUTLINE_STEP))).points


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
