"""The structured fit: lines, Beziers and small splines between nodes, as few points as possible.

An outline is cut into sections at nodes. How far a section of each kind reaches within the
tolerance is found by fitting, dynamic programming chooses the nodes, then the nodes become
unknowns and moves on windows of neighbours take away what is not needed. The loops are one
kernel call; this module decides what it may do, and verifies what it did.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING, Literal

import numpy as np

from shapespline.engines.pieces.constraints import Constraints, pinned_exactly
from shapespline.engines.pieces.problem import PiecesProblem
from shapespline.engines.pieces.search import SEARCHES, PiecesSolver
from shapespline.errors import InvalidInputError
from shapespline.geometry import EXACT, Distances, joined, turn_between, two_sided_distance
from shapespline.monitor import Monitor
from shapespline.values import Piece, check_degree

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.analysis import NormalizedContour
    from shapespline.engines.pieces.search import Effort, SearchBudget
    from shapespline.typing import ArrayLike, FloatArray, IntArray
    from shapespline.values import BSplineCurve, Contour
from shapespline.engines.pieces.fallbacks import _chords_found, _drawn_with_lines, through_all

# Parts of the tolerance that the search aims at, one after another until the promise is kept.
AIMS = (0.999, 0.97, 0.9, 0.7)
# Beyond this part of the number of points the data are rough, and lines may be the smaller.
ROUGH_PART = 0.3
# Beyond this part of the vertices of a polyline found in one pass, which are more than need be,
# lines are looked at.
CHORDS_PART = 0.7
# A node that turns more is a corner of the result, radians.
SHARP_TURN = np.radians(1.01)
# Sections are at most cubic; higher degrees are made by elevation.
SECTION_DEGREE = 3


@dataclass(frozen=True, eq=False, kw_only=True)
class PiecesResult:
    """A structured fit and what was verified about it.

    Attributes
    ----------
    pieces : tuple of Piece
        Lines, Beziers and splines end to end, each clamped over [0, 1].
    spline : BSplineCurve
        The same curve as one B-spline over [0, 1].
    corners : ndarray, shape (c,)
        Indices of the points nearest to the nodes where the curve turns by more than a degree.
    distances : Distances
        Both directions, certified.
    tolerance : float
        The one asked for.
    closed : bool
    tangent_error : float
        By how much a tangent that was asked for is missed, radians.
    """

    pieces: tuple[Piece, ...]
    spline: BSplineCurve
    corners: IntArray
    distances: Distances = field(repr=False)
    tolerance: float
    closed: bool
    tangent_error: float = 0.0

    @property
    def n_stored_points(self) -> int:
        """Line 1, quadratic 2, cubic 3, k interior knots 3 + k; an open curve adds 1."""
        stored = sum(len(piece.control_points) - 1 for piece in self.pieces)
        return stored + (0 if self.closed else 1)

    @property
    def kept(self) -> bool:
        """Whether both distances are within the tolerance."""
        return self.distances.hausdorff_distance <= self.tolerance

    def turns(self) -> Iterator[float]:
        """Signed turn at the start of every piece but the first of an open curve, radians."""
        for i in range(0 if self.closed else 1, len(self.pieces)):
            yield turn_between(self.pieces[i - 1], self.pieces[i])


def fit_pieces(
    contour: Contour,
    tolerance: float,
    *,
    corners: Literal["auto", "free"] | ArrayLike | None = "auto",
    degree: int = 3,
    effort: Effort = "balanced",
    held: Constraints | None = None,
    monitor: Monitor | None = None,
    outline: PiecesProblem | None = None,
) -> PiecesResult:
    """Fit lines, Beziers and small splines to a contour, as few points as the tolerance allows.

    Parameters
    ----------
    contour : Contour
    tolerance : float
        Largest distance, data units, from data to curve and from curve to data polyline.
    corners : "auto", "free", None or array_like of indices
        "auto" finds the corners and keeps them, and is tangent-continuous elsewhere; indices say
        which they are, None that there are none; "free" may round or make them: fewest points.
    degree : int
        Of ``spline``, 1 to 9; pieces have at most this degree, and at most 3.
    effort : {"fast", "balanced", "smallest"}
        How many candidate nodes, moves and runs are tried.
    held : Constraints, optional
        Ends, tangents and points that the curve keeps exactly, by the contour's indices.
    monitor : Monitor, optional
        Hears of the progress and may end the search; what was reached is returned, verified.
    outline : PiecesProblem, optional
        Of this contour, tolerance and corners, if it is known.

    Returns
    -------
    PiecesResult
        Verified by `two_sided_distance`. Where the search breaks the promise it is run again with
        a smaller tolerance, at last with lines only.

    Raises
    ------
    InvalidInputError
        If the tolerance is not positive or an argument is not one of those above.

    Notes
    -----
    A closed outline gives the same curve whichever point comes first, whichever way it runs.

    Examples
    --------
    >>> from shapespline import Contour
    >>> side = np.linspace(0, 1, 20, endpoint=False)
    >>> x = np.concatenate([side, 1 + 0 * side, 1 - side, 0 * side])
    >>> square = Contour(np.column_stack([x, np.roll(x, 20)]), closed=True)
    >>> result = fit_pieces(square, 0.01)
    >>> result.kept, result.n_stored_points, [piece.kind for piece in result.pieces]
    (True, 4, ['line', 'line', 'line', 'line'])
    """
    degree, held = check_degree(degree), Constraints() if held is None else held
    if not (np.isfinite(tolerance) and tolerance > 0):
        raise InvalidInputError(f"tolerance must be a positive number, got {tolerance!r}")
    if effort not in SEARCHES:
        raise InvalidInputError(f"effort must be one of {', '.join(SEARCHES)}, got {effort!r}")
    whole = PiecesProblem.of(contour, tolerance, corners, held) if outline is None else outline
    work = whole.thinned()
    free = isinstance(corners, str) and corners == "free"
    monitor = Monitor() if monitor is None else monitor
    task = PiecesSolver(work, min(degree, SECTION_DEGREE), not free, not free, monitor)
    # Free of rules, sharp corners are still often the cheapest: both are tried.
    tasks = [task, task._replace(keep_corners=True)] if free and len(work.corners) else [task]
    results = []
    for part in AIMS:
        best = _smallest_run(tasks, part * work.tolerance, SEARCHES[effort], monitor)
        if best:
            results.append(verified_pieces(work.frame, best, contour, tolerance, degree, held))
        if monitor.ended or results[-1].kept:
            break
    found = results[-1] if results else None
    count = found.n_stored_points if found is not None and found.kept else np.inf
    # Where the caller knows the corners lines would make others.
    named = not isinstance(corners, str)
    n_chords, in_facets = (np.inf, False) if named else _chords_found(work)
    rough = min(ROUGH_PART * len(contour), n_chords)
    if found is not None and count <= rough and (in_facets or count <= CHORDS_PART * n_chords):
        return found
    # Data rougher than the tolerance: what curves cannot follow lines do, at last one a point.
    straight = work._replace(held=work.held._replace(tangents=(None, None)))
    lines = PiecesSolver(straight, 1, False, False, Monitor()).run(
        AIMS[0] * work.tolerance, SEARCHES["fast"][0]._replace(stride=1)
    )
    fewer = _size(lines) + (not contour.closed) < count
    drawn = fewer and _drawn_with_lines(lines, contour.closed)
    if found is not None and count <= rough and not drawn:
        return found
    results.append(verified_pieces(work.frame, lines, contour, tolerance, degree, held))
    if not any(result.kept for result in results):
        every = through_all(whole.frame.contour)
        results.append(verified_pieces(work.frame, every, contour, tolerance, degree, held))
    return min(
        results,
        key=lambda found: (not found.kept, found.tangent_error > 0, found.n_stored_points),
    )


def _smallest_run(
    tasks: Sequence[PiecesSolver], aim: float, searches: Sequence[SearchBudget], monitor: Monitor
) -> tuple[Piece, ...]:
    """The best of all searches that were run before the monitor ended them, empty if none was."""
    best: tuple[Piece, ...] = ()
    for search, task in product(searches, tasks):
        if monitor.stage(_size(best)):
            break
        found = task.run(aim, search)
        if found and (not best or _size(found) < _size(best)):
            best = found
    return best


def _size(pieces: Sequence[Piece]) -> int:
    return sum(len(piece.control_points) - 1 for piece in pieces)


def verified_pieces(
    frame: NormalizedContour,
    found: tuple[Piece, ...],
    contour: Contour,
    tolerance: float,
    degree: int,
    held: Constraints,
) -> PiecesResult:
    """The result in the data's unit with its distances measured."""
    pieces = frame.restored(found)
    fixed = np.array([0, len(contour) - 1] if held.ends and not contour.closed else [], dtype=int)
    pinned_exactly(pieces, contour.points[np.union1d(fixed, held.through)])
    spline = joined(pieces, degree)
    sharp = [
        pieces[i].control_points[0]
        for i in range(0 if contour.closed else 1, len(pieces))
        if abs(turn_between(pieces[i - 1], pieces[i])) > SHARP_TURN
    ]
    return PiecesResult(
        pieces=pieces,
        spline=spline,
        corners=_nearest_points(contour, sharp),
        distances=two_sided_distance(spline, contour),
        tolerance=tolerance,
        closed=contour.closed,
        tangent_error=_tangent_error(pieces, held),
    )


def _nearest_points(contour: Contour, nodes: Sequence[FloatArray]) -> IntArray:
    """Indices of the points nearest to some places, sorted, each once."""
    x, y = np.ascontiguousarray(contour.points.T)
    nearest = {int(((x - a) ** 2 + (y - b) ** 2).argmin()) for a, b in nodes}
    return np.array(sorted(nearest), dtype=np.int64)


def _tangent_error(pieces: Sequence[Piece], held: Constraints) -> float:
    """The larger angle between a tangent that is held and the curve's, radians; 0 for rounding."""
    errors = [0.0]
    first, last = pieces[0].control_points[:2], pieces[-1].control_points[-2:]
    for wanted, (a, b) in zip(held.tangents, (first, last), strict=True):
        if wanted is not None:
            (ux, uy), (vx, vy) = wanted, b - a
            errors.append(abs(float(np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy))))
    return max(errors) if max(errors) > EXACT else 0.0
