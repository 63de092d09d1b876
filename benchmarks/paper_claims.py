"""The claims of the published paper beside what was measured, as rows of words.

Each function returns what was measured and a verdict; both are made from the figures of the run.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from benchmarks.paper_runs import LENGTHS
from benchmarks.paper_tables import count, seconds

if TYPE_CHECKING:
    from collections.abc import Sequence

    from benchmarks.paper_runs import Growth, OutlineRuns

# "Near" and "closely", in parts of the box diagonal.
NEAR = 0.01
# Times of less than a millisecond differ by more than they mean.
CLEARLY = 1.25
HEADER = ("claim of the paper", "measured", "verdict")


def claims(runs: Sequence[OutlineRuns], growth: Sequence[Growth]) -> list[tuple[str, str, str]]:
    """Rows of claim, measurement and verdict."""
    return [
        ("A shorter L gives more control points.", *_more_points(runs)),
        ("A shorter L gives a more precise initial curve.", *_more_precise(runs)),
        ("A shorter L takes less time.", *_less_time(runs)),
        ("The initial curve is extremely near to the data.", *_near(runs)),
        ("The final curve closely matches the shape.", *_matches(runs)),
        (
            "Fewer control points and smaller errors than the predecessor.",
            *_predecessor(runs),
        ),
        ("The predecessor takes longer for the initial curve.", *_longer(runs)),
        ("A step of D-BFGS costs O(n).", *_linear(growth)),
        ("One-step secant converges far more slowly than D-BFGS.", *_against(runs, "oss", 1.5)),
        ("L-BFGS does not suit such problems.", *_against(runs, "l-bfgs", 1.0)),
        (
            "The inverse form of Algorithm 1 is the D-BFGS of Eq. 10.",
            *_against(runs, "d-bfgs-inverse"),
        ),
    ]


def verdict(flags: dict[str, bool]) -> str:
    """Holds, holds in part, does not hold."""
    so = [name for name, flag in flags.items() if flag]
    if len(so) == len(flags):
        return "holds"
    return f"holds on the {' and the '.join(so)} only" if so else "does not hold"


def span(values: Sequence[float], form: str) -> str:
    """``a to b``, or one value if both look the same."""
    low, high = form.format(min(values)), form.format(max(values))
    return low if low == high else f"{low} to {high}"


def times(values: Sequence[float]) -> str:
    """``a to b`` of seconds."""
    low, high = seconds(min(values)), seconds(max(values))
    return low if low == high else f"{low} to {high}"


def _percent(values: Sequence[float]) -> str:
    return span([100 * value for value in values], "{:.1f}") + " %"


def _more_points(runs: Sequence[OutlineRuns]) -> tuple[str, str]:
    counts = {
        run.outline.name: [run.lengths[chord, True].start.n_control_points for chord in LENGTHS]
        for run in runs
    }
    flags = {
        name: all(after >= before for before, after in pairwise(of)) and of[-1] > of[0]
        for name, of in counts.items()
    }
    told = "; ".join(f"{name} {', '.join(map(str, of))}" for name, of in counts.items())
    return f"literal, L = 5, 4, 3, 2: {told}", verdict(flags)


def _more_precise(runs: Sequence[OutlineRuns]) -> tuple[str, str]:
    errors = {
        run.outline.name: [run.lengths[chord, True].error for chord in LENGTHS] for run in runs
    }
    flags = {
        name: all(after < before for before, after in pairwise(of)) for name, of in errors.items()
    }
    told = "; ".join(
        f"{name} {', '.join(f'{error:.2f}' for error in of)}" for name, of in errors.items()
    )
    return f"literal start error, L = 5, 4, 3, 2: {told}", verdict(flags)


def _less_time(runs: Sequence[OutlineRuns]) -> tuple[str, str]:
    every = [run.lengths[chord, True].seconds for run in runs for chord in LENGTHS]
    told = (
        f"literal, every L and outline: {times(every)}. H sums L - 1 distances a point, but that"
        " is not what takes the time (published: 0.2604 s for L = 5, 0.2535 s for L = 2)"
    )
    return told, "true of the sums, without consequence"


def _near(runs: Sequence[OutlineRuns]) -> tuple[str, str]:
    parts = {}
    for literal in (True, False):
        starts = [run.literal if literal else run.sensible for run in runs]
        parts[literal] = (
            _percent([one.start_error / one.contour.box_diagonal for one in starts]),
            _percent(
                [
                    run.start_distances[literal].hausdorff_distance / run.contour.box_diagonal
                    for run in runs
                ]
            ),
        )
    flags = {
        run.outline.name: run.start_distances[True].hausdorff_distance
        < NEAR * run.contour.box_diagonal
        for run in runs
    }
    told = (
        f"in parts of the box diagonal: E_0 literal {parts[True][0]}, sensible {parts[False][0]};"
        f" two-sided distance literal {parts[True][1]}, sensible {parts[False][1]}"
    )
    return told, verdict(flags) + " literally (within 1 %, two-sided)"


def _matches(runs: Sequence[OutlineRuns]) -> tuple[str, str]:
    literal = [run.literal.fit.hausdorff_distance / run.contour.box_diagonal for run in runs]
    sensible = [run.shown.fit.hausdorff_distance / run.contour.box_diagonal for run in runs]
    flags = {run.outline.name: part < NEAR for run, part in zip(runs, literal, strict=True)}
    told = (
        f"two-sided distance in parts of the box diagonal: literal {_percent(literal)}, sensible"
        f" {_percent(sensible)}"
    )
    return told, verdict(flags) + " literally (within 1 %, two-sided)"


def _predecessor(runs: Sequence[OutlineRuns]) -> tuple[str, str]:
    told, flags = [], {}
    for run in runs:
        _, fit, _ = run.predecessors[True]
        ours = run.literal
        told.append(
            f"{run.outline.name} {ours.fit.n_control_points} points, E {ours.final_error:.3f}"
            f" against {fit.n_control_points}, {fit.history[-1].paper_error:.3f}"
        )
        flags[run.outline.name] = (
            ours.fit.n_control_points < fit.n_control_points
            and ours.final_error < fit.history[-1].paper_error
        )
    return f"literal against the stand-in: {'; '.join(told)}", verdict(flags) + " (stand-in)"


def _longer(runs: Sequence[OutlineRuns]) -> tuple[str, str]:
    ours = [run.literal.start_seconds for run in runs]
    theirs = [run.predecessors[True][2] for run in runs]
    flags = {r.outline.name: t > CLEARLY * o for r, o, t in zip(runs, ours, theirs, strict=True)}
    told = f"literal {times(ours)}, stand-in {times(theirs)}; either is a small part of a run"
    return told, verdict(flags) + " (stand-in, by a quarter at least)"


def _linear(growth: Sequence[Growth]) -> tuple[str, str]:
    small, large = growth[0], growth[-1]
    more, longer = large.n_points / small.n_points, large.per_iteration / small.per_iteration
    told = (
        f"from {count(small.n_points)} to {count(large.n_points)} points, {more:.0f} times as"
        f" many, an iteration takes {longer:.0f} times as long"
    )
    return told, "holds" if longer < 2 * more else "does not hold"


def _against(
    runs: Sequence[OutlineRuns], name: str, factor: float | None = None
) -> tuple[str, str]:
    """A method beside direct D-BFGS from the literal start, to the literal run's end error.

    The verdict is on needing more than ``factor`` times the evaluations; without one on being the
    same method, which the same evaluations would show.
    """
    told, flags = [], {}
    for run in runs:
        met = [run.methods[True][method].reached[0] for method in (name, "d-bfgs")]
        cells = ["not reached" if one is None else count(one.evaluations) for one in met]
        told.append(f"{run.outline.name} {cells[0]} against {cells[1]}")
        here, direct = (float("inf") if one is None else one.evaluations for one in met)
        flags[run.outline.name] = here == direct if factor is None else here > factor * direct
    text = (
        "evaluations from the literal start to the error that the literal run ends at,"
        f" `{name}` against `d-bfgs`: {'; '.join(told)}"
    )
    return text, verdict(flags)


def tenth(runs: Sequence[OutlineRuns]) -> tuple[str, str]:
    """Verdicts on the tenth of the evaluations: by default, and with as many control points."""
    default, counted = {}, {}
    for run in runs:
        allowed = 0.1 * run.literal_near_end.evaluations
        for flags, met in ((default, run.direct), (counted, run.at_literal_count.reached[0])):
            flags[run.outline.name] = met is not None and met.evaluations < allowed
    return verdict(default), verdict(counted)
