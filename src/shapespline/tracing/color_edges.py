"""Edges between areas of colours: how far pixels are from one colour to the other, and places.

As for one ink (:mod:`shapespline.tracing.edges`), of whichever two colours meet. Where edges are
blurred the lightness of pixels tells, if the two differ enough in it: a camera sees colours less
sharply (TRC-21).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.tracing.borders import OUTSIDE
from shapespline.tracing.edges import (
    EVEN,
    EVEN_NOISE,
    FARTHEST,
    NOISIEST,
    OFFSETS,
    REACH,
    half_way,
    places_across,
)
from shapespline.tracing.mixtures import ink_axis
from shapespline.tracing.pixels import LUMA, STRONG
from shapespline.tracing.softness import SHARP, Softness

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from shapespline.tracing.borders import Borders, Nodes
    from shapespline.tracing.palette import Palette
    from shapespline.typing import BoolArray, FloatArray, IntArray

# A border's crossings are no nearer to a pixel's centre than this while its course is told.
INNER = 0.02
# A pixel that is half of each colour has the label of one; its border passes through its centre
# (TRC-32).
TIE = 1e-6
# A stroke of no more pixels between two grounds is told apart from both (TRC-35).
STROKE = 3
# Pixels on either side of a crossing in which its place is looked for.
NEAR = 1
# Borders that are looked at together.
TOGETHER = 100_000


class Seen(NamedTuple):
    """A picture of few colours.

    Attributes
    ----------
    pixels : ndarray of uint8, shape (h, w, 3)
    palette : Palette
    noise : float
        Standard deviation of the pixels, of 255.
    soft : Softness
        Of its edges.
    """

    pixels: NDArray[np.uint8]
    palette: Palette
    noise: float
    soft: Softness = SHARP

    @property
    def size(self) -> tuple[int, int]:
        """Height and width."""
        height, width = self.palette.labels.shape
        return height, width

    def axis(self, first: IntArray, second: IntArray) -> FloatArray:
        """What the values of pixels, less the first colour, are multiplied by, shape (n, 3).

        The second colour then is 1.
        """
        along = self.palette.colors[second] - self.palette.colors[first]
        towards = along
        if self.soft.blur:
            lightness = along @ LUMA
            strong = np.abs(lightness) >= STRONG * np.sqrt((along**2).mean(axis=1))
            towards = np.where(strong[:, None], np.array(LUMA), along)
        step = (towards * along).sum(axis=1)
        return np.asarray(towards / np.where(step == 0.0, 1.0, step)[:, None])

    def noise_along(self, axis: FloatArray) -> FloatArray:
        """Noise of the contrast of two colours."""
        return np.asarray(self.noise * np.sqrt((axis**2).sum(axis=1)))

    def across(
        self, nodes: Nodes, axis: FloatArray, offsets: IntArray, beside: int = 0
    ) -> FloatArray:
        """How far pixels across borders are from the first colour to the second, shape (n, k).

        Of the column or row of each crossing, or of one so many beside it.
        """
        height, width = self.size
        upright = nodes.upright[:, None]
        row = nodes.row[:, None] + np.where(upright, offsets, beside)
        column = nodes.column[:, None] + np.where(upright, beside, offsets)
        row, column = np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)
        seen = self.pixels[row, column] - self.palette.colors[nodes.first][:, None]
        return np.asarray((seen * axis[:, None]).sum(axis=2))


class NodePlaces(NamedTuple):
    """Places of nodes, junctions and corners of the picture: between pixel centres, and as drawn.

    ``known`` says of which the grey tells where they were drawn.
    """

    level: FloatArray
    drawn: FloatArray
    known: BoolArray


def softened(seen: Seen, nodes: Nodes) -> Seen:
    """The same picture, how blurred it is told by its edges."""
    for _ in range(2):  # by all colours, then by their lightness
        profiles, beside, noise = [], [], []
        for _index, own in _inner(nodes):
            axis = seen.axis(own.first, own.second)
            profiles.append(seen.across(own, axis, OFFSETS))
            before, behind = (seen.across(own, axis, np.zeros(1, int), k)[:, 0] for k in (-1, 1))
            beside.append(behind - before)
            noise.append(seen.noise_along(axis))
        if not profiles:
            return seen
        usual = float(np.median(np.concatenate(noise)))
        soft = Softness.told(np.concatenate(profiles), np.concatenate(beside), usual)
        seen = seen._replace(soft=soft)
        if not soft.blur:
            break
    return seen


def node_places(seen: Seen, borders: Borders) -> NodePlaces:
    """Places of nodes, junctions and corners."""
    nodes = borders.nodes
    height, width = seen.size
    rim = (nodes.first == OUTSIDE) | (nodes.second == OUTSIDE)
    level, drawn = np.full(len(rim), 0.5), np.full(len(rim), 0.5)
    known = np.zeros(len(rim), dtype=bool)
    for index, own in _inner(nodes):
        axis = seen.axis(own.first, own.second)
        if not seen.soft.blur:
            step = _to_other_ground(seen, own)
            axis = ink_axis(seen.palette.colors[own.second] - seen.palette.colors[own.first], step)
        across = seen.across(own, axis, OFFSETS)
        first, second = across[:, REACH - 1] - 0.5, across[:, REACH] - 0.5
        told = (first < TIE) & (second > -TIE) & (second - first > 2 * TIE)
        share = np.where(told, first / np.where(told, first - second, 1.0), 0.5)
        level[index] = drawn[index] = np.clip(share, INNER, 1 - INNER)
        if seen.soft.on_level:
            # Lightness may be half-way between the next two pixels.
            places = half_way(across, NEAR) - REACH + 0.5
            drawn[index] = np.where(np.isnan(places), share, places)
            continue
        noise = seen.noise_along(axis)
        even = EVEN + EVEN_NOISE * float(np.median(noise))
        ahead = places_across(across, even) - REACH + 0.5
        # Of a stroke thinner than a pixel its level tells little.
        moved = (np.abs(ahead - share) <= FARTHEST) | (np.abs(ahead - 0.5) <= 0.5)
        known[index] = moved & (noise <= NOISIEST)
        drawn[index] = np.where(known[index], ahead, share)
    found = []
    for shares in (level, drawn):
        x = nodes.column + 0.5 + np.where(nodes.upright, 0.0, shares)
        y = height - (nodes.row + 0.5 + np.where(nodes.upright, shares, 0.0))
        own_places = np.clip(np.column_stack([x, y]), 0, (width, height))
        junctions = [_junction(own_places, four, rim, (width, height)) for four in borders.cells]
        found.append(np.concatenate([own_places, _pairs(junctions), _pairs(borders.corners)]))
    return NodePlaces(found[0], found[1], np.pad(known, (0, len(found[0]) - len(known))))


def _to_other_ground(seen: Seen, nodes: Nodes) -> FloatArray:
    """From the ground beside a thin stroke to that on its other side; zero where there is none."""
    height, width = seen.size
    offsets = np.arange(-STROKE, STROKE + 2)
    row = nodes.row[:, None] + np.where(nodes.upright[:, None], offsets, 0)
    column = nodes.column[:, None] + np.where(nodes.upright[:, None], 0, offsets)
    labels = seen.palette.labels[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
    each = np.arange(len(labels))
    thin, beyond = [], []
    for ahead in (labels[:, STROKE::-1], labels[:, STROKE + 1 :]):
        other = ahead != ahead[:, :1]
        thin.append(other.any(axis=1))
        beyond.append(ahead[each, other.argmax(axis=1)])
    colors = seen.palette.colors
    first, second = (
        colors[beyond[1]] - colors[nodes.first],
        colors[beyond[0]] - colors[nodes.second],
    )
    step = np.where((thin[1] & ~thin[0])[:, None], first, 0.0)
    return np.where((thin[0] & ~thin[1])[:, None], second, step)


def _inner(nodes: Nodes) -> Iterator[tuple[IntArray, Nodes]]:
    """Crossings between two colours, some at a time, and which they are."""
    inner = np.flatnonzero((nodes.first != OUTSIDE) & (nodes.second != OUTSIDE))
    for begin in range(0, len(inner), TOGETHER):
        index = inner[begin : begin + TOGETHER]
        yield index, nodes.chosen(index)


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
