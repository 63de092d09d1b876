"""fit_large: one outline of any number of points, in a few passes over them.

Within a tolerance there are three. The first looks: bounds, ends, a sample for corners and noise.
The second finds a polyline of few vertices that stands for all points, a small, proven distance
away (stand_in.py). The search sees these vertices only, and keeps the tolerance less that distance,
so that the promise holds for all points; the third measures every one of them against the curve.
With a number of control points some passes between sum up normal equations (large_squares.py).
What a pass brings home from a chunk is a few numbers or vertices, so chunks may lie on disk or on
the machines of a cluster.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from shapespline.analysis import (
    GENTLE_TURN,
    LONGEST_CHORD,
    NormalizedContour,
    canonical_reading,
    find_corners,
)
from shapespline.engines.least_squares import MOST_PASSES, least_squares
from shapespline.engines.pieces import PiecesProblem
from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.fitting.verify import final_status, status_of, verified_fit
from shapespline.fitting.within import Wanted, check_size_alone, fit_within, tolerance_length
from shapespline.geometry import (
    CentredCurve,
    Distances,
    backwards,
    reverse_distance,
    reversed_curve,
    rounding,
)
from shapespline.monitor import Monitor
from shapespline.solvers import Stop
from shapespline.streaming import (
    FootParameters,
    LargeFit,
    Measured,
    Passes,
    PointStream,
    ProxyPolyline,
    TurnedRows,
)
from shapespline.validation import is_number
from shapespline.values import Contour, Fit, Status, check_count, check_degree

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Executor

    from shapespline.fitting.within import Effort, Form
    from shapespline.streaming import Seen
    from shapespline.typing import IntArray

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
    corners: Literal["auto", "free"] | None = "auto",
    form: Form = "pieces",
    effort: Effort = "balanced",
    executor: Executor | None = None,
    progress: Callable[[int, int], object] | None = None,
    time_limit: float | None = None,
) -> LargeFit:
    """Fit a curve to one outline of any number of points, without holding them in memory.

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
    degree = check_degree(degree)
    if (tolerance is None) == (n_control_points is None):
        given = "both" if n_control_points is not None else "none"
        raise InvalidInputError(
            f"points are fitted within a tolerance or with n_control_points, got {given}: give one"
        )
    count = 0
    if n_control_points is not None:
        check_size_alone(corners, form, effort)
        count = check_count(n_control_points, degree)
    if not (corners is None or corners in ("auto", "free")):
        raise InvalidInputError(f"corners must be 'auto', 'free' or None, got {corners!r}")
    for name, value, choices in (
        ("form", form, ("pieces", "spline")),
        ("effort", effort, ("fast", "balanced", "smallest")),
    ):
        if value not in choices:
            raise InvalidInputError(f"{name} must be one of {', '.join(choices)}, got {value!r}")
    if not isinstance(tolerance, str | None) and not (
        is_number(tolerance) and 0 < tolerance < np.inf
    ):
        raise InvalidInputError(f"tolerance must be a positive length, got {tolerance!r}")
    monitor = Monitor(None, time_limit)
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
        return _of_size(passes, seen, closed, count, degree, monitor)
    length = tolerance_length(tolerance, box)
    standing = ProxyPolyline.of(passes, seen, closed, length, LONGEST_CHORD * box.box_diagonal)
    sample = Contour.silently(seen.sample, closed)
    wanted = Wanted(degree, corners, form, effort)
    fit = _fitted(standing, sample, stream.n_points, length, wanted, monitor)
    curve = CentredCurve.of(fit.spline, fit.contour)
    found = _distances(fit, passes.measure(curve), standing, stream.n_points)
    named = {name: getattr(fit, name) for name in Fit.__dataclass_fields__}
    named |= _verified(found, length, monitor)
    return LargeFit(**named, n_points=stream.n_points, feet=FootParameters(stream, curve))


