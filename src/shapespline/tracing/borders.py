"""Borders between areas of any number of kinds: each of them once, from junction to junction.

Marching squares on labels: the border crosses between neighbouring pixels of different labels;
where three or four meet in a cell they have a junction there. Every area is bounded by rings of
these borders, so that neighbours share theirs to the bit, without a gap and without an overlap.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.typing import BoolArray, FloatArray, IntArray

OUTSIDE = -1


class Nodes(NamedTuple):
    """Where borders cross between two pixels: as Crossings, and the labels of the two."""

    row: IntArray
    column: IntArray
    upright: BoolArray
    first: IntArray
    second: IntArray

    def chosen(self, index: IntArray) -> Nodes:
        """Some of them."""
        where = self.row[index], self.column[index], self.upright[index]
        return Nodes(*where, self.first[index], self.second[index])


class Borders(NamedTuple):
    """Crossings, junctions, and how they hang together.

    Attributes
    ----------
    nodes : Nodes
    cells : list of list of int
        For each junction the four nodes around it, clockwise from the upper side; -1 for none.
    corners : list of tuple of float
        Corners of the picture that borders go round, numbered after nodes and junctions.
    links : list of list of int
        For each node or corner the one or two that come next: nodes, corners or junctions.
    """

    nodes: Nodes
    cells: list[list[int]]
    corners: list[tuple[float, float]]
    links: list[list[int]]


class Arc(NamedTuple):
    """A border from junction to junction, or a closed one, whose first node is its last.

    Attributes
    ----------
    path : list of int
        Its nodes in order.
    left, right : int
        The labels on its sides.
    is_ring : bool
    """

    path: list[int]
    left: int
    right: int
    is_ring: bool


class Ring(NamedTuple):
    """A closed border with one label on its left: arcs in order, and whether they run backwards."""

    label: int
    halves: list[tuple[int, bool]]

    def outline(self, lines: Sequence[FloatArray], arcs: Sequence[Arc]) -> FloatArray:
        """Points of the ring, from those of each arc (of a closed one without the last)."""
        parts = []
        for index, backwards in self.halves:
            own = lines[index][::-1] if backwards else lines[index]
            parts.append(own if arcs[index].is_ring else own[:-1])
        return np.concatenate(parts)


def borders_of(labels: NDArray[np.signedinteger]) -> Borders:
    """Crossings and junctions of a picture of labels, its rim included."""
    height, width = labels.shape
    padded = np.pad(labels, 1, constant_values=OUTSIDE)
    beside, below = padded[:, :-1] != padded[:, 1:], padded[:-1] != padded[1:]
    places = [np.nonzero(side) for side in (beside, below)]
    count = len(places[0][0])
    row, column = (np.concatenate([p[k] for p in places]) for k in (0, 1))
    upright = np.arange(len(row)) >= count
    labelled = (padded[row, column], padded[row + upright, column + ~upright])
    nodes = Nodes(row - 1, column - 1, upright, *(each.astype(np.int64) for each in labelled))
    links: list[list[int]] = [[] for _ in range(len(row))]
    # Cells that something crosses, and the numbers of what crosses their upper, right, lower and
    # left side.
    rows, columns = np.nonzero(beside[:-1] | below[:, 1:] | beside[1:] | below[:, :-1])
    around = (
        _numbers(beside, rows, columns),
        _numbers(below, rows, columns + 1, count),
        _numbers(beside, rows + 1, columns),
        _numbers(below, rows, columns, count),
    )
    sides = np.stack(around, axis=-1)
    cells: list[list[int]] = []
    corners: list[tuple[float, float]] = []
    pending: list[tuple[int, int]] = []
    for r, c, four in zip(rows.tolist(), columns.tolist(), sides.tolist(), strict=True):
        there = [node for node in four if node >= 0]
        if len(there) == 2 and r in (0, height) and c in (0, width):
            corners.append((float(c), float(height - r)))
            pending.append((there[0], len(corners) - 1))
            pending.append((there[1], len(corners) - 1))
        elif len(there) == 2:
            links[there[0]].append(there[1])
            links[there[1]].append(there[0])
        elif len(there) == 4 and (ways := _apart(padded, r, c)) is not None:
            for a, b in ways:
                links[four[a]].append(four[b])
                links[four[b]].append(four[a])
        else:
            cells.append(four)
    first_junction = len(row)
    for index, four in enumerate(cells):
        for node in four:
            if node >= 0:
                links[node].append(first_junction + index)
    first_corner = first_junction + len(cells)
    links += [[] for _ in range(len(cells) + len(corners))]
    for node, corner in pending:
        links[node].append(first_corner + corner)
        links[first_corner + corner].append(node)
    return Borders(nodes, cells, corners, links)


def _numbers(crossed: BoolArray, row: IntArray, column: IntArray, first: int = 0) -> IntArray:
    """Numbers of crossings at some places, from the first on, row by row; -1 where none is."""
    there = np.flatnonzero(crossed)
    number = first + np.searchsorted(there, row * crossed.shape[1] + column)
    return np.where(crossed[row, column], number, -1)


def _apart(
    padded: NDArray[np.signedinteger], r: int, c: int
) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """Pairs of sides that belong together where a label, or two, meets itself by a corner.

    What there is less of around is joined. So is a stroke between two areas, if there is less of it
    than of both (TRC-35).
    """
    (a, b), (e, d) = padded[r : r + 2, c : c + 2].tolist()
    around = padded[max(r - 2, 0) : r + 4, max(c - 2, 0) : c + 4]
    falling, rising = np.isin(around, (a, d)).sum(), np.isin(around, (b, e)).sum()
    if a == d and (falling <= rising if b == e else falling < rising):
        return (0, 1), (2, 3)
    if b == e and (a == d or rising < falling):
        return (0, 3), (1, 2)
    return None


def rings_of(borders: Borders, points: FloatArray) -> tuple[list[Arc], list[Ring]]:
    """All borders, and every ring of them around an area or a hole in it, the area on its left.

    Parameters
    ----------
    borders : Borders
    points : ndarray, shape (n, 2)
        Places of nodes, junctions and corners, y up, each node between its two pixels.
    """
    arcs = [
        Arc(path, *_sides(borders, points, path), not _is_junction(borders, path[0]))
        for path in _paths(borders)
    ]
    # A half of a border: the arc, and whether it is run backwards.
    starts: dict[tuple[int, int], tuple[int, bool]] = {}
    for index, arc in enumerate(arcs):
        if not arc.is_ring:
            starts[arc.path[0], arc.path[1]] = (index, False)
            starts[arc.path[-1], arc.path[-2]] = (index, True)
    rings, done = [], set()
    for index, arc in enumerate(arcs):
        for backwards, label in ((False, arc.left), (True, arc.right)):
            halves = []
            half = (index, backwards)
            while half not in done:
                done.add(half)
                halves.append(half)
                path = arcs[half[0]].path[:: -1 if half[1] else 1]
                if arcs[half[0]].is_ring:
                    break
                half = starts[path[-1], _clockwise(borders, path[-1], path[-2])]
            if halves and label != OUTSIDE:
                rings.append(Ring(label, halves))
    return arcs, rings


def _is_junction(borders: Borders, node: int) -> bool:
    n_nodes = len(borders.nodes.row)
    return n_nodes <= node < n_nodes + len(borders.cells)


def _clockwise(borders: Borders, junction: int, came: int) -> int:
    """The node by which who comes from another leaves a junction, the same area on the left."""
    four = borders.cells[junction - len(borders.nodes.row)]
    side = four.index(came)
    return next(four[(side + k) % 4] for k in (1, 2, 3, 4) if four[(side + k) % 4] >= 0)


def _paths(borders: Borders) -> list[list[int]]:
    """Borders from junction to junction, and closed ones, whose first node is their last."""
    seen: set[int] = set()
    arcs = []

    def walk(path: list[int]) -> list[int]:
        while True:
            here, before = path[-1], path[-2]
            if _is_junction(borders, here) or here == path[0]:
                return path
            seen.add(here)
            a, b = borders.links[here]
            path.append(b if a == before else a)

    first = len(borders.nodes.row)
    for junction, four in enumerate(borders.cells, start=first):
        for node in four:
            if node >= 0 and node not in seen:
                arcs.append(walk([junction, node]))  # noqa: PERF401 - each walk marks what it saw
    for node in range(first):
        if node not in seen:
            seen.add(node)
            arcs.append(walk([node, borders.links[node][1]]))
    return arcs


def _sides(borders: Borders, points: FloatArray, arc: list[int]) -> tuple[int, int]:
    """The labels on the left and on the right of an arc."""
    nodes = borders.nodes
    index = next(k for k, node in enumerate(arc) if node < len(nodes.row))
    here = arc[index]
    ahead = (
        points[arc[index + 1]] - points[here]
        if index + 1 < len(arc)
        else points[here] - points[arc[index - 1]]
    )
    # From the second pixel to the first: up or to the left.
    to_first = (0.0, 1.0) if nodes.upright[here] else (-1.0, 0.0)
    first_left = ahead[0] * to_first[1] - ahead[1] * to_first[0] > 0
    first, second = int(nodes.first[here]), int(nodes.second[here])
    return (first, second) if first_left else (second, first)
