"""Starts for comparison that solve for their control points at parameters that stay.

Knots at dominant points (Park and Lee), with seeds from the data or from a base curve, and equally
spaced knots for equally spaced parameters.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import chord_to_point, local_maxima
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.engines.least_squares.starts.equidistribution import Balanced
from shapespline.errors import DegenerateContourError
from shapespline.geometry import parametrize
from shapespline.values import BSplineCurve, clamped_knots, periodic_knots

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour

# CPDA chord in points, at most this part of the outline, for the curvature along it.
CHORD, CHORD_PART = 8, 8
# Points to a knot of Park and Lee's base curve, and the part of its mean curvature that a seed
# exceeds.
BASE_POINTS, LOW_CURVATURE = 4, 0.25
# Part of the bending against the length in the shape index of a segment [1].
BEND_PART = 0.8


def uniform_start(
    contour: Contour, n_control_points: int, degree: int, weights: FloatArray | None = None
) -> Balanced:
    """Equally spaced knots, and parameters that count the points."""
    parameters = parametrize(contour, "uniform")
    make = periodic_knots if contour.closed else clamped_knots
    return _fitted(contour, parameters, make(n_control_points, degree), degree, weights)


def dominant_start(
    contour: Contour, n_control_points: int, degree: int, weights: FloatArray | None = None
) -> Balanced:
    """Knots that average the parameters of dominant points, one for every control point.

    The sharpest bends of the data come first, where H is largest, at most half of them; then, fit
    by fit, the segment between two dominant points that errs most gets another where it halves the
    segment's shape index, a mean of bending and length.

    Raises
    ------
    DegenerateContourError
        If there are fewer points than control points.

    References
    ----------
    .. [1] H. Park, J.-H. Lee, B-spline curve fitting based on adaptive curve refinement using
       dominant points, Computer-Aided Design 39, 2007: sections 3.1 (seeds), 3.2 (knots by
       averaging), 3.3 (refinement by the shape index).
    """
    length = max(2, min(CHORD, len(contour) // CHORD_PART))
    bend = chord_to_point(contour, length, prominence=0.05)
    seeds = _seeds(contour, bend.maxima, bend.values, n_control_points // 2, degree)
    return _dominant(contour, seeds, bend.values, n_control_points, degree, weights)


def park_lee_start(
    contour: Contour, n_control_points: int, degree: int, weights: FloatArray | None = None
) -> Balanced:
    """The same with the seeds of the reference: maxima of the curvature of a base curve.

    The base curve is the least-squares curve on uniform knots at chord length, with a knot for
    every four points; its curvature at a data point counts where it exceeds that at both neighbours
    and a quarter of the mean.

    References
    ----------
    .. [1] As for `dominant_start`, section 3.1.
    """
    parameters = parametrize(contour, "chord")
    count = max(degree + 1, len(contour) // BASE_POINTS)
    make = periodic_knots if contour.closed else clamped_knots
    base = _fitted(contour, parameters, make(count, degree), degree, weights)
    bend = np.abs(base.spline.curvature(parameters))
    low = LOW_CURVATURE * float(bend.mean())
    maxima = local_maxima(bend, closed=contour.closed)
    seeds = _seeds(contour, maxima[bend[maxima] > low], bend, n_control_points, degree)
    return _dominant(contour, seeds, bend, n_control_points, degree, weights)


def _dominant(
    contour: Contour,
    chosen: list[int],
    bend: FloatArray,
    n_control_points: int,
    degree: int,
    weights: FloatArray | None,
) -> Balanced:
    """The curve whose knots average dominant points, refined from the seeds to a number."""
    parameters = parametrize(contour, "chord")
    index = _shape_index(contour, bend)
    while True:
        knots, shift = _averaged(contour, parameters[chosen], degree)
        start = _fitted(contour, parameters - shift, knots, degree, weights)
        if len(chosen) == n_control_points:
            return start
        chosen = _refined(contour, start, chosen, index)


def _seeds(
    contour: Contour, maxima: IntArray, values: FloatArray, count: int, degree: int
) -> list[int]:
    """The sharpest bends, the ends of an open outline, and what a first curve needs beside them."""
    n = len(contour)
    sharpest = maxima[np.argsort(-values[maxima], kind="stable")]
    chosen = set() if contour.closed else {0, n - 1}
    chosen |= set(sharpest[: max(0, count - len(chosen))].tolist())
    for i in np.linspace(0, n - 1, 4 * (degree + 1)).astype(int).tolist():
        if len(chosen) < degree + 1:
            chosen.add(i)
    return sorted(chosen)


def _shape_index(contour: Contour, bend: FloatArray) -> FloatArray:
    """Bending and length up to every vertex of the polyline, parts of the whole, increasing."""
    turned = np.concatenate([[0.0], np.cumsum(bend)])[: len(contour.arc_length)]
    total = turned[-1] if turned[-1] > 0 else 1.0
    return BEND_PART * turned / total + (1 - BEND_PART) * contour.arc_length / contour.length


def _averaged(contour: Contour, at: FloatArray, degree: int) -> tuple[FloatArray, float]:
    """Knots that are means of ``degree`` neighbouring dominant parameters, and where they begin.

    Those of a closed outline begin anywhere: the parameters have to be shifted as far back.
    """
    m = len(at)
    if not contour.closed:
        inner = np.array([at[j : j + degree].mean() for j in range(1, m - degree)])
        return clamped_knots(m, degree, inner), 0.0
    around = np.concatenate([at, at + 1.0, at + 2.0])
    knots = np.array([around[j : j + degree].mean() for j in range(m + 1)])
    shift = float(knots[0])
    knots -= shift
    knots[-1] = 1.0  # rounding
    return periodic_knots(m, degree, knots), shift


def _fitted(
    contour: Contour,
    parameters: FloatArray,
    knots: FloatArray,
    degree: int,
    weights: FloatArray | None,
) -> Balanced:
    """The least-squares curve on these knots at these parameters."""
    periodic = contour.closed
    count = len(knots) - degree - 1 - (degree if periodic else 0)
    middle = contour.points.mean(axis=0)
    template = BSplineCurve(knots, np.zeros((count, 2)), degree, periodic)
    ends = "free" if periodic else "fixed"
    problem = CurveProblem(contour.points - middle, template, weights, ends=ends)
    guess = np.zeros((count, 2))
    if not periodic:
        guess[[0, -1]] = problem.points[[0, -1]]
    control_points = problem.control_points_for(parameters, guess) + middle
    return Balanced(BSplineCurve(knots, control_points, degree, periodic), parameters)


def _refined(contour: Contour, start: Balanced, chosen: list[int], index: FloatArray) -> list[int]:
    """The dominant points and one more, in the segment that errs most and has room for it."""
    n = len(contour)
    distances_sq = ((start.spline(start.parameters) - contour.points) ** 2).sum(axis=1)
    ends = [*chosen[1:], chosen[0] + n] if contour.closed else chosen[1:]
    worst, best = -1.0, None
    for a, b in zip(chosen, ends, strict=False):
        between = np.arange(a + 1, b)
        error = float(distances_sq[between % n].max()) if len(between) else -1.0
        if error > worst:
            worst, best = error, (a, between)
    if best is None:
        raise DegenerateContourError(
            f"n_control_points must be at most the number of points, {n}; lower it"
        )
    a, between = best
    lap = index[-1]
    along = index[between % n] + lap * (between // n)
    end = between[-1] + 1
    half = 0.5 * (index[a] + index[end % n] + lap * (end // n))
    return sorted([*chosen, int(between[np.argmin(np.abs(along - half))] % n)])
