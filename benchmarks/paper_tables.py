"""The tables of docs/paper.md, from what was measured."""

from __future__ import annotations

from typing import TYPE_CHECKING

from benchmarks.paper_runs import (
    LENGTHS,
    LITERAL_CONFIGURATION,
    PUBLISHED_LENGTHS,
    STRICTER,
    GoingOn,
    Growth,
    MethodRun,
    OutlineRuns,
    Parameters,
    Published,
    UnitRow,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapespline import Fit


def table(header: Sequence[str], rows: Iterable[Sequence[object]], n_words: int = 1) -> str:
    """A Markdown table; the first columns hold words, the others figures, to the right."""
    lines = [header, ["---"] * n_words + ["---:"] * (len(header) - n_words), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def seconds(value: float) -> str:
    """A time to two digits, in a unit that suits it."""
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if value >= 0.995 * size:
            return f"{_two_digits(value / size)} {unit}"
    return f"{_two_digits(value / 1e-6)} µs"


def _two_digits(value: float) -> str:
    if value >= 99.5:
        return f"{float(f'{value:.2g}'):.0f}"
    return f"{value:.2g}" if value >= 9.95 else f"{value:.1f}"


def count(value: int) -> str:
    """A whole number with thin groups of three."""
    return f"{value:,}".replace(",", " ")


def lengths(runs: Sequence[OutlineRuns]) -> str:
    """Table 1: the length L against control points, start error and time."""
    header = (
        "outline",
        "L",
        "literal: points",
        "E_0",
        "time",
        "sensible: maxima",
        "points",
        "E_0",
        "time",
    )
    rows: list[Sequence[object]] = [
        ("*published (shape of its Figure 1)*", chord, n, "not given", f"{time:.4f} s", *["—"] * 4)
        for chord, (n, time) in PUBLISHED_LENGTHS.items()
    ]
    for run in runs:
        for chord in LENGTHS:
            literal, sensible = run.lengths[chord, True], run.lengths[chord, False]
            rows.append(
                (
                    run.outline.name,
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
    return table(header, rows)


def examples(runs: Sequence[OutlineRuns]) -> str:
    """Table 2: three outlines, the published rows first."""
    header = (
        "outline",
        "method",
        "control points",
        "start error",
        "final error",
        "rms",
        "maximum",
        "two-sided",
        "time of the initial curve",
    )
    rows: list[Sequence[object]] = []
    for run in runs:
        outline = run.outline
        rows.append(_published(outline.name, "*published, our method*", outline.ours))
        rows.append(_published(outline.name, "*published, method [47]*", outline.predecessor))
        rows += [
            (
                outline.name,
                entry.label,
                entry.n_control_points,
                f"{entry.start_error:.4f}",
                f"{entry.fit.history[-1].paper_error:.4f}",
                f"{entry.fit.rms_distance:.4f}",
                f"{entry.fit.max_distance:.3f}",
                f"{entry.fit.hausdorff_distance:.3f}",
                seconds(entry.start_seconds),
            )
            for entry in run.entries
        ]
    return table(header, rows, n_words=2)


def _published(outline: str, label: str, row: Published) -> tuple[object, ...]:
    errors = f"{row.start_error:.4f}", f"{row.final_error:.4f}"
    return outline, label, row.n_control_points, *errors, "—", "—", "—", f"{row.seconds} s"


def methods(run: OutlineRuns) -> str:
    """Every method from both starts to the two targets."""
    header = (
        "method",
        "literal start: to the target",
        f"to {STRICTER:g} of it",
        "sensible start: to the target",
        f"to {STRICTER:g} of it",
    )
    names = run.methods[True]
    return table(
        header,
        [
            (
                name if name == LITERAL_CONFIGURATION else f"`{name}`",
                *(
                    _reached(run.methods[literal][name], target)
                    for literal in (True, False)
                    for target in range(2)
                ),
            )
            for name in names
        ],
    )


def _reached(run: MethodRun, target: int) -> str:
    """Iterations / evaluations / time, or where it stood when it ended."""
    record = run.reached[target]
    if record is None:
        last = run.last
        return f"not reached: {last.paper_error:.4f} after {count(last.evaluations)}"
    if record.iteration == 0:
        return "already there"
    return f"{count(record.iteration)} / {count(record.evaluations)} / {seconds(record.seconds)}"


def tenth(runs: Sequence[OutlineRuns]) -> str:
    """The literal run's evaluations beside those of direct D-BFGS."""
    header = (
        "outline",
        "literal: control points",
        "ends at E",
        "evaluations to within 1 %",
        "until it ended",
        "sensible: control points",
        "evaluations to that E",
        "part",
        "as many points as literal",
        "evaluations",
    )
    rows = []
    for run in runs:
        near, last = run.literal_near_end.evaluations, run.literal.fit.history[-1].evaluations
        direct, counted = run.direct, run.at_literal_count.reached[0]
        rows.append(
            (
                run.outline.name,
                run.literal.fit.n_control_points,
                f"{run.literal.final_error:.4f}",
                count(near),
                count(last),
                run.sensible.fit.n_control_points,
                "not reached" if direct is None else count(direct.evaluations),
                "—" if direct is None else f"1/{count(round(near / direct.evaluations))}",
                run.n_at_literal_count,
                "not reached" if counted is None else count(counted.evaluations),
            )
        )
    return table(header, rows)


def going_on(rows: dict[str, list[GoingOn]]) -> str:
    """What a longer run gains, and what it costs."""
    header = ("outline", "stop at a fall below", "evaluations", "E", "data to curve", "two-sided")
    header = (*header, *(f"held: {title}" for title in header[2:]))
    return table(
        header,
        [
            (
                name,
                f"{row.relative_decrease:.0e}",
                *(cell for fit in (row.plain, row.held) for cell in _end(fit)),
            )
            for name, of_outline in rows.items()
            for row in of_outline
        ],
    )


def _end(fit: Fit) -> tuple[str, ...]:
    return (
        count(fit.history[-1].evaluations),
        f"{fit.history[-1].paper_error:.4f}",
        f"{fit.max_distance:.3f}",
        f"{fit.hausdorff_distance:.3f}",
    )


def units(rows: Sequence[UnitRow]) -> str:
    """Errors relative to the box diagonal, in several units."""
    header = ("box diagonal", "literal: start", "final", "sensible: start", "final")
    return table(
        header,
        [(f"{row.diagonal:.6g}", *(f"{100 * value:.2f} %" for value in row[1:])) for row in rows],
    )


def parameters(rows: dict[str, Parameters]) -> str:
    """Start errors of the literal control points with several parameters."""
    header = (
        "outline",
        "uniform (as published)",
        "centripetal",
        "chord length",
        "Greville-matched",
    )
    return table(header, [(name, *(f"{error:.3f}" for error in row)) for name, row in rows.items()])


def growth(rows: Sequence[Growth]) -> str:
    """Time of an iteration and an evaluation."""
    header = ("points n", "an iteration", "an evaluation", "per point and evaluation")
    return table(
        header,
        [
            (
                count(row.n_points),
                seconds(row.per_iteration),
                seconds(row.per_evaluation),
                f"{1e9 * row.per_evaluation / row.n_points:.0f} ns",
            )
            for row in rows
        ],
    )
