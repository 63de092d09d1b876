"""A curve as SciPy's splines end to end, and dense points of it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline

Array = NDArray[np.float64]
MOST_SAMPLES = 2_000_000
FEWEST_A_SPAN = 64


def splines(curve: Any) -> tuple[BSpline, ...]:
    """The curve as splines end to end, whatever it is given as.

    Parameters
    ----------
    curve : BSpline, tuple (t, c, k), piece, or a sequence of those
        A piece has ``knots``, ``control_points`` and ``degree``; where the knots want more control
        points than there are, these go around.
    """
    if isinstance(curve, BSpline):
        return (curve,)
    if hasattr(curve, "control_points"):
        n = len(curve.knots) - curve.degree - 1
        around = np.arange(n) % len(curve.control_points)
        return (BSpline(curve.knots, curve.control_points[around], curve.degree),)
    if len(curve) == 3 and isinstance(curve[2], int | np.integer):
        return (BSpline(*curve),)
    return tuple(spline for part in curve for spline in splines(part))


def breakpoints(spline: BSpline) -> Array:
    """Distinct knots of the domain."""
    inside: Array = spline.t[spline.k : len(spline.t) - spline.k]
    return np.unique(inside)


class Samples(NamedTuple):
    """Parameters and points of one spline, ends of spans included."""

    parameters: Array
    points: Array


def samples(spline: BSpline, step: float = np.inf) -> Samples:
    """Points of a spline about ``step`` apart or closer, at least 64 a span."""
    breaks = breakpoints(spline)
    coarse = spline(_spread(breaks, np.full(len(breaks) - 1, FEWEST_A_SPAN)))
    chords = np.hypot(*np.diff(coarse, axis=0).T).reshape(len(breaks) - 1, FEWEST_A_SPAN)
    # Twice the mean speed allows for the fastest part of a span.
    count = np.clip(2 * chords.sum(axis=1) / step, FEWEST_A_SPAN, MOST_SAMPLES / len(breaks))
    parameters = _spread(breaks, count.astype(int))
    return Samples(parameters, spline(parameters))


def _spread(breaks: Array, counts: NDArray[np.int_]) -> Array:
    parts = [
        np.linspace(a, b, n, endpoint=False)
        for a, b, n in zip(breaks[:-1], breaks[1:], counts, strict=True)
    ]
    return np.concatenate([*parts, breaks[-1:]])


def polyline_of(curve: Any, step: float = np.inf) -> Array:
    """Points of a whole curve in order, about ``step`` apart or closer."""
    return np.concatenate([samples(spline, step).points for spline in splines(curve)])


def sampling_error(curve: Any, step: float = np.inf) -> float:
    """No point of a curve is farther than this from the nearest of its samples.

    Half a parameter step times the largest speed in its span, which the control points of the
    derivative bound.
    """
    return max(_sampling_error(spline, step) for spline in splines(curve))


def _sampling_error(spline: BSpline, step: float) -> float:
    u = samples(spline, step).parameters
    velocity = spline.derivative()
    speed = np.hypot(*velocity.c.T)
    span = np.searchsorted(velocity.t, u[:-1], side="right") - 1
    largest = np.max([speed[span - k] for k in range(velocity.k + 1)], axis=0)
    return 0.5 * float((largest * np.diff(u)).max())


def gaps(curve: Any, *, closed: bool) -> Array:
    """Distances from the end of every part to the begin of the next one."""
    ends = np.array([_ends(spline) for spline in splines(curve)])
    before = ends[:, 1] if closed else ends[:-1, 1]
    after = np.roll(ends[:, 0], -1, axis=0) if closed else ends[1:, 0]
    return np.hypot(*(after - before).T)


def _ends(spline: BSpline) -> Array:
    """First and last point, of a clamped spline to the bit."""
    n, k = len(spline.t) - spline.k - 1, spline.k
    if spline.t[0] == spline.t[k] and spline.t[-1] == spline.t[n]:
        return np.array([spline.c[0], spline.c[n - 1]])
    return spline(spline.t[[k, n]])
