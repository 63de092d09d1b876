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

# A stroke leads on from its end as it did over so many radii, and so many pixels at least, but for
# those beside its end, where a notch or corner is rounded.
SEEN, SEEN_PIXELS, NOTCH = 2.0, 4.0, 1.0
# How that is read, the first that follows it within so many pixels: a line or a parabola along this
# part of it. What turns into a line was drawn to end as one (TRC-26).
READINGS, FOLLOWED = ((1.0, 1), (1.0, 2), (0.7, 1), (0.5, 1), (0.35, 1), (1.0, 2)), 0.1


class StraightCourse(NamedTuple):
    """Where a stroke runs beside a junction: through a place, along a direction away from it."""

    place: FloatArray
    along: FloatArray


class EndCourse(NamedTuple):
    """Where the end of a stroke leads: its direction, and how that changes along a pixel."""

    direction: FloatArray
    bend: FloatArray

    def way(self, start: FloatArray, length: float) -> FloatArray:
        """Places a pixel apart from its end on."""
        u = np.linspace(0.0, length, max(2, int(length) + 1))[:, None]
        return np.asarray(start + u * self.direction + 0.5 * u**2 * self.bend)


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


def end_course(points: FloatArray, radius: float) -> EndCourse:
    """Where a line leads beyond its first point."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    # Where it ends a notch or a corner is rounded.
    clear = along >= NOTCH
    if along[-1] > 3.0 * NOTCH and clear.sum() > 1:
        points, along = points[clear], along[clear]
    longest = max(SEEN * radius, SEEN_PIXELS)
    terms = np.array([points[1] - points[0], points[0]])  # of places far from each other
    for part, degree in READINGS:
        seen = along - along[0] <= max(part * longest, SEEN_PIXELS)
        if seen.sum() > degree:
            terms = np.polyfit(along[seen], points[seen], degree)
            off = np.vander(along[seen], degree + 1) @ terms - points[seen]
            if np.abs(off).max() <= FOLLOWED:
                break
    # Its length counts from where it ends: it leads on the other way.
    speed = max(float(np.hypot(*terms[-2])), 1e-12)
    bend = 2.0 * terms[0] / speed**2 if len(terms) == 3 else np.zeros(2)
    return EndCourse(-terms[-2] / speed, bend)
