"""Fillets of noisy points: what turns between two edges as one arc that touches both.

A chamfer, an arc with a short line beside it or a bare corner may fit nearly as well, and a price
for each smooth joint lets them win; but a fillet is told by its radius alone (DRA-24).
"""

from __future__ import annotations

from functools import cache, partial
from math import atan2, cos, inf, tan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.drawn.ends import data_length, off_by
from shapespline.engines.drawn.joints import meeting, unit_of
from shapespline.engines.drawn.segments import ARC, LINE, PRICE, SMOOTH, Segment

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

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


class Fillet(NamedTuple):
    """An arc instead of the segments between two edges, from a point of the row to another.

    ``is_told`` if it leaves less than what lies there now, ``is_possible`` if it leaves anything.
    """

    before: int
    inner: tuple[int, ...]
    after: int
    begin: int
    end: int
    is_told: bool
    is_possible: bool


def rows_with_fillets(model: Model, *, estimating: bool) -> Iterator[Segments]:
    """Rows with fillets: where the points tell them, and all alike if that is another one.

    ``estimating`` without a tolerance.
    """
    fewest = FEWEST_ESTIMATED if estimating else FEWEST
    best = cache(partial(_fillet, model, fewest=fewest, of_arcs=estimating))
    told = _with_fillets(model, best, fewest, all_alike=False)
    alike = _with_fillets(model, best, fewest, all_alike=True)
    if told is not None:
        yield told
    if alike is not None and (told is None or alike.found != told.found):
        yield alike


def _with_fillets(
    model: Model,
    best: Callable[[int, tuple[int, ...], int], Fillet | None],
    fewest: int,
    *,
    all_alike: bool,
) -> Segments | None:
    """The row with fillets between edges wherever shorter elements or too little lie; or None.

    ``all_alike`` takes them for all shorter elements, though some are told by these as well.
    """
    row, n, closed = model.row, len(model.row.found), model.seen.closed
    fillets: dict[int, Fillet] = {}
    edges: set[int] = set()
    gone: set[int] = set()
    lines = {k for k in model.at if model.kind(k) == LINE}
    for k in sorted(lines):
        for m in range(min(MOST, n - 2), -1, -1):
            inner, after = [(k + i) % n for i in range(1, m + 1)], (k + m + 1) % n
            if after not in lines or (not closed and k + m + 1 >= n):
                continue
            if not gone.isdisjoint((k, after)) or not (edges | gone).isdisjoint(inner):
                continue
            found = best(k, tuple(inner), after)
            if found is None:
                continue
            if found.is_possible if all_alike and m > 0 else found.is_told:
                fillets[k] = found
                edges |= {k, after}
                gone |= set(inner)
                break
    if not fillets:
        return None
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


def _fillet(
    model: Model, a: int, inner: tuple[int, ...], b: int, *, fewest: int, of_arcs: bool
) -> Fillet | None:
    """The best one between two lines, if what lies there turns as it does.

    ``of_arcs`` instead of an arc, too: one that takes points of its neighbours touches none.
    """
    if a == b or not all(k in model.at for k in inner):
        return None
    if not of_arcs and [model.kind(k) for k in inner] == [ARC]:
        return None
    shorter = min(data_length(model, a), data_length(model, b))
    if any(data_length(model, k) >= shorter for k in inner):
        return None
    along_a, along_b = (unit_of(float(model.x[model.at[k]])) for k in (a, b))
    turn = _turn(along_a, along_b)
    ways = [_way(model, k, along_a) for k in inner]
    if not SMOOTH < abs(turn) < LARGEST_TURN or any(way * turn < -SMOOTH for way in ways):
        return None
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
    off_a, off_b = off_by(model, a, points) ** 2, off_by(model, b, points) ** 2
    # What lies there now, of which a fillet saves all numbers but one; in a bare corner it takes
    # two, since any of some corners may be blunted by chance.
    at, least, saved = i - first, 0.0, -1 if inner else -2
    for k in inner:
        upto = at + found[k].end - found[k].begin
        least += float((off_by(model, k, points[at:upto]) ** 2).sum())
        at, saved = upto, saved + (2 if model.kind(k) == LINE else 3)
    least += float(off_a[: i - first].sum() + off_b[at:].sum())
    least += 2.0 * PRICE * saved * model.seen.deviation**2
    before, after = (points[:middle] - corner) @ along_a, (points[middle:] - corner) @ along_b

    def told_by(radius: float) -> tuple[float, int, int]:
        """Squares that a fillet leaves, and where it begins and ends."""
        outside = np.flatnonzero(before <= -radius * tan(half))
        beyond = np.flatnonzero(after >= radius * tan(half))
        if not len(outside) or not len(beyond):
            return inf, 0, 0
        p, q = int(outside[-1]), middle + int(beyond[0])
        if p == 0 or q == len(points) - 1 or q - p < fewest:
            return inf, 0, 0
        centre = corner + inward * radius / cos(half)
        off = (np.hypot(*(points[p : q + 1] - centre).T) - radius) ** 2
        return float(off_a[:p].sum() + off.sum() + off_b[q + 1 :].sum()), p, q

    largest = depth / (1.0 / cos(half) - 1.0) if inner else 0.5 * shorter / tan(half)
    radii = largest * (RADII if inner else CUTS)
    best = min(radii.tolist(), key=lambda radius: told_by(radius)[0])
    left, p, q = min(told_by(radius) for radius in (best * FINER).tolist())
    return Fillet(a, inner, b, first + p, first + q, left < least, left < inf)


def _turn(u: FloatArray, v: FloatArray) -> float:
    """Angle from a direction to another."""
    return atan2(u[0] * v[1] - u[1] * v[0], u @ v)


def _way(model: Model, k: int, along: FloatArray) -> float:
    """By what an element turns from a direction: only the sign tells for an arc."""
    if model.kind(k) == ARC:
        return model.ways[k]
    return _turn(along, unit_of(float(model.x[model.at[k]])))
