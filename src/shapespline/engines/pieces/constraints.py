"""What a fit must keep exactly: ends, tangents there, points that the curve goes through."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Piece

_NONE: IntArray = np.empty(0, dtype=np.int64)
_NONE.setflags(write=False)


class Constraints(NamedTuple):
    """What a fit must keep exactly.

    ``ends`` says whether an open curve begins and ends in the first and last point; ``through`` are
    indices of points that are nodes and stay where they are; ``tangents`` are directions at the
    first and the last point, None where they are free. Once virtual end extensions stand for them,
    ``after_extension`` and ``before_extension`` are the points where these end and begin.
    """

    ends: bool = False
    through: IntArray = _NONE
    tangents: tuple[FloatArray | None, FloatArray | None] = (None, None)
    after_extension: IntArray = _NONE
    before_extension: IntArray = _NONE

    @property
    def anything(self) -> bool:
        """Whether more is kept than ends."""
        return len(self.through) > 0 or any(t is not None for t in self.tangents)


def pinned_exactly(pieces: tuple[Piece, ...], points: FloatArray) -> None:
    """Moves the nodes nearest to some points onto them, which undoes rounding."""
    if not len(points):
        return
    nodes = np.array([piece.control_points[0] for piece in pieces])
    nodes = np.concatenate([nodes, pieces[-1].control_points[-1:]])
    for point in points:
        distances_sq = ((nodes - point) ** 2).sum(axis=1)
        for i in np.flatnonzero(distances_sq == distances_sq.min()):
            if i < len(pieces):
                pieces[i].control_points[0] = point
            if i > 0:
                pieces[i - 1].control_points[-1] = point
