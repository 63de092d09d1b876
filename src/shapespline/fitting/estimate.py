"""Estimation: the curve behind noisy points, when the caller gives neither tolerance nor size.

The thinnest curve in a band as wide as the noise is a bad estimate. So the outline is smoothed
first, run by run between its corners, by least squares whose sizes a criterion chooses (Mallows'
C_p); the pieces are then those that follow the smoothed outline within a few of its own standard
errors.
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import (
    LEAST_TURN,
    NOISE_BAND,
    NormalizedContour,
    neighbours_to_average,
    resolution,
)
from shapespline.engines.least_squares import (
    FINAL_LIMITS,
    PENALTY,
    STRAY_WEIGHT,
    averaged,
    cheapest,
    minimized,
    named_solver,
    noise_of,
    sizes_tried,
    smooth_start,
    start_of,
)
from shapespline.engines.pieces import (
    PIECE_DEGREE,
    drawn_with_lines,
    fit_observed,
    pinned_exactly,
)
from shapespline.errors import DegenerateContourError
from shapespline.fitting.goals import Estimate
from shapespline.fitting.means import Means
from shapespline.fitting.runs import KeptCorners, Runs
from shapespline.fitting.settings import DEFAULT_METHOD
from shapespline.fitting.strategies import measured_candidate, summed
from shapespline.fitting.verify import Candidate
from shapespline.geometry import joined, reversed_curve, turns_of, two_sided_distance
from shapespline.values import CORNER_TURN, Contour

if TYPE_CHECKING:
    from shapespline.analysis import Resolution
    from shapespline.engines.least_squares import Balanced, Minimized, Smoothed
    from shapespline.fitting.problem import Problem
    from shapespline.fitting.strategies import Proposals
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray
    from shapespline.values import Piece

# A smoothed outline is followed within one of these numbers of its standard errors (FIT-01).
STANDARD_ERRORS = (1.5, 2.0, 3.0)
# Pieces may cost at most this part of what one spline costs: with corners that are proven, which
# everybody sees, and without.
CHARACTER, NO_CORNERS = 1.02, 0.97
# What keeps regularities may cost so much more than one spline, whose size was chosen for these
# very points (DRA-16).
DRAWN_DEARER = 10.0
# If a point is farther than so many bands away, the estimate has missed something: a jump, a spike,
# a track too sparse to be smoothed (FIT-06).
FARTHEST = 1.5


class Evidence(NamedTuple):
    """What the points say of a curve.

    ``cost`` is the sum of squared distances over the variance, and the price of what the curve
    stores; ``farthest`` the largest distance of a point, or of pieces
    in either direction, data units; ``worth`` what its sharp corners may cost (`Runs`).
    """

    cost: float
    farthest: float
    n_stored_points: int
    n_proven_corners: int = 0
    worth: float = 0.0

    def preferred_to(self, smooth: Evidence) -> bool:
        """Whether pieces are better than one spline: no larger, and not too dear."""
        part = CHARACTER if self.n_proven_corners else NO_CORNERS
        most = part * smooth.cost + self.worth
        return self.cost <= most and self.n_stored_points <= smooth.n_stored_points

    @classmethod
    def of_spline(cls, start: Balanced, means: Means, contour: Contour) -> Evidence:
        """Of one spline."""
        found = two_sided_distance(start.spline, contour)
        size = start.spline.n_control_points
        return cls(means.misfit(start.spline) + PENALTY * size, found.max_distance, size)

    @classmethod
    def of_pieces(
        cls,
        pieces: tuple[Piece, ...],
        degree: int,
        means: Means,
        contour: Contour,
        n_proven: int,
    ) -> Evidence:
        """Of pieces; a corner that is not proven is one of n places, which costs log n more."""
        curve = joined(pieces, degree)
        found, misfit = two_sided_distance(curve, contour), means.misfit(curve)
        stored = sum(piece.n_stored for piece in pieces)
        stored += 0 if contour.closed else 1
        sharp = [abs(turn) > CORNER_TURN for turn in turns_of(pieces, closed=contour.closed)]
        price = PENALTY * stored + np.log(len(contour)) * max(0, sum(sharp) - n_proven)
        return cls(misfit + price, found.hausdorff_distance, stored, n_proven)


class Estimation:
    """What the points of a problem tell of the curve behind them, found once.

    ``ordered`` are the points in canonical order, data units; ``shown`` what they can show;
    ``width`` how many neighbours are averaged; ``precisions`` those of the points over that of
    most, where they are supposed not to be alike.
    """

    precisions: FloatArray | None
    _supposed: Estimation | None

    def __init__(self, problem: Problem, monitor: Monitor) -> None:
        contour = problem.contour
        self.normalized = NormalizedContour.of(contour)
        self.ordered = Contour.silently(
            contour.points[self.normalized.order], contour.closed, accuracy=contour.accuracy
        )
        self.shown: Resolution = resolution(self.ordered, of_picture=contour.level_line is not None)
        self._degree, self._monitor = problem.request.style.degree, monitor
        self._ends = problem.request.constraints.ends
        self.width, self.precisions, self._supposed = 1, None, None
        if not (self.shown.clean or problem.request.style.names_corners):
            points, closed = self.ordered.points, contour.closed
            self.width = neighbours_to_average(points, closed, self.shown.noise)

    def supposing(self, precisions: FloatArray | None) -> Estimation:
        """The same of points, in canonical order, with such precisions over that of most."""
        if precisions is None or self.width > 1:
            return self
        if self._supposed is None or self._supposed.precisions is not precisions:
            other = copy(self)
            for known in ("means", "_noise", "_tried", "start", "smooth"):
                other.__dict__.pop(known, None)
            other.precisions = precisions
            self._supposed = other
        return self._supposed

    @cached_property
    def means(self) -> Means:
        """Of the points, data units."""
        means = self.means_of(self.ordered, self.shown.noise)
        return means._replace(precisions=self.precisions)

    def means_of(self, contour: Contour, noise: float) -> Means:
        """Of the points in another unit."""
        return Means.of(contour, noise, self.width, self._ends)

    @cached_property
    def _noise(self) -> float:
        """That sizes are compared by."""
        contour, noise, _ = self.means
        return noise_of(contour, noise if self.width > 1 else None)

    @cached_property
    def _tried(self) -> list[Smoothed]:
        """Splines over all points, of several sizes."""
        contour = self.means.contour
        return sizes_tried(
            contour, self._degree, self._noise, self.precisions, monitor=self._monitor
        )

    @cached_property
    def start(self) -> Balanced:
        """One spline over all points, of the size that the criterion chooses."""
        return start_of(cheapest(self._tried), self.means.contour, self._degree)

    def told(self) -> tuple[Contour, Balanced]:
        """What one spline tells, and where its least squares start.

        The mean of what several sizes tell (FIT-33); the points, where one size alone counts.
        """
        contour = self.means.contour
        mean = averaged(self._tried, contour, self._degree, self._noise, monitor=self._monitor)
        if mean is None:
            return contour, self.start
        outline, start = mean
        if self._ends and not contour.closed:
            points = outline.points.copy()
            points[[0, -1]] = contour.points[[0, -1]]
            outline = Contour.silently(points, closed=False)
        return outline, start

    @cached_property
    def smooth(self) -> Evidence:
        """What the points say of it."""
        return Evidence.of_spline(self.start, self.means, self.ordered)

    def cost_of(self, pieces: tuple[Piece, ...], n_unknowns: int, *, told: bool) -> float | None:
        """What lines, arcs and smoothed runs cost; None if one spline tells the points better.

        Of their numbers they pay for those alone that regularities leave free.
        """
        # With regularities joints were drawn, but those that turn little are there by chance.
        # Without them every piece is one of three kinds, too, which costs log 3.
        joints, dearer = self._n_clear_corners(pieces), DRAWN_DEARER
        if not told:
            # No smooth outline is told by lines alone that meet in clear corners (DRA-60).
            are_lines = all(piece.kind == "line" for piece in pieces)
            joints *= are_lines and drawn_with_lines(pieces, self.ordered.closed)
            dearer = -float(np.log(3)) * len(pieces)
        said = Evidence.of_pieces(pieces, self._degree, self.means, self.ordered, joints)
        free = n_unknowns + (0 if self.ordered.closed else 2)
        cost = said.cost + PENALTY * (0.5 * free - said.n_stored_points)
        return cost if cost <= self.smooth.cost + dearer else None

    def _n_clear_corners(self, pieces: tuple[Piece, ...]) -> int:
        """Corners that turn as much as those of data do."""
        turns = turns_of(pieces, closed=self.ordered.closed)
        return sum(abs(turn) >= LEAST_TURN for turn in turns)

    def explains(self, evidence: Evidence) -> bool:
        """Whether a curve comes near all points."""
        return evidence.farthest <= FARTHEST * self.shown.band


@dataclass(frozen=True)
class ObservedPieces:
    """Lines, Beziers and small splines behind noisy points, where they tell as much as one spline.

    Corners that "auto" and "free" find stay only where the criterion prefers two runs to one.
    """

    estimation: Estimation

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve, if its price is justified and it explains the points."""
        smooth = self.estimation.smooth
        found = None if monitor.ended else self._found(problem, monitor)
        if found is None:
            return
        said, pieces = found
        one_run = len(pieces) == 1 and pieces[0].kind != "line"
        justified = said.preferred_to(smooth) and not one_run
        named = not isinstance(problem.request.style.corners, str | None)
        if (named or justified) and self.estimation.explains(said):
            yield Candidate(method="estimation", pieces=pieces)

    def _found(
        self, problem: Problem, monitor: Monitor
    ) -> tuple[Evidence, tuple[Piece, ...]] | None:
        """The cheapest pieces, data units, and what the points say of them.

        None where there is noise alone (what is left of it, smoothed, is a single point), or the
        monitor ended the search.
        """
        request, normalized = problem.request, self.estimation.normalized
        shown, degree = self.estimation.shown, request.style.degree
        means = self.estimation.means_of(normalized.contour, shown.noise * normalized.scale)
        work, noise, _ = means
        runs = Runs(work, min(degree, PIECE_DEGREE), noise, monitor)
        at, worth = self._corners(problem, runs)
        points, size = runs.joined(at)
        try:
            outline = Contour.silently(points, work.closed)
        except DegenerateContourError:
            return None
        observed = work.points[np.unique(outline.source, return_index=True)[1]]
        error = noise * float(np.sqrt(size / len(work)))
        found: list[tuple[Evidence, tuple[Piece, ...]]] = []
        for part in STANDARD_ERRORS:
            pieces = fit_observed(
                outline,
                observed,
                part * error,
                noise,
                corners=None if request.style.free else outline.source[at],
                degree=degree,
                effort=request.effort,
                monitor=monitor,
            )
            if not pieces or monitor.ended:
                return None
            if request.constraints.ends and not work.closed:
                pinned_exactly(pieces, work.points[[0, -1]])
            said = Evidence.of_pieces(pieces, degree, means, normalized.contour, len(at))
            farthest = said.farthest / normalized.scale
            found.append((said._replace(farthest=farthest, worth=worth), pieces))
        band = FARTHEST * NOISE_BAND * shown.noise
        said, pieces = min(found, key=lambda one: (one[0].farthest > band, one[0].cost))
        restored = normalized.restored(pieces)
        if request.constraints.ends and not work.closed:
            pinned_exactly(restored, problem.contour.points[[0, -1]])
        return said, restored

    def _corners(self, problem: Problem, runs: Runs) -> KeptCorners:
        """The corners that the data prove, or those that were named, in canonical order."""
        corners = problem.request.style.corners
        if isinstance(corners, str):
            return runs.kept_corners()
        named = np.asarray(() if corners is None else corners, dtype=np.int64)
        return KeptCorners(np.unique(self.estimation.normalized.new_index[named]), 0.0)


