"""The shape as it was drawn: lines, arcs and regularities first, the tolerance for the rest."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import LEAST_TURN, NOISE_BAND, largest_bulge, resolution
from shapespline.engines.drawn import (
    FEW_ELEMENTS,
    LITTLE_FREE,
    ONE_BIT,
    POINTS_EACH,
    DrawnArc,
    DrawnLine,
    simplified,
)
from shapespline.engines.pieces import MirroredHalf
from shapespline.fitting.choose import DRAWN, FEW_DRAWN
from shapespline.fitting.estimate import DRAWN_DEARER, Estimation
from shapespline.fitting.measured_runs import MeasuredRuns
from shapespline.fitting.problem import Problem
from shapespline.fitting.verify import Candidate
from shapespline.geometry import joined, turns_of, two_sided_distance
from shapespline.validation import median
from shapespline.values import CORNER_TURN, Contour, Piece

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.analysis import Resolution
    from shapespline.engines.drawn import Drawn
    from shapespline.fitting.strategies import Ask, Proposals
    from shapespline.monitor import Monitor
    from shapespline.values import Regularity

# Without a tolerance a drawn shape explains points no farther than so many bands, those of a
# picture than so many times its accuracy; a corner that it blunts lies beyond them (DRA-06). More
# than a pixel, and two at a corner, no picture is off.
FARTHEST, FARTHEST_OF_PICTURE, FARTHEST_CORNER = 1.5, 25.0, 75.0
# Free-form runs among noisy points must cost so much less than lines and arcs alone, two control
# points (FIT-38).
RUNS_DEARER = 7.0
# Nats that each piece saves of what one spline costs where lines and arcs that repeat nothing were
# drawn: those of one of its numbers (DRA-51).
SAVED = 4.0
# Kinds of pieces that are neither lines nor arcs.
CURVED = ("bezier", "spline")


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
        proposed: list[tuple[float, Candidate, Drawn]] = []
        for reading in self._readings(problem):
            candidate = (
                None if monitor.ended else self._candidate(problem, reading, within, monitor)
            )
            cost = None if candidate is None else self._cost(candidate, reading, problem)
            if candidate is not None and cost is not None:
                if self._is_evident(candidate, reading, problem, monitor):
                    candidate = replace(candidate, rank=DRAWN)
                elif not reading.is_told and self._is_chain(reading):
                    continue
                dearer = RUNS_DEARER if reading.has_runs else 0.0
                proposed.append((cost + dearer, candidate, reading))
                if not reading.has_runs and self._needs_no_other(cost, reading):
                    break
        if not proposed:
            return
        _, candidate, found = min(proposed, key=lambda one: one[0])
        yield candidate
        if style.simplify:
            measured = two_sided_distance(joined(candidate.pieces, style.degree), problem.contour)
            left = within - measured.hausdorff_distance
            simpler = simplified(found, left * scale) if left > 0 else found
            if simpler is not found:
                other = self._candidate(problem, simpler, within, monitor)
                if other is not None:
                    yield other

    def _readings(self, problem: Problem) -> Iterator[Drawn]:
        """What the points tell, each way that it may be: noisy points may be read in several."""
        found, noisy = problem.lines_and_arcs, self.shown is not None and not self.shown.clean
        symmetric, of_picture = problem.request.symmetric, problem.contour.level_line is not None
        if found is not None:
            # A whole circle is its own mirror image.
            mirrored = len(found.parts) == 1 or any(o.name == "mirror" for o in found.regularities)
            if symmetric and not mirrored and MirroredHalf.of(problem.thinned):
                return
            one: Drawn | None = found
            while one is not None:
                if not (noisy and one.has_runs):
                    yield one
                elif one.share >= 1.0 - LITTLE_FREE:
                    # What chains of elements left is no run, unless it is little (DRA-51).
                    yield replace(one, is_told=False)
                one = one.otherwise
        if noisy and not (of_picture or symmetric):
            yield from problem.between_corners

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
        measured = self._measured(problem, found, within, monitor)
        if measured is not None:
            found = measured.meeting(found, closed=problem.contour.closed)
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
                if measured is not None and not measured.clean:
                    pieces += measured.smoothed(part)
                    continue
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

    def _measured(
        self, problem: Problem, found: Drawn, within: float, monitor: Monitor
    ) -> MeasuredRuns | None:
        """What free-form runs of measured points meet; None of pictures.

        Within a tolerance where points are clean; without one noisy ones are smoothed.
        """
        if problem.contour.level_line is not None or not found.has_runs:
            return None
        degree, scale = problem.request.style.degree, problem.upright.scale
        if self.estimation is None:
            shown = resolution(problem.seen)
            if not shown.clean:
                return None
            return MeasuredRuns(degree, shown.noise, monitor, clean=True, within=within)
        clean = self.estimation.shown.clean
        noise = (self.estimation.shown if clean else self.estimation.means).noise * scale
        return MeasuredRuns(degree, noise, monitor, clean=clean)

    def _needs_no_other(self, cost: float, drawn: Drawn) -> bool:
        """Whether one spline costs so much more that no curves between corners need be tried."""
        if self.estimation is None or self.estimation.shown.clean:
            return True
        return cost <= self.estimation.supposing(drawn.precisions).smooth.cost - DRAWN_DEARER

    def _is_evident(
        self, candidate: Candidate, drawn: Drawn, problem: Problem, monitor: Monitor
    ) -> bool:
        """Whether lines and arcs that repeat nothing tell many points better than one spline.

        Then they were drawn: no smooth curve is told so. Within a tolerance they have arcs and no
        blunt corners, which is soon found out (DRA-51).
        """
        contour, estimation = problem.contour, self.estimation
        many = len(drawn.parts) * POINTS_EACH <= len(contour)
        if drawn.is_told or not many or contour.level_line is not None:
            return False
        if estimation is None:
            if not _has_arcs_and_clear_corners(candidate.pieces, closed=contour.closed):
                return False
            estimation = Estimation(problem, monitor)
        estimation = estimation.supposing(drawn.precisions)
        cost = _told_by(estimation, candidate, drawn)
        saved = 0.0 if cost is None else estimation.smooth.cost - cost
        return saved >= SAVED * len(candidate.pieces)

    def _is_chain(self, drawn: Drawn) -> bool:
        """Whether it may follow any curve: many elements with arcs, or with runs beside them.

        Runs within a tolerance lie beside edges of exact points alone (DRA-45).
        """
        if drawn.has_runs:
            return self.estimation is not None
        has_arcs = any(isinstance(part, DrawnArc) for part in drawn.parts)
        return has_arcs and len(drawn.parts) > FEW_ELEMENTS

    def _cost(self, candidate: Candidate, drawn: Drawn, problem: Problem) -> float | None:
        """What the curve costs; None where it misses points, or noisy ones tell no other as well.

        Of clean points one reading alone is proposed, which costs nothing.
        """
        if self.estimation is None:
            return 0.0
        contour, shown = problem.contour, self.estimation.shown
        curve = joined(candidate.pieces, problem.request.style.degree)
        found = two_sided_distance(curve, contour)
        # What was not drawn is a curve like others, and those follow what clean points tell.
        # What lines and arcs alone tell of errors does not show in the points.
        supposed = NOISE_BAND * drawn.supposed / problem.upright.scale
        farthest = beyond = FARTHEST * (shown.band + supposed)
        if drawn.precisions is not None:  # all points may be off by more than neighbours tell
            beyond /= min(1.0, median(drawn.precisions)) ** 0.5
        if not drawn.is_told:  # a curve like others, and those follow what clean points tell
            farthest = min(farthest, FARTHEST * shown.told)
        step = median(np.diff(contour.arc_length))
        accuracy = None if contour.level_line is None else contour.accuracy
        if accuracy is not None:
            farthest = min(max(farthest, FARTHEST_OF_PICTURE * accuracy), step)
            beyond = min(max(beyond, FARTHEST_CORNER * accuracy), 2.0 * step)
            if accuracy > ONE_BIT * step:
                found = found.beside(candidate.pieces)
        elif len(candidate.pieces) == 1:
            # A circle bulges beyond the chords of its points.
            beyond = max(beyond, FARTHEST * largest_bulge(contour))
        else:
            # Corners lie between points, those of a right angle half a step from their chord.
            beyond = max(beyond, step if not drawn.has_runs or shown.clean else 0.5 * step)
            if drawn.is_told and not drawn.has_runs:  # where points are missing, too
                beyond = max(beyond, 0.5 * float(np.diff(contour.arc_length).max()))
        estimation = self.estimation.supposing(drawn.precisions)
        alike = estimation is self.estimation
        missed = found.max_distance if alike else estimation.means.farthest(curve)
        if missed > farthest or found.reverse_distance > beyond:
            return None
        # What is left of a picture's slow errors is no noise.
        if accuracy is not None or shown.clean:
            return 0.0
        return _told_by(estimation, candidate, drawn)


def _has_arcs_and_clear_corners(pieces: tuple[Piece, ...], *, closed: bool) -> bool:
    """Whether not all are lines, and they meet smoothly or in corners; chords of curves do not."""
    turns = np.abs(turns_of(pieces, closed=closed))
    blunt = (turns > CORNER_TURN) & (turns < LEAST_TURN)
    return not blunt.any() and any(piece.arc is not None for piece in pieces)


def _told_by(estimation: Estimation, candidate: Candidate, drawn: Drawn) -> float | None:
    """What a curve of measured points costs; None if one spline tells them better."""
    n_unknowns = drawn.n_unknowns + 2 * _n_of_runs(candidate.pieces, drawn)
    return estimation.cost_of(candidate.pieces, n_unknowns, told=drawn.is_told)


def _n_of_runs(pieces: tuple[Piece, ...], drawn: Drawn) -> int:
    """Control points of free-form runs that no line or arc tells."""
    inner = sum(len(one.control_points) - 2 for one in pieces if one.kind in CURVED)
    return inner + len(pieces) - len(drawn.parts)


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
