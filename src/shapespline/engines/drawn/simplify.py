"""Features below a size left out: a fillet becomes a corner, an arc a line, never a bend.

What is left out depends on the size of a feature alone, so equal features stay equal.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn.parts import Drawn, DrawnArc, DrawnLine

if TYPE_CHECKING:
    from shapespline.engines.drawn.parts import Part
    from shapespline.typing import FloatArray

# Equal features differ by rounding: this part of a size.
ROUNDING = 1e-6
# A fillet touches its lines but for so many radians, and turns by less than this.
TOUCHES, LARGEST_TURN = 1e-4, 0.9 * pi
# Regularities that are about arcs alone, or joints with them.
OF_ARCS = ("tangent", "concentric", "equal-radius")


def simplified(drawn: Drawn, distance: float) -> Drawn:
    """The same without features that leaving out moves the curve by no more than a distance.

    Examples
    --------
    >>> from shapespline.values import Arc
    >>> low, right = np.array([[0.0, 0], [9, 0]]), np.array([[10.0, 1], [10, 9]])
    >>> fillet = DrawnArc(Arc((9, 1), 1.0, -np.pi / 2, np.pi / 2), low[1], right[0])
    >>> corner = Drawn((DrawnLine(*low), fillet, DrawnLine(*right)), (), True, 6)
    >>> [part.end.tolist() for part in simplified(corner, 0.5).parts]
    [[10.0, 0.0], [10.0, 9.0]]
    >>> simplified(corner, 0.2) is corner
    True
    """
    distance *= 1 + ROUNDING
    parts: list[Part | None] = list(drawn.parts)
    ends = [_ends_of(part) for part in drawn.parts]
    closed = bool((ends[0][0] == ends[-1][1]).all())
    changed: set[int] = set()
    for k, part in enumerate(drawn.parts):
        if not isinstance(part, DrawnArc) or abs(part.arc.sweep) > LARGEST_TURN:
            continue
        before, after = k - 1, (k + 1) % len(parts)
        inside = closed or 0 < k < len(parts) - 1
        corner = _corner(parts[before], part, parts[after]) if inside and len(parts) > 2 else None
        flat = cos(0.5 * part.arc.sweep)
        if corner is not None and part.arc.radius * (1 / flat - 1) <= distance:
            parts[k] = None
            parts[before] = replace(parts[before], end=corner)  # type: ignore[type-var]
            parts[after] = replace(parts[after], begin=corner)  # type: ignore[type-var]
            changed.add(k)
        elif part.arc.radius * (1 - flat) <= distance:
            parts[k] = DrawnLine(part.begin, part.end)
            changed.add(k)
    if not changed:
        return drawn
    place = {k: i for i, k in enumerate(k for k, part in enumerate(parts) if part is not None)}
    beside = {(k + off) % len(parts) for k in changed for off in (-1, 1)}
    kept = tuple(
        one._replace(pieces=tuple(place[k] for k in one.pieces if k in place))
        for one in drawn.regularities
        if not (changed & set(one.pieces) and one.name in OF_ARCS)
        and not (beside & set(one.pieces) and one.name == "equal-length")
    )
    left = tuple(part for part in parts if part is not None)
    return replace(drawn, parts=left, regularities=kept)


def _ends_of(part: Part) -> tuple[FloatArray, FloatArray]:
    if isinstance(part, DrawnLine | DrawnArc):
        return part.begin, part.end
    return part.points[0], part.points[-1]


def _corner(before: Part | None, arc: DrawnArc, after: Part | None) -> FloatArray | None:
    """Where the lines beside a fillet meet; None if it is no fillet."""
    if not (isinstance(before, DrawnLine) and isinstance(after, DrawnLine)):
        return None
    a, b = before.end - before.begin, after.end - after.begin
    turn = float(np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b))
    if abs(turn - arc.arc.sweep) > TOUCHES:
        return None
    off = after.begin - before.begin
    along = (off[0] * b[1] - off[1] * b[0]) / (a[0] * b[1] - a[1] * b[0])
    corner = before.begin + along * a
    # Level and upright lines keep their coordinate to the bit.
    corner = np.where(a == 0.0, before.begin, corner)
    return np.where(b == 0.0, after.begin, corner)
