"""Paint: what an element of an SVG is filled and stroked with, if it is to be seen."""

from __future__ import annotations

import math
import re
import zlib
from typing import TYPE_CHECKING, NamedTuple

from shapespline.errors import FormatError
from shapespline.formats.svg_viewports import LENGTH
from shapespline.values import BLACK, CAPS, JOINS, Stroke

if TYPE_CHECKING:
    from collections.abc import Mapping

    from svgelements import Shape

WHITE = "#ffffff"
# Of patterns and the like: greys from this one on, so many of them.
GREY, GREYS = 0x60, 0x40
REBECCA, FUNCTION = "rgb(102 51 153)", re.compile(r"(rgb|hsl)a?\(([^,]*)\)")


class Paint(NamedTuple):
    """What an element is painted with; None where nothing is to be seen.

    Attributes
    ----------
    fill, stroke : str or None
        Colours as #rrggbb.
    even_odd : bool
        The rule by which it is filled; otherwise what its sub-paths wind around is.
    fill_opacity, stroke_opacity : float
        From 0, which is not to be seen, to 1.
    width : float
        Of the stroke, in the coordinates of the view box.
    cap, join : str
        How the stroke ends and turns.
    """

    fill: str | None
    stroke: str | None
    even_odd: bool
    fill_opacity: float = 1.0
    stroke_opacity: float = 1.0
    width: float = 1.0
    cap: str = "butt"
    join: str = "miter"


def paint_of(shape: Shape) -> Paint:
    """What an element with inherited properties is painted with."""
    values = shape.values
    if str(values.get("visibility", "visible")).strip() in ("hidden", "collapse"):
        return Paint(None, None, False)
    m = shape.transform
    width = _number(values, "stroke-width", 1.0) * math.sqrt(abs(m.a * m.d - m.b * m.c))
    if not math.isfinite(width):
        raise FormatError("the width of a stroke is no finite number")
    fill, fill_opacity = _color(values, "fill", "black")
    stroke, stroke_opacity = _color(values, "stroke", "none")
    return Paint(
        fill,
        stroke if width > 0 else None,
        str(values.get("fill-rule", "nonzero")).strip() == "evenodd",
        fill_opacity,
        stroke_opacity,
        width,
        _word(values, "stroke-linecap", CAPS, "butt"),
        _word(values, "stroke-linejoin", JOINS, "miter"),
    )


def stroke_of(paint: Paint, beneath: str | None) -> Stroke:
    """How a stroke of a paint looks on a colour, or on white paper."""
    color = blended(paint.stroke or BLACK, paint.stroke_opacity, beneath)
    return Stroke(color, paint.cap, paint.join)


def blended(color: str, opacity: float, beneath: str | None) -> str:
    """A colour that lets through some of what lies beneath, white paper if nothing does.

    Examples
    --------
    >>> blended("#000000", 0.2, "#ff8000")
    '#cc6600'
    """
    if opacity == 1.0:
        return color
    pairs = zip(_parts(color), _parts(beneath or WHITE), strict=True)
    mixed = (round(opacity * above + (1 - opacity) * below) for above, below in pairs)
    return "#" + "".join(f"{part:02x}" for part in mixed)


def _parts(color: str) -> list[int]:
    return [int(color[k : k + 2], 16) for k in (1, 3, 5)]


def _color(values: Mapping[str, object], name: str, default: str) -> tuple[str | None, float]:
    """A colour and how opaque it is."""
    color, opacity = color_and_opacity(values, name, default)
    opacity *= share(values, "opacity", 1.0) * share(values, f"{name}-opacity", 1.0)
    return (color if opacity else None), opacity


def color_and_opacity(
    values: Mapping[str, object], name: str, default: str
) -> tuple[str | None, float]:
    """A colour as #rrggbb and how opaque it says to be; None where it is none."""
    from svgelements import Color

    text = str(values.get(name, default)).strip()
    if text.startswith("url(") and text.partition(")")[2].strip():  # where there is no such paint
        text = text.partition(")")[2].strip()
    if text.startswith("url("):
        level = GREY + zlib.crc32(text.encode()) % GREYS
        return f"#{3 * f'{level:02x}'}", 1.0
    # The library knows neither this name nor CSS Color 4, which writes blanks and a slash.
    match = FUNCTION.fullmatch(REBECCA if text == "rebeccapurple" else text)
    if match is not None and len(words := match[2].replace("/", " ").split()) in (3, 4):
        alpha = share({"": words[3]}, "", 1.0) if len(words) == 4 else 1.0
        text = f"{match[1]}a({','.join([*words[:3], repr(alpha)])})"
    color = Color(text)
    if color.value is None:
        return None, 0.0
    # The library rounds what is opaque to 1 - 1e-16 here and there.
    return str(color.hexrgb), round(float(color.opacity), 3)


def share(values: Mapping[str, object], name: str, default: float) -> float:
    """A number from 0 to 1, or its per cents."""
    text = str(values.get(name, default)).strip()
    number = _number({name: text.removesuffix("%")}, name, default)
    return min(max(number / 100 if text.endswith("%") else number, 0.0), 1.0)


def _word(values: Mapping[str, object], name: str, words: tuple[str, ...], default: str) -> str:
    found = str(values.get(name, default)).strip()
    return found if found in words else default


def _number(values: Mapping[str, object], name: str, default: float) -> float:
    match = LENGTH.fullmatch(str(values.get(name, default)))
    return default if match is None else float(match[1])


def is_zero(values: Mapping[str, object], name: str) -> bool:
    """Whether an opacity or a width is told to be 0, with whatever unit."""
    return _number(values, name, 1.0) == 0
