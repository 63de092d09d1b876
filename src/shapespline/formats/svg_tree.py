"""The document of an SVG file made harmless and plain, before svgelements sees it.

Refused: entities, and documents that grow without end. Resolved: the page and its units, lengths
with a unit, elements that are used again. Left out: what is not drawn or is no outline.
"""

from __future__ import annotations

import copy
import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING
from xml.etree import ElementTree
from xml.parsers import expat

from shapespline.errors import FormatError
from shapespline.units import MILLIMETRES, PIXEL
from shapespline.values import ViewBox

if TYPE_CHECKING:
    from collections.abc import Mapping
    from xml.etree.ElementTree import Element

# After elements that are used again have been copied; numbers are those of paths, polygons and
# transforms, half a million points (FMT-09).
MOST_ELEMENTS, MOST_NUMBERS = 200_000, 1_000_000
DEEPEST = 200
LONG = ("d", "points", "transform")
NUMBER = re.compile(r"\d+")
# A pixel of CSS (FMT-04).
PIXEL_MILLIMETRES = 25.4 / 96
LENGTH = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(px|mm|cm|in|pt|pc|Q)?\s*")
LENGTHS = ("x", "y", "width", "height", "r", "rx", "ry", "cx", "cy", "x1", "y1", "x2", "y2")
# Class of what our writer draws beneath areas that share their borders.
UNDERLAY = "underlay"
HREFS = ("href", "{http://www.w3.org/1999/xlink}href")
NAMED = {"text": "text", "image": "pictures", "foreignObject": "foreign content"}
NOT_DRAWN = ("clipPath", "mask", "pattern", "marker", "linearGradient", "radialGradient", "filter",
             "metadata", "script", "title", "desc", "symbol", "defs")  # fmt: skip
CUTTING = {"clip-path": "clip paths", "mask": "masks"}


@dataclass(frozen=True)
class Page:
    """A plain document, and where its coordinates lie.

    Attributes
    ----------
    root : Element
        Without definitions, uses and view box: its coordinates are those of the view box, y down.
    turning_height : float or None
        y runs down: turned up it is this minus y. None without a page.
    scale : float
        What coordinates are then multiplied with.
    frame : ViewBox or None
        The view box, turned and multiplied.
    unit : str
    skipped : tuple of str
        What was left out, in words.
    """

    root: Element
    turning_height: float | None
    scale: float
    frame: ViewBox | None
    unit: str
    skipped: tuple[str, ...]


def prepared(data: bytes) -> Page:
    """The document of a file.

    Raises
    ------
    FormatError
        If it is no SVG, cut off, declares entities, or grows beyond bounds.
    """
    root = _parsed(data)
    if _tag(root) != "svg":
        raise FormatError(f"no SVG drawing: its first element is <{_tag(root)}>")
    skipped: dict[str, None] = {}
    ids = {element.get("id", ""): element for element in root.iter()}
    budget = [MOST_ELEMENTS, MOST_NUMBERS]
    plain = _plain(root, ids, (), budget, skipped)
    view_box = _view_box(root)
    width, height = (_length(root.get(name)) for name in ("width", "height"))
    for name in ("width", "height", "viewBox", "preserveAspectRatio", "x", "y"):
        plain.attrib.pop(name, None)
    if view_box is None and width is not None and height is not None:
        view_box = ViewBox(0.0, 0.0, _pixels(*width), _pixels(*height))
    if view_box is None:
        return Page(plain, None, 1.0, None, PIXEL, tuple(skipped))
    plain.set("width", repr(view_box.width))
    plain.set("height", repr(view_box.height))
    scale, unit = _scale(view_box, width, height)
    return Page(
        plain,
        2 * view_box.y + view_box.height,
        scale,
        ViewBox(*(scale * side for side in view_box)),
        unit,
        tuple(skipped),
    )


