"""shapespline: from a 2D shape to the smallest B-spline that stays within your tolerance.

The public names are loaded on first use, so that ``import shapespline`` costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from shapespline._version import __version__

if TYPE_CHECKING:
    from shapespline.batch import Batch, fit_many
    from shapespline.comparison import Comparison, compare
    from shapespline.contour import Contour, Frame, Shape
    from shapespline.curve import BSplineCurve
    from shapespline.drawing import Drawing, Fit, Piece, Status
    from shapespline.errors import (
        DegenerateContourError,
        DroppedPointsWarning,
        FormatError,
        InvalidInputError,
        MissingExtraError,
        OrderError,
        ShapesplineError,
        ShuffledPointsWarning,
        SkippedContentWarning,
        UnknownFormatError,
    )
    from shapespline.fitting import fit_curve
    from shapespline.formats import read, write
    from shapespline.initial import InitialCurve, initial_curve
    from shapespline.large import fit_large
    from shapespline.large_fit import FootParameters, LargeFit
    from shapespline.optimization import optimize
    from shapespline.ordering import Ordering, order_points
    from shapespline.reading import LITERAL, SENSIBLE, Reading
    from shapespline.reconstruction import fit_shape

# Public name -> module that defines it.
_HOME = {
    "BSplineCurve": "curve",
    "Batch": "batch",
    "Comparison": "comparison",
    "Contour": "contour",
    "DegenerateContourError": "errors",
    "Drawing": "drawing",
    "DroppedPointsWarning": "errors",
    "Fit": "drawing",
    "FootParameters": "large_fit",
    "LargeFit": "large_fit",
    "FormatError": "errors",
    "Frame": "contour",
    "InitialCurve": "initial",
    "InvalidInputError": "errors",
    "LITERAL": "reading",
    "MissingExtraError": "errors",
    "OrderError": "errors",
    "Ordering": "ordering",
    "Piece": "drawing",
    "Reading": "reading",
    "SENSIBLE": "reading",
    "Shape": "contour",
    "ShapesplineError": "errors",
    "ShuffledPointsWarning": "errors",
    "SkippedContentWarning": "errors",
    "Status": "drawing",
    "UnknownFormatError": "errors",
    "compare": "comparison",
    "fit_curve": "fitting",
    "fit_large": "large",
    "fit_many": "batch",
    "fit_shape": "reconstruction",
    "initial_curve": "initial",
    "optimize": "optimization",
    "order_points": "ordering",
    "read": "formats",
    "write": "formats",
}

__all__ = [
    "LITERAL",
    "SENSIBLE",
    "BSplineCurve",
    "Batch",
    "Comparison",
    "Contour",
    "DegenerateContourError",
    "Drawing",
    "DroppedPointsWarning",
    "Fit",
    "FootParameters",
    "FormatError",
    "Frame",
    "InitialCurve",
    "InvalidInputError",
    "LargeFit",
    "MissingExtraError",
    "OrderError",
    "Ordering",
    "Piece",
    "Reading",
    "Shape",
    "ShapesplineError",
    "ShuffledPointsWarning",
    "SkippedContentWarning",
    "Status",
    "UnknownFormatError",
    "__version__",
    "compare",
    "fit_curve",
    "fit_large",
    "fit_many",
    "fit_shape",
    "initial_curve",
    "optimize",
    "order_points",
    "read",
    "write",
]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(f"shapespline.{_HOME[name]}"), name)
    raise AttributeError(f"module 'shapespline' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
