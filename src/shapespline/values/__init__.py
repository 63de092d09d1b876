"""Values: immutable inputs and results. They know nothing but themselves."""

from shapespline.values.arc import FULL_TURN, Arc
from shapespline.values.contour import Contour, checked_contour
from shapespline.values.curve import BSplineCurve, clamped_ends, with_knot
from shapespline.values.drawing import Drawing
from shapespline.values.fit import Fit, Status
from shapespline.values.knots import (
    check_count,
    check_degree,
    clamped_knots,
    greville_abscissae,
    on_grid,
    periodic_knots,
)
from shapespline.values.piece import (
    CORNER_TURN,
    EXACT_TURN,
    SAME_FACTOR,
    SMOOTH_TURN,
    Piece,
    with_points,
)
from shapespline.values.regularity import Regularity
from shapespline.values.shape import Shape, checked_parents, nesting_depth
from shapespline.values.snapshot import Snapshot
from shapespline.values.stroke import BLACK, CAPS, JOINS, Stroke
from shapespline.values.uncertainty import Band, Uncertainty
from shapespline.values.view_box import ViewBox

__all__ = [
    "BLACK",
    "CAPS",
    "CORNER_TURN",
    "EXACT_TURN",
    "FULL_TURN",
    "JOINS",
    "SAME_FACTOR",
    "SMOOTH_TURN",
    "Arc",
    "BSplineCurve",
    "Band",
    "Contour",
    "Drawing",
    "Fit",
    "Piece",
    "Regularity",
    "Shape",
    "Snapshot",
    "Status",
    "Stroke",
    "Uncertainty",
    "ViewBox",
    "check_count",
    "check_degree",
    "checked_contour",
    "checked_parents",
    "clamped_ends",
    "clamped_knots",
    "greville_abscissae",
    "nesting_depth",
    "on_grid",
    "periodic_knots",
    "with_knot",
    "with_points",
]
