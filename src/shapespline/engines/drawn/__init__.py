"""The drawn engine: lines, arcs and free-form runs, with what a drawing repeats."""

from shapespline.engines.drawn.engine import (
    Drawn,
    DrawnArc,
    DrawnLine,
    FreeRun,
    as_drawn,
)
from shapespline.engines.drawn.regularities import NAMES, Regularity

__all__ = ["NAMES", "Drawn", "DrawnArc", "DrawnLine", "FreeRun", "Regularity", "as_drawn"]
