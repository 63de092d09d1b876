"""Areas as they are seen: which outlines of painted elements bound something, and what they lie in.

A picture is painted element over element, by the fill rule of each. An outline across which the
colour on top changes is seen, and lies in the next one around it that is: areas and holes in turn
(FMT-15). White is the colour of the paper where anything else is painted.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.formats.svg_paint import WHITE, blended
from shapespline.formats.svg_polygons import (
    BESIDE,
    border_places,
    is_closed,
    places_within,
    polygon_of,
    winds_twice,
)
from shapespline.geometry import (
    all_containing,
    crossing_pairs,
    holding,
    self_crossings,
    signed_area,
)
from shapespline.values import BLACK

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapespline.formats.svg_paint import Paint
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Piece

# The grid of the ends of chords as a part of the drawing (FMT-15).
GRID = 1e-7
# Places within an outline near which is asked what is seen, of one and of all together (FMT-17).
PLACES, ALL_PLACES = 32, 8192
# The edges of a stroke are asked for at this part of its width to both sides; and so many places
# along strokes tell whether they lie within an outline (FMT-17).
STROKED, MOST_OF_STROKES = 0.49, 256


class SubPath(NamedTuple):
    """An outline or a line, the place of its element in the order of painting, and its paint."""

    pieces: list[Piece]
    element: int
    paint: Paint


class Top(NamedTuple):
    """The uppermost element that is seen in a place, -1 for none, and the colour.

    Elements beneath it that show through count for the colour, too.
    """

    element: int
    color: str | None
    through: tuple[int, ...] = ()


def sides_asked(count: int) -> int:
    """How many sides of each of so many outlines are asked."""
    return max(1, min(PLACES, ALL_PLACES // max(1, count)))


@dataclass
class Areas:
    """Closed sub-paths by their places, and what is painted within each."""

    paths: Sequence[SubPath]

    @cached_property
    def polygons(self) -> dict[int, FloatArray]:
        """Vertices of the closed ones, as parts of the largest coordinate and on a grid."""
        found = {
            k: polygon_of(path.pieces)
            for k, path in enumerate(self.paths)
            if is_closed(path.pieces)
        }
        # Without negative zeros: what coincides is told by its bytes.
        return {
            k: np.round(points / self.largest / GRID) * GRID + 0.0 for k, points in found.items()
        }

    @cached_property
    def largest(self) -> float:
        """The largest coordinate of control points, of which all others are parts."""
        ends = (piece.control_points for path in self.paths for piece in path.pieces)
        return max((float(np.abs(points).max()) for points in ends), default=0.0) or 1.0

    @cached_property
    def twins(self) -> dict[int, list[int]]:
        """For each closed one those that coincide with it, itself among them."""
        alike: dict[bytes, list[int]] = {}
        for k, points in self.polygons.items():
            alike.setdefault(points[np.lexsort(points.T)].tobytes(), []).append(k)
        return {k: group for group in alike.values() for k in group}

    @cached_property
    def outlines(self) -> list[int]:
        """One of those that coincide each: the last that is filled, or the last."""
        groups = {id(group): group for group in self.twins.values()}.values()
        return sorted(
            max(group, key=lambda k: (bool(self.paths[k].paint.fill), k)) for group in groups
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
            k: (self.top([*self.twins[k], *self.around[k]]), self.top(self.around[k]))
            for k in self.outlines
        }

    def top(self, within: Sequence[int]) -> Top:
        """What is seen within some outlines, the smallest first."""
        by_element: dict[int, list[int]] = {}
        for k in within:
            if self.paths[k].paint.fill:
                by_element.setdefault(self.paths[k].element, []).append(k)
        shown: list[int] = []  # from above to what nothing shows through
        for one in sorted(by_element, reverse=True):
            if self.is_filled(by_element[one]):
                shown.append(one)
                if self.paths[by_element[one][0]].paint.fill_opacity == 1.0:
                    break
        if shown:
            color = None
            for one in reversed(shown):
                paint = self.paths[by_element[one][0]].paint
                color = blended(paint.fill or BLACK, paint.fill_opacity, color)
            return Top(shown[0], None if color == self.paper else color, tuple(shown[1:]))
        # What is only stroked is an outline, not a colour: each its own.
        stroked = (k for k in within if not self.paths[k].paint.fill)
        return Top(-1, next((f"within {k}" for k in stroked), None))

    def is_filled(self, ones: Sequence[int]) -> bool:
        """Whether an element fills what lies within some of its sub-paths."""
        if ones and self.paths[ones[0]].paint.even_odd:
            return len(ones) % 2 == 1
        return sum(self.turns[k] for k in ones) != 0

    def own(self, k: int) -> list[int]:
        """Sub-paths of the same filled element around one."""
        path = self.paths[k]
        if not path.paint.fill:
            return []
        return [other for other in self.around[k] if self.paths[other].element == path.element]

    def _bounds_own(self, k: int) -> bool:
        """Whether its element is filled on one side of it only."""
        own = self.own(k)
        return self.is_filled(own) != self.is_filled([k, *own])

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

    def beneath(self, k: int) -> Top:
        """What a sub-path is painted on."""
        return self.top(self.under(k, [*self.twins.get(k, []), *self.around.get(k, [])]))

    def under(self, k: int, ones: Sequence[int]) -> list[int]:
        """Those of some sub-paths whose elements are painted before that of another one."""
        return [j for j in ones if self.paths[j].element < self.paths[k].element]

    def color(self, top: Top) -> str | None:
        """A colour that is seen, no stroke alone."""
        return top.color if top.element >= 0 else None

    def is_hidden(self, k: int) -> bool:
        """Whether an outline that is nowhere seen is white on white or painted over."""
        return k in self._unseen and k not in self.partly_seen

    @cached_property
    def _unseen(self) -> set[int]:
        """Outlines that are white on white or painted over where most of them lies."""
        found = set()
        for k in self.outlines:
            within, beside = self.tops[k]
            over = min(within.element, beside.element) > self.paths[k].element
            hidden = within.color is None or (over and within.color != self.paths[k].paint.fill)
            if hidden and k not in self.seen:
                found.add(k)
        return found

    @cached_property
    def partly_seen(self) -> set[int]:
        """Those of them that show somewhere within, by their strokes, or by what they cover."""
        filled = [k for k in sorted(self._unseen) if self.paths[k].paint.fill]
        found = {
            k
            for k, within in zip(filled, self.around_places(self._within(filled)), strict=True)
            if self._shows(k, within, [self.top(around) for around in within], self.twins[k])
        }
        found |= {k for k in filled if self.is_white(k) and self._covers_strokes(k)}
        stroked = [k for k in sorted(self._unseen - found) if self._widest(k)]
        sides = [self._beside(k, self._widest(k), sides_asked(len(stroked))) for k in stroked]
        for k, around in zip(stroked, self.around_places(sides), strict=True):
            last = max(self.paths[j].element for j in self.twins[k] if self.paths[j].paint.stroke)
            if any(self.top(ones).element < last for ones in around):
                found.add(k)
        return found

    @cached_property
    def twins_seen(self) -> set[int]:
        """Areas that show in another colour than the one they coincide with, and holes that do."""
        asked = {
            k: [
                j
                for j in self.twins[k]
                if j != k and self.paths[j].paint.fill
                if self.paths[j].paint.fill != self.paths[k].paint.fill or self._is_hole(j)
            ]
            for k in self.outlines
        }
        beside = [k for k, others in asked.items() if others]
        places = self.around_places(self._within(beside))
        return {
            j
            for k, within in zip(beside, places, strict=True)
            for tops in [[self.top(around) for around in within]]
            for j in asked[k]
            if self._shows(j, within, tops, [j])
        }

    def _shows(
        self, k: int, within: list[list[int]], tops: list[Top], leaving: Sequence[int]
    ) -> bool:
        """Whether an outline shows in one of some places, told by the outlines around each.

        What is seen there is compared to what is without its element and without those to leave.
        """
        element = self.paths[k].element
        if self._is_hole(k):
            fill = None if self.is_white(k) else self.paths[k].paint.fill
            return any(top.element < element and self.color(top) != fill for top in tops)
        for around, top in zip(within, tops, strict=True):
            if top.element != element:
                continue
            others = [j for j in around if j not in leaving]
            without = self.top([j for j in others if self.paths[j].element != element])
            if top.color != self.color(without):
                return True
        return False

    def _is_hole(self, k: int) -> bool:
        """Whether its element does not fill what lies within an outline."""
        return not self.is_filled([k, *self.own(k)])

    def _widest(self, k: int) -> float:
        """Width of the widest stroke along an outline, 0 without one."""
        paints = (self.paths[j].paint for j in self.twins[k])
        return max((paint.width for paint in paints if paint.stroke), default=0.0)

    def _within(self, asked: Sequence[int]) -> list[FloatArray]:
        return [places_within(self.polygons[k], sides_asked(len(asked))) for k in asked]

    def _beside(self, k: int, width: float, count: int) -> FloatArray:
        """Places on both edges of a stroke."""
        middle, inwards = border_places(self.polygons[k], count)
        reach = STROKED * width / self.largest * inwards
        return np.concatenate([middle + reach, middle - reach])

    def near_places(self, asked: Sequence[int]) -> list[FloatArray]:
        """Places just within the borders of some outlines."""
        pairs = (border_places(self.polygons[k], sides_asked(len(asked))) for k in asked)
        return [middle + BESIDE * inwards for middle, inwards in pairs]

    def around_places(self, places: Sequence[FloatArray]) -> list[list[list[int]]]:
        """The outlines around each of some places."""
        keys, polygons = [*self.polygons], [*self.polygons.values()]
        held = iter(holding(np.concatenate([np.empty((0, 2)), *places]), polygons))
        return [[[keys[j] for j in next(held)] for _ in points] for points in places]

    def _covers_strokes(self, k: int) -> bool:
        """Whether a line was stroked before within an outline."""
        elements, points = self._strokes
        low, high = self.polygons[k].min(axis=0), self.polygons[k].max(axis=0)
        boxed = (points >= low).all(axis=1) & (points <= high).all(axis=1)
        asked = boxed & (elements < self.paths[k].element)
        chosen = points[asked][:: 1 + int(asked.sum()) // MOST_OF_STROKES]
        return any(holding(chosen, [self.polygons[k]]))

    @cached_property
    def _strokes(self) -> tuple[IntArray, FloatArray]:
        """Elements and places along all strokes, as parts of the largest coordinate."""
        found = [(np.empty(0, dtype=np.int64), np.empty((0, 2)))]
        for path in self.paths:
            if path.paint.stroke:
                points = polygon_of(path.pieces) / self.largest
                found.append((np.full(len(points), path.element), points))
        return np.concatenate([one for one, _ in found]), np.concatenate([at for _, at in found])

    def is_white(self, k: int) -> bool:
        """Whether an outline is that of a white area."""
        return self.paper is not None and self.paths[k].paint.fill == self.paper

    def parent(self, k: int) -> int:
        """The outline directly around one: of its own element, or any that is seen; or -1."""
        if self._bounds_own(k):
            own = (other for other in self.own(k) if self._bounds_own(other))
            found = next((other for other in own if other in self.tops), None)
            if found is not None:
                return found
        return self.next_seen(k) if k in self.seen else -1

    def next_seen(self, k: int) -> int:
        """The smallest outline around one that is seen, -1 for none."""
        return next((other for other in self.around[k] if other in self.seen), -1)

    def cross(self, kept: Iterable[int], *, even_odd: bool) -> bool:
        """Whether areas that are kept lie partly over each other, or are filled by another rule.

        The even-odd rule or the other one makes a difference where one runs around something twice.
        """
        filled = [k for k in kept if self.paths[k].paint.fill]
        lines = [np.concatenate([self.polygons[k], self.polygons[k][:1]]) for k in filled]
        return bool(crossing_pairs(lines)) or any(
            self.paths[k].paint.even_odd != even_odd and self_crossings(line) and winds_twice(line)
            for k, line in zip(filled, lines, strict=True)
        )
