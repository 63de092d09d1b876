"""Whether elements are what was drawn: the last test of each, and what speaks for all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.ends import (
    NEIGHBOURS,
    away_from_data,
    cut_off,
    data_length,
    length_along,
    length_between,
    nodes_of,
    off_by,
)
from shapespline.engines.drawn.joints import direction_at, distance_from, turn_at
from shapespline.engines.drawn.jumps import jump_clearly
from shapespline.engines.drawn.regularities import DIRECTIONS, OF_PICTURES, RADII, TANGENT_TURN
from shapespline.engines.drawn.segments import ARC, CORNER, FREE, LINE, is_corner

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.engines.drawn.model import Model
    from shapespline.engines.drawn.segments import Segments
    from shapespline.typing import FloatArray
    from shapespline.values import Regularity

# An element whose points are off by more deviations in the mean, or at most, is none (DRA-06).
MEAN, LARGEST = 2.0, 6.0
# The stairs of a picture of one bit are no random errors: none is larger than half a step or so
# (DRA-14).
BIT_MEAN, BIT_LARGEST = 1.3, 3.0
# Of an outline that was drawn lines and arcs make up this part, and keep so many regularities for
# each, tangency counted half where free-form runs make up no more than a tenth, too (DRA-08).
LEAST_SHARE, LEAST_SAID, SAID_BY_TOUCH, LITTLE_FREE = 0.2, 0.65, 0.5, 0.1
# A line from corner to corner was drawn, whatever it repeats, if no arc of a radius below so many
# pixels lies as near to it (DRA-40).
PLAIN = 900.0
# Of exact points a line from corner to corner with so many steps is one (DRA-45).
PLAIN_POINTS = 20
# That a line's direction is another's, or level, says something if it is known to so many radians
# (DRA-42). What else is told in degrees.
DIRECTED = ("axis-parallel", "parallel", "perpendicular", "collinear")
TURNED = ("tangent", "axis-parallel", "parallel", "perpendicular")
KNOWN_DIRECTION = float(np.radians(0.7))
# So few elements and nothing else may be what was drawn though they keep no regularities (DRA-17).
FEW_ELEMENTS = 12
# Between its nodes an element has at least this part of the length of its data.
LEAST_LENGTH = 0.3
# Measured points so few, and no farther from the elements beside them, in deviations (DRA-15).
FEW, OFF_FEW = 8, 3.5
# No curve is lines and arcs to the fifth digit, if each of them has so many points (DRA-49).
POINTS_EACH = 12
# Before elements that their points contradict are left out so small a part of it is enough.
HOPELESS = 0.7
# An arc that meets a neighbour at such an angle, radians, and cannot touch it is the beginning of a
# free-form curve: nobody draws so blunt a corner (DRA-26).
BLUNT = np.radians(1.0), np.radians(4.0)
# Nor does one that is told less exactly than its points are turn by less at its ends (DRA-49).
BLUNTEST = np.radians(10.0)
# An arc misses the node that it ends in, and is then led through it, by no more than that part of a
# tolerance, without one of a pixel (DRA-40).
GAP, GAP_OF_PIXEL = 0.25, 0.01
# A node is no farther from its data than so many steps and deviations: lines that are nearly
# parallel meet anywhere (DRA-06).
NODE_STEPS, NODE_DEVIATIONS = 3.0, 20.0
# So many points on either side of a node are looked at first.
NEAREST = 4
# A picture's corner that turns by less is where its data are, but for so many deviations and what
# the pixel's box takes off: 0.4 pixel of a right angle (DRA-29).
SHALLOW, CORNER_OFF = np.radians(60.0), 3.0
BLUNTING = 0.4 / float(np.tan(np.pi / 8))


def misfitting(model: Model, tolerance: float, *, each_alone: bool = False) -> list[int]:
    """Elements that their own data contradict, the worst alone where others may be its victims.

    ``each_alone`` tells that no equation joins them.
    """
    bad: list[tuple[float, int]] = []
    sigma = model.seen.largest_deviation
    for k, misfit in model.misfits().items():
        mean = misfit.mean * model.seen.deviation / sigma
        most = (BIT_MEAN, BIT_LARGEST) if model.seen.one_bit else (MEAN, LARGEST)
        far = max(mean / most[0], misfit.largest / min(most[1] * sigma, tolerance))
        if far > 1.0:
            bad.append((far, k))
    if bad:
        return [k for _, k in bad] if each_alone else [max(bad)[1]]
    reach = NODE_STEPS * model.seen.step + NODE_DEVIATIONS * sigma
    bad += _at_nodes(model, reach, tolerance, each_alone=each_alone)
    nodes = nodes_of(model)
    for k in model.at:
        between = length_between(model, k, nodes[k - 1], nodes[k])
        along = length_along(model, k)
        far = abs(between - along) / (3 * reach)
        if between < LEAST_LENGTH * along:
            far += 1.0
        if far > 1.0:
            bad.append((far, k))
    return [max(bad)[1]] if bad else []


def _at_nodes(
    model: Model, reach: float, tolerance: float, *, each_alone: bool
) -> Iterator[tuple[float, int]]:
    """Elements whose nodes are not where their data end, and by how much."""
    seen, n = model.seen, len(model.row.found)
    gap = GAP_OF_PIXEL * seen.pixel if seen.pixel and np.isinf(tolerance) else GAP * tolerance
    for k, node in nodes_of(model).items():
        m = (k + 1) % n
        if k not in model.at or m not in model.at or (k == n - 1 and not seen.closed):
            continue
        turn = turn_at(model, k, m, node)
        # Blunted corners lie farther from their points the sharper they are.
        sharpness = float(np.cos(0.5 * turn)) ** 0.5
        far = _to_points(model, k, m, node, NEAREST) / reach * sharpness
        if far > 1.0:  # of the nearest points in the row, but others may be nearer
            far = _to_points(model, k, m, node, len(model.row.points)) / reach * sharpness
        if seen.pixel and turn < SHALLOW:
            far = max(far, off_shallow(model, k, node, turn))
        if not each_alone:  # a line and a circle may not meet
            far = max(far, *(_off_node(model, one, node) / gap for one in (k, m)))
        shorter = min(k, m, key=lambda one: data_length(model, one))
        if far > 1.0:
            yield far, shorter
        elif not each_alone and model.kind(shorter) == ARC and BLUNT[0] < turn < BLUNT[1]:
            yield 1.0, shorter
        if each_alone or np.isinf(tolerance):
            continue
        before, after = cut_off(model, k, m, node, tolerance)
        if (before != after).any():  # and follows its data so
            continue
        for own, missed in zip((k, m), _missed(model, k, m, node), strict=True):
            if missed > tolerance:
                yield missed / tolerance, own


def off_shallow(model: Model, k: int, node: FloatArray, turn: float) -> float:
    """How far a picture's data are from the node behind segment k, over what they may be."""
    blunted = BLUNTING * float(np.tan(0.25 * turn)) * model.seen.pixel
    allowed = CORNER_OFF * model.seen.largest_deviation + blunted
    return away_from_data(model, k, node) / allowed


