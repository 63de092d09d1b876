"""Arcs of circles and ellipses as files hold them, made into pieces."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from shapespline.values import Arc, Piece

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike

# Of a circle one cubic replaces at most this angle: it is then nowhere farther from the arc than
# 4/27 sin^6(a/4) / cos^2(a/4) of the radius [1]_, a billionth of it. Ellipses are affine images of
# circles: a billionth of the longer half axis (FMT-02).
LARGEST_ANGLE = math.radians(10.0)
# Half axes that are equal and perpendicular to this part of themselves are those of a circle.
ROUND = 1e-9
CUBIC_KNOTS = np.repeat([0.0, 1.0], 4)


def elliptical_arc(
    centre: ArrayLike, first: ArrayLike, second: ArrayLike, begin: float, sweep: float
) -> list[Piece]:
    """Pieces along c + cos(t) u + sin(t) v, t from ``begin`` to ``begin + sweep``.

    Of a circle one arc, else cubic Beziers.

    Parameters
    ----------
    centre, first, second : array_like, shape (2,)
        The centre c and two conjugate half axes u and v.
    begin, sweep : float
        Radians; a negative sweep runs backwards.

    Notes
    -----
    End points and tangents are those of the arc; in between a cubic is within 1.1e-9 of the longer
    half axis. An arc of a circle is exact.

    References
    ----------
    .. [1] M. Goldapp, "Approximation of circular arcs by cubic polynomials", Computer Aided
       Geometric Design 8, 1991, 227-238.

    Examples
    --------
    >>> quarter = elliptical_arc((0, 0), (2, 0), (0, 1), 0.0, math.pi / 2)
    >>> len(quarter), quarter[0].control_points[0].tolist()
    (9, [2.0, 0.0])
    >>> [piece.arc.radius for piece in elliptical_arc((0, 0), (2, 0), (0, -2), 0.0, math.pi)]
    [2.0]
    """
    (ux, uy), (vx, vy) = np.array([first, second], dtype=np.float64).tolist()
    x, y = np.array(centre, dtype=np.float64).tolist()
    radius, sign = math.hypot(ux, uy), math.copysign(1.0, ux * vy - uy * vx)
    off = math.hypot(vx + sign * uy, vy - sign * ux)
    if 0 < radius < math.inf and off <= ROUND * radius and sweep and math.isfinite(x + y):
        arc = Arc((x, y), radius, math.atan2(uy, ux) + sign * begin, sign * sweep)
        return [Piece.of_arc(arc)]
    # A rounding above a whole number of pieces does not ask for one more.
    count = max(1, math.ceil(abs(sweep) / LARGEST_ANGLE - 1e-9))
    t = begin + sweep / count * np.arange(count + 1)
    if abs(abs(sweep) - 2 * math.pi) < 1e-15:
        t[-1] = t[0]
    axes = np.array([first, second], dtype=np.float64)
    points = np.asarray(centre) + np.column_stack([np.cos(t), np.sin(t)]) @ axes
    reach = 4 / 3 * math.tan(sweep / count / 4)
    tangents = reach * np.column_stack([-np.sin(t), np.cos(t)]) @ axes
    return [
        Piece(
            "bezier",
            3,
            CUBIC_KNOTS,
            np.array([points[i], points[i] + tangents[i], points[i + 1] - tangents[i + 1],
                      points[i + 1]]),
        )
        for i in range(count)
    ]  # fmt: skip
