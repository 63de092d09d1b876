"""The outside checker: what a curve is, found without a line of the package that made it.

Distances, crossings, hooks, near-cusps, radii, inflections, knots and bits, by dense samples with
NumPy and SciPy alone. Tests and benchmarks use this one. A curve is a SciPy ``BSpline``, a tuple
``(t, c, k)``, a piece with ``knots``, ``control_points`` and ``degree``, or a sequence of those end
to end.
"""

from checks.crossings import crossings, self_crossings
from checks.curves import gaps, polyline_of, samples, sampling_error, splines
from checks.distance import TwoSided, distance_to_curve, distance_to_polyline, two_sided
from checks.report import Report, bits, report
from checks.shape import (
    data_turn,
    hooks,
    inflections,
    interval_ratio,
    smallest_radius,
    speed_ratio,
    turns,
)

__all__ = [
    "Report",
    "TwoSided",
    "bits",
    "crossings",
    "data_turn",
    "distance_to_curve",
    "distance_to_polyline",
    "gaps",
    "hooks",
    "inflections",
    "interval_ratio",
    "polyline_of",
    "report",
    "samples",
    "sampling_error",
    "self_crossings",
    "smallest_radius",
    "speed_ratio",
    "splines",
    "turns",
    "two_sided",
]
