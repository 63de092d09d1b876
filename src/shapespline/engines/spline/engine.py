"""The single spline: the fewest control points by knot removal with free knots.

One B-spline with many knots loses one knot after another (Lyche and Morken 1987). Each removal is
refitted in a window with control points, parameters and knot intervals free, in a rising p-norm of
the distances in both directions, and taken only if both are proven to keep the tolerance. The loops
are in kernels/include/shapespline/spline; here are the limits, the levels of effort and the check
of the exported curve.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.engines.spline.fairness import (
    INTERVAL_RATIO,
    SPEED_RATIO,
    Fairness,
    fairness_of,
    turning,
)
from shapespline.values import BSplineCurve, on_grid, periodic_knots

if TYPE_CHECKING:
    from collections.abc import Generator

    from shapespline.analysis import NormalizedContour
    from shapespline.monitor import Monitor
    from shapespline.typing import Effort
    from shapespline.values import Contour

# Extent of the data that the limits of intervals refer to.
EXTENT = 100.0
# Knot intervals of a fair curve: corners need some as small as the tolerance, long straight runs
# large ones. Measured: 0.02 / 0.04 / 0.06 / 0.1 / 0.15 at tolerances 0.1 and 0.5 give 834 / 810 /
# 807 / 800 / 794 control points over 26 fits (SPL-01).
LEAST_INTERVAL = (0.015, 0.2)
LEAST_INTERVAL_TOLERANCES = 1.5
FREE_INTERVALS = (1e-3, 150.0)
# A fit stops at this part of the tolerance; a curve is taken when proven to keep that one.
ENOUGH, ACCEPT = 0.97, 0.998
SAMPLES_PER_SPAN, SAMPLE_WEIGHT = 8, 0.5
# When the exported curve misses the tolerance, the search is run again with this part of it; when
# it is not fair, with more knots, at last from the data polyline, which keeps it.
TIGHTER = 0.95
ATTEMPTS = 5
# Removals tried in the first stage; only outlines far rougher than the tolerance need so many.
MOST_TRIALS = 20_000
# A search that begins with more control points than so many times those of another curve, and more
# than so many, does not come below them (SPL-12).
HOPELESS_RATIO, HOPELESS_POINTS = 3.0, 200
NO_LIMIT = 2**31 - 1


def _effort(n_side: int, *stages: tuple[int, int, bool, float]) -> _kernels.RemovalEffort:
    """Free control points on each side; half of p, iterations, intervals free, when to give up."""
    return _kernels.RemovalEffort(n_side, [_kernels.FitStage(*stage) for stage in stages])


# Stages: half of p, iterations, whether knot intervals are free, and the largest distance in
# tolerances to go on with (SPL-06).
_RANK = _effort(3, (1, 1, False, inf))
_REMOVE_QUICKLY = _effort(4, (1, 3, False, 6.0), (3, 8, True, 2.0), (6, 15, True, inf))
_REMOVE = _effort(4, (1, 6, False, 6.0), (3, 8, True, 2.5), (6, 25, True, inf))
_RETRY = _effort(7, (1, 4, False, inf), (3, 12, True, 2.6), (6, 25, True, 1.3), (10, 30, True, inf))
_UNENDING = _kernels.Patience(NO_LIMIT, inf)


class _Level(NamedTuple):
    """What an effort spends: fits, passes over what is left and how they redistribute intervals.

    A stage is left that would need ``stagnation_limit`` times its present rate. After so many
    failures in a row no removal is tried whose rank is beyond so many tolerances (``trying``), and
    none retried that failed by more (``retrying``).
    """

    remove: _kernels.RemovalEffort
    passes: int
    redistributions: list[int]
    stagnation_limit: float
    trying: _kernels.Patience = _UNENDING
    retrying: _kernels.Patience = _UNENDING


# What each effort spends (SPL-02, SPL-07, SPL-20).
LEVELS = {
    "fast": _Level(_REMOVE_QUICKLY, 0, [], 4.0, _kernels.Patience(20, 2.5)),
    "balanced": _Level(
        _REMOVE, 1, [0, 2], 8.0, _kernels.Patience(30, 4.0), _kernels.Patience(4, 2.0)
    ),
    "smallest": _Level(_REMOVE, 4, [0, 2, 4], 1e9),
}


class SplineAttempt(NamedTuple):
    """One spline that a search ended with.

    ``curve`` is in data units over [0, 1], periodic for a closed contour, clamped for an open one;
    ``fairness`` was measured on it, ``counts`` tells of ranks, trials, removals and misses.
    """

    curve: BSplineCurve
    fairness: Fairness
    counts: dict[str, int]


def attempts(
    contour: Contour,
    normalized: NormalizedContour,
    tolerance: float,
    *,
    degree: int,
    effort: Effort,
    monitor: Monitor,
    fair: bool = True,
    fewer_than: float = inf,
) -> Generator[SplineAttempt, bool, None]:
    """One spline with few control points within a tolerance, tried until it keeps what is asked.

    A generator that is sent, after each attempt, whether the curve keeps the tolerance. Where it
    does not the next one aims at less; where it is not fair the next one begins with more knots, at
    last from the data polyline, which is fair.

    Parameters
    ----------
    contour : Contour
        A closed one gives a periodic spline without a seam, an open one is interpolated at its
        ends.
    normalized : NormalizedContour
        Of this contour: the result does not depend on which point of a closed one comes first or
        which way it runs.
    tolerance : float
        Data units.
    degree : int
        1 to 9.
    effort : {"fast", "balanced", "smallest"}
        How much time goes into the last few control points.
    monitor : Monitor
        Hears of the progress and may end the search; the curve is then the last one found.
    fair : bool
        Keep knot intervals within a factor of 1000, speed above 1/20 of its median and
        self-crossings to those of the data.
    fewer_than : float
        Control points of a curve that is known: nothing is tried where the data are so rough that
        no spline has fewer.

    References
    ----------
    Lyche and Morken 1987 (knot removal); Jupp 1978 (logarithms of knot intervals as unknowns).

    Examples
    --------
    >>> from shapespline import Contour
    >>> from shapespline.analysis import NormalizedContour
    >>> from shapespline.monitor import Monitor
    >>> angle = 2 * np.pi * np.arange(200) / 200
    >>> circle = Contour(np.column_stack([np.cos(angle), np.sin(angle)]), closed=True)
    >>> tried = attempts(
    ...     circle,
    ...     NormalizedContour.of(circle),
    ...     0.01,
    ...     degree=3,
    ...     effort="balanced",
    ...     monitor=Monitor(),
    ... )
    >>> first = next(tried)
    >>> first.fairness.kept, first.curve.n_control_points <= 8
    (True, True)
    """
    thinned = normalized.thinned(normalized.length(tolerance), np.empty(0, dtype=np.int64))
    part, start = 1.0, 0
    data_turning = turning(np.diff(contour.polyline, axis=0), closed=contour.closed) or np.inf
    limit = max(HOPELESS_RATIO * fewer_than, HOPELESS_POINTS)
    most = int(min(limit, NO_LIMIT))
    for _ in range(ATTEMPTS):
        settings = _settings(thinned, part * tolerance, LEVELS[effort], fair, start, most)
        search = _searched(thinned, settings, degree, LEVELS[effort], most, monitor)
        if search is None:
            return
        curve = _exported(search, thinned, contour, degree)
        counts = search.counts()
        fairness = fairness_of(curve, thinned.contour, counts["hooks"], data_turning)
        kept = yield SplineAttempt(curve, fairness, counts)
        if monitor.ended or (kept and (fairness.kept or not fair)):
            return
        if not kept:
            part *= TIGHTER
        elif search.from_polyline():
            return
        else:
            start += 1


def _settings(
    normalized: NormalizedContour,
    tolerance: float,
    level: _Level,
    fair: bool,
    start: int,
    most_at_start: int,
) -> _kernels.SplineSettings:
    """What the kernel is asked for, in the unit of the search."""
    scaled = normalized.length(tolerance) - normalized.error_used
    unit = normalized.extent / EXTENT
    low, high = (unit * length for length in LEAST_INTERVAL)
    least = min(max(LEAST_INTERVAL_TOLERANCES * scaled, low), high)
    least_interval, largest_interval = (
        (least, INTERVAL_RATIO * least) if fair else (unit * length for length in FREE_INTERVALS)
    )
    return _kernels.SplineSettings(
        fit=_kernels.FitLimits(
            tolerance=scaled,
            enough=ENOUGH,
            samples_per_span=SAMPLES_PER_SPAN,
            sample_weight=SAMPLE_WEIGHT,
            least_interval=least_interval,
            largest_interval=largest_interval,
            stagnation_limit=level.stagnation_limit,
        ),
        fairness=_kernels.Fairness(interval_ratio=INTERVAL_RATIO, speed_ratio=SPEED_RATIO),
        keep_fair=fair,
        start=start,
        most_at_start=most_at_start,
        accept=ACCEPT,
        trying=level.trying,
        retrying=level.retrying,
    )


def _searched(
    normalized: NormalizedContour,
    settings: _kernels.SplineSettings,
    degree: int,
    level: _Level,
    most_at_start: int,
    monitor: Monitor,
) -> _kernels.RemovalSearch | None:
    """The stages of one search, as many as the monitor allows; None where it has no hope."""
    search = _kernels.RemovalSearch(
        normalized.contour.points, normalized.contour.closed, degree, settings, monitor.ends
    )
    if search.n_points() > most_at_start:
        return None
    if monitor.stage(search.n_points()):
        return search
    search.remove_cheapest(_RANK, level.remove, MOST_TRIALS, monitor.ends)
    for _ in range(level.passes):
        if monitor.stage(search.n_points()):
            break
        if search.retry(_RETRY, level.redistributions, monitor.ends) == 0:
            break
    return search


def _exported(
    search: _kernels.RemovalSearch, normalized: NormalizedContour, contour: Contour, degree: int
) -> BSplineCurve:
    """The curve over [0, 1] in data units.

    The seam of a periodic one is a simple knot; a closed curve that has none is clamped.
    """
    interval_list, coordinates = search.curve()
    intervals = np.array(interval_list)
    points = np.array(coordinates).reshape(-1, 2)
    if not contour.closed:
        knots = np.concatenate([[0.0], np.cumsum(intervals)])
        knots = on_grid(knots / knots[-1])
        knots[len(points) :] = 1.0  # rounding
        restored = normalized.restored_curve(BSplineCurve(knots, points, degree))
        points = restored.control_points.copy()
        points[[0, -1]] = contour.points[[0, -1]]  # but for rounding they are
        return BSplineCurve(restored.knots, points, degree)
    simple = (intervals > 0) & (np.roll(intervals, 1) > 0)
    seam = int(np.argmax(simple)) if simple.any() else int(np.argmax(intervals > 0))
    period = np.concatenate([[0.0], np.cumsum(np.roll(intervals, -seam))])
    knots = periodic_knots(len(points), degree, on_grid(period / period[-1]))
    points = np.roll(points, degree - seam, axis=0)
    curve = BSplineCurve(knots, points, degree, periodic=True)
    # Clamped before it is turned round: knots are inserted from one side on.
    return normalized.restored_curve(curve if simple.any() else curve.clamped())
