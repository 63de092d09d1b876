"""The pieces engine: lines, Beziers and small splines between nodes, as few points as possible.

An outline is cut into pieces at nodes. How far a piece of each kind extends within the tolerance
is found by fitting, a shortest path through a feasibility graph chooses the nodes, then the nodes
become unknowns and moves on windows of neighbours take away what is not needed. The loops are one
kernel call; this module decides what it may do. Who asks verifies what it did.
"""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.pieces.constraints import pinned_exactly
from shapespline.engines.pieces.end_tangents import turned_exactly
from shapespline.engines.pieces.search import BUDGETS, PiecesSolver, n_points_of
from shapespline.engines.pieces.tangents import align
from shapespline.geometry import backwards
from shapespline.values import with_points

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.engines.pieces.constraints import Constraints
    from shapespline.engines.pieces.problem import PiecesProblem
    from shapespline.engines.pieces.search import SearchBudget
    from shapespline.monitor import Monitor
    from shapespline.typing import Effort
    from shapespline.values import Contour, Piece

# Parts of the tolerance that the search aims at, one after another until the promise is kept.
TOLERANCE_FACTORS = (0.999, 0.97, 0.9, 0.7)
# Control points move by at most this part of the tolerance to make a tangent exact. That moves a
# cubic by 4/9 of it at most, less than what the first tolerance factor leaves.
LARGEST_MOVE = 0.002
# Pieces are at most cubic; higher degrees are made by elevation.
PIECE_DEGREE = 3


def search_pieces(
    problem: PiecesProblem,
    tolerance_factor: float,
    *,
    degree: int,
    effort: Effort,
    free: bool,
    monitor: Monitor,
) -> tuple[Piece, ...]:
    """The fewest points that a search of some effort finds, none if it was ended before.

    Parameters
    ----------
    problem : PiecesProblem
        Most often without the points that a search does not need (`PiecesProblem.thinned`).
    tolerance_factor : float
        Part of the tolerance that the search aims at.
    degree : int
        Pieces have at most this degree, and at most 3.
    effort : {"fast", "balanced", "smallest"}
        How many candidate nodes, moves and runs are tried.
    free : bool
        Whether corners may be rounded and made: the fewest points. Else they are kept, and
        everything else is tangent-continuous.
    monitor : Monitor
        Hears of the progress and may end the search.

    Returns
    -------
    tuple of Piece
        In the unit and order of the problem; see `in_data`.

    Examples
    --------
    >>> import numpy as np
    >>> from shapespline import Contour
    >>> from shapespline.engines.pieces import PiecesProblem
    >>> from shapespline.monitor import Monitor
    >>> side = np.linspace(0, 1, 20, endpoint=False)
    >>> x = np.concatenate([side, 1 + 0 * side, 1 - side, 0 * side])
    >>> square = Contour(np.column_stack([x, np.roll(x, 20)]), closed=True)
    >>> problem = PiecesProblem.of(square, 0.01, "auto")
    >>> pieces = search_pieces(
    ...     problem, 0.999, degree=3, effort="balanced", free=False, monitor=Monitor()
    ... )
    >>> [piece.kind for piece in pieces]
    ['line', 'line', 'line', 'line']
    """
    solver = PiecesSolver(problem, min(degree, PIECE_DEGREE), not free, not free, monitor)
    # Free of rules, sharp corners are still often the cheapest: both are tried.
    both = free and len(problem.corners) > 0
    solvers = [solver, solver._replace(keep_corners=True)] if both else [solver]
    return _smallest(solvers, tolerance_factor * problem.tolerance, BUDGETS[effort], monitor)


def _smallest(
    solvers: Sequence[PiecesSolver],
    tolerance: float,
    budgets: Sequence[SearchBudget],
    monitor: Monitor,
) -> tuple[Piece, ...]:
    """The best of all runs before the monitor ended them, empty if there was none."""
    best: tuple[Piece, ...] = ()
    for budget, solver in product(budgets, solvers):
        if monitor.stage(n_points_of(best)):
            break
        found = solver.run(tolerance, budget)
        if found and (not best or n_points_of(found) < n_points_of(best)):
            best = found
    return best


def in_data(
    problem: PiecesProblem, pieces: tuple[Piece, ...], contour: Contour, constraints: Constraints
) -> tuple[Piece, ...]:
    """Pieces of a problem where its data are and the way they run, to the bit where they are held.

    ``constraints`` are by the indices of the data. Tangents that nearly agree are made to agree.
    """
    normalized = problem.normalized
    # In canonical order: two joints of a parabola share a control point.
    points = normalized.restored_points(np.concatenate([p.control_points for p in pieces]))
    placed = with_points(pieces, points)
    pinned_exactly(placed, contour.points[constraints.through])
    if constraints.ends and not contour.closed:
        # Each to its own: where they meet both are the nearest.
        first, last = (-1, 0) if normalized.reversed else (0, -1)
        placed[0].control_points[0] = contour.points[first]
        placed[-1].control_points[-1] = contour.points[last]
    largest_move = LARGEST_MOVE * problem.tolerance / normalized.scale
    align(placed, points, largest_move, closed=contour.closed)
    restored = backwards(placed) if normalized.reversed else placed
    turned_exactly(restored, constraints.tangents)
    return restored
