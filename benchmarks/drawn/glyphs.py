"""Letters and words of the DejaVu fonts, which come with matplotlib: lines and quadratics."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from benchmarks.drawn.truth import Cubic, Line, Outline

if TYPE_CHECKING:
    from benchmarks.drawn.truth import Array, Element


def word(text: str, font: str = "Sans") -> tuple[Outline, ...]:
    """The outlines of a text in one line, in em."""
    glyphs, names, unit = _font(font)
    outlines: list[Outline] = []
    at = 0.0
    for character in text:
        name = names[ord(character)]
        outlines += _glyph(glyphs, name, np.array([at, 0.0]), unit)
        at += glyphs[name].width
    return tuple(outlines)


@cache
def _font(name: str) -> tuple[Any, dict[int, str], float]:
    import matplotlib
    from fontTools.ttLib import TTFont

    font = TTFont(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / f"DejaVu{name}.ttf")
    return font.getGlyphSet(), font.getBestCmap(), float(font["head"].unitsPerEm)


def _glyph(glyphs: Any, name: str, shift: Array, unit: float) -> list[Outline]:
    from fontTools.pens.recordingPen import DecomposingRecordingPen

    pen = DecomposingRecordingPen(glyphs)
    glyphs[name].draw(pen)
    outlines: list[Outline] = []
    elements: list[Element] = []
    first = here = np.zeros(2)
    for command, arguments in pen.value:
        given = [(np.array(a, dtype=float) + shift) / unit for a in arguments if a is not None]
        if command == "moveTo":
            elements, first, here = [], given[0], given[0]
        elif command == "lineTo":
            elements.append(Line(here, given[0]))
            here = given[0]
        elif command == "qCurveTo":
            inner = given[:-1]
            for k, q in enumerate(inner):
                to = given[-1] if k == len(inner) - 1 else 0.5 * (q + inner[k + 1])
                elements.append(Cubic(np.stack([here, (here + 2 * q) / 3, (to + 2 * q) / 3, to])))
                here = to
        elif command == "closePath":
            if np.hypot(*(here - first)) > 1e-9:
                elements.append(Line(here, first))
            outlines.append(tuple(elements))
    return outlines
