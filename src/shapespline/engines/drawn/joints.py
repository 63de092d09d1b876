"""Where elements meet: intersections and points of tangency, never data."""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.segments import ARC, LINE

if TYPE_CHECKING:
    from shapespline.engines.drawn.model import Model
    from shapespline.typing import FloatArray

# Lines whose directions differ by less have no intersection that data tell; circles that miss each
# other by this part of a radius touch.
PARALLEL, TOUCHES = 0.02, 1e-4
# Directions that differ from an axis by less lie along it, radians.
EXACT = 1e-10


def direction_at(model: Model, k: int, point: FloatArray) -> FloatArray:
    """Direction of travel of an element at a point on it; along an axis exactly."""
    o = model.at[k]
    if model.kind(k) == LINE:
        return unit_of(float(model.x[o]))
    out = (point - model.x[o : o + 2]) * model.ways[k]
    out = out / np.hypot(*out)
    return np.array([-out[1], out[0]])


def unit_of(angle: float) -> FloatArray:
    """A unit vector; multiples of a right angle, but for rounding, have exact ones."""
    quarter = round(angle / (pi / 2))
    if abs(angle - quarter * (pi / 2)) < EXACT:
        return np.array([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][quarter % 4])
    return np.array([cos(angle), sin(angle)])


def onto(model: Model, k: int, point: FloatArray) -> FloatArray:
    """The nearest point of an element's line or circle; exact in a coordinate that it fixes."""
    o = model.at[k]
    if model.kind(k) == LINE:
        tx, ty = unit_of(float(model.x[o])).tolist()
        d = float(model.x[o + 1])
        if ty == 0.0:
            return np.array([point[0], d * tx])
        if tx == 0.0:
            return np.array([-d * ty, point[1]])
        along = point[0] * tx + point[1] * ty
        return np.array([-ty * d + along * tx, tx * d + along * ty])
    out = point - model.x[o : o + 2]
    return model.x[o : o + 2] + out * (model.x[o + 2] / max(hypot(*out), 1e-300))


def meeting(model: Model, k: int, m: int, near: FloatArray) -> FloatArray:
    """The common point of two elements nearest to a point."""
    if model.kind(k) == ARC and model.kind(m) == LINE:
        k, m = m, k
    if model.kind(m) == LINE:
        return _of_lines(model, k, m, near)
    found = _of_line_and_circle(model, k, m, near) if model.kind(k) == LINE else None
    if found is None:
        found = _of_circles(model, k, m, near)
    return onto(model, k, found) if model.kind(k) == LINE else found


def turn_at(model: Model, k: int, m: int, point: FloatArray) -> float:
    """Angle between two elements at their common point, radians."""
    a, b = direction_at(model, k, point), direction_at(model, m, point)
    return abs(atan2(a[0] * b[1] - a[1] * b[0], a @ b))


def _of_lines(model: Model, k: int, m: int, near: FloatArray) -> FloatArray:
    a, b = (unit_of(float(model.x[model.at[i]])) for i in (k, m))
    c, d = (float(model.x[model.at[i] + 1]) for i in (k, m))
    det = a[0] * b[1] - a[1] * b[0]
    if abs(det) < PARALLEL:
        return 0.5 * (onto(model, k, near) + onto(model, m, near))
    # n_a . p = c, n_b . p = d with n = (-t_y, t_x)
    found = np.array([b[0] * c - a[0] * d, b[1] * c - a[1] * d]) / det
    found = onto(model, k, found)
    fixed = onto(model, m, found)
    # Both coordinates exact where both lines lie along axes.
    return np.where(b == 0.0, fixed, found) if (b == 0.0).any() else found


def _of_line_and_circle(model: Model, k: int, m: int, near: FloatArray) -> FloatArray:
    o = model.at[m]
    centre, r = model.x[o : o + 2], float(model.x[o + 2])
    foot = onto(model, k, centre)
    half_sq = r * r - float(((centre - foot) ** 2).sum())
    if half_sq <= (TOUCHES * r) ** 2:
        return foot
    along = unit_of(float(model.x[model.at[k]])) * half_sq**0.5
    return min((foot + along, foot - along), key=lambda p: float(((p - near) ** 2).sum()))


def _of_circles(model: Model, k: int, m: int, near: FloatArray) -> FloatArray:
    a, b = model.at[k], model.at[m]
    c, r = model.x[a : a + 2], float(model.x[a + 2])
    e, s = model.x[b : b + 2], float(model.x[b + 2])
    d = hypot(*(e - c))
    if d < 1e-9 * r:
        return 0.5 * (onto(model, k, near) + onto(model, m, near))
    t = (e - c) / d
    u = (d * d + r * r - s * s) / (2 * d)
    half_sq = r * r - u * u
    if half_sq <= (TOUCHES * r) ** 2:
        return c + t * float(np.copysign(r, u))
    n = np.array([-t[1], t[0]]) * half_sq**0.5
    return min((c + u * t + n, c + u * t - n), key=lambda p: float(((p - near) ** 2).sum()))
