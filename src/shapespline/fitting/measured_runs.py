"""Free-form runs of measured points beside lines and arcs: where they meet; noise smoothed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import LEAST_TURN, NOISE_BAND
from shapespline.engines.drawn import DrawnArc, DrawnLine, FreeRun
from shapespline.fitting.runs import Runs, crossing_of
from shapespline.geometry import distance_from_chords
from shapespline.validation import median
from shapespline.values import FULL_TURN, Arc, Contour

if TYPE_CHECKING:
    from shapespline.engines.drawn import Drawn
    from shapespline.fitting.runs import Crossing
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray
    from shapespline.values import Piece

# A corner is moved by no more than so many steps and the band of the noise to where a run and the
# element beside it cross if continued, a step or that band from one of so many points (FIT-38).
STEPS, NEAREST = 1.5, 4
# Within a tolerance a corner lies no farther than that part of it from the chords (FIT-40).
KEPT = 0.9
# Points that turn by more each are stairs or corners, which tell of no curve (FIT-40).
MOST_BEND = np.radians(15.0)
# A corner nearer to a point than that part of a step is that point (FIT-40).
BETWEEN = 0.02
# So many points at an end of a run may be the element's beside it (FIT-38).
UNCERTAIN = 1
# Regularities of a whole outline, which corners that move one by one would break (FIT-38).
WHOLE = ("mirror", "rotation")


@dataclass(frozen=True)
class MeasuredRuns:
    """What smooths them: the degree, the noise of the points, in their unit.

    ``clean`` points tell by themselves where a run goes on; corners are ``within`` that distance
    from the chords.
    """

    degree: int
    noise: float
    monitor: Monitor
    clean: bool = False
    within: float = np.inf

    def meeting(self, drawn: Drawn, *, closed: bool) -> Drawn:
        """The same with corners where runs and elements cross if both are continued.

        Where the data of an element end is known to a step only, and the run that begins there
        would turn with it.
        """
        if any(one.name in WHOLE for one in drawn.regularities):
            return drawn
        parts, n = list(drawn.parts), len(drawn.parts)
        for k, run in enumerate(drawn.parts):
            if not isinstance(run, FreeRun):
                continue
            points = run.points
            for end, m in ((0, k - 1), (-1, k + 1)):
                other = parts[m % n] if closed or 0 <= m < n else run
                if run.tangents[end] is not None or isinstance(other, FreeRun):
                    continue
                crossing = self._crossing(run.points, end, other)
                moved = crossing and _ending_in(other, crossing.point, -1 - end)
                if crossing is not None and moved is not None:
                    points = _ending_there(points, end, crossing)
                    parts[m % n] = moved
            parts[k] = replace(run, points=self._with_corners(points) if self.clean else points)
        return replace(drawn, parts=tuple(parts))

    def _with_corners(self, points: FloatArray) -> FloatArray:
        """A run of clean points with its corners that lie between two of them (FIT-40)."""
        turns = _turns(points)
        # The chord across one turns at both of its ends.
        places = 1 + np.flatnonzero(np.abs(turns[:-1] + turns[1:]) >= LEAST_TURN)
        found = [(k + 1, self._corner_after(points, k)) for k in places.tolist()]
        corners = [(at, corner) for at, corner in found if corner is not None]
        if not corners:
            return points
        return np.insert(points, [at for at, _ in corners], [one for _, one in corners], axis=0)

    def _corner_after(self, points: FloatArray, k: int) -> FloatArray | None:
        """Where the run up to a point and from the next one on cross if continued."""
        if not 3 <= k <= len(points) - 5:
            return None
        before, after = points[k - 3 : k + 1], points[k + 1 : k + 5]
        if not (_bends_little(before) and _bends_little(after)):
            return None
        crossing = crossing_of(_through(before, -1), _through(after, 0))
        if crossing is None or crossing.turn < LEAST_TURN:
            return None
        point, chord = crossing.point, points[k : k + 2]
        ahead = (point - chord[0]) @ crossing.before, (chord[1] - point) @ crossing.after
        step = float(np.hypot(*(chord[1] - chord[0])))
        if min(ahead) < BETWEEN * step or max(ahead) > STEPS * step:
            return None
        return point if distance_from_chords(point, chord) <= KEPT * self.within else None

    def smoothed(self, run: FreeRun) -> tuple[Piece, ...]:
        """Lines and splines of a run, from its first point to its last one, along its tangents."""
        pieces = self._runs(run.points).fitted()
        begin, end = run.tangents
        if begin is not None and pieces[0].degree > 1:
            _lead(pieces[0].control_points[:2], begin)
        if end is not None and pieces[-1].degree > 1:
            _lead(pieces[-1].control_points[:-3:-1], -end)
        return pieces

    def _runs(self, points: FloatArray) -> Runs:
        return Runs(Contour.silently(points, closed=False), self.degree, self.noise, self.monitor)

    def _crossing(
        self, points: FloatArray, end: int, element: DrawnLine | DrawnArc
    ) -> Crossing | None:
        """Where a run and the element before (0) or behind it (-1) meet if that is near."""
        node = points[end]
        if len(points) < 2 * (UNCERTAIN + self.degree + 1):
            return None
        if isinstance(element, DrawnLine) and (element.begin == element.end).all():
            return None
        step, band = median(np.hypot(*np.diff(points, axis=0).T)), NOISE_BAND * self.noise
        reach = STEPS * step + band
        inner = points[UNCERTAIN:-UNCERTAIN]
        if self.clean and not _bends_little(inner[:4] if end == 0 else inner[-4:]):
            return None
        continued = _through(inner, end) if self.clean else self._runs(inner).continued(end)
        crossing = crossing_of(continued, _expanded(element, node, reach))
        if crossing is None or crossing.turn < LEAST_TURN:
            return None
        met = _onto(element, node, crossing.point)
        near = points[:NEAREST] if end == 0 else points[-NEAREST:]
        far = float(np.hypot(*(near - met).T).min())
        if np.hypot(*(met - node)) > reach or far > max(step, band):
            return None
        if distance_from_chords(met, near) > KEPT * self.within:
            return None
        return crossing._replace(point=met)


def _turns(points: FloatArray) -> FloatArray:
    """By how much a row turns in each of its inner points, radians."""
    (x, y), (u, v) = np.diff(points[:-1], axis=0).T, np.diff(points[1:], axis=0).T
    return np.arctan2(x * v - y * u, x * u + y * v)


def _bends_little(points: FloatArray) -> bool:
    """Whether a cubic through some points tells where their curve goes on: no corner is in them."""
    return bool(np.abs(_turns(points)).max() <= MOST_BEND)


def _through(points: FloatArray, end: int) -> FloatArray:
    """Coefficients of the cubic through the first (0) or last (-1) four points, by their number."""
    row = points[:4] if end == 0 else points[-4:]
    return np.polynomial.polynomial.polyfit(np.arange(4.0) + min(3 * end, 0), row, 3)


def _ending_there(points: FloatArray, end: int, crossing: Crossing) -> FloatArray:
    """A run that begins (0) or ends (-1) in a crossing, without the element's points beside it."""
    row = points if end == 0 else points[::-1]
    inwards = crossing.before if end == 0 else -crossing.before
    near = row[1 : 1 + 2 * UNCERTAIN]
    kept = np.concatenate(
        [row[:1], near[(near - crossing.point) @ inwards > 0.0], row[1 + 2 * UNCERTAIN :]]
    )
    kept[0] = crossing.point
    return kept if end == 0 else kept[::-1]


