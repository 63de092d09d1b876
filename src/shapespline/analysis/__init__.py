"""Analysis: what points tell before any fit."""

from shapespline.analysis.between_points import with_points_between
from shapespline.analysis.corners import LEAST_TURN, LOW_TURN, find_corners
from shapespline.analysis.cpda import Cpda, bending, check_window, chord_to_point, local_maxima
from shapespline.analysis.drawn_vertices import are_drawn_vertices
from shapespline.analysis.last_digit import left_by_rounding, rounded
from shapespline.analysis.mirror import Mirror, find_mirror
from shapespline.analysis.noise import (
    bends_evenly,
    bends_evenly_but_in_corners,
    largest_bulge,
    left_of_cubics,
    noise_level,
    tells_noise,
)
from shapespline.analysis.normalization import (
    FEW_LEFT,
    LONGEST_CHORD,
    MOST_SCATTER,
    NormalizedContour,
    canonical_reading,
)
from shapespline.analysis.outliers import find_outliers
from shapespline.analysis.pixel_chains import GOING_ON, along_pixels, pixel_of
from shapespline.analysis.reconstruction.ordering import Ordering, looks_shuffled, order_points
from shapespline.analysis.resolution import (
    NOISE_BAND,
    Resolution,
    means_of,
    neighbours_to_average,
    resolution,
)
from shapespline.analysis.run_averages import (
    WIDTHS,
    Averages,
    at_end,
    averaged,
    averages,
    best_width,
    joint,
)
from shapespline.analysis.shared_boundaries import shared_arcs
from shapespline.analysis.slow_noise import slow_noise
from shapespline.analysis.straight_runs import (
    FEWEST_STRAIGHT,
    STRAIGHT_PART,
    filled,
    has_straight_runs,
    with_points_on_lines,
)
from shapespline.analysis.uneven_noise import precisions

__all__ = [
    "FEWEST_STRAIGHT",
    "FEW_LEFT",
    "GOING_ON",
    "LEAST_TURN",
    "LONGEST_CHORD",
    "LOW_TURN",
    "MOST_SCATTER",
    "NOISE_BAND",
    "STRAIGHT_PART",
    "WIDTHS",
    "Averages",
    "Cpda",
    "Mirror",
    "NormalizedContour",
    "Ordering",
    "Resolution",
    "along_pixels",
    "are_drawn_vertices",
    "at_end",
    "averaged",
    "averages",
    "bending",
    "bends_evenly",
    "bends_evenly_but_in_corners",
    "best_width",
    "canonical_reading",
    "check_window",
    "chord_to_point",
    "filled",
    "find_corners",
    "find_mirror",
    "find_outliers",
    "has_straight_runs",
    "joint",
    "largest_bulge",
    "left_by_rounding",
    "left_of_cubics",
    "local_maxima",
    "looks_shuffled",
    "means_of",
    "neighbours_to_average",
    "noise_level",
    "order_points",
    "pixel_of",
    "precisions",
    "resolution",
    "rounded",
    "shared_arcs",
    "slow_noise",
    "tells_noise",
    "with_points_between",
    "with_points_on_lines",
]
