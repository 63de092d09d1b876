"""The smallest curve within a tolerance: chooses between pieces and one spline."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from shapespline.analysis import (
    FEWEST_STRAIGHT,
    LEAST_TURN,
    STRAIGHT_PART,
    filled,
    has_straight_runs,
)
from shapespline.engines.pieces import (
    ROUGH_PART,
    Constraints,
    PiecesProblem,
    fit_mirrored,
    fit_pieces,
)
from shapespline.engines.spline import fit_spline, rule_report
from shapespline.errors import InvalidInputError
from shapespline.fitting.verify import final_status, verified_fit
from shapespline.validation import float_array, is_number
from shapespline.values import Status

if TYPE_CHECKING:
    from shapespline.analysis import NormalizedContour
    from shapespline.engines.pieces import PiecesResult
    from shapespline.monitor import Monitor
    from shapespline.typing import ArrayLike, FloatArray, IntArray
    from shapespline.values import Contour, Fit, Piece

# Of the joints between lines that stand for a curve so many turn less than corners.
FACETS_PART = 0.25

Form = Literal["pieces", "spline"]
Ends = Literal["free", "fixed"]
Effort = Literal["fast", "balanced", "smallest"]


class Wanted(NamedTuple):
    """What a curve within a tolerance is to be, as `fit_curve` takes it."""

    degree: int
    corners: Literal["auto", "free"] | ArrayLike | None
    form: Form
    effort: Effort
    held: Constraints = Constraints()
    symmetric: bool = False


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
    wanted: Wanted,
    monitor: Monitor,
    outline: PiecesProblem | None = None,
    dense: Contour | None = None,
) -> Fit:
    """The smallest curve within a tolerance, of the form that was asked for.

    ``outline`` is the search's view of the contour where it is known, and ``dense`` holds points
    as they came where the contour holds thinned ones.
    """
    degree, corners, form, effort, held, symmetric = wanted
    corners = checked_corners(corners, len(contour))
    if form == "spline":
        if not (corners is None or isinstance(corners, str)):
            raise InvalidInputError("corners must be 'auto', 'free' or None for form='spline'")
        if held.anything:
            raise InvalidInputError("end_tangents and through act with form='pieces' only")
        if symmetric:
            raise InvalidInputError("symmetric acts with form='pieces' only")
        return _single(contour, tolerance, degree, effort, monitor)
    free = isinstance(corners, str) and corners == "free"
    if free and any(tangent is not None for tangent in held.tangents):
        raise InvalidInputError(
            "end_tangents do not act with corners='free': joints are free there"
        )
    if outline is None:
        outline = PiecesProblem.of(contour, tolerance, corners, held)
    smooth = None
    if not (len(outline.corners) or held.anything or symmetric or _has_straight_runs(outline)):
        smooth = _single(contour, tolerance, degree, effort, monitor, outline.frame)
        if _followed(smooth) or monitor.ended:
            return smooth
    mirrored = None
    if not (free or held.anything) and (symmetric or effort != "fast"):
        mirrored = fit_mirrored(
            contour, tolerance, degree=degree, effort=effort, monitor=monitor, outline=outline
        )
    if mirrored is None or not symmetric:
        found = fit_pieces(
            contour,
            tolerance,
            corners=corners,
            degree=degree,
            effort=effort,
            held=held,
            monitor=monitor,
            outline=outline,
        )
    if mirrored is not None and (symmetric or mirrored.n_stored_points <= found.n_stored_points):
        found = mirrored
    fit = _ended(
        verified_fit(
            contour,
            found.spline,
            tolerance=tolerance,
            method="sections",
            sections=found.pieces,
            distances=found.distances,
        ),
        monitor,
    )
    if found.tangent_error:
        turn = np.degrees(found.tangent_error)
        fit = replace(
            fit,
            status=Status.EXCEEDED.saying(
                f"an end tangent is missed by {turn:.3g} degrees: {fit.status.value}; take a larger"
                " tolerance, or a tangent nearer to the data"
            ),
        )
    if found is mirrored and symmetric:
        return fit
    cornered = len(outline.corners) > 0 and not free
    if monitor.ended or held.anything:
        return fit
    if cornered and not (isinstance(corners, str) and _in_facets(found)):
        return fit
    drawn = filled(contour if dense is None else dense)
    if not free and any(_drawn_straight(piece, drawn, tolerance) for piece in found.pieces):
        return fit
    smooth = smooth or _single(contour, tolerance, degree, effort, monitor, outline.frame)
    # Of equals the single spline: it has no joints. Nor has it corners where the data have none.
    if not (free or cornered) and len(found.corners) and _followed(smooth):
        return smooth
    better = smooth.kept >= fit.kept and smooth.n_stored_points <= fit.n_stored_points
    if cornered:  # without a cusp in place of a corner
        better = better and rule_report(smooth.spline, contour).kept
    return smooth if better else _ended(fit, monitor)


def _has_straight_runs(outline: PiecesProblem) -> bool:
    """Whether some of the data of a problem are straight, as they came."""
    seen = outline.frame.contour if outline.dense is None else outline.dense
    return has_straight_runs(seen, outline.tolerance)


def _single(
    contour: Contour,
    tolerance: float,
    degree: int,
    effort: Effort,
    monitor: Monitor,
    frame: NormalizedContour | None = None,
) -> Fit:
    """The smallest single spline within a tolerance."""
    found = fit_spline(
        contour, tolerance, degree=degree, effort=effort, monitor=monitor, frame=frame
    )
    fit = verified_fit(
        contour, found.curve, tolerance=tolerance, method="removal", distances=found.distances
    )
    return _ended(fit, monitor)


def _followed(fit: Fit) -> bool:
    """Whether a fit keeps its tolerance with few points for those of the data."""
    return fit.kept and fit.n_stored_points <= ROUGH_PART * len(fit.contour)


def _in_facets(found: PiecesResult) -> bool:
    """Whether lines stand for a curve: many of the joints between them turn less than corners."""
    if any(piece.degree > 1 for piece in found.pieces):
        return False
    turns = np.abs(list(found.turns()))
    gentle = np.count_nonzero(turns < LEAST_TURN)
    return bool(len(turns) and gentle >= FACETS_PART * len(turns))


def _drawn_straight(piece: Piece, contour: Contour, tolerance: float) -> bool:
    """Whether the data along a line are straight themselves, by far more than the tolerance."""
    if piece.degree > 1:
        return False
    begin, side = piece.control_points[0], np.diff(piece.control_points, axis=0)[0]
    length = float(np.hypot(*side))
    along = (contour.points - begin) @ side / length**2
    off = (contour.points - begin) @ np.array([-side[1], side[0]]) / length
    beside = (np.abs(along - 0.5) < 0.4) & (np.abs(off) <= tolerance)
    if np.count_nonzero(beside) < FEWEST_STRAIGHT:
        return False
    # They may lie on another line, within the tolerance.
    tilt = np.polynomial.Polynomial.fit(along[beside], off[beside], 1)
    return float(np.ptp(off[beside] - tilt(along[beside]))) <= STRAIGHT_PART * tolerance


def _ended(fit: Fit, monitor: Monitor) -> Fit:
    """The fit with what the monitor has seen since."""
    return replace(fit, status=final_status(fit.status, monitor), history=tuple(monitor.history))


def check_size_alone(corners: object, form: object, effort: object) -> None:
    """Raise if something is said that only acts within a tolerance."""
    for name, value, default in (
        ("corners", corners, "auto"),
        ("form", form, "pieces"),
        ("effort", effort, "balanced"),
    ):
        if not (isinstance(value, str) and value == default):
            raise InvalidInputError(
                f"{name} does not act with n_control_points: leave one of them out"
            )


def checked_corners(
    corners: Literal["auto", "free"] | ArrayLike | None, n: int
) -> Literal["auto", "free"] | ArrayLike | None:
    """The corners as a caller may say them; indices sorted, each once."""
    if corners is None or (isinstance(corners, str) and corners in ("auto", "free")):
        return corners
    return _checked_indices(corners, n, "corners must be 'auto', 'free', None or indices below")


def checked_held(
    contour: Contour,
    ends: Ends,
    end_tangents: tuple[ArrayLike | None, ArrayLike | None] | None,
    through: ArrayLike | None,
) -> Constraints:
    """What a fit must keep exactly, as a caller may say it.

    Examples
    --------
    >>> from shapespline import Contour
    >>> held = checked_held(Contour([(0, 0), (4, 3)]), "free", ((0, 5), None), None)
    >>> held.ends, held.tangents
    (True, (array([0., 1.]), None))
    """
    n = len(contour)
    nodes = np.empty(0, dtype=np.int64)
    if through is not None:
        nodes = _checked_indices(through, n, "through must be None or indices below")
    tangents: tuple[FloatArray | None, FloatArray | None] = (None, None)
    if end_tangents is not None:
        if contour.closed:
            raise InvalidInputError("end_tangents act on open curves only: pass closed=False")
        message = (
            "end_tangents must be a pair of vectors (x, y), None where the direction is free,"
            f" got {end_tangents!r}"
        )
        if isinstance(end_tangents, str) or not isinstance(end_tangents, Sequence | np.ndarray):
            raise InvalidInputError(message)
        if len(end_tangents) != 2:
            raise InvalidInputError(message)
        begin, end = (None if t is None else _direction(t, message) for t in end_tangents)
        tangents = (begin, end)
    at_ends = not contour.closed and bool(np.isin(nodes, (0, n - 1)).any())
    fixed = ends == "fixed" or at_ends or any(tangent is not None for tangent in tangents)
    return Constraints(fixed, nodes, tangents)


def _direction(vector: ArrayLike, message: str) -> FloatArray:
    """A unit vector."""
    given = float_array(vector, "end_tangents")
    length = float(np.hypot(*given)) if given.shape == (2,) else 0.0
    if not 0 < length < np.inf:
        raise InvalidInputError(message)
    return given / length


def _checked_indices(values: ArrayLike, n: int, message: str) -> IntArray:
    """Indices of a contour's points, sorted, each once."""
    if isinstance(values, str):
        raise InvalidInputError(f"{message} {n}, got {values!r}")
    given = float_array(values, message.split()[0]).ravel()
    if (given != np.floor(given)).any() or (given < 0).any() or (given >= n).any():
        raise InvalidInputError(f"{message} {n}, got {values!r}")
    return np.unique(given.astype(np.int64))
