"""The literal reading: lengths, examples, units, counts, smoothing, data of every kind."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from benchmarks.paper.outlines import EXAMPLES, PUBLISHED_LENGTHS, Example
from benchmarks.paper.tables import Table, count, percent, seconds
from shapespline import LITERAL, SENSIBLE, Contour, Reading, initial_curve
from shapespline.errors import DegenerateContourError
from shapespline.paper import PaperRun, paper_error, run_paper, timed_start

LENGTHS = (5, 4, 3, 2)
# Powers of two leave every rounding as it is; the others say what the identity does.
DIAGONALS = (0.1, 0.3, 1.0, 3.0, 10.0, 40.0, 160.0, 1280.0)
# Literal in everything but the number of control points.
COUNTED = replace(LITERAL, start="cpda-halved", prominence=0.02, signed=True)
BUDGET = 20_000
NOISES = (0.0, 0.0002, 0.001, 0.004)
WINDOWS = (1, 3, 5, 7, 11)


class Shown(NamedTuple):
    """An example run as published, with the published number, and sensibly."""

    example: Example
    contour: Contour
    literal: PaperRun
    counted: PaperRun
    sensible: PaperRun
    same_count: PaperRun


def shown(example: Example) -> Shown:
    """Run one example four ways."""
    contour, length, n = example.contour, example.length, example.published.n_control_points
    literal, counted = (replace(reading, max_evaluations=BUDGET) for reading in (LITERAL, COUNTED))
    return Shown(
        example,
        contour,
        run_paper(contour, length, reading=literal),
        run_paper(contour, length, reading=counted, n_control_points=n),
        run_paper(contour, length),
        run_paper(contour, length, n_control_points=n),
    )


def examples_table(found: list[Shown]) -> Table:
    """Table 2 of the paper, the published rows first."""
    header = (
        "outline",
        "run",
        "control points",
        "E_0",
        "E",
        "rms",
        "two-sided",
        "evaluations",
        "time of the start",
    )
    rows: list[tuple[object, ...]] = []
    for of in found:
        for label, row in (
            ("*published*", of.example.published),
            ("*published, method [47]*", of.example.predecessor),
        ):
            figures = (f"{row.start_error:.4f}", f"{row.final_error:.4f}", "—", "—", "—")
            rows.append(
                (of.example.name, label, row.n_control_points, *figures, f"{row.seconds} s")
            )
        for label, run in (
            ("as published", of.literal),
            ("as published, the published number", of.counted),
            ("sensible", of.sensible),
            ("sensible, the published number", of.same_count),
        ):
            rows.append(
                (
                    of.example.name,
                    label,
                    run.fit.n_control_points,
                    f"{run.start_error:.4f}",
                    f"{run.final_error:.4f}",
                    f"{run.fit.rms_distance:.4f}",
                    f"{run.fit.hausdorff_distance:.3f}",
                    count(run.fit.history[-1].evaluations),
                    seconds(run.start_seconds),
                )
            )
    return Table("examples", header, rows, words=2)


def lengths_table() -> Table:
    """Table 1 of the paper: L against control points, start error and time."""
    header = ("outline", "L", "as published: points", "E_0", "time", "sensible: maxima", "points")
    rows: list[tuple[object, ...]] = [
        ("*published (shape of its Figure 1)*", chord, n, "—", f"{time:.4f} s", *["—"] * 4)
        for chord, (n, time) in PUBLISHED_LENGTHS.items()
    ]
    for example in EXAMPLES:
        for chord in LENGTHS:
            contour = example.contour
            literal = timed_start(contour, chord, reading=LITERAL)
            sensible = timed_start(contour, chord)
            rows.append(
                (
                    example.name,
                    chord,
                    literal.start.n_control_points,
                    f"{literal.error:.3f}",
                    seconds(literal.seconds),
                    len(sensible.start.cpda.maxima),
                    sensible.start.n_control_points,
                    f"{sensible.error:.3f}",
                    seconds(sensible.seconds),
                )
            )
    return Table("lengths", (*header, "E_0", "time"), rows)


class Unit(NamedTuple):
    """One outline in one unit: a reading's errors, parts of the box diagonal."""

    outline: str
    diagonal: float
    reading: str
    n_control_points: int
    start: float
    final: float
    two_sided: float


