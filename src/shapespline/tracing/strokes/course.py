"""Straight courses of strokes, and where they meet."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray

# Over so many radii, and so many pixels at least, a stroke beside a junction, corner or end runs
# straight if its middle stays within BENT pixels of a line (TRC-12).
BESIDE, LEAST_BESIDE, BENT = 3.0, 3.0, 0.25
# Lines that meet at less say nothing of where (TRC-12).
LEAST_TURN = np.radians(20.0)


class StraightCourse(NamedTuple):
    """Where a stroke runs beside a junction: through a place, along a direction away from it."""

    place: FloatArray
    along: FloatArray


class Turn(NamedTuple):
    """Where a line may have a corner.

    Attributes
    ----------
    at : int
        Index of its place.
    mixed : float
        How far from there the line follows neither side.
    farthest : float
        How far from there the corner may be.
    is_corner : bool
        Whether it is one even where no straight courses tell its place.
    """

    at: int
    mixed: float
    farthest: float
    is_corner: bool = False


def course_of(
    points: FloatArray, start: FloatArray, mixed: float, radius: float
) -> StraightCourse | None:
    """The line along which a stroke leaves a place; None where it bends or is too short.

    What is within ``mixed`` of the place follows neither of the strokes that meet there.
    """
    off = np.hypot(*(points - start).T)
    length = max(BESIDE * radius, LEAST_BESIDE)
    beyond = np.argmax(off > mixed + length) if (off > mixed + length).any() else len(points)
    own = points[:beyond][off[:beyond] >= mixed]
    if len(own) < 3 or np.hypot(*(own[-1] - own[0])) < 0.5 * length:
        return None
    middle = own.mean(axis=0)
    _, _, axes = np.linalg.svd(own - middle, full_matrices=False)
    if np.abs((own - middle) @ axes[1]).max() > BENT:
        return None
    along = axes[0] if (own[-1] - own[0]) @ axes[0] > 0 else -axes[0]
    return StraightCourse(middle, along)


def meeting(courses: Sequence[StraightCourse]) -> FloatArray | None:
    """The place nearest to all lines (least squares); None where they hardly meet."""
    if len(courses) < 2:
        return None
    normals = np.array([(-along[1], along[0]) for _, along in courses])
    matrix = normals.T @ normals
    # Of two lines the smaller eigenvalue is 1 - cos of the angle between them.
    if np.linalg.eigvalsh(matrix)[0] < 1.0 - np.cos(LEAST_TURN):
        return None
    offsets = np.array(
        [normal @ place for normal, (place, _) in zip(normals, courses, strict=True)]
    )
    return np.asarray(np.linalg.solve(matrix, normals.T @ offsets))


def turned(
    points: FloatArray, turns: Sequence[Turn], radius: float
) -> tuple[FloatArray, list[int]]:
    """A line with corners where its straight courses meet, and the indices of corners."""
    kept, places = np.ones(len(points), dtype=bool), {}
    for turn in turns:
        courses = [
            course_of(points[turn.at :: -1], points[turn.at], turn.mixed, radius),
            course_of(points[turn.at :], points[turn.at], turn.mixed, radius),
        ]
        place = meeting([course for course in courses if course is not None])
        if place is None or np.hypot(*(place - points[turn.at])) > turn.farthest:
            if turn.is_corner:
                places[turn.at] = points[turn.at]
            continue
        near = np.hypot(*(points - points[turn.at]).T) <= turn.mixed
        begin = end = turn.at
        while begin > 0 and near[begin - 1]:
            begin -= 1
        while end < len(points) - 1 and near[end + 1]:
            end += 1
        kept[begin : end + 1] = False
        places[turn.at] = place
    points = points.copy()
    for at, place in places.items():
        points[at] = place
    kept[list(places)] = True
    return points[kept], [int(np.count_nonzero(kept[:at])) for at in sorted(places)]
