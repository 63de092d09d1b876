"""Boundaries that outlines share: cut into arcs between junctions, each of them once.

Outlines that run through the same points there, in one direction or the other, share a boundary;
it ends where one of them leaves it. That is the topology of maps (TopoJSON, Bostock 2012).
"""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour


class ArcUse(NamedTuple):
    """An arc as a part of an outline: its index, and whether the outline runs it backwards."""

    arc: int
    backwards: bool


class Arcs(NamedTuple):
    """Arcs of all outlines.

    ``points`` holds an array for each arc, ``closed`` whether it is a whole ring; ``uses`` the arcs
    of each outline end to end, none for an outline that shares nothing.
    """

    points: list[FloatArray]
    closed: list[bool]
    uses: list[list[ArcUse]]


def shared_arcs(contours: Sequence[Contour], snap: float) -> Arcs:
    """Arcs between junctions of the outlines that share one, points nearer than ``snap`` made one.

    Examples
    --------
    >>> from shapespline import Contour
    >>> left = Contour([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)
    >>> right = Contour([(1, 0), (2, 0), (2, 1), (1, 1)], closed=True)
    >>> arcs = shared_arcs([left, right], 1e-9)
    >>> [len(points) for points in arcs.points], [len(uses) for uses in arcs.uses]
    ([2, 4, 4], [2, 2])
    """
    points, chains = _snapped(contours, snap)
    junctions = _junctions(chains, contours)
    known: dict[tuple[int, ...], int] = {}
    found = Arcs([], [], [])
    for chain, contour in zip(chains, contours, strict=True):
        found.uses.append([])
        for part, ring in _cut(chain, junctions, contour.closed):
            key, backwards = _canonical(part, ring)
            if key not in known:
                known[key] = len(found.points)
                found.points.append(points[list(key)])
                found.closed.append(ring)
            found.uses[-1].append(ArcUse(known[key], backwards))
    count = np.bincount([use.arc for uses in found.uses for use in uses])
    alone = [all(count[use.arc] < 2 for use in uses) for uses in found.uses]
    return _without(found, alone)


def _snapped(contours: Sequence[Contour], snap: float) -> tuple[FloatArray, list[list[int]]]:
    """Distinct points, and the indices of those that each contour runs through."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    everything = np.concatenate([contour.points for contour in contours])
    pairs = cKDTree(everything).query_pairs(snap, output_type="ndarray")
    size = (len(everything),) * 2
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=size)
    _, label = connected_components(links, directed=False)
    _, first, place = np.unique(label, return_index=True, return_inverse=True)
    ends = np.cumsum([len(contour) for contour in contours])
    chains = []
    for contour, part in zip(contours, np.split(place, ends[:-1]), strict=True):
        chain = [int(part[0])]
        chain += [int(b) for a, b in itertools.pairwise(part) if a != b]
        if contour.closed and len(chain) > 1 and chain[0] == chain[-1]:
            chain.pop()
        chains.append(chain)
    return everything[first], chains


def _junctions(chains: list[list[int]], contours: Sequence[Contour]) -> set[int]:
    """Points at which an outline ends, or at which not all go on to the same neighbours."""
    neighbours: dict[int, frozenset[int]] = {}
    junctions: set[int] = set()
    for chain, contour in zip(chains, contours, strict=True):
        n = len(chain)
        for k, here in enumerate(chain):
            if not contour.closed and k in (0, n - 1):
                junctions.add(here)
                continue
            around = frozenset((chain[k - 1], chain[(k + 1) % n]))
            if neighbours.setdefault(here, around) != around:
                junctions.add(here)
    return junctions


def _cut(chain: list[int], junctions: set[int], closed: bool) -> list[tuple[list[int], bool]]:
    """Parts of a chain between junctions, and whether one is a whole ring."""
    at = [k for k, point in enumerate(chain) if point in junctions]
    if not at:
        return [(chain, closed)]
    if not closed:
        cuts = sorted({0, *at, len(chain) - 1})
        return [(chain[a : b + 1], False) for a, b in itertools.pairwise(cuts)]
    turned = chain[at[0] :] + chain[: at[0]] + [chain[at[0]]]
    cuts = [k - at[0] for k in at] + [len(chain)]
    return [(turned[a : b + 1], False) for a, b in itertools.pairwise(cuts)]


def _canonical(part: list[int], ring: bool) -> tuple[tuple[int, ...], bool]:
    """The same for whoever runs through it; whether that is the other way round."""
    if not ring:
        forth, back = tuple(part), tuple(reversed(part))
        return min(forth, back), back < forth
    start = part.index(min(part))
    forth = tuple(part[start:] + part[:start])
    back = (forth[0], *reversed(forth[1:]))
    return min(forth, back), back < forth


def _without(arcs: Arcs, alone: list[bool]) -> Arcs:
    """The same without the outlines that share nothing, and without their arcs."""
    uses = [[] if left else own for own, left in zip(arcs.uses, alone, strict=True)]
    kept = sorted({use.arc for own in uses for use in own})
    new: IntArray = np.full(len(arcs.points), -1)
    new[kept] = np.arange(len(kept))
    return Arcs(
        [arcs.points[k] for k in kept],
        [arcs.closed[k] for k in kept],
        [[ArcUse(int(new[use.arc]), use.backwards) for use in own] for own in uses],
    )
