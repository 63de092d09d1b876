"""Where elements end: in nodes, on their last data, or cut off within a tolerance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.joints import cos_sin, direction_at, meeting, onto, turn_at, unit_of
from shapespline.engines.drawn.segments import CORNER, LINE
from shapespline.geometry import distance_from_chords

if TYPE_CHECKING:
    from shapespline.engines.drawn.model import Model
    from shapespline.engines.drawn.segments import Segments
    from shapespline.typing import BoolArray, FloatArray, IntArray

# A free-form run goes on smoothly from an element if its data do, radians.
SMOOTH_END = 0.2
# A corner that is farther from its data than the first part of the tolerance is cut off, so that
# the second part is left, in steps of a part more; data so many points about it are looked at
# (DRA-07, DRA-40).
NEAR_PART, CUT_PART, CUT_STEP, NEIGHBOURS, CUTS = 0.97, 0.93, 0.1, 8, 30
# A corner so many points beyond the node of an element that it lies on ends it (DRA-19).
CORNER_REACH = 3
# An arc that misses a node by more of the outline's extent does so not by rounding.
ROUNDING = 1e-9
# Data that lie on an element are no farther from it than so many deviations.
ON = 3.0


def at_corners(model: Model) -> Segments:
    """The row of a picture's closed outline, elements beside runs going on to the corner there.

    Points beside a node do not count, so it may lie before the corner, which is then the run's.
    """
    row, n = model.row, len(model.row.found)
    if not model.seen.closed or not model.seen.pixel or model.seen.one_bit or n < 2:
        return row
    n_points = len(row.points) - 1
    begins = [segment.begin for segment in row.found]
    for k in range(n):
        m = (k + 1) % n
        if (k in model.at) == (m in model.at):
            continue
        own, way = (k, 1) if k in model.at else (m, -1)
        node, other = row.found[m].begin, row.found[m if own == k else k]
        reach = min(CORNER_REACH, (other.end - other.begin - 1) // 2)  # both of its ends may move
        ahead = (node + way * np.arange(reach + 1)) % n_points
        is_sharp = _turns(row.points[:-1], ahead) > CORNER
        if is_sharp[0] or not is_sharp.any():
            continue
        upto = ahead[1 : is_sharp.argmax() + 1]
        if np.abs(off_by(model, own, row.points[upto])).max() <= ON * model.seen.largest_deviation:
            begins[m] = node + way * len(upto)
    return row if begins == [s.begin for s in row.found] else row.cut_at(begins)


def _turns(points: FloatArray, at: IntArray) -> FloatArray:
    """By how much closed data turn in some of their points, radians."""
    before = points[at] - points[at - 1]
    after = points[(at + 1) % len(points)] - points[at]
    turns = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.abs(np.arctan2(turns, (before * after).sum(axis=1)))


def nodes_of(model: Model) -> dict[int, FloatArray]:
    """Where each segment ends, if it or the next one is an element; -1 for an open beginning."""
    if model.known_nodes is None or model.known_nodes[0] is not model.x:
        model.known_nodes = model.x, _nodes_of(model)
    return model.known_nodes[1]


def _nodes_of(model: Model) -> dict[int, FloatArray]:
    found, n = model.row.found, len(model.row.found)
    points, nodes = model.row.points, {}
    for k in range(n):
        m, at = (k + 1) % n, points[found[k].end]
        if m == 0 and not model.seen.closed:
            m = -1
        if k in model.at and m in model.at and k != m:
            nodes[k] = meeting(model, k, m, at)
        elif k in model.at:
            # Beside a free-form run the last points may be the run's, at an open end they are not.
            nodes[k] = onto(model, k, at if m < 0 else points[last_on(model, k)])
        elif m in model.at:
            nodes[k] = onto(model, m, points[first_on(model, m)])
    if model.ends is not None:
        for k, own, end in zip((-1, n - 1), (0, n - 1), model.ends, strict=True):
            if own in model.at:  # which goes through it but for rounding
                nodes[k] = onto(model, own, end)
    elif not model.seen.closed and 0 in model.at:
        nodes[-1] = onto(model, 0, points[0])
    elif model.seen.closed and n - 1 in nodes:
        nodes[-1] = nodes[n - 1]
    return nodes


def last_on(model: Model, k: int) -> int:
    """The last point of a segment that lies on its element."""
    return model.row.found[k].begin + _last_on(model, _off(model, k))


def first_on(model: Model, k: int) -> int:
    """The first point of a segment that lies on its element."""
    return model.row.found[k].begin + _first_on(model, _off(model, k))


def on_between(model: Model, k: int, tolerance: float) -> tuple[int, int]:
    """First and last point on an element that only its ends miss by more than a tolerance."""
    (i, j, _), off = model.row.found[k], _off(model, k)
    far = off > tolerance
    if not far.any():
        return i, j
    first, last = _first_on(model, off), _last_on(model, off)
    if far[first : last + 1].any():
        return i, j
    return i + first if far[:first].any() else i, i + last if far[last:].any() else j


def _off(model: Model, k: int) -> FloatArray:
    """How far the points of a segment are from its element."""
    i, j, _ = model.row.found[k]
    return np.abs(off_by(model, k, model.row.points[i : j + 1]))


def _last_on(model: Model, off: FloatArray) -> int:
    """The last of points so far from an element that lies on it."""
    n = len(off) - 1
    return n - int(_lies_on(model, off[max(n // 2, n - NEIGHBOURS) :][::-1]).argmax())


def _first_on(model: Model, off: FloatArray) -> int:
    """The first of them."""
    return int(_lies_on(model, off[: min((len(off) - 1) // 2, NEIGHBOURS) + 1]).argmax())


def _lies_on(model: Model, off: FloatArray) -> BoolArray:
    """Which of points so far from an element are no farther than noise; at least the nearest."""
    return off <= max(ON * model.seen.largest_deviation, float(off.min()))


def off_by(model: Model, k: int, points: FloatArray) -> FloatArray:
    """Signed distances of points from the whole line or circle of an element."""
    own, x, y = model.unknowns(k), points[:, 0], points[:, 1]
    if model.kind(k) == LINE:
        tx, ty = cos_sin(own[0])
        return tx * y - ty * x - own[1]
    return np.hypot(x - own[0], y - own[1]) - own[2]


def misses(model: Model, k: int, *nodes: FloatArray) -> bool:
    """Whether an arc misses nodes that it ends in: its neighbours and its circle may not meet."""
    if model.kind(k) == LINE:
        return False
    return float(np.abs(off_by(model, k, np.stack(nodes))).max()) > ROUNDING * model.extent


def cut_off(
    model: Model, k: int, m: int, node: FloatArray, tolerance: float
) -> tuple[FloatArray, FloatArray]:
    """Where element k ends and m begins: in their node, or beside it where data are blunted."""
    far = away_from_data(model, k, node)
    if far > NEAR_PART * tolerance and model.seen.whole is not None:  # those not looked at, too
        far = min(far, _away_from_whole(model, k, node, model.seen.whole))
    turn = turn_at(model, k, m, node)
    if far <= NEAR_PART * tolerance or turn < SMOOTH_END:
        return node, node
    if not model.seen.skip:  # no picture blunted it: no point happened to lie there
        last, first = model.row.points[last_on(model, k)], model.row.points[first_on(model, m)]
        share = 1.0 - CUT_PART * tolerance / far
        ends = (node + share * (point - node) for point in (last, first))
        return onto(model, k, next(ends)), onto(model, m, next(ends))
    steepness = float(np.sin(0.5 * turn))
    back = (far - CUT_PART * tolerance) / steepness
    for _ in range(CUTS):
        before = onto(model, k, node - back * direction_at(model, k, node))
        after = onto(model, m, node + back * direction_at(model, m, node))
        far = max(away_from_data(model, k, p) for p in (before, after, 0.5 * (before + after)))
        if far <= NEAR_PART * tolerance:
            return before, after
        back += CUT_STEP * tolerance / steepness  # of a cusp the cut goes too far, too
    return node, node


def away_from_data(model: Model, k: int, node: FloatArray) -> float:
    """Distance of the node behind segment k from the data polyline about it."""
    points, at, n = model.row.points, model.row.found[k].end, len(model.row.points)
    first, last = at - NEIGHBOURS, at + NEIGHBOURS + 1
    if model.seen.closed and not 0 <= first < last < n:
        around = points[np.arange(first, last) % (n - 1)]
    else:
        around = points[max(first, 0) : last]
    return distance_from_chords(node, around)


def _away_from_whole(model: Model, k: int, node: FloatArray, whole: FloatArray) -> float:
    """The same of all points, those about the one that is looked at behind segment k."""
    end = model.row.points[model.row.found[k].end]
    nearest = int(((whole - end) ** 2).sum(axis=1).argmin())
    reach = NEIGHBOURS * (len(whole) // len(model.seen.points) + 1)
    index = np.arange(nearest - reach, nearest + reach + 1)
    around = index % len(whole) if model.seen.closed else np.unique(index.clip(0, len(whole) - 1))
    return distance_from_chords(node, whole[around])


def length_between(model: Model, k: int, begin: FloatArray, end: FloatArray) -> float:
    """Signed length of an element from node to node."""
    o = model.at[k]
    if model.kind(k) == LINE:
        return float(unit_of(float(model.x[o])) @ (end - begin))
    return abs(sweep_of(model, k, begin, end)[1]) * float(model.x[o + 2])


def sweep_of(model: Model, k: int, begin: FloatArray, end: FloatArray) -> tuple[float, float]:
    """First angle of an arc and the angle that it turns by."""
    centre = model.x[model.at[k] : model.at[k] + 2]
    first, last = (float(np.arctan2(*(p - centre)[::-1])) for p in (begin, end))
    full = 2 * np.pi
    return first, (last - first) % full if model.ways[k] > 0 else -((first - last) % full)


def length_along(model: Model, k: int) -> float:
    """Length of the data of a segment along its element; noise across it does not count."""
    i, j, kind = model.row.found[k]
    o = model.at[k]
    if kind == LINE:
        return float(unit_of(float(model.x[o])) @ (model.row.points[j] - model.row.points[i]))
    out = model.row.points[i : j + 1] - model.x[o : o + 2]
    turns = np.arctan2(out[:, 1], out[:, 0])
    if np.abs(np.diff(turns)).max() >= np.pi:
        turns = np.unwrap(turns)
    return abs(float(turns[-1] - turns[0])) * float(model.x[o + 2])


def data_length(model: Model, k: int) -> float:
    """Length of the data of a segment."""
    return model.lengths[k]
