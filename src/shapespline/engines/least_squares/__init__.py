"""The least-squares engine: control points and location parameters together."""

from shapespline.engines.least_squares.averaging import averaged
from shapespline.engines.least_squares.measurement import (
    Measurement,
    check_freedom,
    checked_measurement,
    measured,
)
from shapespline.engines.least_squares.methods import METHODS, named_solver
from shapespline.engines.least_squares.problem import ENDS, CurveProblem
from shapespline.engines.least_squares.settings import (
    DEFAULT_LIMITS,
    RunSettings,
    path_of,
    run_data,
    settings_of,
)
from shapespline.engines.least_squares.smoothing import (
    FINAL_LIMITS,
    PENALTY,
    Smoothed,
    cheapest,
    noise_of,
    sizes_tried,
    smooth_start,
    smoothed_to,
    start_of,
    straight_line,
)
from shapespline.engines.least_squares.solve import (
    Minimized,
    RunArguments,
    Start,
    given_weights,
    minimized,
    summed_weights,
)
from shapespline.engines.least_squares.starts.equidistribution import (
    STRAY_WEIGHT,
    Balanced,
    balanced_start,
)
from shapespline.engines.least_squares.starts.named import STARTS
from shapespline.engines.least_squares.starts.placed import (
    bend_gain,
    placed_curve,
    quasi_interpolating,
    with_neighbours,
)
from shapespline.engines.least_squares.starts.stations import (
    STATIONS,
    chosen_stations,
    even_samples,
    inner_maxima,
    own_number,
)
from shapespline.engines.least_squares.streamed import MOST_PASSES, least_squares
from shapespline.engines.least_squares.trusted import FAR, standardized, start_of_some

__all__ = [
    "DEFAULT_LIMITS",
    "ENDS",
    "FAR",
    "FINAL_LIMITS",
    "METHODS",
    "MOST_PASSES",
    "PENALTY",
    "STARTS",
    "STATIONS",
    "STRAY_WEIGHT",
    "Balanced",
    "CurveProblem",
    "Measurement",
    "Minimized",
    "RunArguments",
    "RunSettings",
    "Smoothed",
    "Start",
    "averaged",
    "balanced_start",
    "bend_gain",
    "cheapest",
    "check_freedom",
    "checked_measurement",
    "chosen_stations",
    "even_samples",
    "given_weights",
    "inner_maxima",
    "least_squares",
    "measured",
    "minimized",
    "named_solver",
    "noise_of",
    "own_number",
    "path_of",
    "placed_curve",
    "quasi_interpolating",
    "run_data",
    "settings_of",
    "sizes_tried",
    "smooth_start",
    "smoothed_to",
    "standardized",
    "start_of",
    "start_of_some",
    "straight_line",
    "summed_weights",
    "with_neighbours",
]
