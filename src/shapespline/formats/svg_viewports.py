"""Viewports of SVG: lengths and percentages in them, and how a view box is fitted into one."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, NamedTuple

from shapespline.errors import FormatError
from shapespline.units import MILLIMETRES, PIXEL
from shapespline.values import ViewBox

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

# A pixel of CSS (FMT-04).
PIXEL_MILLIMETRES = 25.4 / 96
LENGTH = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(px|mm|cm|in|pt|pc|Q|%)?\s*")
ACROSS = ("x", "width", "rx", "cx", "x1", "x2")
DOWN = ("y", "height", "ry", "cy", "y1", "y2")
LENGTHS = (*ACROSS, *DOWN, "r", "stroke-width")
# What makes an element a viewport.
VIEWPORT = ("x", "y", "width", "height", "viewBox", "preserveAspectRatio")


class Size(NamedTuple):
    """Width and height of the nearest viewport, in its own units: what percentages are part of."""

    width: float
    height: float

    def part_of(self, name: str) -> float:
        """What a percentage of an attribute counts (SVG 2, section 8.9)."""
        if name in ACROSS:
            return self.width
        return self.height if name in DOWN else math.hypot(*self) / math.sqrt(2)


def view_box_of(element: Element) -> ViewBox | None:
    """The view box of an element, y down.

    Raises
    ------
    FormatError
        If it is not four numbers with an area.
    """
    text = element.get("viewBox")
    if text is None:
        return None
    try:
        box = ViewBox(*(float(number) for number in text.replace(",", " ").split()))
    except (TypeError, ValueError):
        raise FormatError(f"viewBox must be four numbers, found {text!r}") from None
    if not all(map(math.isfinite, box)) or box.width <= 0 or box.height <= 0:
        raise FormatError(f"viewBox must have an area, found {text!r}")
    return box


def page_length(text: str | None) -> tuple[float, str] | None:
    """A positive number and its unit; None for per cent and the like."""
    match = LENGTH.fullmatch(text or "")
    if match is None or match[2] == "%":
        return None
    number = float(match[1])
    return (number, match[2] or PIXEL) if math.isfinite(number) and number > 0 else None


def pixels(number: float, unit: str) -> float:
    """A length of CSS in its pixels, 96 to an inch."""
    return number if unit == PIXEL else number * MILLIMETRES[unit] / PIXEL_MILLIMETRES


def resolved(name: str, text: str, size: Size | None) -> str:
    """A length as a number of pixels; what is not understood or part of nothing known stays."""
    match = LENGTH.fullmatch(text)
    if match is None or match[2] in (None, PIXEL):
        return text
    if match[2] != "%":
        return repr(pixels(float(match[1]), match[2]))
    return text if size is None else repr(float(match[1]) / 100 * size.part_of(name))


def page_scale(
    element: Element,
    view_box: ViewBox,
    width: tuple[float, str] | None,
    height: tuple[float, str] | None,
) -> tuple[tuple[float, float], str]:
    """How much a unit of the view box is on paper, across and down, and in which unit.

    1 pixel if the page does not say; where the page stretches the view box, the smaller of both.
    """
    stretch = (1.0, 1.0)
    if width is not None and height is not None:
        across, down, *_ = _fitted(element, view_box, pixels(*width), pixels(*height))
        stretch = across / min(across, down), down / min(across, down)
    known = [
        (number, unit, side)
        for (number, unit), side in (
            (length, side)
            for length, side in ((width, view_box.width), (height, view_box.height))
            if length is not None
        )
        if unit != PIXEL
    ]
    if not known:
        return stretch, PIXEL
    unit = known[0][1]
    scales = [
        number * MILLIMETRES[other] / MILLIMETRES[unit] / side for number, other, side in known
    ]
    scale = max(scales) if "slice" in element.get("preserveAspectRatio", "") else min(scales)
    return (scale * stretch[0], scale * stretch[1]), unit


def inner_viewport(element: Element, outer: Size | None) -> tuple[str, Size | None]:
    """The transform of an <svg> within another one, and the size of its viewport."""
    given = {
        name: resolved(name, element.get(name, default), outer)
        for name, default in (("x", "0"), ("y", "0"), ("width", "100%"), ("height", "100%"))
    }
    x, y, width, height = map(_number, given.values())
    own = element.get("transform", "")
    box = view_box_of(element)
    if box is None:
        known = width is not None and height is not None
        size = Size(width, height) if known else None  # type: ignore[arg-type]
        return f"{own} translate({x or 0.0!r} {y or 0.0!r})", size
    across, down, right, below = _fitted(
        element,
        box,
        box.width if width is None else width,
        box.height if height is None else height,
    )
    place = f"translate({(x or 0.0) + right!r} {(y or 0.0) + below!r}) scale({across!r} {down!r})"
    return f"{own} {place}", Size(box.width, box.height)


def _number(text: str) -> float | None:
    try:
        number = float(text)
    except ValueError:
        return None
    return number if math.isfinite(number) else None


def _fitted(
    element: Element, box: ViewBox, width: float, height: float
) -> tuple[float, float, float, float]:
    """Scale across and down, and where the origin of a view box comes to lie (SVG 2, 8.2)."""
    across, down = width / box.width, height / box.height
    align, *sliced = element.get("preserveAspectRatio", "").split() or ["xMidYMid"]
    if align != "none":
        across = down = (max if "slice" in sliced else min)(across, down)
    free = width - across * box.width, height - down * box.height
    right, below = (
        0.0 if align == "none" or low in align else gap if high in align else 0.5 * gap
        for low, high, gap in (("xMin", "xMax", free[0]), ("YMin", "YMax", free[1]))
    )
    return across, down, right - across * box.x, below - down * box.y
