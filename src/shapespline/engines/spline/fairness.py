"""Fairness of a single spline: even knots, no near-cusp, no crossing, hook or wave of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve, Contour

# Largest over smallest knot interval, slowest over median speed.
INTERVAL_RATIO, SPEED_RATIO = 1000.0, 0.05
# A curve that turns, left and right, so much more than its data waves about their chords (SPL-13).
MORE_TURN = 0.1


class Fairness(NamedTuple):
    """How fair an exported curve is.

    ``interval_ratio`` is the largest over the smallest non-zero knot interval, ``speed_ratio`` the
    slowest speed over its median (both with respect to the parameter, knots of multiplicity >=
    degree left out), ``n_crossings`` and ``n_data_crossings`` count self-crossings of curve and
    data polyline, ``n_hooks`` the places where the curve turns back and the data do not;
    ``more_turn`` is how much farther the curve turns, left and right, than its data, in parts of
    what they turn.
    """

    interval_ratio: float
    speed_ratio: float
    n_crossings: int
    n_data_crossings: int
    n_hooks: int = 0
    more_turn: float = 0.0

    @property
    def waves(self) -> bool:
        """Whether the curve turns to and fro where its data do not."""
        return self.more_turn > MORE_TURN

    @property
    def kept(self) -> bool:
        """Whether the curve is fit for use."""
        return (
            self.interval_ratio <= INTERVAL_RATIO * (1 + 1e-9)
            and self.speed_ratio >= SPEED_RATIO * (1 - 1e-9)
            and self.n_crossings <= self.n_data_crossings
            and self.n_hooks == 0
        )


def turning(directions: FloatArray, *, closed: bool) -> float:
    """How far a way turns, left and right, that runs along these directions one after another."""
    if closed:
        directions = np.concatenate([directions, directions[:1]])
    (ax, ay), (bx, by) = directions[:-1].T, directions[1:].T
    return float(np.abs(np.arctan2(ax * by - ay * bx, ax * bx + ay * by)).sum())


def fairness_of(
    curve: BSplineCurve, contour: Contour, n_hooks: int = 0, data_turning: float = np.inf
) -> Fairness:
    """How fair a curve is, from dense samples of every span; its hooks the search has counted.

    Notes
    -----
    64 samples a span: not a rigorous bound.
    """
    breaks = curve.breakpoints
    intervals = np.diff(breaks)
    share = (np.arange(64) + 0.5) / 64
    u = (breaks[:-1, None] + intervals[:, None] * share).ravel()
    velocity = curve(u, derivative=1)
    speed = np.hypot(velocity[:, 0], velocity[:, 1])
    order = np.argsort(speed, kind="stable")
    weight = np.cumsum(np.repeat(intervals / 64, 64)[order])
    median = float(speed[order][np.searchsorted(weight, 0.5 * weight[-1])])
    inside = curve.knots[curve.degree : -curve.degree]
    later = inside[curve.degree - 1 :]
    corners = later[later == inside[: len(later)]]
    away = np.ones(len(u), dtype=bool)
    width = np.repeat(intervals, 64)
    for corner in corners:
        away &= np.abs(u - corner) > 0.05 * width
    slowest = float(speed[away].min()) if away.any() else median
    if curve.periodic:
        vertices = curve(np.append(u, u[0]))
    else:
        vertices = curve(np.concatenate([breaks[:1], u, breaks[-1:]]))
    return Fairness(
        float(intervals.max() / intervals.min()),
        slowest / median if median > 0 else 0.0,
        _kernels.count_crossings(vertices),
        _kernels.count_crossings(contour.polyline),
        n_hooks,
        turning(velocity, closed=contour.closed) / data_turning - 1.0,
    )
