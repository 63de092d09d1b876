"""The published method from an outline to its final curve, with its own constants as values.

Two ways to run it: *literal*, every open point as the paper has it, and *sensible*, every open
point as it works (METHOD, sections 2 and 3). Both end in a :class:`PaperRun`, which
:func:`write_report` turns into the paper's figures and a table.

References
----------
.. [1] Eur. Phys. J. Plus 2022, DOI 10.1140/epjp/s13360-022-02604-y.
"""

from __future__ import annotations

import csv
import io
import os
import tempfile
import time
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats.atomic import check_target, write_atomically
from shapespline.initial import LITERAL, SENSIBLE, InitialCurve, initial_curve
from shapespline.optimization import METHODS, optimize
from shapespline.solvers.iteration import Limits, Solver
from shapespline.solvers.quasi_newton import make_solver

if TYPE_CHECKING:
    from shapespline.contour import Contour
    from shapespline.curve import BSplineCurve
    from shapespline.drawing import Fit
    from shapespline.typing import FloatArray

LITERAL_METHOD = "d-bfgs-inverse"
SENSIBLE_METHOD = "d-bfgs"
# The paper names no stopping rule. Until the literal run stands still: 25 000 to 35 000
# evaluations on outlines of about 1000 points.
LITERAL_LIMITS = Limits(max_iterations=50_000, max_evaluations=50_000, relative_decrease=1e-6)
# Until three steps in a row gain less than a hundredth. Where nothing holds the curve between the
# data, what a longer run still gains it gains by loops there (METHOD, section 4).
SENSIBLE_LIMITS = Limits(max_iterations=2000, max_evaluations=4000, relative_decrease=1e-2)
# The initial curve takes less than a millisecond: one run alone measures the clock.
TIMED_RUNS = 9

FIGURES = (
    "1-points.png",
    "2-cpda.png",
    "3-frames.png",
    "4-initial-curve.png",
    "5-final-curve.png",
    "6-convergence.png",
)
TABLES = ("report.md", "table.csv")


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
        Wolfe conditions.
    degree : int
        1 to 9.
    method : str, optional
        Another method of :func:`shapespline.optimize`.
    limits : Limits, optional
        ``LITERAL_LIMITS`` or ``SENSIBLE_LIMITS`` when not given.
    n_control_points : int, optional
        At least so many. When not given, the sensible reading halves the gaps between dominant
        points until none is wider than the mean one was, because a run without a maximum of H
        would get no control point of its own; the literal reading takes the maxima as they are.

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
    (10, True)
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
    """Control points once every gap wider than the mean one is halved until it is not."""
    stations, n = start.stations, len(start.samples)
    if start.spline.periodic:
        gaps = np.diff(np.concatenate([stations, stations[:1] + n]))
    else:
        gaps = np.diff(np.concatenate([[0], stations, [n - 1]]))
    halvings = np.maximum(np.ceil(np.log2(gaps / gaps.mean()) - 1e-9), 0.0)
    return start.n_control_points + int(np.sum(2.0**halvings - 1.0))


def _literal_solver(name: str) -> str | Solver[Any, Any]:
    """A quasi-Newton method as published: H_0 = I, weak Wolfe conditions (Eq. 6)."""
    if name == "levenberg-marquardt":
        return name
    return make_solver(name, start_diagonal="identity", wolfe="weak")


# The report


class Row(NamedTuple):
    """One line of the table; lengths have a value relative to the box diagonal too."""

    quantity: str
    value: str
    relative: str = ""


def check_folder(folder: str | os.PathLike[str]) -> Path:
    """Return the folder to write a report to, or say why that cannot be.

    Raises
    ------
    FormatError
        If neither the folder nor its parent exists, or it cannot be written.
    """
    folder = Path(folder)
    if folder.exists() and not folder.is_dir():
        raise FormatError(f"cannot write the report to {folder}: it is a file; name a folder")
    if not folder.exists() and not folder.parent.is_dir():
        raise FormatError(
            f"cannot write the report to {folder}: {folder.parent} does not exist; create it first"
        )
    existing = folder if folder.exists() else folder.parent
    if not os.access(existing, os.W_OK | os.X_OK):
        raise FormatError(f"cannot write the report to {folder}: {existing} is write-protected")
    if folder.exists():
        for name in (*FIGURES, *TABLES):
            check_target(folder / name)
    return folder


