"""An outline as it was drawn: lines, arcs and whole circles, free-form runs between them."""

from __future__ import annotations

from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.assembly import assembled
from shapespline.engines.drawn.beginnings import without_beginnings
from shapespline.engines.drawn.between_corners import rows_between_corners
from shapespline.engines.drawn.descent import descended, widest
from shapespline.engines.drawn.ends import at_corners
from shapespline.engines.drawn.estimated import MOST_WRONG, Estimated, begun, estimated, settled
from shapespline.engines.drawn.fillets import rows_with_fillets
from shapespline.engines.drawn.judgement import (
    has_blunt_arcs,
    is_plain,
    is_short,
    misfitting,
    tell_by_direction,
    without_few,
)
from shapespline.engines.drawn.long_edges import long_edges
from shapespline.engines.drawn.missed_arcs import with_missed_arcs
from shapespline.engines.drawn.missed_lines import with_missed_lines
from shapespline.engines.drawn.model import Model
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.parts import Drawn
from shapespline.engines.drawn.readings import read_as, rough
from shapespline.engines.drawn.regularities import NAMES, Search
from shapespline.engines.drawn.repeats import free_runs, rows_repeated
from shapespline.engines.drawn.segments import (
    FREE,
    FREE_PARAMETERS,
    PRICE,
    Prices,
    Segments,
    segmented,
    supported,
)
from shapespline.engines.drawn.sharing import shared_anew
from shapespline.engines.drawn.sides import go_on
from shapespline.engines.drawn.supposed import drifting, suppositions, unsure
from shapespline.engines.drawn.whole_circle import whole_circle

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator

    from shapespline.engines.drawn.segments import Segment
    from shapespline.engines.drawn.supposed import Supposition
    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# Fewer points tell no structure.
FEWEST_POINTS = 12
# An outline of more elements than these that have fewer points each is none that was drawn, which
# takes long to find out (DRA-10).
MANY_ELEMENTS, POINTS_EACH = 40, 5
# Points of unknown errors that are free-form in a larger part are no lines and arcs (DRA-47).
MOST_FREE = 0.35
# Stored points of a line and of a circle, than which nothing open or closed is simpler.
SIMPLEST_OPEN, SIMPLEST_CLOSED = 1, 2
# Stored points that readings by other errors spare at least (DRA-57).
CLEARLY = 2
# Rows with more segments are found at that part of their price (DRA-38).
FINER = 0.5


