"""Curves that cross where their data do not: the pieces that cross are fitted again.

A slit that is narrower than the tolerance closes when both of its sides may move by it. A closer
fit of everything would keep it open at the price of points everywhere; here only the pieces beside
it are fitted again, between their nodes and with their tangents, to points that were moved from the
other side (`slits`); where that does not part them, to their own points closer and closer.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.contour import Contour
from shapespline.crossings import crossing_pairs, self_crossings
from shapespline.exact import chords
from shapespline.footpoint import nearest
from shapespline.joining import joined, turn_between
from shapespline.slits import Sides, moved
from shapespline.trails import SAMPLING_PART, Part, Row, curve_of, located, pieces_of
from shapespline.verification import verified_fit

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from shapespline.drawing import Fit
    from shapespline.trails import Trail
    from shapespline.typing import FloatArray

    Refit = Callable[[Contour, float, "Tangents"], Fit]


class Step(NamedTuple):
    """How pieces that cross are fitted again.

    ``within`` is the part of the tolerance; ``beside`` how many neighbours go with each piece;
    ``moved`` whether points move by the rest of the tolerance.
    """

    within: float
    beside: int
    moved: bool


# Where the pieces alone are not enough a node is to blame, which goes with both of its pieces. The
# last two follow the points as they came, closer.
STEPS = (
    Step(3 / 4, 0, True),
    Step(3 / 4, 1, True),
    Step(1 / 2, 1, True),
    Step(1 / 4, 1, True),
    Step(1 / 8, 1, False),
    Step(1 / 32, 1, False),
)
# Joints that turn less than this, radians, are smooth.
SMOOTH = np.radians(1.0)

# Searches that follow the points. What was estimated from noisy ones would follow their noise.
FOLLOWING = ("sections", "removal")
CROSSES = "it crosses a curve where the data do not"

Tangents = tuple["FloatArray | None", "FloatArray | None"]


def uncrossed(contours: Sequence[Contour], fits: Sequence[Fit], refit: Refit) -> list[Fit]:
    """Fits whose curves cross no more than their data, as far as other pieces bring that about.

    ``refit`` fits an open row of points within a distance, with its ends and, where given, its end
    tangents. Of the rows tried the one with the fewest parts that cross is taken. Fits that cross
    after all say so in their status.
    """
    lines = [_line(fit) for fit in fits]
    pairs = _new_crossings(contours, lines)
    if not pairs:
        return list(fits)
    sides = Sides.of([fit.contour for fit in fits])
    begun: dict[int, Row] = {}
    rows: dict[int, Row] = {}
    best: dict[int, tuple[int, Row]] = {}
    for step in (*STEPS, None):
        for owner in {owner for pair in pairs for owner in pair} - rows.keys():
            rows[owner] = begun[owner] = Row.of(owner, fits[owner])
        found = _crossing_parts(pairs, rows)
        for owner, row in rows.items():
            count = len(found.get(owner, ()))
            if owner not in best or count < best[owner][0]:
                best[owner] = count, row
        owners = [owner for owner in found if fits[owner].method in FOLLOWING]
        if step is None or not owners:
            break
        for owner in owners:
            rows[owner] = _fitted_again(rows[owner], found[owner], step, sides, refit)
            lines[owner] = rows[owner].line
        pairs = _new_crossings(contours, lines)
    result = list(fits)
    for owner, (_, row) in best.items():
        if row is not begun[owner]:
            result[owner] = _verified(row)
        lines[owner] = _line(result[owner])
    still = {owner for pair in _new_crossings(contours, lines) for owner in pair}
    return [_told(fit) if owner in still else fit for owner, fit in enumerate(result)]


def _line(fit: Fit) -> FloatArray:
    """A fit as a polyline."""
    return chords(fit.spline, SAMPLING_PART * fit.tolerance)[0]


def _verified(row: Row) -> Fit:
    """The fit of a row, unless it breaks the promise that was kept."""
    fit, pieces = row.fit, tuple(part.piece for part in row.parts)
    again = verified_fit(
        fit.contour,
        joined(pieces, fit.degree),
        tolerance=fit.tolerance,
        method=fit.method,
        sections=pieces,
        history=fit.history,
    )
    # Where data overlap a piece may have been given the points of another: the promise comes first.
    return fit if fit.kept and not again.kept else again


def _told(fit: Fit) -> Fit:
    sentence = fit.status.value
    if sentence.endswith(CROSSES):
        return fit
    return replace(fit, status=fit.status.saying(f"{sentence}; {CROSSES}"))


def _crossing_parts(pairs: set[tuple[int, int]], rows: Mapping[int, Row]) -> dict[int, list[int]]:
    """Of each contour the parts that cross others, or themselves, where no data cross."""
    lines = {owner: [part.line for part in row.parts] for owner, row in rows.items()}
    found: set[tuple[int, int]] = set()
    for i, j in pairs:
        mine = [(i, k) for k in range(len(lines[i]))]
        yours = [] if i == j else [(j, k) for k in range(len(lines[j]))]
        places = mine + yours
        for a, b in crossing_pairs([lines[owner][k] for owner, k in places]):
            if i == j or places[a][0] != places[b][0]:
                found |= {places[a], places[b]}
        if i == j:
            found |= {(i, k) for _, k in mine if self_crossings(lines[i][k])}
    return {
        owner: sorted(k for other, k in found if other == owner)
        for owner in sorted({owner for owner, _ in found})
    }


def _new_crossings(
    contours: Sequence[Contour], lines: Sequence[FloatArray]
) -> set[tuple[int, int]]:
    """Pairs of contours whose lines cross but not their data; (i, i) of one that crosses itself."""
    data = [contour.polyline for contour in contours]
    pairs = {
        (i, j)
        for i, j in crossing_pairs(lines)
        if not crossing_pairs([data[i], data[j]], at_vertices=True)
    }
    return pairs | {
        (index, index)
        for index, line in enumerate(lines)
        if self_crossings(line) > self_crossings(data[index])
    }


def _fitted_again(
    row: Row,
    found: Sequence[int],
    step: Step,
    sides: Sides,
    refit: Refit,
) -> Row:
    """The row with the parts that cross, and so many beside them, fitted again."""
    if row.fit.closed and step.beside:
        first = _seam(found, len(row.parts))
        row, found = row.turned(first), [(at - first) % len(row.parts) for at in found]
    parts = list(row.parts)
    for begin, end in reversed(_windows(found, step.beside, len(parts))):
        parts[begin:end] = _window_again(row, begin, end, step, sides, refit)
    return row._replace(parts=tuple(parts))


def _seam(found: Sequence[int], count: int) -> int:
    """The part to begin with: away from those that cross, or elsewhere than before."""

    def crossing_beside(at: int) -> tuple[int, int]:
        return (at in found) + ((at - 1) % count in found), abs(at - count // 2)

    return min(range(count), key=crossing_beside)


def _windows(found: Sequence[int], beside: int, count: int) -> list[tuple[int, int]]:
    """Runs of neighbours (begin, end) around some indices, each once."""
    windows: list[tuple[int, int]] = []
    for at in sorted(found):
        begin, end = max(at - beside, 0), min(at + beside + 1, count)
        if windows and beside and begin <= windows[-1][1]:
            begin = windows.pop()[0]
        windows.append((begin, end))
    return windows


def _window_again(
    row: Row,
    begin: int,
    end: int,
    step: Step,
    sides: Sides,
    refit: Refit,
) -> tuple[Part, ...]:
    """Parts fitted again, with their outer nodes and the smooth tangents there."""
    window = row.parts[begin:end]
    within = step.within * row.fit.tolerance
    first, last = window[0].piece.control_points, window[-1].piece.control_points
    trail = row.trail.part(window[0].begin, window[-1].end)
    points = _aside(row, window, trail, within, sides) if step.moved else trail.points
    # What is so near to an outer node is kept by it, and may lie behind it.
    beyond = _beyond(trail.points, first[0], within)
    before_last = _beyond(trail.points[::-1], last[-1], within)
    inner = points[beyond : len(points) - before_last]
    contour = Contour.silently(np.concatenate([first[:1], inner, last[-1:]]), closed=False)
    fit = refit(contour, within, _tangents(row, begin, end))
    if not fit.kept:
        fit = refit(contour, within, (None, None))
    return located(trail, pieces_of(fit), row.fit.tolerance, window[0].begin)


def _beyond(points: FloatArray, node: FloatArray, within: float) -> int:
    """How many points from the first on are this near to a node; none if all are."""
    return int(np.argmax(np.hypot(*(points - node).T) > within)) if len(points) else 0


def _aside(
    row: Row, window: Sequence[Part], trail: Trail, within: float, sides: Sides
) -> FloatArray:
    """The points of a window moved from what lies across a slit."""
    if not len(trail.points):
        return trail.points
    feet = [_feet(part, row.trail.points[part.begin : part.end]) for part in window]
    across = sides.beside(trail.points, 2 * within).across(trail, row.owner, within)
    room = row.fit.tolerance - within
    return moved(trail.points, np.concatenate(feet), across, within, room)


def _feet(part: Part, points: FloatArray) -> FloatArray:
    """The nearest point of a part for each point."""
    curve = curve_of(part.piece)
    return curve(nearest(curve, points).parameters)


def _tangents(row: Row, begin: int, end: int) -> Tangents:
    """The tangents at the outer nodes of a window, where its neighbours go on smoothly."""
    pieces, closed = [part.piece for part in row.parts], row.fit.closed
    tangents: list[FloatArray | None] = [None, None]
    if (begin > 0 or closed) and abs(turn_between(pieces[begin - 1], pieces[begin])) < SMOOTH:
        tangents[0] = np.diff(pieces[begin].control_points[:2], axis=0)[0]
    after = pieces[end % len(pieces)]
    if (end < len(pieces) or closed) and abs(turn_between(pieces[end - 1], after)) < SMOOTH:
        tangents[1] = np.diff(pieces[end - 1].control_points[-2:], axis=0)[0]
    return tangents[0], tangents[1]
