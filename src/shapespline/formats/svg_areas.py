"""Areas as they are seen: which outlines of painted elements bound something, and what they lie in.

A picture is painted element over element, by the fill rule of each. An outline across which the
colour on top changes is seen, and lies in the next one around it that is: areas and holes in turn
(FMT-15). White is the colour of the paper where anything else is painted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.geometry import all_containing, crossing_pairs, self_crossings, signed_area

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapespline.formats.svg_paint import Paint
    from shapespline.typing import FloatArray
    from shapespline.values import Piece

WHITE = "#ffffff"
# Chords of a curve or a quarter of a circle and of a line, of which corners alone may lie on the
# border of another area; and the grid of their ends as a part of the drawing: borders that two
# areas share are the same chords either way round (FMT-15).
CHORDS, CHORDS_OF_A_LINE, GRID = 16, 4, 1e-7
# Segments of a line that crosses itself beside which is asked how often it runs around (FMT-15).
MOST_ASKED = 64


class SubPath(NamedTuple):
    """An outline or a line, the place of its element in the order of painting, and its paint."""

    pieces: list[Piece]
    element: int
    paint: Paint


class Nested(NamedTuple):
    """What of some sub-paths is seen.

    Attributes
    ----------
    kept : list of int
        Places of those that are, in their order.
    parents : list of int or None
        For each of them the one directly around it among them, -1 for none; None where their
        places tell it.
    white : bool
        Whether areas were left out that are white on white.
    crossing : bool
        Whether borders of areas cross each other or themselves, so that they would have to be
        united or cut.
    """

    kept: list[int]
    parents: list[int] | None
    white: bool = False
    crossing: bool = False


class Top(NamedTuple):
    """The element that is seen in a place, -1 for none, and its colour."""

    element: int
    color: str | None


def nested_as_painted(paths: Sequence[SubPath]) -> Nested:
    """Which sub-paths are seen, and which lie directly in which.

    Outlines that bound no change of colour are no holes: those of an area on one of its own colour
    stand for themselves, what is white on white or painted over is left out, and of those that
    coincide one is kept.
    """
    areas = _Areas(paths)
    parents = {k: areas.parent(k) for k in areas.outlines if not areas.is_hidden(k)}
    # Painted for itself an area of no other colour would fill a hole that belongs to what is
    # around it.
    filling = {
        other
        for k, parent in parents.items()
        if parent >= 0 and k in areas.seen
        for other in areas.around[k]
        if other in parents and other not in areas.seen and parent in areas.around[other]
    }
    for k, parent in parents.items():
        if parent in filling:
            parents[k] = areas.next_seen(k)
    lines = set(range(len(paths))) - set(areas.around)
    kept = sorted(lines | (set(parents) - filling))
    place = {k: at for at, k in enumerate(kept)}
    return Nested(
        kept,
        [place.get(parents.get(k, -1), -1) for k in kept],
        any(areas.is_white(k) for k in areas.outlines if areas.is_hidden(k)),
        areas.cross([k for k in parents if k not in filling]),
    )


@dataclass
class _Areas:
    """Closed sub-paths by their places, and what is painted within each."""

    paths: Sequence[SubPath]

    @cached_property
    def polygons(self) -> dict[int, FloatArray]:
        """Vertices of the closed ones, as parts of the largest coordinate and on a grid."""
        found = {
            k: _polygon(path.pieces) for k, path in enumerate(self.paths) if _is_closed(path.pieces)
        }
        largest = max((float(np.abs(points).max()) for points in found.values()), default=1.0)
        # Without negative zeros: what coincides is told by its bytes.
        return {k: np.round(points / largest / GRID) * GRID + 0.0 for k, points in found.items()}

    @cached_property
    def twins(self) -> dict[int, list[int]]:
        """For each closed one those that coincide with it, itself among them."""
        alike: dict[bytes, list[int]] = {}
        for k, points in self.polygons.items():
            alike.setdefault(points[np.lexsort(points.T)].tobytes(), []).append(k)
        return {k: group for group in alike.values() for k in group}

    @cached_property
    def outlines(self) -> list[int]:
        """One of those that coincide each: the last that is filled, or the first."""
        groups = {id(group): group for group in self.twins.values()}.values()
        return sorted(
            max(group, key=lambda k: k if self.paths[k].paint.fill else -k - 1) for group in groups
        )

    @cached_property
    def around(self) -> dict[int, list[int]]:
        """For each closed one those around it, the smallest first."""
        firsts = [group[0] for k, group in self.twins.items() if k == group[0]]
        found = all_containing([self.polygons[k] for k in firsts])
        inner = {
            first: [k for at in outer for k in self.twins[firsts[at]]]
            for first, outer in zip(firsts, found, strict=True)
        }
        return {k: inner[group[0]] for k, group in self.twins.items()}

    @cached_property
    def paper(self) -> str | None:
        """White, unless all that is painted is."""
        paints = [color for path in self.paths for color in path.paint[:2] if color]
        return WHITE if any(color != WHITE for color in paints) else None

    @cached_property
    def turns(self) -> dict[int, int]:
        """Which way each closed one runs: 1 or -1."""
        return {k: 1 if signed_area(points) > 0 else -1 for k, points in self.polygons.items()}

    @cached_property
    def tops(self) -> dict[int, tuple[Top, Top]]:
        """What is seen directly within each outline and directly around it."""
        return {
            k: (self._top([*self.twins[k], *self.around[k]]), self._top(self.around[k]))
            for k in self.outlines
        }

    def _top(self, within: Sequence[int]) -> Top:
        """What is seen within some outlines, the smallest first."""
        by_element: dict[int, list[int]] = {}
        for k in within:
            if self.paths[k].paint.fill:
                by_element.setdefault(self.paths[k].element, []).append(k)
        from_above = sorted(by_element, reverse=True)
        top = next((one for one in from_above if self._is_filled(by_element[one])), None)
        if top is not None:
            color = self.paths[by_element[top][0]].paint.fill
            return Top(top, None if color == self.paper else color)
        # What is only stroked is an outline, not a colour: each its own.
        stroked = (k for k in within if not self.paths[k].paint.fill)
        return Top(-1, next((f"within {k}" for k in stroked), None))

    def _is_filled(self, ones: Sequence[int]) -> bool:
        """Whether an element fills what lies within some of its sub-paths."""
        if ones and self.paths[ones[0]].paint.even_odd:
            return len(ones) % 2 == 1
        return sum(self.turns[k] for k in ones) != 0

    def _own(self, k: int) -> list[int]:
        """Sub-paths of the same filled element around one."""
        path = self.paths[k]
        if not path.paint.fill:
            return []
        return [other for other in self.around[k] if self.paths[other].element == path.element]

    def _bounds_own(self, k: int) -> bool:
        """Whether its element is filled on one side of it only."""
        own = self._own(k)
        return self._is_filled(own) != self._is_filled([k, *own])

    @cached_property
    def seen(self) -> set[int]:
        """The outlines across which colours differ, or whose strokes differ from them."""
        return {k for k in self.outlines if self._is_seen(k)}

    def _is_seen(self, k: int) -> bool:
        within, beside = self.tops[k]
        strokes = {
            self.paths[twin].paint.stroke
            for twin in self.twins[k]
            if self.paths[twin].element >= min(within.element, beside.element)
        }
        shown = {None if color == self.paper else color for color in strokes if color}
        return bool({beside.color, *shown} - {within.color})

    def is_hidden(self, k: int) -> bool:
        """Whether an outline that is not seen is white on white or painted over."""
        if k in self.seen:
            return False
        within, beside = self.tops[k]
        over = min(within.element, beside.element) > self.paths[k].element
        return within.color is None or (over and within.color != self.paths[k].paint.fill)

    def is_white(self, k: int) -> bool:
        """Whether an outline is that of a white area."""
        return self.paper is not None and self.paths[k].paint.fill == self.paper

    def parent(self, k: int) -> int:
        """The outline directly around one: of its own element, or any that is seen; or -1."""
        if self._bounds_own(k):
            own = (other for other in self._own(k) if self._bounds_own(other))
            found = next((other for other in own if other in self.tops), None)
            if found is not None:
                return found
        return self.next_seen(k) if k in self.seen else -1

    def next_seen(self, k: int) -> int:
        """The smallest outline around one that is seen, -1 for none."""
        return next((other for other in self.around[k] if other in self.seen), -1)

    def cross(self, kept: Iterable[int]) -> bool:
        """Whether areas that are kept lie partly over each other, or white ones over them."""
        kept = set(kept)
        asked = [
            k for k in self.outlines if self.paths[k].paint.fill and (k in kept or self.is_white(k))
        ]
        lines = [np.concatenate([self.polygons[k], self.polygons[k][:1]]) for k in asked]
        for pair in ({asked[i], asked[j]} for i, j in crossing_pairs(lines)):
            left_out = pair - kept
            if not left_out or (len(left_out) == 1 and max(pair) in left_out):
                return True
        return any(
            not self.paths[k].paint.even_odd and self_crossings(line) and _winds_twice(line)
            for k, line in zip(asked, lines, strict=True)
            if k in kept
        )


def _winds_twice(line: FloatArray) -> bool:
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


def _is_closed(pieces: Sequence[Piece]) -> bool:
    return bool((pieces[0].control_points[0] == pieces[-1].control_points[-1]).all())


def _polygon(pieces: Sequence[Piece]) -> FloatArray:
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
