"""Curves that cross where their data do not: the pieces that cross are fitted again.

A clearance that is narrower than the tolerance closes when both of its sides may move by it. A
closer fit of everything would keep it open at the price of points everywhere; here only the pieces
beside it are fitted again, between their nodes and with their tangents, to points that were moved
from the other side (`clearance`); where that does not part them, to their own points closer and
closer.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.pieces import through_all
from shapespline.fitting.repair.assignment import (
    AssignedPiece,
    DataRun,
    PieceAssignment,
    curve_of,
    line_of,
)
from shapespline.fitting.repair.clearance import Sides, moved
from shapespline.fitting.repair.reading import Reading
from shapespline.fitting.repair.refit import (
    Refit,
    Window,
    fitted_again,
    turned_apart,
    verified_row,
    windows_around,
)
from shapespline.fitting.verify import verified_anew, verified_fit
from shapespline.geometry import crossing_pairs, joined, nearest, self_crossings

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from shapespline.fitting.request import Request
    from shapespline.typing import BoolArray, FloatArray
    from shapespline.values import Contour, Fit


class Step(NamedTuple):
    """How pieces that cross are fitted again.

    ``within`` is the part of the tolerance; ``beside`` how many neighbours go with each piece;
    ``moved`` whether points move by the rest of the tolerance.
    """

    within: float
    beside: int
    moved: bool


# Where the pieces alone are not enough a node is to blame; then the neighbours are fitted again
# with them. The last two steps follow the points as they came, closer (FIT-11).
STEPS = (
    Step(3 / 4, 0, True),
    Step(3 / 4, 1, True),
    Step(1 / 2, 1, True),
    Step(1 / 4, 1, True),
    Step(1 / 8, 1, False),
    Step(1 / 32, 1, False),
)
# Where all that is not enough, a curve of few points is searched anew within these parts (FIT-29).
CLOSER, FEW_POINTS = (0.6, 0.3), 60
# These methods follow the points. A curve that was estimated from noisy points would follow noise.
FOLLOWING = ("sections", "removal")
# Points as near to another side as this part of the size lie on it; another is a side that is
# farther along the data than this part of the tolerance (FIT-24).
TOUCHING, NEXT = 1e-9, 0.01
CROSSES = "it crosses a curve where the data do not"
# Curves of so many pieces that cross with so many of their points are given up for lines through
# all of them at once: of scattered points each piece would be fitted again six times (FIT-21).
MANY_PIECES, NEARLY_ALL = 400, 0.85


def uncross(fit: Fit, request: Request, ask: Callable[[Request], Fit]) -> Fit:
    """A fit of one outline in pieces that crosses itself no more than its data.

    Where it cannot be repaired its status says so.
    """
    if not request.is_plain or request.style.form == "spline":
        return told(fit)
    (found,) = uncrossed([fit], request, ask)
    if not _crosses(found) or fit.n_stored_points > FEW_POINTS or _lies_on_itself(fit):
        return found
    for part in CLOSER:
        again = verified_anew(fit, ask(request.closer(part * fit.tolerance)))
        (again,) = uncrossed([again], request, ask)
        if again.kept and not _crosses(again):
            return again
    return found


def told(fit: Fit) -> Fit:
    """The fit; its status says so if its curve crosses itself more often than its data do."""
    count = self_crossings(_line(Reading.of(fit.contour).curve(fit)))
    return _told(fit) if count and count > self_crossings(fit.contour.polyline) else fit


def uncrossed(
    fits: Sequence[Fit],
    request: Request,
    ask: Callable[[Request], Fit],
    *,
    each_is_told: bool = False,
) -> list[Fit]:
    """Fits whose curves cross no more than their data, as far as other pieces bring that about.

    ``ask`` answers sub-requests in the style of ``request``. Of the rows tried the one with the
    fewest parts that cross is taken. Fits that cross after all say so in their status. Points are
    read in their canonical order: what is repaired does not depend on which of them comes first and
    which way they run. Where ``each_is_told`` a status says so already of a fit that crosses
    itself, and the others are looked at only where they may cross each other.
    """
    if each_is_told and not any(_crosses(fit) for fit in fits) and not _may_cross(fits):
        return list(fits)
    readings = [Reading.of(fit.contour) for fit in fits]
    lines = [_line(one.curve(fit)) for one, fit in zip(readings, fits, strict=True)]
    if not (crossing_pairs(lines) or any(self_crossings(line) for line in lines)):
        return list(fits)
    read = [reading.fit(fit) for reading, fit in zip(readings, fits, strict=True)]
    pairs = _new_crossings([fit.contour for fit in read], lines)
    if not pairs:
        return list(fits)
    found = _uncrossed(read, pairs, request, ask)
    apart = [
        reading.restored(*each) for reading, *each in zip(readings, fits, read, found, strict=True)
    ]
    if request.tolerance is not None:
        return apart
    return [
        one if one.spline is fit.spline else _unasked(one)
        for fit, one in zip(fits, apart, strict=True)
    ]


def _uncrossed(
    fits: Sequence[Fit],
    pairs: set[tuple[int, int]],
    request: Request,
    ask: Callable[[Request], Fit],
) -> list[Fit]:
    """The same of fits in canonical order, of which ``pairs`` cross."""
    refit, contours = Refit(request, ask), [fit.contour for fit in fits]
    fits, lines, pairs = _given_up(fits, pairs, request)
    sides = Sides([fit.contour for fit in fits])
    begun: dict[int, PieceAssignment] = {}
    rows: dict[int, PieceAssignment] = {}
    best: dict[int, tuple[int, PieceAssignment]] = {}
    for step in (*STEPS, None):
        for owner in {owner for pair in pairs for owner in pair} - rows.keys():
            rows[owner] = begun[owner] = PieceAssignment.of(owner, fits[owner])
        found = _crossing_parts(pairs, rows, sides)
        for owner, row in rows.items():
            count = len(found.get(owner, ()))
            if owner not in best or count < best[owner][0]:
                best[owner] = count, row
        owners = [owner for owner in found if fits[owner].method in FOLLOWING]
        # Windows meet their neighbours in tangents, not in curvature.
        if step is None or not owners or request.style.smoothness == 2:
            break
        for owner in owners:
            rows[owner] = _fitted_again(rows[owner], found[owner], step, sides, refit)
            lines[owner] = rows[owner].line
        pairs = _new_crossings(contours, lines)
    result = list(fits)
    for owner, (_, row) in best.items():
        if row is not begun[owner]:
            result[owner] = _no_larger_than_data(verified_row(row))
        lines[owner] = _line(result[owner])
    if best:
        pairs = _new_crossings(contours, lines)
    still = {owner for pair in pairs for owner in pair}
    return [_told(fit) if owner in still else fit for owner, fit in enumerate(result)]


def _given_up(
    fits: Sequence[Fit], pairs: set[tuple[int, int]], request: Request
) -> tuple[list[Fit], list[FloatArray], set[tuple[int, int]]]:
    """Fits, their lines and the pairs that still cross, lines through all points for some."""
    hopeless = {
        owner
        for owner, fit in enumerate(fits)
        if (owner, owner) in pairs and len(fit.sections) >= MANY_PIECES
    }
    if request.style.smoothness == 2:
        hopeless.clear()
    found = [
        _no_larger_than_data(fit, NEARLY_ALL) if owner in hopeless else fit
        for owner, fit in enumerate(fits)
    ]
    lines = [_line(fit) for fit in found]
    if all(a is b for a, b in zip(fits, found, strict=True)):
        return found, lines, pairs
    return found, lines, _new_crossings([fit.contour for fit in found], lines)


def _may_cross(fits: Sequence[Fit]) -> bool:
    """Whether curves whose boxes overlap cross each other."""
    if len(fits) < 2:
        return False
    boxes = np.array([[*f.control_points.min(axis=0), *f.control_points.max(axis=0)] for f in fits])
    low, high = boxes[:, :2], boxes[:, 2:]
    beside = [
        k for k in range(len(fits)) if ((low <= high[k]) & (high >= low[k])).all(axis=1).sum() > 1
    ]
    lines = [_line(Reading.of(fits[k].contour).curve(fits[k])) for k in beside]
    return bool(crossing_pairs(lines))


def _line(fit: Fit) -> FloatArray:
    """A fit as a polyline."""
    return line_of(fit.spline, fit.tolerance, fit.corners)


def _no_larger_than_data(fit: Fit, part: float = 1.0) -> Fit:
    """The fit, or lines through all points where it has more than this part of theirs."""
    lines = through_all(fit.contour)
    if fit.n_stored_points <= part * (len(lines) + (not fit.closed)):
        return fit
    spline = joined(lines, fit.degree)
    return verified_fit(
        fit.contour, spline, tolerance=fit.tolerance, method=fit.method, sections=lines
    )


def _unasked(fit: Fit) -> Fit:
    """A fit of no tolerance, repaired within what it kept before: it keeps what it does now."""
    again = verified_fit(
        fit.contour,
        fit.spline,
        tolerance=None,
        method=fit.method,
        history=fit.history,
        sections=fit.sections,
    )
    again = replace(again, outliers=fit.outliers)
    return _told(again) if _crosses(fit) else again


def _told(fit: Fit) -> Fit:
    if _crosses(fit):
        return fit
    return replace(fit, status=fit.status.saying(f"{fit.status.value}; {CROSSES}"))


def _crosses(fit: Fit) -> bool:
    """Whether its status says that it crosses where the data do not."""
    return fit.status.value.endswith(CROSSES)


def _crossing_parts(
    pairs: set[tuple[int, int]], rows: Mapping[int, PieceAssignment], sides: Sides
) -> dict[int, list[int]]:
    """Of each contour the parts that cross others, or themselves, where data lie apart."""
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
    found = {(owner, k) for owner, k in found if not _lies_on_data(rows[owner], k, sides)}
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
        if (count := self_crossings(line)) and count > self_crossings(data[index])
    }


def _lies_on_itself(fit: Fit) -> bool:
    """Whether some of the data lie on other sides of them: no search may part those."""
    contour, tolerance = fit.contour, fit.tolerance
    data = DataRun(contour.points, contour.arc_length[: len(contour)])
    across = Sides([contour]).across(data, 0, reach=tolerance, least=NEXT * tolerance)
    return bool(_touching(across, contour.points).any())


def _touching(across: FloatArray, points: FloatArray) -> BoolArray:
    return np.hypot(*across.T) <= TOUCHING * np.ptp(points, axis=0).max()


def _lies_on_data(row: PieceAssignment, at: int, sides: Sides) -> bool:
    """Whether most points of a part lie on other sides of the data: no clearance keeps them apart.

    Of a stroke that is traced there and back no count of crossings is right (FIT-24).
    """
    part, tolerance = row.parts[at], row.fit.tolerance
    data = row.data.part(max(part.begin - 1, 0), part.end + 1)
    across = sides.across(data, row.owner, reach=tolerance, least=NEXT * tolerance)
    touching = _touching(across, row.data.points)
    return bool(2 * touching.sum() > len(touching))


def _fitted_again(
    row: PieceAssignment, found: Sequence[int], step: Step, sides: Sides, refit: Refit
) -> PieceAssignment:
    """The row with the parts that cross, and so many beside them, fitted again."""
    if row.fit.contour.closed and step.beside:
        row, found = turned_apart(row, found)
    within = step.within * row.fit.tolerance

    def aside(row: PieceAssignment, window: Sequence[AssignedPiece], data: DataRun) -> FloatArray:
        return _aside(row, window, data, within, sides)

    windows = [
        Window(begin, end, within)
        for begin, end in windows_around(found, step.beside, len(row.parts))
    ]
    return fitted_again(row, windows, refit, aside if step.moved else None)


def _aside(
    row: PieceAssignment,
    window: Sequence[AssignedPiece],
    data: DataRun,
    within: float,
    sides: Sides,
) -> FloatArray:
    """The points of a window moved from what lies across a clearance."""
    if not len(data.points):
        return data.points
    feet = [_feet(part, row.data.points[part.begin : part.end]) for part in window]
    across = sides.across(data, row.owner, reach=2 * within, least=within)
    room = row.fit.tolerance - within
    return moved(data.points, np.concatenate(feet), across, within, room)


def _feet(part: AssignedPiece, points: FloatArray) -> FloatArray:
    """The nearest point of a part for each point."""
    curve = curve_of(part.piece)
    return curve(nearest(curve, points).parameters)
