"""A fit as the lines, arcs and splines that a CAD program wants: one entity for each smooth run.

Straight pieces stay lines and arcs stay arcs. What lies between two of them, or between two
corners, is one clamped non-rational B-spline. A curve that is smooth all around is one clamped
spline that says it is closed: importers read that, true periodic knots few of them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.geometry import joined, turn_between
from shapespline.values import CORNER_TURN, BSplineCurve, Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.values import Arc, Fit


class Entity(NamedTuple):
    """A clamped curve over [0, 1], a line if its degree is 1; ``closed`` if smooth all around.

    Of an arc ``arc`` is the arc itself and the curve its twin.
    """

    curve: BSplineCurve
    closed: bool
    arc: Arc | None = None

    @property
    def is_line(self) -> bool:
        """Whether two points tell all of it."""
        return self.curve.degree == 1 and self.curve.n_control_points == 2


def entities(fit: Fit) -> list[Entity]:
    """Entities of a fit, end to end; of a closed one the first begins where the last ends.

    Examples
    --------
    >>> import shapespline as ss
    >>> square = ss.Contour([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True).resampled(80)
    >>> [entity.is_line for entity in entities(ss.fit_curve(square, tolerance=0.01))]
    [True, True, True, True]
    """
    if fit.spline.periodic and not fit.sections:
        return [Entity(fit.spline.clamped(), closed=True)]
    pieces = [part for piece in fit.pieces for part in _smooth_parts(piece)]
    breaks = [_breaks(a, b) for a, b in zip(pieces, [*pieces[1:], pieces[0]], strict=True)]
    if fit.closed:
        # Where it began before, if that is a cut.
        first = 0 if breaks[-1] or not any(breaks) else breaks.index(True) + 1
        pieces, breaks = pieces[first:] + pieces[:first], breaks[first:] + breaks[:first]
        smooth_seam = not any(breaks)
    else:
        smooth_seam = False
    breaks[-1] = True
    runs: list[list[Piece]] = [[]]
    for piece, ends in zip(pieces, breaks, strict=True):
        runs[-1].append(piece)
        if ends:
            runs.append([])
    return [_entity(run, smooth_seam) for run in runs[:-1]]


def _entity(run: Sequence[Piece], smooth_seam: bool) -> Entity:
    arc = run[0].arc
    return Entity(_run(run), smooth_seam or (arc is not None and arc.is_circle), arc)


def _run(pieces: Sequence[Piece]) -> BSplineCurve:
    if len(pieces) == 1:
        return BSplineCurve(pieces[0].knots, pieces[0].control_points, pieces[0].degree)
    return joined(pieces)


def _breaks(before: Piece, after: Piece) -> bool:
    """Whether a new entity begins between two pieces: at corners and beside lines and arcs."""
    alone = any(piece.degree == 1 or piece.arc is not None for piece in (before, after))
    return alone or abs(turn_between(before, after)) > CORNER_TURN


def _smooth_parts(piece: Piece) -> list[Piece]:
    """A clamped piece cut at its inner knots of full multiplicity, where it may have a corner."""
    if piece.arc is not None:
        return [piece]
    p = piece.degree
    inner, counts = np.unique(piece.knots[p + 1 : -p - 1], return_counts=True)
    at = inner[counts >= p]
    if not len(at):
        return [piece]
    parts, begin = [], piece.knots[0]
    for end in [*at, piece.knots[-1]]:
        within = piece.knots[(piece.knots > begin) & (piece.knots < end)]
        first = int(np.searchsorted(piece.knots, begin, side="right")) - p - 1
        knots = np.concatenate([np.full(p + 1, begin), within, np.full(p + 1, end)])
        points = piece.control_points[first : first + len(within) + p + 1]
        kind = "line" if p == 1 else "spline" if len(within) else "bezier"
        parts.append(Piece(kind, p, (knots - begin) / (end - begin), points))
        begin = end
    return parts
