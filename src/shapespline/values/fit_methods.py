"""What a fit can be asked: measures of its curve, the same curve elsewhere, and pictures of it."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, cast

from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from shapespline.geometry import Box
    from shapespline.typing import ArrayLike, FloatArray
    from shapespline.values.arc import Arc
    from shapespline.values.contour import Contour
    from shapespline.values.curve import BSplineCurve
    from shapespline.values.drawing import Drawing
    from shapespline.values.fit import Fit
    from shapespline.values.piece import Piece


class FitMethods:
    """The methods of `Fit` that ask other rooms."""

    if TYPE_CHECKING:  # the fields that a fit has
        spline: BSplineCurve
        sections: tuple[Piece, ...]
        contour: Contour

        @property
        def closed(self) -> bool:
            """Whether the curve ends where it begins."""

        @property
        def exact_parts(self) -> list[BSplineCurve | Arc]:
            """The curve in as few parts as it takes to tell arcs from splines."""

    # Measures of the curve

    @property
    def length(self) -> float:
        """Arc length of the curve, data units; exact to rounding unless its speed nears zero."""
        return sum(part.length() for part in self.exact_parts)

    @cached_property
    def source_distance(self) -> float | None:
        """Certified bound of the distance between the curve and the level line of a picture.

        Data units, both ways; None where the data were not traced. The curve follows the contour,
        which has the corners that pixels cut off, so this is larger than ``hausdorff_distance`` by
        what the contour lies beside its level line.

        Examples
        --------
        >>> import numpy as np, shapespline as ss
        >>> picture = np.full((40, 40), 255, dtype=np.uint8)
        >>> picture[10:30, 15:25] = 0
        >>> (fit,) = ss.fit_shape(ss.trace(picture), tolerance=0.1)
        >>> fit.hausdorff_distance <= 0.1, 0 < fit.source_distance <= 0.6
        (True, True)
        """
        from shapespline.geometry import two_sided_distance

        line = self.contour.level_line
        if line is None:
            return None
        source = type(self.contour).silently(line, self.contour.closed)
        return two_sided_distance(self.spline, source).hausdorff_distance

    @property
    def area(self) -> float:
        """Area within a closed curve, data units squared, exact up to rounding.

        Of a curve that crosses itself, parts that run the other way count negative.

        Raises
        ------
        InvalidInputError
            If the curve is open.

        Examples
        --------
        >>> import shapespline as ss
        >>> square = ss.Contour([(0, 0), (2, 0), (2, 2), (0, 2)], closed=True).resampled(80)
        >>> round(ss.fit_curve(square, tolerance=0.01).area, 9)
        4.0
        """
        from shapespline.geometry import enclosed_area

        self._check_closed("area")
        return abs(enclosed_area(self.spline, self.sections))

    @property
    def bounds(self) -> Box:
        """The box (x_min, y_min, x_max, y_max) of the curve, data units, exact up to rounding.

        Examples
        --------
        >>> import shapespline as ss
        >>> fit = ss.fit_curve([(0, 0), (4, 0), (4, 3)], closed=False, tolerance=0.01)
        >>> fit.bounds
        Box(x_min=0.0, y_min=0.0, x_max=4.0, y_max=3.0)
        """
        from shapespline.geometry import bounds

        return bounds(self.exact_parts)

    def contains(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Which points lie inside a closed curve, by the even-odd rule.

        Parameters
        ----------
        points : array_like, shape (k, 2) or (2,)
            Data units. One on the curve itself, up to rounding, may count as either.

        Returns
        -------
        ndarray of bool, shape (k,)

        Raises
        ------
        InvalidInputError
            If the curve is open, or the points are no finite (k, 2) array.

        Examples
        --------
        >>> import shapespline as ss
        >>> square = ss.Contour([(0, 0), (2, 0), (2, 2), (0, 2)], closed=True).resampled(80)
        >>> ss.fit_curve(square, tolerance=0.01).contains([(1, 1), (3, 1)]).tolist()
        [True, False]
        """
        from shapespline.geometry import contains

        self._check_closed("contains")
        return contains([self.spline], points)

    def points(self, n: int | None = None, *, step: float | None = None) -> FloatArray:
        """Points of the curve at equal arc length, from its beginning.

        Parameters
        ----------
        n : int, optional
            How many: an open curve from end to end, 2 or more; a closed one without the first
            point repeated, 1 or more.
        step : float, optional
            Instead: the largest arc length from one to the next, data units; all steps are equal.

        Returns
        -------
        ndarray, shape (n, 2)

        Raises
        ------
        InvalidInputError
            Unless one of both is given and in range.

        Examples
        --------
        >>> import shapespline as ss
        >>> fit = ss.fit_curve([(0, 0), (4, 0)], closed=False, tolerance=0.01)
        >>> fit.points(3).tolist(), len(fit.points(step=0.3))
        ([[0.0, 0.0], [2.0, 0.0], [4.0, 0.0]], 15)
        """
        from shapespline.geometry import evenly_spaced

        return self.spline(evenly_spaced(self.spline, n, step=step, closed=self.closed))

    # The same curve elsewhere, the other way, in parts

    def transformed(self, matrix: ArrayLike) -> Fit:
        """The image of curve and data under an affine map.

        Parameters
        ----------
        matrix : array_like, shape (2, 2), (2, 3) or (3, 3)
            Multiplies columns (x, y) or (x, y, 1); the last row of three is 0, 0, 1.

        Returns
        -------
        Fit
            Under a similarity (rotation, mirror, scale, shift) distances and tolerance are
            multiplied by its factor, up to rounding. Under another map the tolerance is multiplied
            by the largest factor of a length, which keeps every promise; the distances are measured
            anew. The history stays behind.

        Raises
        ------
        InvalidInputError
            If the matrix has another shape, is not finite, or flattens the plane.

        Examples
        --------
        >>> import shapespline as ss
        >>> fit = ss.fit_curve([(0, 0), (4, 0), (4, 3)], closed=False, tolerance=0.01)
        >>> turned = fit.transformed([[0, -2], [2, 0]])
        >>> turned.bounds, turned.tolerance
        (Box(x_min=-6.0, y_min=0.0, x_max=0.0, y_max=8.0), 0.02)
        """
        from shapespline.geometry import transformed_fit

        return transformed_fit(cast("Fit", self), matrix)

    def reversed(self) -> Fit:
        """The same curve and data the other way: parameter u of one is 1 - u of the other.

        Examples
        --------
        >>> import shapespline as ss
        >>> fit = ss.fit_curve([(0, 0), (4, 0), (4, 3)], closed=False, tolerance=0.01)
        >>> fit.reversed().spline([0, 1]).tolist()
        [[4.0, 3.0], [0.0, 0.0]]
        """
        from shapespline.geometry import reversed_fit

        return reversed_fit(cast("Fit", self))

    def split(self, at: ArrayLike) -> tuple[Fit, ...]:
        """The curve in parts, cut at parameters; every part is an open fit of its part of the data.

        The parts are the same curve, exactly up to rounding. Their data are cut where they are
        nearest to the ends of the parts. Distances are measured anew and the status of a part says
        whether it keeps the tolerance; beside a cut a distance can grow a little.

        Parameters
        ----------
        at : array_like, shape (k,), or float
            Parameters of ``curve``, 0 to 1. A closed curve gives one part for each, from there to
            the next; an open one gives one part more, and cuts at its ends count for nothing.

        Returns
        -------
        tuple of Fit

        Raises
        ------
        InvalidInputError
            If there is no parameter, or one is outside 0 to 1.
        DegenerateContourError
            If a part is too short to hold two points.

        Examples
        --------
        >>> import shapespline as ss
        >>> fit = ss.fit_curve([(0, 0), (4, 0)], closed=False, tolerance=0.01)
        >>> [part.length for part in fit.split(0.25)]
        [1.0, 3.0]
        """
        from shapespline.geometry import split_fit

        return split_fit(cast("Fit", self), at)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the data, the control polygon and the curve into axes of matplotlib.

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

        Examples
        --------
        >>> import matplotlib
        >>> matplotlib.use("agg")
        >>> import shapespline as ss
        >>> axes = ss.fit_curve([(0, 0), (4, 0), (4, 3)], closed=False, tolerance=0.01).plot()
        >>> len(axes.lines)
        3
        """
        from shapespline.plotting import plot_on_axes

        return plot_on_axes([cast("Fit", self)], ax)

    def offset(self, distance: float, *, tolerance: float | None = None) -> Drawing:
        """The curves at a distance from this one, fitted again within a tolerance.

        Parameters
        ----------
        distance : float
            Data units. A closed curve grows by a positive one and shrinks by a negative one; of an
            open one the offset lies to its left if positive.
        tolerance : float, optional
            Largest distance between the result and the true offset, both ways, data units; by
            default that of the fit, and at least 1e-4 of the box diagonal.

        Returns
        -------
        Drawing
            One fit for each outline that is left: a waist can part in two, a bay close to a hole.

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
        >>> square = ss.Contour([(0, 0), (2, 0), (2, 2), (0, 2)], closed=True).resampled(80)
        >>> fit = ss.fit_curve(square, tolerance=0.01)
        >>> round(fit.offset(-0.5).area, 2), round(fit.offset(0.5, tolerance=0.001).area, 2)
        (1.0, 8.79)
        """
        from shapespline.fitting import offset_drawing
        from shapespline.values.drawing import Drawing

        return offset_drawing(Drawing([cast("Fit", self)]), distance, tolerance=tolerance)

    def _check_closed(self, name: str) -> None:
        """Raise if the curve is open."""
        if not self.closed:
            raise InvalidInputError(
                f"{name} is of a closed curve, got an open one; give closed=True to the fit"
            )
