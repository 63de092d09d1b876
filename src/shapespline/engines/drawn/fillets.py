"""Fillets of noisy points: what turns between two edges as one arc that touches both.

A chamfer, an arc with a short line beside it or a bare corner may fit nearly as well, and a price
for each smooth joint lets them win; but a fillet is told by its radius alone (DRA-24).
"""

from __future__ import annotations

from functools import cache
from itertools import permutations
from math import atan2, cos, inf, tan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.drawn.ends import data_length, off_by
from shapespline.engines.drawn.joints import cos_sin, meeting
from shapespline.engines.drawn.segments import ARC, FREE_OF_POINTS, LINE, PRICE, SMOOTH, Segment

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from shapespline.engines.drawn.joints import Place
    from shapespline.engines.drawn.model import Model
    from shapespline.engines.drawn.segments import Segments
    from shapespline.typing import FloatArray

# A fillet turns by no more, radians, and stands for so many shorter elements (DRA-24).
LARGEST_TURN, MOST = 2.4, 3
# Radii that are tried: in parts of the one that the middle of the data tells, and by the part of
# half an edge that they take where there is a bare corner; then these parts of it (DRA-24).
RADII, CUTS = np.geomspace(0.5, 2.0, 17), np.geomspace(0.05, 1.0, 17)
FINER = np.linspace(0.85, 1.15, 13)
# Points that an edge keeps, and that an arc has (DRA-24); without a tolerance, where arcs that were
# found are tried as fillets, too, which short edges lie between (DRA-37).
FEWEST, FEWEST_ESTIMATED = 5, 3
# A fillet is tried alone if it leaves so many nats less than what lies there (DRA-38).
LIKELY = 1.0
# Radii that differ by a smaller part are one, but for rounding.
ALIKE = 1e-6
# An arc between two edges.
FILLETED = [LINE, ARC, LINE]


class Fillet(NamedTuple):
    """An arc instead of the segments between two edges, from a point of the row to another.

    ``is_told`` if it leaves less than what lies there now, ``is_possible`` if it leaves anything;
    ``is_likely`` if it would leave less were its radius that of others, which costs nothing.
    """

    before: int
    inner: tuple[int, ...]
    after: int
    begin: int
    end: int
    is_told: bool
    is_possible: bool
    is_likely: bool


def rows_with_fillets(model: Model, *, estimating: bool) -> Iterator[Segments]:
    """Rows with fillets: where the points tell them, and all alike if that is another one.

    ``estimating`` without a tolerance.
    """
    fewest = FEWEST_ESTIMATED if estimating else FEWEST
    known: dict[tuple[int, ...], Fillet | None] = {}

    def best(a: int, inner: tuple[int, ...], b: int) -> Fillet | None:
        # An arc that takes points of its neighbours touches none.
        of_arc = [model.kind(k) for k in inner] == [ARC]
        if not all(k in model.at for k in inner) or (of_arc and not estimating):
            return None
        key = a, *inner, b
        if key not in known:
            known[key] = _best_between(model, a, inner, b, fewest)
        return known[key]

    told = _with_fillets(model, best, fewest, lambda one: one.is_told)
    if told is None and not any(one is not None and one.is_possible for one in known.values()):
        return  # all were looked at
    # For all shorter elements, though some are told by these as well.
    alike = _with_fillets(
        model, best, fewest, lambda one: one.is_possible if one.inner else one.is_told
    )
    if told is not None:
        yield told
    if alike is not None and (told is None or alike.found != told.found):
        yield alike


def rows_with_likely_fillets(model: Model) -> Iterator[Segments]:
    """Rows with a single fillet each, wherever one is likely, and one with all of these."""

    @cache
    def best(a: int, inner: tuple[int, ...], b: int) -> Fillet | None:
        if [model.kind(k) for k in inner] == [ARC]:
            return None
        return _best_between(model, a, inner, b, FEWEST_ESTIMATED)

    lines = {k for k in model.at if model.kind(k) == LINE}
    for k in sorted(lines):
        for m in range(MOST + 1):
            between = _between(model, k, m)
            if between is None or between[1] not in lines:
                continue
            found = best(k, *between)
            if found is not None and found.is_likely:
                row = _row_with(model, {k: found}, FEWEST_ESTIMATED)
                if row is not None:
                    yield row
    # One alone may be told by none of the others: equal radii are known by two.
    every = _with_fillets(model, best, FEWEST_ESTIMATED, lambda one: one.is_likely)
    if every is not None:
        yield every


def _best_between(
    model: Model, a: int, inner: tuple[int, ...], b: int, fewest: int
) -> Fillet | None:
    """The best fillet between two edges, if what lies there is shorter and turns so."""
    lengths = model.lengths
    shorter = min(lengths[a], lengths[b])
    if any(lengths[k] >= shorter for k in inner):
        return None
    turn = _Turn.of(model, a, inner, b, fewest=fewest)
    return None if turn is None else turn.best()


