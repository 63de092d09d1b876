"""fit_curve: points in, verified Fit out. Chooses among the engines."""

from __future__ import annotations

import warnings
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from shapespline.arrays import float_array, is_number
from shapespline.balance import STRAY_WEIGHT, balanced_start
from shapespline.contour import Contour
from shapespline.errors import (
    DegenerateContourError,
    InvalidInputError,
    ShuffledPointsWarning,
)
from shapespline.estimation import (
    FARTHEST,
    FINAL_LIMITS,
    Evidence,
    estimated_pieces,
    resolution,
    smooth_start,
)
from shapespline.frame import WorkingFrame, reversed_curve
from shapespline.joining import joined
from shapespline.knots import check_count, check_degree
from shapespline.optimization import checked_weights, optimize
from shapespline.ordering import looks_shuffled
from shapespline.placement import dominant_start, uniform_start
from shapespline.removal import fit_spline
from shapespline.sections import fit_pieces
from shapespline.verification import verified_fit

if TYPE_CHECKING:
    from shapespline.balance import Balanced
    from shapespline.drawing import Fit
    from shapespline.optimization import Callback
    from shapespline.typing import ArrayLike

Form = Literal["pieces", "spline"]
Effort = Literal["fast", "balanced", "smallest"]
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
    effort: Effort = "balanced",
    weights: ArrayLike | None = None,
    knots: Knots = "balanced",
    method: str = "levenberg-marquardt",
    callback: Callback | None = None,
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
    effort : {"fast", "balanced", "smallest"}
        How long to search.
    weights : array_like, shape (n,), optional
        One positive weight per point, for least squares.
    knots : {"balanced", "dominant", "uniform"}
        With a number of control points: spread until every span errs as much, or for comparison
        at dominant points or equally spaced.
    method : str
        For least squares; see `optimize`.
    callback : callable, optional
        Called with every Iteration of a least-squares run; a true answer cancels it.

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
    one_spline = n_control_points is not None or weights is not None
    if len(contour) < degree + 1 and tolerance is None and one_spline:
        raise DegenerateContourError(
            f"points must hold at least degree + 1 = {degree + 1} distinct points for degree"
            f" {degree}, got {len(contour)}; add points or lower the degree"
        )
    _check_choice("form", form, get_args(Form))
    _check_choice("effort", effort, get_args(Effort))
    _check_choice("knots", knots, get_args(Knots))
    if knots != "balanced" and n_control_points is None:
        raise InvalidInputError("knots act with n_control_points only: give a number of them")
    if tolerance is not None and n_control_points is not None:
        raise InvalidInputError("tolerance and n_control_points exclude each other: give one")
    if n_control_points is not None:
        for name, value, default in (
            ("corners", corners, "auto"),
            ("form", form, "pieces"),
            ("effort", effort, "balanced"),
        ):
            if not (isinstance(value, str) and value == default):
                raise InvalidInputError(
                    f"{name} does not act with n_control_points: leave one of them out"
                )
    if tolerance is not None:
        if weights is not None:
            raise InvalidInputError("weights act in least squares only: leave out the tolerance")
        return _within(contour, tolerance_length(tolerance, contour), degree, corners, form, effort)
    summed = checked_weights(weights, contour)
    if n_control_points is None:
        if weights is None:
            return _estimated(contour, degree, corners, form, effort, method, callback)
        start = smooth_start(contour, degree, summed)
        return _finished(contour, start, method, weights, callback)
    count = check_count(n_control_points, degree)
    if count > len(contour):
        raise InvalidInputError(
            f"n_control_points must be at most the number of distinct points, {len(contour)},"
            f" got {count}; lower it"
        )
    return optimize(
        contour,
        STARTS[knots](contour, count, degree, summed),
        method,
        weights=weights,
        stray_weight=STRAY_WEIGHT,
        limits=FINAL_LIMITS,
        callback=callback,
    )


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
    effort: Effort,
) -> Fit:
    """The smallest curve within a tolerance, of the form that was asked for."""
    corners = _checked_corners(corners, len(contour))
    if form == "spline":
        if not (corners is None or isinstance(corners, str)):
            raise InvalidInputError("corners must be 'auto', 'free' or None for form='spline'")
        return _single(contour, tolerance, degree, effort)
    pieces = fit_pieces(contour, tolerance, corners=corners, degree=degree, effort=effort)
    fit = verified_fit(
        contour,
        pieces.spline,
        tolerance=tolerance,
        method="sections",
        sections=pieces.pieces,
        distances=pieces.distances,
    )
    straight = any(piece.kind == "line" for piece in pieces.pieces)
    may_be_smooth = corners is None or not (len(pieces.corners) or straight)
    if not may_be_smooth and not (isinstance(corners, str) and corners == "free"):
        return fit
    smooth = _single(contour, tolerance, degree, effort)
    # Of equals the single spline: it has no joints.
    better = smooth.kept >= fit.kept and smooth.n_stored_points <= fit.n_stored_points
    return smooth if better else fit


