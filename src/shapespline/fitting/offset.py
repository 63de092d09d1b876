"""offset: the curves at a distance from a drawing, fitted again within a tolerance."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.fitting.curve import fit_curve
from shapespline.geometry import (
    Source,
    chords,
    crossing_pairs,
    enclosed_area,
    offset_lines,
    parents_of,
    self_crossings,
)
from shapespline.validation import is_number
from shapespline.values import Contour, Drawing, Fit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.geometry import OffsetLine

# Of the tolerance: step of the raw offset and what its chords deviate. A detail shorter than a step
# may be missed by half of it; two deviations come from chords and from points that are made one.
STEP, DEVIATION = 0.3, 0.04
# What is left for the fit.
FITTED = 1.0 - 0.5 * STEP - 2.0 * DEVIATION
# Of the box diagonal: the least tolerance that is taken where none is named.
LEAST = 1e-4


def offset_drawing(drawing: Drawing, distance: float, *, tolerance: float | None = None) -> Drawing:
    """The curves at a distance from those of a drawing; see `Drawing.offset`.

    Examples
    --------
    >>> import shapespline as ss
    >>> square = ss.Contour([(0, 0), (2, 0), (2, 2), (0, 2)], closed=True).resampled(80)
    >>> inner = offset_drawing(ss.Drawing([ss.fit_curve(square, tolerance=0.01)]), -0.5)
    >>> len(inner), round(inner.area, 1)
    (1, 1.0)
    """
    if not (is_number(distance) and distance != 0 and np.isfinite(distance)):
        raise InvalidInputError(
            f"distance must be a length in data units other than 0, got {distance!r}"
        )
    low, high = np.array(drawing.bounds).reshape(2, 2)
    if tolerance is None:
        largest = max(fit.tolerance for fit in drawing)
        tolerance = max(largest, LEAST * float(np.hypot(*(high - low))))
    elif not (is_number(tolerance) and 0 < tolerance < np.inf):
        raise InvalidInputError(f"tolerance must be a positive length, got {tolerance!r}")
    _check_crossings(drawing)
    lines: list[OffsetLine] = []
    for source in _sources(drawing, float(distance)):
        lines += offset_lines(source, STEP * tolerance, DEVIATION * tolerance)
    if not lines:
        raise DegenerateContourError(
            f"nothing is left at a distance of {distance:g}: the drawing is nowhere wider than"
            f" {2 * abs(distance):g}"
        )
    fits = [_fitted(line, float(tolerance)) for line in lines]
    parents = parents_of([fit.contour for fit in fits])
    return Drawing(fits, parents, drawing.frame, drawing.unit, reference=drawing.reference)


def _sources(drawing: Drawing, distance: float) -> list[Source]:
    """The closed curves as one area, every open curve alone."""
    closed = [index for index, fit in enumerate(drawing.fits) if fit.closed]
    found = []
    if closed:
        curves = [drawing.fits[index].spline for index in closed]
        # The area lies to the left of an outline that runs counter-clockwise, and of a hole that
        # runs clockwise; growing is to the other side.
        lefts = [
            (-distance if drawing.is_hole(index) == (enclosed_area(curve) < 0) else distance)
            for index, curve in zip(closed, curves, strict=True)
        ]
        found.append(Source(curves, lefts, True, distance < 0))
    found += [Source([fit.spline], [distance], False, False) for fit in drawing if not fit.closed]
    return found


def _check_crossings(drawing: Drawing) -> None:
    """Raise if closed curves cross themselves or each other: they bound no area."""
    lines = [chords(fit.spline)[0] for fit in drawing if fit.closed]
    if any(self_crossings(line) for line in lines) or crossing_pairs(lines):
        raise InvalidInputError(
            "an offset needs closed curves that do not cross themselves or each other, and some do;"
            " offset them one by one, or repair them first"
        )


def _fitted(line: OffsetLine, tolerance: float) -> Fit:
    """The fit of an offset line, its distances those to the offset itself."""
    contour = Contour.silently(line.points, line.closed)
    corners: Sequence[int] | None = line.corners or None
    fit = fit_curve(contour, tolerance=FITTED * tolerance, corners=corners)
    known = (1.0 - FITTED) * tolerance
    bound = fit.hausdorff_distance + known
    kept = bound <= tolerance
    return replace(
        fit,
        max_distance=fit.max_distance + known,
        hausdorff_distance=bound,
        tolerance=tolerance,
        status=fit.status.saying(
            f"an offset curve: tolerance {tolerance:.6g} {'kept' if kept else 'not kept'}, both"
            f" ways {bound:.6g}"
        ),
    )
