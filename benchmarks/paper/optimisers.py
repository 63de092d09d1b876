"""Which optimiser: every method from the same start, and what it costs."""

from __future__ import annotations

from statistics import median
from typing import TYPE_CHECKING, NamedTuple

from benchmarks.paper.outlines import EXAMPLES, Example
from benchmarks.paper.tables import Table, count, seconds
from shapespline import LITERAL, SENSIBLE, Contour, Fit, Reading, initial_curve, optimize
from shapespline.engines.least_squares import METHODS
from shapespline.solvers import Limits

if TYPE_CHECKING:
    from shapespline.monitor import Iteration

# The full matrix costs a hundred times as much an evaluation as the others.
BUDGETS = {"bfgs": 400, "differential-evolution": 2000}
BUDGET = 6000
# A method has arrived within this factor of the best error that any reaches on the same knots.
NEAR, NEAR_PUBLISHED = 2.0, 1.25
# These move the knots, too: another problem, whose errors the others need not reach.
MOVING_KNOTS = ("insertion-removal", "differential-evolution")
AS_PUBLISHED = tuple(
    name
    for name in METHODS
    if name.split("-")[0] in ("d", "oss", "bfgs", "l") and name not in ("l-bfgs-feet",)
)


class Cost(NamedTuple):
    """How a method did on one outline."""

    outline: str
    method: str
    end: float
    two_sided: float
    last: Iteration
    arrived: Iteration | None


def run(example: Example, reading: Reading, methods: tuple[str, ...], factor: float) -> list[Cost]:
    """Every method from one start, and when each came within a factor of the best end."""
    contour = example.contour
    start = initial_curve(contour, example.length, reading=reading)
    fits = {method: _fit(contour, start, method) for method in methods}
    best = min(
        fit.history[-1].paper_error for name, fit in fits.items() if name not in MOVING_KNOTS
    )
    return [
        Cost(
            example.name,
            method,
            fit.history[-1].paper_error,
            fit.hausdorff_distance,
            fit.history[-1],
            next((r for r in fit.history if r.paper_error <= factor * best), None),
        )
        for method, fit in fits.items()
    ]


def _fit(contour: Contour, start: object, method: str) -> Fit:
    most = BUDGETS.get(method, BUDGET)
    limits = Limits(max_iterations=most, max_evaluations=most, relative_decrease=1e-7)
    return optimize(contour, start, method, limits=limits)


def sensible() -> list[Cost]:
    """All methods from the filled start, held."""
    return [cost for example in EXAMPLES for cost in run(example, SENSIBLE, METHODS, NEAR)]


def as_published() -> list[Cost]:
    """The quasi-Newton family from the literal start, identity and weak Wolfe for all of them."""
    return [
        cost for example in EXAMPLES for cost in run(example, LITERAL, AS_PUBLISHED, NEAR_PUBLISHED)
    ]


def table(name: str, costs: list[Cost], factor: float) -> Table:
    """Methods in rows, outlines side by side: iterations / evaluations / time to arrive."""
    outlines = list(dict.fromkeys(cost.outline for cost in costs))
    methods = list(dict.fromkeys(cost.method for cost in costs))
    by = {(cost.outline, cost.method): cost for cost in costs}
    header = ("method", *(f"{o}: to {factor:g} of the best" for o in outlines))
    header = (*header, *(f"{o}: E at the end" for o in outlines))
    rows = [
        (
            f"`{method}`",
            *(_cell(by[outline, method]) for outline in outlines),
            *(f"{by[outline, method].end:.4f}" for outline in outlines),
        )
        for method in methods
    ]
    return Table(name, header, rows)


def _cell(cost: Cost) -> str:
    record = cost.arrived
    if record is None:
        return f"not in {count(cost.last.evaluations)}"
    return f"{count(record.iteration)} / {count(record.evaluations)} / {seconds(record.seconds)}"


class Growth(NamedTuple):
    """Seconds an iteration and an evaluation for a number of points."""

    n_points: int
    per_iteration: float
    per_evaluation: float


def growth(sizes: tuple[int, ...] = (1000, 10_000, 100_000)) -> list[Growth]:
    """Time of direct D-BFGS on the leaf, sampled ever more densely."""
    rows = []
    for n in sizes:
        dense = EXAMPLES[0].contour.resampled(n)
        start = initial_curve(dense, arc_length=dense.length / 100)
        limits = Limits(max_iterations=30, relative_decrease=0, gradient_tolerance=0)
        lasts = [optimize(dense, start, "d-bfgs", limits=limits).history[-1] for _ in range(5)]
        rows.append(
            Growth(
                n,
                median(last.seconds / last.iteration for last in lasts),
                median(last.seconds / last.evaluations for last in lasts),
            )
        )
    return rows


def growth_table(rows: list[Growth]) -> Table:
    """Time against the number of points."""
    header = ("points n", "an iteration", "an evaluation", "per point and evaluation")
    return Table(
        "growth",
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
