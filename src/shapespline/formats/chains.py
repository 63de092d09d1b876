"""Loose runs of pieces that meet end to end, put together to outlines."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import FormatError
from shapespline.formats.pieces import closed_up, size_of
from shapespline.geometry import backwards

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import IntArray
    from shapespline.values import Piece

# Of the size of the drawing: ends nearer than this are meant to be one point.
MEETING = 1e-6
# Squares of coordinates are finite.
LARGEST = 1e60


def chained(runs: Sequence[Sequence[Piece]]) -> list[list[Piece]]:
    """Outlines of runs of pieces that meet end to end, in the order and direction of the first.

    Where more than two ends meet nothing is joined. Ends that meet are made equal.

    Parameters
    ----------
    runs : sequence of sequences of Piece
        In any order and direction.

    Raises
    ------
    FormatError
        If a coordinate is too large to reckon with.

    Examples
    --------
    >>> from shapespline.formats import bezier
    >>> sides = [[bezier([(0, 0), (4, 0)])], [bezier([(0, 3), (0, 0)])], [bezier([(4, 0), (0, 3)])]]
    >>> [len(outline) for outline in chained(sides)]
    [3]
    """
    runs = [kept for kept in map(closed_up, runs) if kept]
    if not runs:
        return []
    partner = _partners(runs)
    done: set[int] = set()
    outlines: list[tuple[int, list[Piece]]] = []
    # Those with a loose end first, from there, forwards if possible; then those that close.
    begins, ends = np.flatnonzero(partner[::2] < 0) * 2, np.flatnonzero(partner[1::2] < 0) * 2 + 1
    for start in [*begins.tolist(), *ends.tolist(), *range(0, 2 * len(runs), 2)]:
        if start // 2 in done:
            continue
        chain: list[Piece] = []
        end, first = start, start // 2
        while end >= 0 and end // 2 not in done:
            done.add(end // 2)
            first = min(first, end // 2)
            run = runs[end // 2]
            chain += _met(chain, run if end % 2 == 0 else backwards(run))
            end = int(partner[end ^ 1])
        outlines.append((first, closed_up(chain)))
    return [outline for _, outline in sorted(outlines, key=lambda item: item[0])]


def _met(chain: list[Piece], run: Sequence[Piece]) -> list[Piece]:
    """A run that begins where the chain before it ends, exactly."""
    if not chain:
        return list(run)
    return [run[0].meeting(begin=chain[-1].control_points[-1]), *run[1:]]


def _partners(runs: Sequence[Sequence[Piece]]) -> IntArray:
    """For each end (2 i the start of run i, 2 i + 1 its end) the one other end there, or -1."""
    from scipy.spatial import cKDTree

    ends = np.array(
        [point for run in runs for point in (run[0].control_points[0], run[-1].control_points[-1])]
    )
    largest = float(np.abs(ends).max())
    if not largest <= LARGEST:
        raise FormatError(
            f"coordinates must not exceed {LARGEST:g} in magnitude, found {largest:g}; scale it"
        )
    near = MEETING * size_of([piece for run in runs for piece in run])
    pairs = cKDTree(ends).query_pairs(near, output_type="ndarray")
    partner = np.full(len(ends), -1)
    meeting = np.bincount(pairs.ravel(), minlength=len(ends))
    for one, other in pairs[(meeting[pairs] == 1).all(axis=1)]:
        partner[one], partner[other] = other, one
    return partner
