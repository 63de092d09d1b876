"""Drawing: fits with the nesting of the shape they came from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from shapespline.errors import InvalidInputError
from shapespline.units import checked_unit
from shapespline.values.shape import (
    Shape,
    checked_colors,
    checked_parents,
    checked_reference,
    counted,
    nesting_depth,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy as np
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from shapespline.geometry import Box
    from shapespline.typing import ArrayLike
    from shapespline.values.view_box import ViewBox
from shapespline.values.equality import ByValue
from shapespline.values.exchanged import Exchanged
from shapespline.values.fit import Fit
from shapespline.values.regularity import OutlineRegularity, Regularity
from shapespline.values.shown import Shown
from shapespline.values.stroke import Stroke, checked_strokes, checked_widths


@dataclass(frozen=True, eq=False, init=False)
class Drawing(ByValue, Shown, Exchanged):
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
        and where no colour is known. One of a fit within another is painted upon it.
    widths : sequence of float or None, optional
        For each fit that a stroke runs along, how wide it is, in the unit of the coordinates;
        None, the default, for others. Without a colour the stroke alone is painted.
    strokes : sequence of Stroke or None, optional
        How strokes of those widths look that were drawn; None, the default, for the centre lines of
        a picture's strokes, which are shown by a round black pen and bound no area.
    reference : str, optional
        Coordinate reference system of the points, such as "EPSG:25832", if known.
    regularities : sequence of Regularity, optional
        What the fits keep together where they are as they were drawn, such as equal holes in a row;
        their ``pieces`` are places among ``fits`` (default: none).
    """

    fits: tuple[Fit, ...]
    parents: tuple[int, ...]
    frame: ViewBox | None
    unit: str | None
    colors: tuple[str | None, ...]
    widths: tuple[float | None, ...]
    strokes: tuple[Stroke | None, ...]
    reference: str | None
    regularities: tuple[OutlineRegularity, ...]

    def __init__(
        self,
        fits: Sequence[Fit],
        parents: Sequence[int] | None = None,
        frame: ViewBox | None = None,
        unit: str | None = None,
        *,
        colors: Sequence[str | None] | None = None,
        widths: Sequence[float | None] | None = None,
        strokes: Sequence[Stroke | None] | None = None,
        reference: str | None = None,
        regularities: Sequence[Regularity] = (),
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
        object.__setattr__(self, "widths", checked_widths(widths, len(fits)))
        object.__setattr__(self, "strokes", checked_strokes(strokes, self.widths))
        object.__setattr__(self, "reference", checked_reference(reference))
        listed = tuple(OutlineRegularity._make(one) for one in regularities)
        object.__setattr__(self, "regularities", listed)

    @classmethod
    def of(
        cls, shape: Shape, fits: Sequence[Fit], *, regularities: Sequence[Regularity] = ()
    ) -> Drawing:
        """Fits of the contours of a shape, with all that the shape says of itself.

        Parameters
        ----------
        shape : Shape
            Gives nesting, frame, unit, colours, strokes and coordinate reference.
        fits : sequence of Fit
            One for each contour, in their order.
        regularities : sequence of Regularity, optional
            What several of them repeat.

        Raises
        ------
        InvalidInputError
            If there are more or fewer fits than contours.

        Examples
        --------
        >>> import shapespline as ss
        >>> box = ss.Contour([(0, 0), (9, 0), (9, 5), (0, 5)], closed=True)
        >>> shape = ss.Shape([box, box.resampled(80)], [-1, 0], unit="mm")
        >>> drawing = ss.Drawing.of(shape, [ss.fit_curve(one, tolerance=0.1) for one in shape])
        >>> drawing.parents, drawing.unit
        ((-1, 0), 'mm')
        """
        return cls(
            fits,
            shape.parents,
            shape.frame,
            shape.unit,
            colors=shape.colors,
            widths=shape.widths,
            strokes=shape.strokes,
            reference=shape.reference,
            regularities=regularities,
        )

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

    @property
    def shape(self) -> Shape:
        """The outlines that the curves were fitted to, with all that the drawing says of itself."""
        return Shape(
            [fit.contour for fit in self.fits],
            self.parents,
            self.frame,
            self.unit,
            colors=self.colors,
            widths=self.widths,
            strokes=self.strokes,
            reference=self.reference,
        )

    def is_area(self, index: int) -> bool:
        """Whether a fit bounds an area: it is closed, and no centre line of a picture's stroke."""
        is_center_line = self.widths[index] is not None and self.strokes[index] is None
        return self.fits[index].closed and (not is_center_line or self.colors[index] is not None)

    def is_filled(self, index: int) -> bool:
        """Whether a fit is painted as an area: it bounds one, and is no stroke alone."""
        is_stroke = self.widths[index] is not None and self.colors[index] is None
        return self.is_area(index) and not is_stroke

    def is_hole(self, index: int) -> bool:
        """Whether the fit lies inside an odd number of others."""
        return nesting_depth(self.parents, index) % 2 == 1

    def __iter__(self) -> Iterator[Fit]:
        return iter(self.fits)

    # Measures of the curves

    @property
    def length(self) -> float:
        """Arc length of all curves together, data units."""
        return sum(fit.length for fit in self.fits)

    @property
    def area(self) -> float:
        """Area of the silhouette, data units squared: outlines without their holes.

        Exact up to rounding where no curve crosses itself or another; open curves have none.

        Examples
        --------
        >>> import shapespline as ss
        >>> square = ss.Contour([(0, 0), (2, 0), (2, 2), (0, 2)], closed=True).resampled(80)
        >>> hole = ss.Contour([(0.5, 0.5), (1, 0.5), (1, 1), (0.5, 1)], closed=True).resampled(40)
        >>> drawing = ss.fit_shape(ss.Shape([square, hole], [-1, 0]), tolerance=0.05)
        >>> round(drawing.area, 9), round(drawing.length, 9)
        (3.75, 10.0)
        >>> drawing.contains([(0.2, 0.2), (0.7, 0.7)]).tolist()
        [True, False]
        """
        closed = [(index, fit) for index, fit in enumerate(self.fits) if fit.closed]
        return sum((-1.0 if self.is_hole(index) else 1.0) * fit.area for index, fit in closed)

    @property
    def bounds(self) -> Box:
        """The box (x_min, y_min, x_max, y_max) of all curves, data units."""
        from shapespline.geometry import bounds

        return bounds([part for fit in self.fits for part in fit.exact_parts])

    def contains(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Which points lie in the silhouette: inside an odd number of closed curves.

        Parameters
        ----------
        points : array_like, shape (k, 2) or (2,)
            Data units. One on a curve itself, up to rounding, may count as either.

        Returns
        -------
        ndarray of bool, shape (k,)

        Raises
        ------
        InvalidInputError
            If the points are no finite (k, 2) array.
        """
        from shapespline.geometry import contains

        return contains([fit.spline for fit in self.fits if fit.closed], points)

    def transformed(self, matrix: ArrayLike) -> Drawing:
        """The image of every fit under an affine map; see `Fit.transformed`.

        The frame becomes the box around its image; the unit stays.

        Parameters
        ----------
        matrix : array_like, shape (2, 2), (2, 3) or (3, 3)

        Raises
        ------
        InvalidInputError
            If the matrix has another shape, is not finite, or flattens the plane.
        """
        from shapespline.geometry import transformed_drawing

        return transformed_drawing(self, matrix)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the data, the control polygons and the curves into axes of matplotlib.

        Parameters
        ----------
        ax : matplotlib Axes, optional
            New ones of pyplot's when not given.

        Returns
        -------
        matplotlib Axes

        Raises
        ------
        MissingExtraError
            If matplotlib is not installed.
        InvalidInputError
            If ``ax`` is no Axes.
        """
        from shapespline.plotting import plot_on_axes

        return plot_on_axes(self.fits, ax)

    def offset(self, distance: float, *, tolerance: float | None = None) -> Drawing:
        """The curves at a distance from these, holes the other way, fitted again.

        Parameters
        ----------
        distance : float
            Data units. The silhouette grows by a positive one, its holes shrink; open curves are
            offset each to its left.
        tolerance : float, optional
            Largest distance between the result and the true offset, both ways, data units; by
            default the largest of the fits, and at least 1e-4 of the box diagonal.

        Returns
        -------
        Drawing
            With its own nesting; frame and unit stay. Outlines that grow into one another
            are one.

        Raises
        ------
        InvalidInputError
            If the distance is 0 or not finite, the tolerance is not positive, closed curves cross
            themselves or each other, or the offset cannot be closed at so coarse a tolerance.
        DegenerateContourError
            If nothing is left.

        Notes
        -----
        The true offset is every point at the distance from the nearest point of the curves, on the
        side asked for: what would cross itself is cut off there, and corners that turn away are
        rounded by arcs. Outlines smaller than a third of the tolerance are left out. The distances
        of the fits are those to the true offset: that of the refit to a dense polyline of it, which
        is certified, and the allowance for that polyline (sampled, not a rigorous bound).

        Examples
        --------
        >>> import shapespline as ss
        >>> square = ss.Contour([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True).resampled(80)
        >>> hole = ss.Contour([(1, 1), (3, 1), (3, 3), (1, 3)], closed=True).resampled(80)
        >>> drawing = ss.fit_shape(ss.Shape([square, hole], [-1, 0]), tolerance=0.05)
        >>> shrunk = drawing.offset(-0.25)
        >>> len(shrunk), round(shrunk.area)
        (2, 6)
        """
        from shapespline.fitting import offset_drawing

        return offset_drawing(self, distance, tolerance=tolerance)
