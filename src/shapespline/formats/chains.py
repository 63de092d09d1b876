"""Loose pieces that meet end to end, put together to outlines."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.drawing import Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray, IntArray

# Of the size of the drawing: ends nearer than this are one point.
MEETING = 1e-7


def chained(pieces: Sequence[Piece]) -> list[list[Piece]]:
    """Pieces as outlines: each goes on where the one before it ends, turned round where need be.

    A chain ends where no other piece goes on, or more than one could; where a ring is all there
    is, it begins with its first piece. Ends that meet become one point, to the bit.

    Examples
    --------
    >>> ends = np.array([0.0, 0, 1, 1])
    >>> a = Piece("line", 1, ends, np.array([[0.0, 0], [1, 0]]))
    >>> b = Piece("line", 1, ends, np.array([[1.0, 1], [1, 0]]))
    >>> [[piece.control_points.tolist() for piece in chain] for chain in chained([a, b])]
    [[[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [1.0, 1.0]]]]
    """
    pieces = [piece for piece in pieces if np.ptp(piece.control_points, axis=0).any()]
    if not pieces:
        return []
    points, ends = _meeting_points(pieces)
    at: list[list[int]] = [[] for _ in points]
    for index, pair in enumerate(ends.tolist()):
        for node in pair:
            at[node].append(index)
    free = dict.fromkeys(range(len(pieces)))
    chains = []
    while free:
        index = next(iter(free))
        # Back to where the chain begins, or once around a ring; then along it.
        _, begin = _walk(index, int(ends[index, 0]), ends, at)[-1]
        first = next(i for i in at[begin] if i in free) if len(at[begin]) != 2 else index
        other = ends[first, 1] if ends[first, 0] == begin else ends[first, 0]
        if len(at[begin]) == 2:  # a ring
            begin, other = ends[first]
        walk = [(first, int(begin)), *_walk(first, int(other), ends, at)[:-1]]
        chain = []
        for i, node in walk:
            if i not in free:
                break
            del free[i]
            chain.append(_oriented(pieces[i], points, ends[i], node))
        chains.append(chain)
    return chains


def _walk(index: int, node: int, ends: IntArray, at: list[list[int]]) -> list[tuple[int, int]]:
    """Pieces met on leaving piece ``index`` through a node, each with the node it is entered by.

    The last entry is (-1, the node where it ends).
    """
    found, start = [], index
    while len(at[node]) == 2:
        a, b = at[node]
        index = b if a == index else a
        if index == start:
            break
        found.append((index, node))
        node = int(ends[index, 1] if ends[index, 0] == node else ends[index, 0])
    return [*found, (-1, node)]


def _meeting_points(pieces: Sequence[Piece]) -> tuple[FloatArray, IntArray]:
    """Points where pieces end, those that meet taken as one, and the two of each piece."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    ends = np.concatenate([piece.control_points[[0, -1]] for piece in pieces])
    everything = np.concatenate([piece.control_points for piece in pieces])
    size = float(np.ptp(everything, axis=0).max())
    pairs = cKDTree(ends).query_pairs(MEETING * size, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(ends),) * 2)
    _, label = connected_components(links, directed=False)
    _, first, node = np.unique(label, return_index=True, return_inverse=True)
    return ends[first], node.reshape(-1, 2)


def _oriented(piece: Piece, points: FloatArray, ends: IntArray, begin: int) -> Piece:
    """The piece from a node on, its ends put on the points of its nodes."""
    control_points, knots, (first, last) = piece.control_points, piece.knots, ends.tolist()
    if first != begin:
        control_points, knots = control_points[::-1], 1.0 - knots[::-1]
        first, last = last, first
    control_points = np.array(control_points)
    control_points[0], control_points[-1] = points[first], points[last]
    return Piece(piece.kind, piece.degree, knots, control_points)