def as_drawn(
    contour: Contour,
    accuracy: float | None = None,
    regularities: Collection[str] = NAMES,
    tolerance: float = np.inf,
    *,
    holds_ends: bool = False,
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
    holds_ends : bool
        Whether an open outline begins and ends in its first and last point.

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
    ends = contour.points[[0, -1]] if holds_ends and not contour.closed else None
    best = _circle(rough(seen, tolerance) or seen)
    if best is None:
        row = segmented(seen)
        best = _first_told(read_as(seen, row, tolerance), ends, regularities, tolerance)
        if best is None and accuracy is not None:
            best = _edges(seen, row, regularities, tolerance)
    if accuracy is not None:
        return best

    def read(one: Supposition) -> Drawn | None:
        return _supposed(one, ends, regularities, tolerance)

    others = [read(one) for one in unsure(contour, seen)]
    if best is None or best.has_runs or best.errors_go_on:
        others.append(_in_turn([read(one) for one in drifting(contour, seen)]))
    best = _by_size(best, others)
    simplest = SIMPLEST_CLOSED if seen.closed else SIMPLEST_OPEN
    return _simplest(best, suppositions(contour, seen), read, simplest)


def _edges(
    seen: Observed, row: Segments, regularities: Collection[str], tolerance: float
) -> Drawn | None:
    """Long edges, one of them level, of a picture's outline that tells of no drawing otherwise."""
    edges = None if seen.one_bit or not seen.closed else long_edges(row, seen)
    if edges is None:
        return None
    model = Model.of(seen, edges)
    if (edges := at_corners(model)) is not model.row:
        model = Model.of(seen, edges, model)
    found = Search(model, NAMES).run()
    is_level = any(one.name == "axis-parallel" for one in found)
    if not is_level or misfitting(model, tolerance):
        return None
    return _finished(Estimated(model, found, told=True, wide=False), regularities, tolerance)


def _in_turn(found: Iterable[Drawn | None]) -> Drawn | None:
    """The first reading, the others after it."""
    known = [one for one in found if one is not None]
    return reduce(lambda after, one: one.or_else(after), reversed(known), None)


def _by_size(best: Drawn | None, others: Iterable[Drawn | None]) -> Drawn | None:
    """Readings of noisy points one after the other, the shortest first, free-form runs last.

    By other errors a bend may be none: what tells of a drawing without gives way only to one that
    is clearly shorter.
    """

    def order(one: Drawn) -> tuple[bool, int]:
        return one.has_runs, one.size - (CLEARLY if one is best else 0)

    found = sorted((one for one in (best, *others) if one is not None), key=order)
    return _in_turn(found)


def _simplest(
    best: Drawn | None,
    larger: Iterable[Supposition],
    read: Callable[[Supposition], Drawn | None],
    fewest: int,
) -> Drawn | None:
    """Of points as exact and with larger and larger errors: the first reading of lines and arcs.

    Or one that is as good as exact, or the next one, if it is simpler: errors half as large as they
    are leave elements that nobody drew.
    """
    told = best is not None and best.is_told
    plain = best if best is not None and told and not best.has_runs else None
    for one in larger:
        if (plain is not None and plain.size <= fewest) or (told and not one.nearly_exact):
            break
        other = read(one)
        is_plain = other is not None and not other.has_runs
        if plain is None and is_plain:
            plain = other
        elif plain is not None:
            if other is not None and is_plain and other.size < plain.size:
                plain = other
            if not one.nearly_exact:
                break
        elif other is not None and not told:
            best, told = other, True
    return best if plain is None else plain


def _circle(seen: Observed, *, independent: bool = False) -> Drawn | None:
    """A closed outline as a whole circle, if it is one."""
    found = whole_circle(seen, independent=independent) if seen.closed else None
    if found is None:
        return None
    off = [] if seen.pixel else [found.off]
    return Drawn((found.arc,), (), is_told=True, n_unknowns=3, errors_go_on=go_on(off))


def _first_told(
    readings: Iterable[tuple[Observed, Segments, bool]],
    ends: FloatArray | None,
    regularities: Collection[str],
    tolerance: float,
) -> Drawn | None:
    """The first reading that holds."""
    for one, row, as_whole in readings:
        best = _of_row(one, row, ends, tolerance, whole=as_whole)
        if best is None or (as_whole and one.exact and has_blunt_arcs(best.model)):
            continue
        is_small = len(best.model.row.found) <= MANY_ELEMENTS  # others take very long
        if one.pixel or np.isfinite(tolerance) or not is_small:
            return _finished(best, regularities, tolerance)
        best = _cheapest(best, row)
        drawn = _finished(best, regularities, tolerance)
        wider = widest(best) if best.told and not one.exact else best
        if wider is best:
            return drawn
        return replace(_finished(wider, regularities, tolerance), otherwise=drawn)
    return None


def _supposed(
    one: Supposition, ends: FloatArray | None, regularities: Collection[str], tolerance: float
) -> Drawn | None:
    """What points tell that are supposed to have larger errors, if they tell enough."""
    independent = not one.by_rounding and one.seen.apart == 1.0
    found = _circle(one.seen, independent=independent)
    if found is None and one.n_each:
        row = segmented(one.seen)
        n_free = sum(segment.end - segment.begin for segment in row.found if segment.kind == FREE)
        if one.by_rounding or n_free <= MOST_FREE * len(row.points):
            found = _first_told([(one.seen, row, False)], ends, regularities, tolerance)
    if found is None or not one.tells(found):
        return None
    if one.seen.apart > 1.0 and not found.errors_go_on:
        return None
    return _supposing(found, one)


def _supposing(found: Drawn, one: Supposition) -> Drawn:
    """The same, told by points with such errors."""
    other = None if found.otherwise is None else _supposing(found.otherwise, one)
    if one.precisions is not None:
        return replace(found, precisions=one.precisions, otherwise=other)
    return replace(found, supposed=one.seen.deviation, otherwise=other)


def drawn_between_corners(
    contour: Contour, regularities: Collection[str] = NAMES, *, holds_ends: bool = False
) -> list[Drawn]:
    """Other readings of noisy points: free-form runs from corner to corner beside long elements.

    None without corners, without free-form runs, and where no directions tell of a drawing; they
    are no better than others for that, which the curves decide (DRA-42). Arguments as of
    `as_drawn`.

    Examples
    --------
    >>> from shapespline.values import Contour
    >>> x = np.linspace(0, 100, 120)
    >>> wave = np.column_stack([x[::-1], 50 + 6 * np.sin(0.1 * x)])
    >>> side = np.linspace(0, 50, 50, endpoint=False)
    >>> left, base = np.column_stack([0 * side, 50 - side]), np.column_stack([x[1:-1], 0 * x[1:-1]])
    >>> points = np.concatenate([wave, left, base, np.column_stack([100 + 0 * side, side])])
    >>> points += np.random.default_rng(1).normal(0, 0.3, points.shape)
    >>> found = drawn_between_corners(Contour(points, closed=True))
    >>> sorted(type(part).__name__ for part in found[0].parts)
    ['DrawnLine', 'DrawnLine', 'DrawnLine', 'FreeRun']
    """
    if len(contour) < FEWEST_POINTS:
        return []
    seen = Observed.of(contour, None)
    ends = contour.points[[0, -1]] if holds_ends and not contour.closed else None
    readings: dict[tuple[Segment, ...], Drawn] = {}
    for row in rows_between_corners(seen, segmented(seen)):
        found = estimated(Model.of(seen, row, None, ends), row, np.inf)
        if found is None or not free_runs(found.model.row):
            continue
        best = settled(found, np.inf)
        own = best.model.row.found
        if own not in readings and tell_by_direction(best.model, best.found):
            readings[own] = _finished(best._replace(told=True), regularities, np.inf)
    return list(readings.values())


def _finished(best: Estimated, regularities: Collection[str], tolerance: float) -> Drawn:
    """Parts of an estimate, its points shared anew; it may keep some regularities only."""
    model, found = best.model, best.found
    if set(regularities) != set(NAMES):
        model = Model.of(model.seen, model.row, model, model.ends)
        found = Search(model, regularities, best.wide).run()
    return assembled(shared_anew(model), found, tolerance, best.told)


def _of_row(
    seen: Observed, row: Segments, ends: FloatArray | None, tolerance: float, *, whole: bool
) -> Estimated | None:
    """Lines, arcs and free-form runs of segments; None if these are none that were drawn.

    ``whole`` takes them only if none of them is contradicted by its points.
    """
    row = supported(row, seen.closed)
    if len(row.found) > max(MANY_ELEMENTS, len(seen.points) / POINTS_EACH):
        return None
    if seen.closed and len(row.found) == 1:  # an arc that is no circle
        return None
    model, n_few = Model.of(seen, row, None, ends), 0
    if (row := at_corners(model)) is not model.row:
        model = Model.of(seen, row, model, ends)
    while (fewer := without_few(model)) is not None and n_few < MOST_WRONG:
        model, n_few = Model.of(seen, fewer, model, ends), n_few + 1
    estimating = bool(np.isinf(tolerance))
    best = estimated(model, model.row, tolerance)
    as_read = best is not None and best.model.row is model.row
    if best is not None and estimating:
        best = settled(best, tolerance)
    for with_arcs, supposed in _with_arcs(model, estimating=estimating, whole=whole):
        other = estimated(model, with_arcs, tolerance, whole=supposed)
        if other is not None:
            as_it_is = other.model.row is with_arcs
            if estimating:
                other = settled(other, tolerance)
            if _is_taken(other, best, as_it_is=as_it_is):
                best, as_read = other, False
    if best is not None:
        best = settled(best, tolerance)
    for repeated_row in rows_repeated(seen, model.row if best is None else best.model.row):
        other = estimated(model, repeated_row, tolerance, whole=True)
        if other is None:
            continue
        if best is None or _is_preferred(other, best):
            best = other
            as_read = as_read or free_runs(repeated_row) <= free_runs(model.row)
            break
    if best is None or not (best.told or is_short(best.model, tolerance)):
        fewer = without_beginnings(row, seen)
        again = None if fewer is row else _of_row(seen, fewer, ends, tolerance, whole=whole)
        if again is not None or best is None or not is_plain(best.model):
            return again
        # Within a tolerance curves of fewer points may do.
        best = best._replace(told=bool(np.isinf(tolerance)))
    return None if whole and not as_read else begun(best, tolerance)


def _with_arcs(model: Model, *, estimating: bool, whole: bool) -> Iterator[tuple[Segments, bool]]:
    """Rows with arcs that the model's has not, and whether they are supposed and hold as a whole.

    None of a picture's row that is to hold as a ``whole``.
    """
    if not model.seen.pixel:
        for row in rows_with_fillets(model, estimating=estimating):
            yield row, False
    elif not whole:
        if (with_lines := with_missed_lines(model)) is not model.row:
            yield with_lines, False
        missed, more = (with_missed_arcs(model, supposed=supposed) for supposed in (False, True))
        if missed is not None:
            yield missed, False
        if more is not None and (missed is None or more.found != missed.found):
            yield more, True


def _is_taken(other: Estimated, best: Estimated | None, *, as_it_is: bool) -> bool:
    """Whether a row with more arcs is: ``as_it_is``, or what is left if nothing else is known.

    What is left in a picture is, instead of another rest, if both tell of a drawing.
    """
    if best is None:
        return True
    rests = bool(other.model.seen.pixel) and best.told and other.told
    return (as_it_is or rests) and _is_cheaper(other, best)


def _cheapest(best: Estimated, row: Segments) -> Estimated:
    """The reading of measured points that costs least; ``best`` is the one of a row.

    Compared with that of a row of more segments; from the cheaper one on step by step (DRA-38).
    """
    seen = best.model.seen
    finer = segmented(seen, prices=Prices(FINER * PRICE))
    if (finer.first, finer.found) != (row.first, row.found):
        other = _of_row(seen, finer, best.model.ends, np.inf, whole=False)
        best = best if other is None else min(best, other, key=lambda one: one.whole_cost)
    return descended(best)


def _is_cheaper(other: Estimated, best: Estimated) -> bool:
    """Whether it is told for less; what was left free costs nothing there."""
    more = free_runs(other.model.row) - free_runs(best.model.row)
    return more < 0 or (more == 0 and other.cost < best.cost)


def _is_preferred(alike: Estimated, best: Estimated) -> bool:
    """Whether parts that are read alike need fewer free-form runs, or are told for less."""
    more = free_runs(alike.model.row) - free_runs(best.model.row)
    return more < 0 or alike.cost + PRICE * FREE_PARAMETERS * more <= best.cost
