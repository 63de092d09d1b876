"""Glyphs: curves drawn with pens of fontTools, and those that a glyph draws (the segment protocol).

A pen is told moveTo, lineTo, curveTo (cubic), qCurveTo (quadratic, points between implied) and
closePath or endPath. Whatever has ``draw(pen)`` is a glyph: of a font file, a UFO, an editor.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import FormatError, SkippedContentWarning, caller_level, require
from shapespline.formats.cubics import as_cubics, elevated, is_straight
from shapespline.formats.pieces import bezier, closed_up
from shapespline.geometry import Outlines, as_drawing, signed_area

if TYPE_CHECKING:
    from collections.abc import Iterable

    from shapespline.geometry import Drawable
    from shapespline.typing import FloatArray
    from shapespline.values import Fit, Piece


def draw_with_pen(value: Drawable, pen: Any, *, clockwise: bool = False) -> None:
    """What `Exchanged.draw` does."""
    drawing = as_drawing(value)
    for index, fit in enumerate(drawing):
        beziers = _beziers(fit)
        if fit.closed:
            points = np.concatenate([piece[:-1] for piece in beziers])
            if (signed_area(points) < 0) != (clockwise != drawing.is_hole(index)):
                beziers = [piece[::-1] for piece in reversed(beziers)]
        _draw(beziers, pen, closed=fit.closed)


def _beziers(fit: Fit) -> list[FloatArray]:
    """Lines, quadratics and cubics of a fit, end to end."""
    if fit.degree == 2:
        pieces = list(fit.spline.beziers().points)
        if fit.closed:
            pieces[-1] = np.concatenate([pieces[-1][:-1], pieces[0][:1]])
        cubics = elevated(np.array(pieces))
    else:
        pieces = list(as_cubics(fit))
        cubics = np.array(pieces)
    return [
        piece[[0, -1]] if is_straight(cubic) else piece
        for piece, cubic in zip(pieces, cubics, strict=True)
    ]


def _draw(beziers: list[FloatArray], pen: Any, *, closed: bool) -> None:
    pen.moveTo(_pair(beziers[0][0]))
    for number, piece in enumerate(beziers):
        inner = [_pair(point) for point in piece[1:]]
        if len(inner) == 1:
            # The line that closes a path is drawn by closing it.
            if not (closed and number == len(beziers) - 1):
                pen.lineTo(inner[0])
        elif len(inner) == 2:
            pen.qCurveTo(*inner)
        else:
            pen.curveTo(*inner)
    if closed:
        pen.closePath()
    else:
        pen.endPath()


def _pair(point: FloatArray) -> tuple[float, float]:
    x, y = point.tolist()
    return x, y


def outlines_of(glyph: Any, glyph_set: Any = None) -> Outlines:
    """The curves that a glyph draws, exactly.

    Parameters
    ----------
    glyph : object
        With ``draw(pen)``.
    glyph_set : mapping, optional
        The glyphs that components name; that of the glyph if it knows one.

    Raises
    ------
    FormatError
        If it draws nothing.
    MissingExtraError
        Without fontTools.

    Warns
    -----
    SkippedContentWarning
        If components are in no glyph set: those are left out.
    """
    require("fontTools.pens", "fonts", "glyphs need")
    from fontTools.pens.basePen import MissingComponentError
    from fontTools.pens.recordingPen import DecomposingRecordingPen, RecordingPen

    known = getattr(glyph, "glyphSet", {}) if glyph_set is None else glyph_set
    pen = DecomposingRecordingPen(known)
    try:
        glyph.draw(pen)
    except MissingComponentError as error:
        warnings.warn(
            f"components are left out, {error} is in no glyph set; pass glyph_set=font",
            SkippedContentWarning,
            stacklevel=caller_level(),
        )
        pen = RecordingPen()
        glyph.draw(pen)
    curves = [pieces for pieces in _curves(pen.value) if pieces]
    if not curves:
        raise FormatError("the glyph draws no outline")
    return Outlines(curves)


def _curves(told: Iterable[tuple[str, tuple[Any, ...]]]) -> list[list[Piece]]:
    """Pieces of every path that a pen was told."""
    from fontTools.pens.basePen import decomposeQuadraticSegment, decomposeSuperBezierSegment

    found: list[list[Piece]] = []
    pieces: list[Piece] = []
    start = at = (0.0, 0.0)
    for verb, points in told:
        if verb == "moveTo":
            start = at = points[0]
        elif verb == "lineTo":
            pieces.append(bezier([at, points[0]]))
        elif verb == "curveTo" and len(points) > 3:
            for segment in decomposeSuperBezierSegment(points):
                pieces.append(bezier([at, *segment]))
                at = segment[-1]
        elif verb == "curveTo":
            pieces.append(bezier([at, *points]))
        elif verb == "qCurveTo":
            ring = points
            if points[-1] is None:  # no point on the curve: it passes between two that are off it
                (ax, ay), (bx, by) = points[0], points[-2]
                start = at = (0.5 * (ax + bx), 0.5 * (ay + by))
                ring = (*points[:-1], start)
            for segment in decomposeQuadraticSegment(ring):
                pieces.append(bezier([at, *segment]))
                at = segment[-1]
        elif verb in ("closePath", "endPath"):
            if verb == "closePath" and at != start:
                pieces.append(bezier([at, start]))
            found.append(closed_up(pieces))
            pieces = []
        if verb in ("lineTo", "curveTo"):
            at = points[-1]
    return found
