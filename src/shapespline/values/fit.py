"""Fit and Status: one curve with what was verified about it."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray
    from scipy.interpolate import BSpline

    from shapespline.geometry import Box
    from shapespline.monitor import Iteration
    from shapespline.typing import ArrayLike, FloatArray, IntArray
    from shapespline.values.contour import Contour
    from shapespline.values.curve import BSplineCurve
    from shapespline.values.snapshot import Snapshot
    from shapespline.values.uncertainty import Band, Uncertainty
from shapespline.values.equality import ByValue
from shapespline.values.piece import CORNER_TURN, Piece
from shapespline.values.shape import counted
from shapespline.values.shown import Shown


@dataclass(frozen=True, eq=False)
class Status:
    """How a fit ended: one of four names, and a sentence with figures and a remedy.

    Two statuses are equal when their names are: ``fit.status == Status.KEPT``.
    """

    name: str
    value: str

    KEPT: ClassVar[Status]
    EXCEEDED: ClassVar[Status]
    BUDGET: ClassVar[Status]
    CANCELLED: ClassVar[Status]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Status) and self.name == other.name

    def __hash__(self) -> int:
        return hash(self.name)

    def __str__(self) -> str:
        return self.value

    def saying(self, sentence: str) -> Status:
        """The same status with its own sentence."""
        return Status(self.name, sentence)


Status.KEPT = Status("KEPT", "both distances are within the tolerance")
Status.EXCEEDED = Status("EXCEEDED", "a distance exceeds the tolerance")
Status.BUDGET = Status("BUDGET", "a budget ran out before the fit had converged")
Status.CANCELLED = Status("CANCELLED", "the callback cancelled the fit")


@dataclass(frozen=True, eq=False, kw_only=True)
class Fit(ByValue, Shown):
    """A curve fitted to a contour, and what is known about it.

    Fits are equal when curve, data, figures and the name of the status are; their histories, which
    tell seconds, may differ.

    Attributes
    ----------
    spline : BSplineCurve
        The curve over [0, 1]; ``curve`` is the same as a scipy BSpline.
    contour : Contour
        The data.
    parameters : ndarray, shape (n_given,)
        The nearest foot parameter of every point that was given and not left out.
    max_distance, rms_distance : float
        Data to curve, data units; the maximum is an upper bound up to rounding.
    hausdorff_distance : float
        Certified upper bound of the larger of data -> curve and curve -> data polyline.
    tolerance : float
        The one asked for, or the one found: then it is ``hausdorff_distance``.
    status : Status
        ``status.value`` is a sentence with figures.
    history : tuple of Iteration
        One record per iteration, the start first.
    method : str
        Name of the solver.
    sections : tuple of Piece
        The pieces that the curve was made of, end to end; empty for a single spline.
    outliers : ndarray
        Indices, among the points that were given, of those left out on request.
    snapshots : tuple of Snapshot
        Curves on the way, where `optimize` was asked to keep them.
    uncertainty : Uncertainty or None
        Where the errors of the points were given.
    """

    spline: BSplineCurve
    contour: Contour
    parameters: FloatArray = field(repr=False)
    max_distance: float
    rms_distance: float
    hausdorff_distance: float
    tolerance: float
    status: Status
    history: tuple[Iteration, ...] = field(repr=False)
    method: str
    sections: tuple[Piece, ...] = field(default=(), repr=False)
    outliers: IntArray = field(default_factory=lambda: np.empty(0, dtype=np.int64), repr=False)
    snapshots: tuple[Snapshot, ...] = field(default=(), repr=False)
    uncertainty: Uncertainty | None = field(default=None, repr=False)

    # How the iterations went, with their seconds, is no part of the result.
    _BESIDE: ClassVar = frozenset({"history", "snapshots", "uncertainty"})

    def __post_init__(self) -> None:
        self._protect()

    def _protect(self) -> None:
        """Make the arrays read-only, as those of the curve and the contour are."""
        held = [array for piece in self.sections for array in (piece.knots, piece.control_points)]
        for array in (self.parameters, self.outliers, *held):
            array.setflags(write=False)

    # Between processes go the fields alone, and come back read-only.
    def __getstate__(self) -> dict[str, object]:
        return {item.name: getattr(self, item.name) for item in fields(self)}

    def __setstate__(self, state: dict[str, object]) -> None:
        for name, value in state.items():
            object.__setattr__(self, name, value)
        self._protect()

    def __repr__(self) -> str:
        kind = "closed" if self.closed else "open"
        return (
            f"Fit({kind}, {counted(len(self.pieces), 'piece')} of degree {self.degree},"
            f" {self.n_stored_points} stored points, distance {self.hausdorff_distance:.3g},"
            f" tolerance {self.tolerance:.3g}, {self.status.name})"
        )

    @cached_property
    def curve(self) -> BSpline:
        """The whole result as one ``scipy.interpolate.BSpline``, periodic if smooth and closed."""
        return self.spline.to_scipy()

    @property
    def control_points(self) -> FloatArray:
        """Distinct control points, shape (m, 2)."""
        return self.spline.control_points

    @property
    def n_control_points(self) -> int:
        """Number of distinct control points."""
        return self.spline.n_control_points

    @property
    def knots(self) -> FloatArray:
        """Full knot array of ``curve``."""
        return self.spline.knots

    @property
    def degree(self) -> int:
        """Degree of ``curve``."""
        return self.spline.degree

    @property
    def closed(self) -> bool:
        """Whether the curve ends where it begins."""
        ends = self.control_points[[0, -1]]
        return self.spline.periodic or bool((ends[0] == ends[1]).all())

    @property
    def corners(self) -> FloatArray:
        """Parameters where the curve turns by more than a degree, shape (c,)."""
        pieces, breakpoints = self.spline.beziers()
        arriving, leaving = pieces[:, -1] - pieces[:, -2], pieces[:, 1] - pieces[:, 0]
        if self.closed:
            before, at = np.roll(arriving, 1, axis=0), breakpoints[:-1]
        else:
            before, leaving, at = arriving[:-1], leaving[1:], breakpoints[1:-1]
        turn = before[:, 0] * leaving[:, 1] - before[:, 1] * leaving[:, 0]
        along = (before * leaving).sum(axis=1)
        return at[np.abs(np.arctan2(turn, along)) > CORNER_TURN]

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The curve end to end as lines, Beziers or splines."""
        if self.sections:
            return self.sections
        spline = self.spline
        without_inner_knots = len(spline.breakpoints) == 2 and not spline.periodic
        kind = "line" if spline.degree == 1 else "bezier"
        return (
            Piece(
                kind if without_inner_knots else "spline",
                spline.degree,
                spline.knots,
                spline.coefficients,
            ),
        )

    @property
    def n_stored_points(self) -> int:
        """Distinct points that a file of the pieces stores.

        A line counts 1, a quadratic 2, a cubic 3, a spline with k interior knots its degree + k;
        an open curve one more.
        """
        if self.spline.periodic and not self.sections:
            return self.n_control_points
        stored = sum(len(piece.control_points) - 1 for piece in self.pieces)
        return stored + int(not self.closed)

    @property
    def covariance(self) -> FloatArray:
        """Covariance of the control points, x and y in turn, shape (2 m, 2 m)."""
        return self._known_uncertainty().covariance

    def band(
        self,
        level: float = 0.95,
        *,
        simultaneous: bool = False,
        parameters: ArrayLike | int = 1000,
    ) -> Band:
        """The band that holds the true curve with a probability; see `confidence_band`."""
        from shapespline.geometry import confidence_band

        return confidence_band(
            self.spline,
            self._known_uncertainty(),
            level,
            simultaneous=simultaneous,
            parameters=parameters,
        )

    def _known_uncertainty(self) -> Uncertainty:
        if self.uncertainty is None:
            raise InvalidInputError(
                "fit knows no errors of its points: make it with optimize(..., sigma=)"
            )
        return self.uncertainty

    @property
    def kept(self) -> bool:
        """Whether both bounds are within the tolerance."""
        return max(self.max_distance, self.hausdorff_distance) <= self.tolerance

    # Measures of the curve

    @property
    def length(self) -> float:
        """Arc length of the curve, data units; exact to rounding unless its speed nears zero."""
        return self.spline.length()

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
        return abs(enclosed_area(self.spline))

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

        return bounds([self.spline])

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

        return transformed_fit(self, matrix)

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

        return reversed_fit(self)

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

        return split_fit(self, at)

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

        return plot_on_axes([self], ax)

    def _check_closed(self, name: str) -> None:
        """Raise if the curve is open."""
        if not self.closed:
            raise InvalidInputError(
                f"{name} is of a closed curve, got an open one; give closed=True to the fit"
            )
