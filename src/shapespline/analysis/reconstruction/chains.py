"""Chains through points of the plane: each point linked to at most two others."""

from __future__ import annotations

from math import atan2, pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray

# Ends of chains are joined if they are no farther apart than this many of the steps beside them.
GAP = 3.0
# So many points tell the step around a point, and so many where steps scatter.
AROUND, WIDELY = 8, 32
# Of fewer steps nobody knows how they scatter; one outline of so many has a longer one than those
# that are joined across (ANA-20).
FEWEST_STEPS, RARELY = 16, 1000.0
# Chains of fewer points are no rings, nor those whose ends are farther apart than this part of
# their length (ANA-20).
FEWEST_OF_RING, SHORT_GAP = 4, 0.4
# Nearest neighbours asked for beside the triangulation, which points on a line do not have.
NEAREST = 6
# An edge this many times longer than the median step of both its ends' surroundings is no step.
LONGEST = 5.0
# Rounds of exchanging edges, the turn from which a point is looked at, and what a turn costs: going
# straight back as much as so many steps.
ROUNDS = 20
SHARP, TURNING = 0.6, 4.0


class Links:
    """For each point its neighbours in a chain, at most two."""

    def __init__(self, points: FloatArray) -> None:
        self.points = points
        self.neighbours: list[list[int]] = [[] for _ in range(len(points))]
        self._root = list(range(len(points)))

    def distance(self, a: int, b: int) -> float:
        """Between two points."""
        (x, y), (u, v) = self.points[a], self.points[b]
        return float(np.hypot(x - u, y - v))

    def root(self, index: int) -> int:
        """Representative of the chain of a point."""
        while self._root[index] != index:
            self._root[index] = self._root[self._root[index]]
            index = self._root[index]
        return index

    def link(self, a: int, b: int) -> None:
        """Make two points neighbours."""
        self.neighbours[a].append(b)
        self.neighbours[b].append(a)
        self._root[self.root(a)] = self.root(b)

    def unlink(self, a: int, b: int) -> None:
        """Chains stay one for `root`, which is asked before the first is taken apart only."""
        self.neighbours[a].remove(b)
        self.neighbours[b].remove(a)

    def exchange(self, a: int, b: int, c: int, d: int) -> None:
        """Edges a b and c d become a c and b d."""
        own = self.neighbours
        own[a][own[a].index(b)], own[d][own[d].index(c)] = c, b
        own[b][own[b].index(a)], own[c][own[c].index(d)] = d, a

    def turn(self, index: int) -> float:
        """Angle by which the chain turns at a point, radians; 0 at its ends."""
        if len(self.neighbours[index]) < 2:
            return 0.0
        (x, y), (u, v), (r, s) = self.points[[self.neighbours[index][0], index,
                                              self.neighbours[index][1]]].tolist()  # fmt: skip
        p, q, m, n = u - x, v - y, r - u, s - v
        return abs(atan2(p * n - q * m, p * m + q * n))

    def cost(self, *indices: int) -> float:
        """Steps beside the points, and their turns in the unit of those steps."""
        total = 0.0
        for index in indices:
            steps = [self.distance(index, other) for other in self.neighbours[index]]
            total += 0.5 * sum(steps)
            total += TURNING * (self.turn(index) / pi) ** 2 * sum(steps) / max(len(steps), 1)
        return total

    def step(self, index: int) -> float:
        """Longest step beside a point, infinite where there is none."""
        lengths = [self.distance(index, other) for other in self.neighbours[index]]
        return max(lengths, default=np.inf)

    def is_ring(self, chain: list[int]) -> bool:
        """Whether a chain returns to where it begins."""
        return len(chain) > 2 and chain[0] in self.neighbours[chain[-1]]

    def chains(self) -> list[list[int]]:
        """Points of every chain in order, open ones from end to end; points alone too."""
        seen = np.zeros(len(self.neighbours), dtype=bool)
        found = []
        ends = [i for i, own in enumerate(self.neighbours) if len(own) < 2]
        for begin in [*ends, *range(len(self.neighbours))]:
            if seen[begin]:
                continue
            chain, before = [begin], -1
            seen[begin] = True
            while True:
                ahead = [k for k in self.neighbours[chain[-1]] if k != before and not seen[k]]
                if not ahead:
                    break
                before = chain[-1]
                chain.append(ahead[0])
                seen[ahead[0]] = True
            found.append(chain)
        return found


