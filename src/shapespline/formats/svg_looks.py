"""What of painted elements is kept, which lies in which, and how each looks.

Each outline keeps the colour that its element fills it with, so that all of them are painted again
in their order (FMT-17).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapespline.formats.svg_areas import Areas
from shapespline.formats.svg_paint import WHITE, blended, stroke_of
from shapespline.values import BLACK

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapespline.formats.svg_areas import SubPath
    from shapespline.values import Stroke


class Look(NamedTuple):
    """The colour of the area within an outline, None for a hole or a line; and the stroke along it.

    The width of the stroke is in the coordinates of the view box.
    """

    color: str | None = None
    width: float | None = None
    stroke: Stroke | None = None


class Nested(NamedTuple):
    """What of some sub-paths is seen.

    Attributes
    ----------
    kept : list of int
        Places of those that are, in their order.
    parents : list of int or None
        For each of them the one directly around it among them, -1 for none; None where their
        places tell it.
    looks : list of Look
        How each of them is painted.
    white : bool
        Whether areas were left out that are white on white.
    crossing : bool
        Whether borders of areas cross each other or themselves, so that they would have to be
        united or cut.
    """

    kept: list[int]
    parents: list[int] | None
    looks: list[Look]
    white: bool = False
    crossing: bool = False


def nested_as_painted(paths: Sequence[SubPath]) -> Nested:
    """Which sub-paths are seen, and which lie directly in which.

    Outlines that bound no change of colour are no holes: those of an area on one of its own colour
    stand for themselves, what is white on white or painted over is left out, and of those that
    coincide one is kept, and others that show beside it.
    """
    areas = Areas(paths)
    parents = {k: areas.parent(k) for k in areas.outlines if not areas.is_hidden(k)}
    # Painted for itself an area of no other colour would fill a hole that belongs to what is
    # around it.
    filling = {
        other
        for k, parent in parents.items()
        if parent >= 0 and k in areas.seen
        for other in areas.around[k]
        if other in parents and other not in areas.seen and parent in areas.around[other]
    } - areas.partly_seen
    for k, parent in parents.items():
        if parent in filling:
            parents[k] = areas.next_seen(k)
    lines = set(range(len(paths))) - set(areas.around)
    outlines = set(parents) - filling
    along = _strokes_along(areas, outlines)
    more = {stroke for strokes in along.values() for stroke in strokes[1:]}
    parents |= {k: areas.parent(k) for k in areas.twins_seen}
    kept = sorted(lines | outlines | areas.twins_seen | more, key=lambda k: _order(areas, k))
    place = {k: at for at, k in enumerate(kept)}
    strokes = {k: strokes[0] for k, strokes in along.items()}
    looks = [_look(areas, k, parents.get(k, -1), strokes.get(k, k)) for k in kept]
    looks = _plain(looks, areas, kept)
    return Nested(
        kept,
        [place.get(parents.get(k, -1), -1) for k in kept],
        looks,
        any(areas.is_white(k) for k in areas.outlines if areas.is_hidden(k)),
        # Areas in colours are filled whole, black ones by the even-odd rule.
        areas.cross(sorted(outlines), even_odd=not any(look.color for look in looks)),
    )


def side_by_side(paths: Sequence[SubPath]) -> Nested:
    """Sub-paths that our writer drew side by side: all of them are seen, and lie as they lie."""
    areas = Areas(paths)
    return Nested([*range(len(paths))], None, [_look(areas, k, -1, k) for k in range(len(paths))])


def _plain(looks: list[Look], areas: Areas, kept: list[int]) -> list[Look]:
    """Looks without colours where black areas with holes and without strokes look the same."""
    colors = {look.color for look in looks if look.color}
    if not colors <= {BLACK, WHITE} or any(look.color and look.width for look in looks):
        return looks
    if any(areas.is_white(k) for k in areas.partly_seen.intersection(kept)):
        return looks
    return [look._replace(color=None) for look in looks]


def _order(areas: Areas, k: int) -> tuple[int, int, int]:
    """When a sub-path is painted: what lets others show through at once upon what it lies on.

    What lies between has the colour that is seen through it.
    """
    path = areas.paths[k]
    if k in areas.twins and path.paint.fill and path.paint.fill_opacity < 1.0:
        return areas.beneath(k).element, 1, k
    return path.element, 0, k


def _look(areas: Areas, k: int, parent: int, stroke: int) -> Look:
    """How a sub-path is painted that lies in another one, with the stroke of one that coincides.

    A hole of its own element is cut from it, whatever is seen through it.
    """
    paint = areas.paths[k].paint
    fills = k in areas.twins and paint.fill
    color = None
    if fills and areas.is_filled([k, *areas.own(k)]):
        color = blended(paint.fill or BLACK, paint.fill_opacity, areas.color(areas.beneath(k)))
        seen = areas.tops[k][0] if k in areas.tops else areas.beneath(k)
        if areas.paths[k].element in seen.through:
            color = areas.color(seen) or WHITE
    elif fills and parent >= 0 and parent not in areas.own(k):
        color = areas.color(areas.tops[k][0]) or WHITE
    pen = areas.paths[stroke].paint
    # A stroke runs along the holes of its element as along its outline, which tells it.
    if not pen.stroke or (fills and color is None):
        return Look(color)
    return Look(color, pen.width, stroke_of(pen, areas.color(areas.beneath(k))))


def _strokes_along(areas: Areas, kept: Iterable[int]) -> dict[int, list[int]]:
    """For each outline the sub-path whose stroke is painted with it, then those of other strokes.

    They are lines of their own: beneath a fill or a narrower stroke, or above what was painted over
    the fill in between. What a wider one covers is left out.
    """
    found, above = {}, {}
    for k in sorted(kept):
        strokes = [j for j in areas.twins[k] if areas.paths[j].paint.stroke]
        found[k] = strokes
        if strokes and strokes[-1] > k and not areas.paths[k].paint.stroke:
            above[k] = strokes[-1]
    places = areas.around_places(areas.near_places([*above]))
    covered = {
        k
        for (k, stroke), near in zip(above.items(), places, strict=True)
        if any(
            areas.top(areas.under(stroke, around)).element > areas.paths[k].element
            for around in near
        )
    }
    for k, strokes in found.items():
        own = above[k] if k in above and k not in covered else k
        shown, width = [own], 0.0
        for j in reversed(strokes):
            if j != own and areas.paths[j].paint.width > width:
                shown.append(j)
            width = max(width, areas.paths[j].paint.width)
        found[k] = shown
    return found
