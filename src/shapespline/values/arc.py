"""Arc: part of a circle, or all of it, and the B-spline that stands for it.

A circle is no polynomial, so an arc has a twin: a cubic C1 B-spline with its ends and end tangents,
n Beziers of equal angle whose nodes lie on the circle. With handles of length h R, a Bezier about
an angle 2 a has

    (r / R)^2 - 1 = A s^2 + B s^3,   s = t (1 - t),   q = 2 sin a - 3 h cos a,
    A = 9 h^2 sin^2 a + q^2 - 8 q sin a,   B = -4 q^2,

which is of one sign for the textbook's h = 4/3 tan(a / 2) [1]_. Here h makes the outer and the
inner error equal: 1.96e-4 R instead of 2.73e-4 R for a quarter, times (angle / 90 degrees)^6.

References
----------
.. [1] M. Goldapp, "Approximation of circular arcs by cubic polynomials", Computer Aided Geometric
   Design 8, 1991, 227-238.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, ceil, cos, dist, isfinite, pi, sin, sqrt
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.validation import float_array, is_number

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike, FloatArray

# A sweep that is nearer to a full turn than this, radians, is one: angles come in degrees, or from
# an arc tangent, and lose a few units in the last place.
FULL_TURN, TURN_ROUNDING = 2.0 * pi, 1e-12
# A matrix whose determinant is this near to 1 is a motion's.
MOTION = 1e-15
# The twin lies within these parts of the tolerance and of the radius, or within the last where no
# tolerance was asked for, and is never asked for more than rounding allows (VAL-02).
TOLERANCE_PART, RADIUS_PART, READ_PART, LEAST_PART = 0.01, 1e-4, 1e-9, 1e-13
# A Bezier of a twin turns by a quarter at most.
LARGEST_PART = 0.5 * pi
# -B / A where the errors to both sides are equal: the root above 4 of x^3 / 4 - x^2 = 64 / 27.
BALANCE = 4.473735196810826


@dataclass(frozen=True)
class Arc:
    """An arc of a circle, or a whole circle.

    Parameters
    ----------
    centre : pair of float
    radius : float
        Positive.
    start_angle : float
        Radians, from the x axis to the beginning.
    sweep : float
        Radians, positive counter-clockwise; at most a full turn, which is a whole circle.

    Raises
    ------
    InvalidInputError
        If a number is not finite, the radius is not positive, or the sweep is 0 or more than a
        turn.

    Examples
    --------
    >>> quarter = Arc((1.0, 0.0), 2.0, 0.0, pi / 2)
    >>> quarter.begin.tolist(), quarter.end.round(9).tolist(), round(quarter.length(), 9)
    ([3.0, 0.0], [1.0, 2.0], 3.141592654)
    """

    centre: tuple[float, float]
    radius: float
    start_angle: float
    sweep: float

    def __post_init__(self) -> None:
        centre = float_array(self.centre, "centre of an arc")
        if centre.shape != (2,) or not np.isfinite(centre).all():
            raise InvalidInputError(
                f"centre of an arc must be two finite numbers, got {self.centre!r}"
            )
        numbers = {"radius": self.radius, "start_angle": self.start_angle, "sweep": self.sweep}
        for name, number in numbers.items():
            if not (is_number(number) and isfinite(number)):
                raise InvalidInputError(f"{name} of an arc must be finite, got {number!r}")
        if not self.radius > 0:
            raise InvalidInputError(f"radius of an arc must be positive, got {self.radius!r}")
        turn = abs(self.sweep)
        if not 0 < turn <= FULL_TURN + TURN_ROUNDING:
            raise InvalidInputError(
                "sweep of an arc must be between -2 pi and 2 pi radians and not 0, got"
                f" {self.sweep!r}"
            )
        whole = turn >= FULL_TURN - TURN_ROUNDING
        sweep = float(np.copysign(FULL_TURN, self.sweep)) if whole else float(self.sweep)
        object.__setattr__(self, "centre", tuple(centre.tolist()))
        for name, number in (numbers | {"sweep": sweep}).items():
            object.__setattr__(self, name, float(number))

    @classmethod
    def through(cls, begin: ArrayLike, end: ArrayLike, sweep: float) -> Arc:
        """The arc from one point to another that turns by a sweep, less than a full turn.

        Examples
        --------
        >>> arc = Arc.through((1, 0), (0, 1), pi / 2)
        >>> [round(value, 9) + 0.0 for value in (*arc.centre, arc.radius)]
        [0.0, 0.0, 1.0]
        """
        (ax, ay), (bx, by) = (np.array(point, dtype=np.float64).tolist() for point in (begin, end))
        half = 0.5 * sweep
        if not (0 < abs(half) < pi and (ax, ay) != (bx, by)):
            raise InvalidInputError(
                "an arc between two points needs two that differ and a sweep between -2 pi and"
                f" 2 pi, got {sweep!r} from {(ax, ay)} to {(bx, by)}"
            )
        # From the middle of the chord to the left, in chords.
        left = 0.5 * cos(half) / sin(half)
        x = 0.5 * (ax + bx) - left * (by - ay)
        y = 0.5 * (ay + by) + left * (bx - ax)
        radius = 0.5 * dist((ax, ay), (bx, by)) / sin(abs(half))
        return cls((x, y), radius, atan2(ay - y, ax - x), sweep)

    @property
    def is_circle(self) -> bool:
        """Whether it turns all around."""
        return abs(self.sweep) == FULL_TURN

    @property
    def end_angle(self) -> float:
        """Radians, from the x axis to the end; not reduced to a turn."""
        return self.start_angle + self.sweep

    @property
    def begin(self) -> FloatArray:
        """Where the arc begins, shape (2,)."""
        return self.at(0.0)

    @property
    def end(self) -> FloatArray:
        """Where the arc ends, shape (2,); of a circle where it begins."""
        return self.at(0.0 if self.is_circle else 1.0)

    def at(self, share: ArrayLike) -> FloatArray:
        """Points at parts of the sweep, 0 to 1, shape (..., 2)."""
        turned = self.sweep * np.asarray(share, dtype=np.float64)
        x, y = self.centre
        a, r = self.start_angle, self.radius
        # By the chord from the beginning: of a flat arc the radius cancels almost all digits.
        chord, way = 2.0 * r * np.sin(0.5 * turned), a + 0.5 * turned
        along = np.stack([-np.sin(way), np.cos(way)], axis=-1)
        return np.array([x + r * cos(a), y + r * sin(a)]) + chord[..., None] * along

    def length(self) -> float:
        """Arc length, in the unit of the radius."""
        return self.radius * abs(self.sweep)

    def nearest(self, points: ArrayLike) -> FloatArray:
        """The points of the arc itself that are nearest to points (n, 2), shape (n, 2)."""
        given = np.asarray(points, dtype=np.float64)
        x, y = (given - self.centre).T
        turned = np.copysign(1.0, self.sweep) * (np.arctan2(y, x) - self.start_angle)
        share = np.mod(turned, FULL_TURN) / abs(self.sweep)
        to_begin, to_end = (np.hypot(*(given - end).T) for end in (self.begin, self.end))
        return self.at(np.where(share <= 1.0, share, np.where(to_begin <= to_end, 0.0, 1.0)))

    def distances(self, points: ArrayLike) -> FloatArray:
        """Distance of points (n, 2) to the arc itself, shape (n,).

        Examples
        --------
        >>> Arc((0, 0), 1.0, 0.0, pi).distances([(0, 3), (0, 0), (1, -1)]).tolist()
        [2.0, 1.0, 1.0]
        """
        away = np.asarray(points, dtype=np.float64) - self.nearest(points)
        return np.hypot(away[:, 0], away[:, 1])

    def reversed(self) -> Arc:
        """The same arc from its end to its beginning."""
        begin = self.start_angle if self.is_circle else self.end_angle
        return Arc(self.centre, self.radius, begin, -self.sweep)

    def part(self, begin: float, end: float) -> Arc:
        """What lies between two parts of the sweep, 0 to 1."""
        first = self.start_angle + begin * self.sweep
        return Arc(self.centre, self.radius, first, (end - begin) * self.sweep)

    def moved(self, linear: FloatArray, shift: FloatArray) -> Arc:
        """The image under a similarity, p -> linear p + shift; motions keep the radius."""
        factor = sqrt(abs(float(np.linalg.det(linear))))
        if abs(factor - 1.0) <= MOTION:
            factor = 1.0
        angle, mirrored = atan2(linear[1, 0], linear[0, 0]), np.linalg.det(linear) < 0
        sign = -1.0 if mirrored else 1.0
        centre = (linear @ np.asarray(self.centre) + shift).tolist()
        return Arc(
            (centre[0], centre[1]),
            factor * self.radius,
            angle + sign * self.start_angle,
            sign * self.sweep,
        )

    def n_beziers(self, tolerance: float | None = None) -> int:
        """How many Beziers its twin is made of, of a whole circle some for each quarter.

        Parameters
        ----------
        tolerance : float, optional
            Of the fit that the arc is in, data units: the twin lies within a hundredth of it and
            within 1e-4 of the radius, and within 1e-9 of the radius where there is none.

        Examples
        --------
        >>> circle = Arc((0, 0), 1.0, 0.0, 2 * pi)
        >>> circle.n_beziers(0.1), circle.n_beziers()
        (8, 32)
        """
        part = READ_PART
        if tolerance is not None:
            part = max(LEAST_PART, min(RADIUS_PART, TOLERANCE_PART * tolerance / self.radius))
        quarters = abs(self.sweep) / LARGEST_PART
        # A little less than the law of sixth powers says, which holds for small angles only.
        law = 0.99 * quarters * (deviation(LARGEST_PART) / part) ** (1 / 6)
        n = max(1, ceil(quarters - 1e-9), ceil(law))
        while deviation(abs(self.sweep) / n) > part:
            n += 1
        return 4 * ceil(n / 4) if self.is_circle else n

    def twin(self, n_beziers: int) -> tuple[FloatArray, FloatArray]:
        """Knots over [0, 1] and control points of the cubic B-spline that stands for the arc.

        Every Bezier spans the same angle and the handles on both sides of a node are equal, so
        that a double knot holds it.
        """
        n = n_beziers
        nodes = self.at(np.arange(n + 1) / n)
        nodes[-1] = self.end
        angles = self.start_angle + self.sweep * np.arange(n + 1) / n
        arm = np.copysign(self.radius * handle(abs(self.sweep) / n), self.sweep)
        arms = arm * np.column_stack([-np.sin(angles), np.cos(angles)])
        points = np.empty((2 * n + 2, 2))
        points[0], points[-1] = nodes[0], nodes[-1]
        points[1:-1:2], points[2:-1:2] = nodes[:-1] + arms[:-1], nodes[1:] - arms[1:]
        inner = np.repeat(np.arange(1, n) / n, 2)
        return np.concatenate([np.zeros(4), inner, np.ones(4)]), points


def handle(angle: float) -> float:
    """Length of the handles of a Bezier about an angle, in radii.

    -B = BALANCE A is a quadratic equation in h / sin a.
    """
    c = cos(0.5 * angle)
    two, one, none = 36 * c * c - 9 * BALANCE, (48 + 12 * BALANCE) * c, 16 + 12 * BALANCE
    return sin(0.5 * angle) * 2 * none / (one + sqrt(one * one - 4 * two * none))


def deviation(angle: float) -> float:
    """Largest distance of such a Bezier to its arc, in radii; a rounding at least.

    Examples
    --------
    >>> round(deviation(0.5 * pi), 6)
    0.000196
    """
    q = 2 * sin(0.5 * angle) - 3 * handle(angle) * cos(0.5 * angle)
    squares = 16 * q * q / (27 * BALANCE**3)  # of (r / R)^2 - 1, to both sides
    return max(squares / (1.0 + sqrt(1.0 - squares)), 4 * float(np.finfo(float).eps))
