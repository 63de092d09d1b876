"""Run it from the repository: ``python -m benchmarks.paper``. It takes six to nine minutes."""

from __future__ import annotations

import time

from benchmarks.paper import figures, literal, optimisers, start_claim
from benchmarks.paper.outlines import EXAMPLES, REPOSITORY, closed_outlines, kinds
from benchmarks.paper.text import Findings, page, readings_table, short
from benchmarks.paper.verdicts import verdicts
from shapespline.formats import write_atomically

# Figure 1 of the paper has L = 8.
FIGURE_1_LENGTH = 8


def main() -> None:
    """Measure, write tables and figures, then the words about them."""
    began = time.perf_counter()
    figures.PICTURES.mkdir(parents=True, exist_ok=True)
    outlines = closed_outlines()
    published, sensible = (start_claim.compare(s, outlines) for s in start_claim.SETTINGS)
    shown = [literal.shown(example) for example in EXAMPLES]
    units = literal.units()
    costs, family = optimisers.sensible(), optimisers.as_published()
    growth = optimisers.growth()
    tables = [
        readings_table(),
        verdicts(shown, units, published, sensible, family, growth),
        *(start_claim.table(compared) for compared in (published, sensible)),
        *(start_claim.single_runs(compared) for compared in (published, sensible)),
        literal.lengths_table(),
        literal.examples_table(shown),
        literal.units_table(units),
        optimisers.table("optimisers", costs, optimisers.NEAR),
        optimisers.table("optimisers-published", family, optimisers.NEAR_PUBLISHED),
        optimisers.growth_table(growth),
        literal.kinds_table(kinds()),
        literal.smoothing_table(literal.smoothing()),
    ]
    figures.draw_claim(
        [
            (published, "d-bfgs-inverse", "As published: Algorithm 1"),
            (sensible, "levenberg-marquardt", "As it works: Levenberg-Marquardt"),
        ]
    )
    figures.draw_steps(shown[0], FIGURE_1_LENGTH)
    figures.draw_lengths(shown[0], literal.LENGTHS)
    for one in shown:
        figures.draw_example(one)
    found = Findings(shown, published, sensible, costs, {table.name: table for table in tables})
    for table in tables:
        write_atomically(figures.PICTURES / f"{table.name}.csv", table.csv())
    write_atomically(REPOSITORY / "docs" / "paper.md", page(found).encode())
    write_atomically(REPOSITORY / "docs" / "paper-in-short.md", short(found).encode())
    print(f"wrote docs/paper.md and what belongs to it in {time.perf_counter() - began:.0f} s")


if __name__ == "__main__":
    main()
