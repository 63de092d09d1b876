"""The shape as it was drawn: lines, arcs and regularities first, the tolerance for the rest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapespline.engines.drawn import (
    ONE_BIT,
    DrawnArc,
    DrawnLine,
    FreeRun,
    simplified,
)
from shapespline.engines.pieces import MirroredHalf
from shapespline.fitting.choose import DRAWN, FEW_DRAWN
from shapespline.fitting.problem import Problem
from shapespline.fitting.verify import Candidate
from shapespline.geometry import joined, two_sided_distance
from shapespline.validation import median
from shapespline.values import Contour, Piece

if TYPE_CHECKING:
    from shapespline.analysis import Resolution
    from shapespline.engines.drawn import Drawn
    from shapespline.fitting.estimate import Estimation
    from shapespline.fitting.strategies import Ask, Proposals
    from shapespline.monitor import Monitor
    from shapespline.values import Regularity

# Without a tolerance a drawn shape explains points no farther than so many bands, those of a
# picture than so many times its accuracy; a corner that it blunts lies beyond them (DRA-06). More
# than a pixel, and two at a corner, no picture is off.
FARTHEST, FARTHEST_OF_PICTURE, FARTHEST_CORNER = 1.5, 25.0, 75.0


@dataclass(frozen=True)
class DrawnPieces:
    """Lines, arcs and free-form runs as they were drawn.

    ``ask`` fits the free-form runs between their ends, with the tangents there; ``estimation`` is
    what the points tell where no tolerance is given.
    """

    ask: Ask
    estimation: Estimation | None = None

    @property
    def shown(self) -> Resolution | None:
        """What the points can show where no tolerance is given."""
        return None if self.estimation is None else self.estimation.shown

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve, if the data tell of lines and arcs; a simpler one too, if asked for."""
        style = problem.request.style
        within = problem.tolerance if self.shown is None else self.shown.band
        normalized = problem.upright
        scale = normalized.scale
        found = problem.lines_and_arcs
        if found is None or monitor.ended:
            return
        # A whole circle is its own mirror image.
        mirrored = len(found.parts) == 1 or any(one.name == "mirror" for one in found.regularities)
        if problem.request.symmetric and not mirrored and MirroredHalf.of(problem.thinned):
            return
        runs = any(isinstance(part, FreeRun) for part in found.parts)
        if runs and self.shown is not None and not self.shown.clean:
            return  # noise between them is smoothed with the rest
        candidate = self._candidate(problem, found, within, monitor)
        if candidate is None or not self._explains(candidate, found, problem):
            return
        yield candidate
        if style.simplify:
            measured = two_sided_distance(joined(candidate.pieces, style.degree), problem.contour)
            left = within - measured.hausdorff_distance
            simpler = simplified(found, left * scale) if left > 0 else found
            if simpler is not found:
                other = self._candidate(problem, simpler, within, monitor)
                if other is not None:
                    yield other

    def _candidate(
        self, problem: Problem, found: Drawn, within: float, monitor: Monitor
    ) -> Candidate | None:
        """Parts as pieces; None where a run was not fitted."""
        normalized = problem.upright
        pieces, kept = self._pieces(problem, found, within * normalized.scale, monitor)
        if not pieces:
            return None
        return Candidate(
            method="drawn",
            rank=DRAWN if found.is_told else FEW_DRAWN,
            pieces=_with_ends(normalized.restored(pieces), problem),
            regularities=_in_data(kept, len(pieces), normalized.scale, normalized.reversed),
        )

    def _pieces(
        self, problem: Problem, found: Drawn, within: float, monitor: Monitor
    ) -> tuple[tuple[Piece, ...], list[Regularity]]:
        """Pieces in the working unit, none where a run was not fitted; and what they keep."""
        pieces: list[Piece] = []
        place: dict[int, int] = {}
        for k, part in enumerate(found.parts):
            place[k] = len(pieces)
            if isinstance(part, DrawnLine):
                ends = np.stack([part.begin, part.end])
                if (part.begin == part.end).all():  # an outline without an inside, all of one line
                    return (), []
                pieces.append(Piece("line", 1, np.array([0.0, 0.0, 1.0, 1.0]), ends))
            elif isinstance(part, DrawnArc):
                pieces.append(Piece.of_arc(part.arc, within, begin=part.begin, end=part.end))
            else:
                run = Contour.silently(part.points, False)
                asked = problem.request.part(run, within, part.tangents)
                fitted = self.ask(Problem(asked), monitor)
                if fitted.tangent_error:  # a run so short that it turns within the tolerance
                    asked = problem.request.part(run, within)
                    fitted = self.ask(Problem(asked), monitor)
                if not fitted.kept:
                    return (), []
                pieces += fitted.fit.pieces
        kept = [
            one._replace(pieces=tuple(place[k] for k in one.pieces)) for one in found.regularities
        ]
        return tuple(pieces), kept

    def _explains(self, candidate: Candidate, drawn: Drawn, problem: Problem) -> bool:
        """Whether the curve comes near all points, and noisy ones tell no other as well."""
        if self.estimation is None:
            return True
        contour, shown = problem.contour, self.estimation.shown
        found = two_sided_distance(joined(candidate.pieces, problem.request.style.degree), contour)
        # What was not drawn is a curve like others, and those follow what clean points tell.
        farthest = beyond = FARTHEST * shown.band
        if not drawn.is_told:  # a curve like others, and those follow what clean points tell
            farthest = min(farthest, FARTHEST * shown.told)
        step = median(np.diff(contour.arc_length))
        accuracy = None if contour.level_line is None else contour.accuracy
        if accuracy is not None:
            farthest = min(max(farthest, FARTHEST_OF_PICTURE * accuracy), step)
            beyond = min(max(beyond, FARTHEST_CORNER * accuracy), 2.0 * step)
            if accuracy > ONE_BIT * step:
                found = found.beside(candidate.pieces)
        elif len(candidate.pieces) > 1:
            beyond = max(beyond, step)  # corners lie between points
        if found.max_distance > farthest or found.reverse_distance > beyond:
            return False
        # What is left of a picture's slow errors is no noise.
        return (
            accuracy is not None
            or shown.clean
            or self.estimation.justifies(candidate.pieces, drawn.n_unknowns, told=drawn.is_told)
        )


def _with_ends(pieces: tuple[Piece, ...], problem: Problem) -> tuple[Piece, ...]:
    """Pieces in the data's unit, their ends the data's to the bit where they are kept."""
    if problem.contour.closed or not problem.request.constraints.ends:
        return pieces
    points = [piece.control_points.copy() for piece in pieces]
    for k, end, way in ((0, 0, 1), (len(pieces) - 1, -1, -1)):
        own, given, other = points[k], problem.contour.points[end], -1 - end
        level = own[0] == own[-1] if pieces[k].kind == "line" else np.zeros(2, dtype=bool)
        own[end] = given
        if 0 <= k + way < len(pieces):  # a level edge stays level to the bit
            own[other, level] = points[k + way][end, level] = given[level]
    return tuple(
        piece._replace(control_points=own) for piece, own in zip(pieces, points, strict=True)
    )


def _in_data(
    found: list[Regularity], n_pieces: int, scale: float, backwards: bool
) -> tuple[Regularity, ...]:
    """Regularities by the places and in the unit of the data."""
    angles = ("tangent", "axis-parallel", "parallel", "perpendicular")
    return tuple(
        one._replace(
            pieces=tuple(sorted(n_pieces - 1 - k if backwards else k for k in one.pieces)),
            off=one.off if one.name in angles else one.off / scale,
        )
        for one in found
    )
