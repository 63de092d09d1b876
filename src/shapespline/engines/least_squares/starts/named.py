"""Starts of a given size by their names.

=============  =======================================================================  ==========
name           where its control points come from                                       known from
=============  =======================================================================  ==========
balanced       short fits, each with its knots where the last one erred                 here
cpda-filled    maxima of H, the gaps filled by the curvature that H measures            here
cpda-halved    maxima of H, the widest gaps halved by index                             here
cpda-maxima    maxima of H, the highest                                                 the paper
curvature      equal integrals of the curvature's root                                  folklore
arc-length     equal arc length                                                         folklore
every-nth      every so many points                                                     folklore
park-lee       dominant points, seeds from a base curve                                 [41]
dominant       dominant points, seeds from H                                            [41] and H
uniform        one linear solve on uniform knots at uniform parameters                  [46]
=============  =======================================================================  ==========

The first and the last three solve for their control points; the others place them.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from shapespline.analysis import chord_to_point
from shapespline.engines.least_squares.starts.baselines import (
    CHORD,
    CHORD_PART,
    dominant_start,
    park_lee_start,
    uniform_start,
)
from shapespline.engines.least_squares.starts.equidistribution import Balanced, balanced_start
from shapespline.engines.least_squares.starts.placed import placed_curve, quasi_interpolating
from shapespline.engines.least_squares.starts.stations import (
    STATIONS,
    chosen_stations,
    even_samples,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# Part of the largest H that a maximum must rise.
PROMINENCE = 0.02


def station_start(
    kind: str,
    contour: Contour,
    n_control_points: int,
    degree: int,
    weights: FloatArray | None = None,
) -> Balanced:
    """Control points at stations of a kind, without a solve; weights say nothing to it."""
    path = contour if kind == "every-nth" else even_samples(contour)
    length = max(2, min(CHORD, len(path) // CHORD_PART))
    cpda = chord_to_point(path, length, prominence=PROMINENCE, spacing=max(1, length // 2))
    count = n_control_points - (0 if path.closed else 2)
    stations = chosen_stations(kind, path, cpda, count)
    points = path.points[stations]
    ends = None if path.closed else path.points[[0, -1]]
    inner = points + quasi_interpolating(points, ends, degree)
    return placed_curve(contour, inner, path.arc_length[stations], degree, periodic=contour.closed)


STARTS: dict[str, Callable[[Contour, int, int, FloatArray | None], Balanced]] = {
    "balanced": balanced_start,
    **{kind: partial(station_start, kind) for kind in STATIONS},
    "park-lee": park_lee_start,
    "dominant": dominant_start,
    "uniform": uniform_start,
}
