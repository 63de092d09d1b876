"""Neighbouring arcs of one circle are one arc, neighbours on one line one line.

Segments are found before it is known what is equal: a fillet that was cut in two becomes two arcs
of the same centre and radius, an edge two that are level and meet.
"""

from __future__ import annotations

from dataclasses import replace
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.parts import DrawnArc, DrawnLine

if TYPE_CHECKING:
    from shapespline.engines.drawn.parts import Drawn, Part
    from shapespline.values import Regularity

# Circles are one if their centres and radii differ by no more than this part of the radius, lines
# if their joint is off by no more than this part of the shorter one, which equations are met to
# (DRA-53).
SAME = 1e-7


def merged(drawn: Drawn, *, closed: bool) -> Drawn:
    """The same, with one part for neighbours of one circle or line.

    What they kept of each other is gone.
    """
    parts: list[Part] = []
    place: list[int] = []
    for part in drawn.parts:
        whole = _one(parts[-1], part) if parts else None
        if whole is None:
            parts.append(part)
        else:
            parts[-1] = whole
        place.append(len(parts) - 1)
    if closed and len(parts) > 1 and (whole := _one(parts[-1], parts[0])) is not None:
        parts[0] = whole
        del parts[-1]
        place = [0 if k == len(parts) else k for k in place]
    if len(parts) == len(drawn.parts):
        return drawn
    kept: dict[tuple[str, tuple[int, ...]], Regularity] = {}
    for one in drawn.regularities:
        pieces = tuple(dict.fromkeys(place[k] for k in one.pieces))
        if len(pieces) > 1 or len(one.pieces) == 1:  # else what two parts of one have alike
            kept.setdefault((one.name, pieces), one._replace(pieces=pieces))
    return replace(drawn, parts=tuple(parts), regularities=tuple(kept.values()))


def _one(before: Part, after: Part) -> Part | None:
    return _one_arc(before, after) or _one_line(before, after)


def _one_arc(before: Part, after: Part) -> DrawnArc | None:
    """Two parts as one arc, None where they are none or would be a whole circle."""
    if not (isinstance(before, DrawnArc) and isinstance(after, DrawnArc)):
        return None
    a, b = before.arc, after.arc
    off = max(hypot(*np.subtract(a.centre, b.centre)), abs(a.radius - b.radius))
    sweep = a.sweep + b.sweep
    if off > SAME * a.radius or a.sweep * b.sweep <= 0 or abs(sweep) >= 2 * np.pi:
        return None
    return DrawnArc(replace(a, sweep=sweep), before.begin, after.end)


def _one_line(before: Part, after: Part) -> DrawnLine | None:
    """Two parts as one line, None where they are none or one turns back."""
    if not (isinstance(before, DrawnLine) and isinstance(after, DrawnLine)):
        return None
    a, b = before.end - before.begin, after.end - after.begin
    longer = max(hypot(*a), hypot(*b))
    # The joint's distance from the whole line is the cross product over its length.
    if abs(a[0] * b[1] - a[1] * b[0]) > SAME * min(hypot(*a), hypot(*b)) * longer or a @ b <= 0:
        return None
    return DrawnLine(before.begin, after.end)
