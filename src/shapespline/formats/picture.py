"""PNG: a picture of the curves, black on white."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageChops, ImageDraw

from shapespline.errors import InvalidInputError
from shapespline.formats.cubics import groups
from shapespline.geometry import sampled
from shapespline.validation import whole_number

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import Drawing

# Of the longer side: the border, and the width of a stroke.
MARGIN, STROKE = 0.02, 0.004
LONGER_SIDE, LARGEST_SIDE = 1024, 16_384
# Drawn larger and reduced: each pixel then has the part of it that is covered.
OVERSAMPLING = 4


def encode(drawing: Drawing, *, fill: bool = True, pixels: int = LONGER_SIDE) -> bytes:
    """Bytes of a PNG picture, anti-aliased.

    Parameters
    ----------
    drawing : Drawing
        With a frame the picture shows the frame, else the curves and a margin.
    fill : bool
        Fill closed curves by the even-odd rule; otherwise they are stroked like open ones.
    pixels : int
        Pixels of the longer side, up to 16 384.

    Raises
    ------
    InvalidInputError
        If ``pixels`` is out of range.
    """
    longest = whole_number(pixels)
    if longest is None or not 1 <= longest <= LARGEST_SIDE:
        raise InvalidInputError(
            f"pixels must be a whole number from 1 to {LARGEST_SIDE}, got {pixels!r}"
        )
    lines = [sampled(fit.spline)[0].polyline for fit in drawing]
    low, high = _window(drawing, lines)
    longer = float((high - low).max())
    scale = OVERSAMPLING * longest / longer
    width, height = (
        int(np.ceil(side * longest / longer)) * OVERSAMPLING for side in (high - low).tolist()
    )
    size = (width, height)
    ink = Image.new("RGB", size, "white")
    for group in groups(drawing):
        filled = fill and drawing.is_area(group[0])
        shape = Image.new("1", size)
        for index in group:
            part = Image.new("1", size)
            points = scale * (lines[index] - low)
            at = [(float(x), float(scale * (high[1] - low[1]) - y)) for x, y in points]
            if filled:
                ImageDraw.Draw(part).polygon(at, fill=1)
                shape = ImageChops.logical_xor(shape, part)
            else:
                own = drawing.widths[index]
                _draw_stroke(part, at, scale * (own or STROKE * longer), is_round=own is not None)
                shape = ImageChops.logical_or(shape, part)
        ink.paste(drawing.colors[group[0]] or "black", mask=shape)
    picture = ink.reduce(OVERSAMPLING)
    if not any(drawing.colors):
        picture = picture.convert("L")
    out = io.BytesIO()
    picture.save(out, format="PNG", optimize=True)
    return out.getvalue()


def _draw_stroke(
    part: Image.Image, at: list[tuple[float, float]], width: float, *, is_round: bool
) -> None:
    pen, wide = ImageDraw.Draw(part), max(1, round(width))
    pen.line(at, fill=1, width=wide, joint=None if is_round else "curve")
    half = 0.5 * (wide - 1)
    for x, y in at if is_round else ():  # Pillow's own joints leave gaps in wide strokes
        pen.ellipse([x - half, y - half, x + half, y + half], fill=1)


def _window(drawing: Drawing, lines: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Lower left and upper right corner of what is shown."""
    if drawing.frame is not None:
        x, y, width, height = drawing.frame
        return np.array([x, y]), np.array([x + width, y + height])
    everything = np.concatenate(lines)
    low, high = everything.min(axis=0), everything.max(axis=0)
    margin = (MARGIN + STROKE) * float((high - low).max())
    return low - margin, high + margin
