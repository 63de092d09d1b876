"""A start without any solve: one control point a station, on uniform knots."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.least_squares.starts.equidistribution import Balanced
from shapespline.geometry import greville_matched, parametrize
from shapespline.values import (
    BSplineCurve,
    Contour,
    clamped_knots,
    greville_abscissae,
    periodic_knots,
)

if TYPE_CHECKING:
    from shapespline.typing import FloatArray


def placed_curve(
    contour: Contour,
    control_points: FloatArray,
    at: FloatArray,
    degree: int,
    *,
    periodic: bool,
    parametrization: str = "greville",
) -> Balanced:
    """The curve of control points made from stations, on uniform knots, and the data's parameters.

    Parameters
    ----------
    contour : Contour
        Open wherever the curve is clamped: first and last point are its ends.
    control_points : ndarray, shape (k, 2)
        Apart from the ends of a clamped curve.
    at : ndarray, shape (k,)
        Arc lengths of their stations along the contour.
    degree : int
    periodic : bool
    parametrization : {"greville", "uniform", "chord", "centripetal"}
        Of the data: that each station has the Greville abscissa of its control point, or without
        regard to the stations.
    """
    if periodic:
        knots, anchors = periodic_knots(len(control_points), degree), at
    else:
        knots = clamped_knots(len(control_points) + 2, degree)
        points = contour.points
        control_points = np.concatenate([points[:1], control_points, points[-1:]])
        anchors = np.concatenate([[0.0], at, [contour.length]])
    spline = BSplineCurve(knots, control_points, degree, periodic)
    abscissae = greville_abscissae(knots, degree)[: len(control_points)]
    if not periodic:  # to the bit, not as a mean of equal knots
        abscissae[[0, -1]] = spline.domain
    if parametrization == "greville":
        parameters = greville_matched(contour, anchors, abscissae, 1.0 if periodic else None)
    else:
        parameters = parametrize(contour, parametrization)
        if periodic:  # the first control point, not the first data point, sits at its abscissa
            there = np.interp(at[0], contour.arc_length[: len(contour)], parameters)
            parameters += abscissae[0] - there
    return Balanced(spline, parameters)


def bend_gain(degree: int) -> float:
    """(p + 1) / 24: uniform B-splines of degree p lie k h^2 (p + 1) / 24 inside (reading 9)."""
    return 0.0 if degree == 1 else (degree + 1) / 24.0


def with_neighbours(chosen: FloatArray, values: FloatArray, period: float | None) -> FloatArray:
    """The chosen values with those before the first and after the last of them.

    Around a closed outline with a ``period``, else the first and last of all ``values``.
    """
    if period is not None:
        return np.concatenate([chosen[-1:] - period, chosen, chosen[:1] + period])
    return np.concatenate([values[:1], chosen, values[-1:]])


def quasi_interpolating(stations: FloatArray, ends: FloatArray | None, degree: int) -> FloatArray:
    """From each station to its control point: (p + 1) / 24 against the second difference, (k, 2).

    ``ends`` holds the first and last point of a clamped curve, None closes the stations.
    """
    if ends is None:
        around = with_neighbours(stations, stations, 0.0)
    else:
        around = with_neighbours(stations, ends, None)
    return -bend_gain(degree) * (around[2:] - 2 * around[1:-1] + around[:-2])