def _off_node(model: Model, k: int, node: FloatArray) -> float:
    return abs(float(off_by(model, k, node[None])[0]))


def _missed(model: Model, k: int, m: int, node: FloatArray) -> tuple[float, float]:
    """How far the last points of segment k, the first ones of m are from elements up to a node."""
    before, after = model.row.found[k], model.row.found[m]
    last = max((before.begin + before.end) // 2, before.end - NEIGHBOURS), before.end + 1
    first = after.begin, min((after.begin + after.end) // 2, after.begin + NEIGHBOURS) + 1
    farthest = []
    for i, j in (last, first):
        points = model.row.points[i:j]
        off = np.hypot(*(points - node).T)
        for one, way in ((k, 1.0), (m, -1.0)):
            on = way * _before(model, one, node, points) >= 0.0
            off[on] = np.minimum(off[on], np.abs(off_by(model, one, points[on])))
        farthest.append(float(off.max()))
    return farthest[0], farthest[1]


def _before(model: Model, k: int, node: FloatArray, points: FloatArray) -> FloatArray:
    """Positive for points that lie along an element before a node, negative behind it."""
    if model.kind(k) == LINE:
        return (node - points) @ direction_at(model, k, node)
    centre = model.x[model.at[k] : model.at[k] + 2]
    (x, y), (u, v) = (points - centre).T, node - centre
    return (x * v - y * u) * model.ways[k]


def _to_points(model: Model, k: int, m: int, node: FloatArray, n: int) -> float:
    """Distance of a node from the last n points of the segment before it, the first n behind it."""
    before, after = model.row.found[k], model.row.found[m]
    first, last = max(before.begin, before.end - n), min(after.end, after.begin + n)
    cuts = [(first, last)] if m > k else [(first, before.end), (after.begin, last)]
    points = (model.row.points[i : j + 1] for i, j in cuts)
    return min(float(np.hypot(*(some - node).T).min()) for some in points)


def without_few(model: Model) -> Segments | None:
    """The row without an element of a few measured points that those beside it explain (DRA-15)."""
    row, n, sigma = model.row, len(model.row.found), model.seen.deviation
    closed = model.seen.closed
    for k in model.at:
        i, j, _ = row.found[k]
        if model.seen.pixel or n < 3 or (not closed and k in (0, n - 1)):
            continue
        if j - i > FEW or data_length(model, k) > FEW * model.seen.step:
            continue
        before, after = (k - 1) % n, (k + 1) % n
        if before not in model.at or after not in model.at:
            continue
        points = row.points[i + 1 : j + 1]
        if any(_off_both(model, before, after, *place) for place in points.tolist()):
            continue
        left = (off_by(model, before, points) / sigma) ** 2
        right = (off_by(model, after, points) / sigma) ** 2
        both = np.concatenate([[0.0], np.cumsum(left)]) + np.concatenate(
            [np.cumsum(right[::-1])[::-1], [0.0]]
        )
        cut = int(np.argmin(both))
        if max(left[:cut].max(initial=0.0), right[cut:].max(initial=0.0)) <= OFF_FEW**2:
            row = row.turned(before) if closed else row
            at = 1 if closed else k
            first, few, last = row.found[at - 1 : at + 2]
            node = few.begin + cut
            found = (first._replace(end=node), last._replace(begin=node))
            return row._replace(found=(*row.found[: at - 1], *found, *row.found[at + 2 :]))
    return None


def _off_both(model: Model, before: int, after: int, x: float, y: float) -> bool:
    """Whether a point is farther from two elements than those of few points are (DRA-15)."""
    off = min(distance_from(model, k, x, y) for k in (before, after))
    return (off / model.seen.deviation) ** 2 > OFF_FEW**2


def is_enough(row: Segments) -> bool:
    """Whether lines and arcs make up enough of an outline to be what was drawn."""
    return any(kind != FREE for _, _, kind in row.found) and share(row) >= LEAST_SHARE


def share(row: Segments) -> float:
    """The part of an outline's length that lines and arcs make up."""
    s = row.stations
    return sum(float(s[j] - s[i]) for i, j, kind in row.found if kind != FREE) / float(s[-1])


def is_short(model: Model, tolerance: float) -> bool:
    """Whether so few elements make up all of an outline that they may be fewer than curves.

    Or more of them that have many noisy points each; without a tolerance nearly all (DRA-51).
    """
    many = _has_many_points(model)
    if many and np.isinf(tolerance):
        return share(model.row) >= 1.0 - LITTLE_FREE
    n = len(model.row.found)
    return len(model.at) == n and (many or n <= FEW_ELEMENTS)


def may_be_short(model: Model, tolerance: float) -> bool:
    """Whether it may be so without the elements that its points contradict."""
    few = len(model.row.found) <= FEW_ELEMENTS
    return (few or np.isinf(tolerance)) and is_short(model, tolerance)


def _has_many_points(model: Model) -> bool:
    """Whether elements have many noisy points each."""
    row, seen = model.row, model.seen
    return not (seen.pixel or seen.exact) and len(row.found) * POINTS_EACH <= len(row.points)


def is_told(model: Model, found: list[Regularity], tolerance: float, part: float = 1.0) -> bool:
    """Whether what elements repeat tells of a drawing, or how they meet.

    Or all of them follow many exact points. Lines alone within a tolerance are what curves of fewer
    points are compared with.
    """
    row, n = model.row, len(model.row.found)
    exactly = model.seen.exact and len(model.at) == n <= len(row.points) / POINTS_EACH
    if exactly and (np.isinf(tolerance) or any(kind == ARC for _, _, kind in row.found)):
        return True
    return jump_clearly(model) or repeated(model, found) >= part * LEAST_SAID


def has_blunt_arcs(model: Model) -> bool:
    """Whether an arc meets a neighbour neither smoothly nor in a corner: a curve follows it."""
    nodes, n = nodes_of(model), len(model.row.found)
    for k in range(n if model.seen.closed else n - 1):
        m = (k + 1) % n
        if k == m or ARC not in (model.row.found[k].kind, model.row.found[m].kind):
            continue
        if BLUNT[0] < turn_at(model, k, m, nodes[k]) < BLUNTEST:
            return True
    return False


def repeated(model: Model, found: list[Regularity]) -> float:
    """How much a drawing repeats, for each element.

    Any smooth outline has straight stretches, and noisy ones make corners of their own; what people
    draw is level, parallel, equal or symmetric. Equal lengths often follow from that.
    """
    n, said = len(model.at), 0.0
    speak: set[int] = set()
    by_touch = SAID_BY_TOUCH if share(model.row) >= 1.0 - LITTLE_FREE else 0.0
    if len(model.row.found) == 1:  # one arc from end to end, as a whole circle
        return 1.0
    for one in found:
        if not _speaks(model, one):
            continue
        if one.name in ("rotation", "mirror"):
            said += n * (1.0 - 1.0 / one.order)
        elif one.name != "equal-length":
            said += 1.0 if one.name != "tangent" else by_touch
            if one.name != "tangent":
                speak.update(one.pieces)
    return (said + len(_plain_lines(model) - speak)) / n


def _speaks(model: Model, one: Regularity) -> bool:
    """Whether a regularity is met so nearly that it tells of a drawing: few points may be level."""
    if one.name == "equal-radius":
        return abs(one.off) < RADII * float(model.x[model.at[one.pieces[0]] + 2])
    directions = OF_PICTURES if model.seen.pixel else DIRECTIONS
    most = TANGENT_TURN if one.name == "tangent" else directions
    return one.name not in TURNED or abs(one.off) < np.degrees(most)


def is_plain(model: Model) -> bool:
    """Whether most elements are lines from corner to corner of many exact points (DRA-45)."""
    row, closed = model.row, model.seen.closed
    if not model.seen.exact:
        return False
    plain = [
        k
        for k in model.at
        if row.found[k].kind == LINE
        and row.found[k].end - row.found[k].begin >= PLAIN_POINTS
        and all(is_corner(row, at, closed) for at in row.found[k][:2])
    ]
    return len(plain) >= LEAST_SAID * len(model.at)


def tell_by_direction(model: Model, found: list[Regularity]) -> bool:
    """Whether most elements are lines that are level, parallel or square, and known to be so.

    Two parallel edges tell of each other; among much noise any directions agree (DRA-42).
    """
    speak = {k for one in found if one.name in DIRECTED for k in one.pieces}
    known = sum(_direction_error(model, k) <= KNOWN_DIRECTION for k in speak)
    return known >= LEAST_SAID * len(model.at)


def _direction_error(model: Model, k: int) -> float:
    """Standard error of the direction of a line alone, radians."""
    begin, end, _ = model.row.found[k]
    n = max(1, end - begin)
    return model.seen.deviation * float(np.sqrt(12.0 / n)) / data_length(model, k)


def _plain_lines(model: Model) -> set[int]:
    """Lines of a picture from corner to corner, so long that they are no curves (DRA-40)."""
    seen, found, n = model.seen, model.row.found, len(model.row.found)
    if not seen.pixel or seen.one_bit:
        return set()
    nodes, ends = nodes_of(model), dict.fromkeys(model.at, 0)
    for k in range(n if seen.closed else n - 1):
        m = (k + 1) % n
        if k in model.at and m in model.at and k != m and turn_at(model, k, m, nodes[k]) > CORNER:
            ends[k] += 1
            ends[m] += 1
    least = (8.0 * PLAIN * seen.pixel * seen.largest_deviation) ** 0.5  # whose sagitta is that
    return {
        k
        for k, n_ends in ends.items()
        if n_ends == 2 and found[k].kind == LINE and data_length(model, k) >= least
    }
