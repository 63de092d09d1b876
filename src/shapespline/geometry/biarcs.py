"""A curve as lines and arcs of circles, for machines that read nothing else.

Along every corner-free stretch a biarc, two arcs with a common tangent, takes the place of the
curve from one node to the next with the curve's own tangents at both [1]_, so that arcs join
smoothly. Nodes lie on the curve and each stretch reaches as far as the tolerance allows.

References
----------
.. [1] K. M. Bolton, "Biarc curves", Computer-Aided Design 7, 1975, 89-92.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.validation import is_number
from shapespline.values import EXACT_TURN, BSplineCurve

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.typing import FloatArray

# Part of the tolerance that samples on the curve may keep from what lies between them (GEO-02).
SAMPLING_PART = 0.02
# A Bezier that strays from its chord by less than this part of it is a line.
STRAIGHT = 1e-12
# An arc of a biarc turns by a quarter at most: the biarc by a half, of which one arc may be made.
LARGEST_TURN = 0.5 * pi + EXACT_TURN
MOST_SAMPLES = 2_000_000


@dataclass(frozen=True, eq=False)
class ArcPolyline:
    """Lines and arcs end to end.

    Attributes
    ----------
    points : ndarray, shape (n, 2)
        Where they meet; of a closed one the first point is not repeated.
    bulges : ndarray, shape (n,)
        Of the segment that begins at each point: the tangent of a quarter of the angle that it
        turns, positive to the left, 0 for a line. The last of an open one is 0.
    closed : bool
    """

    points: FloatArray
    bulges: FloatArray
    closed: bool

    @property
    def n_segments(self) -> int:
        """Number of lines and arcs."""
        return len(self.points) - (0 if self.closed else 1)


def arc_polyline(curve: BSplineCurve, tolerance: float, *, closed: bool = False) -> ArcPolyline:
    """Lines and arcs within a tolerance of a curve, in both directions.

    Corners of the curve stay, straight pieces stay lines, everything else is tangent-continuous.

    Parameters
    ----------
    curve : BSplineCurve
    tolerance : float
        Data units.
    closed : bool
        Whether the end is joined to the beginning, which must be the same point.

    Raises
    ------
    InvalidInputError
        If the tolerance is not positive, or absurdly small for the curve.

    Notes
    -----
    A stretch of the curve and its biarc have common ends, and the foot of a curve point on the
    biarc moves without a jump from one end to the other: the distances from the curve to its feet
    bound both directions. They are taken at samples so dense that between them no more than 2 % of
    the tolerance is lost, for which samples keep to the rest of it.

    Examples
    --------
    >>> from shapespline.values import BSplineCurve
    >>> arch = BSplineCurve([0, 0, 0, 1, 1, 1], [(0, 0), (1, 2), (2, 0)], degree=2)
    >>> found = arc_polyline(arch, 0.05)
    >>> found.n_segments, found.points[0].tolist(), found.points[-1].tolist()
    (4, [0.0, 0.0], [2.0, 0.0])
    """
    if not (is_number(tolerance) and 0 < tolerance < np.inf):
        raise InvalidInputError(f"arc_tolerance must be a positive length, got {tolerance!r}")
    segments = [
        segment
        for stretch in _stretches(curve, tolerance)
        for segment in _segments(stretch, (1 - SAMPLING_PART) * tolerance)
    ]
    points = [segment.begin for segment in segments]
    bulges = [segment.bulge for segment in segments]
    if not closed:
        points.append(segments[-1].end)
        bulges.append(0.0)
    return ArcPolyline(np.array(points), np.array(bulges), closed)


class _Segment(NamedTuple):
    """A line or arc."""

    begin: FloatArray
    end: FloatArray
    bulge: float


class _Stretch(NamedTuple):
    """A corner-free run of a curve: dense points (n, 2) and unit tangents there, both (n, 2)."""

    points: FloatArray
    tangents: FloatArray


def _stretches(curve: BSplineCurve, tolerance: float) -> Iterator[_Stretch]:
    """The curve cut at its corners and around its lines, sampled."""
    beziers = [bezier for bezier in curve.beziers().points if np.ptp(bezier, axis=0).any()]
    parts: list[tuple[FloatArray, FloatArray]] = []
    for bezier in beziers:
        if _is_straight(bezier):
            if parts:
                yield _joined(parts)
                parts = []
            chord = bezier[-1] - bezier[0]
            yield _Stretch(bezier[[0, -1]], np.tile(chord / np.hypot(*chord), (2, 1)))
            continue
        sampled = _sampled(bezier, SAMPLING_PART * tolerance)
        if parts and not _is_smooth(parts[-1][1][-1], sampled[1][0]):
            yield _joined(parts)
            parts = []
        parts.append(sampled)
    if parts:
        yield _joined(parts)


def _is_straight(bezier: FloatArray) -> bool:
    """Whether a Bezier runs along its chord and does not turn back."""
    chord = bezier[-1] - bezier[0]
    length_sq = float(chord @ chord)
    if length_sq == 0.0:
        return False
    inner = bezier[1:-1] - bezier[0]
    along, across = inner @ chord, inner[:, 0] * chord[1] - inner[:, 1] * chord[0]
    return bool(
        (np.abs(across) <= STRAIGHT * length_sq).all()
        and (np.diff(np.concatenate([[0.0], along, [length_sq]])) >= 0).all()
    )


def _is_smooth(before: FloatArray, after: FloatArray) -> bool:
    turn = before[0] * after[1] - before[1] * after[0]
    return abs(turn) <= EXACT_TURN and float(before @ after) > 0


def _joined(parts: list[tuple[FloatArray, FloatArray]]) -> _Stretch:
    """Samples of neighbouring Beziers without those of the ends that they share."""
    points, tangents = zip(*parts, strict=True)
    return _Stretch(
        np.concatenate([points[0], *(p[1:] for p in points[1:])]),
        np.concatenate([tangents[0], *(t[1:] for t in tangents[1:])]),
    )


def _sampled(bezier: FloatArray, gap: float) -> tuple[FloatArray, FloatArray]:
    """Points of a Bezier whose chords stray by no more than ``gap``, and unit tangents."""
    p = len(bezier) - 1
    bend = float(np.hypot(*np.diff(bezier, 2, axis=0).T).max()) if p > 1 else 0.0
    # An arc bends towards its chords as a curve does: half of the gap for each.
    wanted = np.sqrt(p * (p - 1) * bend / (4 * gap))
    if not wanted < MOST_SAMPLES:
        raise InvalidInputError(
            f"arc_tolerance asks for {wanted:.2g} samples on one piece, got {gap / SAMPLING_PART:g}"
            "; raise it"
        )
    t = np.linspace(0.0, 1.0, max(8, int(np.ceil(wanted)) + 1))[:, None]
    points, velocity = _evaluated(bezier, t), _evaluated(p * np.diff(bezier, axis=0), t)
    points[0], points[-1] = bezier[0], bezier[-1]
    speed = np.hypot(velocity[:, 0], velocity[:, 1])
    # Where the curve stands still, at an end with a double control point, the chord tells the way.
    still = speed <= STRAIGHT * speed.max()
    chords = np.diff(points, axis=0)
    velocity[still] = np.concatenate([chords, chords[-1:]])[still]
    return points, velocity / np.hypot(velocity[:, 0], velocity[:, 1])[:, None]


def _evaluated(bezier: FloatArray, t: FloatArray) -> FloatArray:
    """De Casteljau at many parameters (k, 1) at once, shape (k, 2)."""
    work = [np.broadcast_to(point, (len(t), 2)) for point in bezier]
    while len(work) > 1:
        work = [(1 - t) * a + t * b for a, b in pairwise(work)]
    return np.array(work[0])


def _segments(stretch: _Stretch, tolerance: float) -> Iterator[_Segment]:
    """Biarcs, each as long as can be: a longer one is tried until it fails, then halfway."""
    last, begin, step = len(stretch.points) - 1, 0, 1
    while begin < last:
        reached, best = begin, None
        failed = last + 1
        while failed - reached > 1:
            end = min(reached + step, failed - 1, last)
            found = _biarc(stretch, begin, end, tolerance)
            if found is None:
                failed = end
                step = max(1, (failed - reached) // 2)
            else:
                reached, best = end, found
                step = 2 * step if failed > last else max(1, (failed - reached) // 2)
        if best is None:  # neighbouring samples: the curve is its chord to a part of the tolerance
            reached = begin + 1
            best = [_Segment(stretch.points[begin], stretch.points[reached], 0.0)]
        yield from best
        step = max(1, reached - begin)
        begin = reached


def _biarc(stretch: _Stretch, begin: int, end: int, tolerance: float) -> list[_Segment] | None:
    """Two arcs with the ends and end tangents of a stretch, or one, or None if they stray."""
    points = stretch.points[begin : end + 1]
    p, q = points[0], points[-1]
    t0, t1 = stretch.tangents[begin], stretch.tangents[end]
    v = q - p
    chord_sq = float(v @ v)
    if chord_sq == 0.0:
        return None
    # Equal tangent lengths d: |q - p - d (t0 + t1)| = 2 d, the ends of the middle tangent.
    both, cross = float(v @ (t0 + t1)), 1.0 - float(t0 @ t1)
    if cross < 1e-14:
        if both <= 0:
            return None
        d = chord_sq / (2 * both)
    else:
        d = (-both + np.sqrt(both**2 + 2 * cross * chord_sq)) / (2 * cross)
    middle = 0.5 * (p + q + d * (t0 - t1))
    first, second = _arc(p, middle, t0), _arc(q, middle, -t1)
    if first is None or second is None:
        return None
    one, two = first, _Segment(second.end, second.begin, -second.bulge)
    # On which side of the middle normal a point lies says which arc is its own.
    along = middle - p + q - middle
    direction = (q - d * t1) - (p + d * t0)
    normal = direction if float(direction @ direction) > 0 else along
    before = (points - middle) @ normal <= 0
    for segment, own in ((one, points[before]), (two, points[~before])):
        if len(own) and _deviation(segment, own) > tolerance:
            return None
    whole = _half_turn(t0, v)
    if abs(whole - _half_turn(v, t1)) < EXACT_TURN:  # both arcs lie on one circle, or line
        return [_Segment(p, q, float(np.tan(whole / 2)) if abs(whole) > EXACT_TURN else 0.0)]
    return [one, two]


def _half_turn(first: FloatArray, second: FloatArray) -> float:
    """Angle from one direction to another: a chord turns from its tangent half as its arc does."""
    turn = first[0] * second[1] - first[1] * second[0]
    return float(np.arctan2(turn, first @ second))


def _arc(begin: FloatArray, end: FloatArray, tangent: FloatArray) -> _Segment | None:
    """The arc from a point in a direction to another point."""
    chord = end - begin
    half = _half_turn(tangent, chord)
    if 2 * abs(half) > LARGEST_TURN or not chord.any():
        return None
    return _Segment(begin, end, float(np.tan(half / 2)))


def _deviation(segment: _Segment, points: FloatArray) -> float:
    """Largest distance of points to a line or to an arc of half a turn at most."""
    chord = segment.end - segment.begin
    length = float(np.hypot(*chord))
    along, left = chord / length, np.array([-chord[1], chord[0]]) / length
    offset = points - 0.5 * (segment.begin + segment.end)
    b = segment.bulge
    if abs(b) < EXACT_TURN:
        distances = np.abs(offset @ left)
    else:
        radius = length * (1 + b * b) / (4 * abs(b))
        from_centre = offset - length * (1 - b * b) / (4 * b) * left
        distances = np.abs(np.hypot(from_centre[:, 0], from_centre[:, 1]) - radius)
    # Beyond an end, seen in the direction that the segment has there, the end is nearest.
    cosine, sine = (1 - b * b) / (1 + b * b), 2 * b / (1 + b * b)
    for end, outwards in (
        (segment.begin, -cosine * along + sine * left),
        (segment.end, cosine * along + sine * left),
    ):
        from_end = points - end
        beyond = from_end @ outwards > 0
        distances = np.where(beyond, np.hypot(from_end[:, 0], from_end[:, 1]), distances)
    return float(distances.max())
