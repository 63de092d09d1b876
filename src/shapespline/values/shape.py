"""Shape: what a file holds, contours with their nesting."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from shapespline.errors import InvalidInputError
from shapespline.units import checked_unit

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.values.view_box import ViewBox

from shapespline.values.contour import Contour, checked_contour


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


def nesting_depth(parents: Sequence[int], index: int) -> int:
    """Number of items around one; more than there are if the nesting runs in a circle."""
    depth, parent = 0, parents[index]
    while parent >= 0 and depth <= len(parents):
        depth, parent = depth + 1, parents[parent]
    return depth


@dataclass(frozen=True, eq=False, init=False)
class Shape:
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

    def __init__(
        self,
        contours: Sequence[Contour],
        parents: Sequence[int] | None = None,
        frame: ViewBox | None = None,
        unit: str | None = None,
    ) -> None:
        contours = tuple(contours)
        if not contours:
            raise InvalidInputError("contours must hold at least one Contour, got none")
        for contour in contours:
            checked_contour(contour, "contours")
        object.__setattr__(self, "contours", contours)
        object.__setattr__(self, "parents", checked_parents(parents, len(contours)))
        object.__setattr__(self, "frame", frame)
        object.__setattr__(self, "unit", checked_unit(unit))

    def __len__(self) -> int:
        return len(self.contours)

    def __iter__(self) -> Iterator[Contour]:
        return iter(self.contours)

    def is_hole(self, index: int) -> bool:
        """Whether the contour lies inside an odd number of others."""
        return nesting_depth(self.parents, index) % 2 == 1

    @property
    def longest(self) -> Contour:
        """The contour with the longest polyline."""
        return max(self.contours, key=lambda contour: contour.length)
