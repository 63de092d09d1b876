"""Icons from their SVG paths: lines, circular arcs and cubics as the path has them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from benchmarks.drawn.truth import Arc, Cubic, Line

if TYPE_CHECKING:
    from benchmarks.drawn.truth import Array, Element, Outline

# Paths, with their licence in the first lines.
SOURCE = Path(__file__).with_name("icons.tsv")
# Side of the square that icons are drawn in, and what is no length there: two digits are written.
SIDE, NOTHING = 24.0, 1e-6


def icons(kind: str) -> dict[str, tuple[Outline, ...]]:
    """The icons of a kind by name, y up, in a square of side one."""
    lines = SOURCE.read_text("utf-8").splitlines()
    rows = [line.split("\t") for line in lines if not line.startswith("#")]
    return {name: outlines_of(path) for own, name, path in rows if own == kind}


def outlines_of(path: str) -> tuple[Outline, ...]:
    """The closed outlines of a path; arcs of one circle in a row are one arc, lines one line."""
    import svgelements

    outlines = []
    for part in svgelements.Path(path).as_subpaths():
        elements: list[Element] = []
        for segment in svgelements.Path(part):
            if isinstance(segment, svgelements.Move):
                continue
            element = _element(segment)
            if np.hypot(*(element.end - element.begin)) > NOTHING or isinstance(element, Cubic):
                elements.append(element)
        if np.hypot(*(elements[-1].end - elements[0].begin)) > NOTHING:
            elements.append(Line(elements[-1].end, elements[0].begin))
        outlines.append(_merged(elements))
    return tuple(outlines)


def _element(segment: Any) -> Element:
    import svgelements

    begin, end = _up(segment.start), _up(segment.end)
    if isinstance(segment, svgelements.CubicBezier):
        return Cubic(np.stack([begin, _up(segment.control1), _up(segment.control2), end]))
    if isinstance(segment, svgelements.Arc):
        centre, sweep = _up(segment.center), -float(segment.sweep)
        out = begin - centre
        radius, start = float(np.hypot(*out)), float(np.arctan2(out[1], out[0]))
        return Arc(centre, radius, start, sweep)
    return Line(begin, end)


def _up(point: Any) -> Array:
    return np.array([point.x, SIDE - point.y]) / SIDE


def _merged(elements: list[Element]) -> Outline:
    """Elements that go on as their neighbours are one with them."""
    row = list(elements)
    k = 0
    while len(row) > 1 and k < len(row):
        both = _joined(row[k - 1], row[k])
        if both is None:
            k += 1
            continue
        row[k - 1] = both
        del row[k]
        k = max(k - 1, 0)
    return tuple(row)


def _joined(before: Element, after: Element) -> Element | None:
    """One element for two, if they lie on one line or one circle and go the same way."""
    if isinstance(before, Arc) and isinstance(after, Arc):
        alike = np.hypot(*(before.centre - after.centre)) + abs(before.radius - after.radius)
        if alike < NOTHING and before.sweep * after.sweep > 0:
            return Arc(before.centre, before.radius, before.start, before.sweep + after.sweep)
    if isinstance(before, Line) and isinstance(after, Line):
        a, b = before.end - before.begin, after.end - after.begin
        if abs(a[0] * b[1] - a[1] * b[0]) < NOTHING * np.hypot(*a) and a @ b > 0:
            return Line(before.begin, after.end)
    return None
