"""fit_large: one outline of any number of points, in a few passes over them.

Within a tolerance there are three. The first looks: bounds, ends, a sample for corners and noise.
The second finds a polyline of few vertices that stands for all points, a small, proven distance
away (`ProxyPolyline`). The search sees these vertices only, and keeps the tolerance less that
distance, so that the promise holds for all points; the third measures every one of them against the
curve. With a number of control points some passes between sum up normal equations
(`least_squares`). What a pass brings home from a chunk is a few numbers or vertices, so chunks may
lie on disk or on the machines of a cluster.
"""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.analysis import LONGEST_CHORD
from shapespline.engines.least_squares import MOST_PASSES, least_squares
from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.fitting.goals import Style, Within
from shapespline.fitting.request import Request
from shapespline.fitting.settings import Settings, tolerance_length
from shapespline.fitting.solve import search
from shapespline.fitting.streamed import distances_of_all, fit_proxy, with_distances
from shapespline.fitting.verify import final_status, verified_fit
from shapespline.geometry import CentredCurve, Distances, reverse_distance, rounding
from shapespline.monitor import Monitor
from shapespline.solvers import Stop
from shapespline.streaming import FootParameters, LargeFit, Passes, PointStream, ProxyPolyline
from shapespline.values import Contour, Fit, Status

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Executor

    from shapespline.streaming import Seen
    from shapespline.typing import CornerChoice, Effort, Form

# Points that scatter around a curve scatter as far around their averages: a polyline that stands
# for them may be twice as far as the farthest is from the curve, or this part of the box diagonal.
NEAR_ENOUGH, FINEST = 2.0, 1e-9


def fit_large(
    points: Any,
    *,
    tolerance: float | str | None = None,
    n_control_points: int | None = None,
    closed: bool | None = None,
    degree: int = 3,
    corners: CornerChoice | None = "auto",
    form: Form = "pieces",
    effort: Effort = "balanced",
    executor: Executor | None = None,
    progress: Callable[[int, int], object] | None = None,
    time_limit: float | None = None,
) -> LargeFit:
    """Fit a curve to one outline of any number of points, without holding them in memory.

    The fewest points are looked for (``character="fewest"`` of `fit_curve`).

    Parameters
    ----------
    points : array-like, shape (n, 2)
        In order along the outline: an array, a file mapped by ``numpy.load(path,
        mmap_mode="r")``, a zarr or a dask array.
    tolerance : float or str, optional
        As `fit_curve` takes it; kept for every point, both ways.
    n_control_points : int, optional
        Instead of a tolerance: one spline by least squares over all points, its ends fitted like
        the rest.
    closed : bool, optional
        Whether the last point joins the first; when not given, whether the gap between them is no
        longer than the longest step.
    degree, corners, form, effort, time_limit
        As `fit_curve` takes them; corners cannot be named by their indices.
    executor : concurrent.futures.Executor, optional
        Where to work on chunks, several at a time: threads for an array or a file. The blocks of a
        dask array are worked on by dask's own scheduler, a cluster's if there is a client. The
        result has the same bits.
    progress : callable, optional
        Called with the number of points looked at and to look at at most, over all passes; a true
        answer ends the run with a ShapesplineError.

    Returns
    -------
    LargeFit

    Raises
    ------
    InvalidInputError, DegenerateContourError
        If the points or an argument is not usable, or the points scatter by so much more than the
        tolerance that too many of them have to stay.

    Notes
    -----
    Clean points are thinned by cone intersection in one pass over each chunk (Williams 1978), 1 to
    30 % of the tolerance away; points that scatter are averaged over runs. The bound from curve to
    data is that to the vertices' polyline and its distance. Points that begin elsewhere or run the
    other way may give another curve, as good a one.

    Least squares begin with those of some 20 000 of the points. Each pass finds the feet of all of
    them and sums the moments of every span; a chunk sends no more than these, whatever its size.
    Most often 4 to 8 passes.

    Examples
    --------
    >>> t = np.linspace(0, 2 * np.pi, 600_000, endpoint=False)
    >>> ellipse = np.column_stack([3 * np.cos(t), np.sin(t)]).astype(np.float32)
    >>> fit = fit_large(ellipse, tolerance=0.01)
    >>> fit.kept, fit.closed, fit.n_stored_points <= 8, fit.n_points
    (True, True, True, 600000)
    >>> fit_large(ellipse, n_control_points=12).n_control_points
    12
    """
    if (tolerance is None) == (n_control_points is None):
        given = "both" if n_control_points is not None else "none"
        raise InvalidInputError(
            f"points are fitted within a tolerance or with n_control_points, got {given}: give one"
        )
    if not (corners is None or isinstance(corners, str)):
        raise InvalidInputError(f"corners must be 'auto', 'free' or None, got {corners!r}")
    settings = Settings(
        tolerance=tolerance,
        n_control_points=n_control_points,
        degree=degree,
        corners=corners,
        form=form,
        effort=effort,
        time_limit=time_limit,
    )
    monitor = Monitor(None, settings.time_limit)
    stream = PointStream(points, executor)
    passes = Passes(stream, progress, in_all=3 if n_control_points is None else 3 + MOST_PASSES)
    seen = passes.look()
    closed = seen.ends_meet if closed is None else bool(closed)
    if (seen.low == seen.high).all():
        raise DegenerateContourError(
            f"points must hold at least 2 distinct points, got 1 (of {stream.n_points} given)"
        )
    box = Contour.silently(np.array([seen.low, seen.high]), closed=False)
    if tolerance is None:
        return _of_size(passes, seen, closed, settings, monitor)
    length = tolerance_length(tolerance, box)
    proxy = ProxyPolyline.of(passes, seen, closed, length, LONGEST_CHORD * box.box_diagonal)
    sample = Contour.silently(seen.sample, closed)
    request = Request(
        contour=sample,
        goal=Within(length),
        style=Style(settings.degree, form, corners),
        effort=effort,
    )
    fit = fit_proxy(proxy, sample, stream.n_points, request, monitor, search)
    curve = CentredCurve.of(fit.spline, fit.contour)
    found = distances_of_all(fit, passes.measure(curve), proxy, stream.n_points)
    return _large(with_distances(fit, found, length, monitor), stream, curve)


