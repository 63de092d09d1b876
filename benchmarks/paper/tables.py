"""Tables: one value that becomes Markdown on the page and a CSV file beside it."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True)
class Table:
    """A name, a header and rows of words and figures."""

    name: str
    header: Sequence[str]
    rows: Sequence[Sequence[object]]
    words: int = 1

    def markdown(self) -> str:
        """The table on the page; the first columns hold words, the others figures."""
        rule = ["---"] * self.words + ["---:"] * (len(self.header) - self.words)
        lines = [self.header, rule, *self.rows]
        body = "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)
        return f"{body}\n\n[as CSV](figures/paper/{self.name}.csv)"

    def csv(self) -> bytes:
        """The same for a program."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(self.header)
        writer.writerows(self.rows)
        return text.getvalue().encode()


def mean_and_scatter(ratios: Sequence[float]) -> str:
    """The geometric mean, and the factor that two thirds of the values lie within."""
    mean, factor = geometric(ratios)
    return f"{mean:.2g} ×÷ {factor:.2g}"


def geometric(ratios: Sequence[float]) -> tuple[float, float]:
    """Geometric mean and geometric standard deviation."""
    logs = np.log(np.asarray(ratios, dtype=float))
    return float(np.exp(logs.mean())), float(np.exp(logs.std()))


def count(value: int) -> str:
    """A whole number with thin groups of three."""
    return f"{value:,}".replace(",", " ")


def seconds(value: float) -> str:
    """A time to two digits."""
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if value >= 0.995 * size:
            return (
                f"{value / size:.2g} {unit}"
                if value / size < 99.5
                else f"{value / size:.0f} {unit}"
            )
    return f"{1e6 * value:.0f} µs"


def percent(part: float) -> str:
    """A part as per cent, three digits."""
    return f"{100 * part:.3g} %"
