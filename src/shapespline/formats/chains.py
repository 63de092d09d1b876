"""Loose runs of pieces that meet end to end, put together to outlines."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.errors import FormatError, SkippedContentWarning, caller_level
from shapespline.formats.file_order import loops_in_order
from shapespline.formats.gaps import say_of_gaps
from shapespline.formats.junctions import joints
from shapespline.formats.pieces import closed_up, ring, size_of
from shapespline.formats.repeats import repeated
from shapespline.geometry import backwards

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.values import Piece

# Of the size of the drawing: ends nearer than this are meant to be one point (FMT-13).
MEETING = 2e-5
# Squares of coordinates are finite.
LARGEST = 1e60


def chained(runs: Sequence[Sequence[Piece]], name: str) -> list[Sequence[Piece]]:
    """Outlines of runs of pieces that meet end to end, in the order and direction of the first.

    Ends that meet are made equal. Where more than two meet, outlines that close come first (see
    `joints`); what closes nothing is not joined there. A run that repeats another, either way
    round, is used where it closes an outline of its own, such as one of two areas that share a
    side, and left out otherwise.

    Parameters
    ----------
    runs : sequence of sequences of Piece
        In any order and direction.
    name : str
        Of the file, for warnings.

    Raises
    ------
    FormatError
        If a coordinate is too large to reckon with.

    Warns
    -----
    SkippedContentWarning
        If runs that repeat others were left out.
    OpenOutlinesWarning
        If ends almost meet.

    Examples
    --------
    >>> from shapespline.formats import bezier
    >>> sides = [[bezier([(0, 0), (4, 0)])], [bezier([(0, 3), (0, 0)])], [bezier([(4, 0), (0, 3)])]]
    >>> [len(outline) for outline in chained(sides, "triangle.dxf")]
    [3]
    """
    given = [kept for kept in map(closed_up, runs) if kept]
    if not given:
        return []
    pieces = [piece for run in given for piece in run]
    largest = max(float(np.abs(piece.control_points).max()) for piece in pieces)
    if not largest <= LARGEST:
        raise FormatError(
            f"coordinates must not exceed {LARGEST:g} in magnitude, found {largest:g}; scale it"
        )
    size = size_of(pieces)
    near = MEETING * size
    loops = loops_in_order(given, near)
    drawn = [run for loop in loops for run in loop]
    order = drawn + sorted(set(range(len(given))).difference(drawn))
    # What stands in a loop is what others repeat.
    first = repeated([given[run] for run in order], MEETING)
    alone = [_Chain([run], pieces) for run, pieces in enumerate(given)]
    rest = range(len(drawn), len(order))
    chains = [_end_to_end([alone[run] for run in loop], closed=True) for loop in loops]
    chains += _joined([alone[order[place]] for place in rest if first[place] == place], near)
    shared = {run for chain in chains if chain.is_closed for run in chain.runs}
    again = [place for place in rest if first[place] < place and order[first[place]] in shared]
    chains = _with_shared_sides(chains, [alone[order[place]] for place in again], near)
    left_out = len(given) - sum(len(chain.runs) for chain in chains)
    if left_out:
        _say_of_repeated(left_out, name)
    say_of_gaps([chain.pieces for chain in chains if not chain.is_closed], near, size, name)
    return [chain.pieces for chain in sorted(chains, key=lambda chain: min(chain.runs))]


def wire(runs: Sequence[Sequence[Piece]]) -> list[Sequence[Piece]]:
    """Outlines of runs that are known to be one: one, or what hangs together."""
    alone = [_Chain([], kept) for kept in map(closed_up, runs) if kept]
    pieces = [piece for chain in alone for piece in chain.pieces]
    return [chain.pieces for chain in _joined(alone, MEETING * size_of(pieces))] if alone else []


class _Chain(NamedTuple):
    """Runs, by their number in the file, and the pieces that they are end to end."""

    runs: Sequence[int]
    pieces: Sequence[Piece]

    @property
    def is_closed(self) -> bool:
        return bool((self.pieces[0].control_points[0] == self.pieces[-1].control_points[-1]).all())


def _joined(chains: Sequence[_Chain], near: float) -> list[_Chain]:
    """The same with those that meet made one."""
    if not chains:
        return []
    partner = joints([chain.pieces for chain in chains], near)
    done: set[int] = set()
    found: list[_Chain] = []
    # Those with a loose end first, from there, forwards if possible; then those that close.
    begins, ends = np.flatnonzero(partner[::2] < 0) * 2, np.flatnonzero(partner[1::2] < 0) * 2 + 1
    for start in [*begins.tolist(), *ends.tolist(), *range(0, 2 * len(chains), 2)]:
        if start // 2 in done:
            continue
        parts: list[_Chain] = []
        end = start
        while end >= 0 and end // 2 not in done:
            done.add(end // 2)
            runs, pieces = chains[end // 2]
            parts.append(_Chain(runs, pieces if end % 2 == 0 else backwards(pieces)))
            end = int(partner[end ^ 1])
        found.append(_end_to_end(parts, closed=end >= 0))
    return found


def _end_to_end(parts: Sequence[_Chain], *, closed: bool) -> _Chain:
    """Chains that follow each other as one, each beginning where the one before ends, exactly."""
    pieces: list[Piece] = []
    for part in parts:
        begin = pieces[-1].control_points[-1] if pieces else None
        pieces += [part.pieces[0].meeting(begin=begin), *part.pieces[1:]]
    pieces = closed_up(ring(pieces) if closed else pieces)
    return _Chain([run for part in parts for run in part.runs], pieces)


def _with_shared_sides(chains: list[_Chain], again: list[_Chain], near: float) -> list[_Chain]:
    """Chains with what runs that repeat sides of closed ones close, each outline once."""
    closed = [chain for chain in chains if chain.is_closed]
    loose = [chain for chain in chains if not chain.is_closed]
    if again:
        closed += [chain for chain in _joined([*loose, *again], near) if chain.is_closed]
        used = {run for chain in closed for run in chain.runs}
        loose = [chain for chain in loose if used.isdisjoint(chain.runs)]
    found = closed + loose
    same = repeated([chain.pieces for chain in found], MEETING)
    return [chain for number, chain in enumerate(found) if same[number] == number]


def _say_of_repeated(count: int, name: str) -> None:
    which = (
        "an entity that repeats another was"
        if count == 1
        else (f"{count} entities that repeat others were")
    )
    warnings.warn(f"{name}: {which} left out", SkippedContentWarning, stacklevel=caller_level())
