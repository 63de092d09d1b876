"""Short arcs of a picture that its segments take for corners or for lines.

Points beside a node do not count, since corners are blunted there: an arc of few pixels may lie
between them, or all that tells it from a line.
"""

from __future__ import annotations

from math import cos, tan
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.ends import away_from_data, data_length, nodes_of
from shapespline.engines.drawn.joints import turn_at
from shapespline.engines.drawn.judgement import SHALLOW, off_shallow
from shapespline.engines.drawn.segments import ARC, LINE, Segment

if TYPE_CHECKING:
    from shapespline.engines.drawn.model import Model
    from shapespline.engines.drawn.segments import Segments

# A line may be an arc if it is at most so many times as long as an arc beside it that it meets at
# such an angle, or misses, or as any fillet where lines meet it so; between lines an arc has at
# least so many points, and either line is so many times as long as what half of the arc takes of
# it, or as the arc (DRA-62, DRA-64).
LONGEST, BREAK, FEWEST, SHORTEST = 1.5, np.radians([3.0, 30.0]), 3, 3.0


def with_missed_arcs(model: Model, *, supposed: bool = False) -> Segments | None:
    """The row with arcs where nodes are no corners; None where they are.

    All chords between long sides that may be fillets are if they are `supposed` to be.
    """
    row, n = model.row, len(model.row.found)
    begins, kinds = ([segment[at] for segment in row.found] for at in (0, 2))
    missed = _missed_nodes(model)
    for k in model.at:
        if model.kind(k) == LINE and _is_arc(model, k, missed, supposed=supposed):
            kinds[k] = ARC
            for node in ((k - 1) % n, k):  # which it mends for its neighbours, too
                missed.pop(node)
    arcs: dict[int, int] = {}
    for k in [k for k, is_off in missed.items() if is_off]:
        m = (k + 1) % n
        fillet = _fillet(model, k, m) if kinds[k] == kinds[m] == LINE else None
        if fillet is not None:
            arcs[k], begins[m] = fillet
    if not arcs and kinds == [segment.kind for segment in row.found]:
        return None
    more = {k: (begin, ARC) for k, begin in arcs.items()}
    return row_with(row, begins, kinds, more, closed=model.seen.closed)


def _missed_nodes(model: Model) -> dict[int, bool]:
    """Nodes where elements meet at an angle as small as if they touched, and which data miss."""
    found, n, nodes = {}, len(model.row.found), nodes_of(model)
    for k in range(n if model.seen.closed else n - 1):
        m = (k + 1) % n
        if k == m or k not in model.at or m not in model.at:
            continue
        turn = turn_at(model, k, m, nodes[k])
        is_off = turn < SHALLOW and off_shallow(model, k, nodes[k], turn) > 1.0
        if is_off or BREAK[0] < turn < BREAK[1]:
            found[k] = is_off
    return found


def _is_arc(model: Model, k: int, missed: dict[int, bool], *, supposed: bool) -> bool:
    """Whether a line between two such nodes may be one: beside an arc, or if data miss both."""
    n, length = len(model.row.found), data_length(model, k)
    before, after = (k - 1) % n, (k + 1) % n
    if before not in missed or k not in missed:
        return False
    arcs = [data_length(model, one) for one in (before, after) if model.kind(one) == ARC]
    if arcs:
        return length <= LONGEST * max(arcs)
    sides = min(data_length(model, one) for one in (before, after))
    if sides > SHORTEST * length:
        fillets = (data_length(model, one) for one in fillets_of(model.row))
        return supposed or length <= LONGEST * max(fillets, default=0.0)
    are_off = missed[before] and missed[k]
    return are_off and length < min(data_length(model, one) for one in (before, after))


def fillets_of(row: Segments) -> list[int]:
    """Arcs between two lines each, of a closed outline."""
    kinds, n = [segment.kind for segment in row.found], len(row.found)
    arcs = (k for k in range(n) if kinds[k] == ARC)
    return [k for k in arcs if kinds[k - 1] == kinds[(k + 1) % n] == LINE]


def _fillet(model: Model, k: int, m: int) -> tuple[int, int] | None:
    """First and last point of the arc that touches two lines as far from their node as data are."""
    node, s = nodes_of(model)[k], model.row.stations
    half, off = 0.5 * turn_at(model, k, m, node), away_from_data(model, k, node)
    depth = 1.0 / cos(half) - 1.0  # of a node, in radii
    if depth == 0.0:
        return None
    reach = off / depth * tan(half)
    i, j, _ = model.row.found[k]
    p, q, _ = model.row.found[m]
    begin = int(np.searchsorted(s, s[j] - reach, side="right")) - 1
    end = int(np.searchsorted(s, s[p] + reach))
    if j - begin + end - p < FEWEST or min(s[j] - s[i], s[q] - s[p]) < SHORTEST * reach:
        return None
    return begin, end


def row_with(
    row: Segments,
    begins: list[int],
    kinds: list[int],
    more: dict[int, tuple[int, int]],
    *,
    closed: bool,
) -> Segments:
    """Segments that begin there and are these, with others that begin behind some of them."""
    last, parts = row.found[-1].end, [*zip(begins, kinds, strict=True)]
    for k in sorted(more, reverse=True):
        parts.insert(k + 1, more[k])
    ends = [*(begin for begin, _ in parts[1:]), last]
    found = (Segment(i, j, kind) for (i, kind), j in zip(parts, ends, strict=True))
    row = row._replace(found=tuple(found))
    return row.cut_at([begin % last for begin, _ in parts]) if closed else row