def rows_with_other_radii(model: Model) -> Iterator[Segments]:
    """Rows with one fillet, or all that are equal, of the radius of others."""
    turns: dict[int, tuple[_Turn, float]] = {}
    for k in model.at:
        between = _between(model, k, 1)
        if between is None or not {k, between[0][0], between[1]} <= model.at.keys():
            continue
        kinds = [model.kind(one) for one in (k, *between[0], between[1])]
        turn = _Turn.of(model, k, *between, fewest=FEWEST_ESTIMATED) if kinds == FILLETED else None
        if turn is not None:
            turns[k] = turn, float(model.x[model.at[between[0][0]] + 2])
    radii: list[float] = []
    for _, radius in turns.values():
        if all(abs(radius - other) > ALIKE * other for other in radii):
            radii.append(radius)
    for radius, other in permutations(radii, 2):
        alike = [k for k, (_, own) in turns.items() if abs(own - radius) <= ALIKE * radius]
        fillets = {k: turns[k][0].of_radius(other) for k in alike}
        likely = {k: one for k, one in fillets.items() if one.is_likely}
        tried = [{k: one} for k, one in likely.items()]
        for some in [*tried, likely] if len(likely) > 1 else tried:
            row = _row_with(model, some, FEWEST_ESTIMATED)
            if row is not None:
                yield row


def _with_fillets(
    model: Model,
    best: Callable[[int, tuple[int, ...], int], Fillet | None],
    fewest: int,
    is_taken: Callable[[Fillet], bool],
) -> Segments | None:
    """The row with all fillets that are taken, those of most segments first; None for none."""
    fillets: dict[int, Fillet] = {}
    edges: set[int] = set()
    gone: set[int] = set()
    lines = {k for k in model.at if model.kind(k) == LINE}
    for k in sorted(lines):
        for m in range(MOST, -1, -1):
            between = _between(model, k, m)
            if between is None or between[1] not in lines:
                continue
            inner, after = between
            if not gone.isdisjoint((k, after)) or not (edges | gone).isdisjoint(inner):
                continue
            found = best(k, inner, after)
            if found is None:
                continue
            if is_taken(found):
                fillets[k] = found
                edges |= {k, after}
                gone |= set(inner)
                break
    return _row_with(model, fillets, fewest) if fillets else None


def _between(model: Model, k: int, m: int) -> tuple[tuple[int, ...], int] | None:
    """The m segments behind one, and the one after these; None if there are too few."""
    n = len(model.row.found)
    if m > n - 2 or (not model.seen.closed and k + m + 1 >= n):
        return None
    return tuple((k + i) % n for i in range(1, m + 1)), (k + m + 1) % n


def _row_with(model: Model, fillets: dict[int, Fillet], fewest: int) -> Segments | None:
    """The row with fillets, by the edge before each; None if they leave too little of an edge."""
    row, n, closed = model.row, len(model.row.found), model.seen.closed
    gone = {k for one in fillets.values() for k in one.inner}
    moved = {one.after: one.end for one in fillets.values()}
    begins: list[int] = []
    kinds: list[int] = []
    for k in (k for k in range(n) if k not in gone):
        begins.append(moved.get(k, row.found[k].begin))
        kinds.append(row.found[k].kind)
        if k in fillets:
            begins.append(fillets[k].begin)
            kinds.append(ARC)
    last = row.found[-1].end
    parts = zip(begins, [*begins[1:], last], kinds, strict=True)
    row = row._replace(found=tuple(Segment(*part) for part in parts))
    if closed:
        row = row.cut_at([begin % last for begin in begins])
    # Two fillets may take all of the edge between them.
    return row if all(j - i >= fewest for i, j, _ in row.found) else None


