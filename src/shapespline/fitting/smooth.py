"""smoothness=2: one spline with simple knots from corner to corner, so curvature has no jumps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.pieces import Constraints
from shapespline.fitting.problem import Problem
from shapespline.fitting.strategies import PIECES, OneSpline
from shapespline.fitting.verify import Candidate
from shapespline.geometry import two_sided_distance
from shapespline.values import BSplineCurve, Contour, Piece

if TYPE_CHECKING:
    from shapespline.fitting.strategies import Ask, Proposals
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray


@dataclass(frozen=True)
class SmoothRuns:
    """A line or a spline with simple knots for each run of the data between two corners."""

    ask: Ask

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve; without corners one spline."""
        if not len(problem.pieces.corners):
            yield from OneSpline().propose(problem, monitor)
            return
        runs = _runs(problem)
        pieces = [self._piece(run, problem, monitor) for run in runs]
        for before, after in pairwise(pieces):  # up to rounding they are
            after.control_points[0] = before.control_points[-1]
        yield Candidate(method="removal", rank=PIECES, pieces=tuple(pieces))

    def _piece(self, run: Contour, problem: Problem, monitor: Monitor) -> Piece:
        """What goes through one run."""
        request = problem.request
        ends = run.points[[0, -1]]
        line = BSplineCurve(np.array([0.0, 0.0, 1.0, 1.0]), ends, 1)
        if two_sided_distance(line, run).hausdorff_distance <= problem.tolerance:
            return Piece("line", 1, line.knots, ends.copy())
        asked = replace(
            request,
            contour=run,
            style=replace(request.style, form="spline", corners=None, smoothness=1),
            constraints=Constraints(ends=True),
            weights=None,
            is_part=True,
        )
        spline = self.ask(Problem(asked), monitor).fit.spline
        kind = "bezier" if len(spline.control_points) == spline.degree + 1 else "spline"
        return Piece(kind, spline.degree, spline.knots, spline.control_points.copy())


def _runs(problem: Problem) -> list[Contour]:
    """The data between corners, in their direction."""
    contour = problem.contour
    found = problem.normalized.order[problem.pieces.corners]
    corners = np.sort(found)
    if contour.closed:
        # From the corner that is the first whatever the order of the data.
        corners = np.roll(corners, -int(np.searchsorted(corners, found[0])))
        spans = [*pairwise(corners.tolist()), (int(corners[-1]), int(corners[0]))]
        points = [_between(contour.points, *span) for span in spans]
    else:
        cuts = np.unique([0, *corners.tolist(), len(contour) - 1]).tolist()
        points = [contour.points[a : b + 1] for a, b in pairwise(cuts)]
    return [Contour.trusted(run, False, contour.accuracy) for run in points]


def _between(points: FloatArray, begin: int, end: int) -> FloatArray:
    """Points of a closed contour from one to another, both among them."""
    n = len(points)
    return points[(begin + np.arange((end - begin - 1) % n + 2)) % n]
