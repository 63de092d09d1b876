"""Borders between areas of colours as they were drawn, corners included: each once, for both sides.

The same as for outlines of one colour (:mod:`shapespline.tracing.lines`,
:mod:`shapespline.tracing.corners`), but of lines from junction to junction, whose ends stay.
Whether a corner was drawn is told by the colours around it: those of the areas add up to them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.borders import OUTSIDE
from shapespline.tracing.corners import (
    AROUND,
    UNCERTAIN,
    around,
    put_back,
    rounded_off,
)
from shapespline.tracing.coverage import border_coverage
from shapespline.tracing.lines import MOST

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.tracing.borders import Arc, Borders, Ring
    from shapespline.tracing.palette import Palette
    from shapespline.tracing.sides import Corners
    from shapespline.typing import BoolArray, FloatArray


class NodePlaces(NamedTuple):
    """Places of nodes, junctions and corners of the picture: between pixel centres, and as drawn.

    ``known`` says of which the grey tells where they were drawn.
    """

    level: FloatArray
    drawn: FloatArray
    known: BoolArray


class Bordering(NamedTuple):
    """Borders of the areas of a picture, and where they lie."""

    borders: Borders
    arcs: list[Arc]
    rings: list[Ring]
    places: NodePlaces


def drawn_borders(
    pixels: NDArray[np.uint8], palette: Palette, found: Bordering, noise: float
) -> list[FloatArray]:
    """Points of each arc, of a closed one without its last node.

    Parameters
    ----------
    pixels : ndarray of uint8, shape (h, w, 3)
    palette : Palette
    found : Bordering
    noise : float
        Standard deviation of the pixels, of 1.
    """
    closed = [arc.is_ring for arc in found.arcs]
    lines, levels, drawn = [], [], []
    for arc in found.arcs:
        path = np.array(arc.path[:-1] if arc.is_ring else arc.path)
        certain = OUTSIDE not in (arc.left, arc.right)
        certain = certain and bool(found.places.known[path].mean() > MOST)
        lines.append(found.places.drawn[path])
        levels.append(found.places.level[path])
        drawn.append(certain)

    def fit(corners: Corners, tried: Sequence[FloatArray]) -> BoolArray:
        missing, step = _missing(corners, tried, found, pixels, palette)
        uncertain = UNCERTAIN + 3 * (2 * AROUND + 1) * noise * 255.0 / step
        return np.abs(missing) <= uncertain + rounded_off(corners)

    return put_back(lines, levels, drawn, closed, fit)


def _missing(
    corners: Corners,
    lines: Sequence[FloatArray],
    found: Bordering,
    pixels: NDArray[np.uint8],
    palette: Palette,
) -> tuple[FloatArray, FloatArray]:
    """Square pixels of the left colour that the picture has around corners and the areas do not.

    And how far apart the two colours are, of 255 in each channel.
    """
    height, width = palette.labels.shape
    keys, mixed = _colours(lines, found, palette)
    r, c, inside = around(corners.points, palette.labels.shape)
    r_in, c_in = np.clip(r, 0, height - 1), np.clip(c, 0, width - 1)
    key = r_in * width + c_in
    place = np.minimum(np.searchsorted(keys, key), len(keys) - 1)
    flat = palette.colors[palette.labels[r_in, c_in]]
    ours = np.where((keys[place] == key)[..., None], mixed[place], flat)
    sides = [(found.arcs[k].left, found.arcs[k].right) for k in corners.own.tolist()]
    left, right = (palette.colors[list(labels)] for labels in zip(*sides, strict=True))
    along = left - right
    step = np.maximum(np.sqrt((along**2).sum(axis=1)), 1.0)
    off = ((pixels[r_in, c_in] - ours) * along[:, None, None]).sum(axis=-1)
    return np.where(inside, off, 0.0).sum(axis=(1, 2)) / step**2, step


def _colours(
    lines: Sequence[FloatArray], found: Bordering, palette: Palette
) -> tuple[NDArray[np.int64], FloatArray]:
    """Pixels that borders pass through, row times width plus column; the colours that they mix."""
    height, width = palette.labels.shape
    every, colours = [], []
    for label in sorted({ring.label for ring in found.rings}):
        own = [ring.outline(lines, found.arcs) for ring in found.rings if ring.label == label]
        keys, part, _ = border_coverage(own, height, width)
        every.append(keys)
        colours.append(part[:, None] * palette.colors[label])
    unique, place = np.unique(np.concatenate(every), return_inverse=True)
    weights = np.concatenate(colours)
    mixed = [np.bincount(place, weights[:, k], len(unique)) for k in range(3)]
    return unique, np.stack(mixed, axis=1)
