"""Hooks: places where a curve turns back and the data do not; the loops are in the kernel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.geometry.flattening import chords

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve

# A curve is looked at by chords within this part of the tolerance: where it just turns enough they
# turn by 9 degrees each, and what is not seen of a turn is less. By chords of 29 degrees, at 0.02,
# hooks of a parabola stayed unsaid (PIE-27).
SAMPLING_PART = 0.002


def chords_for_hooks(curve: BSplineCurve, tolerance: float) -> FloatArray:
    """A curve as the polyline that `hooks` looks at, shape (k, 2).

    Examples
    --------
    >>> from shapespline.values import BSplineCurve
    >>> line = BSplineCurve([0, 0, 1, 1], [(0, 0), (2, 0)], degree=1)
    >>> chords_for_hooks(line, 0.1)[[0, -1]].tolist()
    [[0.0, 0.0], [2.0, 0.0]]
    """
    return chords(curve, SAMPLING_PART * tolerance)[0]


def hooks(line: FloatArray, polyline: FloatArray, tolerance: float, *, closed: bool) -> FloatArray:
    """Places where a curve turns back and the data beside it do not, shape (k, 2).

    A hook turns by more than 90 degrees within one tolerance of the curve's length, while the data
    turn by less than 45 within 2.5 tolerances on both sides of their nearest point. Where they pass
    several times within a tolerance the pass that turns most counts: the curve may stand for it.

    Parameters
    ----------
    line : (k, 2) array
        The curve as a polyline (`chords_for_hooks`).
    polyline : (n, 2) array
        The data.
    tolerance : float
        The length that both are measured by.
    closed : bool
        Whether the data are closed: then what ends where it begins goes on there. A stroke that
        ends where it began does not.

    Examples
    --------
    >>> data = np.array([(0.0, 0.0), (9.0, 0.0)])
    >>> line = np.array([(0.0, 0.0), (5.0, 0.0), (5.0, 0.1), (4.9, 0.1)])
    >>> hooks(line, data, 1.0, closed=False).tolist()
    [[5.0, 0.05]]
    """
    if len(polyline) < 2 or len(line) < 2:
        return np.empty((0, 2))
    line, polyline = (np.ascontiguousarray(rows, dtype=np.float64) for rows in (line, polyline))
    return np.array(_kernels.hook_places(line, polyline, tolerance, closed)).reshape(-1, 2)
