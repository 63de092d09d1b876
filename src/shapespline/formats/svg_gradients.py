"""Gradients of an SVG: the one colour that an area has in their place."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING

from shapespline.formats.svg_paint import color_and_opacity, share
from shapespline.formats.svg_styles import tag_of

if TYPE_CHECKING:
    from collections.abc import Mapping
    from xml.etree.ElementTree import Element

GRADIENTS = ("linearGradient", "radialGradient")
REFERENCE = re.compile(r"url\(\s*['\"]?#([^'\")]+)['\"]?\s*\)")
HREFS = ("href", "{http://www.w3.org/1999/xlink}href")
# Gradients that take their stops from others, one after the other.
MOST_REFERENCES = 16


def mean_color(paint: str, ids: Mapping[str, Element]) -> tuple[str, float] | None:
    """The mean colour of the gradient that a fill or a stroke refers to, and how opaque it is.

    Of its stops along the gradient; where they are transparent they count less. None if it refers
    to no gradient with stops.
    """
    match = REFERENCE.match(paint.strip())
    found = _stops(ids.get(match[1]), ids) if match else []
    if not found:
        return None
    # To the first stop and from the last one on the colour stays.
    ends = [(0.0, *found[0][1:]), *found, (1.0, *found[-1][1:])]
    total, parts = 0.0, [0.0, 0.0, 0.0]
    for (at, color, opacity), (to, other, further) in pairwise(ends):
        for tone, much in ((color, opacity), (other, further)):
            weight = 0.5 * max(to - at, 0.0) * much
            total += weight
            parts = [part + weight * one for part, one in zip(parts, tone, strict=True)]
    if total == 0.0:
        return "#000000", 0.0
    return "#" + "".join(f"{round(part / total):02x}" for part in parts), min(total, 1.0)


def _stops(
    gradient: Element | None, ids: Mapping[str, Element]
) -> list[tuple[float, bytes, float]]:
    """Offset, colour and opacity of each stop, those of another gradient if it has none."""
    for _ in range(MOST_REFERENCES):
        if gradient is None or tag_of(gradient) not in GRADIENTS:
            return []
        found: list[tuple[float, bytes, float]] = []
        for stop in gradient:
            if tag_of(stop) != "stop":
                continue
            color, opacity = color_and_opacity(stop.attrib, "stop-color", "black")
            opacity *= share(stop.attrib, "stop-opacity", 1.0)
            at = max(share(stop.attrib, "offset", 0.0), found[-1][0] if found else 0.0)
            found.append((at, bytes.fromhex((color or "#000000")[1:]), opacity if color else 0.0))
        if found:
            return found
        target = next((gradient.get(name) for name in HREFS if gradient.get(name)), "") or ""
        gradient = ids.get(target.removeprefix("#"))
    return []
