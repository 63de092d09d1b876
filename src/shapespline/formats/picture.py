"""PNG: a picture of the curves on white."""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw

from shapespline.errors import InvalidInputError
from shapespline.formats.cubics import broadest, is_whole, painted
from shapespline.geometry import sampled
from shapespline.validation import whole_number
from shapespline.values import BLACK, Stroke

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import Drawing

# Of the longer side: the border, and the width of a stroke.
MARGIN, STROKE = 0.02, 0.004
LONGER_SIDE, LARGEST_SIDE = 1024, 16_384
# Drawn larger and reduced: each pixel then has the part of it that is covered.
OVERSAMPLING = 4
# How many times as far as its sides a pointed corner of a stroke may reach, as in SVG.
MITER_LIMIT = 4.0


def encode(drawing: Drawing, *, fill: bool = True, pixels: int = LONGER_SIDE) -> bytes:
    """Bytes of a PNG picture, anti-aliased.

    Parameters
    ----------
    drawing : Drawing
        With a frame the picture shows the frame, else the curves and a margin.
    fill : bool
        Fill closed curves, black ones by the even-odd rule; otherwise they are stroked like open
        ones. Strokes of their own are drawn with them.
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
    for group in painted(drawing):
        first = group[0]
        filled = fill and drawing.is_filled(first)
        # y down
        placed = [
            scale * (lines[index] - low) * (1, -1) + (0, scale * (high[1] - low[1]))
            for index in group
        ]
        if filled:
            corner, shape = _filled(placed, size, whole=is_whole(drawing, group))
            ink.paste(drawing.colors[first] or BLACK, corner, shape)
        own, look = drawing.widths[first], drawing.strokes[first] or Stroke()
        if own is None and filled:
            continue
        wide = max(1, round(scale * (own or STROKE * longer)))
        for points in placed:
            corner, shape = _stroked(points, size, wide, None if own is None else look)
            ink.paste(look.color, corner, shape)
    picture = ink.reduce(OVERSAMPLING)
    if not any(drawing.colors) and not any(drawing.strokes):
        picture = picture.convert("L")
    out = io.BytesIO()
    picture.save(out, format="PNG", optimize=True)
    return out.getvalue()


def _part(
    rings: list[FloatArray], size: tuple[int, int], reach: float
) -> tuple[tuple[int, int], tuple[int, int]]:
    """Upper left corner and size of the part of a picture that some polylines reach into."""
    points = np.concatenate(rings)
    low = np.clip(np.floor(points.min(axis=0) - reach), 0, np.subtract(size, 1)).astype(int)
    high = np.clip(np.ceil(points.max(axis=0) + reach), low + 1, size).astype(int)
    return (int(low[0]), int(low[1])), (int(high[0] - low[0]), int(high[1] - low[1]))


def _filled(
    rings: list[FloatArray], size: tuple[int, int], *, whole: bool
) -> tuple[tuple[int, int], Image.Image]:
    """What closed polylines run around, as a mask of a part of the picture, and its corner.

    Pixels are within where the sides to their left do not cancel out, up and down; or, by the
    even-odd rule, where there is an odd number of them.
    """
    corner, (width, height) = _part(rings, size, 1.0)
    begins = np.concatenate(rings) - corner - 0.5
    ends = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings]) - corner - 0.5
    first = np.ceil(np.minimum(begins[:, 1], ends[:, 1])).astype(int)
    counts = np.ceil(np.maximum(begins[:, 1], ends[:, 1])).astype(int) - first
    side = np.repeat(np.arange(len(begins)), counts)
    row = first[side] + np.arange(len(side)) - np.repeat(np.cumsum(counts) - counts, counts)
    (x, y), (dx, dy) = begins[side].T, (ends - begins)[side].T
    column = np.ceil(x + (row - y) * dx / dy).clip(0, width).astype(int)
    shown = (row >= 0) & (row < height)
    turns = np.zeros((height, width + 1), dtype=np.int32)
    np.add.at(turns, (row[shown], column[shown]), np.where(dy > 0, 1, -1)[shown])
    within = np.cumsum(turns, axis=1)[:, :width]
    return corner, Image.fromarray((within if whole else within % 2) != 0)


def _stroked(
    points: FloatArray, size: tuple[int, int], wide: int, look: Stroke | None
) -> tuple[tuple[int, int], Image.Image]:
    """A polyline with a pen, as a mask of a part of the picture, and its corner.

    Where it bends it is round, at its corners and ends as the stroke says.
    """
    corner, part = _part([points], size, (MITER_LIMIT + 1) * 0.5 * wide + 1)
    shape, points = Image.new("1", part), points - corner
    pen, half = ImageDraw.Draw(shape), 0.5 * (wide - 1)
    if look is None:
        pen.line([(x, y) for x, y in points.tolist()], fill=1, width=wide, joint="curve")
        return corner, shape
    points = points[np.concatenate([[True], (points[1:] != points[:-1]).any(axis=1)])]
    closed = len(points) > 2 and bool((points[0] == points[-1]).all())
    steps = np.diff(points, axis=0)
    along = steps / np.hypot(*steps.T)[:, None]
    if look.cap == "square" and not closed and len(along):
        points[0] -= half * along[0]
        points[-1] += half * along[-1]
    pen.line([(x, y) for x, y in points.tolist()], fill=1, width=wide)
    rounded = [points[0], points[-1]] if look.cap == "round" and not closed else []
    before, after = (along, np.roll(along, -1, axis=0)) if closed else (along[:-1], along[1:])
    # Pillow's own joints leave gaps in wide strokes. A round one would reach beyond an end.
    ends = points[:0] if closed or look.cap == "round" else points[[0, -1]]
    for point, one, other in zip(points[1:], before, after, strict=False):
        turn = float(np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other))
        if look.join == "round" and (np.hypot(*(ends - point).T) > half).all():
            rounded.append(point)
            continue
        sides = half * -np.sign(turn) * np.array([[-one[1], one[0]], [-other[1], other[0]]])
        outer = [point, point + sides[0], point + sides[1]]
        if look.join == "miter" and math.cos(0.5 * turn) >= 1 / MITER_LIMIT:
            outer.insert(2, point + (sides[0] + sides[1]) / (1 + one @ other))
        pen.polygon([(x, y) for x, y in np.array(outer).tolist()], fill=1)
    for x, y in np.array(rounded).reshape(-1, 2).tolist():
        pen.ellipse([x - half, y - half, x + half, y + half], fill=1)
    return corner, shape


def _window(drawing: Drawing, lines: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Lower left and upper right corner of what is shown."""
    if drawing.frame is not None:
        x, y, width, height = drawing.frame
        return np.array([x, y]), np.array([x + width, y + height])
    everything = np.concatenate(lines)
    low, high = everything.min(axis=0), everything.max(axis=0)
    margin = (MARGIN + STROKE) * float((high - low).max()) + broadest(drawing)
    return low - margin, high + margin
