"""Colours: a picture as areas of few colours that share their borders."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.errors import InvalidInputError, PictureWarning, caller_level
from shapespline.geometry import signed_area
from shapespline.monitor import silent
from shapespline.tracing.border_lines import Bordering, drawn_borders
from shapespline.tracing.borders import borders_of, rings_of
from shapespline.tracing.clear_parts import on_clear
from shapespline.tracing.color_edges import Seen, node_places, softened
from shapespline.tracing.layer import Layer
from shapespline.tracing.level import noise_deviation
from shapespline.tracing.palette import MOST_COLORS, Palette, merged, palette_of
from shapespline.tracing.pixels import on_ground, validated_pixels
from shapespline.tracing.seeing import cropped, evened
from shapespline.units import PIXEL
from shapespline.validation import whole_number
from shapespline.values import Contour, Shape, ViewBox

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.monitor import Say
    from shapespline.tracing.borders import Arc, Ring
    from shapespline.tracing.lines import Line
    from shapespline.typing import ArrayLike, BoolArray, FloatArray, IntArray

# Square pixels of the smallest area of a picture without noise, and with it: so many for each part
# of the contrast that the noise is, and no more than so many.
LEAST_AREA, LEAST_NOISE_AREA, LARGEST_LEAST = 1.0, 1000.0, 200.0
# Pixels of a margin (TRC-23).
MARGIN = 2
# The contrast of the faintest edge, of 255 in a channel: what changes less may be noise.
FAINT = 60.0


class Inks(NamedTuple):
    """The colours that areas are painted with, and the label of what is clear, if anything is."""

    colors: FloatArray
    ground: int | None


def color_areas(
    image: ArrayLike,
    colors: int | str,
    *,
    min_area: float | None = None,
    blur: float | None = None,
    crop: str | Sequence[int] | None = None,
    lit: bool = False,
    say: Say = silent,
) -> Shape:
    """Areas of few colours, without gaps and without overlaps; as :func:`shapespline.trace` tells.

    Of a picture that is not taken for evenly ``lit`` the light is told first.

    What is clear is no area. Areas of fewer square pixels than ``min_area`` go to the neighbour
    with which they share most border; if it is not given, as many as the noise of the picture asks
    for, without noise none.
    """
    pixels = cropped(validated_pixels(image), crop)
    clear = on_clear(pixels)
    if clear is not None:
        pixels = clear.pixels
        colors = colors if colors == "auto" else int(colors) + 1
    else:
        pixels = _eight_bits(pixels if lit else evened(pixels, say))
    if blur:
        from scipy.ndimage import gaussian_filter

        pixels = np.rint(gaussian_filter(pixels.astype(np.float64), (blur, blur, 0))).astype(
            np.uint8
        )
    say("looking for colours")
    palette = palette_of(pixels, colors)
    noise = max(noise_deviation(Layer(pixels[:, :, k]), FAINT) for k in range(3))
    least = min_area
    if least is None:
        least = min(LEAST_AREA + LEAST_NOISE_AREA * noise / 255.0, LARGEST_LEAST)
    palette, n_merged = merged(palette, least)
    if n_merged and min_area is None:
        warnings.warn(
            f"{n_merged} areas below {least:.3g} square pixels went to their neighbours:"
            " --min-area 0 (min_area=0) keeps them",
            PictureWarning,
            stacklevel=caller_level(),
        )
    say(f"following the borders of {len(palette.colors)} colours")
    seen_colors = palette.colors if clear is None else clear.seen_colors(palette)
    ground = None if clear is None else clear.label(palette)
    size = palette.labels.shape
    pixels, palette, margin = _with_margin(pixels, palette)
    borders = borders_of(palette.labels)
    seen = softened(Seen(pixels, palette, noise), borders.nodes)
    places = node_places(seen, borders)
    arcs, rings = rings_of(borders, places.level)
    say(f"looking for the corners of {len(arcs)} borders")
    lines = drawn_borders(seen, Bordering(borders, arcs, rings, places))
    lines = [_within(line, margin, size) for line in lines]
    return _shape(rings, arcs, lines, Inks(seen_colors, ground), ViewBox(0, 0, size[1], size[0]))


def _with_margin(
    pixels: NDArray[np.uint8], palette: Palette
) -> tuple[NDArray[np.uint8], Palette, int]:
    """A picture with a margin of the colour that its four corners have, and how wide it is.

    So what ends in a pixel of the rim has a border there (TRC-23); without one colour there is no
    margin.
    """
    labels = palette.labels
    four = labels[[0, 0, -1, -1], [0, -1, 0, -1]]
    if (four != four[0]).any():
        return pixels, palette, 0
    ground = np.rint(palette.colors[four[0]]).astype(np.uint8)
    wide = np.empty((labels.shape[0] + 2 * MARGIN, labels.shape[1] + 2 * MARGIN, 3), dtype=np.uint8)
    wide[:] = ground
    wide[MARGIN:-MARGIN, MARGIN:-MARGIN] = pixels
    labels = np.pad(labels, MARGIN, constant_values=four[0])
    return wide, Palette(palette.colors, labels), MARGIN


def _within(line: Line, margin: int, size: tuple[int, ...]) -> Line:
    """A border in the picture without its margin, which ends at the rim."""
    height, width = size
    points, level_line = (
        np.clip(each - margin, 0, (width, height)) for each in (line.points, line.level_line)
    )
    return line._replace(points=points, level_line=level_line)


def checked_count(colors: int | str) -> int | str:
    """A number of colours, or "auto"."""
    if colors == "auto":
        return "auto"
    count = whole_number(int(colors) if str(colors).isdecimal() else colors)
    if count is None or not 2 <= count <= MOST_COLORS:
        raise InvalidInputError(
            f"colors must be auto or a whole number from 2 to {MOST_COLORS}, got {colors!r}"
        )
    return count


def _eight_bits(pixels: NDArray[Any]) -> NDArray[np.uint8]:
    """RGB of 8 bits, on a ground."""
    full = float(np.iinfo(pixels.dtype).max) if pixels.dtype.kind == "u" else 1.0
    if pixels.ndim == 3 and pixels.shape[2] in (2, 4):
        pixels = on_ground(pixels)
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[:, :, None], 3, axis=2)
    if pixels.dtype == np.uint8:
        return pixels
    return np.rint(np.clip(pixels / full, 0, 1) * 255).astype(np.uint8)


def _shape(
    rings: Sequence[Ring],
    arcs: Sequence[Arc],
    lines: Sequence[Line],
    inks: Inks,
    frame: ViewBox,
) -> Shape:
    """Areas by size, each with the holes in it after it; without those of what is clear."""
    outlines = [ring.outline([line.points for line in lines], arcs) for ring in rings]
    areas = np.array([signed_area(points) for points in outlines])
    labels = np.array([ring.label for ring in rings])
    owner = _owners(labels, outlines, areas)
    contours: list[Contour] = []
    parents: list[int] = []
    colors: list[str | None] = []
    for index in np.argsort(-areas, kind="stable").tolist():
        if areas[index] <= 0:
            break
        if labels[index] == inks.ground:
            continue
        around = len(contours)
        color = "#" + "".join(f"{round(value):02x}" for value in inks.colors[labels[index]])
        for ring in [index, *np.flatnonzero(owner == index).tolist()]:
            level = rings[ring].outline([line.level_line for line in lines], arcs)
            contours.append(
                Contour(
                    _without_repeats(outlines[ring]),
                    closed=True,
                    accuracy=max(lines[half].accuracy for half, _ in rings[ring].halves),
                    level_line=_without_repeats(level),
                )
            )
            parents.append(-1 if ring == index else around)
            colors.append(color if ring == index else None)
    return Shape(contours, parents, frame, PIXEL, colors=colors)


def _owners(labels: IntArray, outlines: Sequence[FloatArray], areas: FloatArray) -> IntArray:
    """For each hole the smallest area of its label around it; -1 for outlines of areas."""
    low = np.array([points.min(axis=0) for points in outlines])
    high = np.array([points.max(axis=0) for points in outlines])
    owner = np.full(len(labels), -1)
    for hole in np.flatnonzero(areas <= 0).tolist():
        around = (areas > 0) & (labels == labels[hole])
        around &= (low <= low[hole]).all(axis=1) & (high >= high[hole]).all(axis=1)
        witnesses = outlines[hole][:: max(1, len(outlines[hole]) // 9)]
        for index in sorted(np.flatnonzero(around).tolist(), key=lambda k: areas[k]):
            if 2 * _inside(witnesses, outlines[index]).sum() > len(witnesses):
                owner[hole] = index
                break
    return owner


def _inside(points: FloatArray, polygon: FloatArray) -> BoolArray:
    """Even-odd rule."""
    a, b = polygon, np.roll(polygon, -1, axis=0)
    x, y = points[:, 0, None], points[:, 1, None]
    spans = (a[:, 1] > y) != (b[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return np.asarray((spans & (x < at)).sum(axis=1) % 2 == 1)


def _without_repeats(points: FloatArray) -> FloatArray:
    """Points without those equal to the one before, which would be dropped with a warning."""
    return points[(points != np.roll(points, 1, axis=0)).any(axis=1)]
