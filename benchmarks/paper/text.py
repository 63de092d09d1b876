"""The words of docs/paper.md and of docs/paper-in-short.md, made from what was measured."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from benchmarks.paper.start_claim import better
from benchmarks.paper.tables import Table
from benchmarks.paper.verdicts import FILLED, PAPERS
from shapespline import LITERAL, SENSIBLE, Reading

if TYPE_CHECKING:
    from benchmarks.paper.literal import Shown
    from benchmarks.paper.optimisers import Cost
    from benchmarks.paper.start_claim import Compared

DOI = "10.1140/epjp/s13360-022-02604-y"


@dataclass(frozen=True)
class Findings:
    """Everything that the pages are made from."""

    shown: list[Shown]
    published: Compared
    sensible: Compared
    costs: list[Cost]
    tables: dict[str, Table]


def paragraph(*sentences: str) -> str:
    """Sentences as lines of at most 100 characters."""
    text = " ".join(sentences)
    return textwrap.fill(text, width=100, break_long_words=False, break_on_hyphens=False)


def image(name: str, caption: str) -> str:
    """A figure of this page."""
    return f"![{caption}](figures/paper/{name}.svg)"


def pair(*pictures: tuple[str, str]) -> str:
    """Pictures side by side, each by its name and caption."""
    captions = " | ".join(caption for _, caption in pictures)
    images = " | ".join(image(name, caption) for name, caption in pictures)
    return f"| {captions} |\n|{'---|' * len(pictures)}\n| {images} |"


def readings_table() -> Table:
    """The two readings, field by field."""
    rows = [
        (
            f"`{field.name}`",
            *(f"`{getattr(reading, field.name)}`" for reading in (LITERAL, SENSIBLE)),
        )
        for field in fields(Reading)
    ]
    return Table("readings", ("field", "LITERAL", "SENSIBLE"), rows, words=3)


def page(found: Findings) -> str:
    """docs/paper.md."""
    tables = found.tables
    blocks = [
        *_head(found),
        "## Four questions",
        *_questions(found),
        "## How it was read",
        tables["readings"].markdown(),
        paragraph(
            "Every row is a field of `Reading`, and can be set: `shapespline paper INPUT"
            " --reading window=7 -o FOLDER`. An initial curve carries its reading, so"
            " `initial_curve`, `optimize`, `run_paper` and the command give the same curve, to the"
            " bit. LITERAL smooths over five points, the span of MATLAB's moving average unless"
            " told otherwise (the paper used MATLAB), and its last point Q_n repeats Q_0 on closed"
            " data. E is the paper's error, the root of the sum of squared residuals over n - 1"
            " for n points at the location parameters; rms and two-sided distance are geometric,"
            " the latter a bound that no data point and no point of the curve exceeds.",
        ),
        "## Which claims hold",
        tables["verdicts"].markdown(),
        "## The main claim: does the start help?",
        image("does-the-start-help", "Error at the end by start"),
        paragraph(
            "Sixteen closed outlines, every start with the number of control points that the"
            " reading itself takes, geometric means relative to the start in grey and the factor"
            " that two thirds of the outlines lie within; small dots are the outlines. Left: the"
            " paper's own setting (clamped uniform knots, uniform parameters, identity, weak"
            " Wolfe). Right: periodic knots, matched parameters, held on the data.",
        ),
        tables["starts-published"].markdown(),
        tables["starts-sensible"].markdown(),
        paragraph(
            "Every run behind the means: [published](figures/paper/starts-published-runs.csv)"
            ", [sensible](figures/paper/starts-sensible-runs.csv)."
        ),
        *_examples(found),
        "## The unit and the number decide",
        paragraph(
            "H_0 = I knows no unit, and (max H) H_r N_r is a squared length: the same outline in"
            " another unit gives another curve. `published number` is literal in everything but"
            " the number of control points: prominent maxima, gaps halved to what the paper"
            " reports. The sensible reading gives the same curve in every unit (a test holds it).",
        ),
        tables["units"].markdown(),
        "## Which optimiser",
        paragraph(
            "From the filled start, held on the data: iterations / evaluations / time until within"
            " a factor of two of the best error that any method reaches on the same knots."
            " `insertion-removal` and `differential-evolution` move the knots, too.",
        ),
        tables["optimisers"].markdown(),
        paragraph(
            "From the literal start, as published: identity and weak Wolfe conditions for every"
            " method of the family.",
        ),
        tables["optimisers-published"].markdown(),
        tables["growth"].markdown(),
        "## Open, semi-closed, self-intersecting data, several outlines",
        tables["kinds"].markdown(),
        "## Does smoothing reduce noise?",
        paragraph(
            "It leaves fewer maxima, but with every maximum a control point the number still"
            " follows the noise, whatever the window; what tells maxima from noise is their"
            " prominence. More control points lie nearer to the data at first: E_0 to the clean"
            " outline falls with noise for that reason alone. L = 4, means of three outlines and"
            " five draws.",
        ),
        tables["smoothing"].markdown(),
    ]
    return "\n\n".join(blocks) + "\n"


def _head(found: Findings) -> list[str]:
    return [
        "# The published method, run and judged",
        paragraph(
            "*Reconstruction of the initial curve from a two-dimensional shape for the B-spline"
            " curve fitting*, Eur. Phys. J. Plus 2022,",
            f"[doi:{DOI}](https://doi.org/{DOI}): an initial curve from the maxima of the"
            " chord-to-point distance accumulation H (CPDA), then control points and parameters"
            " together by a quasi-Newton method with a diagonal matrix (D-BFGS). Its data, unit,"
            " iterations and stopping rule are not published; the outlines here are others of the"
            " same names and sizes, box diagonal 10. **As published** (`LITERAL`) means its"
            " constants throughout: start matrix identity, weak Wolfe conditions. **Sensible** is"
            " the same method with every open point settled so that it works. `make paper` writes"
            " this page, [the short one](paper-in-short.md), every table as CSV and every figure"
            " as SVG; all but the times is the same from run to run.",
        ),
    ]


def _questions(found: Findings) -> list[str]:
    mean, factor, wins, of = better(found.published, "d-bfgs-inverse", PAPERS, "rms")
    ours, our_factor, our_wins, _ = better(found.sensible, "levenberg-marquardt", FILLED, "rms")
    quick = quickest(found.costs)
    return [
        paragraph(
            f"**Does the start help?** As published {says(mean)}: it ends with"
            f" {mean:.2g} (×÷ {factor:.2g}) times the rms of every (n/m)-th data point, better on"
            f" {wins} of {of} outlines. With the gaps between maxima filled by curvature"
            f" {says(ours)}:"
            f" {ours:.2g} (×÷ {our_factor:.2g}) of equal arc length, better on {our_wins} of {of}.",
        ),
        "    shapespline paper INPUT --reading start=arc-length -o even\n"
        "    shapespline paper INPUT -o filled",
        paragraph(
            f"**Which optimiser should I use?** `{quick}`: from the filled start it is the first"
            " within a factor of two of the best error, summed over the three outlines.",
        ),
        f"    shapespline paper INPUT --method {quick} -o FOLDER",
        paragraph(
            "**What does it cost?** The start about a millisecond for 840 points, an iteration"
            " of D-BFGS O(n); `convergence.csv` and `table.csv` of a run have iterations,"
            " evaluations and seconds.",
        ),
        "    shapespline paper INPUT -o FOLDER    # FOLDER/table.csv, FOLDER/convergence.csv",
        paragraph(
            "**How sure is my curve?** The two-sided distance is certified for every point of the"
            " curve. With measured points, `optimize(contour, start, sigma=...)` gives"
            " `fit.covariance` and `fit.band(0.95)` ([uncertainties](uncertainties.md)).",
        ),
    ]


def says(ratio: float) -> str:
    """Whether a start with this ratio to the obvious one helps."""
    return "yes" if ratio < 1.0 else "no"


def quickest(costs: list[Cost]) -> str:
    """The method on fixed knots that arrives everywhere in the least time together."""
    outlines = {cost.outline for cost in costs}
    total: dict[str, list[float]] = {}
    for cost in costs:
        if cost.arrived is not None:
            total.setdefault(cost.method, []).append(cost.arrived.seconds)
    everywhere = {name: sum(of) for name, of in total.items() if len(of) == len(outlines)}
    most = max(len(of) for of in total.values())
    pool = everywhere or {name: sum(of) for name, of in total.items() if len(of) == most}
    return min(pool, key=lambda name: pool[name])


def _examples(found: Findings) -> list[str]:
    blocks = [
        "## Figures 1 and 2, Table 1: the steps and the length L",
        image("figure1a-points", "The data"),
        *(
            pair((f"{figure}-literal", f"{caption}, literal"), (f"{figure}-sensible", "sensible"))
            for figure, caption in (
                ("figure1b-cpda", "H and its maxima"),
                ("figure1c-frames", "Tangents and normals"),
                ("figure1d-initial", "The initial curve"),
                ("figure2-lengths", "L = 5, 4, 3, 2"),
            )
        ),
        found.tables["lengths"].markdown(),
        "## Figures 4 to 6, Table 2: three outlines",
    ]
    for shown in found.shown:
        number = shown.example.figure
        blocks += [
            f"**The {shown.example.name}**, {shown.example.published.n_control_points} control"
            " points as the paper has:",
            *(
                pair(
                    (f"figure{number}{part}-literal", f"{caption}, as published"),
                    (f"figure{number}{part}-sensible", f"{caption}, sensible"),
                )
                for part, caption in (("a-initial", "initial"), ("b-final", "final"))
            ),
            image(f"figure{number}c-convergence", "Convergence"),
        ]
    return [
        *blocks,
        found.tables["examples"].markdown(),
        paragraph("Published errors belong to other outlines and an unknown unit."),
    ]


def short(found: Findings) -> str:
    """docs/paper-in-short.md: what to take from the paper without reading it."""
    mean, _, wins, of = better(found.published, "d-bfgs-inverse", PAPERS, "rms")
    ours, *_ = better(found.sensible, "levenberg-marquardt", FILLED, "rms")
    two_sided, *_ = better(found.sensible, "levenberg-marquardt", FILLED, "two_sided")
    best, *_ = better(found.sensible, "levenberg-marquardt", "balanced (several fits)", "rms")
    quick = quickest(found.costs)
    lines = (
        ("fit = shapespline.fit_curve(points, n_control_points=40)", "points 1 to 7"),
        ("start = shapespline.initial_curve(contour, length=8)", "points 1 and 3"),
        (f'fit = shapespline.optimize(contour, start, "{quick}")', "points 4 to 6"),
        ("shapespline paper leaf.csv --literal -o as-published", "points 2 and 4, seen"),
    )
    return (
        "\n\n".join(
            [
                "# What to take from the paper",
                paragraph(
                    "One page for people who will never read it. The figures come from"
                    " [the long page](paper.md), which `make paper` writes.",
                ),
                "1. **Measure curvature by sums of distances to chords.** H is cheap and needs"
                " no derivatives.\n"
                f"   Its integral places control points: {1 - ours:.0%} less rms error and"
                f" {1 - two_sided:.0%} less two-sided error than even spacing, at the same"
                " number.\n"
                f"2. **Its maxima alone: {'a' if mean < 1 else 'not a'} good start.** As published"
                " they end with"
                f" {mean:.2g} times the error of taking every so many points ({of - wins} of {of}"
                " outlines worse).\n"
                "3. **Match the parameters to the control points** (Greville abscissae). Uniform"
                " parameters contradict uneven control points.\n"
                "4. **Scale the start matrix.** With the identity the result depends on whether you"
                " draw in millimetres or metres.\n"
                "5. **Hold the curve between the points.** Residuals of the data alone let it fly"
                " late in a run.\n"
                f"6. **Use `{quick}`.** D-BFGS is O(n) and works, but takes many more steps.\n"
                "7. **If you can afford several short fits, balance the knots by the error**:"
                f" {best:.2g} of the rms of even spacing.",
                "In one line each:",
                "\n".join(f"    {code:<66}# {why}" for code, why in lines),
            ]
        )
        + "\n"
    )
