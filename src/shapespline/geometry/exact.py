"""Curves that were read rather than fitted: as they are, with a contour sampled on them.

A file of curves holds them exactly. They become a :class:`Drawing` like any other, so that they can
be written in every format as they are, compared, drawn, and fitted again through the contours.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import DegenerateContourError
from shapespline.geometry.distances import distances_at
from shapespline.geometry.joining import joined
from shapespline.geometry.nesting import parents_of
from shapespline.values import Drawing, Fit, Piece, Status

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.values import Stroke, ViewBox
from shapespline.geometry.flattening import sampled


@dataclass(frozen=True)
class Outlines:
    """What a file of curves holds: the value that readers of such formats return.

    Attributes
    ----------
    curves : sequence of sequences of Piece
        Each outline as pieces end to end, knots over [0, 1]; one whose last point is its first,
        to the bit, is closed.
    frame : ViewBox, optional
        The view box.
    unit : str, optional
        Of the coordinates, one of :data:`shapespline.units.UNITS`, if known.
    parents : sequence of int, optional
        For each outline the one directly around it, -1 for none, where the file tells more of it
        than where they lie.
    colors, widths, strokes : sequence, optional
        For each outline, as of a :class:`Drawing`.
    """

    curves: Sequence[Sequence[Piece]]
    frame: ViewBox | None = None
    unit: str | None = None
    parents: Sequence[int] | None = None
    colors: Sequence[str | None] | None = None
    widths: Sequence[float | None] | None = None
    strokes: Sequence[Stroke | None] | None = None


def exact_drawing(outlines: Outlines, *, sampling: float | None = None) -> Drawing:
    """The outlines as a drawing, nested by containment unless they say how; open ones in nothing.

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
    parents = outlines.parents
    if parents is None:
        parents = parents_of([fit.contour for fit in fits])
    return Drawing(
        fits,
        parents,
        outlines.frame,
        outlines.unit,
        colors=outlines.colors,
        widths=outlines.widths,
        strokes=outlines.strokes,
    )


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
    distances = distances_at(spline, contour, parameters).beside(pieces)
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
        sections=pieces if len(pieces) > 1 or pieces[0].arc is not None else (),
    )
