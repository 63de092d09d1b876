"""Strokes of a medial axis as they were drawn: junctions, corners and ends where the pen was.

Where strokes meet or turn, the disc between their sides is larger than a stroke is wide, and the
axis leaves their middles. What was drawn there is where their straight courses meet. A square end
lies half a width beyond the last disc, the end of a round one is its centre.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scipy.spatial import cKDTree

    from shapespline.typing import BoolArray, FloatArray, IntArray

# Pixels between points of a line.
LINE_STEP = 1.0
# Within so many radii of a junction or corner the axis follows neither stroke; over so many more,
# and so many pixels at least, the stroke beside it runs straight if its middle stays within BENT
# pixels of a line (TRC-12).
MIXED, BESIDE, LEAST_BESIDE, BENT = 1.5, 3.0, 3.0, 0.25
# A stroke turns where its discs are larger than this part of its usual ones, by this angle at
# least; lines that meet at less say nothing of where (TRC-12).
HUMP, LEAST_TURN = 1.08, np.radians(20.0)
# A junction was drawn no farther from where the axis has it than so many of its radii.
FARTHEST = 1.5
# A line ends where its discs become smaller than this part of what they are within the stroke; of
# a tip that tapers so many radii at most are lost.
FULL, TAPER = 0.9, 2.0
# An end is square if its outline beside the middle is no farther back than this part of the
# radius; of a half disc it is 0.2 (TRC-12).
SQUARE = 0.1


class Branch(NamedTuple):
    """Part of a medial axis: places, radii of its discs, and the nodes where it begins and ends.

    Nodes are negative at loose ends; of a ring the first place is the last one, too.
    """

    points: FloatArray
    radii: FloatArray
    nodes: tuple[int, int]
    is_ring: bool = False

    @property
    def width(self) -> float:
        """Usual width, pixels."""
        return 2.0 * float(np.median(self.radii))


class StraightCourse(NamedTuple):
    """Where a stroke runs beside a junction: through a place, along a direction away from it."""

    place: FloatArray
    along: FloatArray


class Stroke(NamedTuple):
    """A line at even steps, closed or open, and its width."""

    points: FloatArray
    closed: bool
    width: float


def drawn_strokes(
    branches: Sequence[Branch], places: FloatArray, radii: FloatArray, outline: FloatArray
) -> list[Stroke]:
    """Lines of a medial axis, each from end to end.

    Parameters
    ----------
    branches : sequence of Branch
    places, radii : ndarray, shape (k, 2) and (k,)
        Of the nodes.
    outline : ndarray, shape (n, 2)
        Points on the outlines, dense.
    """
    from scipy.spatial import cKDTree

    met = _junctions(branches, places, radii)
    tree = cKDTree(outline)
    found = []
    for branch in branches:
        points, fixed = _turned(_trimmed(branch, places, radii, met))
        if not branch.is_ring:
            points, fixed = _ended(points, fixed, branch, tree)
        line = _even_steps(points, fixed, branch.is_ring)
        if line is not None:
            found.append(Stroke(line, branch.is_ring, branch.width))
    return found


def _junctions(
    branches: Sequence[Branch], places: FloatArray, radii: FloatArray
) -> dict[int, FloatArray]:
    """Where the strokes of each junction meet."""
    courses: dict[int, list[StraightCourse]] = {}
    for branch in branches:
        for node, at_end in zip(branch.nodes, (False, True), strict=True):
            if node >= 0 and not branch.is_ring:
                points = branch.points[:: -1 if at_end else 1]
                course = _course(points, places[node], MIXED * radii[node], 0.5 * branch.width)
                courses.setdefault(node, []).extend([] if course is None else [course])
    met = {}
    for node, beside in courses.items():
        place = _meeting(beside)
        near = place is not None and np.hypot(*(place - places[node])) <= FARTHEST * radii[node]
        met[node] = place if place is not None and near else places[node]
    return met


def _course(
    points: FloatArray, start: FloatArray, mixed: float, radius: float
) -> StraightCourse | None:
    """The line along which a stroke leaves a place; None where it bends or is too short."""
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


def _meeting(courses: Sequence[StraightCourse]) -> FloatArray | None:
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


def _trimmed(
    branch: Branch, places: FloatArray, radii: FloatArray, met: dict[int, FloatArray]
) -> Branch:
    """A branch without what of it lies in junctions or in the corners of its ends."""
    if branch.is_ring:
        start = _even_start(branch)
        points, own = (np.roll(x[:-1], -start, axis=0) for x in branch[:2])
        return branch._replace(
            points=np.concatenate([points, points[:1]]), radii=np.append(own, own[0])
        )
    kept = np.ones(len(branch.points), dtype=bool)
    for end, node in zip((0, -1), branch.nodes, strict=True):
        if node < 0:
            off = np.hypot(*(branch.points - branch.points[end]).T)
            kept &= ~_in_corner(branch.radii, off)
        else:
            off = np.hypot(*(branch.points - places[node]).T)
            kept &= off > MIXED * radii[node]
    points, own = branch.points[kept], branch.radii[kept]
    for end, node in zip((0, -1), branch.nodes, strict=True):
        if node >= 0:
            at = 0 if end == 0 else len(points)
            points = np.insert(points, at, met[node], axis=0)
            own = np.insert(own, at, 0.5 * branch.width)
    return branch._replace(points=points, radii=own)


def _even_start(branch: Branch) -> int:
    """Where to open a ring: amid the longest stretch without corners."""
    high = np.flatnonzero(branch.radii[:-1] > 0.5 * HUMP * branch.width)
    if len(high) == 0:
        return 0
    count = len(branch.points) - 1
    gaps = np.diff(high, append=high[0] + count)
    longest = int(np.argmax(gaps))
    return int(high[longest] + gaps[longest] // 2) % count


def _in_corner(radii: FloatArray, off: FloatArray) -> BoolArray:
    """Nodes at a loose end where the discs shrink: the axis has turned into a corner there."""
    widest = float(radii[off <= 2 * TAPER * np.median(radii)].max())
    far = off > TAPER * widest
    full = far | (radii >= FULL * np.median(radii[off <= 2 * TAPER * widest]))
    inner = float(off[full].min()) if full.any() else 0.0
    return np.asarray(off < inner)


def _turned(branch: Branch) -> tuple[FloatArray, IntArray]:
    """Points with the corners of a stroke put back, and the indices of corners."""
    points, radii = branch.points, branch.radii
    usual = 0.5 * branch.width
    high = np.flatnonzero(radii > HUMP * usual)
    kept, corners = np.ones(len(points), dtype=bool), {}
    for run in np.split(high, np.flatnonzero(np.diff(high) > 1) + 1):
        if len(run) == 0:
            continue
        peak = int(run[np.argmax(radii[run])])
        mixed = MIXED * radii[peak]
        courses = [
            _course(points[peak::-1], points[peak], mixed, usual),
            _course(points[peak:], points[peak], mixed, usual),
        ]
        place = _meeting([course for course in courses if course is not None])
        if place is None or np.hypot(*(place - points[peak])) > radii[peak]:
            continue
        near = np.hypot(*(points - points[peak]).T) <= mixed
        begin, end = peak, peak
        while begin > 0 and near[begin - 1]:
            begin -= 1
        while end < len(points) - 1 and near[end + 1]:
            end += 1
        kept[begin : end + 1] = False
        kept[peak] = True
        corners[peak] = place
    points = points.copy()
    for index, place in corners.items():
        points[index] = place
    kept[list(corners)] = True
    return points[kept], np.cumsum(kept)[sorted(corners)] - 1


def _ended(
    points: FloatArray, fixed: IntArray, branch: Branch, outline: cKDTree
) -> tuple[FloatArray, IntArray]:
    """A line whose loose ends reach as far as the pen did."""
    for at_end in (False, True):
        if branch.nodes[at_end] >= 0:
            continue
        ahead = points[::-1] if at_end else points
        end = _drawn_end(ahead, 0.5 * branch.width, outline)
        if end is None:
            continue
        if at_end:
            points = np.concatenate([points, [end]])
        else:
            points, fixed = np.concatenate([[end], points]), fixed + 1
    return points, fixed


def _drawn_end(points: FloatArray, radius: float, outline: cKDTree) -> FloatArray | None:
    """Where a stroke that loosely begins with its first point was begun; None for a tip."""
    course = _course(points, points[0], 0.0, radius)
    if course is None:
        return None
    back = -course.along
    near = outline.data[outline.query_ball_point(points[0], 2.5 * radius + 1.0)] - course.place
    along, aside = near @ back, np.abs(near @ np.array((-back[1], back[0])))
    own = float((points[0] - course.place) @ back)
    middle = along[(along > own) & (aside <= max(0.3 * radius, 0.3))]
    beside = along[(along > own) & (aside >= 0.5 * radius) & (aside <= 0.8 * radius)]
    if len(middle) == 0 or len(beside) == 0:
        return None
    reach = float(middle.mean())
    if reach - float(beside.mean()) > SQUARE * radius:
        reach -= radius
    return course.place + reach * back if reach > own else None


def _even_steps(points: FloatArray, fixed: IntArray, is_ring: bool) -> FloatArray | None:
    """Points a pixel apart, ends and corners among them; None for a line without extent."""
    lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    if lengths[-1] < LINE_STEP:
        return None
    stops = np.unique(np.concatenate([[0], fixed, [len(points) - 1]]).astype(int))
    at = [lengths[0]]
    for begin, end in zip(lengths[stops[:-1]], lengths[stops[1:]], strict=True):
        count = max(1, round(float(end - begin) / LINE_STEP))
        at.extend(np.linspace(begin, end, count + 1)[1:])
    if is_ring:
        at.pop()
        if len(at) < 8:
            at = np.linspace(0, lengths[-1], 8, endpoint=False).tolist()
    return np.column_stack([np.interp(at, lengths, column) for column in points.T])
