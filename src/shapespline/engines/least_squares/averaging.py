"""The mean of smooth curves of several sizes, each weighted by what its cost says of it.

Which size is the cheapest is a draw of the noise where few points tell it; the mean of all that are
nearly as cheap is nearer to the truth than any one of them is on average (Buckland, Burnham and
Augustin 1997, "Model selection: an integral part of inference").
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from shapespline.engines.least_squares.smoothing import FINEST, cheapest, smoothed_to
from shapespline.engines.least_squares.starts.equidistribution import Balanced, balanced_start
from shapespline.geometry import nearest
from shapespline.values import Contour

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.engines.least_squares.smoothing import Smoothed
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray

# A size that costs so much more weighs 1 / e; sizes that weigh less than this count for nothing
# (FIT-33).
DEARER, LEAST_WEIGHT = 16.0, 1e-3
# Where the knots of a closed curve lie is a draw, too: sizes that weigh at least so much count with
# knots moved on by these parts of a span as well (FIT-39).
MOVED, MOVED_WEIGHT = (1 / 3, 2 / 3), 0.3
# The mean is read at so many places for each control point, and one spline tells it within this
# part of its standard error, with at most so many times the control points (FIT-33).
PLACES_EACH, WITHIN, MOST_TIMES = 12, 0.25, 1.6


class Averaged(NamedTuple):
    """Points along the mean curve, and a spline that tells it."""

    outline: Contour
    start: Balanced


def averaged(
    tried: Sequence[Smoothed], contour: Contour, degree: int, noise: float, *, monitor: Monitor
) -> Averaged | None:
    """The mean of the curves that were tried; None where one alone counts.

    Along the cheapest one, of the points of all the others that are nearest to it.
    """
    best = cheapest(tried)
    if best.start is None:
        return None
    size = best.n_control_points
    places = np.linspace(0.0, 1.0, PLACES_EACH * size + 1)
    along = best.start.spline(places[:-1] if contour.closed else places)
    counted = [one for one in tried if one.start is not None and _weight(one, best) >= LEAST_WEIGHT]
    if len(counted) == 1:
        return None
    if contour.closed:
        near = [one.n_control_points for one in counted if _weight(one, best) >= MOVED_WEIGHT]
        counted += [
            smoothed_to(count, _begun_at(contour, part / count), degree, noise, monitor=monitor)
            for count in near
            for part in MOVED
        ]
    total, sum_of_weights = np.zeros_like(along), 0.0
    for one in counted:
        weight = _weight(one, best)
        total += weight * (along if one is best else _nearest_to(along, one))
        sum_of_weights += weight
    outline = Contour.silently(total / sum_of_weights, contour.closed)
    error = WITHIN * noise * float(np.sqrt(size / len(contour)))
    most = max(size, int(MOST_TIMES * size))
    for count in range(size, most + 1, max(1, round(FINEST * size))):
        start = balanced_start(outline, count, degree, rounds=0, ends="fitted", ask=monitor.ends)
        if monitor.ends(count) or _rms(start, outline.points) <= error:
            break
    return Averaged(outline, start)


def _weight(one: Smoothed, best: Smoothed) -> float:
    """What a size counts in the mean."""
    return float(np.exp((best.cost - one.cost) / DEARER))


def _begun_at(contour: Contour, part: float) -> Contour:
    """A closed contour that begins a part of its points on."""
    return Contour.silently(np.roll(contour.points, -round(part * len(contour)), axis=0), True)


def _nearest_to(points: FloatArray, one: Smoothed) -> FloatArray:
    """The points of a curve that are nearest to others."""
    spline = cast("Balanced", one.start).spline
    return spline(nearest(spline, points).parameters)


def _rms(start: Balanced, points: FloatArray) -> float:
    """Root mean square distance of points from a curve."""
    return float(np.sqrt(nearest(start.spline, points).distances_sq.mean()))
