"""Where elements meet: intersections and points of tangency, never data."""

from __future__ import annotations

from math import atan2, copysign, cos, hypot, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.segments import ARC, LINE

if TYPE_CHECKING:
    from typing import TypeAlias

    from shapespline.engines.drawn.model import Model
    from shapespline.typing import FloatArray

    Place: TypeAlias = tuple[float, float]

# Lines whose directions differ by less have no intersection that data tell; circles that miss each
# other by this part of a radius touch.
PARALLEL, TOUCHES = 0.02, 1e-4
# Directions that differ from an axis by less lie along it, radians.
EXACT = 1e-10


def direction_at(model: Model, k: int, point: FloatArray) -> FloatArray:
    """Direction of travel of an element at a point on it; along an axis exactly."""
    return np.array(_direction_at(model, k, point))


def unit_of(angle: float) -> FloatArray:
    """A unit vector; multiples of a right angle, but for rounding, have exact ones."""
    return np.array(cos_sin(angle))


def cos_sin(angle: float) -> Place:
    """Its coordinates."""
    quarter = round(angle / (pi / 2))
    if abs(angle - quarter * (pi / 2)) < EXACT:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarter % 4]
    return cos(angle), sin(angle)


def onto(model: Model, k: int, point: FloatArray) -> FloatArray:
    """The nearest point of an element's line or circle; exact in a coordinate that it fixes."""
    return np.array(_onto(model, k, *point.tolist()))


def meeting(model: Model, k: int, m: int, near: FloatArray) -> FloatArray:
    """The common point of two elements nearest to a point."""
    if model.kind(k) == ARC and model.kind(m) == LINE:
        k, m = m, k
    beside: Place = (float(near[0]), float(near[1]))
    if model.kind(m) == LINE:
        return np.array(_of_lines(model, k, m, beside))
    if model.kind(k) == LINE:
        return np.array(_onto(model, k, *_of_line_and_circle(model, k, m, beside)))
    return np.array(_of_circles(model, k, m, beside))


def distance_from(model: Model, k: int, x: float, y: float) -> float:
    """How far a point is from the whole line or circle of an element."""
    own = model.unknowns(k)
    if model.kind(k) == LINE:
        tx, ty = cos_sin(own[0])
        return abs(tx * y - ty * x - own[1])
    return abs(float(np.hypot(x - own[0], y - own[1])) - own[2])


def turn_at(model: Model, k: int, m: int, point: FloatArray) -> float:
    """Angle between two elements at their common point, radians."""
    (ax, ay), (bx, by) = _direction_at(model, k, point), _direction_at(model, m, point)
    return abs(atan2(ax * by - ay * bx, ax * bx + ay * by))


# Numbers, not arrays: there are many joints and two coordinates.


def _direction_at(model: Model, k: int, point: FloatArray) -> Place:
    own = model.unknowns(k)
    if model.kind(k) == LINE:
        return cos_sin(own[0])
    x, y = (float(point[0]) - own[0]) * model.ways[k], (float(point[1]) - own[1]) * model.ways[k]
    far = float(np.hypot(x, y))
    return -(y / far), x / far


def _onto(model: Model, k: int, x: float, y: float) -> Place:
    own = model.unknowns(k)
    if model.kind(k) == LINE:
        tx, ty = cos_sin(own[0])
        d = own[1]
        if ty == 0.0:
            return x, d * tx
        if tx == 0.0:
            return -d * ty, y
        along = x * tx + y * ty
        return -ty * d + along * tx, tx * d + along * ty
    cx, cy, r = own
    part = r / max(hypot(x - cx, y - cy), 1e-300)
    return cx + (x - cx) * part, cy + (y - cy) * part


def _middle(model: Model, k: int, m: int, near: Place) -> Place:
    (ax, ay), (bx, by) = _onto(model, k, *near), _onto(model, m, *near)
    return 0.5 * (ax + bx), 0.5 * (ay + by)


def _nearer(a: Place, b: Place, near: Place) -> Place:
    off_a, off_b = (
        (x - near[0]) * (x - near[0]) + (y - near[1]) * (y - near[1]) for x, y in (a, b)
    )
    return b if off_b < off_a else a


def _of_lines(model: Model, k: int, m: int, near: Place) -> Place:
    (phi, c), (psi, d) = model.unknowns(k), model.unknowns(m)
    (ax, ay), (bx, by) = cos_sin(phi), cos_sin(psi)
    det = ax * by - ay * bx
    if abs(det) < PARALLEL:
        return _middle(model, k, m, near)
    # n_a . p = c, n_b . p = d with n = (-t_y, t_x)
    x, y = _onto(model, k, (bx * c - ax * d) / det, (by * c - ay * d) / det)
    # Both coordinates exact where both lines lie along axes.
    if bx == 0.0:
        x = _onto(model, m, x, y)[0]
    elif by == 0.0:
        y = _onto(model, m, x, y)[1]
    return x, y


def _of_line_and_circle(model: Model, k: int, m: int, near: Place) -> Place:
    cx, cy, r = model.unknowns(m)
    x, y = _onto(model, k, cx, cy)
    half_sq = r * r - ((cx - x) * (cx - x) + (cy - y) * (cy - y))
    if half_sq <= (TOUCHES * r) ** 2:
        return x, y
    tx, ty = cos_sin(model.unknowns(k)[0])
    u, v = tx * half_sq**0.5, ty * half_sq**0.5
    return _nearer((x + u, y + v), (x - u, y - v), near)


def _of_circles(model: Model, k: int, m: int, near: Place) -> Place:
    (cx, cy, r), (ex, ey, s) = model.unknowns(k), model.unknowns(m)
    d = hypot(ex - cx, ey - cy)
    if d < 1e-9 * r:
        return _middle(model, k, m, near)
    tx, ty = (ex - cx) / d, (ey - cy) / d
    u = (d * d + r * r - s * s) / (2 * d)
    half_sq = r * r - u * u
    if half_sq <= (TOUCHES * r) ** 2:
        u = copysign(r, u)
        return cx + tx * u, cy + ty * u
    x, y, half = cx + u * tx, cy + u * ty, half_sq**0.5
    return _nearer((x - ty * half, y + tx * half), (x + ty * half, y - tx * half), near)
