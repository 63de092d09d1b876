"""What the outlines of a drawing repeat: equal radii, common centres, centres in rows and on rings.

An outline is told by its centre and, if it is a circle, its radius. Equations are tested as those
between elements are (DRA-04): by their misfit in standard errors, and by how much of a surprise
they are. Centres that share a coordinate get the weighted mean of it, coordinates at equal steps
the weighted straight line, rings the weighted similarity: the least squares under the equations.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot, log, pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.drawn.joints import unit_of
from shapespline.engines.drawn.regularities import EACH_OF_SEVERAL, LARGEST, LEAST_SURPRISE
from shapespline.values import Regularity

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from shapespline.typing import FloatArray

# Angles of a ring's centres may be off by this part of a step; those of a row by this (DRA-12).
RING, ROW = 0.1, 0.1


class Feature(NamedTuple):
    """An outline: its centre, its radius (0 for no circle), and how well both are known.

    Variances are those of one coordinate and of the radius. Outlines of one ``copy`` are equal but
    for their places; -1 for none.
    """

    x: float
    y: float
    radius: float
    centre_variance: float
    radius_variance: float
    copy: int = -1


def repeated_outlines(
    features: Sequence[Feature], extent: float, allowed: Collection[str], angle: float = 0.0
) -> tuple[FloatArray, list[Regularity]]:
    """Centres and radii, shape (n, 3), under what holds, and what that is.

    Parameters
    ----------
    features : sequence of Feature
    extent : float
        Of the drawing: the range that its lengths could have.
    allowed : collection of str
        Names of what may be taken.
    angle : float
        Direction of the drawing's edges, radians: rows are sought along and across it.

    Returns
    -------
    values : ndarray, shape (n, 3)
    found : list of Regularity
        Their pieces are places among the features.

    Examples
    --------
    >>> known = (1e-4, 1e-4)
    >>> holes = [Feature(x, y, r, *known) for x, y, r in [(0, 0.01, 3), (10.02, 0, 3.01)]]
    >>> values, found = repeated_outlines(holes, 100.0, ["equal-radius", "axis-parallel"])
    >>> values.round(3).tolist()
    [[0.0, 0.005, 3.005], [10.02, 0.005, 3.005]]
    >>> [one.name for one in found]
    ['equal-radius', 'axis-parallel']
    """
    search = Across(tuple(features), extent, frozenset(allowed), unit_of(angle))
    search.radii()
    search.centres()
    search.rings(lambda count: count != 4)
    search.coordinates()
    search.rings(lambda count: count == 4)
    search.rows()
    return search.values, search.found


@dataclass(eq=False)
class _Mean:
    """Members, the sum of their weights, their weighted mean."""

    members: list[int]
    weight: float
    place: list[float]

    def away_sq(self, place: Sequence[float]) -> float:
        """Squared distance of a place from the mean."""
        return sum((a - b) ** 2 for a, b in zip(place, self.place, strict=True))

    def take(self, k: int, place: Sequence[float], weight: float) -> None:
        """One member more."""
        self.members.append(k)
        self.weight += weight
        share = weight / self.weight
        self.place = [a + share * (b - a) for a, b in zip(self.place, place, strict=True)]


@dataclass(eq=False)
class Across:
    """The estimate as it is taught by one regularity after the other.

    ``node[k]`` is the centre of feature k among ``at``, with ``variance`` of a coordinate:
    concentric ones share it. ``free`` are the nodes that no ring or row has placed.
    """

    features: tuple[Feature, ...]
    extent: float
    allowed: frozenset[str]
    along: FloatArray
    found: list[Regularity] = field(default_factory=list)

    def __post_init__(self) -> None:
        n = len(self.features)
        self.values = np.array([one[:3] for one in self.features]).reshape(n, 3)
        self.node = np.arange(n)
        self.at = self.values[:, :2].copy()
        self.variance = np.array([one.centre_variance for one in self.features])
        self.free = set(range(n))
        copies = sorted({one.copy for one in self.features} - {-1})
        self.alike = [[k for k in range(n) if self.features[k].copy == c] for c in copies]

    def radii(self) -> None:
        """Equal ones; those of equal circles are alike whatever their centres are."""
        if "equal-radius" not in self.allowed:
            return
        own = [k for k, one in enumerate(self.features) if one.radius > 0]
        variances = np.array([one.radius_variance for one in self.features])
        for group in self._clusters(own, self.values[:, 2:], variances, 0.5 * self.extent):
            mean = float(np.average(self.values[group, 2], weights=1 / variances[group]))
            off = float(np.abs(self.values[group, 2] - mean).max())
            self.values[group, 2] = mean
            self.alike.append(group)
            self.found.append(Regularity("equal-radius", tuple(sorted(group)), off))

    def centres(self) -> None:
        """Common ones."""
        if "concentric" not in self.allowed:
            return
        every = list(range(len(self.features)))
        for group in self._clusters(every, self.at, self.variance, self.extent):
            mean = np.average(self.at[group], axis=0, weights=1 / self.variance[group])
            off = float(np.hypot(*(self.at[group] - mean).T).max())
            self.found.append(Regularity("concentric", tuple(sorted(group)), off))
            self._merge(group, mean)

    def rings(self, asked: Callable[[int], bool]) -> None:
        """Alike ones at equal steps on a circle, about the centre of another where there is one."""
        if "rotation" not in self.allowed:
            return
        for group in self.alike:
            nodes = self._nodes(group)
            if len(nodes) < 3 or not asked(len(nodes)) or not self.free.issuperset(nodes):
                continue
            ring = self._ring(nodes)
            if ring is None:
                continue
            row, places, off = ring
            self._place(row, places)
            self.found.append(Regularity("rotation", tuple(sorted(group)), off, len(row)))

    def coordinates(self) -> None:
        """Centres in rows along and across the edges, and such rows at equal steps."""
        name = "axis-parallel" if 0.0 in self.along else "parallel"
        if name not in self.allowed:
            return
        level = name == "axis-parallel"
        places = self.at if level else _turned(self.at, self.along * [1.0, -1.0])
        free, told = sorted(self.free), set()
        for axis in (0, 1):
            own = places[:, axis]
            groups = self._clusters(free, own[:, None], self.variance, self.extent)
            for group in groups:
                mean = float(np.average(own[group], weights=1 / self.variance[group]))
                off = float(np.abs(own[group] - mean).max())
                own[group] = mean
                told.update(group)
                self.found.append(Regularity(name, self._features(group), off))
            told.update(self._steps(own, groups))
        self.at = places if level else _turned(places, self.along)
        self.free -= told
        self._tell()

    def rows(self) -> None:
        """Alike ones at equal steps on a line of any direction."""
        if "equal-spacing" not in self.allowed:
            return
        for group in self.alike:
            nodes = self._nodes(group)
            if len(nodes) < 3 or not self.free.issuperset(nodes):
                continue
            along = np.linalg.svd(self.at[nodes] - self.at[nodes].mean(axis=0))[2][0]
            row = sorted(nodes, key=lambda k: float(self.at[k] @ along))
            line = self._line(self.at[row], self.variance[row])
            if line is None:
                continue
            self._place(row, line[0])
            self.found.append(Regularity("equal-spacing", tuple(sorted(group)), line[1]))

    def _steps(self, own: FloatArray, groups: Sequence[Sequence[int]]) -> set[int]:
        """Put coordinates at equal steps, of all centres or of those that are alike; which."""
        placed: set[int] = set()
        if "equal-spacing" not in self.allowed:
            return placed
        shared = {k: group for group in groups for k in group}
        for nodes in (sorted(self.free), *(self._nodes(group) for group in self.alike)):
            heads = {shared.get(k, [k])[0] for k in nodes}
            if not self.free.issuperset(nodes) or placed & heads or len(heads) < 3:
                continue
            row = sorted(heads, key=lambda k: float(own[k]))
            members = [shared.get(k, [k]) for k in row]
            variances = np.array([1 / float((1 / self.variance[one]).sum()) for one in members])
            line = self._line(own[row, None], variances)
            if line is None:
                continue
            for one, value in zip(members, line[0][:, 0].tolist(), strict=True):
                own[one] = value
                placed.update(one)
            self.found.append(Regularity("equal-spacing", self._features(nodes), line[1]))
        return placed

    def _ring(self, nodes: Sequence[int]) -> tuple[list[int], FloatArray, float] | None:
        """Nodes by their angles, their places at equal steps, how far they are from them."""
        points, n = self.at[nodes], len(nodes)
        variance = float(self.variance[nodes].max())
        middle, centre = self._centre_of(nodes, variance / n)
        angle = np.arctan2(*(points - middle).T[::-1])
        order = np.argsort(angle)
        row, points, angle = [nodes[k] for k in order], points[order], angle[order]
        steps = np.diff(np.concatenate([angle, [angle[0] + 2 * pi]])) / (2 * pi / n)
        if np.abs(steps - 1).max() > RING:
            return None
        back = np.mean([_turned(points[k] - middle, unit_of(-2 * pi * k / n)) for k in range(n)], 0)
        radius, first = hypot(*back), float(np.arctan2(back[1], back[0]))
        level = round(first / (pi / n)) * (pi / n)
        if abs(first - level) * radius <= (LARGEST * variance / n) ** 0.5:
            first = level
        places = middle + radius * np.array([unit_of(first + 2 * pi * k / n) for k in range(n)])
        off = np.hypot(*(points - places).T)
        if not self._holds(float((off**2).sum()) / variance, np.full(2 * n - 4, variance)):
            return None
        if centre is not None:
            self._place([centre], middle[None])
        return row, places, float(off.max())

    def _centre_of(self, nodes: Sequence[int], variance: float) -> tuple[FloatArray, int | None]:
        """The middle of nodes, that of another that lies there, and which one that is."""
        middle = self.at[nodes].mean(axis=0)
        others = sorted(set(self.node.tolist()) - set(nodes))
        if not others:
            return middle, None
        k = min(others, key=lambda k: hypot(*(self.at[k] - middle)))
        own = float(self.variance[k])
        statistic = float(((self.at[k] - middle) ** 2).sum()) / (own + variance)
        if statistic > EACH_OF_SEVERAL * 2 * LARGEST:
            return middle, None
        if k not in self.free:
            return self.at[k].copy(), None
        return np.average([middle, self.at[k]], axis=0, weights=[1 / variance, 1 / own]), k

    def _line(self, points: FloatArray, variances: FloatArray) -> tuple[FloatArray, float] | None:
        """Points of any dimension at equal steps nearest to some in a row, and how far they are."""
        n, size = points.shape
        if n < 3:
            return None
        system = np.column_stack([np.ones(n), np.arange(n)])
        weights = 1 / np.sqrt(variances)
        solved = np.linalg.lstsq(system * weights[:, None], points * weights[:, None], rcond=None)
        places = system @ solved[0]
        off = points - places
        step = hypot(*solved[0][1].tolist())
        if np.abs(off).max() > ROW * step:
            return None
        statistic = float((off**2 / variances[:, None]).sum())
        equations = np.full((n - 2) * size, float(variances.max()))
        if not self._holds(statistic, equations):
            return None
        return places, float(np.abs(off).max())

    def _holds(self, statistic: float, variances: FloatArray) -> bool:
        """Whether equations of some variances hold, and are a surprise together."""
        n = len(variances)
        if statistic > LARGEST * (1.0 if n == 1 else EACH_OF_SEVERAL * n):
            return False
        surprise = sum(log(self.extent / (2 * pi * v) ** 0.5) for v in variances.tolist())
        return surprise - 0.5 * statistic >= LEAST_SURPRISE

    def _clusters(
        self, own: Sequence[int], values: FloatArray, variances: FloatArray, span: float
    ) -> list[list[int]]:
        """Those of several members whose values are one, each tested against the mean so far."""
        groups: list[_Mean] = []
        n = values.shape[1]
        largest = LARGEST * (1.0 if n == 1 else EACH_OF_SEVERAL * n)
        for k in sorted(own, key=lambda k: float(variances[k])):
            place, weight = values[k].tolist(), 1 / float(variances[k])
            for group in groups:
                variance = 1 / weight + 1 / group.weight
                statistic = group.away_sq(place) / variance
                surprise = n * log(span / (2 * pi * variance) ** 0.5) - 0.5 * statistic
                if statistic <= largest and surprise >= LEAST_SURPRISE:
                    group.take(k, place, weight)
                    break
            else:
                groups.append(_Mean([k], weight, place))
        return [group.members for group in groups if len(group.members) > 1]

    def _nodes(self, group: Sequence[int]) -> list[int]:
        return sorted({int(self.node[k]) for k in group})

    def _features(self, nodes: Sequence[int]) -> tuple[int, ...]:
        return tuple(k for k in range(len(self.features)) if int(self.node[k]) in set(nodes))

    def _merge(self, group: list[int], mean: FloatArray) -> None:
        """Make the centres of a group one node, the first of them."""
        head = group[0]
        variance = 1 / float((1 / self.variance[group]).sum())
        self.node[group] = head
        self.free -= set(group[1:])
        self.at[head], self.variance[head] = mean, variance
        self._tell()

    def _place(self, nodes: Sequence[int], places: FloatArray) -> None:
        """Put nodes where nothing moves them any more."""
        self.at[list(nodes)] = places
        self.free -= set(nodes)
        self._tell()

    def _tell(self) -> None:
        self.values[:, :2] = self.at[self.node]


def _turned(points: FloatArray, unit: FloatArray) -> FloatArray:
    """Points, shape (..., 2), turned by the angle of a unit vector."""
    c, s = unit.tolist()
    return points @ np.array([[c, s], [-s, c]])
