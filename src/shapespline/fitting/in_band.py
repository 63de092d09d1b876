"""The smallest curve within what clean points can show, where no tolerance is given."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import with_points_between
from shapespline.fitting.choose import ROUGH_PART
from shapespline.fitting.goals import Within
from shapespline.fitting.problem import Problem
from shapespline.fitting.smooth import corners_of
from shapespline.fitting.verify import Candidate
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.fitting.estimate import Estimation
    from shapespline.fitting.request import Request
    from shapespline.fitting.strategies import Ask, Proposals
    from shapespline.monitor import Monitor
    from shapespline.values import Fit

# Chords between points that are filled in stay within this part of what the points tell.
CHORD_PART = 0.05


@dataclass(frozen=True)
class InBand:
    """The smallest curve within what the points tell of each other, or at least within their band.

    Near the chords of sparse points there is a polygon only, and the smooth curve through them is
    known better than that: the curve is looked for near points between them, too (FIT-36).
    """

    estimation: Estimation
    ask: Ask

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve."""
        shown, request = self.estimation.shown, problem.request
        found = None
        if shown.told < shown.band and request.is_plain and not request.style.names_corners:
            contour = self._filled(problem)
            found = self._fit(problem, replace(request, contour=contour), shown.told, monitor)
            if found.n_stored_points > ROUGH_PART * len(contour):
                found = None
        if found is None:
            found = self._fit(problem, request, shown.band, monitor)
        yield Candidate(method=found.method, pieces=found.sections, spline=found.spline)

    def _filled(self, problem: Problem) -> Contour:
        """The data with points between them; neither first point nor direction change them."""
        shown, ordered = self.estimation.shown, self.estimation.ordered
        within = Problem(replace(problem.request, contour=ordered, goal=Within(shown.band)))
        corners = np.sort(corners_of(within))
        filled = with_points_between(ordered, corners, CHORD_PART * shown.told, shown.band)
        if not self.estimation.normalized.reversed:
            return filled
        return Contour.silently(filled.points[::-1], filled.closed, accuracy=filled.accuracy)

    def _fit(self, problem: Problem, request: Request, within: float, monitor: Monitor) -> Fit:
        request = replace(request, goal=Within(within))
        if request.style.character == "drawn" and problem.lines_and_arcs is None:
            # Nor is anything drawn within a tolerance where nothing is without one (DRA-32).
            request = replace(request, style=replace(request.style, character="fewest"))
        return self.ask(Problem(request), monitor).fit
