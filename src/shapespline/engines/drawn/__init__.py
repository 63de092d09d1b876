"""The drawn engine: lines, arcs and free-form runs, with what a drawing repeats."""

from shapespline.engines.drawn.across import Feature, repeated_outlines
from shapespline.engines.drawn.copies import Outline, Placement, placement_of, turn_matrix
from shapespline.engines.drawn.engine import as_drawn, drawn_between_corners
from shapespline.engines.drawn.judgement import FEW_ELEMENTS, LITTLE_FREE, POINTS_EACH
from shapespline.engines.drawn.observed import ONE_BIT, Observed
from shapespline.engines.drawn.parts import Drawn, DrawnArc, DrawnLine, FreeRun
from shapespline.engines.drawn.regularities import NAMES
from shapespline.engines.drawn.segments import PRICE
from shapespline.engines.drawn.simplify import simplified

__all__ = [
    "FEW_ELEMENTS",
    "LITTLE_FREE",
    "NAMES",
    "ONE_BIT",
    "POINTS_EACH",
    "PRICE",
    "Drawn",
    "DrawnArc",
    "DrawnLine",
    "Feature",
    "FreeRun",
    "Observed",
    "Outline",
    "Placement",
    "as_drawn",
    "drawn_between_corners",
    "placement_of",
    "repeated_outlines",
    "simplified",
    "turn_matrix",
]
