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
from shapespline.values import Contour, Shape

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from shapespline.typing import FloatArray

# Pixels between points on the outline, and between points of a centre line.
OUTLINE_STEP, LINE_STEP = 0.5, 1.0
# A branch with a loose end is a stroke if it is longer than the disc of its junction is wide, that
# many radii: the corner of a square end is 1.41 away from where its two branches part.
SPUR = 1.6
# Junctions within this part of their radius are one: where two strokes cross there are two of them.
CROSSING = 1.0
# Within so many radii of a junction the axis follows neither stroke: a line takes its place.
STRAIGHT = 1.5
# A line ends where its discs become smaller than this part of what they are within the stroke; of
# a tip that tapers so many radii at most are lost.
FULL, TAPER = 0.9, 2.0


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
        junctions to the bit, and closed ones of rings; the longest first. A stroke's line ends
        about half its width before its end.

    Raises
    ------
    DegenerateContourError
        If there is no stroke: dots alone have no centre line.

    Examples
    --------
    >>> bar = Contour([(0, 0), (40, 0), (40, 4), (0, 4)], closed=True)
    >>> (line,) = centerlines(Shape([bar]))
    >>> line.closed, bool(np.abs(line.points[:, 1] - 2).max() < 1e-9), 34 < line.length < 38
    (False, True, True)
    """
    graph = _medial_axis(shape)
    graph.prune()
    graph.merge_junctions()
    found = [_resampled(path) for path in graph.paths()]
    lines = [line for line in found if line is not None]
    if not lines:
        raise DegenerateContourError(
            "no stroke in the picture: what there is has no centre line longer than it is wide;"
            " trace its outline instead"
        )
    lines.sort(key=lambda line: -line.length)
    return Shape(lines, frame=shape.frame, unit=shape.unit)


def _resampled(path: FloatArray) -> Contour | None:
    """A path at even steps; None for one without extent. Its first and last points stay."""
    steps = np.hypot(*np.diff(path, axis=0).T)
    closed = bool((path[0] == path[-1]).all()) and len(path) > 3
    if steps.sum() < LINE_STEP:
        return None
    count = max(8 if closed else 2, round(float(steps.sum()) / LINE_STEP) + 1)
    contour = Contour.silently(path[:-1] if closed else path, closed)
    return contour.resampled(count)


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

    def paths(self) -> Iterator[FloatArray]:
        """Every branch between ends and junctions, then the rings."""
        done: set[tuple[int, int]] = set()
        for node in [n for n, others in self.links.items() if len(others) not in (0, 2)]:
            for other in sorted(self.links[node]):
                if (node, other) not in done:
                    path = self.walk(node, other)
                    done |= {(path[0], path[1]), (path[-1], path[-2])}
                    for a, b in pairwise(path):
                        done |= {(a, b), (b, a)}
                    yield self._straightened(path)
        for node, others in self.links.items():
            if len(others) == 2 and not any((node, other) in done for other in others):
                path = self.walk(node, min(others))
                for a, b in pairwise(path):
                    done |= {(a, b), (b, a)}
                yield self.points[path]

    def _straightened(self, path: list[int]) -> FloatArray:
        """Points of a branch: straight near junctions, where strokes mix; no hook at loose ends."""
        points, kept = self.points[path], np.ones(len(path), dtype=bool)
        loose = [len(self.links[node]) == 1 for node in (path[0], path[-1])]
        for end, is_loose in zip((0, -1), loose, strict=True):
            off = np.hypot(*(points - points[end]).T)
            if is_loose:
                kept &= ~self._in_corner(path, off)
            else:
                kept &= off > STRAIGHT * self.radii[path[end]]
        kept[[0, -1]] |= ~np.array(loose)
        return points[kept]

    def _in_corner(self, path: list[int], off: FloatArray) -> NDArray[np.bool_]:
        """Nodes at a loose end where the discs shrink: the axis has turned into a corner there."""
        radii = self.radii[path]
        widest = float(radii[off <= 2 * TAPER * np.median(radii)].max())
        far = off > TAPER * widest
        full = far | (radii >= FULL * np.median(radii[off <= 2 * TAPER * widest]))
        inner = float(off[full].min()) if full.any() else 0.0
        return np.asarray(off < inner)


def _medial_axis(shape: Shape) -> _Graph:
    """Voronoi edges between points of the outlines, as far as they lie inside."""
    from scipy.spatial import Voronoi

    sites = np.concatenate([_sites(contour) for contour in shape])
    diagram = Voronoi(sites)
    inside = _inside(diagram.vertices, shape)
    pairs = np.asarray(diagram.ridge_vertices)
    kept = (pairs >= 0).all(axis=1) & inside[pairs[:, 0]] & inside[pairs[:, 1]]
    radii = np.full(len(diagram.vertices), np.inf)
    of = np.asarray(diagram.ridge_points)[:, 0]
    for end in (0, 1):
        found = np.hypot(*(diagram.vertices[pairs[kept, end]] - sites[of[kept]]).T)
        np.minimum.at(radii, pairs[kept, end], found)
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
