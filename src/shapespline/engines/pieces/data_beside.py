"""Points of an outline beside a line, and whether they are straight themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import FEWEST_STRAIGHT, STRAIGHT_PART
from shapespline.geometry import PointsByX

if TYPE_CHECKING:
    from shapespline.values import Contour, Piece

# The inner part of a line, half of it on each side of its middle.
INNER_HALF = 0.4


class DataBeside(NamedTuple):
    """The points of an outline, of which those beside lines are looked at."""

    points: PointsByX

    @classmethod
    def of(cls, contour: Contour) -> DataBeside:
        """Those of a contour."""
        return cls(PointsByX.of(contour.points))

    def are_straight(self, piece: Piece, tolerance: float) -> bool:
        """Whether the data along a line are straight, by far more than the tolerance."""
        if piece.degree > 1:
            return False
        begin, side = piece.control_points[0], np.diff(piece.control_points, axis=0)[0]
        length = float(np.hypot(*side))
        low, high = sorted(piece.control_points[:, 0].tolist())
        points = self.points.between(low - tolerance, high + tolerance)
        along = (points - begin) @ side / length**2
        across = (points - begin) @ np.array([-side[1], side[0]]) / length
        beside = (np.abs(along - 0.5) < INNER_HALF) & (np.abs(across) <= tolerance)
        if np.count_nonzero(beside) < FEWEST_STRAIGHT:
            return False
        # They may lie on another line, within the tolerance.
        tilt = np.polynomial.Polynomial.fit(along[beside], across[beside], 1)
        return float(np.ptp(across[beside] - tilt(along[beside]))) <= STRAIGHT_PART * tolerance