def write_report(run: PaperRun, folder: str | os.PathLike[str]) -> list[Path]:
    """Write the figures of a run as PNG, and its table as ``report.md`` and ``table.csv``.

    The folder is created if its parent exists. Everything is drawn before the first file is
    written, so that a failure leaves nothing half done.

    Returns
    -------
    list of Path
        The files, in the order of ``FIGURES`` and ``TABLES``.

    Raises
    ------
    FormatError
        If the folder cannot be made or written.
    MissingExtraError
        If matplotlib is not installed.
    """
    folder = check_folder(folder)
    rows = report_rows(run)
    with tempfile.TemporaryDirectory() as drawn:
        _draw(run, Path(drawn))
        contents = {name: (Path(drawn) / name).read_bytes() for name in FIGURES}
    contents["report.md"] = _markdown(run, rows).encode()
    contents["table.csv"] = _csv(rows).encode()
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        reason = error.strerror or error
        raise FormatError(f"cannot write the report to {folder}: {reason}") from error
    for name, data in contents.items():
        write_atomically(folder / name, data)
    return [folder / name for name in contents]


def report_rows(run: PaperRun) -> list[Row]:
    """The table of a run: sizes, errors in data units and relative, times, why it ended."""
    fit, diagonal = run.fit, run.contour.box_diagonal

    def length(quantity: str, value: float) -> Row:
        return Row(quantity, f"{value:.6g}", f"{value / diagonal:.6g}")

    last = fit.history[-1]
    return [
        Row("reading", "literal" if run.literal else "sensible"),
        Row("method", fit.method),
        Row("length L", str(run.length)),
        Row("degree", str(fit.degree)),
        Row("data points", str(len(run.contour))),
        length("box diagonal", diagonal),
        Row("local maxima of H", str(len(run.start.cpda.maxima))),
        Row("control points", str(fit.n_control_points)),
        length("start error E_0", run.start_error),
        length("final error E", run.final_error),
        length("rms distance", fit.rms_distance),
        length("maximum distance", fit.max_distance),
        length("two-sided distance", fit.hausdorff_distance),
        Row("iterations", str(last.iteration)),
        Row("evaluations", str(last.evaluations)),
        Row("time of the initial curve, s", f"{run.start_seconds:.3g}"),
        Row("time of the optimisation, s", f"{run.seconds:.3g}"),
        Row("end", fit.status.value),
    ]


def _draw(run: PaperRun, folder: Path) -> None:
    """Write the six figures."""
    from shapespline import paper_figures as figures

    points, cpda, frames, initial, final, convergence = (folder / name for name in FIGURES)
    start, samples, length = run.start, run.start.samples, run.length
    figures.plot_points(run.contour, points, title="Data")
    figures.plot_cpda(
        start.cpda.values,
        start.cpda.maxima,
        cpda,
        raw=start.cpda.raw,
        threshold=None if run.literal else start.cpda.floor,
        title=f"Chord-to-point distance accumulation, L = {length}",
    )
    of_maximum = np.isin(start.stations, start.cpda.maxima)
    figures.plot_frames(
        samples,
        start.stations[of_maximum],
        start.frames.tangents[of_maximum],
        start.frames.normals[of_maximum],
        frames,
        title="Tangents and normals at the local maxima",
    )
    figures.plot_initial_curve(
        run.contour,
        start.spline,
        initial,
        title=f"Initial curve, L = {length}, error {run.start_error:.4g}",
    )
    figures.plot_final_curve(
        run.contour,
        run.fit.spline,
        final,
        title=f"Final curve, error {run.final_error:.4g}, maximum {run.fit.max_distance:.4g},"
        f" two-sided {run.fit.hausdorff_distance:.4g}",
    )
    figures.plot_convergence({run.fit.method: run.fit.history}, convergence, title="Convergence")


def _markdown(run: PaperRun, rows: list[Row]) -> str:
    """The table and the figures as one page."""
    lines = [
        f"# The published method, {'literal' if run.literal else 'sensible'} reading",
        "",
        "E is the error that the paper reports, taken at the location parameters and over n - 1"
        " for n points. The distances below it are geometric: of the data from the curve, and"
        " two-sided, a bound that holds for every point of the curve as well.",
        "",
        "| quantity | value | relative to the box diagonal |",
        "|---|---:|---:|",
        *(f"| {row.quantity} | {row.value} | {row.relative} |" for row in rows),
        "",
    ]
    for name in FIGURES:
        caption = name.removesuffix(".png").split("-", 1)[1].replace("-", " ")
        lines += [f"![{caption}]({name})", ""]
    return "\n".join(lines)


def _csv(rows: list[Row]) -> str:
    """The table as comma-separated values with a header."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["quantity", "value", "relative to the box diagonal"])
    writer.writerows(rows)
    return text.getvalue()
