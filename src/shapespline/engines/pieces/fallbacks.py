"""What is left where curves do not pay: lines through some of the points, at last through all."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.analysis import FEWEST_STRAIGHT, LEAST_TURN, STRAIGHT_PART
from shapespline.engines.pieces.search import BUDGETS, PiecesSolver, without_degenerate
from shapespline.geometry import PointsByX, turns_of
from shapespline.monitor import Monitor
from shapespline.values import Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.engines.pieces.problem import PiecesProblem
    from shapespline.values import Contour

# A polyline whose joints turn less than corners for more than this part follows a curve (PIE-23).
LOW_TURN_PART = 0.5
# Of the joints between lines that stand for a curve so many turn less than corners (FIT-09).
FACETS_PART = 0.25


class Chords(NamedTuple):
    """A polyline through some of the data, found in one pass.

    ``n_points`` is what it stores, ``follow_curve`` whether most of its joints turn less than
    corners.
    """

    n_points: int
    follow_curve: bool


def chords_found(problem: PiecesProblem) -> Chords:
    """A first guess of what lines would take (cone intersection, Williams 1978)."""
    contour = problem.normalized.contour
    chosen = _kernels.thinned(contour.polyline, problem.tolerance, np.inf, None)
    x, y = np.diff(contour.polyline[chosen], axis=0).T
    turns = np.arctan2(x[:-1] * y[1:] - y[:-1] * x[1:], x[:-1] * x[1:] + y[:-1] * y[1:])
    n_low = np.count_nonzero(np.abs(turns) < LEAST_TURN)
    return Chords(len(chosen) - contour.closed, bool(n_low > LOW_TURN_PART * len(turns)))


def search_lines(problem: PiecesProblem, tolerance_factor: float) -> tuple[Piece, ...]:
    """Lines alone, every point a candidate node, in the unit and order of the problem.

    The search aims at ``tolerance_factor`` of the tolerance.
    """
    constraints = problem.constraints._replace(tangents=(None, None))
    straight = problem._replace(constraints=constraints)
    return PiecesSolver(straight, 1, False, False, Monitor()).run(
        tolerance_factor * problem.tolerance, BUDGETS["fast"][0]._replace(stride=1)
    )


def through_all(contour: Contour) -> tuple[Piece, ...]:
    """A line from each point to the next; it crosses itself only where the data do."""
    knots, polyline = np.array([0.0, 0.0, 1.0, 1.0]), contour.polyline
    lines = [Piece("line", 1, knots, polyline[i : i + 2]) for i in range(len(polyline) - 1)]
    return without_degenerate(lines)


def drawn_with_lines(lines: Sequence[Piece], closed: bool) -> bool:
    """Whether lines meet in corners everywhere, not in the facets of a curve."""
    return min(map(abs, turns_of(lines, closed)), default=np.pi) >= LEAST_TURN


def in_facets(pieces: Sequence[Piece], closed: bool) -> bool:
    """Whether lines stand for a curve: many of the joints between them turn less than corners."""
    if any(piece.degree > 1 for piece in pieces):
        return False
    turns = np.abs(turns_of(pieces, closed))
    n_low = np.count_nonzero(turns < LEAST_TURN)
    return bool(len(turns) and n_low >= FACETS_PART * len(turns))


def drawn_straight(piece: Piece, points: PointsByX, tolerance: float) -> bool:
    """Whether the data along a line are straight themselves, by far more than the tolerance."""
    if piece.degree > 1:
        return False
    begin, side = piece.control_points[0], np.diff(piece.control_points, axis=0)[0]
    length = float(np.hypot(*side))
    low, high = sorted(piece.control_points[:, 0].tolist())
    near = points.between(low - tolerance, high + tolerance) - begin
    along, across = near @ side / length**2, near @ np.array([-side[1], side[0]]) / length
    beside = (np.abs(along - 0.5) < 0.4) & (np.abs(across) <= tolerance)
    if np.count_nonzero(beside) < FEWEST_STRAIGHT:
        return False
    # They may lie on another line, within the tolerance.
    tilt = np.polynomial.Polynomial.fit(along[beside], across[beside], 1)
    return float(np.ptp(across[beside] - tilt(along[beside]))) <= STRAIGHT_PART * tolerance
