"""Which stretches of an outline are lines, arcs and free-form runs: the shortest description."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.engines.drawn.observed import Observed
    from shapespline.typing import FloatArray, IntArray

LINE, ARC, FREE = 0, 1, 2
# Nats per parameter; smooth joints turn by less than this, radians (DRA-01).
PRICE, SMOOTH = 4.0, 0.14
# A free-form curve counts as so many parameters (DRA-01), among independent points as more: its
# twelve coefficients follow their noise (DRA-15).
FREE_PARAMETERS, FREE_OF_POINTS, ARC_PARAMETERS, LINE_PARAMETERS = 5.0, 6.5, 3.0, 2.0
# Prices of joints in those of a parameter: what is seldom drawn costs, or smooth chains of arcs
# follow anything (DRA-01).
LINE_LINE_SMOOTH, ARC_ARC_SMOOTH, ARC_ARC_CORNER = 2.0, 2.5, 0.5
JOINTS = _kernels.JointPrices(
    line_line_smooth=LINE_LINE_SMOOTH,
    line_arc_smooth=1.0,
    arc_arc_smooth=ARC_ARC_SMOOTH,
    arc_arc_corner=ARC_ARC_CORNER,
    line_free_smooth=1.0,
    arc_free_smooth=2.0,
    free_corner=1.0,
    arc_free_corner=1.5,
)
# Points on either side of a node that the second search tries, and of the first cut.
NEAR, FREED = 3, 40
# Of so few points a node that is one point off is far off: each is tried as the first (DRA-47).
FEW_POINTS = 80
# A piece is at least so long: in lengths that do not count, those of a picture of one bit, whose
# stairs are straight for a while (DRA-14), in steps (DRA-01).
SHORTEST_BLUNTED, SHORTEST_STAIRS, SHORTEST_STEPS = 2.2, 6.0, 2.5
# Nodes of free-form runs are looked for at every so many-th part of the outline, and not closer
# than so many points.
FREE_PARTS, FREE_STEP = 160, 4
# Neighbouring lines that one line explains are one: systematic errors of a picture broke them. So
# many deviations in the mean and at most; an arc whose sagitta is under this many is a line.
MEAN_MISFIT, LARGEST_MISFIT, FLAT = 2.2, 5.0, 2.5
FLAT_CHORD = 15.0
# Steps of a line that a point which is not its own broke off (DRA-44).
FEW = 4
# Radians that data turn at a corner, between chords of so many points.
CORNER, CORNER_STEPS = 0.5, 4


class Segment(NamedTuple):
    """Points ``begin`` to ``end`` of a row, and what they are."""

    begin: int
    end: int
    kind: int


class Segments(NamedTuple):
    """Segments end to end of an open row of points, with their arc lengths and weights.

    A closed outline's row begins and ends with the same point.
    """

    points: FloatArray
    stations: FloatArray
    weights: FloatArray
    first: int
    found: tuple[Segment, ...]

    def n_parameters(self, long: float) -> float:
        """Numbers that tell the segments, joints aside; free-form runs take more the longer.

        A line counts as an arc does: what is taken for less exact must not save by straightness.
        """
        found, length = 0.0, 0.0
        for k, (i, j, kind) in enumerate(self.found):
            if kind != FREE:
                found += ARC_PARAMETERS
                continue
            length += float(self.stations[j] - self.stations[i])
            if k + 1 == len(self.found) or self.found[k + 1].kind != FREE:
                found += FREE_PARAMETERS * max(1.0, length / long)
                length = 0.0
        return found

    def turned(self, k: int) -> Segments:
        """Those of a closed outline, beginning with segment k."""
        if k == 0:
            return self
        found = self.found[k:] + self.found[:k]
        return self._replace(found=found).cut_at([s.begin for s in found])

    def cut_at(self, begins: Sequence[int]) -> Segments:
        """Those of a closed outline, each beginning at another point."""
        cut, n = begins[0], len(self.points) - 1
        order = (np.arange(n + 1) + cut) % n
        ends = [(begin - cut) % n for begin in begins] + [n]
        found = tuple(
            Segment(i, j, s.kind) for i, j, s in zip(ends, ends[1:], self.found, strict=False)
        )
        return _row(self.points[order], self.weights[order], (self.first + cut) % n, found)


class Prices(NamedTuple):
    """Nats per parameter, and unit vectors along which a line takes its offset alone."""

    parameter: float = PRICE
    directions: FloatArray = np.empty((0, 2))


PRICES = Prices()


def segmented(
    seen: Observed, known: Segments | None = None, *, prices: Prices = PRICES
) -> Segments:
    """The segments of an outline; those of a closed one with nodes near a known row's (DRA-27)."""
    if not seen.closed:
        return _merged(_solved(seen, 0, prices=prices)[0], seen)
    if seen.told_arcs:
        return _between(seen, seen.told_arcs, prices)
    n = len(seen.points)
    if known is not None and len(known.found) > 1:
        start = known.first
        about = [segment.begin for segment in known.found[1:]]
        best, cost = _solved(seen, start, about, _near(about, n), prices=prices)
    else:
        start = sharpest(seen.points)
        best, cost = _solved(seen, start, prices=prices)
    # A second cut, at a node far from the first, frees the first one. Nodes stay where they are but
    # for some points, about the first one many.
    nodes = [segment.begin for segment in best.found[1:]]
    if nodes:
        far = min(nodes, key=lambda at: abs(at - n / 2))
        begin = (start + far) % n
        about = [(at - far) % n for at in nodes]
        near = np.concatenate([_near(about, n), (n - far) % n + np.arange(-FREED, FREED + 1)])
        near = near[(near > 0) & (near < n)]
        again, other = _solved(seen, begin, about, near, prices=prices)
        if other <= cost * (1 + 1e-12):
            best, cost = again, other
    if not seen.pixel and n <= FEW_POINTS:
        best = _cut_anew(seen, best, cost, prices)
    best = _merged(best, seen)
    whole = next((k for k, s in enumerate(best.found) if s.kind != FREE), 0)
    return best.turned(whole)


