"""fit_shape: every contour of a Shape, nesting kept."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.contour import Shape
from shapespline.drawing import Drawing
from shapespline.errors import InvalidInputError
from shapespline.fitting import fit_curve

if TYPE_CHECKING:
    from shapespline.optimization import Callback


def fit_shape(
    shape: Shape,
    *,
    n_control_points: int | None = None,
    degree: int = 3,
    method: str = "levenberg-marquardt",
    callback: Callback | None = None,
) -> Drawing:
    """Fit a B-spline curve to each contour of a shape.

    Parameters
    ----------
    shape : Shape
    n_control_points : int, optional
        Number of control points of each curve; chosen for each contour when not given.
    degree, method, callback
        See `fit_curve`.

    Returns
    -------
    Drawing
        One fit per contour, in their order, with their nesting and frame.

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
    fits = []
    for index, contour in enumerate(shape):
        try:
            fit = fit_curve(
                contour,
                n_control_points=n_control_points,
                degree=degree,
                method=method,
                callback=callback,
            )
        except InvalidInputError as error:
            if len(shape) == 1:
                raise
            raise type(error)(f"contour {index} of {len(shape)}: {error}") from error
        fits.append(fit)
    return Drawing(fits, shape.parents, shape.frame)
