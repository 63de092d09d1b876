"""Regularity: something that the pieces of a curve, or the outlines of a drawing, keep exactly."""

from __future__ import annotations

from typing import NamedTuple


class Regularity(NamedTuple):
    """Something that pieces of a curve keep exactly, because the data allow it.

    Attributes
    ----------
    name : str
        Such as "axis-parallel" or "equal-radius".
    pieces : tuple of int
        The pieces that it is about, by their places among ``fit.sections``; of a drawing the
        fits, by their places among ``drawing.fits``.
    off : float
        How far the data alone were from it: degrees for directions, otherwise data units.
    order : int
        Of a rotation: how many turns there are; 1 for what has none.

    Examples
    --------
    >>> print(Regularity("rotation", (0, 1, 2, 3), 0.0005, order=4))
    4-fold rotation, 4 pieces, off by 0.0005 before
    """

    name: str
    pieces: tuple[int, ...]
    off: float
    order: int = 1

    def __str__(self) -> str:
        name = f"{self.order}-fold {self.name}" if self.name == "rotation" else self.name
        count = f"{len(self.pieces)} {self.noun}{'s' if len(self.pieces) > 1 else ''}"
        return f"{name}, {count}, off by {abs(self.off):.3g} before"

    @property
    def noun(self) -> str:
        """What is counted: pieces of a curve."""
        return "piece"


class OutlineRegularity(Regularity):
    """Something that outlines of a drawing keep exactly: ``pieces`` are places of its fits.

    Examples
    --------
    >>> print(OutlineRegularity("equal-copies", (1, 2, 3), 0.004))
    equal-copies, 3 outlines, off by 0.004 before
    """

    __slots__ = ()

    @property
    def noun(self) -> str:
        """What is counted: outlines of a drawing."""
        return "outline"
