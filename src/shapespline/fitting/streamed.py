"""Many points: a search on a polyline that stands for them, a proven distance away.

A curve that keeps what the distance leaves of the tolerance keeps the tolerance to all points; they
are measured chunk by chunk.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import (
    LONGEST_CHORD,
    LOW_TURN,
    NormalizedContour,
    canonical_reading,
    find_corners,
)
from shapespline.engines.pieces import PiecesProblem
from shapespline.errors import InvalidInputError
from shapespline.fitting.goals import Within
from shapespline.fitting.problem import Problem
from shapespline.fitting.verify import final_status, finished, status_of
from shapespline.geometry import (
    CentredCurve,
    Distances,
    backwards,
    reverse_distance,
    reversed_curve,
    rounding,
)
from shapespline.streaming import Passes, PointStream, ProxyPolyline, TurnedRows
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.fitting.request import Request
    from shapespline.fitting.strategies import Ask
    from shapespline.monitor import Monitor
    from shapespline.streaming import Measured
    from shapespline.typing import IntArray
    from shapespline.values import Fit

# So many points are fitted in passes over chunks, where nothing asks for more (STR-01).
MANY_POINTS = 50_000


def streamed(request: Request, monitor: Monitor, ask: Ask) -> Fit | None:
    """A fit of many points in memory within a tolerance, in canonical order, with all parameters.

    None where nothing smaller can stand for the points, or corners are named among them.
    """
    contour, tolerance = request.contour, request.tolerance
    if tolerance is None or not isinstance(request.style.corners, str | None):
        return None
    start, step = canonical_reading(contour.points, closed=contour.closed)
    passes = Passes(PointStream(TurnedRows(contour.points, start, step)), None, in_all=3)
    seen = passes.look()
    longest = LONGEST_CHORD * contour.box_diagonal
    try:
        proxy = ProxyPolyline.of(passes, seen, contour.closed, tolerance, longest)
    except InvalidInputError:
        return None
    sample = Contour.silently(seen.sample, contour.closed, accuracy=contour.accuracy)
    fit = fit_proxy(proxy, sample, len(contour), request, monitor, ask)
    curve = CentredCurve.of(fit.spline, fit.contour)
    parameters = np.empty(len(contour))
    measured = passes.measure(curve, TurnedRows(parameters, start, step))
    spline, sections = fit.spline, fit.sections
    if step < 0:
        spline, sections = reversed_curve(spline), backwards(sections)
        np.subtract(1.0, parameters, out=parameters)
    found = distances_of_all(fit, measured, proxy, len(contour))
    given = parameters if contour.n_given == len(contour) else parameters[contour.source]
    fit = replace(fit, contour=contour, spline=spline, sections=sections, parameters=given)
    return with_distances(fit, found, tolerance, monitor)


def fit_proxy(
    proxy: ProxyPolyline,
    sample: Contour,
    n_points: int,
    request: Request,
    monitor: Monitor,
    ask: Ask,
) -> Fit:
    """The fit to the vertices that stand for all points, within what is left of the tolerance.

    ``request`` is that for all points; its contour is not looked at.
    """
    thinned = Contour.silently(proxy.points, sample.closed, accuracy=sample.accuracy)
    # Repeated points are gone.
    indices = proxy.indices[np.unique(thinned.source, return_index=True)[1]]
    left = (request.tolerance or 0.0) - proxy.error_bound
    asked = replace(request, contour=thinned, goal=Within(left), weights=None)
    pieces = _pieces_problem(thinned, indices, sample, n_points, asked)
    return finished(ask(Problem(asked, pieces, sample), monitor), monitor)


def distances_of_all(
    fit: Fit, measured: Measured, proxy: ProxyPolyline, n_points: int
) -> Distances:
    """Distances of all points, from those of the vertices that stand for them."""
    return Distances(
        float(np.sqrt(measured.largest)) + rounding(fit.spline, fit.contour),
        float(np.sqrt(measured.total / n_points)),
        reverse_distance(fit.spline, fit.contour) + proxy.error_bound,
        fit.parameters,
    ).beside(fit.sections)


def with_distances(fit: Fit, found: Distances, tolerance: float, monitor: Monitor) -> Fit:
    """The fit with the distances that were found, and the status that they make."""
    fit = replace(
        fit,
        max_distance=found.max_distance,
        rms_distance=found.rms_distance,
        hausdorff_distance=found.hausdorff_distance,
        tolerance=tolerance,
        status=status_of(found, tolerance),
    )
    return replace(fit, status=final_status(fit, monitor))


def _pieces_problem(
    thinned: Contour,
    indices: IntArray,
    sample: Contour,
    n_points: int,
    request: Request,
) -> PiecesProblem:
    """What the search knows: corners found in the sample, if any may be, are vertices near by."""
    tolerance, constraints = request.tolerance or 0.0, request.constraints
    normalized = NormalizedContour.posed(thinned, tolerance)
    seen, scaled = normalized.taken_over(sample), normalized.length(tolerance)
    n = len(thinned)
    empty = np.empty(0, dtype=np.int64)
    if request.style.corners is None:
        low_turn = np.ones(n, dtype=np.int64)
        return PiecesProblem(normalized, scaled, empty, low_turn, constraints, dense=seen)
    found = find_corners(sample, tolerance)
    stride = n_points / len(sample)
    beside = np.minimum((indices / stride).astype(np.int64), len(sample) - 1)
    low_turn = (found.turns[beside] < LOW_TURN).astype(np.int64)
    chosen = [_farthest(thinned, indices, stride * at, 2.0 * stride) for at in found.indices]
    places = np.unique(normalized.new_index[np.array(chosen, dtype=np.int64)]) if chosen else empty
    return PiecesProblem(
        normalized, scaled, places, low_turn[normalized.order], constraints, dense=seen
    )


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
