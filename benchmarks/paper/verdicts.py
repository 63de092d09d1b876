"""The paper's claims beside what was measured; every figure is that of the run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from benchmarks.paper.start_claim import better
from benchmarks.paper.tables import Table, count, percent

if TYPE_CHECKING:
    from benchmarks.paper.literal import Shown, Unit
    from benchmarks.paper.optimisers import Cost, Growth
    from benchmarks.paper.start_claim import Compared

PAPERS = "the paper's: maxima of H, offset"
FILLED = "maxima of H, gaps filled by curvature"
# "Near" and "closely" are words of the paper; this is ours for them, of the box diagonal.
NEAR = 0.01


def verdicts(
    shown: list[Shown],
    units: list[Unit],
    published: Compared,
    sensible: Compared,
    family: list[Cost],
    growth: list[Growth],
) -> Table:
    """Claim, measurement, verdict."""
    rows = [
        (
            "The start helps: fewer iterations, smaller errors (main claim).",
            *_start(published, sensible),
        ),
        (
            "Magnitudes of Table 2.",
            *_magnitudes(shown),
        ),
        ("The initial curve is extremely near to the data.", *_near(units, "start")),
        ("The final curve closely matches the shape.", *_near(units, "two_sided")),
        ("Fewer points and smaller errors than the predecessor [47].", *_PREDECESSOR),
        ("One-step secant converges extremely slowly.", *_against(family, "oss")),
        ("L-BFGS does not suit such problems.", *_against(family, "l-bfgs")),
        (
            "The inverse form of Algorithm 1 is the D-BFGS of Eq. 10.",
            *_against(family, "d-bfgs"),
        ),
        ("A step costs O(n).", *_linear(growth)),
    ]
    return Table("verdicts", ("claim of the paper", "measured", "verdict"), rows, words=3)


_PREDECESSOR = (
    "of [47] no data, constants or stopping rule are published",
    "cannot be judged here",
)


def _start(published: Compared, sensible: Compared) -> tuple[str, str]:
    mean, _, wins, of = better(published, "d-bfgs-inverse", PAPERS, "rms")
    start_mean, *_ = better(published, "d-bfgs-inverse", PAPERS, "start")
    ours, _, our_wins, our_of = better(sensible, "levenberg-marquardt", FILLED, "rms")
    told = (
        f"in the paper's own setting its start has {start_mean:.2g} times the E_0 and ends with"
        f" {mean:.2g} times the rms of every (n/m)-th point (better on {wins} of {of} outlines)."
        f" Maxima with gaps filled by the curvature that H measures, periodic knots, matched"
        f" parameters: {ours:.2g} times the rms of equal arc length (better on {our_wins} of"
        f" {our_of})"
    )
    first, second = ("holds" if ratio < 1.0 else "does not hold" for ratio in (mean, ours))
    return told, f"{first} as published; {second} for H as a measure of curvature"


def _magnitudes(shown: list[Shown]) -> tuple[str, str]:
    ratios = [run.counted.start_error / run.example.published.start_error for run in shown]
    told = "; ".join(
        f"{run.example.name} E_0 {run.counted.start_error:.3f}"
        f" ({run.example.published.start_error:.3f}), E {run.counted.final_error:.4f}"
        f" ({run.example.published.final_error:.4f})"
        for run in shown
    )
    worst = max(max(ratio, 1 / ratio) for ratio in ratios)
    return (
        f"at the published numbers of control points, diagonal 10, published in brackets: {told}",
        f"E_0 within a factor of {worst:.2g} on other outlines: no contradiction",
    )


def _near(units: list[Unit], of: str) -> tuple[str, str]:
    values = [getattr(unit, of) for unit in units]
    within = sum(value < NEAR for value in values)
    told = (
        f"{'E_0' if of == 'start' else 'two-sided distance'} over outlines, units and counts:"
        f" {percent(min(values))} to {percent(max(values))} of the diagonal"
    )
    told += f", below 1 % in {within} of {len(values)}"
    return told, "depends on the unit and the count; 1 % is our word for the paper's"


def _against(family: list[Cost], name: str) -> tuple[str, str]:
    """A method beside Algorithm 1, both from the identity with weak Wolfe conditions."""
    told, quicker = [], []
    for outline in dict.fromkeys(cost.outline for cost in family):
        by = {cost.method: cost for cost in family if cost.outline == outline}
        mine, theirs = by[name], by["d-bfgs-inverse"]
        cells = [
            f"not in {count(cost.last.evaluations)}"
            if cost.arrived is None
            else count(cost.arrived.evaluations)
            for cost in (mine, theirs)
        ]
        told.append(f"{outline} {cells[0]} against {cells[1]}")
        spent = [
            float("inf") if cost.arrived is None else cost.arrived.evaluations
            for cost in (mine, theirs)
        ]
        quicker.append(spent[0] < spent[1])
    text = (
        f"`{name}` against Algorithm 1, both from the identity, evaluations to 1.25 of the best"
        f" error any reaches: {'; '.join(told)}"
    )
    if name == "d-bfgs":
        return text, "two methods"
    wins = sum(quicker)
    return text, f"`{name}` is quicker on {wins} of {len(quicker)}: " + (
        "holds" if wins == 0 else "does not hold" if wins == len(quicker) else "mixed"
    )


def _linear(growth: list[Growth]) -> tuple[str, str]:
    small, large = growth[0], growth[-1]
    more, longer = large.n_points / small.n_points, large.per_iteration / small.per_iteration
    told = f"{more:.0f} times the points, {longer:.0f} times the time of an iteration"
    return told, "holds" if longer < 2 * more else "does not hold"
