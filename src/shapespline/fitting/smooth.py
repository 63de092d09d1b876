"""One spline with simple knots from corner to corner, so that curvature has no jumps.

For all runs of the data (smoothness=2), or for those alone where pieces turn and the data do not.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import atan2
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import LEAST_TURN, bends_evenly
from shapespline.engines.pieces import Constraints, drawn_straight
from shapespline.fitting.choose import ROUGH_PART
from shapespline.fitting.problem import Problem
from shapespline.fitting.strategies import PIECES, SMOOTHED, OneSpline
from shapespline.fitting.verify import Candidate
from shapespline.geometry import chords, hooks, joined, turn_between, two_sided_distance
from shapespline.validation import distinct
from shapespline.values import CORNER_TURN, BSplineCurve, Contour, Piece

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.fitting.strategies import Ask, Proposals
    from shapespline.fitting.verify import Verified
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray, IntArray


# A corner of pieces may be so many tolerances away from that of the data: over that length the data
# are told to turn (PIE-30).
REACH = 8.0
# A spline leaves a corner in the direction that pieces had, but for this part of the corner's turn
# and less than a corner: else it rounds it (PIE-30).
SAME_PART, SAME_TURN = 0.25, LEAST_TURN
# What turns by more is a corner even if the data tell none there (PIE-30).
MOST_NEEDLESS = np.radians(60.0)
# So much of an outline must be in runs that are not rough.
EVEN_SHARE = 0.5
# Hooks are looked for by chords within this part of the tolerance.
SAMPLING_PART = 0.02


@dataclass(frozen=True)
class SmoothRuns:
    """A line or a spline with simple knots for each run of the data between two corners."""

    ask: Ask

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve; without corners one spline."""
        contour, corners = problem.contour, _corners(problem)
        if not len(corners):
            yield from OneSpline().propose(problem, monitor)
            return
        # A closed outline begins in the same corner whatever the order of the data.
        row = _row(contour, int(corners[0]))
        if contour.closed:
            corners = (corners - corners[0]) % len(contour)
        cuts = distinct(np.array([0, len(row) - 1]), corners).tolist()
        runs = [Contour.trusted(row[a : b + 1], False, contour.accuracy) for a, b in pairwise(cuts)]
        pieces = [self._piece(run, problem, monitor) for run in runs]
        for before, after in pairwise(pieces):  # up to rounding they are
            after.control_points[0] = before.control_points[-1]
        yield Candidate(method="removal", rank=PIECES, pieces=tuple(pieces))

    def _piece(self, run: Contour, problem: Problem, monitor: Monitor) -> Piece:
        """What goes through one run."""
        ends = run.points[[0, -1]]
        line = BSplineCurve(np.array([0.0, 0.0, 1.0, 1.0]), ends, 1)
        if two_sided_distance(line, run).hausdorff_distance <= problem.tolerance:
            return Piece("line", 1, line.knots, ends.copy())
        return _as_piece(_one_spline(run, problem, self.ask, monitor).fit.spline)


