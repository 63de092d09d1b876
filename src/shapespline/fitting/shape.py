"""fit_shape: every contour of a Shape, nesting kept."""

from __future__ import annotations

from dataclasses import dataclass, replace
from operator import is_
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import shared_arcs
from shapespline.errors import InvalidInputError
from shapespline.fitting.across import across_outlines
from shapespline.fitting.alike import read_alike
from shapespline.fitting.copies import equal_copies
from shapespline.fitting.repair import uncrossed
from shapespline.fitting.request import Request
from shapespline.fitting.settings import Settings, tolerance_length
from shapespline.fitting.solve import answer, solve
from shapespline.fitting.verify import verified_fit
from shapespline.geometry import backwards, joined, reversed_curve
from shapespline.monitor import Monitor
from shapespline.validation import checked_flag
from shapespline.values import Contour, Drawing, Shape

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapespline.monitor import Callback
    from shapespline.typing import (
        ArrayLike,
        Character,
        CornerChoice,
        Effort,
        Ends,
        FloatArray,
        Form,
        Loss,
    )
    from shapespline.values import Fit, Piece, Regularity

# Of the tolerance: points of two contours that are no farther apart are one point of a boundary;
# of the largest contour, where there is none.
SNAP_PART, ROUNDING = 0.01, 1e-12


def fit_shape(
    shape: Shape,
    *,
    tolerance: float | str | None = None,
    n_control_points: int | None = None,
    degree: int = 3,
    corners: CornerChoice | None = "auto",
    form: Form = "pieces",
    effort: Effort = "balanced",
    method: str = "levenberg-marquardt",
    callback: Callback | None = None,
    time_limit: float | None = None,
    ends: Ends = "free",
    symmetric: bool = False,
    character: Character | None = None,
    regularities: str | Sequence[str] | None = "auto",
    simplify: bool = False,
    smoothness: int = 1,
    outliers: bool = False,
    sigma: ArrayLike | None = None,
    loss: Loss | None = None,
    shared_boundaries: bool = False,
    progress: Callable[[int, int], object] | None = None,
) -> Drawing:
    """Fit a B-spline curve to each contour of a shape.

    Contours that do not cross stay uncrossed: where two curves do, both are fitted more closely.
    With ``character="drawn"`` equal holes, copies and equal steps between them hold exactly where
    the points allow it; ``drawing.regularities`` lists them.

    Parameters
    ----------
    shape : Shape
    tolerance : float or str, optional
        Data units, or a part of the box diagonal of the whole shape, such as ``"0.1%"``.
    n_control_points : int, optional
        Number of control points of each curve; chosen for each contour when neither is given.
    degree, corners, form, effort, method, callback, time_limit, ends, symmetric, character,
    regularities, simplify, smoothness, outliers
        See `fit_curve`; the limit is that of each contour.
    sigma, loss
        See `fit_curve`; of several contours a length, the error of all points.
    shared_boundaries : bool
        Fit boundaries that contours share (the same points, as far as a hundredth of the
        tolerance, or a rounding) once: their pieces are the same in both to the bit.
    progress : callable, optional
        Called with the number of curves done and of all, before each and at the end.

    Returns
    -------
    Drawing
        One fit per contour, in their order, with their nesting, frame and unit.

    Raises
    ------
    InvalidInputError
        If a contour cannot be fitted as asked; the message says which.

    Examples
    --------
    >>> import shapespline as ss
    >>> square = ss.Contour([(0, 0), (2, 0), (2, 2), (0, 2)], closed=True).resampled(80)
    >>> drawing = fit_shape(ss.Shape([square]), n_control_points=12)
    >>> len(drawing), drawing.fits[0].n_control_points
    (1, 12)
    """
    if not isinstance(shape, Shape):
        raise InvalidInputError(
            f"shape must be a Shape, got {type(shape).__name__};"
            " make one with Shape([contour]), read a geometry or a file, or call fit_curve"
        )
    settings = Settings(
        tolerance=tolerance,
        n_control_points=n_control_points,
        degree=degree,
        corners=corners,
        form=form,
        ends=ends,
        symmetric=symmetric,
        character=character,
        regularities=regularities,
        simplify=simplify,
        smoothness=smoothness,
        effort=effort,
        outliers=outliers,
        sigma=sigma,
        loss=loss,
        method=method,
        time_limit=time_limit,
    )
    request = DrawingRequest.of(shape, settings, shared_boundaries)
    fits, together = _solved(request, callback, progress or _silent)
    return Drawing.of(shape, fits, regularities=together)


