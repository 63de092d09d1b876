"""fit_curve: points in, verified Fit out. Chooses among the engines."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from shapespline.analysis import NormalizedContour, find_outliers, looks_shuffled, resolution
from shapespline.engines.least_squares import (
    STRAY_WEIGHT,
    balanced_start,
    dominant_start,
    given_weights,
    summed_weights,
    uniform_start,
)
from shapespline.errors import DegenerateContourError, InvalidInputError, ShuffledPointsWarning
from shapespline.fitting.estimate import (
    FARTHEST,
    FINAL_LIMITS,
    Evidence,
    estimated_pieces,
    smooth_start,
)
from shapespline.fitting.optimization import optimize
from shapespline.fitting.promise import fit_promised
from shapespline.fitting.verify import final_status, verified_fit
from shapespline.fitting.within import (
    Effort,
    Ends,
    Form,
    Wanted,
    check_size_alone,
    checked_corners,
    checked_held,
    fit_within,
    tolerance_length,
)
from shapespline.geometry import joined, reversed_curve
from shapespline.monitor import End, Monitor
from shapespline.values import Contour, Status, check_count, check_degree

if TYPE_CHECKING:
    from shapespline.engines.least_squares import Balanced
    from shapespline.monitor import Callback
    from shapespline.typing import ArrayLike, IntArray
    from shapespline.values import Fit

Knots = Literal["balanced", "dominant", "uniform"]
# What least squares of a given size starts from.
STARTS = {"balanced": balanced_start, "dominant": dominant_start, "uniform": uniform_start}


def fit_curve(
    points: ArrayLike | Contour,
    *,
    closed: bool | None = None,
    tolerance: float | str | None = None,
    n_control_points: int | None = None,
    degree: int = 3,
    corners: Literal["auto", "free"] | ArrayLike | None = "auto",
    form: Form = "pieces",
    ends: Ends = "free",
    end_tangents: tuple[ArrayLike | None, ArrayLike | None] | None = None,
    through: ArrayLike | None = None,
    symmetric: bool = False,
    effort: Effort = "balanced",
    weights: ArrayLike | None = None,
    knots: Knots = "balanced",
    outliers: bool = False,
    method: str = "levenberg-marquardt",
    callback: Callback | None = None,
    time_limit: float | None = None,
) -> Fit:
    """Fit a B-spline curve to ordered points.

    With a ``tolerance``: the fewest stored points that keep it, in both directions, as lines,
    Beziers and small splines or as one spline. With ``n_control_points``: one spline by least
    squares, control points and parameters together. With neither the curve is estimated: clean
    points give the smallest curve within what they can show, a twentieth to a tenth of a per cent
    of the box diagonal or the accuracy of their source; noisy ones a least-squares curve whose size
    a criterion chooses, in pieces with corners and straight runs where the points tell of them.

    Parameters
    ----------
    points : array_like, shape (n, 2), or Contour
        In order along the outline, data units.
    closed : bool, optional
        Whether the last point joins the first; found from the data when not given.
    tolerance : float or str, optional
        Largest distance from data to curve and from curve to data polyline, data units; or a
        part of the box diagonal, such as ``"0.1%"``.
    n_control_points : int, optional
        Number of control points, ``degree + 1`` to n.
    degree : int
        1 to 9.
    corners : "auto", "free", None or array_like of indices
        Keep corners sharp and everything else tangent-continuous; round or make
        them where that is smaller; know none; or these points are the corners.
    form : {"pieces", "spline"}
        Pieces between nodes, or one spline, smooth everywhere.
    ends : {"free", "fixed"}
        Of an open curve: "fixed" begins and ends in the first and last point, exactly. Pieces
        whose ends are free may need fewer points; one spline always has fixed ends, but where it
        is estimated from noisy points.
    end_tangents : pair of array_like, shape (2,), or None, optional
        Directions (x, y) in which an open curve begins and ends, exactly; None where that is free.
        Its ends are fixed then. Within a tolerance, in pieces.
    through : array_like of indices, optional
        Points that the curve goes through, up to rounding; each is a node of it, smooth where it is
        no corner. Within a tolerance, in pieces.
    symmetric : bool
        Whether a mirror symmetry that a closed outline has within a part of the tolerance is kept
        exactly: one half is fitted and reflected, which may take some points more. Without, that
        is done where it takes none, unless the search is to be fast.
    effort : {"fast", "balanced", "smallest"}
        How long to search.
    weights : array_like, shape (n,), optional
        One positive weight per point. In least squares they multiply the squared distances; within
        a tolerance a point of weight w > 1 is kept within tolerance / w, and a lower weight loosens
        nothing. Few points are held exactly by ``through``, and cheaper.
    knots : {"balanced", "dominant", "uniform"}
        With a number of control points: spread until every span errs as much, or for comparison
        at dominant points or equally spaced.
    outliers : bool
        Whether to leave out points that jump off the path and back, up to three in a row (see
        `find_outliers`); ``fit.outliers`` lists them and every promise is about the rest, which
        is ``fit.contour``, as are ``fit.parameters``.
    method : str
        For least squares; see `optimize`.
    callback : callable, optional
        Called with every Iteration of a least-squares run, or with the progress of a search
        within a tolerance (an Iteration whose ``cost`` is the number of points), some times a
        second; a true answer cancels it. The best curve so far is returned.
    time_limit : float, optional
        Seconds after which the search ends with the best curve so far. It is looked at between
        iterations and between moves; finding a start and verifying the result come on top.

    Returns
    -------
    Fit
        Its distances are verified both ways; ``fit.kept`` and ``fit.status`` say whether the
        tolerance holds.

    Raises
    ------
    InvalidInputError, DegenerateContourError
        If the points or an argument is not usable; the message says which and why.

    Examples
    --------
    >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    >>> ellipse = np.column_stack([3 * np.cos(t), np.sin(t)])
    >>> fit = fit_curve(ellipse, closed=True, tolerance=0.01)
    >>> fit.kept, fit.closed, fit.n_stored_points <= 8
    (True, True, True)
    >>> fit_curve(ellipse, closed=True, n_control_points=12).n_control_points
    12
    """
    degree = check_degree(degree)
    contour = _contour(points, closed)
    if looks_shuffled(contour):
        warnings.warn(
            "the points look shuffled: most steps lead across the whole outline, not to a point"
            " near by; sort them with order_points, or read them with unordered=True",
            ShuffledPointsWarning,
            stacklevel=2,
        )
    if not isinstance(outliers, bool | np.bool_):
        raise InvalidInputError(f"outliers must be True or False, got {outliers!r}")
    if not isinstance(symmetric, bool | np.bool_):
        raise InvalidInputError(f"symmetric must be True or False, got {symmetric!r}")
    if outliers and len(left_out := find_outliers(contour)):
        given = np.flatnonzero(np.isin(contour.source, left_out))
        rest = Contour.silently(
            np.delete(contour.points[contour.source], given, axis=0),
            contour.closed,
            accuracy=contour.accuracy,
        )
        if weights is not None:
            given_weights(weights, contour)
        fit = fit_curve(
            rest,
            tolerance=None if tolerance is None else tolerance_length(tolerance, rest),
            n_control_points=n_control_points,
            degree=degree,
            corners=_renumbered(corners, left_out, len(contour)),
            form=form,
            ends=ends,
            end_tangents=end_tangents,
            through=_renumbered_nodes(through, left_out, contour),
            symmetric=symmetric,
            effort=effort,
            weights=None if weights is None else np.delete(np.asarray(weights), given),
            knots=knots,
            method=method,
            callback=callback,
            time_limit=time_limit,
        )
        return replace(fit, outliers=given)
    one_spline = n_control_points is not None or weights is not None
    if len(contour) < degree + 1 and tolerance is None and one_spline:
        raise DegenerateContourError(
            f"points must hold at least degree + 1 = {degree + 1} distinct points for degree"
            f" {degree}, got {len(contour)}; add points or lower the degree"
        )
    _check_choice("form", form, get_args(Form))
    _check_choice("ends", ends, get_args(Ends))
    _check_choice("effort", effort, get_args(Effort))
    _check_choice("knots", knots, get_args(Knots))
    if knots != "balanced" and n_control_points is None:
        raise InvalidInputError("knots act with n_control_points only: give a number of them")
    if tolerance is not None and n_control_points is not None:
        raise InvalidInputError("tolerance and n_control_points exclude each other: give one")
    if n_control_points is not None:
        check_size_alone(corners, form, effort)
    if tolerance is not None:
        length = tolerance_length(tolerance, contour)
        held = checked_held(contour, ends, end_tangents, through)
        wanted = Wanted(degree, corners, form, effort, held, symmetric)
        return fit_promised(contour, length, wanted, weights, Monitor(callback, time_limit))
    if end_tangents is not None or through is not None or symmetric:
        raise InvalidInputError(
            "end_tangents, through and symmetric act within a tolerance: give one"
        )
    monitor = Monitor(callback, time_limit)
    summed = None if weights is None else summed_weights(weights, contour)
    if n_control_points is None:
        if weights is None:
            return _estimated(contour, degree, corners, form, ends, effort, method, monitor)
        return _finished(contour, smooth_start(contour, degree, summed), method, weights, monitor)
    count = check_count(n_control_points, degree)
    if count > len(contour):
        raise InvalidInputError(
            f"n_control_points must be at most the number of distinct points, {len(contour)},"
            f" got {count}; lower it"
        )
    fit = optimize(
        contour,
        STARTS[knots](contour, count, degree, summed),
        method,
        weights=weights,
        stray_weight=STRAY_WEIGHT,
        limits=FINAL_LIMITS,
        callback=monitor.iterated,
    )
    return _in_time(fit, monitor)


def _contour(points: ArrayLike | Contour, closed: bool | None) -> Contour:
    if not isinstance(points, Contour):
        return Contour(points, closed)
    if closed is None or closed == points.closed:
        return points
    return Contour.silently(points.points[points.source], closed, accuracy=points.accuracy)


def _check_choice(name: str, value: object, choices: tuple[str, ...]) -> None:
    if value not in choices:
        raise InvalidInputError(f"{name} must be one of {', '.join(choices)}, got {value!r}")


def _renumbered(
    corners: Literal["auto", "free"] | ArrayLike | None, left_out: IntArray, n: int
) -> Literal["auto", "free"] | ArrayLike | None:
    """The corners among the points that stay."""
    corners = checked_corners(corners, n)
    if corners is None or isinstance(corners, str):
        return corners
    staying = np.setdiff1d(corners, left_out)
    return staying - np.searchsorted(left_out, staying)


def _renumbered_nodes(
    through: ArrayLike | None, left_out: IntArray, contour: Contour
) -> IntArray | None:
    """The points to go through among those that stay; an outlier among them is an error."""
    if through is None:
        return None
    nodes = checked_held(contour, "free", None, through).through
    if len(both := np.intersect1d(nodes, left_out)):
        raise InvalidInputError(
            f"through must hold no outliers, got {both.tolist()}; leave them out, or outliers=False"
        )
    return nodes - np.searchsorted(left_out, nodes)


def _estimated(
    contour: Contour,
    degree: int,
    corners: Literal["auto", "free"] | ArrayLike | None,
    form: Form,
    ends: Ends,
    effort: Effort,
    method: str,
    monitor: Monitor,
) -> Fit:
    """A curve for points of which nothing else is known.

    Clean points: the smallest curve within what they can show. Noisy ones: pieces, where they tell
    as much of the points as one least-squares spline at the same price, or that spline. Points
    that neither comes near are no noisy curve after all, and are treated as clean ones.
    """
    corners = checked_corners(corners, len(contour))
    frame = NormalizedContour.of(contour)
    ordered = Contour.silently(
        contour.points[frame.order], contour.closed, accuracy=contour.accuracy
    )
    shown = resolution(ordered)
    if not shown.clean:
        start = smooth_start(ordered, degree)
        smooth = Evidence.of_spline(start, ordered, shown.noise)
        found = None
        if form == "pieces":
            found = estimated_pieces(
                contour, shown.noise, corners=corners, degree=degree, effort=effort
            )
        if found is not None:
            pieces, said = found
            given = not isinstance(corners, str | None)
            one_run = len(pieces) == 1 and pieces[0].kind != "line"
            chosen = given or (said.preferred_to(smooth) and not one_run)
            if chosen and said.farthest <= FARTHEST * shown.band:
                spline = joined(pieces, degree)
                return verified_fit(
                    contour, spline, tolerance=None, method="estimation", sections=pieces
                )
        if smooth.farthest <= FARTHEST * shown.band:
            fit = _finished(ordered, start, method, None, monitor)
            spline, parameters = fit.spline, fit.parameters[frame.place][contour.source]
            if frame.reversed:
                spline, parameters = reversed_curve(spline), 1.0 - parameters
            return replace(fit, contour=contour, spline=spline, parameters=parameters)
    wanted = Wanted(degree, corners, form, effort, checked_held(contour, ends, None, None))
    fit = fit_within(contour, shown.band, wanted, monitor)
    kept = verified_fit(
        contour, fit.spline, tolerance=None, method=fit.method, sections=fit.sections
    )
    return replace(kept, status=final_status(kept.status, monitor), history=fit.history)


def _finished(
    contour: Contour,
    start: Balanced,
    method: str,
    weights: ArrayLike | None,
    monitor: Monitor,
) -> Fit:
    """Least squares to the end from a start whose size was chosen, its ends free to leave noise."""
    fit = optimize(
        contour,
        start,
        method,
        weights=weights,
        ends=None if contour.closed else "fitted",
        stray_weight=STRAY_WEIGHT,
        limits=FINAL_LIMITS,
        callback=monitor.iterated,
    )
    return _in_time(fit, monitor)


def _in_time(fit: Fit, monitor: Monitor) -> Fit:
    """The fit, saying so if the time limit ended it."""
    if monitor.ended is not End.TIME:
        return fit
    found = f"data to curve {fit.max_distance:.6g}, both ways {fit.hausdorff_distance:.6g}"
    return replace(fit, status=final_status(Status.BUDGET.saying(found), monitor))
