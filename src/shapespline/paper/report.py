"""The report of a run of the published method: its figures, and a table as a page and as CSV."""

from __future__ import annotations

import os
import tempfile
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.errors import FormatError
from shapespline.formats import check_target, write_atomically
from shapespline.paper.files import DATA_FILES, FILM, data_files, table
from shapespline.paper.reading import LITERAL, SENSIBLE, Reading
from shapespline.plotting import check_matplotlib

if TYPE_CHECKING:
    from shapespline.paper.run import PaperRun

FIGURES = (
    "1-points.png",
    "2-cpda.png",
    "3-frames.png",
    "4-initial-curve.png",
    "5-final-curve.png",
    "6-convergence.png",
)
DRAWINGS = tuple(f"{name.removesuffix('.png')}.svg" for name in FIGURES)
TABLES = ("report.md", "table.csv")


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
    MissingExtraError
        If matplotlib is not installed.
    """
    check_matplotlib()
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
        for name in (*FIGURES, *DRAWINGS, *TABLES, *DATA_FILES, FILM):
            check_target(folder / name)
    return folder


def write_report(run: PaperRun, folder: str | os.PathLike[str]) -> list[Path]:
    """Write the figures of a run as PNG and SVG, its table, and every intermediate result.

    The table is ``report.md`` and ``table.csv``. Points, H with its maxima, frames, control points
    and convergence are CSV; initial and final curve JSON, SVG and Python source for scipy; where
    the run kept its curves, ``film.svg`` shows them one after another.

    The folder is created if its parent exists. Everything is drawn before the first file is
    written, and each file is written whole or not at all.

    Returns
    -------
    list of Path
        The files, in the order of ``FIGURES``, ``DRAWINGS``, ``TABLES`` and ``DATA_FILES``, and
        the film.

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
        for names in (FIGURES, DRAWINGS):
            _draw(run, [Path(drawn) / name for name in names])
        contents = {name: (Path(drawn) / name).read_bytes() for name in (*FIGURES, *DRAWINGS)}
    contents["report.md"] = _markdown(run, rows).encode()
    contents["table.csv"] = table(("quantity", "value", "relative to the box diagonal"), rows)
    contents |= data_files(run)
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        reason = error.strerror or error
        raise FormatError(f"cannot write the report to {folder}: {reason}") from error
    for name, data in contents.items():
        write_atomically(folder / name, data)
    return [folder / name for name in contents]


def reading_name(reading: Reading) -> str:
    """Literal, sensible, or the fields in which it differs from the nearer of the two."""
    named = {"sensible": SENSIBLE, "literal": LITERAL}
    changes = {
        name: [
            f"{field.name}={getattr(reading, field.name)}"
            for field in fields(Reading)
            if getattr(reading, field.name) != getattr(base, field.name)
        ]
        for name, base in named.items()
    }
    name = min(changes, key=lambda name: len(changes[name]))
    return " ".join([name, *changes[name]])


def report_rows(run: PaperRun) -> list[Row]:
    """The table of a run: sizes, errors in data units and relative, times, why it ended."""
    fit, diagonal = run.fit, run.contour.box_diagonal

    def length(quantity: str, value: float) -> Row:
        return Row(quantity, f"{value:.6g}", f"{value / diagonal:.6g}")

    last = fit.history[-1]
    return [
        Row("reading", reading_name(run.reading)),
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


def _draw(run: PaperRun, paths: list[Path]) -> None:
    """Write the six figures."""
    from shapespline.paper import figures as figures

    points, cpda, frames, initial, final, convergence = paths
    start, samples, length = run.start, run.start.samples, run.length
    figures.plot_points(run.contour, points, title="Data")
    figures.plot_cpda(
        start.cpda.values,
        start.cpda.maxima,
        cpda,
        raw=start.cpda.raw,
        threshold=start.cpda.floor or None,
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
        f"# The published method, {reading_name(run.reading)} reading",
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
    if run.fit.snapshots:
        lines += [f"![the iterates, one after another]({FILM})", ""]
    return "\n".join(lines)
