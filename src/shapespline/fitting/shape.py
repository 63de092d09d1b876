"""fit_shape: every contour of a Shape, nesting kept."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np

from shapespline.analysis import shared_arcs
from shapespline.errors import InvalidInputError
from shapespline.fitting.curve import fit_curve
from shapespline.fitting.repair.crossings import uncrossed
from shapespline.fitting.verify import verified_fit
from shapespline.fitting.within import Effort, Ends, Form, tolerance_length
from shapespline.geometry import backwards, joined, reversed_curve
from shapespline.values import Contour, Drawing, Shape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.fitting.repair.refit import Tangents
    from shapespline.monitor import Callback
    from shapespline.values import Fit, Piece

# Of the tolerance: points of two contours that are no farther apart are one point of a boundary.
SNAP_PART = 0.01


def fit_shape(
    shape: Shape,
    *,
    tolerance: float | str | None = None,
    n_control_points: int | None = None,
    degree: int = 3,
    corners: Literal["auto", "free"] | None = "auto",
    form: Form = "pieces",
    effort: Effort = "balanced",
    method: str = "levenberg-marquardt",
    callback: Callback | None = None,
    time_limit: float | None = None,
    ends: Ends = "free",
    symmetric: bool = False,
    outliers: bool = False,
    shared_boundaries: bool = False,
) -> Drawing:
    """Fit a B-spline curve to each contour of a shape.

    Contours that do not cross stay uncrossed: where two curves do, both are fitted more closely.

    Parameters
    ----------
    shape : Shape
    tolerance : float or str, optional
        Data units, or a part of the box diagonal of the whole shape, such as ``"0.1%"``.
    n_control_points : int, optional
        Number of control points of each curve; chosen for each contour when neither is given.
    degree, corners, form, effort, method, callback, time_limit, ends, symmetric, outliers
        See `fit_curve`; the limit is that of each contour.
    shared_boundaries : bool
        Fit boundaries that contours share (the same points, as far as a hundredth of the
        tolerance) once: their pieces are the same in both to the bit. Needs a tolerance.

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
            " make one with Shape([contour]), or call fit_curve"
        )
    if isinstance(tolerance, str):
        everything = Contour.silently(np.concatenate([c.points for c in shape]), closed=False)
        tolerance = tolerance_length(tolerance, everything)

    def fit(contour: Contour, within: float | None, ends: Ends = ends) -> Fit:
        return fit_curve(
            contour,
            tolerance=within,
            n_control_points=n_control_points,
            degree=degree,
            corners=corners,
            form=form,
            effort=effort,
            method=method,
            callback=callback,
            time_limit=time_limit,
            ends=ends,
            symmetric=symmetric,
            outliers=outliers,
        )

    def closer(part: Contour, within: float, tangents: Tangents, through: Sequence[int]) -> Fit:
        free = corners == "free" or all(tangent is None for tangent in tangents)
        return fit_curve(
            part,
            tolerance=within,
            degree=degree,
            corners=corners,
            effort=effort,
            ends="fixed",
            end_tangents=None if free else tangents,
            through=through or None,
        )

    if shared_boundaries:
        if tolerance is None or outliers:
            raise InvalidInputError("shared_boundaries need a tolerance, and exclude outliers")
        fits = _with_shared(shape, tolerance, degree, fit)
    else:
        fits = [
            _named(index, shape, contour, tolerance, fit) for index, contour in enumerate(shape)
        ]
        if n_control_points is None:
            fits = uncrossed(shape.contours, fits, closer)
    return Drawing(fits, shape.parents, shape.frame, shape.unit)


class _FitContour(Protocol):
    """fit_curve with the options of the caller."""

    def __call__(self, contour: Contour, within: float | None, ends: Ends = ...) -> Fit: ...


def _named(
    index: int, shape: Shape, contour: Contour, within: float | None, fit: _FitContour
) -> Fit:
    """The fit of a contour; an error tells which one it is."""
    try:
        return fit(contour, within)
    except InvalidInputError as error:
        if len(shape) == 1:
            raise
        raise type(error)(f"contour {index} of {len(shape)}: {error}") from error


def _with_shared(shape: Shape, tolerance: float, degree: int, fit: _FitContour) -> list[Fit]:
    """Fits of all contours, boundaries that they share fitted once."""
    snap = SNAP_PART * tolerance
    arcs = shared_arcs(shape.contours, snap)
    curves = [
        fit(Contour.silently(points, closed), tolerance - snap, "fixed")
        for points, closed in zip(arcs.points, arcs.closed, strict=True)
    ]
    fits = []
    for index, (contour, uses) in enumerate(zip(shape, arcs.uses, strict=True)):
        if not uses:
            fits.append(_named(index, shape, contour, tolerance, fit))
            continue
        first = curves[uses[0].arc]
        sections: tuple[Piece, ...] = ()
        if arcs.closed[uses[0].arc] and not first.sections:
            spline = reversed_curve(first.spline) if uses[0].backwards else first.spline
        else:
            for use in uses:
                pieces = curves[use.arc].pieces
                sections += backwards(pieces) if use.backwards else pieces
            spline = joined(sections, degree)
        fits.append(
            verified_fit(
                contour, spline, tolerance=tolerance, method=first.method, sections=sections
            )
        )
    return fits
