"""A stand-in for the published method's predecessor, its reference [47].

Ebrahimi and Loghmani (2018) is compared with in Table 2, but of its procedure only this much is
said there: it finds number and positions of the control points, starts from a B-spline curve and
optimises it. Constants, data and stopping rules are not published. So this is *not* that method;
it is the same pipeline with the steps that were added later taken out:

- dominant points by the same CPDA rule, control points *on* them, without the offset along the
  normal;
- control point insertion: at the data point with the largest residual of the initial curve, one
  at a time, until the start error is no larger than that of the method it is compared with, or
  there are twice as many control points as at first; of all curves tried the best one is kept;
- scaled BFGS: the full matrix, started from the Gauss-Newton diagonal. That is kinder than the
  scaled identity s'y / y'y, which knows only one scale for control points and parameters.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry.parametrization import greville_matched, parametrize
from shapespline.paper.initial import initial_curve
from shapespline.paper.run import paper_error
from shapespline.solvers.quasi_newton import make_solver
from shapespline.values.contour import Contour
from shapespline.values.curve import BSplineCurve
from shapespline.values.knots import clamped_knots, greville_abscissae, periodic_knots

if TYPE_CHECKING:
    from shapespline.paper.reading import Reading
    from shapespline.solvers.quasi_newton import QuasiNewton
    from shapespline.typing import FloatArray

DEGREE = 3


@dataclass(frozen=True, eq=False)
class PredecessorStart:
    """Curve and parameters to start from, its error E_0, and how many points were inserted."""

    spline: BSplineCurve
    parameters: FloatArray
    error: float
    n_inserted: int


def predecessor_start(
    contour: Contour, length: int, target_error: float, reading: Reading
) -> PredecessorStart:
    """Control points on the dominant points, and more of them where the error is largest."""
    first = initial_curve(contour, length, reading=replace(reading, offset="none"))
    chosen = sorted(set(first.dominant.tolist()))
    most = 2 * first.n_control_points
    best: PredecessorStart | None = None
    n_inserted = 0
    while True:
        start = _start(contour, chosen, n_inserted, first.spline.periodic)
        if best is None or start.error < best.error:
            best = start
        if start.error <= target_error or start.spline.n_control_points >= most:
            return best
        residuals = start.spline(start.parameters) - contour.points
        distance = np.hypot(residuals[:, 0], residuals[:, 1])
        distance[chosen] = -1.0
        if not start.spline.periodic:
            distance[[0, -1]] = -1.0
        chosen = sorted([*chosen, int(np.argmax(distance))])
        n_inserted += 1


def predecessor_solver() -> QuasiNewton:
    """Scaled BFGS with a dense matrix."""
    return make_solver("bfgs", start_diagonal="gauss-newton")


def _start(
    contour: Contour, chosen: list[int], n_inserted: int, periodic: bool
) -> PredecessorStart:
    """The curve with the chosen data points as its control points."""
    inner = contour.points[chosen]
    if periodic:
        knots = periodic_knots(len(inner), DEGREE)
        spline = BSplineCurve(knots, inner, DEGREE, periodic=True)
        abscissae = greville_abscissae(knots, DEGREE)[: len(inner)]
        parameters = greville_matched(contour, contour.arc_length[chosen], abscissae, 1.0)
    else:
        points = np.concatenate([contour.points[:1], inner, contour.points[-1:]])
        spline = BSplineCurve(clamped_knots(len(points), DEGREE), points, DEGREE)
        # Uniform, as published; the clamped curve has no closing segment.
        parameters = parametrize(Contour(contour.points, closed=False), "uniform")
    return PredecessorStart(
        spline, parameters, paper_error(contour, spline, parameters), n_inserted
    )
