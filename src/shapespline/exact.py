"""Curves that were read rather than fitted: as they are, with a contour sampled on them.

A file of curves holds them exactly. They become a :class:`Drawing` like any other, so that they can
be written in every format as they are, compared, drawn, and fitted again through the contours.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.arrays import is_number
from shapespline.contour import Contour
from shapespline.distance import distances_at
from shapespline.drawing import Drawing, Fit, Piece, Status
from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.joining import joined
from shapespline.nesting import parents_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.contour import Frame
    from shapespline.curve import BSplineCurve
    from shapespline.typing import FloatArray

# Chordal distance of the samples where the caller names none, of the box diagonal of the outline,
# and the largest that is taken.
SAMPLING = 1e-4
COARSEST = 1e-2
# Longest step between samples, of the box diagonal. Without one, rounded corners between long lines
# were taken for sharp ones: a rounded rectangle of 8 pieces took 12 points instead of 6.
LONGEST_STEP = 2e-2
# Samples of one outline; a caller who wants more has mistaken the unit.
MOST_SAMPLES = 5_000_000


@dataclass(frozen=True)
class Outlines:
    """What a file of curves holds: the value that readers of such formats return.

    Attributes
    ----------
    curves : sequence of sequences of Piece
        Each outline as pieces end to end, knots over [0, 1]; one whose last point is its first,
        to the bit, is closed.
    frame : Frame, optional
        The view box.
    unit : str, optional
        Of the coordinates, one of :data:`shapespline.units.UNITS`, if known.
    """

    curves: Sequence[Sequence[Piece]]
    frame: Frame | None = None
    unit: str | None = None


def exact_drawing(outlines: Outlines, *, sampling: float | None = None) -> Drawing:
    """The outlines as a drawing, nested by containment; open ones lie in nothing.

    Parameters
    ----------
    outlines : Outlines
    sampling : float, optional
        See `exact_fit`.

    Raises
    ------
    InvalidInputError
        If there is no outline, or a number in it is not usable.
    """
    fits = [exact_fit(pieces, sampling=sampling) for pieces in outlines.curves]
    parents = parents_of([fit.contour for fit in fits])
    return Drawing(fits, parents, outlines.frame, outlines.unit)


def exact_fit(pieces: Sequence[Piece], *, sampling: float | None = None) -> Fit:
    """A curve as it was read, with a contour sampled on it and distances that are true.

    Parameters
    ----------
    pieces : sequence of Piece
        End to end, each clamped over [0, 1]; closed if the last point is the first. Those without
        extent are left out.
    sampling : float, optional
        Largest distance between the curve and the contour's polyline, data units: what a fit to
        the contour adds to its own tolerance. 1e-4 of the box diagonal when not given, never more
        than 1e-2 of it.

    Returns
    -------
    Fit
        ``method`` is "read", the contour's points lie on the curve, and ``hausdorff_distance`` is
        the bound of the distance between curve and polyline.

    Raises
    ------
    DegenerateContourError
        If nothing has an extent.
    InvalidInputError
        If a coordinate is not usable, or the sampling is not positive or absurdly fine.

    Examples
    --------
    >>> bend = Piece("bezier", 2, np.repeat([0.0, 1.0], 3), np.array([[0.0, 0], [1, 2], [2, 0]]))
    >>> fit = exact_fit([bend], sampling=0.01)
    >>> fit.n_stored_points, len(fit.contour), fit.hausdorff_distance <= 0.01
    (3, 81, True)
    """
    pieces = tuple(piece for piece in pieces if np.ptp(piece.control_points, axis=0).any())
    if not pieces:
        raise DegenerateContourError("the outline is a single point: there is no curve")
    spline = joined(pieces)
    contour, parameters = sampled(spline, sampling)
    distances = distances_at(spline, contour, parameters)
    bound = distances.hausdorff_distance
    return Fit(
        spline=spline,
        contour=contour,
        parameters=parameters[contour.source],
        max_distance=distances.max_distance,
        rms_distance=distances.rms_distance,
        hausdorff_distance=bound,
        tolerance=bound,
        status=Status.KEPT.saying(f"the curve as it was read, sampled to {bound:.3g}"),
        history=(),
        method="read",
        sections=pieces if len(pieces) > 1 else (),
    )


def sampled(spline: BSplineCurve, sampling: float | None = None) -> tuple[Contour, FloatArray]:
    """Points on a curve so dense that the chords stay within ``sampling``, and their parameters.

    1e-4 of the box diagonal when none is given, and never more than 1e-2 of it.
    """
    points, parameters = chords(spline, sampling)
    contour = Contour.silently(points, closed=bool((points[0] == points[-1]).all()))
    first = np.unique(contour.source, return_index=True)[1]
    return contour, parameters[first]


def chords(spline: BSplineCurve, sampling: float | None = None) -> tuple[FloatArray, FloatArray]:
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
    _kernels.steps_wanted(beziers, degree, step, LONGEST_STEP * diagonal, wanted)
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