def _expanded(element: DrawnLine | DrawnArc, node: FloatArray, unit: float) -> FloatArray:
    """Coefficients of an element about one of its points, by powers of the length in some unit."""
    if isinstance(element, DrawnLine):
        return np.stack([node, unit * _direction(element)])
    away = node - np.array(element.arc.centre)
    x, y = away / np.hypot(*away)
    bend = -0.5 * unit**2 / element.arc.radius * np.array([x, y])
    return np.stack([node, unit * np.array([-y, x]), bend])


def _direction(line: DrawnLine) -> FloatArray:
    along = line.end - line.begin
    return along / np.hypot(*along)


def _onto(element: DrawnLine | DrawnArc, node: FloatArray, point: FloatArray) -> FloatArray:
    """The point of an element nearest to one; a level edge stays level to the bit."""
    if isinstance(element, DrawnLine):
        along = _direction(element)
        nearest = node + ((point - node) @ along) * along
        return np.where(element.begin == element.end, node, nearest)
    centre = np.array(element.arc.centre)
    away = point - centre
    return centre + element.arc.radius * away / np.hypot(*away)


def _ending_in(
    element: DrawnLine | DrawnArc, node: FloatArray, end: int
) -> DrawnLine | DrawnArc | None:
    """An element with another first (0) or last (-1) point; None if nothing is left of it."""
    begin, last = (node, element.end) if end == 0 else (element.begin, node)
    if isinstance(element, DrawnLine):
        return DrawnLine(begin, last) if (last - begin) @ _direction(element) > 0.0 else None
    arc, old = element.arc, element.begin if end == 0 else element.end
    (ux, uy), (vx, vy) = old - np.array(arc.centre), node - np.array(arc.centre)
    turn = float(np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy))
    sweep = arc.sweep - turn if end == 0 else arc.sweep + turn
    if sweep * arc.sweep <= 0.0 or abs(sweep) >= FULL_TURN:
        return None
    start = arc.start_angle + turn if end == 0 else arc.start_angle
    return DrawnArc(Arc(arc.centre, arc.radius, start, sweep), begin, last)


def _lead(ends: FloatArray, direction: FloatArray) -> None:
    """Moves the second of two control points to where it is nearest along a direction."""
    along = float((ends[1] - ends[0]) @ direction)
    if along > 0.0:
        ends[1] = ends[0] + along * direction