@dataclass(frozen=True)
class SmoothInstead:
    """Pieces that keep the tolerance, with one spline for each run where they turn needlessly.

    Data that are sparse for the tolerance make pieces alternate between lines and parabolas, with
    corners where the data have none; one spline follows them without, and mostly with fewer points
    (PIE-30).
    """

    found: Verified
    ask: Ask

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve, if a run became smooth."""
        if len(problem.request.constraints.through):
            return
        between = _BetweenCorners.of(problem, self.found.fit.sections)
        if not between.cuts:
            yield from self._whole(between, problem, monitor)
            return
        pieces: list[Piece] = []
        runs = list(between.runs(problem.request.constraints))
        smooth = [run for run in runs if not run.is_rough]
        # A few runs of rough data are even by chance. Pieces about a hook are fitted again, which
        # long ones do not bear.
        if (
            sum(len(run.points) for run in smooth) < EVEN_SHARE * len(between.row)
            or not any(run.n_turns for run in smooth)
            or _has_hooks(self.found.fit.spline, problem)
        ):
            return
        for run in runs:
            turns = run.n_turns and not run.is_rough
            spline = self._instead(run, problem, monitor) if turns else None
            pieces += run.pieces if spline is None else [spline]
        if len(pieces) == len(between.pieces):
            return
        curve = joined(pieces, problem.request.style.degree)
        if not _has_hooks(curve, problem):
            yield Candidate(method="sections", rank=SMOOTHED, pieces=tuple(pieces), spline=curve)

    def _whole(self, between: _BetweenCorners, problem: Problem, monitor: Monitor) -> Proposals:
        """One spline of a closed outline whose corners pieces gave up."""
        if between.turns and not _any_straight(between.pieces, problem):
            yield from OneSpline(self.found.fit.n_stored_points).propose(problem, monitor)

    def _instead(self, run: _Run, problem: Problem, monitor: Monitor) -> Piece | None:
        """One spline from end to end, if it costs at most a point for each turn that it spares."""
        first, last = run.pieces[0], run.pieces[-1]
        if run.is_held or _any_straight(run.pieces, problem):
            return None
        points = run.points.copy()
        points[0], points[-1] = first.control_points[0], last.control_points[-1]
        found = _one_spline(Contour.silently(points, False), problem, self.ask, monitor)
        if not (found.kept and found.fair) or _has_hooks(found.fit.spline, problem):
            return None
        spline = _as_piece(found.fit.spline)
        begin, end = slice(2), slice(-2, None)
        off = (
            _angle(first.control_points[begin], spline.control_points[begin]),
            _angle(last.control_points[end], spline.control_points[end]),
        )
        stays = all(
            angle <= min(SAME_PART * turn, SAME_TURN)
            for angle, turn in zip(off, run.end_turns, strict=True)
        )
        return spline if stays and spline.n_stored <= run.n_stored + run.n_turns else None


class _Run(NamedTuple):
    """Pieces between two cuts, the data there, and how many joints inside turn like corners.

    ``end_turns`` are the turns of the corners at both ends, radians, pi where the outline ends;
    ``is_held`` tells whether a tangent at an end is kept.
    """

    pieces: tuple[Piece, ...]
    points: FloatArray
    n_turns: int
    end_turns: tuple[float, float]
    is_held: bool

    @property
    def n_stored(self) -> int:
        """Points that the pieces store."""
        return sum(piece.n_stored for piece in self.pieces)

    @property
    def is_rough(self) -> bool:
        """Whether so many stored points follow data that no smooth curve follows with few."""
        few = self.n_stored <= ROUGH_PART * len(self.points)
        return not (few or bends_evenly(self.points))


class _Cut(NamedTuple):
    """Where pieces and data are at a corner: the piece and the point that begin there."""

    piece: int
    point: int


class _BetweenCorners(NamedTuple):
    """Pieces and data in a row, cut where both have a corner and at the ends.

    ``turns`` are those of pieces that begin with a corner, whether the data have one or not,
    radians. A closed outline's row begins and ends in the same corner, whatever the order of the
    data; without one it has no cuts.
    """

    pieces: tuple[Piece, ...]
    row: FloatArray
    cuts: list[_Cut]
    turns: dict[int, float]

    @classmethod
    def of(cls, problem: Problem, pieces: tuple[Piece, ...]) -> _BetweenCorners:
        """Of pieces of the whole outline."""
        contour, n = problem.contour, len(pieces)
        joints = range(0 if contour.closed else 1, n)
        every = {k: abs(turn_between(pieces[k - 1], pieces[k])) for k in joints}
        turns = {k: turn for k, turn in every.items() if turn > CORNER_TURN}
        cuts = _common(problem, pieces, turns)
        if contour.closed:
            if not cuts:
                return cls(pieces, contour.points, [], turns)
            first = cuts[0]
            pieces = (*pieces[first.piece :], *pieces[: first.piece])
            turns = {(k - first.piece) % n: turn for k, turn in turns.items()}
            cuts = [
                _Cut((cut.piece - first.piece) % n, (cut.point - first.point) % len(contour))
                for cut in cuts
            ]
            row = _row(contour, first.point)
        else:
            row = contour.points
            cuts.append(_Cut(0, 0))
        cuts = [*sorted(cuts), _Cut(n, len(row) - 1)]
        # Where both come in another order no corner is sure.
        if any(after.point <= before.point for before, after in pairwise(cuts)):
            cuts, turns = [], {}
        return cls(pieces, row, cuts, turns)

    def runs(self, constraints: Constraints) -> Iterator[_Run]:
        """From cut to cut."""
        for begin, end in pairwise(self.cuts):
            ends = (begin == self.cuts[0], end == self.cuts[-1])
            turns = [self.turns.get(cut.piece % len(self.pieces), np.pi) for cut in (begin, end)]
            yield _Run(
                self.pieces[begin.piece : end.piece],
                self.row[begin.point : end.point + 1],
                sum(begin.piece < k < end.piece for k in self.turns),
                (turns[0], turns[1]),
                any(at and t is not None for at, t in zip(ends, constraints.tangents, strict=True)),
            )


def _any_straight(pieces: Sequence[Piece], problem: Problem) -> bool:
    """Whether one of some pieces was drawn as a line."""
    return any(drawn_straight(piece, problem.drawn, problem.tolerance) for piece in pieces)


def _common(problem: Problem, pieces: Sequence[Piece], turns: dict[int, float]) -> list[_Cut]:
    """Corners of both, nearest to each other, and sharp ones of pieces; in canonical order."""
    if not turns:
        return []
    corners, points = _corners(problem), problem.contour.points
    starts = np.array([pieces[k].control_points[0] for k in turns])
    found = dict.fromkeys(turns, -1)
    if len(corners):
        away = starts - points[corners][:, None]
        far = np.hypot(away[..., 0], away[..., 1])
        for i, k in enumerate(far.argmin(axis=1).tolist()):
            if far[i, k] <= REACH * problem.tolerance and far[:, k].argmin() == i:
                found[list(turns)[k]] = int(corners[i])
    for start, (k, turn) in zip(starts, turns.items(), strict=True):
        if found[k] < 0 and turn > MOST_NEEDLESS:
            found[k] = int(((points - start) ** 2).sum(axis=1).argmin())
    place = problem.normalized.new_index
    cuts = [_Cut(k, point) for k, point in found.items() if point >= 0]
    return sorted(cuts, key=lambda cut: int(place[cut.point]))


def _corners(problem: Problem) -> IntArray:
    """Corners of the data by their indices, in canonical order."""
    return problem.normalized.order[problem.pieces.corners]


def _row(contour: Contour, first: int) -> FloatArray:
    """The points in a row; those of a closed contour from one of them round to it again."""
    if not contour.closed:
        return contour.points
    return contour.points[(first + np.arange(len(contour) + 1)) % len(contour)]


def _one_spline(run: Contour, problem: Problem, ask: Ask, monitor: Monitor) -> Verified:
    """The smallest spline from end to end of a run."""
    request = problem.request
    asked = replace(
        request,
        contour=run,
        style=replace(request.style, form="spline", corners=None, smoothness=1),
        constraints=Constraints(ends=True),
        weights=None,
        is_part=True,
    )
    return ask(Problem(asked), monitor)


def _angle(leg: FloatArray, other: FloatArray) -> float:
    """Between the ways from one point to another, radians."""
    (ux, uy), (vx, vy) = (leg[1] - leg[0]).tolist(), (other[1] - other[0]).tolist()
    return abs(atan2(ux * vy - uy * vx, ux * vx + uy * vy))


def _has_hooks(curve: BSplineCurve, problem: Problem) -> bool:
    """Whether a curve turns back where the data do not."""
    line, polyline = chords(curve, SAMPLING_PART * problem.tolerance)[0], problem.contour.polyline
    return len(hooks(line, polyline, problem.tolerance)) > 0


def _as_piece(spline: BSplineCurve) -> Piece:
    kind = "bezier" if len(spline.control_points) == spline.degree + 1 else "spline"
    return Piece(kind, spline.degree, spline.knots, spline.control_points.copy())
