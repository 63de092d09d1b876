"""How a curve moves with its control points, along its normals or any directions."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import BSplineCurve

_SMALLEST = 1e-300


class CurveMotion(NamedTuple):
    """How a curve moves along directions with its control points.

    ``gains[k, i]`` is the part of coordinate ``columns[k, i]`` of the control points (x and y in
    turn) in the motion at place k.
    """

    gains: FloatArray
    columns: IntArray


def unit_normals(spline: BSplineCurve, parameters: FloatArray) -> FloatArray:
    """Normals of length 1 to the left of a curve, (k, 2); zero where it stands still."""
    tangents = spline(parameters, derivative=1)
    speed = np.hypot(tangents[:, 0], tangents[:, 1])[:, None]
    turned = np.column_stack([-tangents[:, 1], tangents[:, 0]])
    return np.divide(turned, speed, out=np.zeros_like(turned), where=speed > _SMALLEST)


def curve_motion(
    spline: BSplineCurve, parameters: FloatArray, directions: FloatArray
) -> CurveMotion:
    """The control points that move a curve along directions (k, 2) at places."""
    degree, count = spline.degree, spline.n_control_points
    values = np.empty((len(parameters), degree + 1))
    first = np.empty(len(parameters), dtype=np.int64)
    _kernels.basis_functions(spline.knots, degree, spline.periodic, parameters, values, first)
    index = (first[:, None] + np.arange(degree + 1)) % count
    columns = (2 * index[:, :, None] + np.arange(2)).reshape(len(parameters), -1)
    gains = (values[:, :, None] * directions[:, None, :]).reshape(len(parameters), -1)
    return CurveMotion(gains, columns)