def _parsed(data: bytes) -> Element:
    """The tree of an XML document without entities of its own and of bounded depth."""
    depth = 0

    def start(name: str, attributes: Mapping[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > DEEPEST:
            raise FormatError(f"the drawing is nested more than {DEEPEST} deep")

    def end(name: str) -> None:
        nonlocal depth
        depth -= 1

    def entity(name: str, *_: object) -> None:
        raise FormatError(
            f"the file declares the XML entity {name!r}, which can hide anything; save it as plain"
            " SVG in a drawing program"
        )

    parser = expat.ParserCreate()
    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.EntityDeclHandler = entity
    try:
        parser.Parse(data, True)
        return ElementTree.fromstring(data)
    except (expat.ExpatError, ElementTree.ParseError, ValueError, LookupError) as error:
        raise FormatError(f"no SVG drawing, or cut off: {error}") from error


def _tag(element: Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _plain(
    element: Element,
    ids: Mapping[str, Element],
    inside: tuple[str, ...],
    budget: list[int],
    skipped: dict[str, None],
) -> Element:
    """A copy of what an element draws, elements that it uses put in their places."""
    budget[0] -= 1
    if budget[0] < 0:
        raise FormatError(f"the drawing has more than {MOST_ELEMENTS} elements; split it")
    budget[1] -= sum(len(NUMBER.findall(element.get(name, ""))) for name in LONG)
    if budget[1] < 0:
        raise FormatError(
            f"the paths of the drawing have more than {MOST_NUMBERS} numbers; simplify or split it"
        )
    attributes = {
        name: _without_unit(value) if name in LENGTHS else value
        for name, value in element.attrib.items()
    }
    for name, words in CUTTING.items():
        if name in attributes or f"{name}:" in attributes.get("style", "").replace(" ", ""):
            skipped[words] = None
    result = ElementTree.Element(str(element.tag), attributes)
    result.text = element.text
    for child in element:
        tag = _tag(child)
        if tag in NAMED:
            skipped[NAMED[tag]] = None
        elif tag == "defs":
            # Style sheets may stand there.
            result.extend(copy.deepcopy(style) for style in child.iter() if _tag(style) == "style")
        elif tag == "use":
            if child.get("class") == UNDERLAY:  # of the areas that are drawn above it
                continue
            target = next((child.get(name) for name in HREFS if child.get(name)), "") or ""
            found = ids.get(target[1:]) if target.startswith("#") else None
            if found is None or not target[1:]:
                skipped["references to what is not in the file"] = None
            elif target in inside:
                raise FormatError(f"the element {target} uses itself")
            else:
                placed = _placed(child, found)
                result.append(_plain(placed, ids, (*inside, target), budget, skipped))
        elif isinstance(child.tag, str) and tag not in NOT_DRAWN:
            result.append(_plain(child, ids, inside, budget, skipped))
    return result


def _placed(use: Element, found: Element) -> Element:
    """A group that draws what ``use`` refers to in its place."""
    attributes = {
        name: value
        for name, value in use.attrib.items()
        if name not in (*HREFS, "x", "y", "width", "height", "id")
    }
    x, y = (_without_unit(use.get(name, "0")) for name in ("x", "y"))
    attributes["transform"] = f"{use.get('transform', '')} translate({x} {y})"
    namespace = str(use.tag).rpartition("}")
    group = ElementTree.Element(f"{namespace[0]}{namespace[1]}g", attributes)
    if _tag(found) in ("symbol", "svg"):  # both have a view box of their own
        inner = ElementTree.Element(f"{namespace[0]}{namespace[1]}svg", dict(found.attrib))
        for name in ("width", "height"):
            inner.set(name, use.get(name, found.get(name, "100%")))
        inner.extend(found)
        found = inner
    group.append(found)
    return group


def _view_box(root: Element) -> ViewBox | None:
    text = root.get("viewBox")
    if text is None:
        return None
    try:
        box = ViewBox(*(float(number) for number in text.replace(",", " ").split()))
    except (TypeError, ValueError):
        raise FormatError(f"viewBox must be four numbers, found {text!r}") from None
    if not all(map(math.isfinite, box)) or box.width <= 0 or box.height <= 0:
        raise FormatError(f"viewBox must have an area, found {text!r}")
    return box


def _length(text: str | None) -> tuple[float, str] | None:
    """A number and its unit; None for per cent and the like."""
    match = LENGTH.fullmatch(text or "")
    if match is None:
        return None
    number = float(match[1])
    return (number, match[2] or PIXEL) if math.isfinite(number) and number > 0 else None


def _pixels(number: float, unit: str) -> float:
    """A length of CSS in its pixels, 96 to an inch."""
    return number if unit == PIXEL else number * MILLIMETRES[unit] / PIXEL_MILLIMETRES


def _without_unit(text: str) -> str:
    """A length in pixels; per cent and what is not understood stay."""
    match = LENGTH.fullmatch(text)
    if match is None or match[2] in (None, PIXEL):
        return text
    return repr(_pixels(float(match[1]), match[2]))


def _scale(
    view_box: ViewBox, width: tuple[float, str] | None, height: tuple[float, str] | None
) -> tuple[float, str]:
    """How much a unit of the view box is on paper, and in which unit; 1 pixel if not said."""
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
        return 1.0, PIXEL
    unit = known[0][1]
    # The view box is fitted into the page: the smaller scale counts.
    scales = [
        number * MILLIMETRES[other] / MILLIMETRES[unit] / side for number, other, side in known
    ]
    return min(scales), unit
