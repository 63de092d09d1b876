"""BSplineCurve: a plane B-spline curve as a value; evaluation, derivatives, length, Beziers.

Evaluation is done by the compiled kernel; scipy is imported only when its BSpline is asked for.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.errors import InvalidInputError
from shapespline.validation import float_array
from shapespline.values.equality import ByValue
from shapespline.values.knots import check_degree, check_knots, greville_abscissae

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

    from shapespline.typing import ArrayLike, FloatArray, IntArray

# Nodes and weights of the quadrature of a length.
GAUSS = np.polynomial.legendre.leggauss(16)


class BezierPieces(NamedTuple):
    """Bezier curves end to end: ``points`` (s, degree + 1, 2), ``breakpoints`` (s + 1,)."""

    points: FloatArray
    breakpoints: FloatArray


def unrolled(control_points: FloatArray, n_coefficients: int) -> FloatArray:
    """Control points repeated cyclically up to the number that the knots ask for."""
    if len(control_points) == n_coefficients:
        return control_points
    return control_points[np.arange(n_coefficients) % len(control_points)]


@dataclass(frozen=True, eq=False, init=False)
class BSplineCurve(ByValue):
    """A plane B-spline curve, clamped or periodic.

    Parameters
    ----------
    knots : array_like, shape (n_coefficients + degree + 1,)
        Full non-decreasing knot array.
    control_points : array_like, shape (m, 2)
        The distinct control points, data units: ``m = n_coefficients`` for a clamped curve,
        ``n_coefficients - degree`` for a periodic one.
    degree : int
        1 to 9.
    periodic : bool
        Whether the curve closes on itself as smoothly as inside.

    Raises
    ------
    InvalidInputError, OrderError
        If the knots are not valid or do not fit the control points.

    Examples
    --------
    >>> from shapespline.values import clamped_knots
    >>> line = BSplineCurve(clamped_knots(2, 1), [(0, 0), (2, 4)], degree=1)
    >>> line([0.5]).tolist(), line([0.5], derivative=1).tolist(), round(line.length(), 6)
    ([[1.0, 2.0]], [[2.0, 4.0]], 4.472136)
    """

    knots: FloatArray
    control_points: FloatArray
    degree: int
    periodic: bool

    def __init__(
        self, knots: ArrayLike, control_points: ArrayLike, degree: int, periodic: bool = False
    ) -> None:
        degree = check_degree(degree)
        knots = float_array(knots, "knots")
        points = float_array(control_points, "control_points")
        check_knots(knots, degree, periodic=periodic)
        expected = len(knots) - degree - 1 - (degree if periodic else 0)
        if points.shape != (expected, 2):
            raise InvalidInputError(
                f"control_points must have shape ({expected}, 2) for {len(knots)} knots of degree"
                f" {degree}, got {points.shape}"
            )
        if not np.isfinite(points).all():
            raise InvalidInputError("control_points must be finite, got NaN or infinity")
        self._set(knots, points, degree, bool(periodic))

    @classmethod
    def trusted(
        cls, knots: FloatArray, control_points: FloatArray, degree: int, periodic: bool
    ) -> BSplineCurve:
        """The same unchecked and not copied, for arrays that come from a curve."""
        curve = cls.__new__(cls)
        curve._set(knots, control_points, degree, periodic)
        return curve

    def _set(
        self, knots: FloatArray, control_points: FloatArray, degree: int, periodic: bool
    ) -> None:
        knots.setflags(write=False)
        control_points.setflags(write=False)
        object.__setattr__(self, "knots", knots)
        object.__setattr__(self, "control_points", control_points)
        object.__setattr__(self, "degree", degree)
        object.__setattr__(self, "periodic", periodic)

    # Between processes go the fields alone, and come back read-only.
    def __getstate__(self) -> tuple[FloatArray, FloatArray, int, bool]:
        return self.knots, self.control_points, self.degree, self.periodic

    def __setstate__(self, state: tuple[FloatArray, FloatArray, int, bool]) -> None:
        self._set(*state)

    def __repr__(self) -> str:
        kind = "periodic" if self.periodic else "clamped"
        return f"BSplineCurve({kind}, degree {self.degree}, {self.n_control_points} control points)"

    @property
    def n_control_points(self) -> int:
        """Number of distinct control points."""
        return len(self.control_points)

    @cached_property
    def coefficients(self) -> FloatArray:
        """Control points as the knots count them, the first repeated at the end if periodic."""
        return unrolled(self.control_points, len(self.knots) - self.degree - 1)

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter."""
        return float(self.knots[self.degree]), float(self.knots[-self.degree - 1])

    @cached_property
    def breakpoints(self) -> FloatArray:
        """Distinct knots of the domain."""
        inside = self.knots[self.degree : len(self.knots) - self.degree]
        first = np.ones(len(inside), dtype=bool)
        np.greater(inside[1:], inside[:-1], out=first[1:])
        return inside[first]

    @property
    def greville(self) -> FloatArray:
        """Greville abscissae of the distinct control points, unwrapped."""
        return greville_abscissae(self.knots, self.degree)[: self.n_control_points]

    def __call__(self, parameters: ArrayLike, derivative: int = 0) -> FloatArray:
        """Points, or derivatives with respect to the parameter, shape (k, 2).

        A periodic curve reads parameters modulo its period, an open one extends its end
        polynomials. At a knot the span to the right counts, at the end of the domain the left.
        """
        u = np.atleast_1d(float_array(parameters, "parameters"))
        if u.ndim != 1 or not np.isfinite(u).all():
            raise InvalidInputError(
                f"parameters must be one array of finite numbers, got shape {u.shape}"
                f" with {int((~np.isfinite(u)).sum())} that are not finite"
            )
        if derivative < 0:
            raise InvalidInputError(f"derivative must not be negative, got {derivative}")
        if derivative > self.degree:
            return np.zeros((len(u), 2))
        knots, coefficients, degree = self.knots, self.coefficients, self.degree
        for _ in range(derivative):
            knots, coefficients = _differentiated(knots, coefficients, degree)
            degree -= 1
        if degree == 0:
            return coefficients[self._span(u)]
        out = np.empty((len(u), 2))
        _kernels.evaluate(knots, degree, self.periodic, coefficients, u, out)
        return out

    def _span(self, u: FloatArray) -> IntArray:
        """Index of the knot span of each parameter, counted from the first of the domain."""
        begin, end = self.domain
        if self.periodic:
            u = begin + np.mod(u - begin, end - begin)
        inside = self.knots[self.degree + 1 : len(self.knots) - self.degree - 1]
        return np.searchsorted(inside, u, side="right")

    def beziers(self) -> BezierPieces:
        """Exact Bezier pieces, one for each non-empty knot span of the domain.

        Examples
        --------
        >>> from shapespline.values import clamped_knots
        >>> curve = BSplineCurve(clamped_knots(4, 2), [(0, 0), (1, 2), (3, 2), (4, 0)], degree=2)
        >>> curve.beziers().points[0].tolist()
        [[0.0, 0.0], [1.0, 2.0], [2.0, 2.0]]
        """
        n_pieces = len(self.breakpoints) - 1
        points = np.empty((n_pieces * (self.degree + 1), 2))
        breakpoints = np.empty(n_pieces + 1)
        _kernels.bezier_pieces(self.knots, self.degree, self.coefficients, points, breakpoints)
        return BezierPieces(points.reshape(n_pieces, self.degree + 1, 2), breakpoints)

    def length(self) -> float:
        """Arc length by 16-point Gauss-Legendre quadrature on four parts of every span.

        Exact to rounding where the speed does not come near zero; not a rigorous bound.
        """
        nodes, weights = GAUSS
        cuts = np.linspace(self.breakpoints[:-1], self.breakpoints[1:], 5, axis=1)
        begin, end = cuts[:, :-1].ravel(), cuts[:, 1:].ravel()
        half = 0.5 * (end - begin)
        at = 0.5 * (begin + end)[:, None] + half[:, None] * nodes
        velocity = self(at.ravel(), derivative=1)
        speed = np.hypot(velocity[:, 0], velocity[:, 1]).reshape(at.shape)
        return float(np.sum(half * (speed @ weights)))

    def curvature(self, parameters: ArrayLike) -> FloatArray:
        """Signed curvature, positive where the curve turns left, 1 / data units, shape (k,).

        NaN where the curve stands still.
        """
        first, second = self(parameters, derivative=1), self(parameters, derivative=2)
        turn = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            return turn / np.hypot(first[:, 0], first[:, 1]) ** 3

    def to_scipy(self) -> BSpline:
        """The same curve as a ``scipy.interpolate.BSpline`` with values of shape (2,).

        A periodic curve whose seam is a multiple knot becomes its exact open form: scipy would look
        for its end in an empty span and return zeros.
        """
        from scipy.interpolate import BSpline

        extrapolate = "periodic" if self.periodic else True
        n = len(self.coefficients)
        same = self.clamped() if self.knots[n - 1] == self.knots[n] else self
        return BSpline(same.knots, same.coefficients, same.degree, extrapolate=extrapolate)

    def clamped(self) -> BSplineCurve:
        """The same curve with clamped knots: of a periodic one its exact open form.

        Examples
        --------
        >>> from shapespline.values import periodic_knots
        >>> ring = BSplineCurve(
        ...     periodic_knots(4, 2), [(1, 0), (0, 1), (-1, 0), (0, -1)], 2, periodic=True
        ... )
        >>> ring.clamped().n_control_points, bool((ring([0.3]) == ring.clamped()([0.3])).all())
        (6, True)
        """
        if not self.periodic:
            return self
        knots, points = clamped_ends(self.knots, self.coefficients, self.degree)
        points[-1] = points[0]  # knot insertion may miss it by a rounding
        return BSplineCurve(knots, points, self.degree)

    @classmethod
    def from_scipy(cls, spline: BSpline) -> BSplineCurve:
        """A plane ``scipy.interpolate.BSpline`` as a BSplineCurve.

        Periodic if it extrapolates periodically and its knots and coefficients repeat; otherwise
        clamped, by knot insertion at the ends of its domain where need be.

        Examples
        --------
        >>> from shapespline.values import clamped_knots
        >>> curve = BSplineCurve(clamped_knots(4, 3), [(0, 0), (1, 2), (3, 2), (4, 0)], degree=3)
        >>> BSplineCurve.from_scipy(curve.to_scipy()).control_points.tolist()
        [[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0]]
        """
        degree, knots = check_degree(spline.k), np.asarray(spline.t, dtype=np.float64)
        n_coefficients = len(knots) - degree - 1
        coefficients = np.asarray(spline.c, dtype=np.float64)[:n_coefficients]
        if coefficients.shape != (n_coefficients, 2):
            raise InvalidInputError(
                f"spline must have plane values: coefficients of shape ({n_coefficients}, 2),"
                f" got {np.shape(spline.c)}"
            )
        m = n_coefficients - degree
        if (
            spline.extrapolate == "periodic"
            and m > degree
            and np.array_equal(coefficients[m:], coefficients[:degree])
        ):
            return cls(knots, coefficients[:m], degree, periodic=True)
        return cls(*clamped_ends(knots, coefficients, degree), degree)


