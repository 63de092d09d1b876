"""Strokes of a medial axis as they were drawn: junctions, corners and ends where the pen was.

Where strokes meet or turn, the disc between their sides is larger than a stroke is wide, and the
axis leaves their middles. What was drawn there is where their straight courses meet. A square end
lies half a width beyond the last disc, the end of a round one is its centre.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.tracing.strokes.course import Turn, course_of, meeting, turned
from shapespline.tracing.strokes.stroke import stroke_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scipy.spatial import cKDTree

    from shapespline.tracing.strokes.course import StraightCourse
    from shapespline.tracing.strokes.graph import Branch, Graph
    from shapespline.tracing.strokes.stroke import Stroke
    from shapespline.typing import BoolArray, FloatArray

# Within so many radii of a junction or corner the axis follows neither stroke (TRC-12).
MIXED = 1.5
# A stroke turns where its discs are larger than this part of its usual ones (TRC-12).
HUMP = 1.08
# A junction was drawn no farther from where the axis has it than so many of its radii.
FARTHEST = 1.5
# A line ends where its discs become smaller than this part of what they are within the stroke; of
# a tip that tapers so many radii at most are lost.
FULL, TAPER = 0.9, 2.0


def medial_strokes(axis: Graph, branches: Sequence[Branch], outline: cKDTree) -> list[Stroke]:
    """Lines of the branches of a medial axis, each from end to end.

    ``outline`` are points on the outlines, dense.
    """
    met = _junctions(branches, axis.points, axis.radii)
    found = []
    for branch in branches:
        points, corners = _turned(_trimmed(branch, axis.points, axis.radii, met))
        stroke = stroke_of(branch, points, corners, outline)
        if stroke is not None:
            found.append(stroke)
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
                course = course_of(points, places[node], MIXED * radii[node], 0.5 * branch.width)
                courses.setdefault(node, []).extend([] if course is None else [course])
    met = {}
    for node, beside in courses.items():
        place = meeting(beside)
        near = place is not None and np.hypot(*(place - places[node])) <= FARTHEST * radii[node]
        met[node] = place if place is not None and near else places[node]
    return met


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


def _turned(branch: Branch) -> tuple[FloatArray, list[int]]:
    """Points with the corners of a stroke put back, and the indices of corners."""
    points, radii = branch.points, branch.radii
    usual = 0.5 * branch.width
    high = np.flatnonzero(radii > HUMP * usual)
    turns = []
    for run in np.split(high, np.flatnonzero(np.diff(high) > 1) + 1):
        if len(run):
            peak = int(run[np.argmax(radii[run])])
            turns.append(Turn(peak, MIXED * radii[peak], radii[peak]))
    return turned(points, turns, usual)
