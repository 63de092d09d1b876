"""A stroke as it is given back: a line at even steps that ends where the pen did, and its width."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.strokes.course import course_of, end_course

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scipy.spatial import cKDTree

    from shapespline.tracing.strokes.graph import Branch
    from shapespline.typing import FloatArray

# Pixels between points of a line.
LINE_STEP = 1.0
# An end is square if its outline beside the middle is no farther back than this part of the
# radius; of a half disc it is 0.2 (TRC-12).
SQUARE = 0.1
# What bends ends no farther than so many radii from the last disc: else it is not its end.
FARTHEST = 1.1


class Stroke(NamedTuple):
    """A line at even steps, closed or open, and its width."""

    points: FloatArray
    closed: bool
    width: float


def stroke_of(
    branch: Branch, points: FloatArray, corners: Sequence[int], outline: cKDTree
) -> Stroke | None:
    """The stroke along a branch of a net, whose places are ``points``; None without extent.

    Parameters
    ----------
    branch : Branch
        Its width, whether it is a ring, and which of its ends are loose.
    points : ndarray, shape (n, 2)
    corners : sequence of int
        Indices of points that are kept.
    outline : cKDTree
        Points on the outlines, dense.
    """
    fixed = list(corners)
    if not branch.is_ring:
        for at_end in (False, True):
            if branch.nodes[at_end] >= 0:
                continue
            beyond = _beyond(points[::-1] if at_end else points, 0.5 * branch.width, outline)
            if at_end:
                points = np.concatenate([points, beyond])
            else:
                points = np.concatenate([beyond[::-1], points])
                fixed = [k + len(beyond) for k in fixed]
    line = _even_steps(points, fixed, branch.is_ring)
    return None if line is None else Stroke(line, branch.is_ring, branch.width)


def _beyond(points: FloatArray, radius: float, outline: cKDTree) -> FloatArray:
    """How a stroke that loosely begins with its first point was begun; nothing at a tip."""
    nothing = np.empty((0, 2))
    if len(points) < 3:
        return nothing
    bent, straight = end_course(points, radius), course_of(points, points[0], 0.0, radius)
    place, back = points[0], bent.direction
    if straight is not None:
        place, back = straight.place, -straight.along
    near = outline.data[outline.query_ball_point(points[0], 2.5 * radius + 1.0)] - place
    along, aside = near @ back, np.abs(near @ np.array((-back[1], back[0])))
    own = float((points[0] - place) @ back)
    middle = along[(along > own) & (aside <= max(0.3 * radius, 0.3))]
    beside = along[(along > own) & (aside >= 0.5 * radius) & (aside <= 0.8 * radius)]
    if len(middle) == 0:
        return nothing
    # Farther away is other ink.
    last = float(middle.min()) + 0.5 * radius + 0.5
    middle, beside = middle[middle <= last], beside[beside <= last]
    if len(beside) == 0:
        return nothing
    reach = float(middle.mean())
    if reach - float(beside.mean()) > SQUARE * radius:
        reach -= radius
    if reach <= own:
        return nothing
    if straight is None:
        return bent.way(points[0], reach)[1:] if reach <= FARTHEST * radius else nothing
    return np.asarray(place + reach * back)[None]


def _even_steps(points: FloatArray, fixed: Sequence[int], is_ring: bool) -> FloatArray | None:
    """Points a pixel apart, ends and corners among them; None for a line without extent."""
    lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    if lengths[-1] < LINE_STEP:
        return None
    stops = np.unique([0, *fixed, len(points) - 1])
    at = [lengths[0]]
    # What comes back to its junction has some points on the way.
    least = 4 if len(stops) == 2 and (points[0] == points[-1]).all() else 1
    for begin, end in zip(lengths[stops[:-1]], lengths[stops[1:]], strict=True):
        count = max(least, round(float(end - begin) / LINE_STEP))
        at.extend(np.linspace(begin, end, count + 1)[1:])
    if is_ring:
        at.pop()
        if len(at) < 8:
            at = np.linspace(0, lengths[-1], 8, endpoint=False).tolist()
    return np.column_stack([np.interp(at, lengths, column) for column in points.T])
