"""Shape: what a file holds, contours with their nesting."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from shapespline.errors import InvalidInputError
from shapespline.units import checked_unit

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.values.view_box import ViewBox

from shapespline.values.contour import Contour, checked_contour
from shapespline.values.equality import ByValue
from shapespline.values.exchanged import Exchanged
from shapespline.values.shown import Shown
from shapespline.values.stroke import (
    COLOR,
    Stroke,
    checked_strokes,
    checked_widths,
    one_for_each,
)


def checked_parents(parents: Sequence[int] | None, count: int) -> tuple[int, ...]:
    """For each of ``count`` items the index of the one around it, -1 for none (the default).

    Raises
    ------
    InvalidInputError
        If there are not as many, one is out of range, or the nesting runs in a circle.
    """
    if parents is None:
        return (-1,) * count
    parents = tuple(int(parent) for parent in parents)
    if len(parents) != count:
        raise InvalidInputError(
            f"parents must name one parent for each: expected {count}, got {len(parents)}"
        )
    for child, parent in enumerate(parents):
        if not -1 <= parent < count:
            raise InvalidInputError(
                f"parents must be -1 or indices below {count}, got {parent} for {child}"
            )
    for child in range(count):
        if nesting_depth(parents, child) > count:
            raise InvalidInputError(f"parents must not run in a circle, got one through {child}")
    return parents


def counted(count: int, noun: str) -> str:
    """A number and its noun.

    Examples
    --------
    >>> counted(1, "contour"), counted(2, "contour")
    ('1 contour', '2 contours')
    """
    return f"{count} {noun}{'' if count == 1 else 's'}"


def nesting_depth(parents: Sequence[int], index: int) -> int:
    """Number of items around one; more than there are if the nesting runs in a circle."""
    depth, parent = 0, parents[index]
    while parent >= 0 and depth <= len(parents):
        depth, parent = depth + 1, parents[parent]
    return depth


def checked_colors(colors: Sequence[str | None] | None, count: int) -> tuple[str | None, ...]:
    """For each of ``count`` items its colour, None for none (the default).

    Raises
    ------
    InvalidInputError
        If there are not as many, or one is not written as #rrggbb.
    """
    listed = one_for_each(colors, "colors", "colour", count)
    for color in listed:
        if color is not None and not (isinstance(color, str) and COLOR.fullmatch(color)):
            raise InvalidInputError(f"colors must be None or like '#ff8800', got {color!r}")
    return listed


def checked_reference(reference: object) -> str | None:
    """The name of a coordinate reference system, or None.

    Raises
    ------
    InvalidInputError
        If it is no text.
    """
    if reference is None or (isinstance(reference, str) and reference.strip()):
        return reference
    raise InvalidInputError(
        f"reference must name a coordinate reference system such as 'EPSG:25832', got {reference!r}"
    )


@dataclass(frozen=True, eq=False, init=False)
class Shape(ByValue, Shown, Exchanged):
    """What a file holds: contours and which lies directly inside which.

    Parameters
    ----------
    contours : sequence of Contour
    parents : sequence of int, optional
        For each contour the index of the smallest contour around it, -1 for none (default: none).
    frame : ViewBox, optional
        The image or view box that the contours were read from.
    unit : str, optional
        Of the coordinates, one of :data:`shapespline.units.UNITS`, if known.
    left_out : sequence of Contour, optional
        What the source showed besides, and the reader took for noise.
    colors : sequence of str or None, optional
        For each contour the colour of the area within it, as #rrggbb; None, the default, for a
        hole and where no colour is known. One of a contour within another is painted upon it.
    widths : sequence of float or None, optional
        For each contour that a stroke runs along, how wide it is, in the unit of the coordinates;
        None, the default, for others. Without a colour the stroke alone is painted.
    strokes : sequence of Stroke or None, optional
        How strokes of those widths look that were drawn; None, the default, for the centre lines of
        a picture's strokes, which are shown by a round black pen and bound no area.
    reference : str, optional
        Coordinate reference system of the points, such as "EPSG:25832", if known.

    Examples
    --------
    >>> outer = Contour([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True)
    >>> inner = Contour([(1, 1), (2, 1), (2, 2)], closed=True)
    >>> shape = Shape([outer, inner], parents=[-1, 0])
    >>> shape.is_hole(1)
    True
    """

    contours: tuple[Contour, ...]
    parents: tuple[int, ...]
    frame: ViewBox | None
    unit: str | None
    left_out: tuple[Contour, ...] = field(repr=False)
    colors: tuple[str | None, ...] = field(repr=False)
    widths: tuple[float | None, ...] = field(repr=False)
    strokes: tuple[Stroke | None, ...] = field(repr=False)
    reference: str | None = field(repr=False)

    def __init__(
        self,
        contours: Sequence[Contour],
        parents: Sequence[int] | None = None,
        frame: ViewBox | None = None,
        unit: str | None = None,
        *,
        left_out: Sequence[Contour] = (),
        colors: Sequence[str | None] | None = None,
        widths: Sequence[float | None] | None = None,
        strokes: Sequence[Stroke | None] | None = None,
        reference: str | None = None,
    ) -> None:
        contours, left_out = tuple(contours), tuple(left_out)
        if not contours:
            raise InvalidInputError("contours must hold at least one Contour, got none")
        for contour in contours:
            checked_contour(contour, "contours")
        for contour in left_out:
            checked_contour(contour, "left_out")
        object.__setattr__(self, "contours", contours)
        object.__setattr__(self, "parents", checked_parents(parents, len(contours)))
        object.__setattr__(self, "frame", frame)
        object.__setattr__(self, "unit", checked_unit(unit))
        object.__setattr__(self, "left_out", left_out)
        object.__setattr__(self, "colors", checked_colors(colors, len(contours)))
        object.__setattr__(self, "widths", checked_widths(widths, len(contours)))
        object.__setattr__(self, "strokes", checked_strokes(strokes, self.widths))
        object.__setattr__(self, "reference", checked_reference(reference))

    def __len__(self) -> int:
        return len(self.contours)

    def __iter__(self) -> Iterator[Contour]:
        return iter(self.contours)

    def __repr__(self) -> str:
        n_points = sum(map(len, self.contours))
        unit = f", {self.unit}" if self.unit else ""
        return f"Shape({counted(len(self), 'contour')}, {n_points} points{unit})"

    def is_hole(self, index: int) -> bool:
        """Whether the contour lies inside an odd number of others."""
        return nesting_depth(self.parents, index) % 2 == 1

    @property
    def longest(self) -> Contour:
        """The contour with the longest polyline."""
        return max(self.contours, key=lambda contour: contour.length)
