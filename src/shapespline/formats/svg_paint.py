"""Paint: what an element of an SVG is filled and stroked with, if it is to be seen."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapespline.formats.svg_viewports import LENGTH

if TYPE_CHECKING:
    from collections.abc import Mapping

    from svgelements import Shape


class Paint(NamedTuple):
    """What an element is painted with; None where nothing is to be seen.

    Attributes
    ----------
    fill, stroke : str or None
        Colours as #rrggbb; gradients and the like by their reference.
    even_odd : bool
        The rule by which it is filled; otherwise what its sub-paths wind around is.
    """

    fill: str | None
    stroke: str | None
    even_odd: bool


def paint_of(shape: Shape) -> Paint:
    """What an element with inherited properties is painted with."""
    values = shape.values
    if str(values.get("visibility", "visible")).strip() in ("hidden", "collapse"):
        return Paint(None, None, False)
    stroke = None if is_zero(values, "stroke-width") else _color(values, "stroke", "none")
    even_odd = str(values.get("fill-rule", "nonzero")).strip() == "evenodd"
    return Paint(_color(values, "fill", "black"), stroke, even_odd)


def _color(values: Mapping[str, object], name: str, default: str) -> str | None:
    from svgelements import Color

    text = str(values.get(name, default)).strip()
    if text.startswith("url("):
        return text
    color = Color(text)
    if color.value is None or color.opacity == 0 or is_zero(values, f"{name}-opacity"):
        return None
    return str(color.hexrgb)


def is_zero(values: Mapping[str, object], name: str) -> bool:
    """Whether an opacity or a width is told to be 0, with whatever unit."""
    match = LENGTH.fullmatch(str(values.get(name, "1")))
    return match is not None and float(match[1]) == 0
