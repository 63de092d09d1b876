"""Nodes, where pieces of a fit meet: nearly common tangents made exactly common."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.values import SMOOTH_TURN, with_points

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray
    from shapespline.values import Piece

# Pieces whose directions differ by less, radians, may be made to meet in one tangent exactly: what
# the kernel has brought within the degree, and its rounding.
ALIGNED = 1.001 * SMOOTH_TURN


def aligned(pieces: Sequence[Piece], largest_move: float, *, closed: bool) -> tuple[Piece, ...]:
    """The pieces with nearly common tangents made exactly common.

    At a node that is smooth, to a degree, the control points beside it are moved onto one
    line: that of a straight piece, or the mean direction of two curves. Where that moves one by
    more than ``largest_move``, in data units, the node keeps its small turn.
    """
    points = np.concatenate([piece.control_points for piece in pieces])
    result = with_points(pieces, points)
    align(result, points, largest_move, closed=closed)
    return result


def align(
    pieces: Sequence[Piece], points: FloatArray, largest_move: float, *, closed: bool
) -> None:
    """The same in place: the control points of all pieces are those of one row, where they are."""
    _kernels.make_tangents_common(
        [piece.degree for piece in pieces],
        [len(piece.control_points) for piece in pieces],
        points,
        largest_move,
        ALIGNED,
        closed,
    )