@dataclass(frozen=True, eq=False)
class DrawingRequest:
    """What is asked of a shape: settings for each contour, and what belongs to several of them.

    ``settings`` hold a tolerance as a length. Boundaries that contours share are fitted once if
    ``shared_boundaries`` says so; else curves must not cross where their data do not.
    """

    shape: Shape
    settings: Settings
    shared_boundaries: bool = False

    @classmethod
    def of(cls, shape: Shape, settings: Settings, shared_boundaries: object) -> DrawingRequest:
        """The request, checked; a tolerance in per cent is one of the whole shape's box."""
        shared = checked_flag("shared_boundaries", shared_boundaries)
        if shared and (settings.n_control_points is not None or settings.outliers):
            raise InvalidInputError(
                "shared_boundaries exclude n_control_points and outliers: give a tolerance, or none"
            )
        if shared and settings.smoothness == 2:
            raise InvalidInputError(
                "smoothness=2 does not act with shared_boundaries: borders meet where they must"
            )
        if settings.sigma is not None and len(shape) > 1 and np.ndim(settings.sigma):
            raise InvalidInputError(
                f"sigma must be one length for the {len(shape)} contours of a shape, got shape"
                f" {np.shape(settings.sigma)}; fit them one by one with fit_curve"
            )
        if isinstance(settings.tolerance, str):
            everything = Contour.silently(np.concatenate([c.points for c in shape]), closed=False)
            settings = replace(settings, tolerance=tolerance_length(settings.tolerance, everything))
        return cls(shape, settings, shared)

    @property
    def length(self) -> float | None:
        """The tolerance as a length."""
        tolerance = self.settings.tolerance
        return None if tolerance is None else tolerance_length(tolerance, self.shape.contours[0])

    def of_contour(self, index: int) -> Request:
        """The request for one contour; an error tells which one it is."""
        contour, settings = self.shape.contours[index], self.settings
        if settings.symmetric and not contour.closed:
            settings = replace(settings, symmetric=False)
        try:
            return Request.of(contour, None, settings)
        except InvalidInputError as error:
            if len(self.shape) == 1:
                raise
            raise type(error)(f"contour {index} of {len(self.shape)}: {error}") from error


def _silent(done: int, total: int) -> None:
    """Where nobody wants to hear of progress."""


def _solved(
    request: DrawingRequest, callback: Callback | None, progress: Callable[[int, int], object]
) -> tuple[list[Fit], tuple[Regularity, ...]]:
    """The fit of each contour, and what they keep together."""

    def monitor() -> Monitor:
        return Monitor(callback, request.settings.time_limit)

    if request.shared_boundaries:
        return _with_shared(request, monitor, progress)
    requests = [request.of_contour(index) for index in range(len(request.shape))]
    fits = _one_by_one(requests, monitor, progress)
    if request.settings.n_control_points is not None:
        return fits, ()
    return _together(fits, requests[0], request.length, monitor)


def _together(
    fits: list[Fit], asked: Request, tolerance: float | None, monitor: Callable[[], Monitor]
) -> tuple[list[Fit], tuple[Regularity, ...]]:
    """Fits under what they keep together, uncrossed; and what that is."""
    allowed = asked.style.regularities
    alone = fits
    copied = asked.style.character == "drawn" and "equal-copies" in allowed
    if copied:
        fits = read_alike(fits, tolerance)
    fits, found = across_outlines(fits, allowed, tolerance)
    if copied:
        fits, equal = equal_copies(fits, tolerance)
        found += equal
    each_is_told = tolerance is not None and all(map(is_, fits, alone))
    apart = uncrossed(fits, asked, lambda part: answer(part, monitor()), each_is_told=each_is_told)
    same = {k for k, (one, now) in enumerate(zip(fits, apart, strict=True)) if one is now}
    return apart, tuple(one for one in found if same.issuperset(one.pieces))


