"""One spline with simple knots from corner to corner, so that curvature has no jumps."""

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
from shapespline.validation import distinct
from shapespline.values import BSplineCurve, Contour, Piece

if TYPE_CHECKING:
    from shapespline.fitting.strategies import Ask, Proposals
    from shapespline.fitting.verify import Verified
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray, IntArray


@dataclass(frozen=True)
class SmoothRuns:
    """smoothness=2: a line or a spline for each run of the data between two corners."""

    ask: Ask

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve; without corners one spline."""
        contour, corners = problem.contour, corners_of(problem)
        if not len(corners):
            yield from OneSpline().propose(problem, monitor)
            return
        # A closed outline begins in the same corner whatever the order of the data.
        row = row_from(contour, int(corners[0]))
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
        return as_piece(one_spline(run, problem, self.ask, monitor).fit.spline)


def corners_of(problem: Problem) -> IntArray:
    """Corners of the data by their indices, in canonical order."""
    return problem.normalized.order[problem.pieces.corners]


def row_from(contour: Contour, first: int) -> FloatArray:
    """The points in a row; those of a closed contour from one of them round to it again."""
    if not contour.closed:
        return contour.points
    return contour.points[(first + np.arange(len(contour) + 1)) % len(contour)]


def one_spline(run: Contour, problem: Problem, ask: Ask, monitor: Monitor) -> Verified:
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


def as_piece(spline: BSplineCurve) -> Piece:
    """A spline as one piece of a curve."""
    kind = "bezier" if len(spline.control_points) == spline.degree + 1 else "spline"
    return Piece(kind, spline.degree, spline.knots, spline.control_points.copy())