def _single(contour: Contour, tolerance: float, degree: int, effort: Effort) -> Fit:
    """The smallest single spline within a tolerance."""
    found = fit_spline(contour, tolerance, degree=degree, effort=effort)
    return verified_fit(
        contour, found.curve, tolerance=tolerance, method="removal", distances=found.distances
    )


def _estimated(
    contour: Contour,
    degree: int,
    corners: Literal["auto", "free"] | ArrayLike | None,
    form: Form,
    effort: Effort,
    method: str,
    callback: Callback | None,
) -> Fit:
    """A curve for points of which nothing else is known.

    Clean points: the smallest curve within what they can show. Noisy ones: pieces, where they tell
    as much of the points as one least-squares spline at the same price, or that spline. Points
    that neither comes near are no noisy curve after all, and are treated as clean ones.
    """
    corners = _checked_corners(corners, len(contour))
    frame = WorkingFrame.of(contour)
    ordered = Contour.silently(
        contour.points[frame.order], contour.closed, accuracy=contour.accuracy
    )
    shown = resolution(ordered)
    if not shown.clean:
        start = smooth_start(ordered, degree)
        smooth = Evidence.of_spline(start, ordered, shown.noise)
        if form == "pieces":
            pieces, said = estimated_pieces(
                contour, shown.noise, corners=corners, degree=degree, effort=effort
            )
            given = not isinstance(corners, str | None)
            one_run = len(pieces) == 1 and pieces[0].kind != "line"
            chosen = given or (said.preferred_to(smooth) and not one_run)
            if chosen and said.farthest <= FARTHEST * shown.band:
                spline = joined(pieces, degree)
                return verified_fit(
                    contour, spline, tolerance=None, method="estimation", sections=pieces
                )
        if smooth.farthest <= FARTHEST * shown.band:
            fit = _finished(ordered, start, method, None, callback)
            spline, parameters = fit.spline, fit.parameters[frame.place][contour.source]
            if frame.reversed:
                spline, parameters = reversed_curve(spline), 1.0 - parameters
            return replace(fit, contour=contour, spline=spline, parameters=parameters)
    fit = _within(contour, shown.band, degree, corners, form, effort)
    return verified_fit(
        contour, fit.spline, tolerance=None, method=fit.method, sections=fit.sections
    )


def _finished(
    contour: Contour,
    start: Balanced,
    method: str,
    weights: ArrayLike | None,
    callback: Callback | None,
) -> Fit:
    """Least squares to the end from a start whose size was chosen, its ends free to leave noise."""
    return optimize(
        contour,
        start,
        method,
        weights=weights,
        ends=None if contour.closed else "fitted",
        stray_weight=STRAY_WEIGHT,
        limits=FINAL_LIMITS,
        callback=callback,
    )


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
