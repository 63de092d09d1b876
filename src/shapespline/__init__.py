"""shapespline: from a 2D shape to the smallest B-spline that stays within your tolerance.

The public names are loaded on first use, so that ``import shapespline`` costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from shapespline._version import __version__

if TYPE_CHECKING:
    from shapespline.analysis import Ordering, order_points
    from shapespline.errors import (
        ArcsAsCurvesWarning,
        DegenerateContourError,
        DroppedPointsWarning,
        FormatError,
        InvalidInputError,
        MissingExtraError,
        MissingReferenceWarning,
        OpenOutlinesWarning,
        OrderError,
        PictureWarning,
        ShapesplineError,
        ShuffledPointsWarning,
        SkippedContentWarning,
        SparsePointsWarning,
        UnknownFormatError,
    )
    from shapespline.fitting import Batch, fit_curve, fit_large, fit_many, fit_shape, optimize
    from shapespline.formats import compare, read, write
    from shapespline.geometry import Comparison
    from shapespline.paper import LITERAL, SENSIBLE, InitialCurve, Reading, initial_curve
    from shapespline.streaming import FootParameters, LargeFit
    from shapespline.studio import open_studio
    from shapespline.tracing import trace
    from shapespline.values import (
        Arc,
        BSplineCurve,
        Contour,
        Drawing,
        Fit,
        Piece,
        Shape,
        Status,
        Stroke,
        ViewBox,
    )

# Public name -> the room that offers it.
_HOME = {
    "Arc": "values",
    "ArcsAsCurvesWarning": "errors",
    "BSplineCurve": "values",
    "Batch": "fitting",
    "Comparison": "geometry",
    "Contour": "values",
    "DegenerateContourError": "errors",
    "Drawing": "values",
    "DroppedPointsWarning": "errors",
    "Fit": "values",
    "FootParameters": "streaming",
    "FormatError": "errors",
    "InitialCurve": "paper",
    "InvalidInputError": "errors",
    "LITERAL": "paper",
    "LargeFit": "streaming",
    "MissingExtraError": "errors",
    "MissingReferenceWarning": "errors",
    "OrderError": "errors",
    "Ordering": "analysis",
    "OpenOutlinesWarning": "errors",
    "PictureWarning": "errors",
    "Piece": "values",
    "Reading": "paper",
    "SENSIBLE": "paper",
    "Shape": "values",
    "ShapesplineError": "errors",
    "ShuffledPointsWarning": "errors",
    "SparsePointsWarning": "errors",
    "SkippedContentWarning": "errors",
    "Status": "values",
    "Stroke": "values",
    "UnknownFormatError": "errors",
    "ViewBox": "values",
    "compare": "formats",
    "fit_curve": "fitting",
    "fit_large": "fitting",
    "fit_many": "fitting",
    "fit_shape": "fitting",
    "initial_curve": "paper",
    "open_studio": "studio",
    "optimize": "fitting",
    "order_points": "analysis",
    "read": "formats",
    "trace": "tracing",
    "write": "formats",
}

__all__ = [
    "LITERAL",
    "SENSIBLE",
    "Arc",
    "ArcsAsCurvesWarning",
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
    "InitialCurve",
    "InvalidInputError",
    "LargeFit",
    "MissingExtraError",
    "MissingReferenceWarning",
    "OpenOutlinesWarning",
    "OrderError",
    "Ordering",
    "PictureWarning",
    "Piece",
    "Reading",
    "Shape",
    "ShapesplineError",
    "ShuffledPointsWarning",
    "SkippedContentWarning",
    "SparsePointsWarning",
    "Status",
    "Stroke",
    "UnknownFormatError",
    "ViewBox",
    "__version__",
    "compare",
    "fit_curve",
    "fit_large",
    "fit_many",
    "fit_shape",
    "initial_curve",
    "open_studio",
    "optimize",
    "order_points",
    "read",
    "trace",
    "write",
]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(f"shapespline.{_HOME[name]}"), name)
    raise AttributeError(f"module 'shapespline' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