@dataclass(frozen=True)
class SmoothedSpline:
    """One least-squares spline behind noisy points, of the size that the criterion chooses."""

    estimation: Estimation

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve, if it explains the points."""
        if not self.estimation.explains(self.estimation.smooth):
            return
        ordered, normalized = self.estimation.ordered, self.estimation.normalized
        found = _finished(problem, *self.estimation.told(), None, monitor)
        spline, candidate = found.spline, _candidate(problem, found)
        distances = two_sided_distance(spline, ordered)
        parameters = distances.parameters[normalized.new_index]
        if normalized.reversed:
            spline, parameters = reversed_curve(spline), 1.0 - parameters
        found_distances = distances._replace(parameters=parameters)
        yield replace(candidate, spline=spline, distances=found_distances)


class WeightedSpline:
    """One least-squares spline of points that weigh differently, its size chosen likewise."""

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve."""
        contour, weights = problem.contour, summed(problem.request)
        start = smooth_start(contour, problem.request.style.degree, weights, monitor=monitor)
        yield _candidate(problem, _finished(problem, contour, start, weights, monitor))


class MeasuredSpline:
    """One spline of points with known errors, or of which a loss forgives some, its size chosen."""

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve."""
        request, contour = problem.request, problem.contour
        weights, error = request.measurement.spread
        start = smooth_start(
            contour,
            request.style.degree,
            weights,
            noise=error,
            loss=request.loss,
            monitor=monitor,
        )
        yield measured_candidate(problem, start, _method(problem), monitor)


def _finished(
    problem: Problem,
    contour: Contour,
    start: Balanced,
    weights: FloatArray | None,
    monitor: Monitor,
) -> Minimized:
    """Least squares to the end from a start whose size was chosen; free ends leave their noise."""
    ends = "fixed" if problem.request.constraints.ends else "fitted"
    return minimized(
        contour,
        start,
        named_solver(_method(problem))[0],
        weights=weights,
        ends=None if contour.closed else ends,
        stray_weight=STRAY_WEIGHT,
        limits=FINAL_LIMITS,
        callback=monitor.of_iterations,
        ask=monitor.ends,
    )


def _method(problem: Problem) -> str:
    goal = problem.request.goal
    return goal.method if isinstance(goal, Estimate) else DEFAULT_METHOD


def _candidate(problem: Problem, found: Minimized) -> Candidate:
    return Candidate(
        method=_method(problem), spline=found.spline, run=found.run, history=found.history
    )
