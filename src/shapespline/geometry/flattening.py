"""Curves flattened: points so dense that the chords between them stay near them (Wang 1984)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.errors import InvalidInputError
from shapespline.validation import is_number
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve

# Chordal distance of the samples where the caller names none, and the largest that is taken; parts
# of the box diagonal of the outline.
SAMPLING, COARSEST = _kernels.Flattening.SAMPLING, _kernels.Flattening.COARSEST
# Longest step between samples, of the box diagonal. Without one, rounded corners between long lines
# were taken for sharp ones: a rounded rectangle of 8 pieces took 12 points instead of 6 (GEO-01).
LONGEST_STEP = 2e-2
# Samples of one outline; a caller who wants more has mistaken the unit.
MOST_SAMPLES = 5_000_000


def sampled(
    spline: BSplineCurve, sampling: float | None = None, *, longest: float = LONGEST_STEP
) -> tuple[Contour, FloatArray]:
    """Points on a curve so dense that the chords stay within ``sampling``, and their parameters.

    1e-4 of the box diagonal when none is given, and never more than 1e-2 of it. No step is longer
    than ``longest`` of the diagonal, but for chords that a curve was drawn with: infinite where the
    points are not to be fitted again.
    """
    points, parameters = chords(spline, sampling, longest=longest)
    closed = bool((points[0] == points[-1]).all())
    contour = Contour.silently(points, closed, accuracy=0.0)
    first = np.unique(contour.source, return_index=True)[1]
    return contour, parameters[first]


def chords(
    spline: BSplineCurve, sampling: float | None = None, *, longest: float = LONGEST_STEP
) -> tuple[FloatArray, FloatArray]:
    """The same points before they are a contour, the last one where the curve ends.

    Every Bezier piece is cut at equal steps of its parameter (`curve/flatten.hpp`).

    References
    ----------
    G. Wang, "The subdivision method for finding the intersection between two Bezier curves or
    surfaces", Zhejiang University Journal, 1984.
    """
    if sampling is not None and not (is_number(sampling) and 0 < sampling < np.inf):
        raise InvalidInputError(f"sampling must be a positive length, got {sampling!r}")
    # At least so many that no step is long: a fit tells corners from bends by what lies around.
    found = _kernels.Flattening(spline.knots, spline.degree, spline.coefficients, sampling, longest)
    if not found.wanted <= MOST_SAMPLES:
        raise InvalidInputError(
            f"sampling asks for {found.wanted:.2g} points on one outline, got {sampling!r} for a"
            f" size of {found.diagonal:.6g}; raise it"
        )
    parameters = np.empty(found.n_points)
    points = np.empty((len(parameters), 2))
    found.write(points, parameters)
    if spline.periodic:  # knot insertion may miss it by a rounding
        points[-1] = points[0]
    return points, parameters
