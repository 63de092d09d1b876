"""Rows of noisy points whose edges run along the directions that several edges share.

A few points of a short edge hardly tell its direction; where others tell it, it is found by its
offset alone (DRA-50).
"""

from __future__ import annotations

from math import pi, remainder
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.fillets import rows_with_likely_fillets
from shapespline.engines.drawn.model import Model
from shapespline.engines.drawn.segments import LINE, PRICE, Prices, segmented

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.engines.drawn.segments import Segments

# Directions that differ by less, radians, are one, but for rounding.
ALIKE = 1e-6


def rows_along(model: Model) -> Iterator[Segments]:
    """The row that edges along shared directions make cheapest, and those with fillets between."""
    directions = _shared(model)
    if not directions:
        return
    angles = np.add.outer(directions, (0.0, pi / 2)).ravel()
    along = np.column_stack([np.cos(angles), np.sin(angles)])
    row = segmented(model.seen, prices=Prices(PRICE, along))
    yield row
    yield from rows_with_likely_fillets(Model.of(model.seen, row, None, model.ends))


def _shared(model: Model) -> list[float]:
    """Directions that two edges have or more, at right angles as well, radians."""
    lines = [float(model.x[at]) for k, at in model.at.items() if model.kind(k) == LINE]
    found: list[float] = []
    for k, own in enumerate(lines):
        known = any(_apart(own, other) < ALIKE for other in found)
        if not known and any(_apart(own, other) < ALIKE for other in lines[k + 1 :]):
            found.append(own)
    return found


def _apart(one: float, other: float) -> float:
    """Angle between directions but for right angles."""
    return abs(remainder(one - other, pi / 2))
