"""Errors that lines and arcs tell where nothing else does: of few points, and of a file's digits.

Fewer points than tell noise from bends may be exact or not, and those of a file have so many
digits. They are taken for exact first, then for less and less so, until what was drawn explains
them.
"""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import (
    are_drawn_vertices,
    left_of_cubics,
    precisions,
    slow_noise,
    tells_noise,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.engines.drawn.observed import Observed
    from shapespline.engines.drawn.parts import Drawn
    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# Errors are no larger than so many times what neighbours leave of cubics, bends and all, or than
# rounding; those of few points no larger than that part of a step. Beyond the first part of it, the
# second for digits, a leaf may be lines and arcs, too, but no leaf is told by one number for each
# of these; beyond the third a whole circle alone is told (DRA-47).
LARGER = 1.5
OF_STEP, OF_STEP_OF_DIGITS, OF_STEP_REPEATED, OF_STEP_ROUND = 0.01, 0.02, 0.06, 0.1
# From one supposition to the next; and how many times the last digit is as good as exact, so that
# an arc for what was a free-form run is no other shape (DRA-47).
GROWTH, NEARLY = 2.0, 8.0


class Supposition(NamedTuple):
    """The points with larger errors, and what is taken for told by them.

    ``by_rounding`` if the digits of the points make such errors, ``nearly_exact`` if they are as
    small as that; ``n_each`` are the unknowns that lines and arcs may leave for each of them.
    ``precisions`` (n,) of noisy points are those over what their neighbours tell.
    """

    seen: Observed
    by_rounding: bool = False
    nearly_exact: bool = False
    n_each: float = inf
    precisions: FloatArray | None = None

    def tells(self, drawn: Drawn) -> bool:
        """Whether few enough numbers tell the shape; of no file's digits lines and arcs alone."""
        if not drawn.is_told or (drawn.has_runs and not self.by_rounding):
            return False
        n = len(drawn.parts)
        return n == 1 or drawn.n_unknowns <= self.n_each * n


def unsure(contour: Contour, seen: Observed) -> Iterator[Supposition]:
    """Noisy points some of which are less sure than others, as their neighbours tell."""
    found = precisions(contour, seen.deviation) if _tells_all(contour, seen) else None
    if found is not None:
        yield Supposition(replace(seen, precisions=found), precisions=found)


def drifting(contour: Contour, seen: Observed) -> Iterator[Supposition]:
    """Noisy points whose errors go on from one to the next, the shortest way first."""
    if not _tells_all(contour, seen):
        return
    for deviation, apart in slow_noise(contour, seen.deviation):
        part = (seen.deviation / deviation) ** 2 / apart
        yield Supposition(
            seen.drifting(deviation, apart), precisions=np.full(len(seen.points), part)
        )


def _tells_all(contour: Contour, seen: Observed) -> bool:
    """Whether all points are looked at one by one, and tell their noise."""
    return tells_noise(contour) and not seen.exact and len(seen.points) == len(contour)


def suppositions(contour: Contour, seen: Observed) -> Iterator[Supposition]:
    """Measured points whose errors are unknown with larger and larger ones; none of others."""
    if tells_noise(contour):
        return
    points, closed = contour.points, contour.closed
    exact, level = seen.deviation, 0.0
    rounding = LARGER * seen.rounding
    if contour.accuracy != 0:
        level = left_of_cubics(contour)
        if are_drawn_vertices(points, closed, level):
            level = 0.0
    digits = max(rounding, GROWTH * exact) if rounding else 0.0
    nearly = digits if contour.accuracy == 0 else NEARLY * exact
    most = max(digits, nearly, min(LARGER * level, OF_STEP_ROUND * seen.step))
    deviation = GROWTH * exact
    while deviation <= most:
        yield Supposition(
            seen.less_exact(deviation),
            by_rounding=deviation <= digits,
            nearly_exact=deviation <= max(digits, nearly),
            n_each=_n_each(deviation / seen.step, by_rounding=deviation <= digits),
        )
        deviation *= GROWTH


def _n_each(part: float, *, by_rounding: bool) -> float:
    if part <= (OF_STEP_OF_DIGITS if by_rounding else OF_STEP):
        return inf
    return 1.0 if part <= OF_STEP_REPEATED else 0.0
