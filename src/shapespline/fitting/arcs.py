"""form="arcs": lines and arcs alone, verified against the data like every other curve.

A curve in pieces is asked for within a part of the tolerance, and biarcs of it are measured to the
data: they may stray from the curve by more than what it left where the data lie on their side. A
whole outline is first tried as one circle.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.fitting.problem import Problem
from shapespline.fitting.request import Within
from shapespline.fitting.strategies import PIECES
from shapespline.fitting.verify import Candidate
from shapespline.geometry import lines_and_arcs
from shapespline.values import FULL_TURN, Arc, Piece

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.fitting.strategies import Ask, Proposals
    from shapespline.monitor import Monitor
    from shapespline.values import Contour, Fit

# Parts of the tolerance that the curve before the arcs is asked to keep; first all of it, which is
# the answer if it is lines and arcs already (FIT-18).
CURVE_PARTS = (1.0, 0.5, 0.1)
# Parts of the tolerance that arcs may stray from that curve, the loosest that keeps it taken; and
# of what the curve left of it, which keeps it whatever the data are, twins included (FIT-18).
STRAY_PARTS = (1.0, 0.8, 0.65)
SURE_PART = 0.97
# Of fewer points on a circle each may as well be a corner, of a square say.
FEWEST_ON_CIRCLE = 8


@dataclass(frozen=True)
class LinesAndArcs:
    """Lines and arcs end to end, tangent where the curve that they follow is smooth."""

    ask: Ask

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One circle, or a curve in pieces that is lines and arcs, or biarcs of a curve."""
        request, tolerance = problem.request, problem.request.tolerance or 0.0
        kept = request.constraints.anything or request.constraints.ends or problem.has_corners
        if not kept:
            circle = _one_circle(request.contour, tolerance)
            if circle is not None:
                verified = yield Candidate(method="sections", rank=PIECES, pieces=(circle,))
                if verified.kept:
                    return
        nodes, fewest = request.contour.points[request.constraints.through], np.inf
        for part in CURVE_PARTS:
            style = replace(request.style, form="pieces")
            asked = replace(request, goal=Within(part * tolerance), style=style, symmetric=False)
            fit = self.ask(Problem(asked), monitor).fit
            if part == 1.0:
                if fit.sections and all(piece.kind in ("line", "arc") for piece in fit.sections):
                    yield Candidate(method=fit.method, rank=PIECES, pieces=fit.sections)
                    return
                continue  # nothing is left for arcs beside the curve
            for stray in _strays(fit, tolerance):
                try:
                    pieces = lines_and_arcs(fit, stray, nodes)
                except InvalidInputError:  # no room is left between the curve and the tolerance
                    break
                if len(pieces) >= fewest:  # such as facets, which store one point each
                    break
                pieces = tuple(_within(piece, tolerance) for piece in pieces)
                verified = yield Candidate(method="sections", rank=PIECES, pieces=pieces)
                if verified.kept:
                    fewest = len(pieces)
                    break
            if monitor.ended:
                return


def _strays(fit: Fit, tolerance: float) -> Iterator[float]:
    """How far arcs are tried from a curve, data units."""
    sure = SURE_PART * (tolerance - fit.hausdorff_distance)
    yield from (part * tolerance for part in STRAY_PARTS if part * tolerance > sure)
    if sure > 0:
        yield sure


def _within(piece: Piece, tolerance: float) -> Piece:
    """An arc with the twin that the tolerance of the fit asks for."""
    if piece.arc is None:
        return piece
    begin, end = piece.control_points[[0, -1]]
    return Piece.of_arc(piece.arc, tolerance, begin=begin, end=end)


def _one_circle(contour: Contour, tolerance: float) -> Piece | None:
    """All points as one circle, or of an open outline as one arc: least squares (Kasa 1976)."""
    points = contour.points
    if len(points) < FEWEST_ON_CIRCLE:
        return None
    middle = points.mean(axis=0)
    x, y = (points - middle).T
    squares = x * x + y * y
    found, _, rank, _ = np.linalg.lstsq(
        np.column_stack([2 * x, 2 * y, np.ones(len(x))]), squares, rcond=None
    )
    if rank < 3:
        return None
    radius = float(np.sqrt(max(found[2] + found[0] ** 2 + found[1] ** 2, 0.0)))
    away = np.hypot(x - found[0], y - found[1]) - radius
    if not radius > 0 or np.abs(away).max() > tolerance:
        return None
    angles = np.unwrap(np.arctan2(y - found[1], x - found[0]))
    if contour.closed:
        turn = angles[-1] - angles[0]
        sweep = float(np.copysign(FULL_TURN, turn))
    else:
        sweep = float(angles[-1] - angles[0])
        if not tolerance < radius * abs(sweep) < radius * FULL_TURN:
            return None
    centre = (middle + found[:2]).tolist()
    arc = Arc((centre[0], centre[1]), radius, float(angles[0]), sweep)
    return Piece.of_arc(arc, tolerance)
