"""What a curve looks like: hooks, near-cusps, radii, inflections, turns at joints, knots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from checks.curves import Array, breakpoints, polyline_of, samples, splines

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

# A hook turns by more than this within one tolerance of arc length ...
HOOK_TURN = np.radians(90)
# ... where the data turn by less than this within so many tolerances.
DATA_TURN = np.radians(45)
DATA_REACH = 6
# A pass of the data comes within a tolerance of where the curve turns, which is half a tolerance or
# less from the place that is asked.
NEAR = 1.5
# Chords of a curve within one tolerance.
CHORDS = 16
# A piece whose slowest place has less of its middle speed than this has a near-cusp.
NEAR_CUSP = 0.02
# Curvature is none where the curve turns by less than this along its own size: rounding.
STRAIGHT = 1e-6


def hooks(curve: Any, points: Array, *, closed: bool, tolerance: float) -> Array:
    """Places where a curve turns back and the data do not, shape (k, 2).

    The curve turns by more than 90 degrees within one tolerance of arc length; the data, at the
    nearest of their points, by less than 45 degrees within six. Where data pass several times
    within a tolerance and a half the pass that turns most counts: the curve may stand for it. Both
    turns are the largest difference of two directions: of chords of the curve, a sixteenth of the
    tolerance long, and of the sides of the data polyline. One place for each run of such chords.
    """
    step = tolerance / CHORDS
    even = _even(polyline_of(curve, step), step)
    if len(even) < 3:
        return np.empty((0, 2))
    turn = _largest_turn(_directions(even, closed=closed), CHORDS)[: len(even) - 1]
    sharp = np.flatnonzero(turn > HOOK_TURN)
    if not len(sharp):
        return np.empty((0, 2))
    middle = sharp + CHORDS // 2
    last = len(even) - 1
    middles = even[middle % last if closed else np.minimum(middle, last)]
    calm = (
        data_turn(
            points,
            middles,
            closed=closed,
            reach=DATA_REACH * tolerance,
            near=NEAR * tolerance,
        )
        < DATA_TURN
    )
    found = sharp[calm]
    first = np.flatnonzero(np.diff(found, prepend=-2 * CHORDS) > CHORDS)
    return middles[calm][first]


def _even(polyline: Array, step: float) -> Array:
    """Points of a polyline at equal steps of arc length."""
    at = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(polyline, axis=0).T))])
    n = max(int(np.ceil(at[-1] / step)), 1)
    stations = np.linspace(0, at[-1], n + 1)
    return np.column_stack([np.interp(stations, at, axis) for axis in polyline.T])


def _directions(points: Array, *, closed: bool) -> Array:
    """Angle of every chord, without jumps; of closed points twice around."""
    side = np.diff(points, axis=0)
    side = side[np.hypot(*side.T) > 0]
    if closed:
        side = np.concatenate([side, side])
    return np.unwrap(np.arctan2(side[:, 1], side[:, 0]))


def _largest_turn(angles: Array, count: int) -> Array:
    """The largest difference of two of ``count`` angles on end, from each on."""
    padded = np.concatenate([angles, np.full(count - 1, angles[-1])])
    windows = np.lib.stride_tricks.sliding_window_view(padded, count)
    return np.ptp(windows, axis=1)


def data_turn(
    points: Array, places: Array, *, closed: bool, reach: float, near: float = 0.0
) -> Array:
    """Largest difference of two directions of the data around the foot of each place.

    The foot is the nearest point of the data polyline; sides within half of ``reach`` of arc length
    on both sides of it count. Of passes of the data that come as ``near`` as that, each has a foot,
    and the largest difference counts.
    """
    if not len(places):
        return np.zeros(0)
    polyline = np.concatenate([points, points[:1]]) if closed else points
    keep = np.concatenate([[True], np.hypot(*np.diff(polyline, axis=0).T) > 0])
    polyline = polyline[keep]
    at = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(polyline, axis=0).T))])
    angles = _directions(polyline, closed=False)
    passes = [_stations(place, polyline, at, near) for place in places]
    owner = np.repeat(np.arange(len(places)), [len(found) for found in passes])
    stations = np.concatenate(passes)
    if closed:  # three times around, each time with the same whole turns more
        whole, length = _directions(polyline, closed=True)[len(angles)] - angles[0], at[-1]
        angles = np.concatenate([angles + k * whole for k in (-1, 0, 1)])
        at = np.concatenate([at[:-1] - length, at[:-1], at + length])
    first = np.maximum(np.searchsorted(at, stations - reach / 2, side="right") - 1, 0)
    last = np.minimum(np.searchsorted(at, stations + reach / 2, side="left"), len(angles))
    turn = np.zeros(len(places))
    for k, a, b in zip(owner, first, last, strict=True):
        turn[k] = max(turn[k], np.ptp(angles[a : max(b, a + 1)]))
    return turn


def _stations(place: Array, polyline: Array, at: Array, near: float) -> Array:
    """Arc length of the nearest point of each pass of a polyline that comes so near to a place.

    If none does, of the nearest point at all; every side is tried.
    """
    side, offset = np.diff(polyline, axis=0), place - polyline[:-1]
    share = np.clip((offset * side).sum(axis=1) / (side**2).sum(axis=1), 0, 1)
    away = np.hypot(*(offset - share[:, None] * side).T)
    station = at[:-1] + share * np.diff(at)
    within = max(near, away.min())
    sides = np.flatnonzero(away <= within)
    # Data that turn back on the way pass twice, too.
    runs = np.split(sides, np.flatnonzero(np.diff(station[sides]) > 2 * within) + 1)
    return station[[run[np.argmin(away[run])] for run in runs]]


def speed_ratio(curve: Any) -> float:
    """The smallest speed over the median one, of the piece where that is least.

    Below ``NEAR_CUSP`` the piece nearly stands still and turns as it likes: a near-cusp.
    """
    return min(_speed_ratio(spline) for spline in splines(curve))


def _speed_ratio(spline: BSpline) -> float:
    u = samples(spline).parameters
    speed = np.hypot(*spline(u, nu=1).T)
    weight = np.gradient(u)
    order = np.argsort(speed)
    middle = np.searchsorted(np.cumsum(weight[order]), 0.5 * weight.sum())
    return float(speed.min() / speed[order][middle])


def _curvature(spline: BSpline) -> Array:
    u = samples(spline).parameters
    first, second = spline(u, nu=1), spline(u, nu=2)
    speed = np.hypot(*first.T)
    cross = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    floor = 1e-12 * np.hypot(*np.ptp(spline.c, axis=0)) / (u[-1] - u[0])
    return np.where(speed > floor, cross / np.maximum(speed, floor) ** 3, np.inf)


def smallest_radius(curve: Any) -> float:
    """The smallest radius of curvature inside of a piece, infinite if all are lines."""
    bent = [spline for spline in splines(curve) if spline.k > 1]
    largest = max((np.abs(_curvature(spline)).max() for spline in bent), default=0.0)
    return float(1 / largest) if largest > 0 else np.inf


def inflections(curve: Any) -> int:
    """How often the curvature changes its sign along a curve, joints included, lines left out."""
    parts = [spline for spline in splines(curve) if spline.k > 1]
    if not parts:
        return 0
    size = np.hypot(*np.ptp(np.concatenate([spline.c for spline in parts]), axis=0))
    curvature = np.concatenate([_curvature(spline) for spline in parts])
    bent = np.isfinite(curvature) & (np.abs(curvature) * size > STRAIGHT)
    sign = np.sign(curvature[bent])
    return int((np.diff(sign) != 0).sum())


def turns(curve: Any, *, closed: bool) -> Array:
    """Angle at every joint of the parts, radians, left positive: of the limits of the tangents."""
    parts = splines(curve)
    arriving = np.array([_tangent(part, end=True) for part in parts])
    leaving = np.array([_tangent(part, end=False) for part in parts])
    if closed:
        before, after = np.roll(arriving, 1, axis=0), leaving
    else:
        before, after = arriving[:-1], leaving[1:]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.arctan2(cross, (before * after).sum(axis=1))


def _tangent(spline: BSpline, *, end: bool) -> Array:
    """Direction at an end: of the first derivative there that is not zero."""
    u = breakpoints(spline)[-1 if end else 0]
    size = np.abs(spline.c).max()
    for order in range(1, spline.k + 1):
        derivative = spline(u, nu=order)
        if np.hypot(*derivative) > 1e-12 * size:
            backwards = -1.0 if end and order % 2 == 0 else 1.0
            return backwards * derivative / np.hypot(*derivative)
    return np.zeros(2)


def interval_ratio(curve: Any) -> float:
    """The longest knot interval over the shortest, of the part where that is largest."""
    intervals = [np.diff(breakpoints(spline)) for spline in splines(curve)]
    return float(max(interval.max() / interval.min() for interval in intervals))
