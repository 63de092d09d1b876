"""Least-squares splines whose size a criterion chooses: Mallows' C_p with a dearer parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import NOISE_BAND, resolution
from shapespline.engines.least_squares.losses import counted
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.engines.least_squares.starts.equidistribution import (
    Balanced,
    balanced_start,
    bending_parameters,
)
from shapespline.engines.least_squares.trusted import trusted_start
from shapespline.solvers import Limits
from shapespline.values import Contour

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray, Loss

# Price of a control point in units of the variance: more than the 2 of AIC, for a free knot and a
# free tangential place come with it. Measured on a loop (benchmarks.estimation): 2.5 / 3 / 3.5 / 5
# leave an rms distance to the truth of 0.061 / 0.052 / 0.051 / 0.055 of a box diagonal of 100
# (LSQ-04).
PENALTY = 3.5
# Sizes grow by this factor, up to this part of the number of points (FIT-26). The search ends when
# so many sizes in a row were no better, but not before this size: an outline with many features
# shows nothing until there is a control point for each. Then it tries sizes around the best one, in
# steps of this part of it.
SIZE_FACTOR = 1.25
LARGEST_PART = 0.4
PATIENCE, AT_LEAST = 3, 32
FINEST = 0.06
# The search for a size looks at no more points: they would tell it nothing new.
SEARCH_POINTS = 10_000
# The start of a least-squares fit has been balanced already: what is left falls by 1e-4 and less.
FINAL_LIMITS = Limits(max_iterations=300, max_evaluations=1000, relative_decrease=1e-4)


class Smoothed(NamedTuple):
    """The points (n, 2) of a least-squares fit beside those of the data, and its cost.

    ``cost`` is the sum of squares over the variance and the price of the control points.
    """

    points: FloatArray
    cost: float
    n_control_points: int
    start: Balanced | None

    def tangent(self, end: int) -> FloatArray:
        """Unit direction at the first (0) or last (-1) point of an open run."""
        direction = self.continued(end)[1]
        return direction / max(float(np.hypot(*direction)), np.finfo(float).tiny)

    def continued(self, end: int) -> FloatArray:
        """Coefficients (k, 2) of the polynomial beyond the first (0) or last (-1) point.

        Of an open run, by powers of the parameter from there.
        """
        if self.start is None:
            return np.array([self.points[end], self.points[-1] - self.points[0]])
        spline, factor, rows = self.start.spline, 1.0, []
        for k in range(spline.degree + 1):
            rows.append(spline([spline.domain[end]], derivative=k)[0] / factor)
            factor *= k + 1
        return np.array(rows)


def cheapest(tried: Sequence[Smoothed]) -> Smoothed:
    """Of several sizes the one whose cost is least, the first of equals."""
    return min(tried, key=lambda one: one.cost)


def sizes_tried(
    contour: Contour,
    degree: int,
    noise: float,
    weights: FloatArray | None = None,
    loss: Loss | None = None,
    *,
    monitor: Monitor,
) -> list[Smoothed]:
    """Least-squares splines, or a line, of the sizes that a search for the cheapest one tries.

    It minimises ``sum w |C(t) - Q|^2 / noise^2 + 3.5 m`` over the number m of control points
    (Mallows' C_p with a dearer parameter), coarsely first, then finely. A loss takes the place of
    the square. The monitor may end the search. Of very many points the cheapest alone is returned.
    """
    if len(contour) > SEARCH_POINTS and weights is None:
        stride = -(-len(contour) // SEARCH_POINTS)
        thinned = Contour.silently(contour.points[::stride], contour.closed)
        some = sizes_tried(thinned, degree, noise, None, loss, monitor=monitor)
        size = cheapest(some).n_control_points
        if size <= degree:
            return [straight_line(contour, noise)]
        return [smoothed_to(size, contour, degree, noise, None, loss, monitor=monitor)]
    begin = bending_parameters(contour)

    def of_size(size: int) -> Smoothed:
        return smoothed_to(
            size, contour, degree, noise, weights, loss, begin=begin, monitor=monitor
        )

    tried: list[Smoothed] = []
    if not contour.closed and weights is None and loss is None:
        tried.append(straight_line(contour, noise))
    least = tried[0].cost if tried else np.inf
    most = max(degree + 1, int(LARGEST_PART * len(contour)))
    size, misses = degree + 1, 0
    while size <= most and (size <= AT_LEAST or misses < PATIENCE):
        found = of_size(size)
        tried.append(found)
        least, misses = (found.cost, 0) if found.cost < least else (least, misses + 1)
        size = max(size + 1, round(SIZE_FACTOR * size))
        if monitor.ends(size):
            return tried
    middle, known = cheapest(tried).n_control_points, {one.n_control_points for one in tried}
    for size in range(round(middle / SIZE_FACTOR) + 1, round(middle * SIZE_FACTOR)):
        fine = (size - middle) % max(1, round(FINEST * middle)) == 0
        if degree < size <= most and fine and size not in known:
            tried.append(of_size(size))
            if monitor.ends(size):
                break
    return tried


def smoothed_to(
    size: int,
    contour: Contour,
    degree: int,
    noise: float,
    weights: FloatArray | None = None,
    loss: Loss | None = None,
    *,
    begin: FloatArray | None = None,
    monitor: Monitor,
) -> Smoothed:
    """The least-squares spline with so many control points, more than its degree.

    ``begin`` are the parameters of all points to begin with, by how they bend if not given.
    """

    def make(points: Contour, weights: FloatArray | None) -> Balanced:
        return balanced_start(
            points,
            size,
            degree,
            weights,
            rounds=0,
            ends="fitted",
            parameters=begin if points is contour else None,
            ask=monitor.ends,
        )

    if loss is not None:
        trusted = trusted_start(contour, make, weights, noise)
        start, cost = trusted.start, float(counted(trusted.standardized, loss).sum())
        return Smoothed(start.spline(start.parameters), cost + PENALTY * size, size, start)
    start = make(contour, weights)
    squares = _squares_at_feet(contour, start)
    total = float(squares.sum() if weights is None else weights @ squares)
    points = start.spline(start.parameters)
    return Smoothed(points, total / noise**2 + PENALTY * size, size, start)


def _squares_at_feet(contour: Contour, start: Balanced) -> FloatArray:
    """Squared distances of the points from the curve, shape (n,).

    Parameters in the order of points that scatter along the curve are none of foot points: a few
    that wait for each other make their squares twice as large, by chance (FIT-30).
    """
    problem = CurveProblem(contour.points, start.spline, ends="free")
    x = problem.pack(start.spline.control_points, start.parameters)
    _, parameters = problem.unpack(problem.projected_nearby(x))
    return ((start.spline(parameters) - contour.points) ** 2).sum(axis=1)


def straight_line(contour: Contour, noise: float) -> Smoothed:
    """The nearest straight line (total least squares)."""
    middle = contour.points.mean(axis=0)
    away = contour.points - middle
    values, vectors = np.linalg.eigh(np.einsum("ji,jk->ik", away, away))
    along = vectors[:, 1] * np.copysign(1.0, (away[-1] - away[0]) @ vectors[:, 1])
    points = middle + np.outer(np.sort(away @ along), along)
    return Smoothed(points, max(float(values[0]), 0.0) / noise**2 + 2 * PENALTY, 2, None)


def smooth_start(
    contour: Contour,
    degree: int,
    weights: FloatArray | None = None,
    *,
    noise: float | None = None,
    loss: Loss | None = None,
    monitor: Monitor,
) -> Balanced:
    """One spline over the whole contour, of the size that the criterion chooses.

    ``noise`` is the error of a point of weight one, found from the points if it is not known.
    """
    noise = noise_of(contour, noise)
    tried = sizes_tried(contour, degree, noise, weights, loss, monitor=monitor)
    return start_of(cheapest(tried), contour, degree)


def noise_of(contour: Contour, known: float | None) -> float:
    """The error of a point, found from the points if it is not known."""
    if known is not None:
        return known
    shown = resolution(contour)
    return max(shown.noise, shown.band / NOISE_BAND)


def start_of(found: Smoothed, contour: Contour, degree: int) -> Balanced:
    """The spline that was found, one of fewest control points where that is a line."""
    if found.start is not None:
        return found.start
    return balanced_start(contour, degree + 1, degree, rounds=0, ends="fitted")