def _cut_anew(seen: Observed, best: Segments, cost: float, prices: Prices) -> Segments:
    """Segments of a closed outline that begins at any of their nodes, while they cost less.

    Only lines and arcs alone: where runs are left there are others that cost as little.
    """
    known, n = best, len(seen.points)
    tried: set[int] = set()
    while untried := {(best.first + s.begin) % n for s in best.found} - tried:
        at = min(untried)
        tried.add(at)
        again, other = _solved(seen, at, prices=prices)
        if other < cost * (1 - 1e-12):
            best, cost = again, other
    return known if any(segment.kind == FREE for segment in best.found) else best


def _between(seen: Observed, told: Sequence[tuple[int, int]], prices: Prices) -> Segments:
    """Arcs that points tell exactly, and the segments of what lies between them."""
    start, n = told[0][0], len(seen.points)
    points = np.roll(seen.points, -start, axis=0)
    points = np.concatenate([points, points[:1]])
    found: list[Segment] = []
    begins = [*(i for i, _ in told[1:]), told[0][0] + n]
    for (i, j), after in zip(told, begins, strict=True):
        at, after = (j - start, (after - start) if after >= start else after - start + n)
        found.append(Segment((i - start) % n, at, ARC))
        if after > at:
            part = seen.part(points[at : after + 1])
            row = _merged(_solved(part, 0, prices=prices)[0], part)
            found += [Segment(at + s.begin, at + s.end, s.kind) for s in row.found]
    stations = _along(np.hypot(*np.diff(points, axis=0).T))
    return Segments(points, stations, _weights(seen, stations, start), start, tuple(found))


def _near(nodes: Sequence[int], n: int) -> IntArray:
    """Some points of a row of n + 1 and their neighbours, without its ends."""
    near = np.add.outer(nodes, np.arange(-NEAR, NEAR + 1)).ravel()
    return near[(near > 0) & (near < n)]


def sharpest(points: FloatArray) -> int:
    """The point with the largest turn between chords of a sixtieth of a closed outline."""
    k, n = max(2, len(points) // 60), len(points)
    around = np.concatenate([points[-k:], points, points[:k]])
    a, b = points - around[:n], around[2 * k :] - points
    turn = np.abs(np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1)))
    return int(np.argmax(turn))


def _row(
    points: FloatArray, weights: FloatArray, first: int, found: tuple[Segment, ...]
) -> Segments:
    stations = _along(np.hypot(*np.diff(points, axis=0).T))
    return Segments(points, stations, weights, first, found)


def _along(steps: FloatArray) -> FloatArray:
    """Arc lengths of a row of points so far apart."""
    stations = np.zeros(len(steps) + 1)
    np.cumsum(steps, out=stations[1:])
    return stations


def longest_gap(seen: Observed) -> float:
    """The longest step beside which a corner may lie between two points.

    A longer one is an edge whose ends alone are given, but a gap among noisy points.
    """
    return np.inf if seen.noisy else SHORTEST_STEPS * seen.step


def _solved(
    seen: Observed,
    start: int,
    candidates: Sequence[int] = (),
    nodes: IntArray | None = None,
    *,
    prices: Prices,
) -> tuple[Segments, float]:
    """Segments of the row that begins at a point, and what they cost."""
    points = np.concatenate([seen.points[start:], seen.points[: start + seen.closed]])
    stations = _along(np.concatenate([seen.steps[start:], seen.steps[:start]]))
    weights = _weights(seen, stations, start)
    middle, size = seen.box
    shortest = SHORTEST_STAIRS if seen.one_bit else SHORTEST_BLUNTED
    shortest = max(shortest * seen.skip, SHORTEST_STEPS * seen.step)
    parts, cost = _kernels.drawn_pieces(
        (points - middle) / size,
        stations / size,
        weights,
        np.array(candidates, dtype=np.int64),
        np.empty(0, dtype=np.int64) if nodes is None else nodes,
        prices.directions,
        _kernels.SegmentationSettings(
            deviation=seen.deviation / size,
            lengths=_kernels.NodeLengths(
                skip=seen.skip / size, shortest=shortest / size, gap=longest_gap(seen) / size
            ),
            price=prices.parameter,
            free_parameters=FREE_PARAMETERS if seen.pixel else FREE_OF_POINTS,
            smooth_turn=float(np.tan(SMOOTH)),
            stride=max(FREE_STEP, round(len(points) / FREE_PARTS)),
            joints=JOINTS,
        ),
    )
    found = tuple(map(Segment._make, parts))
    return Segments(points, stations, weights, start, found), cost


