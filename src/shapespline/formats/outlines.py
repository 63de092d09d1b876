"""Pieces that readers make, and outlines put together from them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.drawing import Piece
from shapespline.joining import backwards

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import ArrayLike, IntArray

# Ends closer than this part of an outline's size are the same point, written with few digits or
# reached over many additions.
SAME_END = 1e-9
# Ends of entities closer than this part of the whole drawing are meant to meet.
MEETING = 1e-6


def bezier(points: ArrayLike) -> Piece:
    """A line or Bezier of its control points, shape (degree + 1, 2)."""
    control_points = np.array(points, dtype=np.float64)
    degree = len(control_points) - 1
    kind = "line" if degree == 1 else "bezier"
    return Piece(kind, degree, np.repeat([0.0, 1.0], degree + 1), control_points)


def closed_up(pieces: Sequence[Piece]) -> list[Piece]:
    """The pieces but for those without extent; ends that all but meet are made to meet."""
    kept = [piece for piece in pieces if np.ptp(piece.control_points, axis=0).any()]
    if not kept:
        return []
    near = SAME_END * size_of(kept)
    while len(kept) > 1 and _reach(kept[-1]) <= near:  # such as the line that closes a path
        kept.pop()
    gap = kept[-1].control_points[-1] - kept[0].control_points[0]
    if (len(kept) > 1 or kept[0].degree > 1) and np.hypot(*gap) <= near:
        last = kept[-1].control_points.copy()
        last[-1] = kept[0].control_points[0]
        kept[-1] = kept[-1]._replace(control_points=last)
    return kept


def size_of(pieces: Sequence[Piece]) -> float:
    """Diagonal of the box around all control points."""
    points = np.concatenate([piece.control_points for piece in pieces])
    return float(np.hypot(*np.ptp(points, axis=0)))


def _reach(piece: Piece) -> float:
    return float(np.hypot(*np.ptp(piece.control_points, axis=0)))


def chained(runs: Sequence[Sequence[Piece]]) -> list[list[Piece]]:
    """Outlines of runs of pieces that meet end to end, in the order and direction of the first.

    Where more than two ends meet nothing is joined. Ends that meet are made equal.

    Parameters
    ----------
    runs : sequence of sequences of Piece
        In any order and direction.

    Examples
    --------
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
    points = run[0].control_points.copy()
    points[0] = chain[-1].control_points[-1]
    return [run[0]._replace(control_points=points), *run[1:]]


def _partners(runs: Sequence[Sequence[Piece]]) -> IntArray:
    """For each end (2 i the start of run i, 2 i + 1 its end) the one other end there, or -1."""
    from scipy.spatial import cKDTree

    ends = np.array(
        [point for run in runs for point in (run[0].control_points[0], run[-1].control_points[-1])]
    )
    near = MEETING * size_of([piece for run in runs for piece in run])
    pairs = cKDTree(ends).query_pairs(near, output_type="ndarray")
    partner = np.full(len(ends), -1)
    meeting = np.bincount(pairs.ravel(), minlength=len(ends))
    for one, other in pairs[(meeting[pairs] == 1).all(axis=1)]:
        partner[one], partner[other] = other, one
    return partner
