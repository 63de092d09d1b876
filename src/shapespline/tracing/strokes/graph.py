"""A net of strokes: places where their middles pass, each with a radius, and what leads to what."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.typing import FloatArray


class Branch(NamedTuple):
    """Part of a net between ends and junctions: places, radii, and the nodes where it ends.

    Nodes are negative at loose ends; of a ring the first place is the last one, too. ``corners``
    are indices of places at which the stroke turns.
    """

    points: FloatArray
    radii: FloatArray
    nodes: tuple[int, int]
    is_ring: bool = False
    corners: tuple[int, ...] = ()

    @property
    def width(self) -> float:
        """Usual width, pixels."""
        return 2.0 * float(np.median(self.radii))


class Graph:
    """Nodes with the radii of their discs, and edges both ways.

    Attributes
    ----------
    points, radii : ndarray, shape (n, 2) and (n,)
    links : dict of int to set of int
        The neighbours of each node that has or had some.
    corners : set of int
        Nodes at which a stroke turns.
    """

    def __init__(self, points: FloatArray, radii: FloatArray) -> None:
        self.points, self.radii = points, radii
        self.links: dict[int, set[int]] = {}
        self.corners: set[int] = set()

    def add(self, points: FloatArray, radius: float) -> list[int]:
        """New nodes, linked to nothing."""
        first = len(self.points)
        self.points = np.concatenate([self.points, points])
        self.radii = np.concatenate([self.radii, np.full(len(points), radius)])
        return list(range(first, len(self.points)))

    def connect(self, a: int, b: int) -> None:
        """Make two nodes neighbours; one is none of its own."""
        if a != b:
            self.links.setdefault(a, set()).add(b)
            self.links.setdefault(b, set()).add(a)

    def connect_all(self, path: Sequence[int]) -> None:
        """Make each node of a path the neighbour of the next."""
        for a, b in pairwise(path):
            self.connect(a, b)

    def disconnect(self, a: int, b: int) -> None:
        """Make two nodes neighbours no more."""
        self.links[a].discard(b)
        self.links[b].discard(a)

    def disconnect_all(self, path: Sequence[int]) -> None:
        """Make no node of a path the neighbour of the next."""
        for a, b in pairwise(path):
            self.disconnect(a, b)

    def loose_ends(self) -> list[int]:
        """Nodes with one neighbour."""
        return [node for node, others in self.links.items() if len(others) == 1]

    def junctions(self) -> list[int]:
        """Nodes with more than two neighbours."""
        return [node for node, others in self.links.items() if len(others) > 2]

    def length(self, path: Sequence[int]) -> float:
        """Of the way along a path."""
        return float(np.hypot(*np.diff(self.points[list(path)], axis=0).T).sum())

    def walk(self, begin: int, towards: int) -> list[int]:
        """Nodes from one on, as far as there is one way only; back at the start at the latest."""
        path = [begin, towards]
        while len(self.links[path[-1]]) == 2 and path[-1] != begin:
            (ahead,) = self.links[path[-1]] - {path[-2]} or {path[-2]}
            path.append(ahead)
        return path

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
        corners = tuple(k for k, node in enumerate(path) if node in self.corners)
        return Branch(self.points[path], self.radii[path], (begin, end), is_ring, corners)
