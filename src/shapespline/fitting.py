"""fit_curve: points in, verified Fit out. Chooses among the engines."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from shapespline.arrays import float_array, is_number
from shapespline.balance import STRAY_WEIGHT, balanced_start
from shapespline.contour import Contour
from shapespline.drawing import Fit, Status
from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.estimation import FINAL_LIMITS, chosen_count
from shapespline.knots import check_count, check_degree
from shapespline.optimization import checked_weights, optimize
from shapespline.outliers import find_outliers
from shapespline.progress import Watch
from shapespline.removal import fit_spline
from shapespline.sections import fit_pieces

if TYPE_CHECKING:
    from shapespline.curve import BSplineCurve
    from shapespline.distance import Distances
    from shapespline.drawing import Piece
    from shapespline.optimization import Callback
    from shapespline.typing import ArrayLike, IntArray

# So many points that spread across a line by no more than this part of the tolerance are a straight
# run of the data, which one smooth spline would bend.
FEWEST_STRAIGHT, STRAIGHT_PART = 8, 0.1

Form = Literal["pieces", "spline"]
Ends = Literal["free", "fixed"]
Effort = Literal["fast", "balanced", "smallest"]


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
    effort: Effort = "balanced",
    weights: ArrayLike | None = None,
    outliers: bool = False,
    method: str = "levenberg-marquardt",
    callback: Callback | None = None,
    time_limit: float | None = None,
) -> Fit:
    """Fit a B-spline curve to ordered points.

    With a ``tolerance``: the fewest stored points that keep it, in both directions, as lines,
    Beziers and small splines or as one spline. With ``n_control_points``: one spline by least
    squares, control points and parameters together. With neither, the same with a size that an
    information criterion chooses, down to the noise or what the sampling can show.

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
        With a tolerance: keep corners sharp and everything else tangent-continuous; round or make
        them where that is smaller; know none; or these points are the corners.
    form : {"pieces", "spline"}
        With a tolerance: pieces between nodes, or one spline, smooth everywhere.
    ends : {"free", "fixed"}
        Of an open curve: "fixed" begins and ends in the first and last point, exactly. Pieces
        whose ends are free may need fewer points; one spline always has fixed ends.
    effort : {"fast", "balanced", "smallest"}
        With a tolerance: how long to search.
    weights : array_like, shape (n,), optional
        One positive weight per point, for least squares.
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
    if not isinstance(outliers, bool | np.bool_):
        raise InvalidInputError(f"outliers must be True or False, got {outliers!r}")
    if outliers and len(left_out := find_outliers(contour)):
        given = np.flatnonzero(np.isin(contour.source, left_out))
        rest = Contour.silently(
            np.delete(contour.points[contour.source], given, axis=0),
            contour.closed,
            accuracy=contour.accuracy,
        )
        checked_weights(weights, contour)
        fit = fit_curve(
            rest,
            tolerance=None if tolerance is None else tolerance_length(tolerance, rest),
            n_control_points=n_control_points,
            degree=degree,
            corners=_renumbered(corners, left_out, len(contour)),
            form=form,
            ends=ends,
            effort=effort,
            weights=None if weights is None else np.delete(np.asarray(weights), given),
            method=method,
            callback=callback,
            time_limit=time_limit,
        )
        return replace(fit, outliers=given)
    if len(contour) < degree + 1 and tolerance is None:
        raise DegenerateContourError(
            f"points must hold at least degree + 1 = {degree + 1} distinct points for degree"
            f" {degree}, got {len(contour)}; add points or lower the degree"
        )
    _check_choice("form", form, get_args(Form))
    _check_choice("ends", ends, get_args(Ends))
    _check_choice("effort", effort, get_args(Effort))
    if tolerance is not None and n_control_points is not None:
        raise InvalidInputError("tolerance and n_control_points exclude each other: give one")
    if tolerance is None:
        for name, value, default in (
            ("corners", corners, "auto"),
            ("form", form, "pieces"),
            ("effort", effort, "balanced"),
        ):
            if not (isinstance(value, str) and value == default):
                raise InvalidInputError(
                    f"{name} acts with a tolerance only: give one, or leave it out"
                )
    elif weights is not None:
        raise InvalidInputError("weights act in least squares only: leave out the tolerance")
    if tolerance is not None:
        length = tolerance_length(tolerance, contour)
        watch = Watch(callback, time_limit)
        return _within(contour, length, degree, corners, form, ends, effort, watch)
    watch = Watch(callback, time_limit)
    summed = checked_weights(weights, contour)
    if n_control_points is None:
        count = chosen_count(contour, degree, summed)
    else:
        count = check_count(n_control_points, degree)
        if count > len(contour):
            raise InvalidInputError(
                f"n_control_points must be at most the number of distinct points, {len(contour)},"
                f" got {count}; lower it"
            )
    fit = optimize(
        contour,
        balanced_start(contour, count, degree, summed),
        method,
        weights=weights,
        stray_weight=STRAY_WEIGHT,
        limits=FINAL_LIMITS,
        callback=watch.iterated,
    )
    if watch.ended_as != Status.BUDGET:
        return fit
    found = f"data to curve {fit.max_distance:.6g}, both ways {fit.hausdorff_distance:.6g}"
    return replace(fit, status=watch.verdict(Status.BUDGET.saying(found)))


