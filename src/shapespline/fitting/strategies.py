"""Strategies within a tolerance and of a given size: each asks one engine for candidates.

A strategy is anything with `propose`: a generator of candidates that is sent each one verified.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Protocol, TypeAlias

from shapespline.engines.least_squares import (
    FAR,
    FINAL_LIMITS,
    STARTS,
    STRAY_WEIGHT,
    RunArguments,
    measured,
    minimized,
    named_solver,
    smooth_start,
    standardized,
    start_of_some,
    summed_weights,
)
from shapespline.engines.pieces import (
    TOLERANCE_FACTORS,
    MirroredHalf,
    drawn_with_lines,
    in_data,
    n_points_of,
    search_lines,
    search_pieces,
    through_all,
    with_ends_turned,
)
from shapespline.engines.spline import attempts
from shapespline.fitting.goals import OfSize, Style, Within
from shapespline.fitting.problem import Problem
from shapespline.fitting.request import Request
from shapespline.fitting.verify import Candidate, Verified

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

    from shapespline.engines.least_squares import Start
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray
    from shapespline.values import Contour, Piece

    Proposals: TypeAlias = Generator[Candidate, Verified, None]
    # Answers a sub-request by the same plan and order of preference.
    Ask: TypeAlias = Callable[[Problem, Monitor], Verified]

# The simpler structure has the smaller rank; see `choose`.
ONE_SPLINE, MIRRORED, SMOOTHED, PIECES, LINES, EVERY_POINT = range(6)
# A turn into a tangent is so many times as long as what is left of the tolerance: its first
# control point moves by up to two thirds of its length, the curve by 4/9 of that (PIE-24).
TURN_PART = 2.0


class Strategy(Protocol):
    """A way to a curve."""

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """Candidates, one after another, until one is good enough or no more can be done."""


class OneSpline:
    """The smallest single spline (knot removal), if it may have fewer points than what is known."""

    def __init__(self, fewer_than: float = inf) -> None:
        self._fewer_than = fewer_than

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """Curves of tighter and tighter searches, then of other starts."""
        request = problem.request
        tried = attempts(
            problem.contour,
            problem.normalized,
            problem.tolerance,
            degree=request.style.degree,
            effort=request.effort,
            monitor=monitor,
            fewer_than=self._fewer_than,
        )
        with suppress(StopIteration):
            attempt = next(tried)
            while True:
                verified = yield Candidate(
                    method="removal",
                    rank=ONE_SPLINE,
                    spline=attempt.curve,
                    fairness=attempt.fairness,
                )
                attempt = tried.send(verified.kept)


@dataclass(frozen=True)
class Pieces:
    """Lines, Beziers and small splines (shortest path, then moves).

    ``factors`` are the parts of the tolerance that searches aim at.
    """

    factors: tuple[float, ...] = TOLERANCE_FACTORS

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """Curves of one search after another, until one keeps the tolerance."""
        request = problem.request
        for factor in self.factors:
            found = search_pieces(
                problem.thinned,
                factor,
                degree=request.style.degree,
                effort=request.effort,
                free=request.style.free,
                monitor=monitor,
            )
            if found:
                verified = yield _of_pieces(problem, found, PIECES)
                if verified.meets(request):
                    return
            if monitor.ended:
                return


@dataclass(frozen=True)
class Lines:
    """Lines alone: what curves cannot follow lines do.

    ``needed`` tells that curves do not follow the data with few points; else lines are proposed
    only if they were drawn: fewer than ``fewer_than`` points, and corners everywhere.
    """

    needed: bool
    fewer_than: float

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """Curves of one search after another, until one keeps the tolerance."""
        closed = problem.contour.closed
        for factor in TOLERANCE_FACTORS:
            lines = search_lines(problem.thinned, factor)
            if not lines:  # a way back to its first point, all within the tolerance of it
                return
            drawn = n_points_of(lines) + (not closed) < self.fewer_than
            if not (self.needed or (drawn and drawn_with_lines(lines, closed))):
                return
            verified = yield _of_pieces(problem, lines, LINES)
            if verified.kept:
                return


class ThroughAll:
    """A line from each point to the next, which keeps every tolerance."""

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve."""
        yield _of_pieces(problem, through_all(problem.normalized.contour), EVERY_POINT)


