"""Everything about one curve and its data in one record, and the fingerprint of arrays."""

from __future__ import annotations

import hashlib
from typing import Any, NamedTuple

import numpy as np

from checks.crossings import self_crossings
from checks.curves import Array, gaps, polyline_of, splines
from checks.distance import two_sided
from checks.shape import hooks, inflections, interval_ratio, smallest_radius, speed_ratio

# Samples of a curve within one tolerance.
FINE = 10


class Report(NamedTuple):
    """What the outside checker finds."""

    forward: float
    reverse: float
    gap: float
    crossings: int
    data_crossings: int
    hooks: int
    speed_ratio: float
    smallest_radius: float
    inflections: int
    interval_ratio: float


def report(curve: Any, points: Array, *, closed: bool, tolerance: float) -> Report:
    """Check a curve against the data that it was made of."""
    step = tolerance / FINE
    parts = splines(curve)
    polyline = np.concatenate([points, points[:1]]) if closed else points
    between = gaps(parts, closed=closed and len(parts) > 1)
    return Report(
        *two_sided(parts, points, closed=closed, step=step),
        gap=float(between.max(initial=0.0)),
        crossings=self_crossings(polyline_of(parts, step)),
        data_crossings=self_crossings(polyline),
        hooks=len(hooks(parts, points, closed=closed, tolerance=tolerance)),
        speed_ratio=speed_ratio(parts),
        smallest_radius=smallest_radius(parts),
        inflections=inflections(parts),
        interval_ratio=interval_ratio(parts),
    )


def bits(*arrays: Any) -> str:
    """Fingerprint of arrays, their types and shapes: equal where every bit is."""
    found = hashlib.sha256()
    for array in arrays:
        values = np.ascontiguousarray(array)
        found.update(f"{values.dtype.str}{values.shape}".encode())
        found.update(values.tobytes())
    return found.hexdigest()
