"""Colours: a picture as areas of few colours that share their borders."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import InvalidInputError, PictureWarning, caller_level
from shapespline.geometry import signed_area
from shapespline.monitor import silent
from shapespline.tracing.border_lines import Bordering, NodePlaces, drawn_borders
from shapespline.tracing.borders import OUTSIDE, Borders, borders_of, rings_of
from shapespline.tracing.edges import EVEN, EVEN_NOISE, FARTHEST, REACH, places_across
from shapespline.tracing.layer import Layer
from shapespline.tracing.level import noise_deviation
from shapespline.tracing.lines import DRAWN_ACCURACY
from shapespline.tracing.palette import MOST_COLORS, Palette, merged, palette_of
from shapespline.tracing.pixels import on_ground, validated_pixels
from shapespline.tracing.seeing import cropped
from shapespline.units import PIXEL
from shapespline.validation import whole_number
from shapespline.values import Contour, Shape, ViewBox

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.monitor import Say
    from shapespline.typing import ArrayLike, BoolArray, FloatArray, IntArray

# Square pixels of the smallest area of a picture without noise, and with it: so many for each part
# of the contrast that the noise is, and no more than so many.
LEAST_AREA, LEAST_NOISE_AREA, LARGEST_LEAST = 1.0, 1000.0, 200.0
# The contrast of the faintest edge, of 255 in a channel: what changes less may be noise.
FAINT = 60.0
# A border's crossings are no nearer to a pixel's centre than this while its course is told.
INNER = 0.02


def color_areas(
    image: ArrayLike,
    colors: int | str,
    *,
    min_area: float | None = None,
    blur: float | None = None,
    crop: str | Sequence[int] | None = None,
    say: Say = silent,
) -> Shape:
    """Areas of few colours, without gaps and without overlaps; as :func:`shapespline.trace` tells.

    Areas of fewer square pixels than ``min_area`` go to the neighbour with which they share most
    border; if it is not given, as many as the noise of the picture asks for, without noise none.
    """
    pixels = _eight_bits(cropped(validated_pixels(image), crop))
    if blur:
        from scipy.ndimage import gaussian_filter

        pixels = np.rint(gaussian_filter(pixels.astype(np.float64), (blur, blur, 0))).astype(
            np.uint8
        )
    say("looking for colours")
    palette = palette_of(pixels, colors)
    noise = max(noise_deviation(Layer(pixels[:, :, k]), FAINT) for k in range(3)) / 255.0
    least = min_area
    if least is None:
        least = min(LEAST_AREA + LEAST_NOISE_AREA * noise, LARGEST_LEAST)
    palette, n_merged = merged(palette, least)
    if n_merged and min_area is None:
        warnings.warn(
            f"{n_merged} areas below {least:.3g} square pixels went to their neighbours:"
            " --min-area 0 (min_area=0) keeps them",
            PictureWarning,
            stacklevel=caller_level(),
        )
    say(f"following the borders of {len(palette.colors)} colours")
    borders = borders_of(palette.labels)
    found = _places(pixels, palette, borders, noise)
    arcs, rings = rings_of(borders, found.level)
    say(f"looking for the corners of {len(arcs)} borders")
    lines = drawn_borders(pixels, palette, Bordering(borders, arcs, rings, found), noise)
    return _shape([ring.label for ring in rings],
                  [ring.outline(lines, arcs) for ring in rings], palette)  # fmt: skip


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


def _places(
    pixels: NDArray[np.uint8], palette: Palette, borders: Borders, noise: float
) -> NodePlaces:
    """Places of nodes, junctions and corners."""
    nodes = borders.nodes
    height, width = palette.labels.shape
    rim = (nodes.first == OUTSIDE) | (nodes.second == OUTSIDE)
    level, drawn = np.full(len(rim), 0.5), np.full(len(rim), 0.5)
    known = np.zeros(len(rim), dtype=bool)
    for chunk in np.array_split(np.flatnonzero(~rim), (~rim).sum() // 100_000 + 1):
        across, step = _across(pixels, palette, borders, chunk)
        first, second = across[:, REACH - 1] - 0.5, across[:, REACH] - 0.5
        told = (first < 0) & (second > 0)
        share = np.where(told, first / np.where(told, first - second, 1.0), 0.5)
        level[chunk] = np.clip(share, INNER, 1 - INNER)
        ahead = places_across(across, EVEN + EVEN_NOISE * noise * 255.0 / step) - REACH + 0.5
        moved = np.abs(ahead - share) <= FARTHEST
        known[chunk] = moved & told
        drawn[chunk] = np.where(known[chunk], ahead, share)
    found = []
    for shares in (level, drawn):
        x = nodes.column + 0.5 + np.where(nodes.upright, 0.0, shares)
        y = height - (nodes.row + 0.5 + np.where(nodes.upright, shares, 0.0))
        own = np.clip(np.column_stack([x, y]), 0, (width, height))
        junctions = [_junction(own, four, rim, (width, height)) for four in borders.cells]
        found.append(np.concatenate([own, _pairs(junctions), _pairs(borders.corners)]))
    return NodePlaces(found[0], found[1], np.pad(known, (0, len(found[0]) - len(known))))


def _junction(
    places: FloatArray, four: Sequence[int], rim: BoolArray, size: tuple[int, int]
) -> FloatArray:
    """Where the borders of a cell meet: in their middle, or where one of them meets the rim."""
    there = [node for node in four if node >= 0]
    inner = [node for node in there if not rim[node]]
    if len(inner) == len(there) or not inner:
        return np.asarray(places[there].mean(axis=0))
    outer = places[next(node for node in there if rim[node])]
    on_side = (outer == 0) | (outer == size)
    return np.where(on_side, outer, places[inner].mean(axis=0))


def _pairs(points: Sequence[Any]) -> FloatArray:
    return np.array(points, dtype=np.float64).reshape(-1, 2)


def _across(
    pixels: NDArray[np.uint8], palette: Palette, borders: Borders, chunk: NDArray[np.int64]
) -> tuple[FloatArray, float]:
    """How far each pixel across borders is from the first colour to the second, 0 to 1."""
    nodes = borders.nodes
    height, width = palette.labels.shape
    offsets = np.arange(1 - REACH, REACH + 1)
    upright = nodes.upright[chunk, None]
    row = np.clip(nodes.row[chunk, None] + np.where(upright, offsets, 0), 0, height - 1)
    column = np.clip(nodes.column[chunk, None] + np.where(upright, 0, offsets), 0, width - 1)
    a, b = palette.colors[nodes.first[chunk]], palette.colors[nodes.second[chunk]]
    along = b - a
    length = np.maximum((along**2).sum(axis=1), 1.0)
    seen = pixels[row, column].astype(np.float64) - a[:, None]
    across = (seen * along[:, None]).sum(axis=2) / length[:, None]
    return across, float(np.sqrt(np.median(length)))


def _shape(labels: Sequence[int], outlines: Sequence[FloatArray], palette: Palette) -> Shape:
    """Areas by size, each with the holes in it after it."""
    height, width = palette.labels.shape
    areas = np.array([signed_area(points) for points in outlines])
    owner = _owners(np.array(labels), outlines, areas)
    contours: list[Contour] = []
    parents: list[int] = []
    colors: list[str | None] = []
    for index in np.argsort(-areas, kind="stable").tolist():
        if areas[index] <= 0:
            break
        around = len(contours)
        color = "#" + "".join(f"{round(value):02x}" for value in palette.colors[labels[index]])
        for ring in [index, *np.flatnonzero(owner == index).tolist()]:
            own = _without_repeats(outlines[ring])
            contours.append(Contour(own, closed=True, accuracy=DRAWN_ACCURACY))
            parents.append(-1 if ring == index else around)
            colors.append(color if ring == index else None)
    return Shape(contours, parents, ViewBox(0, 0, width, height), PIXEL, colors=colors)


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
