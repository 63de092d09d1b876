"""The smallest curve within a tolerance: chooses between pieces and one spline."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from shapespline.arrays import float_array, is_number
from shapespline.errors import InvalidInputError
from shapespline.outline import FEWEST_STRAIGHT, STRAIGHT_PART, SearchOutline
from shapespline.removal import fit_spline
from shapespline.sections import ROUGH_PART, fit_pieces
from shapespline.verification import verified_fit

if TYPE_CHECKING:
    from shapespline.contour import Contour
    from shapespline.drawing import Fit, Piece
    from shapespline.frame import WorkingFrame
    from shapespline.progress import Watch
    from shapespline.typing import ArrayLike

Form = Literal["pieces", "spline"]
Ends = Literal["free", "fixed"]
Effort = Literal["fast", "balanced", "smallest"]


def tolerance_length(tolerance: float | str, contour: Contour) -> float:
    """A tolerance as a length in data units: a number, or a part of the box diagonal in per cent.

    Examples
    --------
    >>> from shapespline import Contour
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


def fit_within(
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
    corners = checked_corners(corners, len(contour))
    if form == "spline":
        if not (corners is None or isinstance(corners, str)):
            raise InvalidInputError("corners must be 'auto', 'free' or None for form='spline'")
        return _single(contour, tolerance, degree, effort, watch)
    free = isinstance(corners, str) and corners == "free"
    outline = SearchOutline.of(contour, tolerance, corners)
    smooth = None
    if not len(outline.corners) and not outline.has_straight_runs:
        smooth = _single(contour, tolerance, degree, effort, watch, outline.frame)
        if _followed(smooth) or watch.ended_as:
            return smooth
    found = fit_pieces(
        contour,
        tolerance,
        corners=corners,
        degree=degree,
        effort=effort,
        ends_fixed=ends == "fixed",
        watch=watch,
        outline=outline,
    )
    fit = _ended(
        verified_fit(
            contour,
            found.spline,
            tolerance=tolerance,
            method="sections",
            sections=found.pieces,
            distances=found.distances,
        ),
        watch,
    )
    if watch.ended_as or (len(outline.corners) and not free):
        return fit
    if not free and any(_drawn_straight(piece, contour, tolerance) for piece in found.pieces):
        return fit
    smooth = smooth or _single(contour, tolerance, degree, effort, watch, outline.frame)
    # Of equals the single spline: it has no joints. Nor has it corners where the data have none.
    if not free and len(found.corners) and _followed(smooth):
        return smooth
    better = smooth.kept >= fit.kept and smooth.n_stored_points <= fit.n_stored_points
    return smooth if better else _ended(fit, watch)


def _single(
    contour: Contour,
    tolerance: float,
    degree: int,
    effort: Effort,
    watch: Watch,
    frame: WorkingFrame | None = None,
) -> Fit:
    """The smallest single spline within a tolerance."""
    found = fit_spline(contour, tolerance, degree=degree, effort=effort, watch=watch, frame=frame)
    fit = verified_fit(
        contour, found.curve, tolerance=tolerance, method="removal", distances=found.distances
    )
    return _ended(fit, watch)


def _followed(fit: Fit) -> bool:
    """Whether a fit keeps its tolerance with few points for those of the data."""
    return fit.kept and fit.n_stored_points <= ROUGH_PART * len(fit.contour)


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


def checked_corners(
    corners: Literal["auto", "free"] | ArrayLike | None, n: int
) -> Literal["auto", "free"] | ArrayLike | None:
    """The corners as a caller may say them; indices sorted, each once."""
    if corners is None or (isinstance(corners, str) and corners in ("auto", "free")):
        return corners
    message = f"corners must be 'auto', 'free', None or indices below {n}, got {corners!r}"
    if isinstance(corners, str):
        raise InvalidInputError(message)
    given = float_array(corners, "corners").ravel()
    if (given != np.floor(given)).any() or (given < 0).any() or (given >= n).any():
        raise InvalidInputError(message)
    return np.unique(given.astype(np.int64))
