"""Hooks: places where a curve turns back and the data do not; the loops are in the kernel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels

if TYPE_CHECKING:
    from shapespline.typing import FloatArray


def hooks(chords: FloatArray, polyline: FloatArray, tolerance: float) -> int:
    """Number of places where a curve turns back and the data beside it do not.

    A hook turns by more than 90 degrees within one tolerance of the curve's length, while the data
    turn by less than 45 within 2.5 tolerances on both sides of their nearest point.

    Parameters
    ----------
    chords : (k, 2) array
        The curve as an open polyline.
    polyline : (n, 2) array
        The data.
    tolerance : float
        The length that both are measured by.

    Examples
    --------
    >>> data = np.array([(0.0, 0.0), (9.0, 0.0)])
    >>> hooks(np.array([(0.0, 0.0), (5.0, 0.0), (5.0, 0.1), (4.9, 0.1)]), data, 1.0)
    1
    """
    if len(polyline) < 2:
        return 0
    chords, polyline = (np.ascontiguousarray(rows, dtype=np.float64) for rows in (chords, polyline))
    return int(_kernels.count_hooks(chords, polyline, tolerance))
