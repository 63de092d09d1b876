"""compare: of files, points and geometries, too; what is no curve yet is read first."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, cast

from shapespline.formats.registry import read
from shapespline.geometry import compare as compare_curves
from shapespline.values import BSplineCurve, Contour, Drawing, Fit, Shape

if TYPE_CHECKING:
    from shapespline.formats.sources import Source
    from shapespline.geometry import Comparison, Curves
    from shapespline.typing import ArrayLike


def compare(first: Curves | Source | ArrayLike, second: Curves | Source | ArrayLike) -> Comparison:
    """How far two drawings, or outlines, lie apart: each from the other, whatever their pieces.

    Parameters
    ----------
    first, second : Drawing, Fit, Shape, Contour or BSplineCurve, file, or array_like (n, 2)
        Of shapes, contours and points in order the polylines are compared. Names of files, bytes,
        open files, geometries and glyphs are read first; see `read`.

    Returns
    -------
    Comparison
        Distances of about 20 000 samples of each to the exact curves of the other.

    Raises
    ------
    ShapesplineError
        If one of them cannot be read, or is no outline.

    Examples
    --------
    >>> found = compare([(0, 0), (4, 0)], Contour([(0, 1), (4, 1), (4, 3)], closed=False))
    >>> found.forward_max, found.reverse_max
    (1.0, 3.0)
    """
    return compare_curves(_curves_of(first), _curves_of(second))


def _curves_of(value: object) -> Curves:
    """What can be compared: as it is, read from where it lies, or points in order."""
    if isinstance(value, Drawing | Fit | Shape | Contour | BSplineCurve):
        return value
    told = ("__geo_interface__", "draw", "read")
    if isinstance(value, str | bytes | os.PathLike) or any(hasattr(value, name) for name in told):
        return read(cast("Source", value))
    return Contour(cast("ArrayLike", value))
