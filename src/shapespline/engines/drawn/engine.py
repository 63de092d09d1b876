"""An outline as it was drawn: lines, arcs and whole circles, free-form runs between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.joints import direction_at, meeting, onto, turn_at, unit_of
from shapespline.engines.drawn.model import Model, circle_of
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.regularities import NAMES, Regularity, Search
from shapespline.engines.drawn.segments import ARC, FREE, LINE, Segments, segmented

if TYPE_CHECKING:
    from collections.abc import Collection

    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# Fewer points tell no structure.
FEWEST_POINTS = 12
# A whole circle is within so many deviations in the mean (DRA-06).
ROUND = 2.0
# An element whose points are off by more deviations in the mean, or at most, is none (DRA-06).
MEAN, LARGEST = 2.0, 6.0
# A node is no farther from its data than so many steps and deviations: lines that are nearly
# parallel meet anywhere (DRA-06).
NODE_STEPS, NODE_DEVIATIONS = 3.0, 20.0
# A free-form run goes on smoothly from an element if its data do, radians.
SMOOTH_END = 0.2
# Data within so many steps of a node tell its direction.
DIRECTION_STEPS = 4


@dataclass(frozen=True, eq=False)
class DrawnLine:
    """A straight edge."""

    begin: FloatArray
    end: FloatArray


@dataclass(frozen=True, eq=False)
class DrawnArc:
    """Part of a circle, from an angle on by a sweep, counter-clockwise if positive; radians."""

    centre: FloatArray
    radius: float
    start: float
    sweep: float
    begin: FloatArray
    end: FloatArray


@dataclass(frozen=True, eq=False)
class FreeRun:
    """Data that neither explains: points with both ends, and tangents there that are known."""

    points: FloatArray
    tangents: tuple[FloatArray | None, FloatArray | None]
    closed: bool = False


Part = DrawnLine | DrawnArc | FreeRun


@dataclass(frozen=True, eq=False)
class Drawn:
    """Parts end to end, and the regularities that they keep, by their places among the parts."""

    parts: tuple[Part, ...]
    regularities: tuple[Regularity, ...]

    @property
    def n_elements(self) -> int:
        """How many lines and arcs there are."""
        return sum(not isinstance(part, FreeRun) for part in self.parts)


def as_drawn(
    contour: Contour,
    accuracy: float | None = None,
    regularities: Collection[str] = NAMES,
    tolerance: float = np.inf,
) -> Drawn | None:
    """Lines, arcs and free-form runs of a contour; None if it tells no lines and arcs.

    Parameters
    ----------
    contour : Contour
    accuracy : float, optional
        Of points that a picture told, data units; None for measured points.
    regularities : collection of str
        Those that may be taken.
    tolerance : float
        Elements farther from their data are none.

    Examples
    --------
    >>> from shapespline.values import Contour
    >>> t = np.linspace(0, 1, 30, endpoint=False)
    >>> sides = [np.column_stack([t, 0 * t]), np.column_stack([1 + 0 * t, t])]
    >>> square = Contour(np.concatenate([*sides, 1 - sides[0], 1 - sides[1]]), closed=True)
    >>> len(as_drawn(square).parts)
    4
    """
    if len(contour) < FEWEST_POINTS:
        return None
    seen = Observed.of(contour, accuracy)
    if contour.closed:
        whole = _whole_circle(seen)
        if whole is not None:
            return Drawn((whole,), ())
    row = segmented(seen)
    for _ in range(len(row.found)):
        if all(segment.kind == FREE for segment in row.found):
            return None
        model = Model.of(seen, row)
        found = Search(model, regularities).run()
        bad = _misfitting(model, tolerance)
        if not bad:
            return _drawn(model, found)
        row = _without(row, bad)
    return None


def _whole_circle(seen: Observed) -> DrawnArc | None:
    """All points as one circle."""
    points = seen.points
    weights = np.ones(len(points))
    cx, cy, r = circle_of(points, weights)
    off = np.hypot(points[:, 0] - cx, points[:, 1] - cy) - r
    if float(np.sqrt((off**2).mean())) > ROUND * seen.largest_deviation:
        return None
    if float(np.abs(off).max()) > LARGEST * seen.largest_deviation:
        return None
    x, y = points.T
    area = float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    begin = np.array([cx + r, cy])
    sweep = 2 * np.pi if area > 0 else -2 * np.pi
    return DrawnArc(np.array([cx, cy]), r, 0.0, sweep, begin, begin)


def _misfitting(model: Model, tolerance: float) -> list[int]:
    """Elements that their own data contradict, the worst alone where others may be its victims."""
    bad: list[tuple[float, int]] = []
    sigma = model.seen.largest_deviation
    for k, misfit in model.misfits().items():
        points, _ = model.counted(k)
        off = np.abs(_off(model, k, points))
        mean = misfit.mean * model.seen.deviation / sigma
        far = max(mean / MEAN, float(off.max()) / min(LARGEST * sigma, tolerance))
        if far > 1.0:
            bad.append((far, k))
    if bad:
        return [max(bad)[1]]
    nodes = _nodes(model)
    reach = NODE_STEPS * model.seen.step + NODE_DEVIATIONS * sigma
    for k, node in nodes.items():
        at = model.row.points[model.row.found[k].end]
        if k in model.at and (k + 1) % len(model.row.found) in model.at:
            far = float(np.hypot(*(node - at))) / reach
            # Blunted corners lie farther from their points the sharper they are.
            turn = turn_at(model, k, (k + 1) % len(model.row.found), node)
            far *= float(np.cos(0.5 * turn)) ** 0.5
            if far > 1.0:
                bad.append((far, min(k, (k + 1) % len(model.row.found), key=lambda m: _length(model, m))))
    return [max(bad)[1]] if bad else []


def _length(model: Model, k: int) -> float:
    s, (i, j, _) = model.row.stations, model.row.found[k]
    return float(s[j] - s[i])


def _off(model: Model, k: int, points: FloatArray) -> FloatArray:
    """Signed distances of points from the whole line or circle of an element."""
    o = model.at[k]
    if model.kind(k) == LINE:
        tx, ty = unit_of(float(model.x[o]))
        return tx * points[:, 1] - ty * points[:, 0] - model.x[o + 1]
    return np.hypot(*(points - model.x[o : o + 2]).T) - model.x[o + 2]


def _without(row: Segments, bad: list[int]) -> Segments:
    """The row with some segments free-form; it begins with an element, if there is one."""
    found = tuple(s._replace(kind=FREE) if k in bad else s for k, s in enumerate(row.found))
    row = row._replace(found=found)
    closed = bool((row.points[0] == row.points[-1]).all())
    whole = next((k for k, s in enumerate(found) if s.kind != FREE), 0)
    return row.turned(whole) if closed else row


def _nodes(model: Model) -> dict[int, FloatArray]:
    """Where each segment ends, if it or the next one is an element; -1 for an open beginning."""
    found, n = model.row.found, len(model.row.found)
    points, nodes = model.row.points, {}
    for k in range(n):
        m, at = (k + 1) % n, points[found[k].end]
        if m == 0 and not model.seen.closed:
            m = -1
        if k in model.at and m in model.at and k != m:
            nodes[k] = meeting(model, k, m, at)
        elif k in model.at:
            nodes[k] = onto(model, k, at)
        elif m in model.at:
            nodes[k] = onto(model, m, at)
    if not model.seen.closed and 0 in model.at:
        nodes[-1] = onto(model, 0, points[0])
    elif model.seen.closed and n - 1 in nodes:
        nodes[-1] = nodes[n - 1]
    return nodes


def _drawn(model: Model, found: list[Regularity]) -> Drawn:
    """Elements between their nodes, free-form runs between them."""
    segments, nodes = model.row.found, _nodes(model)
    parts: list[Part] = []
    place: dict[int, int] = {}
    k, n = 0, len(segments)
    while k < n:
        if k in model.at:
            place[k] = len(parts)
            parts.append(_element(model, k, nodes[k - 1], nodes[k]))
            k += 1
            continue
        last = k
        while last + 1 < n and last + 1 not in model.at:
            last += 1
        parts.append(_free_run(model, k, last, nodes))
        k = last + 1
    kept = tuple(one._replace(segments=tuple(place[s] for s in one.segments)) for one in found)
    return Drawn(tuple(parts), kept)


def _element(model: Model, k: int, begin: FloatArray, end: FloatArray) -> DrawnLine | DrawnArc:
    if model.kind(k) == LINE:
        return DrawnLine(begin, end)
    o = model.at[k]
    centre, radius = model.x[o : o + 2].copy(), float(model.x[o + 2])
    first, last = (float(np.arctan2(*(p - centre)[::-1])) for p in (begin, end))
    sweep = (last - first) % (2 * np.pi) if model.ways[k] > 0 else -((first - last) % (2 * np.pi))
    return DrawnArc(centre, radius, first, sweep, begin, end)


def _free_run(model: Model, k: int, last: int, nodes: dict[int, FloatArray]) -> FreeRun:
    """The data of segments k to last, from node to node."""
    row, n = model.row, len(model.row.found)
    i, j = row.found[k].begin, row.found[last].end
    points = row.points[i : j + 1].copy()
    tangents: list[FloatArray | None] = [None, None]
    reach = min(DIRECTION_STEPS, len(points) - 1)
    closed = model.seen.closed
    before, after = (k - 1, (last + 1) % n) if closed else (k - 1, last + 1)
    if closed:
        before %= n
    if before in model.at:
        points[0] = nodes[(k - 1) if k > 0 else -1]
        tangents[0] = _smooth(direction_at(model, before, points[0]), points[reach] - points[0])
    if after in model.at:
        points[-1] = nodes[last]
        tangents[1] = _smooth(direction_at(model, after, points[-1]), points[-1] - points[-1 - reach])
    return FreeRun(points, (tangents[0], tangents[1]))


def _smooth(tangent: FloatArray, chord: FloatArray) -> FloatArray | None:
    """The tangent, if data go on along it."""
    turn = np.arctan2(tangent[0] * chord[1] - tangent[1] * chord[0], tangent @ chord)
    return tangent if abs(float(turn)) < SMOOTH_END else None
