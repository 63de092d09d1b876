"""The one table of pinned sizes: how many points a fit stores today, and may store at most.

Rows are an outline of examples/data/outlines, a tolerance in per cent of its box diagonal, and how
it is fitted: form and corners as `fit_curve` takes them, or an engine "alone". ``points`` are those
of today, held in the mean over all outlines; ``most`` is an upper bound for this one: what the
experiments reached, or the average over shaken data where that is more (PKG-01).
"""

from __future__ import annotations

import csv
from typing import NamedTuple

from tests.support.places import ROOT

TABLE = ROOT / "tests" / "contract" / "pinned_sizes.csv"


class Size(NamedTuple):
    """One row; ``points`` or ``most`` is None where it is not pinned."""

    outline: str
    percent: float
    form: str
    corners: str
    points: int | None
    most: int | None


def pinned():
    """Every row of the table."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return [
            Size(
                row["outline"],
                float(row["percent"]),
                row["form"],
                row["corners"],
                int(row["points"]) if row["points"] else None,
                int(row["most"]) if row["most"] else None,
            )
            for row in csv.DictReader(file)
        ]


def most_points(outline, percent, form, corners="auto"):
    """The upper bound for one outline."""
    (row,) = [size for size in pinned() if size[:4] == (outline, percent, form, corners)]
    return row.most


def pin(points):
    """Write the points of today of default fits, {(outline, percent): points}; bounds stay."""
    rows = [
        size._replace(points=points[size[:2]]) if size.points is not None else size
        for size in pinned()
    ]
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerows([Size._fields, *rows])