def _of_size(
    passes: Passes, seen: Seen, closed: bool, count: int, degree: int, monitor: Monitor
) -> LargeFit:
    """Least squares, and the distances of all points."""
    found = least_squares(passes, seen, closed, count, degree, monitor)
    spline, sample, n = found.spline, found.sample, passes.stream.n_points
    curve = CentredCurve.of(spline, sample)
    measured = passes.measure(curve)
    standing = _standing(passes, seen, closed, float(np.sqrt(measured.largest)))
    around = Contour.silently(standing.points, closed)
    distances = Distances(
        float(np.sqrt(measured.largest)) + rounding(spline, around),
        float(np.sqrt(measured.total / n)),
        reverse_distance(spline, around) + standing.off,
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
    named = {name: getattr(fit, name) for name in Fit.__dataclass_fields__}
    figures = f"data to curve {fit.max_distance:.6g}, both ways {fit.hausdorff_distance:.6g}"
    if monitor.ended:
        named["status"] = final_status(Status.BUDGET.saying(figures), monitor)
    elif found.run.stop is Stop.EVALUATIONS:
        more = "the sum of squares still falls a little"
        named["status"] = Status.BUDGET.saying(f"{MOST_PASSES} passes over: {figures}; {more}")
    return LargeFit(**named, n_points=n, feet=FootParameters(passes.stream, curve))


def _standing(passes: Passes, seen: Seen, closed: bool, farthest: float) -> ProxyPolyline:
    """Vertices for points that lie so far from a curve at most: none need be nearer to them."""
    diagonal = float(np.hypot(*(seen.high - seen.low)))
    aim = max(NEAR_ENOUGH * farthest, FINEST * diagonal)
    while True:
        try:
            return ProxyPolyline.of(passes, seen, closed, aim, LONGEST_CHORD * diagonal)
        except InvalidInputError:  # too many would stay
            aim *= 4.0


def fit_all_in_passes(
    contour: Contour,
    tolerance: float,
    wanted: Wanted,
    monitor: Monitor,
) -> Fit | None:
    """The same for a contour in memory, whose order is the canonical one, with all parameters.

    None where nothing smaller can stand for the points, or corners are named among them.
    """
    if not isinstance(wanted.corners, str | None):
        return None
    start, step = canonical_reading(contour.points, closed=contour.closed)
    stream = PointStream(TurnedRows(contour.points, start, step))
    passes = Passes(stream, None, in_all=3)
    seen = passes.look()
    longest = LONGEST_CHORD * contour.box_diagonal
    try:
        standing = ProxyPolyline.of(passes, seen, contour.closed, tolerance, longest)
    except InvalidInputError:
        return None
    sample = Contour.silently(seen.sample, contour.closed, accuracy=contour.accuracy)
    n = len(contour)
    fit = _fitted(standing, sample, n, tolerance, wanted, monitor)
    curve = CentredCurve.of(fit.spline, fit.contour)
    parameters = np.empty(n)
    measured = passes.measure(curve, TurnedRows(parameters, start, step))
    spline, sections = fit.spline, fit.sections
    if step < 0:
        spline, sections = reversed_curve(spline), backwards(sections)
        np.subtract(1.0, parameters, out=parameters)
    found = _distances(fit, measured, standing, n)
    return replace(
        fit,
        contour=contour,
        spline=spline,
        sections=sections,
        parameters=parameters if contour.n_given == n else parameters[contour.source],
        **_verified(found, tolerance, monitor),
    )


def _fitted(
    standing: ProxyPolyline,
    sample: Contour,
    n_points: int,
    tolerance: float,
    wanted: Wanted,
    monitor: Monitor,
) -> Fit:
    """The fit to the vertices that stand for all points, within what is left of the tolerance."""
    thinned = Contour.silently(standing.points, sample.closed, accuracy=sample.accuracy)
    # Repeated points are gone.
    indices = standing.indices[np.unique(thinned.source, return_index=True)[1]]
    aim = tolerance - standing.off
    outline = _outline(thinned, indices, sample, aim, wanted.corners is not None, n_points)
    outline = outline._replace(held=wanted.held)  # ends alone
    return fit_within(thinned, aim, wanted, monitor, outline, sample)


def _distances(fit: Fit, measured: Measured, standing: ProxyPolyline, n_points: int) -> Distances:
    """Of all points, from those that stand for them."""
    return Distances(
        float(np.sqrt(measured.largest)) + rounding(fit.spline, fit.contour),
        float(np.sqrt(measured.total / n_points)),
        reverse_distance(fit.spline, fit.contour) + standing.off,
        fit.parameters,
    )


def _verified(found: Distances, tolerance: float, monitor: Monitor) -> dict[str, Any]:
    """The fields of a Fit that tell of its distances."""
    return {
        "max_distance": found.max_distance,
        "rms_distance": found.rms_distance,
        "hausdorff_distance": found.hausdorff_distance,
        "tolerance": tolerance,
        "status": final_status(status_of(found, tolerance), monitor),
    }


def _outline(
    thinned: Contour,
    indices: IntArray,
    sample: Contour,
    aim: float,
    cornered: bool,
    n_points: int,
) -> PiecesProblem:
    """What the search knows: corners found in the sample, if any may be, are vertices near by."""
    frame = NormalizedContour.of(thinned)
    seen = frame.taken_over(sample)
    n = len(thinned)
    empty = np.empty(0, dtype=np.int64)
    if not cornered:
        gentle = np.ones(n, dtype=np.int64)
        return PiecesProblem(frame, aim * frame.scale, empty, gentle, dense=seen)
    found = find_corners(sample, aim)
    stride = n_points / len(sample)
    beside = np.minimum((indices / stride).astype(np.int64), len(sample) - 1)
    gentle = (found.turns[beside] < GENTLE_TURN).astype(np.int64)
    chosen = [_farthest(thinned, indices, stride * at, 2.0 * stride) for at in found.indices]
    places = np.unique(frame.place[np.array(chosen, dtype=np.int64)]) if chosen else empty
    return PiecesProblem(frame, aim * frame.scale, places, gentle[frame.order], dense=seen)


def _farthest(thinned: Contour, indices: IntArray, middle: float, reach: float) -> int:
    """Of the vertices near a place the one farthest from the chord across them."""
    near = np.flatnonzero(np.abs(indices - middle) <= reach)
    if len(near) == 0:
        return int(np.abs(indices - middle).argmin())
    n = len(thinned)
    ends = np.array([near[0] - 1, near[-1] + 1])
    ends = ends % n if thinned.closed else np.clip(ends, 0, n - 1)
    begin, end = thinned.points[ends]
    (x, y), (dx, dy) = (thinned.points[near] - begin).T, end - begin
    return int(near[np.abs(x * dy - y * dx).argmax()])
