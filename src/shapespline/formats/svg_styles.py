"""Style sheets of SVG: what their rules say of each element, written into its attributes.

Selectors of elements, classes and ids are understood, within (a blank) and directly within (>)
others; what needs more is left out and named. Rules win by !important, by how much their selectors
say, and by their order (CSS Cascading and Inheritance 4, section 6).
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from xml.etree.ElementTree import Element

# The properties that tell what is drawn, and where.
PAINTING = ("fill", "fill-opacity", "fill-rule", "stroke", "stroke-opacity", "stroke-width",
            "stroke-linecap", "stroke-linejoin", "stroke-dasharray", "stop-color", "stop-opacity",
            "marker", "marker-start", "marker-mid", "marker-end",
            "color", "opacity", "display", "visibility", "clip-path", "mask",
            "transform")  # fmt: skip
PLACES = ("x", "y", "width", "height", "r", "rx", "ry", "cx", "cy")
COMMENT = re.compile(r"/\*.*?\*/|<!--|-->", re.DOTALL)
IMPORTANT = re.compile(r"!\s*important\s*$")
OWN = (math.inf,)
SIMPLE = re.compile(r"(\*|[A-Za-z_][\w-]*)?((?:[.#][\w-]+)*)")
PART = re.compile(r"[.#][\w-]+")


class Compound(NamedTuple):
    """What one element has to be: of a kind (or any), with an id and classes."""

    tag: str
    names: frozenset[str]

    def fits(self, element: Element) -> bool:
        """Whether an element is such a one."""
        return self.tag in ("*", tag_of(element)) and self.names <= _names(element)


class Rule(NamedTuple):
    """Declarations, the elements they are for, and what they win by.

    Attributes
    ----------
    last : Compound
        What the element itself has to be.
    outer : tuple of (str, Compound)
        What those around it have to be, from the inside: the next one (">") or any (" ").
    weight : tuple of int
        Numbers of ids, of classes, of kinds, and the place in the sheet.
    declarations : dict of str to (str, bool)
        Values, and whether they are important.
    """

    last: Compound
    outer: tuple[tuple[str, Compound], ...]
    weight: tuple[float, ...]
    declarations: dict[str, tuple[str, bool]]


def styled(root: Element) -> list[str]:
    """Write what rules and the elements' own styles say into the attributes of a document.

    Returns
    -------
    list of str
        Selectors of rules that are left out, once each.
    """
    text = "\n".join("".join(one.itertext()) for one in root.iter() if tag_of(one) == "style")
    by_key: dict[str, list[Rule]] = {}
    unread: dict[str, None] = {}
    for place, (selector, declarations) in enumerate(_rules(text)):
        rule = _rule(selector, declarations, place)
        if rule is None:
            unread[selector] = None
        else:
            key = min(rule.last.names, default=rule.last.tag)
            by_key.setdefault(key, []).append(rule)
    _write(root, by_key, [])
    return list(unread)


def _write(element: Element, by_key: dict[str, list[Rule]], outer: list[Element]) -> None:
    """Write what holds for an element into its attributes, and for those in it."""
    rules = (
        rule
        for key in ("*", tag_of(element), *_names(element))
        for rule in by_key.get(key, ())
        if rule.last.fits(element) and _lies_in(rule.outer, outer)
    )
    told = [(rule.weight, rule.declarations) for rule in rules]
    # The element's own style wins over what is as important in the sheets.
    told.append((OWN, _declarations(element.attrib.pop("style", ""))))
    found: dict[str, tuple[bool, tuple[float, ...], str]] = {}
    for weight, declarations in told:
        for name, (value, important) in declarations.items():
            found[name] = max(found.get(name, (False, (), "")), (important, weight, value))
    # Pages have the size that their attributes say, whatever the window that they are shown in.
    skipped = PLACES if tag_of(element) == "svg" else ()
    element.attrib.update({name: last for name, (*_, last) in found.items() if name not in skipped})
    for name in PAINTING:
        if element.get(name) == "inherit":  # as without it
            del element.attrib[name]
    for child in element:
        _write(child, by_key, [*outer, element])


def _lies_in(wanted: Sequence[tuple[str, Compound]], outer: Sequence[Element]) -> bool:
    """Whether an element with some around it, from the outside, lies in what is wanted."""
    places = {len(outer)}  # where the inner one may be
    for how, compound in wanted:
        asked = {at - 1 for at in places} if how == ">" else set(range(max(places, default=0)))
        places = {at for at in asked if at >= 0 and compound.fits(outer[at])}
    return bool(places)


def _rules(text: str) -> Iterator[tuple[str, dict[str, tuple[str, bool]]]]:
    """Each selector of a style sheet and what it says of drawing; at-rules are passed over."""
    text = COMMENT.sub("", text)
    at = 0
    while (begin := text.find("{", at)) >= 0:
        head = text[at:begin]
        while head.lstrip().startswith("@") and ";" in head:  # such as @import
            head = head.partition(";")[2]
        end = _end_of_block(text, begin)
        if not head.lstrip().startswith("@"):
            declarations = _declarations(text[begin + 1 : end])
            if declarations:
                yield from ((" ".join(one.split()), declarations) for one in head.split(","))
        at = end + 1


def _end_of_block(text: str, begin: int) -> int:
    """Where the brace that opens a block is closed."""
    depth = 0
    for at in range(begin, len(text)):
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at
    return len(text)


def _declarations(text: str) -> dict[str, tuple[str, bool]]:
    """Values of properties that tell what is drawn, and whether they are important."""
    found: dict[str, tuple[str, bool]] = {}
    for declaration in text.split(";"):
        name, colon, value = declaration.partition(":")
        name = name.strip().lower()
        if not colon or name not in (*PAINTING, *PLACES):
            continue
        plain, important = IMPORTANT.subn("", value)
        if important or not found.get(name, ("", False))[1]:
            found[name] = plain.strip(), bool(important)
    return found


def _rule(selector: str, declarations: dict[str, tuple[str, bool]], place: int) -> Rule | None:
    """A rule, or None if its selector needs more than is understood."""
    parts = selector.replace(">", " > ").split()
    compounds: list[tuple[str, Compound]] = []
    how = " "
    for part in parts:
        if part == ">":
            if not compounds or how == ">":
                return None
            how = ">"
            continue
        match = SIMPLE.fullmatch(part)
        if match is None:
            return None
        compounds.append((how, Compound(match[1] or "*", frozenset(PART.findall(match[2])))))
        how = " "
    if not compounds or how == ">":
        return None
    names = [name for _, compound in compounds for name in compound.names]
    ids = sum(name.startswith("#") for name in names)
    kinds = sum(compound.tag != "*" for _, compound in compounds)
    # From the inside: how the inner one lies in the outer one stands with the inner one.
    hows = [how for how, _ in compounds[:0:-1]]
    outer = tuple(zip(hows, [compound for _, compound in compounds[-2::-1]], strict=True))
    weight = (ids, len(names) - ids, kinds, place)
    return Rule(compounds[-1][1], outer, weight, declarations)


def tag_of(element: Element) -> str:
    """What an element is, without its namespace."""
    return str(element.tag).rpartition("}")[2]


def _names(element: Element) -> frozenset[str]:
    """Id and classes of an element as selectors name them."""
    found = {f".{name}" for name in element.get("class", "").split()}
    if element.get("id"):
        found.add(f"#{element.get('id')}")
    return frozenset(found)