def _one_by_one(
    requests: Sequence[Request],
    monitor: Callable[[], Monitor],
    progress: Callable[[int, int], object],
) -> list[Fit]:
    """The fits of some requests, the progress told."""
    fits = []
    for index, request in enumerate(requests):
        progress(index, len(requests))
        fits.append(solve(request, monitor()))
    progress(len(requests), len(requests))
    return fits


def _with_shared(
    request: DrawingRequest,
    monitor: Callable[[], Monitor],
    progress: Callable[[int, int], object],
) -> tuple[list[Fit], tuple[Regularity, ...]]:
    """Fits of all contours, boundaries that they share fitted once; and what they keep together."""
    shape, tolerance = request.shape, request.length
    extent = max(contour.box_diagonal for contour in shape)
    snap = ROUNDING * extent if tolerance is None else SNAP_PART * tolerance
    arcs = shared_arcs(shape.contours, snap)
    # A contour is as far from its points as from those of its borders, and arcs from their twins.
    within = None if tolerance is None else tolerance - 2 * snap
    settings = replace(request.settings, tolerance=within, symmetric=False)
    # The first contour that each border bounds.
    users = {use.arc: k for k, uses in reversed([*enumerate(arcs.uses)]) for use in uses}
    alone = [k for k, uses in enumerate(arcs.uses) if not uses]
    rings = [arc for arc, closed in enumerate(arcs.closed) if closed]
    between = [arc for arc, closed in enumerate(arcs.closed) if not closed]
    requests = [request.of_contour(k) for k in alone]
    for arc in (*rings, *between):
        border = _border(arcs.points[arc], arcs.closed[arc], shape.contours[users[arc]])
        ends: Ends = settings.ends if arcs.closed[arc] else "fixed"
        requests.append(Request.of(border, None, replace(settings, ends=ends)))
    fits = _one_by_one(requests, monitor, progress)
    n_whole = len(alone) + len(rings)
    whole, found = _together(fits[:n_whole], requests[0], within, monitor)
    curves = dict(zip((*rings, *between), whole[len(alone) :] + fits[n_whole:], strict=True))
    own = dict(zip(alone, whole, strict=False))
    if tolerance is not None:
        own = {k: replace(fit, tolerance=tolerance) for k, fit in own.items()}
    of_contours = [
        _around(contour, [(curves[use.arc], use.backwards) for use in uses], tolerance)
        if uses
        else own[k]
        for k, (contour, uses) in enumerate(zip(shape, arcs.uses, strict=True))
    ]
    where = alone + [users[arc] for arc in rings]
    return of_contours, tuple(
        one._replace(pieces=tuple(where[k] for k in one.pieces)) for one in found
    )


def _border(points: FloatArray, closed: bool, contour: Contour) -> Contour:
    """The points of a border as known as those of a contour that it bounds."""
    traced = contour.level_line is not None
    return Contour.silently(
        points, closed, accuracy=contour.accuracy, level_line=points if traced else None
    )


def _around(contour: Contour, borders: Sequence[tuple[Fit, bool]], tolerance: float | None) -> Fit:
    """The fit of a contour from those of its borders, and whether each is run backwards."""
    first, backward = borders[0]
    sections: tuple[Piece, ...] = ()
    kept: list[Regularity] = []
    if first.contour.closed and not first.sections:
        spline = reversed_curve(first.spline) if backward else first.spline
    else:
        for border, turned in borders:
            own, begin = border.pieces, len(sections)
            sections += backwards(own) if turned else own
            places = range(len(own) - 1, -1, -1) if turned else range(len(own))
            kept += [
                one._replace(pieces=tuple(begin + places[k] for k in one.pieces))
                for one in border.regularities
            ]
        spline = joined(sections, first.degree)
    fit = verified_fit(contour, spline, tolerance=tolerance, method=first.method, sections=sections)
    return replace(fit, regularities=tuple(kept))
