"""Piece: a line, a Bezier or a spline, end to end with its neighbours."""

from __future__ import annotations

from itertools import pairwise, starmap
from math import dist
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import FloatArray


# A joint that turns by no more is smooth to the eye and to a milling machine; a rounding above the
# degree that fits promise.
CORNER_TURN = np.radians(1.01)


class Piece(NamedTuple):
    """A line, a Bezier or a spline, end to end with its neighbours."""

    kind: str
    degree: int
    knots: FloatArray
    control_points: FloatArray

    @property
    def polygon_length(self) -> float:
        """Length of the control polygon."""
        return sum(starmap(dist, pairwise(self.control_points.tolist())))