def tolerance_length(tolerance: float | str, contour: Contour) -> float:
    """A tolerance as a length in data units: a number, or a part of the box diagonal in per cent.

    Examples
    --------
    >>> tolerance_length("0.5%", Contour([(0, 0), (3, 4)]))
    0.025
    """
    length = np.nan
    if isinstance(tolerance, str):
        text = tolerance.strip()
        with suppress(ValueError):
            length = float(text.removesuffix("%"))
        if text.endswith("%"):
            length *= 0.01 * contour.box_diagonal
    elif is_number(tolerance):
        length = float(tolerance)
    if not 0 < length < np.inf:
        raise InvalidInputError(
            "tolerance must be a positive length in data units, or a part of the box diagonal"
            f" such as '0.1%', got {tolerance!r}"
        )
    return length


def _contour(points: ArrayLike | Contour, closed: bool | None) -> Contour:
    if not isinstance(points, Contour):
        return Contour(points, closed)
    if closed is None or closed == points.closed:
        return points
    return Contour.silently(points.points[points.source], closed, accuracy=points.accuracy)


def _check_choice(name: str, value: object, choices: tuple[str, ...]) -> None:
    if value not in choices:
        raise InvalidInputError(f"{name} must be one of {', '.join(choices)}, got {value!r}")


def _within(
    contour: Contour,
    tolerance: float,
    degree: int,
    corners: Literal["auto", "free"] | ArrayLike | None,
    form: Form,
    ends: Ends,
    effort: Effort,
    watch: Watch,
) -> Fit:
    """The smallest curve within a tolerance, of the form that was asked for."""
    corners = _checked_corners(corners, len(contour))
    if form == "spline":
        if not (corners is None or isinstance(corners, str)):
            raise InvalidInputError("corners must be 'auto', 'free' or None for form='spline'")
        single = fit_spline(contour, tolerance, degree=degree, effort=effort, watch=watch)
        return _fit(contour, single.curve, single.distances, tolerance, "removal", watch)
    pieces = fit_pieces(
        contour,
        tolerance,
        corners=corners,
        degree=degree,
        effort=effort,
        ends_fixed=ends == "fixed",
        watch=watch,
    )
    fit = _fit(
        contour, pieces.spline, pieces.distances, tolerance, "sections", watch, pieces.pieces
    )
    if watch.ended_as:
        return fit
    free = isinstance(corners, str) and corners == "free"
    if not free and any(_drawn_straight(piece, contour, tolerance) for piece in pieces.pieces):
        return fit
    may_be_smooth = corners is None or not len(pieces.corners)
    if not may_be_smooth and not free:
        return fit
    single = fit_spline(contour, tolerance, degree=degree, effort=effort, watch=watch)
    smooth = _fit(contour, single.curve, single.distances, tolerance, "removal", watch)
    # Of equals the single spline: it has no joints.
    better = smooth.kept >= fit.kept and smooth.n_stored_points <= fit.n_stored_points
    return smooth if better else _ended(fit, watch)


def _drawn_straight(piece: Piece, contour: Contour, tolerance: float) -> bool:
    """Whether the data along a line are straight themselves, by far more than the tolerance."""
    if piece.degree > 1:
        return False
    begin, side = piece.control_points[0], np.diff(piece.control_points, axis=0)[0]
    length = float(np.hypot(*side))
    along = (contour.points - begin) @ side / length**2
    off = (contour.points - begin) @ np.array([-side[1], side[0]]) / length
    beside = off[(np.abs(along - 0.5) < 0.4) & (np.abs(off) <= tolerance)]
    return len(beside) >= FEWEST_STRAIGHT and float(np.ptp(beside)) <= STRAIGHT_PART * tolerance


def _ended(fit: Fit, watch: Watch) -> Fit:
    """The fit with what the watch has seen since."""
    return replace(fit, status=watch.verdict(fit.status), history=tuple(watch.history))


def _renumbered(
    corners: Literal["auto", "free"] | ArrayLike | None, left_out: IntArray, n: int
) -> Literal["auto", "free"] | ArrayLike | None:
    """The corners among the points that stay."""
    corners = _checked_corners(corners, n)
    if corners is None or isinstance(corners, str):
        return corners
    staying = np.setdiff1d(corners, left_out)
    return staying - np.searchsorted(left_out, staying)


def _checked_corners(
    corners: Literal["auto", "free"] | ArrayLike | None, n: int
) -> Literal["auto", "free"] | ArrayLike | None:
    if corners is None or (isinstance(corners, str) and corners in ("auto", "free")):
        return corners
    message = f"corners must be 'auto', 'free', None or indices below {n}, got {corners!r}"
    if isinstance(corners, str):
        raise InvalidInputError(message)
    given = float_array(corners, "corners").ravel()
    if (given != np.floor(given)).any() or (given < 0).any() or (given >= n).any():
        raise InvalidInputError(message)
    return np.unique(given.astype(np.int64))


def _fit(
    contour: Contour,
    spline: BSplineCurve,
    distances: Distances,
    tolerance: float,
    method: str,
    watch: Watch,
    sections: tuple[Piece, ...] = (),
) -> Fit:
    """The Fit of a verified curve, with a status that is a true sentence."""
    figures = (
        f"data to curve {distances.max_distance:.6g},"
        f" curve to data {distances.reverse_distance:.6g}"
    )
    if distances.hausdorff_distance <= tolerance:
        status = Status.KEPT.saying(f"tolerance {tolerance:.6g} kept: {figures}")
    else:
        status = Status.EXCEEDED.saying(
            f"tolerance {tolerance:.6g} not kept: {figures}; take a larger one"
        )
    return Fit(
        spline=spline,
        contour=contour,
        parameters=distances.parameters[contour.source],
        max_distance=distances.max_distance,
        rms_distance=distances.rms_distance,
        hausdorff_distance=distances.hausdorff_distance,
        tolerance=tolerance,
        status=watch.verdict(status),
        history=tuple(watch.history),
        method=method,
        sections=sections,
    )
