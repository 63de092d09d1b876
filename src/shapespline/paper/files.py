"""What a run of the published method leaves for other programs: every intermediate result.

Tables as CSV with a header, curves as JSON, SVG and Python source, and a film of the iterates.
"""

from __future__ import annotations

import csv
import io
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from shapespline.fitting import optimize
from shapespline.formats import write
from shapespline.monitor import Iteration
from shapespline.paper.film import film
from shapespline.solvers import Limits
from shapespline.values import Drawing

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapespline.paper.run import PaperRun
    from shapespline.values import Fit

CURVES = tuple(
    f"{curve}-curve.{kind}" for curve in ("initial", "final") for kind in ("json", "svg", "py")
)
DATA_FILES = (
    "points.csv",
    "h.csv",
    "frames.csv",
    "control-points.csv",
    "convergence.csv",
    *CURVES,
)
FILM = "film.svg"


def data_files(run: PaperRun) -> dict[str, bytes]:
    """Contents of ``DATA_FILES`` and, where the run kept its curves, of ``FILM``."""
    start, cpda = run.start, run.start.cpda
    points = run.contour.polyline[: len(start.parameters)]
    is_maximum = np.isin(np.arange(len(cpda.values)), cpda.maxima).astype(int)
    found = {
        "points.csv": table(
            ("index", "x", "y", "t"),
            (
                (i, *at, t)
                for i, (at, t) in enumerate(
                    zip(points.tolist(), start.parameters.tolist(), strict=True)
                )
            ),
        ),
        "h.csv": table(
            ("index", "x", "y", "H_raw", "H", "H_signed", "is_maximum"),
            zip(
                range(len(cpda.values)),
                *start.samples.points.T.tolist(),
                *(values.tolist() for values in (cpda.raw, cpda.values, cpda.signed, is_maximum)),
                strict=True,
            ),
        ),
        "frames.csv": table(
            ("sample", "x", "y", "tangent_x", "tangent_y", "normal_x", "normal_y"),
            zip(
                start.stations.tolist(),
                *start.samples.points[start.stations % len(start.samples)].T.tolist(),
                *start.frames.tangents.T.tolist(),
                *start.frames.normals.T.tolist(),
                strict=True,
            ),
        ),
        "control-points.csv": table(
            ("curve", "index", "x", "y"),
            (
                (name, index, *point)
                for name, spline in (("initial", start.spline), ("final", run.fit.spline))
                for index, point in enumerate(spline.control_points.tolist())
            ),
        ),
        "convergence.csv": table(Iteration._fields, run.fit.history),
    }
    found |= _curve_files({"initial": _start_fit(run), "final": run.fit})
    if run.fit.snapshots:
        found[FILM] = film(run)
    return found


def table(header: Sequence[str], rows: Iterable[Iterable[object]]) -> bytes:
    """Comma-separated values, numbers with the shortest digits that read back to the same."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return text.getvalue().encode()


def _start_fit(run: PaperRun) -> Fit:
    """The initial curve with its distances: a run of no iteration."""
    fit = optimize(
        run.contour, run.start, "fixed-parameters", ends="free", limits=Limits(max_iterations=0)
    )
    return replace(fit, spline=run.start.spline, history=(), method="initial curve")


def _curve_files(fits: dict[str, Fit]) -> dict[str, bytes]:
    """Each curve in each format."""
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in CURVES:
            path = Path(folder) / name
            write(path, Drawing([fits[name.split("-")[0]]]))
            found[name] = path.read_bytes()
    return found