def _weights(seen: Observed, stations: FloatArray, start: int) -> FloatArray:
    """What points of a row count; those of a picture one for each pixel, or for more of them."""
    weights = np.ones(len(stations))
    if seen.pixel:
        weights[1:-1] = (stations[2:] - stations[:-2]) / 2.0
        weights[[0, -1]] = stations[1] - stations[0], stations[-1] - stations[-2]
        weights = np.minimum(weights / seen.pixel, 1.0)
    elif seen.precisions is not None:
        weights = np.take(seen.precisions, start + np.arange(len(stations)), mode="wrap")
    return weights / seen.apart


def _merged(row: Segments, seen: Observed) -> Segments:
    """Arcs too flat to tell as lines; lines that one line explains as one.

    Of measured points only those beside such an arc, as independent errors break no line, and those
    of a few points beside a free-form run, as the one in the corner may be that's (DRA-44).
    """
    sigma, points = seen.deviation, row.points
    flat = [s.kind == ARC and _is_flat(points, s, seen) for s in row.found]
    found = [
        s._replace(kind=LINE) if is_flat else s for s, is_flat in zip(row.found, flat, strict=True)
    ]
    k = 0
    while k + 1 < len(found):
        a, b = found[k], found[k + 1]
        broken = seen.pixel or flat[k] or flat[k + 1]
        for short, m in ((a, k - 1), (b, k + 2)):
            beside = found[m % len(found)] if seen.closed or 0 <= m < len(found) else short
            broken = broken or (short.end - short.begin <= FEW and beside.kind == FREE)
        inner = points[a.begin + 2 : b.end - 1]
        if a.kind == b.kind == LINE and broken and _on_one_line(inner, sigma):
            found[k : k + 2] = [Segment(a.begin, b.end, LINE)]
            flat[k : k + 2] = [True]
            k = max(k - 1, 0)
        else:
            k += 1
    return row._replace(found=tuple(found))


def supported(row: Segments, closed: bool) -> Segments:
    """The row with elements that nothing but their own fit speaks for as free-form.

    A stretch of any smooth curve is a line or an arc for a while. One was drawn if it meets
    another element or ends in a corner; an arc between free-form curves is never told.
    """
    found = list(row.found)
    n = len(found)
    if n == 1:  # all of it
        return row
    for k, segment in enumerate(row.found):
        about = [(k - 1) % n, (k + 1) % n] if closed else [k - 1, k + 1]
        beside = [row.found[m] for m in about if 0 <= m < n and m != k]
        if segment.kind == FREE or any(other.kind != FREE for other in beside):
            continue
        corners = [is_corner(row, at, closed) for at in (segment.begin, segment.end)]
        if segment.kind == ARC or not all(corners):
            found[k] = segment._replace(kind=FREE)
    row = row._replace(found=tuple(found))
    whole = next((k for k, s in enumerate(found) if s.kind != FREE), 0)
    return row.turned(whole) if closed else row


def is_corner(row: Segments, at: int, closed: bool) -> bool:
    """Whether the data turn sharply at a point, or end there."""
    points, n = row.points, len(row.points)
    if not closed and at in (0, n - 1):
        return True
    size = n - 1 if closed else n
    before, after = at - CORNER_STEPS, at + CORNER_STEPS
    if not closed:
        before, after = max(before, 0), min(after, n - 1)
    a = points[at % size] - points[before % size]
    b = points[after % size] - points[at % size]
    return abs(float(np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b))) > CORNER


def _is_flat(points: FloatArray, arc: Segment, seen: Observed) -> bool:
    """Whether the sagitta of an arc is lost in the noise."""
    i, j, _ = arc
    if j - i > 12:
        i, j = i + 3, j - 3
    size = float(np.hypot(*(points[j] - points[i])))
    # Of the circle through all points, as noise moves three of them by as much.
    radius = _kernels.circle_through(points[i : j + 1], np.ones(j + 1 - i))[2]
    sagitta = size**2 / (4.0 * (radius + max(radius**2 - 0.25 * size**2, 0.0) ** 0.5))
    short = min(1.0, size / (FLAT_CHORD * FLAT)) if seen.pixel else 1.0
    return sagitta < FLAT * seen.deviation * short


def off_line(points: FloatArray) -> FloatArray:
    """Signed distances of points from the line through them."""
    direction, offset = _kernels.line_through(points, np.ones(len(points)))
    return np.cos(direction) * points[:, 1] - np.sin(direction) * points[:, 0] - offset


def _on_one_line(points: FloatArray, sigma: float) -> bool:
    if len(points) < 4:
        return False
    across = np.abs(off_line(points))
    mean = (float(across @ across) / len(across)) ** 0.5
    return mean < MEAN_MISFIT * sigma and float(across.max()) < LARGEST_MISFIT * sigma
