"""Borders between areas of colours as they were drawn, corners included: each once, for both sides.

The same as for outlines of one colour (:mod:`shapespline.tracing.lines`,
:mod:`shapespline.tracing.corners`), but of lines from junction to junction, whose ends stay.
Whether a corner was drawn is told by the colours around it: those of the areas add up to them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.borders import OUTSIDE
from shapespline.tracing.corners import missing_around, put_back
from shapespline.tracing.coverage import border_coverage
from shapespline.tracing.grain import without_grain
from shapespline.tracing.lines import DRAWN_ACCURACY, MOST, Line

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.borders import Arc, Borders, Ring
    from shapespline.tracing.color_edges import NodePlaces, Seen
    from shapespline.tracing.corners import Missing
    from shapespline.tracing.sides import Corners
    from shapespline.tracing.softness import Softness
    from shapespline.typing import BoolArray, FloatArray, IntArray


class Bordering(NamedTuple):
    """Borders of the areas of a picture, and where they lie."""

    borders: Borders
    arcs: list[Arc]
    rings: list[Ring]
    places: NodePlaces


def drawn_borders(seen: Seen, found: Bordering) -> list[Line]:
    """Points of each arc, of a closed one without its last node."""
    closed = [arc.is_ring for arc in found.arcs]
    lines, levels, certain, accuracies = [], [], [], []
    soft = seen.soft
    for arc in found.arcs:
        path = np.array(arc.path[:-1] if arc.is_ring else arc.path)
        line = found.places.drawn[path]
        levels.append(found.places.level[path])
        at_rim = OUTSIDE in (arc.left, arc.right)
        if soft.grainy and not at_rim:
            line = _averaged(line, path, soft.scattered_by(_noise(seen, arc)), found.borders)
        lines.append(line)
        known = at_rim or bool(found.places.known[path].mean() > MOST)
        certain.append(not at_rim and (known or soft.shows_corners(_noise(seen, arc))))
        accuracies.append(DRAWN_ACCURACY if known else soft.accuracy)

    def fit(corners: Corners, tried: Sequence[FloatArray], soft: Softness) -> BoolArray:
        first, second = _sides(corners, found)
        axis = seen.axis(first, second)
        missing = _missing(corners.points, tried, found, seen, first, axis)
        return missing.fits(corners, soft, seen.noise_along(axis))

    points = put_back(lines, levels, certain, closed, fit, soft)
    return [Line(*line) for line in zip(points, levels, accuracies, strict=True)]


def _averaged(line: FloatArray, path: IntArray, scatter: float, borders: Borders) -> FloatArray:
    """Without most of its noise; junctions stay, at which what is open ends."""
    stay = path >= len(borders.nodes.row)
    upright = borders.nodes.upright[np.where(stay, 0, path)]
    return without_grain(line, upright, scatter, stay)


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
) -> Missing:
    """What of the left colour the picture has around corners and the areas do not."""
    colors = seen.palette.colors
    ground = colors[first]
    covered = {
        label: border_coverage(
            [ring.outline(lines, found.arcs) for ring in found.rings if ring.label == label],
            *seen.size,
        )
        for label in sorted({ring.label for ring in found.rings})
    }

    def picture(some: IntArray, r: IntArray, c: IntArray) -> FloatArray:
        values = seen.pixels[r, c] - ground[some, None, None]
        return np.asarray((values * axis[some, None, None]).sum(axis=-1))

    def drawing(some: IntArray, r: IntArray, c: IntArray) -> FloatArray:
        ours = np.zeros(r.shape)
        for label, cover in covered.items():
            share = ((colors[label] - ground[some]) * axis[some]).sum(axis=1)
            ours += cover.at(r, c, seen.size[1]) * share[:, None, None]
        return ours

    return missing_around(at, seen.size, seen.soft, picture, drawing)
