"""What is left where curves do not pay: lines through some of the points, at last through all."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.analysis import LEAST_TURN
from shapespline.geometry import turn_between
from shapespline.values import Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.engines.pieces.problem import PiecesProblem
    from shapespline.values import Contour
# A polyline whose joints turn less than corners for more than this part follows a curve.
GENTLE_PART = 0.5


def _drawn_with_lines(lines: Sequence[Piece], closed: bool) -> bool:
    """Whether lines meet in corners everywhere, not in the facets of a curve."""
    turns = [abs(turn_between(before, after)) for before, after in pairwise(lines)]
    if closed:
        turns.append(abs(turn_between(lines[-1], lines[0])))
    return min(turns, default=np.pi) >= LEAST_TURN


def _chords_found(outline: PiecesProblem) -> tuple[int, bool]:
    """How many points a polyline through some of the data stores; whether it follows a curve.

    A first guess: most joints of a polyline along a curve turn less than corners.
    """
    contour = outline.frame.contour
    chosen = _kernels.thinned(contour.polyline, outline.tolerance, np.inf, None)
    x, y = np.diff(contour.polyline[chosen], axis=0).T
    turns = np.arctan2(x[:-1] * y[1:] - y[:-1] * x[1:], x[:-1] * x[1:] + y[:-1] * y[1:])
    gentle = np.count_nonzero(np.abs(turns) < LEAST_TURN)
    return len(chosen) - contour.closed, bool(gentle > GENTLE_PART * len(turns))


def through_all(contour: Contour) -> tuple[Piece, ...]:
    """A line from each point to the next; it crosses itself only where the data do."""
    knots, polyline = np.array([0.0, 0.0, 1.0, 1.0]), contour.polyline
    return tuple(Piece("line", 1, knots, polyline[i : i + 2]) for i in range(len(polyline) - 1))
