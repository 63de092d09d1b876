"""Ends of open outlines that almost meet."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import OpenOutlinesWarning, caller_level

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray
    from shapespline.values import Piece

# Of the size of the drawing: ends nearer than this may have been meant to meet (FMT-13).
ALMOST = 1e-3
# Of the extent of both outlines: dashes and hatches are drawn apart by more.
LARGEST_PART = 0.1


def say_of_gaps(outlines: Sequence[Sequence[Piece]], near: float, size: float, name: str) -> None:
    """Warn where ends of open outlines lie near each other and were not joined.

    Parameters
    ----------
    outlines : sequence of sequences of Piece
        Open ones.
    near : float
        What is joined.
    size : float
        Of the drawing.
    name : str
        Of the file.

    Warns
    -----
    OpenOutlinesWarning
    """
    gaps = _gaps(outlines, near, ALMOST * size) if outlines else np.empty(0)
    if len(gaps):
        warnings.warn(
            f"{name}: outlines are left open whose ends almost meet, the nearest {gaps.min():.2g}"
            f" apart ({len(gaps)} such gaps); only ends within {near:.2g} are joined: join the"
            " others in the drawing program if they are one point",
            OpenOutlinesWarning,
            stacklevel=caller_level(),
        )


def _gaps(outlines: Sequence[Sequence[Piece]], near: float, almost: float) -> FloatArray:
    """Distances of ends to others, up to ``almost`` and a part of both outlines."""
    from scipy.spatial import cKDTree

    lines = [np.concatenate([piece.control_points for piece in outline]) for outline in outlines]
    extents = np.array([np.hypot(*np.ptp(line, axis=0)) for line in lines])
    ends = np.array([point for line in lines for point in (line[0], line[-1])])
    points, which = np.unique(ends, axis=0, return_inverse=True)
    reach = np.zeros(len(points))
    np.maximum.at(reach, which, np.repeat(LARGEST_PART * extents, 2))
    pairs = cKDTree(points).query_pairs(almost, output_type="ndarray")
    apart = np.hypot(*(points[pairs[:, 0]] - points[pairs[:, 1]]).T)
    within = np.minimum(reach[pairs[:, 0]], reach[pairs[:, 1]])
    found: FloatArray = apart[(apart > near) & (apart <= within)]
    return found
