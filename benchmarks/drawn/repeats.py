"""Equal features of a drawing: how differently a tracer treats them.

A feature is a line or an arc with its two joints. Those of a drawing are equal that have the same
length, curvature and turns; of each the curve's offsets across are taken at corresponding points.
"""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from benchmarks.drawn.truth import Arc, Cubic, Line, turn_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scipy.spatial import cKDTree

    from benchmarks.drawn.found import Found
    from benchmarks.drawn.truth import Array, Element, Outline

# Corresponding points of a feature, the part of it that they lie in, pixels that count as equal.
POINTS, INNER, EQUAL = 15, 0.9, 1e-3


class Spread(NamedTuple):
    """Of some equal features: the largest difference of offsets, and whether pieces are alike."""

    offsets: float
    same_pieces: bool


def spreads(truth: Sequence[Outline], found: Found, tree: cKDTree, shortest: float) -> list[Spread]:
    """One for each set of equal features."""
    groups: dict[tuple[object, ...], list[Element]] = defaultdict(list)
    for outline in truth:
        for k, element in enumerate(outline):
            key = _key(outline, k)
            if key is not None and _length(element) >= shortest:
                groups[key].append(element)
    return [_spread(elements, found, tree) for elements in groups.values() if len(elements) > 1]


def _key(outline: Outline, k: int) -> tuple[object, ...] | None:
    element = outline[k]
    if isinstance(element, Cubic):
        return None
    turns = [
        round(abs(turn_of(*pair)), 1)
        for pair in ((outline[k - 1], element), (element, outline[(k + 1) % len(outline)]))
    ]
    neighbours = [type(outline[k - 1]).__name__, type(outline[(k + 1) % len(outline)]).__name__]
    size = round(_length(element) / EQUAL / 10)
    radius = round(element.radius / EQUAL / 10) if isinstance(element, Arc) else 0
    return type(element).__name__, size, radius, *sorted(zip(turns, neighbours, strict=True))


def _length(element: Element) -> float:
    if isinstance(element, Line):
        return float(np.hypot(*(element.end - element.begin)))
    assert isinstance(element, Arc)
    return abs(element.sweep) * element.radius


def _spread(elements: Sequence[Element], found: Found, tree: cKDTree) -> Spread:
    profiles, kinds = [], set()
    for element in elements:
        points, normals = _across(element)
        index = tree.query(points)[1]
        profiles.append(((found.curve[index] - points) * normals).sum(axis=1))
        row = tuple(found.pieces[k].kind for k in dict.fromkeys(found.owner[index].tolist()))
        kinds.add(min(row, row[::-1]))
    offsets = np.array(profiles)
    # Mirrored features run backwards.
    forwards = np.abs(offsets[:, None] - offsets[None]).max(axis=2)
    backwards = np.abs(offsets[:, None] - offsets[None, :, ::-1]).max(axis=2)
    return Spread(float(np.minimum(forwards, backwards).max()), len(kinds) == 1)


def _across(element: Element) -> tuple[Array, Array]:
    """Points of the inner part, and unit vectors to its left."""
    t = 0.5 + INNER * np.linspace(-0.5, 0.5, POINTS)
    if isinstance(element, Line):
        along = element.end - element.begin
        normal = np.array([-along[1], along[0]]) / np.hypot(*along)
        return element.begin + t[:, None] * along, np.tile(normal, (POINTS, 1))
    assert isinstance(element, Arc)
    points = element.at(element.start + t * element.sweep)
    return points, (element.centre - points) / element.radius * np.sign(element.sweep)
