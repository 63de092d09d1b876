"""Outlines as they are: a polyline as a curve of degree 1."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.geometry.distances import two_sided_distance
from shapespline.geometry.nesting import parents_of
from shapespline.values import BSplineCurve, Contour, Drawing, Fit, Piece, Shape, Status

Drawable: TypeAlias = Drawing | Shape | Fit | Contour | Sequence[Fit] | Sequence[Contour]


def polyline_curve(contour: Contour) -> BSplineCurve:
    """The data polyline as a clamped curve of degree 1.

    Knots are equidistant: of two points that are almost one, arc length would make one knot.

    Examples
    --------
    >>> from shapespline import Contour
    >>> polyline_curve(Contour([(0, 0), (3, 0), (3, 1)], closed=False)).knots.tolist()
    [0.0, 0.0, 0.5, 1.0, 1.0]
    """
    knots = np.linspace(0.0, 1.0, len(contour.polyline))
    return BSplineCurve(np.concatenate([[0.0], knots, [1.0]]), contour.polyline, 1)


def polygon_drawing(shape: Shape) -> Drawing:
    """The contours of a shape as fits of straight pieces, with nothing lost or smoothed.

    Examples
    --------
    >>> from shapespline import Contour, Shape
    >>> square = Contour([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)
    >>> (fit,) = polygon_drawing(Shape([square]))
    >>> fit.n_stored_points, fit.closed, fit.max_distance < 1e-14
    (4, True, True)
    """
    fits = [_polygon_fit(contour) for contour in shape]
    return Drawing.of(shape, fits)


def as_drawing(value: Drawable) -> Drawing:
    """What can be drawn as a drawing: contours as they are, several nested by containment.

    Raises
    ------
    InvalidInputError
        If it is none of them.

    Examples
    --------
    >>> from shapespline import Contour
    >>> square = Contour([(0, 0), (3, 0), (3, 3), (0, 3)], closed=True)
    >>> hole = Contour([(1, 1), (2, 1), (2, 2)], closed=True)
    >>> as_drawing([square, hole]).parents
    (-1, 0)
    """
    if isinstance(value, Drawing):
        return value
    if isinstance(value, Shape):
        return polygon_drawing(value)
    items = [value] if isinstance(value, Fit | Contour) else value
    if isinstance(items, Sequence) and items:
        fits = [item for item in items if isinstance(item, Fit)]
        contours = [item for item in items if isinstance(item, Contour)]
        if len(fits) == len(items):
            return Drawing(fits, parents_of([fit.contour for fit in fits]))
        if len(contours) == len(items):
            return polygon_drawing(Shape(contours, parents_of(contours)))
    raise InvalidInputError(
        "drawing must be a Drawing, Shape, Fit or Contour, or a list of fits or contours, got"
        f" {type(value).__name__}; make one with fit_shape or fit_curve"
    )


def _polygon_fit(contour: Contour) -> Fit:
    spline = polyline_curve(contour)
    distances = two_sided_distance(spline, contour)
    ends = np.array([0.0, 0.0, 1.0, 1.0])
    vertices = contour.polyline
    return Fit(
        spline=spline,
        contour=contour,
        parameters=distances.parameters[contour.source],
        max_distance=distances.max_distance,
        rms_distance=distances.rms_distance,
        hausdorff_distance=distances.hausdorff_distance,
        tolerance=distances.hausdorff_distance,
        status=Status.KEPT.saying("the polyline of the data itself"),
        history=(),
        method="polygon",
        sections=tuple(
            Piece("line", 1, ends, vertices[k : k + 2]) for k in range(len(vertices) - 1)
        ),
    )
