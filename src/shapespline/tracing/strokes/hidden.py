"""Strokes that other ink hides, led on: across it, to another that they meet, to each other."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.strokes.course import EndCourse, StraightCourse, end_course, meeting

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

    from shapespline.tracing.strokes.pen import Pen
    from shapespline.tracing.strokes.pen_net import PenNet
    from shapespline.typing import FloatArray

# Over so many radii it is sought on the other side, within this angle of its course.
ACROSS, ASIDE = 8.0, np.radians(40.0)
# It meets another stroke within so many radii, at a corner or junction if that is within this part
# of one and half a pixel.
AHEAD, AT_CORNER = 4.0, 0.3
# Pixels between places that are one.
SAME = 1e-6


class _Crossed(NamedTuple):
    """An edge of the net that a line meets, and where, at this distance along the line."""

    at: float
    edge: tuple[int, int]
    place: FloatArray


def lead_on(net: PenNet, pen: Pen, outline: cKDTree) -> None:
    """Lead loose ends of a net on to where they belong, but for those that are ends of strokes.

    Parameters
    ----------
    net : PenNet
        Changed in place.
    pen : Pen
    outline : cKDTree
        Points on all outlines: the pen has been where they are no nearer than its radius.
    """
    leading = _Leading(net, pen, outline)
    leading.across()
    leading.to_strokes()
    leading.to_each_other()


class _Leading:
    """The net while its loose ends are led on."""

    def __init__(self, net: PenNet, pen: Pen, outline: cKDTree) -> None:
        self.graph, self.ends = net
        self.pen, self.outline = pen, outline

    def _hidden(self) -> list[int]:
        return [node for node in self.graph.loose_ends() if node not in self.ends]

    def across(self) -> None:
        """Strokes go on where they come out of what hides them, those that bend least first."""
        from scipy.spatial import cKDTree

        nodes, graph, radius = self._hidden(), self.graph, self.pen.radius
        if len(nodes) < 2:
            return
        courses = {node: self._course(node).direction for node in nodes}
        found = []
        for i, j in cKDTree(graph.points[nodes]).query_pairs(ACROSS * radius):
            a, b = nodes[i], nodes[j]
            chord = graph.points[b] - graph.points[a]
            length = float(np.hypot(*chord))
            if length == 0.0:
                found.append((0.0, a, b, graph.points[[a, b]]))
                continue
            turns = np.arccos(
                np.clip([courses[a] @ chord / length, -courses[b] @ chord / length], -1.0, 1.0)
            )
            if turns.max() > ASIDE:
                continue
            way = _hermite(graph.points[a], courses[a], graph.points[b], -courses[b])
            if self._is_inked(way):
                found.append((float(turns.sum()) + 0.02 * length / radius, a, b, way))
        led: set[int] = set()
        for _, a, b, way in sorted(found, key=lambda one: one[:3]):
            if not led & {a, b}:
                led |= {a, b}
                self._lay([a, *self._new(way[1:-1]), b])

    def to_strokes(self) -> None:
        """Strokes that end at another go on until they meet it."""
        for node in self._hidden():
            course = self._course(node)
            own = set(self.graph.walk(node, next(iter(self.graph.links[node])))[:3])
            if self._leads(node, course.way(self.graph.points[node], AHEAD * self.pen.radius), own):
                continue
            corner = self._corner_ahead(node, course.direction)
            if corner is not None:
                self.graph.connect(node, corner)

    def _leads(self, node: int, way: FloatArray, own: set[int]) -> bool:
        """Whether a way from a loose end meets another stroke; then it is laid."""
        for k, (begin, end) in enumerate(pairwise(way)):
            length = float(np.hypot(*(end - begin)))
            met = self._first_crossed(begin, (end - begin) / length, length, own)
            if not self._is_inked((end if met is None else met.place)[None]):
                return False
            if met is not None:
                corner = self._special_at(met.place)
                last = self._part(met) if corner is None else corner
                self.graph.connect_all([node, *self._new(way[1 : k + 1]), last])
                return True
        return False

    def _corner_ahead(self, node: int, course: FloatArray) -> int | None:
        """The corner or junction nearest to the course of a loose end, if ink leads there."""
        graph = self.graph
        own = set(graph.walk(node, next(iter(graph.links[node]))))
        found = []
        for other in {*graph.corners, *graph.junctions()} - own:
            chord = graph.points[other] - graph.points[node]
            length = float(np.hypot(*chord))
            turn = float(np.arccos(np.clip(course @ chord / max(length, 1e-12), -1.0, 1.0)))
            near = length <= AHEAD * self.pen.radius and turn <= ASIDE
            if near and self._is_inked(np.linspace(graph.points[node], graph.points[other], 8)):
                found.append((turn, other))
        return min(found)[1] if found else None

    def to_each_other(self) -> None:
        """What is hidden on all sides meets where its courses do."""
        nodes, points = self._hidden(), self.graph.points
        while nodes:
            first = nodes.pop(0)
            near = [
                node
                for node in nodes
                if np.hypot(*(points[node] - points[first])) < AHEAD * self.pen.radius
                and self._is_inked(np.linspace(points[first], points[node], 8))
            ]
            if not near:
                continue
            group = [first, *near]
            nodes = [node for node in nodes if node not in near]
            courses = [StraightCourse(points[node], self._course(node).direction) for node in group]
            place = meeting(courses)
            if place is None or not self._is_inked(place[None]):
                place = points[group].mean(axis=0)
            (middle,) = self._new(place[None])
            points = self.graph.points
            if len(group) == 2:
                self.graph.corners.add(middle)
            for node in group:
                self.graph.connect(node, middle)

    def _course(self, node: int) -> EndCourse:
        """Where a loose end leads, and how its way bends."""
        graph = self.graph
        path = graph.walk(node, next(iter(graph.links[node])))
        corner = next((k for k, at in enumerate(path) if k and at in graph.corners), len(path))
        points = graph.points[path[: corner + 1]]
        if len(points) < 3:
            points = graph.points[path[:2]]
        return end_course(points, self.pen.radius)

    def _is_inked(self, places: FloatArray) -> bool:
        """Whether the pen can have been there."""
        least = self.pen.radius - 2.0 * self.pen.slack
        return bool((self.outline.query(places)[0] >= least).all())

    def _new(self, points: FloatArray) -> list[int]:
        return self.graph.add(points, self.pen.radius)

    def _lay(self, path: list[int]) -> None:
        """Link a path, parted where it crosses what is there."""
        own = set(path)
        for a, b in pairwise(path):
            begin, way = self.graph.points[a], self.graph.points[b] - self.graph.points[a]
            length = float(np.hypot(*way))
            met = None
            if length > 0.0:
                met = self._first_crossed(begin, way / length, length, own)
            if met is None:
                self.graph.connect(a, b)
            else:
                middle = self._part(met)
                own.add(middle)
                self.graph.connect_all([a, middle, b])

    def _first_crossed(
        self, start: FloatArray, along: FloatArray, reach: float, own: set[int]
    ) -> _Crossed | None:
        """The first edge of the net, none of its own, that a line meets within a length."""
        points, links = self.graph.points, self.graph.links
        near = np.hypot(*(points - start).T) <= reach + 2.0
        edges = [
            (a, b)
            for a in np.flatnonzero(near).tolist()
            if a not in own
            for b in links.get(a, ())
            if b not in own and (a < b or not near[b])
        ]
        if not edges:
            return None
        begin, end = points[[a for a, _ in edges]], points[[b for _, b in edges]]
        side, away = end - begin, begin - start
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = along[0] * side[:, 1] - along[1] * side[:, 0]
            at = (away[:, 0] * side[:, 1] - away[:, 1] * side[:, 0]) / slope
            share = (away[:, 0] * along[1] - away[:, 1] * along[0]) / slope
        hit = np.isfinite(at) & (at >= -0.5) & (at <= reach) & (np.abs(share - 0.5) <= 0.5 + 1e-6)
        if not hit.any():
            return None
        first = int(np.argmin(np.where(hit, at, np.inf)))
        return _Crossed(float(at[first]), edges[first], begin[first] + share[first] * side[first])

    def _special_at(self, place: FloatArray) -> int | None:
        """The corner or junction next to a place, if there is one."""
        special = [*self.graph.corners, *self.graph.junctions()]
        if not special:
            return None
        off = np.hypot(*(self.graph.points[special] - place).T)
        nearest = int(np.argmin(off))
        return special[nearest] if off[nearest] <= AT_CORNER * self.pen.radius + 0.5 else None

    def _part(self, met: _Crossed) -> int:
        """The node at the place where an edge of the net is met, a new one between its ends."""
        for end in met.edge:
            if np.hypot(*(self.graph.points[end] - met.place)) <= SAME:
                return end
        (node,) = self._new(met.place[None])
        self.graph.disconnect(*met.edge)
        self.graph.connect_all([met.edge[0], node, met.edge[1]])
        return node


def _hermite(a: FloatArray, from_a: FloatArray, b: FloatArray, to_b: FloatArray) -> FloatArray:
    """The cubic between two places with these directions, a pixel between its points."""
    length = float(np.hypot(*(b - a)))
    t = np.linspace(0.0, 1.0, max(3, int(length) + 1))[:, None]
    ends = a * (2 * t**3 - 3 * t**2 + 1) + b * (3 * t**2 - 2 * t**3)
    return np.asarray(ends + length * (from_a * (t**3 - 2 * t**2 + t) + to_b * (t**3 - t**2)))
