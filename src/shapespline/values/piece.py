"""Piece: a line, a Bezier or a spline, end to end with its neighbours."""

from __future__ import annotations

from itertools import pairwise, starmap
from math import dist
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.values.equality import hashed, same

if TYPE_CHECKING:
    from shapespline.typing import FloatArray


# A joint is smooth when it turns by no more than this, radians: a degree, which neither the eye nor
# a milling machine sees. The other thresholds of joints are made of it.
SMOOTH_TURN = np.radians(1.0)
# A joint that turns more is a corner; rounding adds less to a joint that keeps the degree.
CORNER_TURN = 1.01 * SMOOTH_TURN
# Tangents that are one agree to rounding, radians.
EXACT_TURN = 1e-9


class Piece(NamedTuple):
    """A line, a Bezier or a spline, end to end with its neighbours."""

    kind: str
    degree: int
    knots: FloatArray
    control_points: FloatArray

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Piece) and all(map(same, self, other))

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(tuple(map(hashed, self)))

    @property
    def polygon_length(self) -> float:
        """Length of the control polygon."""
        return sum(starmap(dist, pairwise(self.control_points.tolist())))
