"""Pieces with one spline for each run where they turn and the data do not."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.pieces import drawn_straight
from shapespline.fitting.piece_runs import runs_of
from shapespline.fitting.smooth import as_piece, one_spline
from shapespline.fitting.strategies import SMOOTHED, OneSpline
from shapespline.fitting.verify import Candidate
from shapespline.geometry import chords_for_hooks, hooks, joined
from shapespline.validation import median
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.fitting.piece_runs import Run
    from shapespline.fitting.problem import Problem
    from shapespline.fitting.strategies import Ask, Proposals
    from shapespline.fitting.verify import Verified
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve, Piece

# A spline leaves a corner in the direction that pieces had, but for this part of the corner's turn
# and less than a corner: else it rounds it (PIE-30).
SAME_PART, SAME_TURN = 1 / 3, np.radians(25.0)
# So much of an outline must be in runs that are not rough (PIE-30).
EVEN_SHARE = 0.5
# What is longer than so many steps of a picture's points was drawn as a line (PIE-30).
LONG_CHORD = 3.0


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
        runs = runs_of(problem, self.found.fit.sections)
        even = [run for run in runs if not run.is_rough]
        # A few runs of rough data are even by chance. Pieces about a hook are fitted again, which
        # long ones do not bear.
        if (
            sum(len(run.points) for run in even) < EVEN_SHARE * len(problem.contour)
            or not any(run.n_turns for run in even)
            or _has_hooks(self.found.fit.spline, problem)
        ):
            return
        if runs[0].is_ring:
            if _any_straight(runs[0], problem):
                return
            yield from OneSpline(self.found.fit.n_stored_points).propose(problem, monitor)
            return
        pieces: list[Piece] = []
        for run in runs:
            turns = run.n_turns and not (run.is_rough or run.is_held)
            spline = self._instead(run, problem, monitor) if turns else None
            pieces += run.pieces if spline is None else [spline]
        if len(pieces) == len(self.found.fit.sections):
            return
        curve = joined(pieces, problem.request.style.degree)
        if not _has_hooks(curve, problem):
            yield Candidate(method="sections", rank=SMOOTHED, pieces=tuple(pieces), spline=curve)

    def _instead(self, run: Run, problem: Problem, monitor: Monitor) -> Piece | None:
        """One spline from end to end, if it costs at most a point for each turn that it spares."""
        if _any_straight(run, problem):
            return None
        found = one_spline(Contour.silently(run.points, False), problem, self.ask, monitor)
        if not (found.kept and found.fair) or _has_hooks(found.fit.spline, problem):
            return None
        spline = as_piece(found.fit.spline)
        points = spline.control_points
        arms = (points[1] - points[0], points[-2] - points[-1])
        stays = all(
            _angle(arm, was) <= min(SAME_PART * turn, SAME_TURN)
            for arm, was, turn in zip(arms, run.arms, run.end_turns, strict=True)
        )
        return spline if stays and spline.n_stored <= run.n_stored + run.n_turns else None


def _any_straight(run: Run, problem: Problem) -> bool:
    """Whether a piece of a run was drawn as a line; of a picture's points few are enough."""
    longest = np.inf
    if problem.contour.accuracy:
        longest = LONG_CHORD * median(np.hypot(*np.diff(run.points, axis=0).T))
    for piece in run.pieces:
        side = piece.control_points[-1] - piece.control_points[0]
        is_long = piece.degree == 1 and np.hypot(*side) > longest
        if is_long or drawn_straight(piece, problem.drawn, problem.tolerance):
            return True
    return False


def _angle(u: FloatArray, v: FloatArray) -> float:
    """Between two directions, radians."""
    (ux, uy), (vx, vy) = u.tolist(), v.tolist()
    return abs(atan2(ux * vy - uy * vx, ux * vx + uy * vy))


def _has_hooks(curve: BSplineCurve, problem: Problem) -> bool:
    """Whether a curve turns back where the data do not.

    Read in canonical direction: where a hook is in a turn depends on it.
    """
    way = -1 if problem.normalized.reversed else 1
    line, data = chords_for_hooks(curve, problem.tolerance)[::way], problem.contour
    return len(hooks(line, data.polyline[::way], problem.tolerance, closed=data.closed)) > 0