def _differentiated(
    knots: FloatArray, coefficients: FloatArray, degree: int
) -> tuple[FloatArray, FloatArray]:
    """Knots and coefficients of the derivative, degree - 1 (de Boor, chapter X, equation 15)."""
    width = (knots[degree + 1 : -1] - knots[1 : -degree - 1])[:, None]
    difference = np.diff(coefficients, axis=0)
    slope = np.divide(degree * difference, width, out=np.zeros_like(difference), where=width > 0)
    return np.ascontiguousarray(knots[1:-1]), slope


def clamped_ends(
    knots: FloatArray, coefficients: FloatArray, degree: int
) -> tuple[FloatArray, FloatArray]:
    """Knots and coefficients of the same curve, clamped at the ends of its domain."""
    begin, end = knots[degree], knots[len(coefficients)]
    for at in (begin, end):
        missing = degree - int(np.count_nonzero(knots == at))
        for _ in range(max(missing, 0)):
            knots, coefficients = with_knot(knots, coefficients, degree, at)
    first = int(np.searchsorted(knots, begin, side="right")) - degree
    last = int(np.searchsorted(knots, end, side="left"))
    inner = knots[first + degree : last]
    knots = np.concatenate([np.full(degree + 1, begin), inner, np.full(degree + 1, end)])
    return knots, coefficients[first - 1 : last].copy()


def with_knot(
    knots: FloatArray, coefficients: FloatArray, degree: int, at: float
) -> tuple[FloatArray, FloatArray]:
    """The same curve with one more knot (Boehm 1980)."""
    span = int(np.searchsorted(knots, at, side="right")) - 1
    span = min(span, len(coefficients) - 1) if at < knots[-1] else len(coefficients) - 1
    index = np.arange(span - degree + 1, span + 1)
    low, high = knots[index], knots[index + degree]
    share = np.divide(at - low, high - low, out=np.zeros(degree), where=high > low)[:, None]
    blended = share * coefficients[index] + (1 - share) * coefficients[index - 1]
    return (
        np.insert(knots, span + 1, at),
        np.concatenate([coefficients[: span - degree + 1], blended, coefficients[span:]]),
    )
