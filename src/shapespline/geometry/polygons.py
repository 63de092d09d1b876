"""Outlines as they are: a polyline as a curve of degree 1."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry.distances import two_sided_distance
from shapespline.values import BSplineCurve, Drawing, Fit, Piece, Status

if TYPE_CHECKING:
    from shapespline.values import Contour, Shape


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
    return Drawing(fits, shape.parents, shape.frame, shape.unit, colors=shape.colors)


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
