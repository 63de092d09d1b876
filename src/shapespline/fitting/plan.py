"""The plan: which strategies are asked for a request, and in which order.

A generator that looks at the shortlist before it names the next strategy, so that none is asked
whose curve would not be taken.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from shapespline.analysis import bends_evenly_but_in_corners
from shapespline.engines.pieces import (
    TOLERANCE_FACTORS,
    drawn_straight,
    in_facets,
)
from shapespline.fitting.arcs import LinesAndArcs
from shapespline.fitting.choose import DRAWN, ROUGH_PART
from shapespline.fitting.drawn import DrawnPieces
from shapespline.fitting.estimate import (
    Estimation,
    MeasuredSpline,
    ObservedPieces,
    SmoothedSpline,
    WeightedSpline,
)
from shapespline.fitting.goals import Estimate, OfSize
from shapespline.fitting.in_band import InBand
from shapespline.fitting.smooth import SmoothRuns
from shapespline.fitting.smooth_instead import SmoothInstead
from shapespline.fitting.strategies import (
    EVERY_POINT,
    LINES,
    MIRRORED,
    ONE_SPLINE,
    PIECES,
    SMOOTHED,
    LeastSquares,
    Lines,
    MirroredPieces,
    OneSpline,
    Pieces,
    ThroughAll,
    TurnedEnds,
)
from shapespline.fitting.whole_chain import WholeChain

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.fitting.choose import Shortlist
    from shapespline.fitting.problem import Problem
    from shapespline.fitting.strategies import Ask, Strategy
    from shapespline.fitting.verify import Verified
    from shapespline.monitor import Monitor

# Where a polyline found in one pass takes more than this part of so many points and more, and these
# do not bend evenly between corners, no pieces have fewer points than lines (FIT-35).
NO_CURVE_PART, NO_CURVE_POINTS = 0.5, 100
# Lines are looked at beyond this part of the vertices of a polyline found in one pass, which has
# more of them than it needs (PIE-20).
CHORDS_PART = 0.7


def plan(problem: Problem, shortlist: Shortlist, monitor: Monitor, ask: Ask) -> Iterator[Strategy]:
    """Strategies for a request, the next one named after the last one was verified."""
    goal = problem.request.goal
    if isinstance(goal, OfSize):
        yield LeastSquares()
    elif isinstance(goal, Estimate):
        yield from _plan_estimate(problem, shortlist, monitor, ask)
    else:
        yield from _plan_within(problem, shortlist, ask)


def _plan_estimate(
    problem: Problem, shortlist: Shortlist, monitor: Monitor, ask: Ask
) -> Iterator[Strategy]:
    """The curve behind noisy points, in pieces where they tell of these; clean ones in a band."""
    if problem.request.is_measured:
        yield MeasuredSpline()
        return
    if problem.request.weights is not None:
        yield WeightedSpline()
        return
    yield WholeChain(ask)
    if len(shortlist):
        return
    estimation = Estimation(problem, monitor)
    if problem.request.style.character == "drawn":
        yield DrawnPieces(ask, estimation)
        if shortlist.among(DRAWN):
            return
    n_drawn = len(shortlist)
    if not estimation.shown.clean:
        if problem.request.style.form == "pieces":
            yield ObservedPieces(estimation)
        if len(shortlist) == n_drawn:
            yield SmoothedSpline(estimation)
    # Points that neither comes near are no noisy curve after all.
    if len(shortlist) == n_drawn:
        yield InBand(estimation, ask)


def _plan_within(problem: Problem, shortlist: Shortlist, ask: Ask) -> Iterator[Strategy]:
    """A curve within a tolerance, of the form that was asked for."""
    request = problem.request
    if request.style.form == "spline":
        yield OneSpline()
        return
    if request.style.form == "arcs":
        yield LinesAndArcs(ask)
        return
    if request.style.smoothness == 2:
        yield SmoothRuns(ask)
        return
    if request.pieces_only:
        yield from plan_pieces(problem, shortlist, ask)
        return
    if request.style.character == "drawn":
        yield DrawnPieces(ask)
        drawn = shortlist.among(DRAWN)
        if drawn is not None and drawn.kept:
            return
    if request.is_plain and problem.looks_smooth:
        yield OneSpline(ROUGH_PART * len(problem.contour))
        one = shortlist.among(ONE_SPLINE)
        if one is not None and shortlist.follows(one) and not one.waves:
            return
    if not (request.style.free or request.constraints.anything) and (
        request.symmetric or request.effort != "fast"
    ):
        if problem.contour.closed:
            yield MirroredPieces(ask)
        if request.symmetric and shortlist.among(MIRRORED):
            return
    yield from plan_pieces(problem, shortlist, ask)
    in_pieces = shortlist.among(MIRRORED, PIECES, LINES, EVERY_POINT)
    if shortlist.among(ONE_SPLINE) or in_pieces is None:
        return
    if _one_spline_may_be_better(problem, in_pieces):
        best = shortlist.best
        most = best.fit.n_stored_points if best.kept else inf
        # One without corners may be preferred to one with more runs.
        spares = len(best.fit.corners) if best.candidate.rank == SMOOTHED else 0
        yield OneSpline(most + spares)


def plan_pieces(problem: Problem, shortlist: Shortlist, ask: Ask) -> Iterator[Strategy]:
    """Pieces alone: curves, lines where they are fewer, at last a line for every point."""
    request, rough = problem.request, ROUGH_PART * len(problem.contour)
    # Where the caller knows the corners lines would make others.
    may_be_lines = not request.style.names_corners
    if may_be_lines and _follows_no_curve(problem):
        yield Lines(needed=True, fewer_than=inf)
        lines = shortlist.among(LINES)
        if lines is not None and lines.kept:
            return
    yield Pieces(TOLERANCE_FACTORS[:1])
    found = shortlist.among(PIECES)
    if found is None or not found.meets(request):
        # Closer to rough data curves have more points, not fewer, and lines take over (FIT-22).
        is_rough = found is not None and found.fit.n_stored_points > rough
        if is_rough and may_be_lines and request.is_plain:
            yield Lines(needed=True, fewer_than=inf)
            lines = shortlist.among(LINES)
            if lines is not None and lines.kept:
                return
        yield Pieces(TOLERANCE_FACTORS[1:])
        found = shortlist.among(PIECES)
    if found is not None and found.kept and not request.style.free:
        yield SmoothInstead(found, ask)
        found = shortlist.among(SMOOTHED, PIECES)
    count = found.fit.n_stored_points if found is not None and found.kept else inf
    few, no_lines = count <= rough, True
    if may_be_lines:
        chords = problem.chords
        few = few and count <= chords.n_points
        no_lines = chords.follow_curve or count <= CHORDS_PART * chords.n_points
    if not (few and no_lines):
        yield Lines(needed=not few, fewer_than=count)
        if not shortlist.kept:
            yield ThroughAll()
    if problem.request.insists_on_tangents and shortlist.missing_tangents:
        yield ThroughAll()
        yield TurnedEnds(shortlist.missing_tangents)


def _follows_no_curve(problem: Problem) -> bool:
    """Whether points are so rough for the tolerance that lines alone may follow them.

    The smallest effort does not go by that, nor a request that asks for more than a tolerance.
    """
    request, contour = problem.request, problem.contour
    if request.effort == "smallest" or not request.is_plain or len(contour) < NO_CURVE_POINTS:
        return False
    rough = problem.chords.n_points > NO_CURVE_PART * len(contour)
    return rough and not bends_evenly_but_in_corners(contour.points)


def _one_spline_may_be_better(problem: Problem, in_pieces: Verified) -> bool:
    """Whether a single spline may replace pieces without bending what was drawn."""
    request, pieces = problem.request, in_pieces.fit.sections
    if request.constraints.anything:
        return False
    if problem.has_corners:
        return not request.style.names_corners and in_facets(pieces, problem.contour.closed)
    if request.style.free:
        return True
    return not any(drawn_straight(piece, problem.drawn, problem.tolerance) for piece in pieces)
