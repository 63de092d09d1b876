"""The net of a pen's strokes: what its edges tell, each stroke once."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.strokes.graph import Graph
from shapespline.tracing.strokes.pen_edges import HIDDEN

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.strokes.pen import Pen
    from shapespline.tracing.strokes.pen_edges import PenEdge
    from shapespline.typing import BoolArray, FloatArray, IntArray

# Both sides of a stroke lead opposite ways, but for what turns by the arc cosine of this.
OPPOSITE = -0.7
# What parts in a corner turns by more than 170 degrees at its most.
PARTING = -np.cos(np.radians(10.0))
# Middles told by the other side are next to one of this side within so many steps along it.
ALONG = 1.0
# Candidates that are looked at for each: points of both sides within some pixels.
CANDIDATES = 24
# What one side tells beside another stroke is one if it is this part of the radius long, and so
# many pixels.
SHORTEST, SHORTEST_PIXELS = 0.3, 1.5


class PenNet(NamedTuple):
    """The strokes of a pen, each once, and which nodes are ends of strokes."""

    graph: Graph
    ends: set[int]


def pen_net(edges: Sequence[PenEdge], pen: Pen) -> PenNet:
    """The net that edges of one part of the ink tell; where ink hides strokes they end loosely."""
    net = _Net(edges, pen)
    net.join()
    return PenNet(net.graph, net.ends)


class _Net:
    """The graph while it is made; its first nodes are the middles of all edges in a row."""

    def __init__(self, edges: Sequence[PenEdge], pen: Pen) -> None:
        self.edges = sorted(edges, key=lambda edge: -len(edge.middles))
        self.pen = pen
        points = np.concatenate([edge.middles for edge in self.edges])
        self.directions = np.concatenate([edge.directions for edge in self.edges])
        self.graph = Graph(points, np.full(len(points), pen.radius))
        self.ends: set[int] = set()

    def join(self) -> None:
        """The longest edges first: others add what no edge before them has told."""
        beside, is_beside, aside = self._beside()
        is_told = np.zeros(len(beside), dtype=bool)
        ends: dict[int, list[int]] = {}
        first = 0
        for edge in self.edges:
            own = np.arange(first, first + len(edge.middles))
            first += len(own)
            known = is_beside[own] & is_told[beside[own]]
            nearest = known.argmax(axis=1)
            twin = np.where(known.any(axis=1), beside[own, nearest], -1)
            self._add(edge, own, twin, is_told, ends)
        # Half-way to where the other side tells it, as far as that is seen.
        seen = np.maximum(is_beside.sum(axis=1), 1)
        offset = 0.5 * np.where(is_beside, aside, 0.0).sum(axis=1) / seen
        left = np.column_stack([-self.directions[:, 1], self.directions[:, 0]])
        self.graph.points = self.graph.points + offset[:, None] * left
        self._close(ends)

    def _beside(self) -> tuple[IntArray, BoolArray, FloatArray]:
        """For each middle others, nearest along it first; which another side tells; how far."""
        from scipy.spatial import cKDTree

        points, reach = self.graph.points, self.pen.apart + ALONG
        found = cKDTree(points).query(points, CANDIDATES, distance_upper_bound=reach)[1]
        is_there = found < len(points)
        found = np.where(is_there, found, 0)
        direction, away = self.directions[:, None], points[found] - points[:, None]
        along = np.abs((away * direction).sum(axis=2))
        aside = direction[..., 0] * away[..., 1] - direction[..., 1] * away[..., 0]
        opposite = (direction * self.directions[found]).sum(axis=2) < OPPOSITE
        near = (along <= ALONG) & (np.abs(aside) <= self.pen.apart)
        order = np.argsort(along, axis=1, kind="stable")
        found, is_beside, aside = (
            np.take_along_axis(rows, order, 1)
            for rows in (found, is_there & opposite & near, aside)
        )
        return found, is_beside, aside

    def _add(
        self,
        edge: PenEdge,
        own: IntArray,
        twin: IntArray,
        is_told: BoolArray,
        ends: dict[int, list[int]],
    ) -> None:
        """Link what of an edge no other has told, from where others tell it to where they do."""
        graph, corners = self.graph, set(own[edge.corners].tolist())
        graph.corners |= {int(twin[k]) for k in edge.corners if twin[k] >= 0}
        self._part_at_tips(edge, own, twin, ends)
        free = twin < 0
        if edge.closed:
            if free.all():
                graph.connect_all([*own.tolist(), int(own[0])])
                graph.corners |= corners
                is_told[own] = True
                return
            turned = np.roll(np.arange(len(own)), -int(np.argmin(free)))
            own, twin, free = own[turned], twin[turned], free[turned]
            own, twin, free = (np.append(row, row[0]) for row in (own, twin, free))
        bounds = np.flatnonzero(np.diff(np.concatenate([[0], free.astype(int), [0]])))
        for a, b in bounds.reshape(-1, 2).tolist():
            path, shortest = own[a:b].tolist(), self._shortest
            if len(path) == len(own):  # nothing else tells of it, and what has an end is a stroke
                shortest = SHORTEST_PIXELS if edge.ends == (HIDDEN, HIDDEN) else 0.0
            if len(path) < 2 or graph.length(path) < shortest:
                continue
            is_told[own[a:b]] = True
            graph.connect_all(path)
            graph.corners |= corners & set(path)
            for at, node, beyond, end in (
                (a, path[0], a - 1, edge.ends[0]),
                (len(own) - b, path[-1], b, edge.ends[1]),
            ):
                if at > 0:
                    graph.connect(node, int(twin[beyond]))
                elif end != HIDDEN:
                    ends.setdefault(end, []).append(node)

    def _part_at_tips(
        self, edge: PenEdge, own: IntArray, twin: IntArray, ends: dict[int, list[int]]
    ) -> None:
        """Strokes that part in a sharp corner are beside each other there, but no sides of one."""
        for end, way in zip(edge.ends, (1, -1), strict=True):
            beside = (twin[::way] >= 0).argmin()
            if end in ends and beside > 0:
                rows = own[::way][beside - 1], twin[::way][beside - 1]
                if float(self.directions[rows[0]] @ self.directions[rows[1]]) > PARTING:
                    twin[::way][:beside] = -1

    @property
    def _shortest(self) -> float:
        return max(SHORTEST_PIXELS, SHORTEST * self.pen.radius)

    def _close(self, ends: dict[int, list[int]]) -> None:
        """Ends of strokes; where two begin that are not sides of one they meet in a corner."""
        for nodes in ends.values():
            if len(nodes) == 2:
                self.graph.connect(*nodes)
                self.graph.corners.add(nodes[0])
            else:
                self.ends |= set(nodes)
