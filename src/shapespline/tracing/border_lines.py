"""Borders between areas of colours as they were drawn, corners included: each once, for both sides.

The same as for outlines of one colour (:mod:`shapespline.tracing.lines`,
:mod:`shapespline.tracing.corners`), but of lines from junction to junction, whose ends stay.
Whether a corner was drawn is told by the colours around it: those of the areas add up to them.
"""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.borders import OUTSIDE
from shapespline.tracing.corners import (
    AROUND,
    TOGETHER,
    UNCERTAIN,
    UNCERTAIN_BLUR,
    around,
    put_back,
    rounded_off,
)
from shapespline.tracing.coverage import border_coverage
from shapespline.tracing.lines import DRAWN_ACCURACY, MOST
from shapespline.tracing.sides import BLURRED

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.borders import Arc, Borders, Ring
    from shapespline.tracing.color_edges import NodePlaces, Seen
    from shapespline.tracing.sides import Corners
    from shapespline.typing import BoolArray, FloatArray, IntArray


class Bordering(NamedTuple):
    """Borders of the areas of a picture, and where they lie."""

    borders: Borders
    arcs: list[Arc]
    rings: list[Ring]
    places: NodePlaces


class BorderLine(NamedTuple):
    """A border as it was drawn, its level line, and how accurate it is."""

    points: FloatArray
    level_line: FloatArray
    accuracy: float


def drawn_borders(seen: Seen, found: Bordering) -> list[BorderLine]:
    """Points of each arc, of a closed one without its last node."""
    closed = [arc.is_ring for arc in found.arcs]
    lines, levels, certain, accuracies = [], [], [], []
    soft = seen.soft
    for arc in found.arcs:
        path = np.array(arc.path[:-1] if arc.is_ring else arc.path)
        lines.append(found.places.drawn[path])
        levels.append(found.places.level[path])
        at_rim = OUTSIDE in (arc.left, arc.right)
        known = at_rim or bool(found.places.known[path].mean() > MOST)
        certain.append(not at_rim and (known or soft.shows_corners(_noise(seen, arc))))
        accuracies.append(DRAWN_ACCURACY if known else soft.accuracy)
    reach = AROUND + round(soft.blur)
    sure = UNCERTAIN + UNCERTAIN_BLUR * soft.blur

    def fit(corners: Corners, tried: Sequence[FloatArray]) -> BoolArray:
        first, second = _sides(corners, found)
        axis = seen.axis(first, second)
        uncertain = sure + 3 * (2 * reach + 1) * seen.noise_along(axis)
        missing = _missing(corners.points, tried, found, seen, first, axis, reach)
        return np.asarray(np.abs(missing) <= uncertain + rounded_off(corners))

    points = put_back(lines, levels, certain, closed, fit, soft)
    return [BorderLine(*line) for line in zip(points, levels, accuracies, strict=True)]


def _noise(seen: Seen, arc: Arc) -> float:
    """Of the contrast of its two sides."""
    return float(seen.noise_along(seen.axis(np.array([arc.left]), np.array([arc.right])))[0])


def _sides(corners: Corners, found: Bordering) -> tuple[IntArray, IntArray]:
    """Labels on the right and on the left of corners."""
    sides = np.array([(found.arcs[k].right, found.arcs[k].left) for k in corners.own.tolist()])
    return sides.reshape(-1, 2)[:, 0], sides.reshape(-1, 2)[:, 1]


def _missing(
    at: FloatArray,
    lines: Sequence[FloatArray],
    found: Bordering,
    seen: Seen,
    first: IntArray,
    axis: FloatArray,
    reach: int,
) -> FloatArray:
    """Square pixels of the left colour that the picture has around corners and the areas do not."""
    height, width = seen.size
    colors, blur = seen.palette.colors, seen.soft.blur
    margin = ceil(BLURRED * blur)
    shown = (slice(None), *(slice(margin, margin + 2 * reach + 1),) * 2)
    covered = {
        label: border_coverage(
            [ring.outline(lines, found.arcs) for ring in found.rings if ring.label == label],
            height,
            width,
        )
        for label in sorted({ring.label for ring in found.rings})
    }
    missing = []
    for some in np.array_split(np.arange(len(at)), len(at) // TOGETHER + 1):
        r, c, inside = around(at[some], seen.size, reach + margin)
        r, c = np.clip(r, 0, height - 1), np.clip(c, 0, width - 1)
        ground, own = colors[first[some]], axis[some]
        ours = np.zeros(r.shape)
        for label, cover in covered.items():
            share = ((colors[label] - ground) * own).sum(axis=1)
            ours += cover.at(r, c, width) * share[:, None, None]
        if blur:
            from scipy.ndimage import gaussian_filter  # which takes a while to load

            ours = gaussian_filter(ours, blur, axes=(1, 2), radius=margin)
        values = seen.pixels[r[shown], c[shown]] - ground[:, None, None]
        off = (values * own[:, None, None]).sum(axis=-1) - ours[shown]
        missing.append(np.where(inside[shown], off, 0.0).sum(axis=(1, 2)))
    return np.concatenate(missing)
