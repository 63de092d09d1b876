"""Curves flattened: points so dense that the chords between them stay near them (Wang 1984)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.errors import InvalidInputError
from shapespline.validation import is_number
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.typing import BoolArray, FloatArray
    from shapespline.values import BSplineCurve

# Chordal distance of the samples where the caller names none, of the box diagonal of the outline,
# and the largest that is taken (GEO-01).
SAMPLING = 1e-4
COARSEST = 1e-2
# Longest step between samples, of the box diagonal. Without one, rounded corners between long lines
# were taken for sharp ones: a rounded rectangle of 8 pieces took 12 points instead of 6 (GEO-01).
LONGEST_STEP = 2e-2
# Straight spans that turn by no more than this from one to the next, neither so many times as long
# as the other, are chords of a curve: its points are their ends alone (GEO-12).
CHORD_TURN, CHORD_RATIO = np.radians(20.0), 3.0
# Bends of less than this part of the box diagonal and turns of less are roundings (GEO-12).
STRAIGHT = 1e-9
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

    Every Bezier piece is cut at equal steps of its parameter. A chord over a step h strays from
    the curve by no more than h^2 / 8 times the largest second derivative, and that is bounded by
    the second differences of the control points.

    References
    ----------
    G. Wang, "The subdivision method for finding the intersection between two Bezier curves or
    surfaces", Zhejiang University Journal, 1984.
    """
    if sampling is not None and not (is_number(sampling) and 0 < sampling < np.inf):
        raise InvalidInputError(f"sampling must be a positive length, got {sampling!r}")
    pieces, breakpoints = spline.beziers()
    beziers, degree = pieces.reshape(-1, 2), spline.degree
    diagonal = float(np.hypot(np.ptp(beziers[:, 0]), np.ptp(beziers[:, 1])))
    step = min(SAMPLING * diagonal if sampling is None else sampling, COARSEST * diagonal)
    # At least so many that no step is long: a fit tells corners from bends by what lies around.
    wanted = np.empty(len(pieces))
    _kernels.steps_wanted(beziers, degree, step, longest * diagonal, wanted)
    wanted[_chords_of_curves(pieces, STRAIGHT * diagonal)] = 1.0
    if not wanted.sum() <= MOST_SAMPLES:
        raise InvalidInputError(
            f"sampling asks for {wanted.sum():.2g} points on one outline, got {sampling!r} for a"
            f" size of {diagonal:.6g}; raise it"
        )
    counts = np.maximum(1, np.ceil(wanted)).astype(np.int64)
    parameters = np.empty(counts.sum() + 1)
    points = np.empty((len(parameters), 2))
    _kernels.chord_points(beziers, degree, breakpoints, counts, points, parameters)
    if spline.periodic:  # knot insertion may miss it by a rounding
        points[-1] = points[0]
    return points, parameters


def _chords_of_curves(pieces: FloatArray, least: float) -> BoolArray:
    """Which spans are straight and go on in another one like the chords of a curve do."""
    along = pieces[:, -1] - pieces[:, 0]
    length = np.hypot(*along.T)
    inner = pieces[:, 1:-1] - pieces[:, :1]
    off = np.abs(inner[..., 0] * along[:, None, 1] - inner[..., 1] * along[:, None, 0])
    straight = (length > least) & (off <= least * length[:, None]).all(axis=1)
    after = np.roll(along, -1, axis=0)
    cross = along[:, 0] * after[:, 1] - along[:, 1] * after[:, 0]
    turn = np.abs(np.arctan2(cross, (along * after).sum(axis=1)))
    longer = np.maximum(length, np.roll(length, -1))
    alike = longer <= CHORD_RATIO * np.minimum(length, np.roll(length, -1))
    goes_on = straight & np.roll(straight, -1) & (turn > STRAIGHT) & (turn <= CHORD_TURN) & alike
    goes_on[-1] &= bool(np.hypot(*(pieces[-1, -1] - pieces[0, 0])) <= least)
    return goes_on | np.roll(goes_on, 1)
