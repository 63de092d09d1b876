"""Drawing: fits with the nesting of the shape they came from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from shapespline.errors import InvalidInputError
from shapespline.units import checked_unit
from shapespline.values.shape import checked_colors, checked_parents, counted, nesting_depth

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.values.view_box import ViewBox
from shapespline.values.fit import Fit
from shapespline.values.shown import Shown


@dataclass(frozen=True, eq=False, init=False)
class Drawing(Shown):
    """Fits with the nesting of the shape they came from.

    Parameters
    ----------
    fits : sequence of Fit
    parents : sequence of int, optional
        For each fit the index of the one directly around it, -1 for none (default: none).
    frame : ViewBox, optional
        The image or view box of the source.
    unit : str, optional
        Of the coordinates, one of :data:`shapespline.units.UNITS`, if known.
    colors : sequence of str or None, optional
        For each fit the colour of the area within it, as #rrggbb; None, the default, for a hole
        and where no colour is known.
    """

    fits: tuple[Fit, ...]
    parents: tuple[int, ...]
    frame: ViewBox | None
    unit: str | None
    colors: tuple[str | None, ...]

    def __init__(
        self,
        fits: Sequence[Fit],
        parents: Sequence[int] | None = None,
        frame: ViewBox | None = None,
        unit: str | None = None,
        *,
        colors: Sequence[str | None] | None = None,
    ) -> None:
        fits = (fits,) if isinstance(fits, Fit) else tuple(fits)
        if not fits:
            raise InvalidInputError("fits must hold at least one Fit, got none")
        for fit in fits:
            if not isinstance(fit, Fit):
                raise InvalidInputError(f"fits must be Fit objects, got {type(fit).__name__}")
        object.__setattr__(self, "fits", fits)
        object.__setattr__(self, "parents", checked_parents(parents, len(fits)))
        object.__setattr__(self, "frame", frame)
        object.__setattr__(self, "unit", checked_unit(unit))
        object.__setattr__(self, "colors", checked_colors(colors, len(fits)))

    def __len__(self) -> int:
        return len(self.fits)

    def __repr__(self) -> str:
        fits = self.fits
        n_points = sum(fit.n_stored_points for fit in fits)
        largest = max(fit.hausdorff_distance for fit in fits)
        unit = f", {self.unit}" if self.unit else ""
        return (
            f"Drawing({counted(len(fits), 'curve')}, {n_points} stored points, distance"
            f" {largest:.3g}{unit}, {sum(fit.kept for fit in fits)} of {len(fits)} kept)"
        )

    def is_hole(self, index: int) -> bool:
        """Whether the fit lies inside an odd number of others."""
        return nesting_depth(self.parents, index) % 2 == 1

    def __iter__(self) -> Iterator[Fit]:
        return iter(self.fits)
