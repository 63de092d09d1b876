"""Stations: the points of an outline that get a control point each.

The local maxima of H (CPDA) say where an outline bends most; what lies between two of them they do
not see. So the gaps are filled, at equal integrals of a density of control points: the root of the
curvature that H measures, plus a part of its mean for the straight runs. A cubic with knots h apart
errs by k h^2 at first, which the root makes the same everywhere.
"""

from __future__ import annotations

from heapq import heapify, heapreplace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import bending
from shapespline.errors import DegenerateContourError
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.analysis import Cpda
    from shapespline.typing import FloatArray, IntArray

# Exponent of the curvature in the density (PAP-06).
BEND_EXPONENT = 0.5
# Part of the density's mean that is added to it, for the straight runs (PAP-06).
MEAN_PART = 0.3
# Own number: gaps between maxima wider than this part of the mean gap are halved until none is,
# because with one control point a maximum none shapes the run between two of them.
WIDE_GAP = 0.5
# Steps between points may differ by this factor and still count as equal.
EVEN_SPACING = 1.5
STATIONS = (
    "cpda-filled",
    "cpda-halved",
    "cpda-maxima",
    "curvature",
    "arc-length",
    "every-nth",
)


def chosen_stations(kind: str, path: Contour, cpda: Cpda, count: int) -> IntArray:
    """Indices of the points of a path that get a control point, increasing; the ends have theirs.

    Parameters
    ----------
    kind : str
        One of ``STATIONS``: the maxima of H with their gaps filled by curvature or halved by index,
        or the maxima alone; by curvature, by arc length or by index without any maximum.
    path : Contour
        The points that CPDA was taken on, about equally spaced; open for a clamped curve, with the
        first point again at its end where a closed outline comes back to it.
    cpda : Cpda
    count : int
        How many. Of more maxima the highest are taken.

    Raises
    ------
    DegenerateContourError
        If there are too few samples, or maxima where nothing else is to be taken.
    """
    room = len(path) if path.closed else len(path) - 2
    if count > room:
        raise DegenerateContourError(
            f"contour must have more points for the degree: {len(path)} points hold"
            f" {room} control points apart from the ends, {count} are needed"
        )
    if kind.startswith("cpda"):
        maxima = inner_maxima(cpda, path)
        if len(maxima) > count:
            highest = np.argsort(-cpda.values[maxima], kind="stable")[:count]
            return np.sort(maxima[highest])
        if kind == "cpda-maxima":
            if len(maxima) < count:
                raise DegenerateContourError(
                    f"length {cpda.length} finds {len(maxima)} maxima, at least {count} are needed;"
                    " shorten the length, or fill the gaps (cpda-filled)"
                )
            return maxima
        fixed = maxima
    else:
        fixed = np.empty(0, dtype=np.int64)
    return _filled(fixed, _grown(kind, path, cpda), count, closed=path.closed)


def even_samples(contour: Contour) -> Contour:
    """The points themselves where they are about equally spaced, else as many at equal spacing."""
    steps = np.diff(contour.arc_length)
    uneven = steps.max() > EVEN_SPACING * steps.min()
    return contour.resampled(len(contour)) if uneven else contour


def own_number(path: Contour, cpda: Cpda) -> int:
    """How many stations the outline asks for: every wide gap between maxima halved."""
    maxima, n = inner_maxima(cpda, path), len(path)
    if len(maxima) == 0:
        return 0
    if path.closed:
        gaps, room = np.diff(np.append(maxima, maxima[0] + n)), n
    else:
        gaps, room = np.diff(np.concatenate([[0], maxima, [n - 1]])), n - 2
    halvings = np.maximum(np.ceil(np.log2(gaps / (WIDE_GAP * gaps.mean())) - 1e-9), 0.0)
    return min(len(maxima) + int(np.sum(2.0**halvings - 1.0)), room)


def inner_maxima(cpda: Cpda, path: Contour) -> IntArray:
    """The maxima that are no ends of the path."""
    maxima = cpda.maxima
    return maxima if path.closed else maxima[(maxima > 0) & (maxima < len(path) - 1)]


def _grown(kind: str, path: Contour, cpda: Cpda) -> FloatArray:
    """What control points are spread evenly over, up to each vertex of the path: its integral."""
    if kind == "arc-length":
        return path.arc_length
    steps = len(path.arc_length) - 1
    if kind in ("cpda-halved", "every-nth"):
        return np.arange(steps + 1.0)
    n = len(cpda.values)
    samples = path if n == len(path) else Contour.trusted(path.points[:n], closed=True)
    root = bending(samples, cpda.length) ** BEND_EXPONENT
    if not root.any():
        return np.arange(steps + 1.0)
    density = (root + MEAN_PART * root.mean())[np.arange(steps + 1) % n]
    return np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])


def _filled(fixed: IntArray, grown: FloatArray, count: int, *, closed: bool) -> IntArray:
    """The fixed stations and others between them, at equal steps of what grows along the path.

    Each in turn goes to the gap whose parts are largest, as long as the gap holds points.
    """
    last = len(grown) - 1
    if closed:
        fixed = fixed if len(fixed) else np.zeros(1, dtype=np.int64)
        edges = np.append(fixed, fixed[0] + last)
        grown = np.concatenate([grown[:-1], grown + grown[-1]])
    else:
        edges = np.concatenate([[0], fixed, [last]])
    at = grown[edges]
    parts = np.array(_shares(np.diff(at), np.diff(edges), count - len(fixed)))
    gap = np.repeat(np.arange(len(parts)), parts)
    part = np.arange(len(gap)) - np.repeat(np.cumsum(parts) - parts, parts)
    aims = at[gap] + np.diff(at)[gap] * (part / parts[gap])
    places = np.rint(np.interp(aims, grown, np.arange(len(grown)))).astype(np.int64)
    stations = _apart(places, gap, part, parts, edges)
    return np.sort(stations % last) if closed else stations[1:]


def _shares(integrals: FloatArray, widths: IntArray, more: int) -> list[int]:
    """Parts that each gap is cut into, so that the largest part is as small as it can be."""
    parts = [1] * len(integrals)
    queue = [(-integral, gap) for gap, integral in enumerate(integrals.tolist())]
    heapify(queue)
    while more > 0:
        _, gap = queue[0]
        if parts[gap] >= widths[gap]:  # no sample left in it
            heapreplace(queue, (np.inf, gap))
            continue
        parts[gap] += 1
        more -= 1
        heapreplace(queue, (-integrals[gap] / parts[gap], gap))
    return parts


def _apart(
    places: IntArray, gap: IntArray, part: IntArray, parts: IntArray, edges: IntArray
) -> IntArray:
    """Rounded places moved so that they differ: each stays in its gap, which begins at an edge."""
    places = np.where(part == 0, edges[gap], places)
    # Each place less its number in the gap must not fall, and leave room for those after it.
    lowest, highest = edges[gap], edges[gap + 1] - parts[gap]
    shifted = np.clip(places - part, lowest, highest)
    return np.maximum.accumulate(shifted + part - np.arange(len(part))) + np.arange(len(part))
