"""Pieces that follow a smoothed outline, then fitted to the noisy points by least squares."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import NormalizedContour
from shapespline.engines.pieces.engine import PIECE_DEGREE
from shapespline.engines.pieces.problem import PiecesProblem
from shapespline.engines.pieces.search import BUDGETS, PiecesSolver, n_points_of
from shapespline.engines.pieces.tangents import aligned

if TYPE_CHECKING:
    from shapespline.monitor import Monitor
    from shapespline.typing import Effort, FloatArray, IntArray
    from shapespline.values import Contour, Piece

# Control points move by at most so many standard deviations of the noise to make a tangent exact.
LARGEST_MOVE = 0.1


def fit_observed(
    outline: Contour,
    observed: FloatArray,
    tolerance: float,
    noise: float,
    *,
    corners: IntArray | None,
    degree: int = 3,
    effort: Effort = "balanced",
    monitor: Monitor,
) -> tuple[Piece, ...]:
    """Pieces that follow a smoothed outline within a tolerance, then fitted to what was observed.

    Parameters
    ----------
    outline : Contour
        The smoothed outline, in the order and unit of a `NormalizedContour`.
    observed : ndarray, shape (n, 2)
        The noisy points, index for index.
    tolerance : float
        Between outline and pieces, before these are fitted to the points by least squares.
    noise : float
        Standard deviation of the points.
    corners : ndarray or None
        Indices of the corners that are kept; None lets the fit make and round them.
    degree, effort
        See `search_pieces`.
    monitor : Monitor
        May end the search; there may be no pieces then.
    """
    faithful = corners is not None
    solver = PiecesSolver(
        PiecesProblem(
            NormalizedContour.of_working(outline),
            tolerance,
            np.empty(0, dtype=np.int64) if corners is None else corners,
            np.zeros(len(outline), dtype=np.int64),
        ),
        min(degree, PIECE_DEGREE),
        faithful,
        faithful,
        monitor,
    )
    runs = [solver.run(tolerance, budget, observed, noise) for budget in BUDGETS[effort]]
    pieces = min(filter(None, runs), key=n_points_of, default=())
    if not (faithful and pieces):
        return pieces
    return aligned(pieces, LARGEST_MOVE * noise, closed=outline.closed)