def _large(fit: Fit, stream: PointStream, curve: CentredCurve) -> LargeFit:
    """The fit of a stream."""
    named = {item.name: getattr(fit, item.name) for item in fields(Fit)}
    return LargeFit(**named, n_points=stream.n_points, feet=FootParameters(stream, curve))


def _of_size(
    passes: Passes, seen: Seen, closed: bool, settings: Settings, monitor: Monitor
) -> LargeFit:
    """Least squares, and the distances of all points."""
    count = settings.n_control_points or 0
    found = least_squares(passes, seen, closed, count, settings.degree, monitor)
    spline, sample, n = found.spline, found.sample, passes.stream.n_points
    curve = CentredCurve.of(spline, sample)
    measured = passes.measure(curve)
    proxy = _proxy(passes, seen, closed, float(np.sqrt(measured.largest)))
    around = Contour.silently(proxy.points, closed)
    distances = Distances(
        float(np.sqrt(measured.largest)) + rounding(spline, around),
        float(np.sqrt(measured.total / n)),
        reverse_distance(spline, around) + proxy.error_bound,
        curve.nearest(sample.points).parameters,
    )
    fit = verified_fit(
        sample,
        spline,
        tolerance=None,
        method="levenberg-marquardt",
        run=found.run,
        history=found.history,
        distances=distances,
    )
    figures = f"data to curve {fit.max_distance:.6g}, both ways {fit.hausdorff_distance:.6g}"
    if monitor.ended:
        fit = replace(fit, status=final_status(fit, monitor))
    elif found.run.stop is Stop.EVALUATIONS:
        more = "the sum of squares still falls a little"
        status = Status.BUDGET.saying(f"{MOST_PASSES} passes over: {figures}; {more}")
        fit = replace(fit, status=status)
    return _large(fit, passes.stream, curve)


def _proxy(passes: Passes, seen: Seen, closed: bool, farthest: float) -> ProxyPolyline:
    """Vertices for points that lie so far from a curve at most: none need be nearer to them."""
    diagonal = float(np.hypot(*(seen.high - seen.low)))
    distance = max(NEAR_ENOUGH * farthest, FINEST * diagonal)
    while True:
        try:
            return ProxyPolyline.of(passes, seen, closed, distance, LONGEST_CHORD * diagonal)
        except InvalidInputError:  # too many would stay
            distance *= 4.0
