"""One run of the search for pieces: its arrays in, pieces with exact tangents out."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.analysis import LEAST_TURN
from shapespline.engines.pieces.end_tangents import extended, without_extensions
from shapespline.values import Piece, on_grid

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.engines.pieces.problem import PiecesProblem
    from shapespline.monitor import Monitor
    from shapespline.typing import Effort, FloatArray

# Candidate nodes on a whole outline, whatever the stride (PIE-23).
LEAST_CANDIDATES, MOST_CANDIDATES = 64, 1000
# A piece shorter than this part of the curve is degenerate: rounding made it.
DEGENERATE_PART = 1e-12
# The search gives up a corner that the fit turns by less than this part of `LEAST_TURN`.
RELEASE = 0.7
# These codes tell the kernel about the joint at a point; they add up.
CORNER, PINNED, AFTER_EXTENSION, BEFORE_EXTENSION = 1, 2, 4, 8


class SearchBudget(NamedTuple):
    """What one run of the kernel may do.

    ``stride`` is the distance of candidate nodes in points, but more of them stand where the
    polyline through them would leave the data by ``resolution`` tolerances. How far sections reach
    is found from one in ``every`` of them; ``passes`` is how often moves are tried. A ``thorough``
    search tries moves that save more points, too, takes more neighbours along, and tries all moves
    again where smooth joints took points.
    """

    stride: int
    resolution: float
    every: int
    passes: int
    thorough: bool


# The reduction is a greedy search, and where it starts is worth some percent: the best of several
# runs on different candidates is taken (PIE-01).
BUDGETS: dict[Effort, tuple[SearchBudget, ...]] = {
    "fast": (SearchBudget(12, 0.8, 5, 1, thorough=False),),
    "balanced": (SearchBudget(12, 0.4, 1, 6, thorough=True),),
    "smallest": tuple(
        SearchBudget(stride, part, 1, 6, thorough=True)
        for stride in (3, 6, 12)
        for part in (0.15, 0.25, 0.4)
    ),
}


class PiecesSolver(NamedTuple):
    """The search for pieces of one problem: what stays the same over its runs.

    Corners are candidate nodes always and nodes if they are kept; ``smooth`` makes other joints
    tangent; where the data have a low turn it may spend some more points on that.
    """

    problem: PiecesProblem
    largest_degree: int
    keep_corners: bool
    smooth: bool
    monitor: Monitor

    def run(
        self,
        tolerance: float,
        budget: SearchBudget,
        observed: FloatArray | None = None,
        noise: float = 0.0,
    ) -> tuple[Piece, ...]:
        """One run of the kernel, in the end a least-squares fit to what was observed.

        No pieces if it was ended before there were any.
        """
        outline = extended(self.problem)
        contour = outline.normalized.contour
        n = len(contour)
        joints, forced = np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64)
        forced[outline.corners] = 1
        if self.keep_corners:
            joints[outline.corners] += CORNER
        joints[outline.constraints.through] += PINNED
        joints[outline.constraints.after_extension] += AFTER_EXTENSION
        joints[outline.constraints.before_extension] += BEFORE_EXTENSION
        forced[joints > 0] = 1
        settings = _kernels.PiecesSettings(
            tolerance=tolerance,
            largest_degree=self.largest_degree,
            smooth=self.smooth,
            ends_fixed=outline.constraints.ends,
            least_corner=RELEASE * LEAST_TURN,
            budget=_kernels.PiecesBudget(
                stride=max(min(budget.stride, n // LEAST_CANDIDATES), n // MOST_CANDIDATES, 1),
                resolution=budget.resolution * tolerance,
                every=budget.every,
                passes=budget.passes,
                thorough=budget.thorough,
            ),
        )
        found = _kernels.fit_pieces(
            _kernels.PiecesOutline(
                contour.points, contour.closed, joints, forced, outline.low_turn
            ),
            settings,
            self.monitor.ends,
            observed,
            noise,
        )
        return without_extensions(_unpacked(found), self.problem)


def n_points_of(pieces: Sequence[Piece]) -> int:
    """Points that the pieces of a closed curve store; an open one has one more."""
    return sum(len(piece.control_points) - 1 for piece in pieces)


def _unpacked(found: _kernels.PiecesFound) -> tuple[Piece, ...]:
    """Pieces of what the kernel found."""
    degrees, counts = found.degrees, found.counts
    points = np.empty((sum(counts), 2))
    knots = np.empty(len(points) + sum(degrees) + len(degrees))
    found.write(knots, points)
    knots = on_grid(knots)
    pieces = []
    k = m = 0
    for degree, count in zip(degrees, counts, strict=True):
        inner = count - degree - 1
        kind = "line" if degree == 1 else "bezier" if inner == 0 else "spline"
        pieces.append(Piece(kind, degree, knots[k : k + count + degree + 1], points[m : m + count]))
        k, m = k + count + degree + 1, m + count
    return without_degenerate(pieces)


def without_degenerate(pieces: list[Piece]) -> tuple[Piece, ...]:
    """The pieces but for those of next to no length; their neighbours meet, the ends stay."""
    if not pieces:
        return ()
    lengths = _kernels.polygon_lengths(
        [len(piece.control_points) for piece in pieces],
        np.concatenate([piece.control_points for piece in pieces]),
    )
    least = DEGENERATE_PART * sum(lengths)
    kept = [p for p, length in zip(pieces, lengths, strict=True) if length > least]
    if len(kept) == len(pieces) or not kept:
        return tuple(kept)
    kept = [piece._replace(control_points=piece.control_points.copy()) for piece in kept]
    kept[0].control_points[0] = pieces[0].control_points[0]
    kept[-1].control_points[-1] = pieces[-1].control_points[-1]
    for before, after in pairwise(kept):
        after.control_points[0] = before.control_points[-1]
    return tuple(kept)
