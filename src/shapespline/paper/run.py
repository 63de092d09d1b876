"""The published method from an outline to its final curve, with its own constants as values.

Two ways to run it: *literal*, every open point as the paper has it, and *sensible*, every open
point as it works (METHOD, sections 2 and 3). Both end in a :class:`PaperRun`, which
:func:`shapespline.paper_report.write_report` turns into the paper's figures and a table.

References
----------
.. [1] Eur. Phys. J. Plus 2022, DOI 10.1140/epjp/s13360-022-02604-y.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from functools import partial
from statistics import median
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.engines.least_squares import METHODS
from shapespline.errors import InvalidInputError
from shapespline.fitting import optimize
from shapespline.paper.initial import InitialCurve, initial_curve
from shapespline.paper.reading import LITERAL, SENSIBLE
from shapespline.solvers import Limits, Solver, make_solver

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve, Contour, Fit

LITERAL_METHOD = "d-bfgs-inverse"
SENSIBLE_METHOD = "d-bfgs"
# The paper names no stopping rule. Until the literal run stands still: 25 000 to 35 000
# evaluations on outlines of about 1000 points.
LITERAL_LIMITS = Limits(max_iterations=50_000, max_evaluations=50_000, relative_decrease=1e-6)
SENSIBLE_LIMITS = Limits(max_iterations=4000, max_evaluations=4000, relative_decrease=1e-5)
# Where nothing holds the curve between the data, what a long run gains it gains by loops there
# (METHOD, section 4): residuals on the curve itself hold it (LSQ-01).
SENSIBLE_STRAY_WEIGHT = 0.1
# The sensible reading halves gaps between dominant points that are wider than this part of the mean
# gap: with one control point a maximum, none shapes the run between two of them.
WIDE_GAP = 0.5
# The initial curve takes less than a millisecond: one run alone measures the clock.
TIMED_RUNS = 9


@dataclass(frozen=True, eq=False, kw_only=True)
class PaperRun:
    """The published method, run on one outline.

    Attributes
    ----------
    contour : Contour
    length : int
        The CPDA chord length L, in points.
    literal : bool
        Everything as the paper has it.
    start : InitialCurve
    fit : Fit
    start_error, final_error : float
        The paper's E before and after the optimisation, data units: at the parameters, which are
        no foot parameters, and over n - 1 for n points.
    start_seconds : float
        Time of the initial curve alone, median of several runs.
    seconds : float
        Time of the optimisation.
    """

    contour: Contour
    length: int
    literal: bool
    start: InitialCurve
    fit: Fit
    start_error: float
    final_error: float
    start_seconds: float
    seconds: float


class TimedStart(NamedTuple):
    """An initial curve, its error E_0 in data units, and the seconds it took."""

    start: InitialCurve
    error: float
    seconds: float


def paper_error(contour: Contour, curve: BSplineCurve, parameters: FloatArray) -> float:
    """The paper's E_i: (sum_{j=0..n1} |C(t_j) - Q_j|^2 / n1)^(1/2), n1 + 1 points, data units."""
    residuals = curve(parameters) - contour.points
    return float(np.sqrt(np.sum(residuals**2) / (len(contour) - 1)))


def run_paper(
    contour: Contour,
    length: int,
    *,
    literal: bool = False,
    degree: int = 3,
    method: str | None = None,
    limits: Limits | None = None,
    n_control_points: int | None = None,
) -> PaperRun:
    """Initial curve from CPDA, then control points and parameters together.

    Parameters
    ----------
    contour : Contour
    length : int
        The CPDA chord length L, in points.
    literal : bool
        As published: ``LITERAL`` reading (clamped and uniform, for closed data too), Algorithm 1
        in its inverse form with H_0 = I, secant, weak Wolfe conditions, nothing held. Otherwise
        the ``SENSIBLE`` reading and the direct form from the Gauss-Newton diagonal with strong
        Wolfe conditions, the curve held on the data polyline where neighbours drift apart.
    degree : int
        1 to 9.
    method : str, optional
        Another method of :func:`shapespline.optimize`.
    limits : Limits, optional
        ``LITERAL_LIMITS`` or ``SENSIBLE_LIMITS`` when not given.
    n_control_points : int, optional
        At least so many. When not given, the sensible reading halves the gaps between dominant
        points until none is wider than half the mean one was, because a run without a maximum of
        H would get no control point of its own; the literal reading takes the maxima as they are.

    Raises
    ------
    InvalidInputError
        For a length or degree that the contour cannot take, or an unknown method.

    Examples
    --------
    >>> from shapespline import Contour
    >>> t = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    >>> r = 3 + np.cos(5 * t)
    >>> run = run_paper(Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True), 8)
    >>> run.start.n_control_points, run.final_error < run.start_error
    (20, True)
    """
    if method is not None and method not in METHODS:
        raise InvalidInputError(f"method must be one of {', '.join(METHODS)}, got {method!r}")
    timed = timed_start(
        contour, length, literal=literal, degree=degree, n_control_points=n_control_points
    )
    start = timed.start
    name = method or (LITERAL_METHOD if literal else SENSIBLE_METHOD)
    began = time.perf_counter()
    fit = optimize(
        contour,
        start,
        _literal_solver(name) if literal else name,
        ends="free" if literal else None,
        stray_weight=0.0 if literal else SENSIBLE_STRAY_WEIGHT,
        limits=limits or (LITERAL_LIMITS if literal else SENSIBLE_LIMITS),
    )
    return PaperRun(
        contour=contour,
        length=int(length),
        literal=literal,
        start=start,
        fit=replace(fit, method=name),
        start_error=timed.error,
        final_error=fit.history[-1].paper_error,
        start_seconds=timed.seconds,
        seconds=time.perf_counter() - began,
    )


def timed_start(
    contour: Contour,
    length: int,
    *,
    literal: bool = False,
    degree: int = 3,
    n_control_points: int | None = None,
) -> TimedStart:
    """The first half of :func:`run_paper`, with its time: the median of several runs."""
    seconds = []
    for _ in range(TIMED_RUNS):
        began = time.perf_counter()
        start = _start(contour, length, literal, degree, n_control_points)
        seconds.append(time.perf_counter() - began)
    error = paper_error(contour, start.spline, start.parameters)
    return TimedStart(start, error, median(seconds))


def _start(
    contour: Contour, length: int, literal: bool, degree: int, n_control_points: int | None
) -> InitialCurve:
    """The initial curve, filled where it is to be."""
    make = partial(
        initial_curve, contour, length, degree=degree, reading=LITERAL if literal else SENSIBLE
    )
    start = make(n_control_points=n_control_points or 0)
    filled = literal or n_control_points is not None
    return start if filled else make(n_control_points=_evenly_filled(start))


def _evenly_filled(start: InitialCurve) -> int:
    """Control points once every gap wider than ``WIDE_GAP`` means is halved until it is not."""
    stations, n = start.stations, len(start.samples)
    if start.spline.periodic:
        gaps = np.diff(np.concatenate([stations, stations[:1] + n]))
    else:
        gaps = np.diff(np.concatenate([[0], stations, [n - 1]]))
    halvings = np.maximum(np.ceil(np.log2(gaps / (WIDE_GAP * gaps.mean())) - 1e-9), 0.0)
    return start.n_control_points + int(np.sum(2.0**halvings - 1.0))


def _literal_solver(name: str) -> str | Solver[Any, Any]:
    """A quasi-Newton method as published: H_0 = I, weak Wolfe conditions (Eq. 6)."""
    if name == "levenberg-marquardt":
        return name
    return make_solver(name, start_diagonal="identity", wolfe="weak")
