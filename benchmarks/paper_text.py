"""The words of docs/paper.md: every sentence with a figure is made from what was measured."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING

from benchmarks import paper_tables as tables
from benchmarks.paper_claims import HEADER, claims, span, tenth
from benchmarks.paper_runs import STRICTER
from benchmarks.paper_tables import count
from shapespline.paper.run import LITERAL_LIMITS, SENSIBLE_LIMITS, SENSIBLE_STRAY_WEIGHT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from benchmarks.paper_runs import GoingOn, Growth, OutlineRuns, Parameters, Shaken, UnitRow
    from shapespline.paper.run import PaperRun

FOLDER = "figures/paper"
DOI = "10.1140/epjp/s13360-022-02604-y"
READINGS = (
    ("H", "unsigned sums", "signed sums, then the absolute value"),
    ("moving average", "3 points", "grows with L and with the noise"),
    ("local maxima", "every one", "above 2 % of the largest, noise and rounding"),
    ("runs without a maximum", "no control point", "gaps wider than half the mean gap are halved"),
    (
        "offset from the data",
        "(max H) H_r N_r, a squared length",
        "(p + 1)/24 of the second difference of the dominant points, degree p",
    ),
    (
        "location parameters",
        "uniform, j / n_1",
        "at a dominant point the Greville abscissa of its control point, linear between",
    ),
    ("closed data", "clamped knots, P_0 = Q_0 and P_m = Q_n", "periodic knots, no seam"),
    (
        "between the data",
        "nothing holds the curve",
        "residuals on the curve where neighbours' parameters drift apart, weight"
        f" {SENSIBLE_STRAY_WEIGHT:g}",
    ),
    ("D-BFGS", "inverse form, secant (Algorithm 1)", "direct form (Eq. 10), secant"),
    ("start matrix", "identity", "diagonal of the Gauss-Newton matrix"),
    ("line search", "weak Wolfe conditions (Eq. 6)", "strong Wolfe conditions, 1e-4 and 0.9"),
    (
        "end",
        "three falls of the cost in a row below"
        f" {LITERAL_LIMITS.relative_decrease:.0e} of it, or"
        f" {count(LITERAL_LIMITS.max_evaluations)} evaluations",
        f"three below {SENSIBLE_LIMITS.relative_decrease:.0e}, or"
        f" {count(SENSIBLE_LIMITS.max_evaluations)} evaluations",
    ),
)


@dataclass(frozen=True)
class Findings:
    """Everything that the document is made from."""

    runs: list[OutlineRuns]
    first: dict[str, PaperRun]
    units: list[UnitRow]
    unit_length: int
    parameters: dict[str, Parameters]
    rounding: dict[str, Shaken]
    pixels: dict[int, tuple[int, int]]
    pixel_length: int
    going_on: dict[str, list[GoingOn]]
    growth: list[Growth]


def document(found: Findings) -> str:
    """The whole page."""
    blocks = [
        *_head(found.runs),
        *_reading(),
        *_claims(found),
        *_steps(found),
        *_lengths(found.runs),
        *_examples(found.runs),
        *_methods(found.runs),
        *_why_the_start(found),
        *_why_the_end(found),
    ]
    return "\n\n".join(blocks) + "\n"


def paragraph(*sentences: str) -> str:
    """Sentences as lines of at most 100 characters."""
    text = " ".join(sentences)
    return textwrap.fill(text, width=100, break_long_words=False, break_on_hyphens=False)


def pair(*pictures: tuple[str, str]) -> str:
    """Pictures side by side, each by its name and caption."""
    captions = " | ".join(caption for _, caption in pictures)
    images = " | ".join(image(name, caption) for name, caption in pictures)
    return f"| {captions} |\n|{'---|' * len(pictures)}\n| {images} |"


def image(name: str, caption: str) -> str:
    """A figure of this page."""
    return f"![{caption}]({FOLDER}/{name}.png)"


def _head(runs: Sequence[OutlineRuns]) -> list[str]:
    outlines = ", ".join(f"{run.outline.name} ({len(run.contour)} points)" for run in runs)
    return [
        "# The published method, run",
        paragraph(
            "*Reconstruction of the initial curve from a two-dimensional shape for the B-spline"
            " curve fitting*, Eur. Phys. J. Plus 2022,",
            f"[doi:{DOI}](https://doi.org/{DOI}), goes from an outline to a B-spline curve in two"
            " steps. The first needs no solve: the chord-to-point distance accumulation H (CPDA)"
            " is taken at every point, and each of its local maxima gives one control point, moved"
            " off the outline along the normal. The second moves control points and location"
            " parameters together, by a quasi-Newton method with a diagonal matrix (D-BFGS).",
        ),
        paragraph(
            "This page runs both, twice. **Literal** takes the paper at its word wherever it is"
            " clear, and at the most obvious word where it is not. **Sensible** is the same method"
            " with every open or contradictory point settled so that it works. `make paper` writes"
            " this page anew, the sentences with figures included; all but the times is the same"
            " from run to run.",
        ),
        paragraph(
            "The paper publishes neither its data nor the unit of its errors, no numbers of"
            " iterations and no stopping rule, so its tables can be reproduced in kind only. The"
            " outlines here are others of the same names and numbers of points, scaled to a"
            f" bounding box diagonal of 10: {outlines};"
            " [where they come from](../examples/data/README.md). To run it on your own:",
        ),
        "    shapespline paper INPUT --length 3 -o FOLDER\n"
        "    shapespline paper INPUT --length 3 --literal -o FOLDER",
    ]


def _reading() -> list[str]:
    return [
        "## How it was read",
        tables.table(("open point", "literal", "sensible"), READINGS, n_words=3),
        paragraph(
            "Both are values: `LITERAL` and `SENSIBLE` in"
            " [reading.py](../src/shapespline/paper/reading.py), the rest in"
            " [run.py](../src/shapespline/paper/run.py). E is the paper's"
            " error, the root of the sum of squared residuals over n - 1 for n points, taken at"
            " the location parameters. Those are no foot parameters, and they say nothing of the"
            " curve between the data; so beside E stand the distances of the data from the curve,"
            " rms and maximum, and the two-sided distance: a bound that no data point and no point"
            " of the curve exceeds.",
        ),
    ]


def _claims(found: Findings) -> list[str]:
    default, counted = tenth(found.runs)
    return [
        "## Which claims hold",
        tables.table(HEADER, claims(found.runs, found.growth), n_words=3),
        paragraph(
            "And one claim of this project: *from the sensible start, direct D-BFGS reaches the"
            " error that the literal reading ends at in less than a tenth of its evaluations.* The"
            " literal run is Algorithm 1 as published from the literal start, until it stops or"
            " has had its budget; of it only the evaluations count until it is within 1 % of the"
            f" error it ends at. The claim **{default}**. With as many control points as the"
            " literal start has, or as many as there are maxima if they are more, it"
            f" **{counted}**. One evaluation means that the start itself is better than the"
            " literal end.",
        ),
        tables.tenth(found.runs),
    ]


def _steps(found: Findings) -> list[str]:
    literal, sensible = found.first["literal"], found.first["sensible"]
    n_literal, n_sensible = len(literal.start.cpda.maxima), len(sensible.start.cpda.maxima)

    def both(figure: str, caption: str) -> str:
        return pair(*((f"{figure}-{reading}", f"{caption}, {reading}") for reading in found.first))

    return [
        f"## Figures 1 and 3: the steps, L = {sensible.length}",
        image("figure1a-points", "The data"),
        both("figure1b-cpda", "H and its maxima"),
        both("figure1c-frames", "Tangents and normals"),
        both("figure1d-initial", "The initial curve"),
        paragraph(
            f"{n_literal} local maxima literally, {n_sensible} prominent ones; with the wide gaps"
            f" halved {sensible.start.n_control_points} control points. The literal error goes from"
            f" {literal.start_error:.3f} to {literal.final_error:.3f}, the sensible one from"
            f" {sensible.start_error:.3f} to {sensible.final_error:.3f}:",
        ),
        both("figure3-final", "The final curve"),
    ]


def _lengths(runs: Sequence[OutlineRuns]) -> list[str]:
    return [
        "## Figure 2 and Table 1: the length L",
        image("figure2-lengths-literal", "Initial curves for L = 5, 4, 3, 2, literal"),
        image("figure2-lengths-sensible", "Initial curves for L = 5, 4, 3, 2, sensible"),
        tables.lengths(runs),
        paragraph(
            "The times are for the initial curve alone, the median of several runs. The sensible"
            " points are the maxima and those that halve the wide gaps between them; for these the"
            " curve is built twice.",
        ),
    ]


def _examples(runs: Sequence[OutlineRuns]) -> list[str]:
    blocks = ["## Figures 4 to 6 and Table 2: three outlines"]
    for run in runs:
        figure, literal, shown = f"figure{run.outline.figure}", run.literal, run.shown
        blocks += [
            f"### Figure {run.outline.figure}: the {run.outline.name}, L = {run.outline.length}",
            *(
                pair(
                    (f"{figure}a-initial-{reading}", f"initial, {reading}"),
                    (f"{figure}b-final-{reading}", f"final, {reading}"),
                )
                for reading in ("literal", "sensible")
            ),
            paragraph(
                f"Literally {literal.fit.n_control_points} control points and E from"
                f" {literal.start_error:.3f} to {literal.final_error:.3f} in"
                f" {count(literal.fit.history[-1].evaluations)} evaluations. Sensibly, with the"
                f" published number of {run.outline.ours.n_control_points} or its own if that is"
                f" larger, {shown.fit.n_control_points} and E from {shown.start_error:.3f} to"
                f" {shown.final_error:.4f} in {count(shown.fit.history[-1].evaluations)}. From the"
                " same start Levenberg-Marquardt, held in the same way, and the convergence"
                " of all three:",
            ),
            pair((f"{figure}c-held", "Levenberg-Marquardt"), (f"{figure}d-convergence", "E")),
        ]
    inserted = ", ".join(
        str(start.n_inserted) for run in runs for start, _, _ in run.predecessors.values()
    )
    blocks += [
        "### Table 2",
        tables.examples(runs),
        paragraph(
            "Published errors belong to other outlines and an unknown unit. The final errors of the"
            " sensible runs count the residuals that hold the curve. Of the predecessor"
            " [47] (Ebrahimi and Loghmani 2018) nothing is used but what the paper says of it. The"
            " rows named so are a **stand-in**, defined in"
            " [predecessor.py](../benchmarks/predecessor.py): control points on the dominant"
            " points, more of them where the initial curve is worst until its start error is no"
            " larger than ours or they are twice as many, then BFGS with the full matrix from the"
            " Gauss-Newton diagonal. They compare ideas, not the two papers. Inserted, in the order"
            f" of the table: {inserted}.",
        ),
    ]
    return blocks


def _methods(runs: Sequence[OutlineRuns]) -> list[str]:
    blocks = [
        "## Every method from the same start",
        paragraph(
            "Iterations / evaluations / time to the error that the literal run ends at, and to"
            f" {STRICTER:g} of it. All rows but the first start from the Gauss-Newton diagonal and"
            ' search by strong Wolfe conditions. "Not reached" tells where the run stood when'
            " three falls in a row were below 1e-6 or its evaluations ran out; with few control"
            " points an error may be out of any method's reach.",
        ),
    ]
    for run in runs:
        literal, sensible, target = run.literal, run.sensible, run.literal.final_error
        blocks += [
            paragraph(
                f"**The {run.outline.name}**, to E = {target:.4f} and {STRICTER * target:.4f}. The"
                f" literal start has {literal.start.n_control_points} control points and E ="
                f" {literal.start_error:.3f}, the sensible one {sensible.start.n_control_points}"
                f" and {sensible.start_error:.3f}.",
            ),
            tables.methods(run),
        ]

    def cost(name: str) -> str:
        last = [run.methods[True][name].last for run in runs]
        return span([record.evaluations / record.iteration for record in last], "{:.1f}")

    published = [run.literal.fit.history[-1] for run in runs]
    published_cost = span([record.evaluations / record.iteration for record in published], "{:.1f}")
    return [
        *blocks,
        paragraph(
            f"From the literal start an iteration costs the direct form {cost('d-bfgs')}"
            f" evaluations, the inverse form {cost('d-bfgs-inverse')}, and the inverse form from"
            f" the identity, as published, {published_cost}. The diagonal of an inverse is never"
            " smaller than the inverse of the diagonal: the steps of the inverse form are longer,"
            " and the line search has to take them back. The identity, besides, knows nothing of"
            " the scales of control points and parameters, which are far apart.",
        ),
    ]


def _why_the_start(found: Findings) -> list[str]:
    ratios = [row.uniform / row.greville for row in found.parameters.values()]
    published = [run.outline.ours for run in found.runs]
    falls = span([row.start_error / row.final_error for row in published], "{:.0f}")
    first, last = found.units[0], found.units[-1]
    stuck = ", in the last unit nowhere" if last.literal_final > 0.9 * last.literal_start else ""
    same = len({f"{row.sensible_final:.9g}" for row in found.units}) == 1
    counts = "; ".join(
        f"{name} {span(of.literal_counts, '{}')} literally, {span(of.sensible_counts, '{}')}"
        " sensibly"
        for name, of in found.rounding.items()
    )
    pixels = "; ".join(
        f"{n} pixels across, {count(literal)} and {sensible}"
        for n, (literal, sensible) in found.pixels.items()
    )
    return [
        "## Why: the start",
        paragraph(
            "**Uniform parameters contradict uneven control points.** On uniform knots control"
            " points act at evenly spaced parameters; taken at the maxima of H they lie unevenly"
            " along the outline. So a curve that looks near to the eye has its parameters"
            " elsewhere, and E is large: published start errors are"
            f" {falls} times the final ones. The same literal control points with parameters that"
            f" match them have a start error {span(ratios, '{:.1f}')} times smaller. Centripetal"
            " and chord length parameters change little where the data are evenly spaced.",
        ),
        tables.parameters(found.parameters),
        paragraph(
            "**The offset is a squared length.** (max H) H_r N_r changes with the unit of the"
            f" drawing. The leaf at L = {found.unit_length} in several units, errors in parts of"
            f" the box diagonal: the literal start error goes from {100 * first.literal_start:.1f}"
            f" to {100 * last.literal_start:.1f} %. The identity as start matrix depends on the"
            f" unit too, so the run also goes another way{stuck}. The sensible start is the same in"
            f" every unit, and its run {'too' if same else 'is not'}:",
        ),
        tables.units(found.units),
        paragraph(
            "**Every local maximum counts.** Without a least prominence, rounding and noise make"
            " control points. With the coordinates changed in the tenth digit, their numbers are:"
            f" {counts}. On the chain of pixels of the leaf, L = {found.pixel_length}, literally"
            f" and sensibly (before gaps are halved): {pixels}.",
        ),
    ]


def _why_the_end(found: Findings) -> list[str]:
    errors = "; ".join(
        f"{name} {span(of.sensible_errors, '{:.4f}')}" for name, of in found.rounding.items()
    )
    return [
        "## Why: the end",
        paragraph(
            "**Nothing holds the curve between the data.** Only distances of the data from the"
            " curve are minimised. Late in a run a span that has lost its foot points is free to"
            " fly, and what E still gains is paid for with loops. The sensible run holds the curve"
            " by residuals of its own: where the parameters of neighbouring points are more than an"
            " eighth of a knot span apart, the curve between them is compared with the segment"
            " between the points. What going on brings, from the sensible starts of Figures 4 to 6,"
            " without these residuals and with them:",
        ),
        tables.going_on(found.going_on),
        paragraph(
            "**Rounding grows on the way.** Early steps of D-BFGS are large where the start curve"
            " almost stands still, and amplify what is in the last digits. Final errors of the"
            f" sensible run with the coordinates changed in the tenth digit: {errors}. The same"
            " input still gives the same curve, bit for bit.",
        ),
        paragraph("**O(n).** Direct D-BFGS on the leaf, sampled ever more densely:"),
        tables.growth(found.growth),
    ]
