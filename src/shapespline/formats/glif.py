"""GLIF: one glyph of a font in UFO, its curves exact (https://unifiedfontobject.org)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats.pens import draw_with_pen, outlines_of
from shapespline.validation import is_number

if TYPE_CHECKING:
    from pathlib import Path

    from shapespline.geometry import Outlines
    from shapespline.values import Drawing

FORMAT_VERSION = 2


class _Glyph:
    """What the reader and the writer of fontTools hang the properties of a glyph on."""

    width: float = 0.0
    unicodes: tuple[int, ...] = ()


def read(path: Path) -> Outlines:
    """The outlines of a glyph; components come from the UFO that the file lies in.

    Parameters
    ----------
    path : Path

    Raises
    ------
    FormatError
        If the file is no GLIF, or draws nothing.
    """
    from fontTools.pens.pointPen import PointToSegmentPen
    from fontTools.pens.recordingPen import RecordingPointPen
    from fontTools.ufoLib.errors import GlifLibError, UFOLibError
    from fontTools.ufoLib.glifLib import GlyphSet, readGlyphFromString

    points = RecordingPointPen()
    try:
        readGlyphFromString(path.read_text(encoding="utf-8"), _Glyph(), points)
        beside = GlyphSet(path.parent) if (path.parent / "contents.plist").exists() else {}
    except (GlifLibError, UFOLibError, ValueError, LookupError, TypeError, SyntaxError) as error:
        raise FormatError(f"no glyph in GLIF: {error}") from error

    class Drawn:
        """What was read, as something that draws itself."""

        def draw(self, pen: object) -> None:
            points.replay(PointToSegmentPen(pen))

    return outlines_of(Drawn(), beside)


def encode(
    drawing: Drawing,
    *,
    glyph: str = "glyph",
    advance: float | None = None,
    codepoint: str | None = None,
    clockwise: bool = False,
) -> bytes:
    """One glyph: a path for each curve, lines, quadratics and cubics as they are.

    Parameters
    ----------
    drawing : Drawing
    glyph : str
        Its name.
    advance : float, optional
        Its advance width, data units; where the outlines end in x if not given.
    codepoint : str, optional
        The character that it stands for.
    clockwise : bool
        Whether outer outlines run clockwise, as in TrueType.

    Raises
    ------
    InvalidInputError
        If the name is empty, ``codepoint`` is not one character, or the width is negative.
    """
    from fontTools.pens.pointPen import SegmentToPointPen
    from fontTools.ufoLib.glifLib import writeGlyphToString

    if not (isinstance(glyph, str) and glyph):
        raise InvalidInputError(f"glyph must be a name such as 'A', got {glyph!r}")
    if codepoint is not None and not (isinstance(codepoint, str) and len(codepoint) == 1):
        raise InvalidInputError(f"codepoint must be one character, got {codepoint!r}")
    held = _Glyph()
    width = max(float(drawing.bounds.x_max), 0.0) if advance is None else advance
    if not (is_number(width) and 0.0 <= width < float("inf")):
        raise InvalidInputError(f"advance must be a number, 0 or more, got {advance!r}")
    held.width = float(width)
    held.unicodes = () if codepoint is None else (ord(codepoint),)
    text = writeGlyphToString(
        glyph,
        held,
        lambda pen: draw_with_pen(drawing, SegmentToPointPen(pen), clockwise=clockwise),
        formatVersion=FORMAT_VERSION,
    )
    return text.encode("utf-8")
