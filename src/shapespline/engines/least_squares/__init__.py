"""The least-squares engine: control points and location parameters together."""

from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.engines.least_squares.smoothing import (
    FINAL_LIMITS,
    PENALTY,
    Smoothed,
    smooth_start,
    smoothed,
    straight_line,
)
from shapespline.engines.least_squares.solve import (
    DEFAULT_LIMITS,
    METHODS,
    Minimized,
    Start,
    given_weights,
    minimized,
    named_solver,
    summed_weights,
)
from shapespline.engines.least_squares.starts.baselines import dominant_start, uniform_start
from shapespline.engines.least_squares.starts.equidistribution import (
    STRAY_WEIGHT,
    Balanced,
    balanced_start,
)
from shapespline.engines.least_squares.streamed import MOST_PASSES, least_squares

__all__ = [
    "DEFAULT_LIMITS",
    "FINAL_LIMITS",
    "METHODS",
    "MOST_PASSES",
    "PENALTY",
    "STRAY_WEIGHT",
    "Balanced",
    "CurveProblem",
    "Minimized",
    "Smoothed",
    "Start",
    "balanced_start",
    "dominant_start",
    "given_weights",
    "least_squares",
    "minimized",
    "named_solver",
    "smooth_start",
    "smoothed",
    "straight_line",
    "summed_weights",
    "uniform_start",
]
