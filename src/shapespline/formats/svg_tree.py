"""The document of an SVG file made harmless and plain, before svgelements sees it.

Refused: entities, and documents that grow without end. Resolved: style sheets, the page and its
units, lengths with a unit or per cent, viewports, elements that are used again. Left out: what is
not drawn or is no outline, and the shades of gradients.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING
from xml.etree import ElementTree
from xml.parsers import expat

from shapespline.errors import FormatError
from shapespline.formats.svg_gradients import HREFS, mean_color
from shapespline.formats.svg_paint import is_zero, share
from shapespline.formats.svg_styles import styled, tag_of
from shapespline.formats.svg_viewports import (
    LENGTHS,
    VIEWPORT,
    Size,
    inner_viewport,
    page_length,
    page_scale,
    pixels,
    resolved,
    view_box_of,
)
from shapespline.units import PIXEL
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
# Selectors that are named where they are left out.
MOST_NAMED = 3
# Class of what our writer draws beneath areas that share their borders.
UNDERLAY = "underlay"
NAMED = {"text": "text", "image": "pictures", "foreignObject": "foreign content"}
NOT_DRAWN = ("clipPath", "mask", "pattern", "marker", "linearGradient", "radialGradient", "filter",
             "metadata", "script", "style", "title", "desc", "symbol", "defs")  # fmt: skip
CUTTING = {"clip-path": "clip paths", "mask": "masks", "stroke-dasharray": "dashes of strokes",
           "marker": "markers", "marker-start": "markers", "marker-mid": "markers",
           "marker-end": "markers"}  # fmt: skip


@dataclass(frozen=True)
class Page:
    """A plain document, and where its coordinates lie.

    Attributes
    ----------
    root : Element
        Without styles, definitions, uses and view boxes: its coordinates are those of the view
        box, y down.
    turning_height : float or None
        y runs down: turned up it is this minus y. None without a page.
    scale : tuple of float
        What x and y are then multiplied with.
    frame : ViewBox or None
        The view box, turned and multiplied.
    unit : str
    skipped : tuple of str
        What was left out, in words.
    tiled : bool
        Whether our writer drew areas side by side, so that none is painted over another.
    """

    root: Element
    turning_height: float | None
    scale: tuple[float, float]
    frame: ViewBox | None
    unit: str
    skipped: tuple[str, ...]
    tiled: bool


def prepared(data: bytes) -> Page:
    """The document of a file.

    Raises
    ------
    FormatError
        If it is no SVG, cut off, declares entities, or grows beyond bounds.
    """
    root = _parsed(data)
    if tag_of(root) != "svg":
        raise FormatError(f"no SVG drawing: its first element is <{tag_of(root)}>")
    unread = styled(root)
    view_box = view_box_of(root)
    width, height = (page_length(root.get(name)) for name in ("width", "height"))
    if view_box is None and width is not None and height is not None:
        view_box = ViewBox(0.0, 0.0, pixels(*width), pixels(*height))
    ids = {element.get("id", ""): element for element in root.iter()}
    copier = _Copier(ids)
    plain = copier.plain(root, (), None if view_box is None else Size(*view_box[2:]))
    for name in VIEWPORT:
        plain.attrib.pop(name, None)
    if unread:
        copier.skipped[f"style rules for {', '.join(map(repr, unread[:MOST_NAMED]))}"] = None
    skipped = tuple(copier.skipped)
    if view_box is None:
        return Page(plain, None, (1.0, 1.0), None, PIXEL, skipped, copier.tiled)
    (across, down), unit = page_scale(root, view_box, width, height)
    x, y, wide, high = view_box
    frame = ViewBox(across * x, down * y, across * wide, down * high)
    return Page(plain, 2 * y + high, (across, down), frame, unit, skipped, copier.tiled)


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


@dataclass
class _Copier:
    """Copies what elements draw, elements that they use put in their places."""

    ids: Mapping[str, Element]
    elements_left: int = MOST_ELEMENTS
    numbers_left: int = MOST_NUMBERS
    skipped: dict[str, None] = field(default_factory=dict)
    tiled: bool = False
    means: dict[str, tuple[str, float] | None] = field(default_factory=dict)

    def plain(
        self,
        element: Element,
        inside: tuple[str, ...],
        size: Size | None,
        opacity: float = 1.0,
    ) -> Element:
        """A copy of what an element draws in a viewport of a size, lengths as numbers of pixels.

        What lies in a group lets as much through as both do.
        """
        self._count(element)
        attributes = {
            name: resolved(name, value, size) if name in LENGTHS else value
            for name, value in element.attrib.items()
        }
        self._color(attributes)
        opacity *= share(attributes, "opacity", 1.0)
        attributes["opacity"] = repr(opacity)
        for name, words in CUTTING.items():
            if attributes.get(name, "none") != "none":
                self.skipped[words] = None
        result = ElementTree.Element(str(element.tag), attributes)
        for child in element:
            tag = tag_of(child)
            if child.get("display") == "none" or is_zero(child.attrib, "opacity"):
                continue
            if tag in NAMED:
                self.skipped[NAMED[tag]] = None
            elif tag == "use":
                result.extend(self._used(child, inside, size, opacity))
            elif tag == "svg":
                transform, inner = inner_viewport(child, size)
                group = _group(child, transform)
                group.extend(child)
                result.append(self.plain(group, inside, inner, opacity))
            elif isinstance(child.tag, str) and tag not in NOT_DRAWN:
                result.append(self.plain(child, inside, size, opacity))
        return result

    def _color(self, attributes: dict[str, str]) -> None:
        """Put their mean colour in the place of gradients."""
        for name in ("fill", "stroke"):
            paint = attributes.get(name, "")
            if not paint.startswith("url("):
                continue
            if paint not in self.means:
                self.means[paint] = mean_color(paint, self.ids)
            found = self.means[paint]
            if found is not None:
                self.skipped["shades of gradients"] = None
                attributes[name], opacity = found
                opacity *= share(attributes, f"{name}-opacity", 1.0)
                attributes[f"{name}-opacity"] = repr(opacity)

    def _count(self, element: Element) -> None:
        self.elements_left -= 1
        if self.elements_left < 0:
            raise FormatError(f"the drawing has more than {MOST_ELEMENTS} elements; split it")
        self.numbers_left -= sum(len(NUMBER.findall(element.get(name, ""))) for name in LONG)
        if self.numbers_left < 0:
            raise FormatError(
                f"the paths of the drawing have more than {MOST_NUMBERS} numbers; simplify or split"
                " it"
            )

    def _used(
        self, use: Element, inside: tuple[str, ...], size: Size | None, opacity: float
    ) -> list[Element]:
        """What a use draws: a group, or nothing."""
        if use.get("class") == UNDERLAY:  # of the areas that are drawn above it
            self.tiled = True
            return []
        target = next((use.get(name) for name in HREFS if use.get(name)), "") or ""
        found = self.ids.get(target[1:]) if target.startswith("#") else None
        if found is None or not target[1:]:
            self.skipped["references to what is not in the file"] = None
            return []
        if target in inside:
            raise FormatError(f"the element {target} uses itself")
        return [self.plain(_placed(use, found, size), (*inside, target), size, opacity)]


def _placed(use: Element, found: Element, size: Size | None) -> Element:
    """A group that draws what ``use`` refers to in its place."""
    x, y = (resolved(name, use.get(name, "0"), size) for name in ("x", "y"))
    group = _group(use, f"{use.get('transform', '')} translate({x} {y})")
    for name in (*HREFS, "id"):
        group.attrib.pop(name, None)
    if tag_of(found) in ("symbol", "svg"):  # both have a view box of their own
        inner = _renamed(found, "svg")
        for name in ("width", "height"):
            inner.set(name, use.get(name, found.get(name, "100%")))
        inner.extend(found)
        found = inner
    group.append(found)
    return group


def _group(element: Element, transform: str) -> Element:
    """An empty group with the style of an element, in a place of its own."""
    group = _renamed(element, "g")
    for name in VIEWPORT:
        group.attrib.pop(name, None)
    group.set("transform", transform)
    return group


def _renamed(element: Element, tag: str) -> Element:
    """An element of another kind with the same attributes and no children."""
    namespace = str(element.tag).rpartition("}")
    return ElementTree.Element(f"{namespace[0]}{namespace[1]}{tag}", dict(element.attrib))