def linked(points: FloatArray) -> Links:
    """Chains through points, from the shortest edge on: what neighbours alone tell."""
    links = Links(points)
    edges, lengths = _candidates(points)
    scale = _scale(points, AROUND)
    for (a, b), length in zip(edges.tolist(), lengths.tolist(), strict=True):
        if length > LONGEST * max(scale[a], scale[b]):
            continue
        free = len(links.neighbours[a]) < 2 and len(links.neighbours[b]) < 2
        if free and links.root(a) != links.root(b):
            links.link(a, b)
    return links


def complete(links: Links) -> Links:
    """The same with stragglers inserted, wrong turns put right and ends joined."""
    _insert_stragglers(links)
    _improve(links)
    _join_ends(links)
    _improve(links)
    return links


def _candidates(points: FloatArray) -> tuple[IntArray, FloatArray]:
    """Edges of the Delaunay triangulation and to the nearest points, the shortest first."""
    from scipy.spatial import Delaunay, QhullError, cKDTree

    _, near = cKDTree(points).query(points, k=min(NEAREST + 1, len(points)))
    own = np.repeat(np.arange(len(points)), near.shape[1] - 1)
    pairs = [np.column_stack([own, near[:, 1:].ravel()])]
    try:
        corners = Delaunay(points).simplices
        pairs += [corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]
    except QhullError:  # all on a line
        pass
    edges = np.unique(np.sort(np.concatenate(pairs), axis=1), axis=0)
    lengths = np.hypot(*(points[edges[:, 0]] - points[edges[:, 1]]).T)
    order = np.argsort(lengths, kind="stable")
    return edges[order], lengths[order]


def _scale(points: FloatArray, around: int) -> FloatArray:
    """Local step: the median, around each point, of the distances to the second nearest."""
    from scipy.spatial import cKDTree

    count = min(1 + around, len(points))
    distances, near = cKDTree(points).query(points, k=count)
    second = distances[:, min(2, count - 1)]
    return np.median(second[near], axis=1)


def _insert_stragglers(links: Links) -> None:
    """Points without a chain go where they lengthen one least, if that is near enough."""
    from scipy.spatial import cKDTree

    alone = [i for i, own in enumerate(links.neighbours) if not own]
    if not alone or len(alone) == len(links.neighbours):
        return
    scale = _scale(links.points, AROUND)
    tree = cKDTree(links.points)
    for index in alone:
        if links.neighbours[index]:
            continue
        best, place = np.inf, None
        for other in tree.query(links.points[index], k=min(12, len(scale)))[1].tolist():
            if other == index:
                continue
            for beyond in links.neighbours[other]:
                added = (
                    links.distance(index, other)
                    + links.distance(index, beyond)
                    - links.distance(other, beyond)
                )
                if added < best:
                    best, place = added, (other, beyond)
            if len(links.neighbours[other]) == 1 and links.distance(index, other) < best:
                best, place = links.distance(index, other), (other, -1)
        if place is None or best > 2 * GAP * scale[index]:
            continue
        other, beyond = place
        if beyond >= 0:
            links.unlink(other, beyond)
            links.link(index, beyond)
        links.link(index, other)


def _improve(links: Links) -> None:
    """Exchange two edges for two others (2-opt) near sharp turns, while that lowers the cost.

    Length alone would undo true crossings too: what counts are steps and turns together, so that
    where two branches meet each goes straight on.
    """
    from scipy.spatial import cKDTree

    points = links.points
    _, near = cKDTree(points).query(points, k=min(NEAREST + 2, len(points)))
    doubtful = [i for i in range(len(points)) if links.turn(i) > SHARP]
    for _ in range(ROUNDS):
        moved: set[int] = set()
        for a in doubtful:
            for b in list(links.neighbours[a]):
                if b in links.neighbours[a]:
                    moved |= _exchanged(links, a, b, near[a].tolist())
        doubtful = sorted(moved)
        if not doubtful:
            return


