"""Shapes and drawings in other units: every length in them multiplied."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.geometry.exact import Outlines
from shapespline.units import PIXEL, checked_unit, conversion
from shapespline.validation import is_number
from shapespline.values import BSplineCurve, Contour, Drawing, Fit, Shape, ViewBox

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.values import Piece

Value = Shape | Drawing | Outlines


def in_unit(
    value: Value,
    unit: str | None = None,
    scale: float | None = None,
    dpi: float | None = None,
) -> Value:
    """The same in another unit and scale.

    Parameters
    ----------
    value : Shape, Drawing or Outlines
        The result is of the same type.
    unit : str, optional
        The unit wanted. A value in a known unit is converted; one without a unit is in this one
        from now on.
    scale : float, optional
        Further factor. For pixels it says their size: so many units are one pixel.
    dpi : float, optional
        Pixels per inch, for a value in pixels, or without a unit; "mm" is then the unit wanted if
        none is named.

    Raises
    ------
    InvalidInputError
        If an option is out of range, or the size of a pixel is needed and not known.

    Examples
    --------
    >>> inches = Shape([Contour([(0, 0), (2, 0)])], unit="in")
    >>> [contour.length for contour in in_unit(inches, "mm")]
    [50.8]
    >>> in_unit(Shape([Contour([(0, 0), (2, 0)])]), "mm", scale=0.1).unit
    'mm'
    """
    checked_unit(unit)
    for name, number in (("scale", scale), ("dpi", dpi)):
        if number is not None and not (is_number(number) and 0 < number < float("inf")):
            raise InvalidInputError(f"{name} must be a positive number, got {number!r}")
    factor = 1.0 if scale is None else float(scale)
    given = value.unit
    if dpi is not None:
        given, unit = given or PIXEL, unit or "mm"
        if PIXEL not in (given, unit):
            raise InvalidInputError(
                f"dpi is the size of pixels, and these are {given}; leave it out, or take scale"
            )
    if unit is not None and given is not None:
        sized = scale is not None and dpi is None and PIXEL in (given, unit)
        factor *= 1.0 if sized else conversion(given, unit, dpi)
    return scaled(value, factor, unit or given)


def scaled(value: Value, factor: float, unit: str | None) -> Value:
    """Every length multiplied, and the unit that they are in then.

    The history of a fit is in the unit of its own problem and stays behind unless the factor is 1.
    """
    frame = None if value.frame is None else ViewBox(*(factor * side for side in value.frame))
    # Other numbers are no places of it any more.
    reference = None if factor != 1.0 or isinstance(value, Outlines) else value.reference
    if isinstance(value, Shape):
        left_out = [_contour(item, factor) for item in value.left_out]
        contours = [_contour(item, factor) for item in value]
        return Shape(
            contours,
            value.parents,
            frame,
            unit,
            left_out=left_out,
            colors=value.colors,
            widths=scaled_widths(value.widths, factor),
            strokes=value.strokes,
            reference=reference,
        )
    if isinstance(value, Outlines):
        curves = [_pieces(item, factor) for item in value.curves]
        return replace(
            value,
            curves=curves,
            frame=frame,
            unit=unit,
            widths=scaled_widths(value.widths, factor),
        )
    fits = [_fit(item, factor) for item in value]
    return Drawing(
        fits,
        value.parents,
        frame,
        unit,
        colors=value.colors,
        widths=scaled_widths(value.widths, factor),
        strokes=value.strokes,
        reference=reference,
        regularities=[one._replace(off=factor * one.off) for one in value.regularities],
    )


def scaled_widths(
    widths: Sequence[float | None] | None, factor: float
) -> list[float | None] | None:
    """Of strokes, multiplied."""
    if widths is None:
        return None
    return [None if width is None else factor * width for width in widths]


def _contour(contour: Contour, factor: float) -> Contour:
    if factor == 1.0:
        return contour
    given = factor * contour.points[contour.source]
    accuracy = None if contour.accuracy is None else factor * contour.accuracy
    line = None if contour.level_line is None else factor * contour.level_line
    return Contour.silently(given, contour.closed, accuracy=accuracy, level_line=line)


def _pieces(pieces: Sequence[Piece], factor: float) -> tuple[Piece, ...]:
    return tuple(piece.moved(factor * np.eye(2), np.zeros(2)) for piece in pieces)


def _fit(fit: Fit, factor: float) -> Fit:
    if factor == 1.0:
        return fit
    spline = fit.spline
    return replace(
        fit,
        spline=BSplineCurve(
            spline.knots, factor * spline.control_points, spline.degree, spline.periodic
        ),
        contour=_contour(fit.contour, factor),
        max_distance=factor * fit.max_distance,
        rms_distance=factor * fit.rms_distance,
        hausdorff_distance=factor * fit.hausdorff_distance,
        tolerance=factor * fit.tolerance,
        history=(),
        sections=_pieces(fit.sections, factor),
    )