@dataclass(frozen=True)
class TurnedEnds:
    """Curves that keep the tolerance but miss a tangent, turned into it at their ends."""

    missing: tuple[Verified, ...]

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve for each, with as long a turn as the rest of the tolerance allows."""
        request = problem.request
        for verified in self.missing:
            left = problem.tolerance - verified.fit.hausdorff_distance
            pieces = with_ends_turned(
                verified.candidate.pieces,
                request.constraints.tangents,
                TURN_PART * left,
                request.style.degree,
            )
            yield Candidate(method="sections", rank=verified.candidate.rank, pieces=pieces)


@dataclass(frozen=True)
class MirroredPieces:
    """One half of a symmetric outline in pieces, the other one its mirror image."""

    ask: Ask

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve that keeps the tolerance, or none."""
        request = problem.request
        half = MirroredHalf.of(problem.thinned)
        if half is None:
            return
        asked = Request(
            contour=half.contour,
            goal=Within(half.tolerance),
            style=Style(request.style.degree, "pieces", half.corners),
            constraints=half.constraints,
            effort=request.effort,
            pieces_only=True,
        )
        found = self.ask(Problem(asked), monitor)
        if found.kept and not found.tangent_error:
            yield _of_pieces(problem, half.whole(found.fit.sections), MIRRORED)


def _of_pieces(problem: Problem, pieces: tuple[Piece, ...], rank: int) -> Candidate:
    """A candidate in the unit and direction of the data."""
    constraints = problem.request.constraints
    found = in_data(problem.pieces, pieces, problem.contour, constraints)
    return Candidate(method="sections", rank=rank, pieces=found)


class LeastSquares:
    """One spline of a given size: control points and parameters together."""

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve."""
        request = problem.request
        goal, contour = request.goal, problem.contour
        if not isinstance(goal, OfSize):
            return
        if request.is_measured:
            yield measured_candidate(
                problem, _measured_start(problem, goal, monitor), goal.method, monitor
            )
            return
        weights = summed(request)
        start = STARTS[goal.knots](contour, goal.n_control_points, request.style.degree, weights)
        solver, name = named_solver(goal.method)
        found = minimized(
            contour,
            start,
            solver,
            weights=weights,
            stray_weight=STRAY_WEIGHT,
            limits=FINAL_LIMITS,
            callback=monitor.of_iterations,
            ask=monitor.ends,
        )
        yield Candidate(method=name, spline=found.spline, run=found.run, history=found.history)


def _measured_start(problem: Problem, goal: OfSize, monitor: Monitor) -> Start:
    """The start that a size names, for points with errors."""
    request = problem.request
    weights, error = request.measurement.spread

    def make(points: Contour, weights: FloatArray | None) -> Start:
        count = min(goal.n_control_points, len(points))
        return STARTS[goal.knots](points, count, request.style.degree, weights)

    if request.loss is None:
        return make(problem.contour, weights)
    # The size that the points ask for tells whom to trust: a larger one bends to outliers.
    seen = smooth_start(
        problem.contour,
        request.style.degree,
        weights,
        noise=error,
        loss=request.loss,
        monitor=monitor,
    )
    kept = standardized(problem.contour, seen, weights, error) <= FAR
    return start_of_some(problem.contour, make, weights, kept)


def measured_candidate(problem: Problem, start: Start, method: str, monitor: Monitor) -> Candidate:
    """Least squares of points with errors from a start; their ends are no places to pass through.

    Nothing else holds the curve, so that its covariance is that of the points alone.
    """
    contour, request = problem.contour, problem.request
    ends = "fixed" if request.constraints.ends else "fitted"
    solver, name = named_solver(method)
    arguments = RunArguments(
        ends=None if contour.closed else ends,
        limits=FINAL_LIMITS,
        callback=monitor.of_iterations,
    )
    found, uncertainty = measured(
        contour, start, solver, request.measurement, arguments, monitor.ends
    )
    return Candidate(
        method=name,
        spline=found.spline,
        run=found.run,
        history=found.history,
        uncertainty=uncertainty,
    )


def summed(request: Request) -> FloatArray | None:
    """The weights of a request, one for each point of its contour."""
    return None if request.weights is None else summed_weights(request.weights, request.contour)
