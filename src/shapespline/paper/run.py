"""The published method from an outline to its final curve.

How it is read is a :class:`shapespline.paper.Reading`, its own constants included: as published
(``LITERAL``) or as it works (``SENSIBLE``). A run is an initial curve and its optimisation, timed:
`initial_curve` and `optimize` give the same curve. `write_report` turns it into figures and files.

References
----------
.. [1] Eur. Phys. J. Plus 2022, DOI 10.1140/epjp/s13360-022-02604-y.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from statistics import median
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.least_squares import named_solver
from shapespline.fitting import optimize
from shapespline.paper.initial import InitialCurve, initial_curve
from shapespline.paper.reading import SENSIBLE, Reading

if TYPE_CHECKING:
    from shapespline.solvers import Limits
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve, Contour, Fit

# The initial curve takes less than a millisecond: one run alone measures the clock.
TIMED_RUNS = 9


@dataclass(frozen=True, eq=False, kw_only=True)
class PaperRun:
    """The published method, run on one outline.

    Attributes
    ----------
    contour : Contour
    start : InitialCurve
        With the ``reading`` that it and the fit follow; ``start.cpda.length`` is L.
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
    start: InitialCurve
    fit: Fit
    start_error: float
    final_error: float
    start_seconds: float
    seconds: float

    @property
    def reading(self) -> Reading:
        """How the paper was read."""
        return self.start.reading

    @property
    def length(self) -> int:
        """The CPDA chord length L, in points of ``start.samples``."""
        return self.start.cpda.length


class TimedStart(NamedTuple):
    """An initial curve, its error E_0 in data units, and the seconds it took."""

    start: InitialCurve
    error: float
    seconds: float


def paper_error(contour: Contour, curve: BSplineCurve, parameters: FloatArray) -> float:
    """The paper's E_i: (sum_{j=0..n1} |C(t_j) - Q_j|^2 / n1)^(1/2), n1 + 1 points, data units.

    A parameter more than points is that of a closed outline's first point, come back to.
    """
    points = contour.polyline if len(parameters) > len(contour) else contour.points
    residuals = curve(parameters) - points
    return float(np.sqrt(np.sum(residuals**2) / (len(points) - 1)))


def run_paper(
    contour: Contour,
    length: int | None = None,
    *,
    arc_length: float | None = None,
    reading: Reading = SENSIBLE,
    method: str | None = None,
    degree: int = 3,
    n_control_points: int | None = None,
    limits: Limits | None = None,
    snapshots: int = 0,
) -> PaperRun:
    """Initial curve from CPDA, then control points and parameters together.

    Parameters
    ----------
    contour : Contour
    length : int, optional
        The CPDA chord length L, in points; 8 when neither length is given.
    arc_length : float, optional
        The same in data units.
    reading : Reading
        ``SENSIBLE``, ``LITERAL`` or fields of your own; every constant of the run.
    method : str, optional
        Another method of :func:`shapespline.optimize` than the reading's.
    degree : int
        1 to 9.
    n_control_points : int, optional
        How many; see `initial_curve`.
    limits : Limits, optional
        Other limits than the reading's.
    snapshots : int
        Keep the curve of every so many iterations in ``run.fit.snapshots``.

    Raises
    ------
    InvalidInputError
        For a length, degree or number that the contour cannot take, or an unknown method.

    Examples
    --------
    >>> from shapespline import Contour
    >>> t = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    >>> r = 3 + np.cos(5 * t)
    >>> run = run_paper(Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True), 8)
    >>> run.start.n_control_points, run.final_error < run.start_error
    (20, True)
    """
    if method is not None:
        named_solver(method)  # before any work
    timed = timed_start(
        contour,
        length,
        arc_length=arc_length,
        reading=reading,
        degree=degree,
        n_control_points=n_control_points,
    )
    began = time.perf_counter()
    fit = optimize(contour, timed.start, method, limits=limits, snapshots=snapshots)
    return PaperRun(
        contour=contour,
        start=timed.start,
        fit=fit,
        start_error=timed.error,
        final_error=fit.history[-1].paper_error,
        start_seconds=timed.seconds,
        seconds=time.perf_counter() - began,
    )


def timed_start(
    contour: Contour,
    length: int | None = None,
    *,
    arc_length: float | None = None,
    reading: Reading = SENSIBLE,
    degree: int = 3,
    n_control_points: int | None = None,
) -> TimedStart:
    """The first half of :func:`run_paper`, with its time: the median of several runs."""
    make = partial(
        initial_curve,
        contour,
        length,
        arc_length=arc_length,
        reading=reading,
        degree=degree,
        n_control_points=n_control_points,
    )
    seconds = []
    for _ in range(TIMED_RUNS):
        began = time.perf_counter()
        start = make()
        seconds.append(time.perf_counter() - began)
    return TimedStart(start, paper_error(contour, start.spline, start.parameters), median(seconds))
