"""Outlines of an SVG as polygons: their chords, and places within and beside them."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry import signed_area

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray
    from shapespline.values import Piece

# Chords of a curve or a quarter of a circle and of a line, of which corners alone may lie on the
# border of another area: borders that two areas share are the same chords either way round
# (FMT-15).
CHORDS, CHORDS_OF_A_LINE = 16, 4
# Segments of a line that crosses itself beside which is asked how often it runs around (FMT-15).
MOST_ASKED = 64
# How far beside the border of a polygon places lie, its coordinates at most 1, and where others
# lie, in parts of the way across it (FMT-17).
BESIDE, DEPTHS = 1e-5, (0.25, 0.5)


def winds_twice(line: FloatArray) -> bool:
    """Whether a closed line runs around some place beside its segments more than once."""
    begins, ends = line[:-1], line[1:]
    chosen = np.unique(np.linspace(0, len(begins) - 1, MOST_ASKED).astype(int))
    along = ends[chosen] - begins[chosen]
    beside = 0.01 * np.stack([-along[:, 1], along[:, 0]], axis=-1)
    on = [begins[chosen] + share * along for share in (0.1, 0.5, 0.9)]
    for x, y in np.concatenate([points + side for points in on for side in (beside, -beside)]):
        up = (begins[:, 1] <= y) & (ends[:, 1] > y)
        down = (begins[:, 1] > y) & (ends[:, 1] <= y)
        sides = ends - begins
        left = sides[:, 0] * (y - begins[:, 1]) - sides[:, 1] * (x - begins[:, 0])
        if abs(int((up & (left > 0)).sum()) - int((down & (left < 0)).sum())) > 1:
            return True
    return False


def is_closed(pieces: Sequence[Piece]) -> bool:
    """Whether pieces end to end come back to where they begin."""
    return bool((pieces[0].control_points[0] == pieces[-1].control_points[-1]).all())


def polygon_of(pieces: Sequence[Piece]) -> FloatArray:
    """Vertices of a closed outline, the ends of chords of its pieces."""
    return np.concatenate([_chords(piece) for piece in pieces])


def _chords(piece: Piece) -> FloatArray:
    """Points evenly spaced in the parameter, the first one included."""
    points = piece.control_points
    count = CHORDS if piece.degree > 1 else CHORDS_OF_A_LINE
    if piece.arc is not None:
        count *= math.ceil(abs(piece.arc.sweep) / (0.5 * math.pi))
        return piece.arc.at(np.arange(count) / count)
    weight = np.arange(count)[:, None] / count
    layers = [np.broadcast_to(point, (count, 2)) for point in points]
    while len(layers) > 1:  # de Casteljau
        layers = [(1 - weight) * a + weight * b for a, b in pairwise(layers)]
    return layers[0]


def border_places(begins: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
    """Middles of ``count`` sides of a polygon at most, and unit vectors from there inwards."""
    along = np.roll(begins, -1, axis=0) - begins
    length = np.hypot(*along.T)
    chosen = np.flatnonzero(length > 2 * BESIDE)
    count = min(count, len(chosen))
    chosen = chosen[np.unique(np.linspace(0, len(chosen) - 1, count).astype(int))]
    left = np.stack([-along[chosen, 1], along[chosen, 0]], axis=-1) / length[chosen, None]
    inwards = math.copysign(1.0, signed_area(begins)) * left
    return begins[chosen] + 0.5 * along[chosen], inwards


def places_within(begins: FloatArray, count: int) -> FloatArray:
    """Places within a polygon: near the middles of ``count`` sides at most, and farther away."""
    middle, inwards = border_places(begins, count)
    along = np.roll(begins, -1, axis=0) - begins
    across = np.array([_across(begins, along, *ray) for ray in zip(middle, inwards, strict=True)])
    far = [middle + part * across.reshape(-1, 1) * inwards for part in DEPTHS]
    return np.concatenate([middle + BESIDE * inwards, *far])


def _across(begins: FloatArray, along: FloatArray, point: FloatArray, way: FloatArray) -> float:
    """How far a ray from the border of a polygon runs until it meets it again."""
    to = begins - point
    cross = way[0] * along[:, 1] - way[1] * along[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        far = (to[:, 0] * along[:, 1] - to[:, 1] * along[:, 0]) / cross
        at = (to[:, 0] * way[1] - to[:, 1] * way[0]) / cross
    return float(far[(far > BESIDE) & (at >= 0) & (at <= 1)].min(initial=1.0))