class _Turn(NamedTuple):
    """What turns between two edges, of which each keeps ``fewest`` points.

    ``points`` of both edges and between them are those of the row from ``first`` on. Edges meet in
    ``corner``, ``half`` is half of the angle between them, radians, ``inward`` points to the centre
    of a fillet; ``before`` and ``after`` are the points' stations on either edge from there.
    ``largest`` is the radius that the points tell, or half of an edge allows where nothing lies
    between. ``off`` are squares of distances from both edges, ``left`` those of what lies there now
    and its price.
    """

    model: Model
    edges: tuple[int, int]
    inner: tuple[int, ...]
    fewest: int
    first: int
    points: FloatArray
    corner: FloatArray
    inward: FloatArray
    half: float
    before: FloatArray
    after: FloatArray
    largest: float
    off: tuple[FloatArray, FloatArray]
    left: float

    @classmethod
    def of(
        cls, model: Model, a: int, inner: tuple[int, ...], b: int, *, fewest: int
    ) -> _Turn | None:
        """Between lines a and b; None if what lies there does not turn as a fillet does."""
        if a == b:
            return None
        places = [cos_sin(model.unknowns(k)[0]) for k in (a, b)]
        turn = _turn(*places)
        if not SMOOTH < abs(turn) < LARGEST_TURN:
            return None
        if any(_way(model, k, places[0]) * turn < -SMOOTH for k in inner if k in model.at):
            return None
        along_a, along_b = (np.array(place) for place in places)
        row, last = model.row, len(model.row.points) - 1
        found = row.found
        i = found[a].end
        j = i + sum(found[k].end - found[k].begin for k in inner)
        first = i - (found[a].end - found[a].begin) + fewest
        index = np.arange(first, j + found[b].end - found[b].begin - fewest + 1)
        points = row.points[index % last] if model.seen.closed else row.points[index]
        middle = (i + j) // 2 - first
        if not fewest <= middle <= len(points) - fewest:
            return None
        apex = points[middle - 1 : middle + 2].mean(axis=0)
        corner = meeting(model, a, b, apex)
        inward = np.array([-(along_a + along_b)[1], (along_a + along_b)[0]]) * np.sign(turn)
        inward /= np.hypot(*inward)
        half, depth = 0.5 * abs(turn), float((apex - corner) @ inward)
        if depth <= 0.0:
            return None
        shorter = min(data_length(model, a), data_length(model, b))
        largest = depth / (1.0 / cos(half) - 1.0) if inner else 0.5 * shorter / tan(half)
        off = off_by(model, a, points) ** 2, off_by(model, b, points) ** 2
        # Of what lies there now a fillet saves all numbers but one; in a bare corner it takes two,
        # since any of some corners may be blunted by chance.
        squares, numbers, at = _between_edges(model, inner, points, i - first)
        left = squares + float(off[0][: i - first].sum() + off[1][at:].sum())
        left += _nat(model) * PRICE * (numbers - (1.0 if inner else 2.0))
        before = (points[:middle] - corner) @ along_a
        after = (points[middle:] - corner) @ along_b
        place = corner, inward, half, before, after
        return cls(model, (a, b), inner, fewest, first, points, *place, largest, off, left)

    def best(self) -> Fillet:
        """The fillet that leaves least."""
        radii = self.largest * (RADII if self.inner else CUTS)
        best = min(radii.tolist(), key=lambda radius: self._left_by(radius)[0])
        return self._fillet(*min(self._left_by(radius) for radius in (best * FINER).tolist()))

    def of_radius(self, radius: float) -> Fillet:
        """The fillet of a radius, data units."""
        return self._fillet(*self._left_by(radius))

    def _fillet(self, left: float, p: int, q: int) -> Fillet:
        """The one that leaves so much and goes from one of the points to another."""
        (a, b), first = self.edges, self.first
        # Were its radius another's, its own number would cost nothing.
        free = PRICE * (1.0 if self.inner else 2.0) - LIKELY
        told, likely = left < self.left, left < self.left + _nat(self.model) * free
        return Fillet(a, self.inner, b, first + p, first + q, told, left < inf, likely)

    def _left_by(self, radius: float) -> tuple[float, int, int]:
        """Squares that a fillet leaves, and where it begins and ends."""
        points, half = self.points, self.half
        outside = np.flatnonzero(self.before <= -radius * tan(half))
        beyond = np.flatnonzero(self.after >= radius * tan(half))
        if not len(outside) or not len(beyond):
            return inf, 0, 0
        p, q = int(outside[-1]), len(self.before) + int(beyond[0])
        if p == 0 or q == len(points) - 1 or q - p < self.fewest:
            return inf, 0, 0
        centre = self.corner + self.inward * radius / cos(half)
        off = (np.hypot(*(points[p : q + 1] - centre).T) - radius) ** 2
        edges = self.off[0][:p].sum() + self.off[1][q + 1 :].sum()
        return float(edges + off.sum()), p, q


def _nat(model: Model) -> float:
    """Squares that are worth a nat."""
    return 2.0 * model.seen.deviation**2


def _between_edges(
    model: Model, inner: tuple[int, ...], points: FloatArray, at: int
) -> tuple[float, float, int]:
    """Squares that segments leave whose points begin at one, their numbers, where they end.

    Points of free-form runs are as far off as others.
    """
    squares, numbers = 0.0, 0.0
    for k in inner:
        upto = at + model.row.found[k].end - model.row.found[k].begin
        if k in model.at:
            squares += float((off_by(model, k, points[at:upto]) ** 2).sum())
            numbers += 2 if model.kind(k) == LINE else 3
        else:
            squares += (upto - at) * model.seen.deviation**2
            numbers += FREE_OF_POINTS
        at = upto
    return squares, numbers, at


def _turn(u: Place, v: Place) -> float:
    """Angle from a direction to another."""
    return atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])


def _way(model: Model, k: int, along: Place) -> float:
    """By what an element turns from a direction: only the sign tells for an arc."""
    if model.kind(k) == ARC:
        return model.ways[k]
    return _turn(along, cos_sin(model.unknowns(k)[0]))
