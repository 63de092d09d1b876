"""What an outline is read as: as exact as its source is, or less so where that is shorter."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.engines.drawn.judgement import is_enough, share
from shapespline.engines.drawn.missed_arcs import fillets_of, with_missed_arcs
from shapespline.engines.drawn.missed_lines import with_missed_lines
from shapespline.engines.drawn.model import Model
from shapespline.engines.drawn.segments import ARC, FREE, LINE, segmented
from shapespline.engines.drawn.supposed import NEARLY
from shapespline.engines.drawn.whole_circle import ROUND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.engines.drawn.observed import Observed
    from shapespline.engines.drawn.segments import Segments

# A picture is taken for drawn so many times less exactly than others where that saves so many
# parameters a pixel: some renderers draw curves as polygons. Never by more than that part of a
# pixel in the mean: not one of one bit. A free-form run counts once for so many pixels (DRA-13).
# Where lines and arcs alone are left, two of them and that part of all are enough (DRA-22).
ROUGH, ROUGHEST, SAVED, LONG = 3.0, 0.3, 0.03, 25.0
LEAST_SAVED, SAVED_PART = 6.0, 0.1
# Where a tolerance or that part leaves room for less, as much as they do, but at least so much
# (DRA-55).
LEAST_ROUGH = 1.2
# Nobody draws arcs of so many times the extent of an outline: errors bend its edges (DRA-54).
IMMENSE = 20.0
# What such a telling holds in part only gives way to the exact one, unless that is so many times
# longer, as chords of curves are (DRA-29).
CHORDS = 1.33
# Arcs between lines that a picture shows are no errors where there is one for so many of the lines,
# or more (DRA-64).
OFTEN = 0.5
# Part of exact points that lines and arcs make up where the rest may be such (DRA-49).
MOST_EXACT = 0.8


def rough(seen: Observed, tolerance: float) -> Observed | None:
    """A picture's outline taken for less exact, where a tolerance leaves room for that."""
    room = min(tolerance, ROUGHEST * seen.pixel)
    factor = min(ROUGH, room / (ROUND * seen.largest_deviation))
    return seen.rougher(factor) if seen.pixel and factor >= LEAST_ROUGH else None


def read_as(
    seen: Observed, row: Segments, tolerance: float
) -> Iterator[tuple[Observed, Segments, bool]]:
    """The outline as these segments, or taken for less exact where that is shorter or straighter.

    It has to be much shorter; what is a little shorter counts if it holds as a whole: lines through
    a bend are, too. What tells no drawing may do so if it is taken for less exact: its elements are
    estimated anew with larger errors, then looked for with these, then with errors that are slow,
    too.
    """
    less = rough(seen, tolerance)
    if less is None:
        yield from _nearly_exact(seen, row)
        yield seen, row, False
        return
    again = segmented(less, row) if row.n_parameters(LONG * seen.pixel) >= LEAST_SAVED else row
    if _is_shorter(again, row, seen.pixel) or _is_straighter(again, row, seen):
        long = LONG * seen.pixel
        fillets = _with_fillets(seen, row)
        if _has_fillets_more(fillets, again):
            yield seen, fillets, True
        if row.n_parameters(long) <= CHORDS * again.n_parameters(long):
            yield less, with_missed_lines(Model.of(less, again)), True
            yield seen, row, False
    else:
        yield seen, row, False
        if not is_enough(row):
            return
        yield less, row, False
    yield less, again, False
    slow = less.slow()
    yield slow, segmented(slow, row), False


def _nearly_exact(seen: Observed, row: Segments) -> Iterator[tuple[Observed, Segments, bool]]:
    """Exact points that are nearly so, if all of them then are lines and arcs.

    Few points of an arc, some of which lie beside a node, may be told by nothing else. Lines and
    arcs that no exact point contradicts come first.
    """
    if not seen.exact or share(row) < MOST_EXACT:
        return
    if share(row) == 1.0:
        yield seen, row, True
    nearly = seen.less_exact(NEARLY * seen.deviation, exact=True)
    again = segmented(nearly)
    if share(again) == 1.0:
        yield nearly, again, True


def _with_fillets(seen: Observed, row: Segments) -> Segments:
    """Lines and arcs, some of these between two lines, with other arcs that its points tell."""
    if not fillets_of(row) or any(segment.kind == FREE for segment in row.found):
        return row
    return with_missed_arcs(Model.of(seen, row)) or row


def _has_fillets_more(row: Segments, again: Segments) -> bool:
    """Whether all that lines and arcs have more than others is arcs, at every other corner or more.

    Chords of curves are lines, and parts of one arc lie side by side; errors round few corners.
    """
    (lines, fillets, others), its = _told(row), _told(again)
    is_more = fillets > its[1] and lines <= its[0] and others <= its[2]
    is_many = fillets >= OFTEN * lines
    return is_more and is_many and all(segment.kind != FREE for segment in row.found)


def _told(row: Segments) -> tuple[int, int, int]:
    """How many lines, arcs between two lines, and other arcs there are."""
    kinds, n_fillets = [segment.kind for segment in row.found], len(fillets_of(row))
    return kinds.count(LINE), n_fillets, kinds.count(ARC) - n_fillets


def _is_straighter(again: Segments, row: Segments, seen: Observed) -> bool:
    """Whether no more lines and arcs tell what is arcs of immense radius otherwise, by errors."""
    if len(again.found) > len(row.found) or any(kind == FREE for *_, kind in again.found):
        return False
    model, again_model = Model.of(seen, row), Model.of(seen, again)
    return _n_immense(model) > _n_immense(again_model)


def _n_immense(model: Model) -> int:
    """How many arcs have a radius that nobody draws."""
    largest = IMMENSE * model.extent
    return sum(model.kind(k) == ARC and model.x[o + 2] > largest for k, o in model.at.items())


def _is_shorter(again: Segments, row: Segments, pixel: float) -> bool:
    """Whether segments are so much shorter to tell than others that errors are behind these."""
    told = row.n_parameters(LONG * pixel)
    saved = told - again.n_parameters(LONG * pixel)
    if all(segment.kind != FREE for segment in again.found):
        return saved >= max(LEAST_SAVED, SAVED_PART * told)
    return saved > SAVED * row.stations[-1] / pixel