def units() -> list[Unit]:
    """Every example in every unit, as published and with the published count."""
    rows = []
    for example in EXAMPLES:
        contour, n = example.contour, example.published.n_control_points
        for diagonal in DIAGONALS:
            scaled = Contour(diagonal / contour.box_diagonal * contour.points, closed=True)
            for name, reading, asked in (
                ("as published", LITERAL, None),
                ("published number", COUNTED, n),
            ):
                reading = replace(reading, max_evaluations=BUDGET)
                run = run_paper(scaled, example.length, reading=reading, n_control_points=asked)
                size = scaled.box_diagonal
                errors = run.start_error, run.final_error, run.fit.hausdorff_distance
                parts = (error / size for error in errors)
                rows.append(Unit(example.name, diagonal, name, run.start.n_control_points, *parts))
    return rows


def units_table(rows: list[Unit]) -> Table:
    """The units side by side."""
    header = ("outline", "reading", "box diagonal", "control points", "E_0", "E", "two-sided")
    return Table(
        "units",
        header,
        [
            (r.outline, r.reading, f"{r.diagonal:g}", r.n_control_points, *map(percent, r[4:]))
            for r in sorted(rows, key=lambda r: (r.outline, r.reading, r.diagonal))
        ],
        words=2,
    )


def kinds_table(shapes: dict[str, list[Contour]]) -> Table:
    """Open, semi-closed, self-intersecting data, and all outlines of a shape."""
    header = ("data", "reading", "outlines", "control points", "E_0", "E", "two-sided")
    rows = []
    for name, contours in shapes.items():
        for label, reading in (("as published", LITERAL), ("sensible", SENSIBLE)):
            reading = replace(reading, max_evaluations=4000)
            scaled = [Contour(10.0 / c.box_diagonal * c.points, closed=c.closed) for c in contours]
            try:
                runs = [run_paper(contour, 6, reading=reading) for contour in scaled]
            except DegenerateContourError:
                rows.append((name, label, len(scaled), "too few maxima", "—", "—", "—"))
                continue
            rows.append(
                (
                    name,
                    label,
                    len(runs),
                    sum(run.fit.n_control_points for run in runs),
                    percent(max(run.start_error for run in runs) / 10),
                    percent(max(run.final_error for run in runs) / 10),
                    percent(max(run.fit.hausdorff_distance for run in runs) / 10),
                )
            )
    return Table("kinds", header, rows, words=2)


class Smoothed(NamedTuple):
    """What a moving average does under noise, means of the examples and draws."""

    noise: float
    window: int
    literal_points: float
    prominent_points: float
    off_truth: float


def smoothing(draws: int = 5) -> list[Smoothed]:
    """Noise x window: maxima that count, and how far the literal start is from the truth."""
    rows = []
    for noise in NOISES:
        for window in WINDOWS:
            counts, prominent, off = [], [], []
            for example in EXAMPLES:
                clean = example.contour
                for draw in range(draws if noise else 1):
                    random = np.random.default_rng(draw).normal(0.0, 1.0, clean.points.shape)
                    noisy = Contour(clean.points + noise * clean.box_diagonal * random, True)
                    literal = initial_curve(noisy, 4, reading=replace(LITERAL, window=window))
                    sensible = initial_curve(noisy, 4, reading=_maxima(window))
                    counts.append(literal.n_control_points)
                    prominent.append(len(sensible.cpda.maxima))
                    error = paper_error(clean, literal.spline, literal.parameters)
                    off.append(error / clean.box_diagonal)
            means = (float(np.mean(values)) for values in (counts, prominent, off))
            rows.append(Smoothed(noise, window, *means))
    return rows


def _maxima(window: int) -> Reading:
    return replace(SENSIBLE, window=window)


def smoothing_table(rows: list[Smoothed]) -> Table:
    """The experiment as a table."""
    header = (
        "noise, of the diagonal",
        "window",
        "control points, every maximum",
        "maxima above noise",
        "E_0 to the clean outline",
    )
    return Table(
        "smoothing",
        header,
        [
            (
                percent(row.noise) if row.noise else "none",
                row.window,
                f"{row.literal_points:.0f}",
                f"{row.prominent_points:.0f}",
                percent(row.off_truth),
            )
            for row in rows
        ],
    )
