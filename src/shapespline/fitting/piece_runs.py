"""Pieces of an outline cut into runs, each with the data that it follows."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import bends_evenly
from shapespline.fitting.choose import ROUGH_PART
from shapespline.fitting.smooth import corners_of, row_from
from shapespline.geometry import nearest_points, turn_between
from shapespline.values import CORNER_TURN

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.fitting.problem import Problem
    from shapespline.typing import FloatArray
    from shapespline.values import Piece

# A corner of pieces may be so many tolerances away from that of the data: over that length the data
# are told to turn (PIE-30).
REACH = 8.0
# What turns by more is a corner even if the data tell none there (PIE-30).
MOST_NEEDLESS = np.radians(60.0)


@dataclass(frozen=True, eq=False)
class Run:
    """Pieces between two cuts and the data beside them.

    Attributes
    ----------
    pieces : tuple of Piece
    points : ndarray, shape (n, 2)
        The data, from the beginning of the first piece to the end of the last.
    n_turns : int
        How many joints inside turn like corners.
    end_turns : tuple of float
        Of the corners at both ends, radians; pi where the outline ends.
    is_held : bool
        Whether a tangent that was asked for is kept at an end.
    is_ring : bool
        Whether it is a closed outline on which no run ends.
    """

    pieces: tuple[Piece, ...]
    points: FloatArray
    n_turns: int
    end_turns: tuple[float, float]
    is_held: bool = False
    is_ring: bool = False

    @property
    def n_stored(self) -> int:
        """Points that the pieces store."""
        return sum(piece.n_stored for piece in self.pieces)

    @property
    def arms(self) -> tuple[FloatArray, FloatArray]:
        """Directions into the run at both ends, not normalised."""
        first, last = self.pieces[0].control_points, self.pieces[-1].control_points
        return first[1] - first[0], last[-2] - last[-1]

    @cached_property
    def is_rough(self) -> bool:
        """Whether pieces store many of the points, and these do not bend evenly."""
        few = self.n_stored <= ROUGH_PART * len(self.points)
        return not (few or bends_evenly(self.points))


class _Cut(NamedTuple):
    """Where a run ends: the piece and the point that begin there."""

    piece: int
    point: int


def runs_of(problem: Problem, pieces: tuple[Piece, ...]) -> list[Run]:
    """Runs of pieces of the whole outline, end to end, where some turn inside of one.

    They end where pieces and data have a corner, and where pieces have a sharp one. The first of a
    closed outline is the same whatever the order of the data. None if it is not sure which data
    belong to which run.
    """
    contour, n = problem.contour, len(pieces)
    joints = range(0 if contour.closed else 1, n)
    every = {k: abs(turn_between(pieces[k - 1], pieces[k])) for k in joints}
    turns = {k: turn for k, turn in every.items() if turn > CORNER_TURN}
    if not turns:
        return []
    cuts, first = _corners(problem, pieces, turns), _Cut(0, 0)
    if len(cuts) == len(turns):
        return []
    if not contour.closed:
        cuts.append(first)
    elif cuts:
        place = problem.normalized.new_index
        first = min(cuts, key=lambda cut: int(place[cut.point]))
    else:
        return [Run(pieces, contour.polyline, len(turns), (0.0, 0.0), is_ring=True)]
    row, size = row_from(contour, first.point), len(contour)
    cuts = sorted(
        _Cut((cut.piece - first.piece) % n, (cut.point - first.point) % size) for cut in cuts
    )
    cuts.append(_Cut(n, len(row) - 1))
    if any(after.point <= before.point for before, after in pairwise(cuts)):
        return []
    pieces = (*pieces[first.piece :], *pieces[: first.piece])
    turns = {(k - first.piece) % n: turn for k, turn in turns.items()}
    turning = sorted(turns)
    begins, ends = (tangent is not None for tangent in problem.request.constraints.tangents)
    runs = []
    for begin, end in pairwise(cuts):
        own, points = pieces[begin.piece : end.piece], row[begin.point : end.point + 1].copy()
        points[0], points[-1] = own[0].control_points[0], own[-1].control_points[-1]
        n_turns = bisect_left(turning, end.piece) - bisect_right(turning, begin.piece)
        end_turns = (turns.get(begin.piece, pi), turns.get(end.piece % n, pi))
        is_held = (begins and begin == cuts[0]) or (ends and end == cuts[-1])
        runs.append(Run(own, points, n_turns, end_turns, is_held))
    return runs


def _corners(problem: Problem, pieces: Sequence[Piece], turns: dict[int, float]) -> list[_Cut]:
    """Corners of both that are nearest to each other, and sharp ones of pieces.

    In canonical order: of data that lie on themselves several points are as near.
    """
    order = problem.normalized.order
    nodes = {k: pieces[k].control_points[0] for k in turns}
    data = problem.contour.points[order]
    near = nearest_points(data, np.array([*nodes.values()])).indices
    at = dict(zip(nodes, near.tolist(), strict=True))
    way = -1 if problem.normalized.reversed else 1
    joints = sorted(turns, key=lambda k: (at[k], way * k))
    corners, found = corners_of(problem), dict.fromkeys(joints, -1)
    if len(corners):
        places, points = np.array([nodes[k] for k in joints]), problem.contour.points[corners]
        to_node, distances = nearest_points(places, points)
        are_near = distances <= REACH * problem.tolerance
        both = are_near & (
            nearest_points(points, places).indices[to_node] == np.arange(len(corners))
        )
        for i in np.flatnonzero(both).tolist():
            found[joints[int(to_node[i])]] = int(corners[i])
    for k in joints:
        if found[k] < 0 and turns[k] > MOST_NEEDLESS:
            found[k] = int(order[at[k]])
    return [_Cut(k, point) for k, point in found.items() if point >= 0]
