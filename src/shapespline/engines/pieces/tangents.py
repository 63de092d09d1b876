"""Nodes, where pieces of a fit meet: nearly common tangents made exactly common."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry import turn_between
from shapespline.values import SMOOTH_TURN

if TYPE_CHECKING:
    from collections.abc import Sequence

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
    result = [piece._replace(control_points=piece.control_points.copy()) for piece in pieces]
    for i in range(0 if closed else 1, len(result)):
        before, after = result[i - 1], result[i]
        if before is after or not abs(turn_between(before, after)) < ALIGNED:
            continue
        node, left, right = (
            after.control_points[0],
            before.control_points[-2],
            after.control_points[1],
        )
        u, v = node - left, right - node
        if (before.degree == 1 and after.degree == 1) or not (u.any() and v.any()):
            continue
        if before.degree == 1:
            direction = u / np.hypot(*u)
        elif after.degree == 1:
            direction = v / np.hypot(*v)
        else:
            mean = u / np.hypot(*u) + v / np.hypot(*v)
            direction = mean / np.hypot(*mean)
        moved_left = node - (u @ direction) * direction
        moved_right = node + (v @ direction) * direction
        if max(np.hypot(*(moved_left - left)), np.hypot(*(moved_right - right))) > largest_move:
            continue
        if before.degree > 1:
            before.control_points[-2] = moved_left
        if after.degree > 1:
            after.control_points[1] = moved_right
    return tuple(result)