def _exchanged(links: Links, a: int, b: int, candidates: list[int]) -> set[int]:
    """The points of the best exchange of the edge a b for a c and b d, made if it pays."""
    best, chosen = -1e-12, None
    for c in candidates:
        for d in list(links.neighbours[c]):
            if len({a, b, c, d}) < 4 or c in links.neighbours[a] or d in links.neighbours[b]:
                continue
            before = links.cost(a, b, c, d)
            links.exchange(a, b, c, d)
            gain = links.cost(a, b, c, d) - before
            links.exchange(a, c, b, d)
            if gain < best:
                best, chosen = gain, (c, d)
    if chosen is None:
        return set()
    links.exchange(a, b, *chosen)
    return {a, b, *chosen}


def _longest_by_chance(all_steps: list[FloatArray]) -> float:
    """The longest of steps that scatter as those of some chains do, in medians of them.

    Logarithms of neighbours tell the shape of Weibull's distribution, of which even steps are one
    end and points at random on a curve (exponential steps) another; the chains themselves end at
    long steps, and the mean would miss those. One outline of a thousand has a longer one.
    """
    steps = [row[row > 0] for row in all_steps]
    ratios = np.concatenate([np.diff(np.log(row)) for row in steps])
    if len(ratios) < FEWEST_STEPS:
        return 0.0
    inverse_shape = float(np.sqrt(3.0 * np.mean(ratios**2))) / np.pi
    n_steps = sum(len(row) for row in steps)
    return float((np.log(RARELY * n_steps) / np.log(2.0)) ** min(inverse_shape, 1.0))


class _Chain(NamedTuple):
    """A chain as its ends know it: its ends, its length, its median step and how many points."""

    ends: tuple[int, int]
    length: float
    typical: float
    n_points: int

    def joined(self, other: _Chain, a: int, b: int, gap: float) -> _Chain:
        """With another one, end a to its end b."""
        ends = (self.ends[self.ends[0] == a], other.ends[other.ends[0] == b])
        length, n_points = self.length + gap + other.length, self.n_points + other.n_points
        return _Chain(ends, length, min(self.typical, other.typical), n_points)


def _join_ends(links: Links) -> None:
    """Join ends of chains, the nearest first, across gaps of a few steps, or as long as by chance.

    A chain is closed across a gap that is short for its own length.
    """
    from scipy.spatial import cKDTree

    ends = [i for i, own in enumerate(links.neighbours) if len(own) == 1]
    if len(ends) < 2:
        return
    of: dict[int, _Chain] = {}
    chains = links.chains()
    all_steps = [np.hypot(*np.diff(links.points[chain], axis=0).T) for chain in chains]
    for chain, steps in zip(chains, all_steps, strict=True):
        if len(steps):
            tips = (chain[0], chain[-1])
            made = _Chain(tips, float(steps.sum()), float(np.median(steps)), len(chain))
            of.update(dict.fromkeys(tips, made))
    scale, longest = _scale(links.points, WIDELY), _longest_by_chance(all_steps)
    tree = cKDTree(links.points[ends])
    distances, near = tree.query(links.points[ends], k=min(8, len(ends)))
    pairs = sorted(
        {
            (float(d), min(ends[i], ends[k]), max(ends[i], ends[k]))
            for i in range(len(ends))
            for d, k in zip(distances[i], near[i], strict=True)
            if ends[i] != ends[k]
        }
    )
    for gap, a, b in pairs:
        if len(links.neighbours[a]) != 1 or len(links.neighbours[b]) != 1:
            continue
        one, other = of[a], of[b]
        closes = one.ends in ((a, b), (b, a))
        if closes and (one.n_points < FEWEST_OF_RING or gap > SHORT_GAP * one.length):
            continue
        reach = GAP * max(links.step(a), links.step(b), min(one.typical, other.typical))
        if gap <= max(reach, longest * min(scale[a], scale[b])):
            links.neighbours[a].append(b)
            links.neighbours[b].append(a)
            if not closes:
                made = one.joined(other, a, b, gap)
                of.update(dict.fromkeys(made.ends, made))
