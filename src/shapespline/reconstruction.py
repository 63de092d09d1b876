"""fit_shape: every contour of a Shape, nesting kept."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from shapespline.contour import Contour, Shape
from shapespline.drawing import Drawing
from shapespline.errors import InvalidInputError
from shapespline.fitting import fit_curve
from shapespline.tolerance import Effort, Ends, Form, tolerance_length

if TYPE_CHECKING:
    from shapespline.optimization import Callback


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
    outliers: bool = False,
) -> Drawing:
    """Fit a B-spline curve to each contour of a shape.

    Parameters
    ----------
    shape : Shape
    tolerance : float or str, optional
        Data units, or a part of the box diagonal of the whole shape, such as ``"0.1%"``.
    n_control_points : int, optional
        Number of control points of each curve; chosen for each contour when neither is given.
    degree, corners, form, effort, method, callback, time_limit, ends, outliers
        See `fit_curve`; the limit is that of each contour.

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
    fits = []
    for index, contour in enumerate(shape):
        try:
            fit = fit_curve(
                contour,
                tolerance=tolerance,
                n_control_points=n_control_points,
                degree=degree,
                corners=corners,
                form=form,
                effort=effort,
                method=method,
                callback=callback,
                time_limit=time_limit,
                ends=ends,
                outliers=outliers,
            )
        except InvalidInputError as error:
            if len(shape) == 1:
                raise
            raise type(error)(f"contour {index} of {len(shape)}: {error}") from error
        fits.append(fit)
    return Drawing(fits, shape.parents, shape.frame, shape.unit)
