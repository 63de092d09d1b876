"""The figures of the page: those of the paper, and the one that answers whether its start helps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

from benchmarks.paper.outlines import REPOSITORY
from benchmarks.paper.tables import geometric
from shapespline import LITERAL, SENSIBLE, initial_curve, optimize
from shapespline.paper import figures as drawn
from shapespline.plotting import (
    BLUE,
    FONT_SIZE,
    GREY,
    INK,
    PALE,
    RED,
    new_figure,
    quiet_axes,
    save,
)

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes

    from benchmarks.paper.literal import Shown
    from benchmarks.paper.start_claim import Compared

PICTURES = REPOSITORY / "docs" / "figures" / "paper"


def picture(name: str) -> Path:
    """Where a figure of the page is."""
    return PICTURES / f"{name}.svg"


def draw_claim(panels: list[tuple[Compared, str, str]]) -> None:
    """Does the start help? A dot a start: rms at the end relative to the obvious start."""
    figure = new_figure(11.0, 4.4)
    grid = figure.subplots(1, len(panels))
    for axes, (compared, method, title) in zip(grid, panels, strict=True):
        _draw_panel(axes, compared, method, title)
    save(figure, picture("does-the-start-help"))


def _draw_panel(axes: Axes, compared: Compared, method: str, title: str) -> None:
    labels = sorted(
        compared.setting.starts,
        key=lambda label: geometric(compared.ratios(method, label, "rms"))[0],
        reverse=True,
    )
    for row, label in enumerate(labels):
        ratios = compared.ratios(method, label, "rms")
        mean, factor = geometric(ratios)
        ours = label.startswith(("the paper", "maxima of H"))
        color = GREY if label == compared.setting.reference else RED if ours else BLUE
        axes.plot(ratios, np.full(len(ratios), row), "o", ms=3, color=color, alpha=0.3, mew=0)
        axes.plot([mean / factor, mean * factor], [row, row], color=color, lw=1.5)
        axes.plot(mean, row, "o", ms=8, color=color, mew=0)
        axes.annotate(
            f"{mean:.2g}",
            (mean, row),
            (0, 7),
            textcoords="offset points",
            ha="center",
            fontsize=FONT_SIZE - 1,
            color=INK,
        )
    axes.axvline(1.0, color=INK, lw=0.8)
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high / low < 100 else (1.0,)))
    axes.xaxis.set_major_formatter(FormatStrFormatter("%g"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(-0.6, len(labels) - 0.3)
    axes.grid(axis="x", color=PALE, linewidth=0.5)
    quiet_axes(axes, x="rms distance at the end, relative; less is better", title=title)


def draw_steps(shown: Shown, length: int) -> None:
    """Figure 1: points, H, frames and initial curve, as published and sensibly."""
    contour = shown.contour
    drawn.plot_points(contour, picture("figure1a-points"), title="Data")
    for name, reading in (("literal", LITERAL), ("sensible", SENSIBLE)):
        start = initial_curve(contour, length, reading=reading)
        drawn.plot_cpda(
            start.cpda.values,
            start.cpda.maxima,
            picture(f"figure1b-cpda-{name}"),
            raw=start.cpda.raw,
            threshold=start.cpda.floor or None,
            title=f"Chord-to-point distance accumulation, L = {length}, {name}",
        )
        of_maximum = np.isin(start.stations, start.cpda.maxima)
        drawn.plot_frames(
            start.samples,
            start.stations[of_maximum],
            start.frames.tangents[of_maximum],
            start.frames.normals[of_maximum],
            picture(f"figure1c-frames-{name}"),
            title=f"Tangents and normals at the local maxima, {name}",
        )
        drawn.plot_initial_curve(
            contour, start.spline, picture(f"figure1d-initial-{name}"), title=f"Initial, {name}"
        )


def draw_lengths(shown: Shown, lengths: tuple[int, ...]) -> None:
    """Figure 2: the initial curve for several L."""
    for name, reading in (("literal", LITERAL), ("sensible", SENSIBLE)):
        curves = {
            f"L = {chord}": initial_curve(shown.contour, chord, reading=reading).spline
            for chord in lengths
        }
        drawn.plot_panels(
            shown.contour, curves, picture(f"figure2-lengths-{name}"), title=f"Initial, {name}"
        )


def draw_example(shown: Shown) -> None:
    """Figures 4 to 6: initial and final curve, and the convergence."""
    number = shown.example.figure
    for name, run in (("literal", shown.counted), ("sensible", shown.same_count)):
        drawn.plot_initial_curve(
            shown.contour,
            run.start.spline,
            picture(f"figure{number}a-initial-{name}"),
            title=f"Initial curve, {name}: E_0 = {run.start_error:.3f}",
        )
        drawn.plot_final_curve(
            shown.contour,
            run.fit.spline,
            picture(f"figure{number}b-final-{name}"),
            title=f"Final curve, {name}: E = {run.final_error:.4f},"
            f" two-sided {run.fit.hausdorff_distance:.3f}",
        )
    best = optimize(shown.contour, shown.same_count.start, "levenberg-marquardt")
    drawn.plot_convergence(
        {
            "as published, the published number": shown.counted.fit.history,
            "sensible, direct D-BFGS": shown.same_count.fit.history,
            "sensible, Levenberg-Marquardt": best.history,
        },
        picture(f"figure{number}c-convergence"),
        title=f"Convergence, {shown.example.name}",
    )
