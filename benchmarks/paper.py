"""``make paper``: run the published method and write docs/paper.md with its figures.

Run it from the repository: ``python -m benchmarks.paper``. It takes about a minute.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from benchmarks import paper_runs as measured
from benchmarks.paper_text import Findings, document
from shapespline.formats.atomic import write_atomically
from shapespline.paper import figures as figures
from shapespline.paper.run import PaperRun, run_paper

if TYPE_CHECKING:
    from pathlib import Path

    from benchmarks.paper_runs import OutlineRuns

DOCUMENT = measured.REPOSITORY / "docs" / "paper.md"
PICTURES = measured.REPOSITORY / "docs" / "figures" / "paper"
# Figure 1 of the paper has L = 8, Figure 2 the lengths of Table 1.
FIGURE_1_LENGTH = 8
UNIT_LENGTH = 5
# Powers of two leave every rounding as it is: what differs is the method.
UNIT_FACTORS = (1.0, 16.0, 128.0)
PIXELS = (200, 400, 800)
SIZES = (1000, 3000, 10_000, 30_000, 100_000)


@dataclass(frozen=True)
class Reading:
    """One way to read the paper, as the names of figures have it."""

    name: str
    literal: bool


READINGS = (Reading("literal", True), Reading("sensible", False))


def main() -> None:
    began = time.perf_counter()
    PICTURES.mkdir(parents=True, exist_ok=True)
    runs = [measured.measure(outline) for outline in measured.OUTLINES]
    leaf = runs[0]
    first = {
        reading.name: run_paper(leaf.contour, FIGURE_1_LENGTH, literal=reading.literal)
        for reading in READINGS
    }
    found = Findings(
        runs=runs,
        first=first,
        units=measured.units(leaf.contour, UNIT_LENGTH, UNIT_FACTORS),
        unit_length=UNIT_LENGTH,
        parameters={
            run.outline.name: measured.parameter_errors(run.contour, run.outline.length)
            for run in runs
        },
        rounding={
            run.outline.name: measured.under_rounding(run.contour, run.outline.length)
            for run in runs
        },
        pixels={
            n: measured.pixel_counts(measured.pixel_chain(leaf.contour, n), FIGURE_1_LENGTH)
            for n in PIXELS
        },
        pixel_length=FIGURE_1_LENGTH,
        going_on={
            run.outline.name: measured.going_on(run.contour, run.shown.start) for run in runs
        },
        growth=measured.growth(leaf.contour, SIZES),
    )
    draw_first(first)
    draw_lengths(leaf)
    for run in runs:
        draw_outline(run)
    write_atomically(DOCUMENT, document(found).encode())
    print(f"wrote {DOCUMENT} and its figures in {time.perf_counter() - began:.0f} s")


def draw_first(first: dict[str, PaperRun]) -> None:
    """Figures 1 and 3: the steps at L = 8, and where they lead."""
    for name, run in first.items():
        start = run.start
        if not run.literal:
            figures.plot_points(run.contour, picture("figure1a-points"), title="Data")
        figures.plot_cpda(
            start.cpda.values,
            start.cpda.maxima,
            picture(f"figure1b-cpda-{name}"),
            raw=start.cpda.raw,
            threshold=None if run.literal else start.cpda.floor,
            title=f"Chord-to-point distance accumulation, L = {run.length}, {name}",
        )
        of_maximum = np.isin(start.stations, start.cpda.maxima)
        figures.plot_frames(
            start.samples,
            start.stations[of_maximum],
            start.frames.tangents[of_maximum],
            start.frames.normals[of_maximum],
            picture(f"figure1c-frames-{name}"),
            title=f"Tangents and normals at the local maxima, {name}",
        )
        draw_initial(run, f"figure1d-initial-{name}", name)
        draw_final(run, f"figure3-final-{name}", name)


def draw_lengths(run: OutlineRuns) -> None:
    """Figure 2: the initial curve for L = 5, 4, 3, 2."""
    for reading in READINGS:
        curves = {
            f"L = {chord}": run.lengths[chord, reading.literal].start.spline
            for chord in measured.LENGTHS
        }
        figures.plot_panels(
            run.contour,
            curves,
            picture(f"figure2-lengths-{reading.name}"),
            title=f"Initial curves, {reading.name}",
        )


def draw_outline(run: OutlineRuns) -> None:
    """Figures 4 to 6: initial and final curve, literal and sensible."""
    figure = f"figure{run.outline.figure}"
    for name, one in (("literal", run.literal), ("sensible", run.shown)):
        draw_initial(one, f"{figure}a-initial-{name}", name)
        draw_final(one, f"{figure}b-final-{name}", name)
    held = run.held
    figures.plot_final_curve(
        run.contour,
        held.spline,
        picture(f"{figure}c-held"),
        title=f"Levenberg-Marquardt, held on the data: {held.n_control_points} control points,"
        f" maximum {held.max_distance:.3f}, two-sided {held.hausdorff_distance:.3f}",
    )
    figures.plot_convergence(
        {
            "literal": run.literal.fit.history,
            "sensible, direct D-BFGS": run.shown.fit.history,
            "sensible, Levenberg-Marquardt": held.history,
        },
        picture(f"{figure}d-convergence"),
        title=f"Convergence, {run.outline.name}",
    )


def draw_initial(run: PaperRun, name: str, reading: str) -> None:
    figures.plot_initial_curve(
        run.contour,
        run.start.spline,
        picture(name),
        title=f"Initial curve, L = {run.length}, {reading}: error {run.start_error:.3f}",
    )


def draw_final(run: PaperRun, name: str, reading: str) -> None:
    figures.plot_final_curve(
        run.contour,
        run.fit.spline,
        picture(name),
        title=f"Final curve, {reading}: {run.fit.n_control_points} control points, error"
        f" {run.final_error:.4f}, maximum {run.fit.max_distance:.3f},"
        f" two-sided {run.fit.hausdorff_distance:.3f}",
    )


def picture(name: str) -> Path:
    """Where a figure of the document is."""
    return PICTURES / f"{name}.png"


if __name__ == "__main__":
    main()
