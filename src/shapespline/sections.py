"""The structured fit: lines, Beziers and small splines between nodes, as few points as possible.

An outline is cut into sections at nodes. How far a section of each kind reaches within the
tolerance is found by fitting, dynamic programming chooses the nodes, then the nodes become
unknowns and moves on windows of neighbours take away what is not needed. The loops are one
kernel call; this module decides what it may do, and verifies what it did.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise, product
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.corners import LEAST_TURN
from shapespline.distance import Distances, two_sided_distance
from shapespline.drawing import Piece
from shapespline.errors import InvalidInputError
from shapespline.joining import joined, turn_between
from shapespline.knots import check_degree
from shapespline.nodes import aligned
from shapespline.outline import SearchOutline
from shapespline.progress import Watch

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.contour import Contour
    from shapespline.curve import BSplineCurve
    from shapespline.frame import WorkingFrame
    from shapespline.typing import ArrayLike, FloatArray, IntArray

# Parts of the tolerance that the search aims at, one after another until the promise is kept.
AIMS = (0.999, 0.97, 0.9, 0.7)
# Candidate nodes on a whole outline, whatever the stride.
LEAST_CANDIDATES, MOST_CANDIDATES = 64, 1000
# Beyond this part of the number of points the data are rough, and lines may be the smaller.
ROUGH_PART = 0.3
# Pieces shorter than this part of the curve are roundings.
SPECK = 1e-12
# A corner that the fit turns by less than this part of what makes a corner is given up.
RELEASE = 0.7
# Control points may move by this part of the tolerance to make a tangent exact: it is less than
# what the first aim leaves.
LARGEST_MOVE = 0.002
# The same for a fit to noisy points, in standard deviations of the noise.
OBSERVED_MOVE = 0.1
# A node that turns more is a corner of the result, radians.
SHARP_TURN = np.radians(1.01)
# Sections are at most cubic; higher degrees are made by elevation.
SECTION_DEGREE = 3

Effort = Literal["fast", "balanced", "smallest"]


class Search(NamedTuple):
    """What one run of the kernel may do.

    ``stride`` is the distance of candidate nodes in points, but more of them stand where the
    polyline through them would leave the data by ``resolution`` tolerances; ``passes`` how often
    all moves are tried; ``widest`` how many neighbours they take along.
    """

    stride: int
    resolution: float
    passes: int
    widest: int


# The reduction is a greedy search, and where it starts is worth some percent: the best of several
# runs on different candidates is taken.
SEARCHES: dict[Effort, tuple[Search, ...]] = {
    "fast": (Search(12, 0.8, 1, 1),),
    "balanced": (Search(12, 0.4, 6, 2),),
    "smallest": tuple(
        Search(stride, part, 6, 2) for stride in (3, 6, 12) for part in (0.15, 0.25, 0.4)
    ),
}


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
    """

    pieces: tuple[Piece, ...]
    spline: BSplineCurve
    corners: IntArray
    distances: Distances = field(repr=False)
    tolerance: float
    closed: bool

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
    ends_fixed: bool = False,
    watch: Watch | None = None,
    outline: SearchOutline | None = None,
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
    ends_fixed : bool
        Whether the curve of an open contour begins and ends in its first and last point, exactly.
    watch : Watch, optional
        Hears of the progress and may end the search; what was reached is returned, verified.
    outline : SearchOutline, optional
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
    degree = check_degree(degree)
    if not (np.isfinite(tolerance) and tolerance > 0):
        raise InvalidInputError(f"tolerance must be a positive number, got {tolerance!r}")
    if effort not in SEARCHES:
        raise InvalidInputError(f"effort must be one of {', '.join(SEARCHES)}, got {effort!r}")
    whole = SearchOutline.of(contour, tolerance, corners) if outline is None else outline
    frame, aim, chosen, gentle = whole.thinned()
    work = frame.contour
    free = isinstance(corners, str) and corners == "free"
    watch = Watch() if watch is None else watch
    task = _Task(
        work, min(degree, SECTION_DEGREE), not free, not free, chosen, gentle, ends_fixed, watch
    )
    # Free of rules, sharp corners are still often the cheapest: both are tried.
    tasks = [task, task._replace(keep_corners=True)] if free and len(chosen) else [task]
    results = []
    for part in AIMS:
        best = _smallest_run(tasks, part * aim, SEARCHES[effort], watch)
        if best:
            results.append(_verified(frame, best, contour, tolerance, degree, ends_fixed))
        if watch.ended_as or results[-1].kept:
            break
    if results and results[-1].kept and results[-1].n_stored_points <= ROUGH_PART * len(contour):
        return results[-1]
    # Data rougher than the tolerance: what curves cannot follow lines do, at last one a point.
    lines = _Task(work, 1, False, False, chosen, gentle, ends_fixed, Watch()).run(
        AIMS[0] * aim, SEARCHES["fast"][0]._replace(stride=1)
    )
    others = (
        _verified(frame, p, contour, tolerance, degree, ends_fixed)
        for p in (lines, _through_all(whole.frame.contour))
    )
    return min((*results, *others), key=lambda found: (not found.kept, found.n_stored_points))


def fit_observed(
    outline: Contour,
    observed: FloatArray,
    tolerance: float,
    noise: float,
    *,
    corners: IntArray | None,
    degree: int = 3,
    effort: Effort = "balanced",
) -> tuple[Piece, ...]:
    """Pieces that follow a smoothed outline within a tolerance, then fitted to what was observed.

    Parameters
    ----------
    outline : Contour
        The smoothed outline, in the order and unit of a `WorkingFrame`.
    observed : ndarray, shape (n, 2)
        The noisy points, index for index.
    tolerance : float
        Between outline and pieces, before these are fitted to the points by least squares.
    noise : float
        Standard deviation of the points.
    corners : ndarray or None
        Indices of the corners that are kept; None lets the fit make and round them.
    degree, effort
        See `fit_pieces`.
    """
    kept = np.empty(0, dtype=np.int64) if corners is None else corners
    faithful = corners is not None
    task = _Task(
        outline,
        min(degree, SECTION_DEGREE),
        faithful,
        faithful,
        kept,
        np.zeros(len(outline), dtype=np.int64),
        False,
        Watch(),
    )
    runs = [task.run(tolerance, search, observed, noise) for search in SEARCHES[effort]]
    return min(runs, key=lambda pieces: sum(len(p.control_points) - 1 for p in pieces))


def _smallest_run(
    tasks: Sequence[_Task], aim: float, searches: Sequence[Search], watch: Watch
) -> tuple[Piece, ...]:
    """The best of all searches that were run before the watch ended them, empty if none was."""
    best: tuple[Piece, ...] = ()
    for search, task in product(searches, tasks):
        if watch.stage(_size(best)):
            break
        found = task.run(aim, search)
        if found and (not best or _size(found) < _size(best)):
            best = found
    return best


def _size(pieces: Sequence[Piece]) -> int:
    return sum(len(piece.control_points) - 1 for piece in pieces)


class _Task(NamedTuple):
    """What stays the same over the runs on one contour.

    Corners are candidate nodes always and nodes if they are kept; ``smooth`` makes other joints
    tangent, where the outline is ``gentle`` at the price of some more points.
    """

    contour: Contour
    largest_degree: int
    keep_corners: bool
    smooth: bool
    corners: IntArray
    gentle: IntArray
    ends_fixed: bool
    watch: Watch

    def run(
        self,
        tolerance: float,
        search: Search,
        observed: FloatArray | None = None,
        noise: float = 0.0,
    ) -> tuple[Piece, ...]:
        """One run of the kernel, in the end a least-squares fit to what was observed.

        No pieces if it was ended before there were any.
        """
        n = len(self.contour)
        marked = np.zeros(n, dtype=np.int64)
        marked[self.corners] = 1
        degrees, counts, knots, coordinates = _kernels.fit_sections(
            self.contour.points,
            self.contour.closed,
            marked if self.keep_corners else np.zeros_like(marked),
            marked,
            self.gentle,
            max(min(search.stride, n // LEAST_CANDIDATES), n // MOST_CANDIDATES, 1),
            search.resolution * tolerance,
            tolerance,
            self.largest_degree,
            self.smooth,
            self.ends_fixed,
            RELEASE * LEAST_TURN,
            search.passes,
            search.widest,
            self.watch.ends,
            observed,
            noise,
        )
        pieces = _unpacked(degrees, counts, np.array(knots), np.array(coordinates))
        if not (self.smooth and pieces):
            return pieces
        largest_move = LARGEST_MOVE * tolerance if observed is None else OBSERVED_MOVE * noise
        return aligned(pieces, largest_move, closed=self.contour.closed)


def _through_all(contour: Contour) -> tuple[Piece, ...]:
    """A line from each point to the next."""
    knots, polyline = np.array([0.0, 0.0, 1.0, 1.0]), contour.polyline
    return tuple(Piece("line", 1, knots, polyline[i : i + 2]) for i in range(len(polyline) - 1))


def _unpacked(
    degrees: list[int], counts: list[int], knots: FloatArray, coordinates: FloatArray
) -> tuple[Piece, ...]:
    """Pieces from the kernel's arrays end to end."""
    pieces = []
    k = m = 0
    points = coordinates.reshape(-1, 2)
    for degree, count in zip(degrees, counts, strict=True):
        inner = count - degree - 1
        kind = "line" if degree == 1 else "bezier" if inner == 0 else "spline"
        pieces.append(Piece(kind, degree, knots[k : k + count + degree + 1], points[m : m + count]))
        k, m = k + count + degree + 1, m + count
    return _without_specks(pieces)


def _without_specks(pieces: list[Piece]) -> tuple[Piece, ...]:
    """The pieces but for those of next to no length, whose neighbours then meet exactly."""
    lengths = [float(np.hypot(*np.diff(p.control_points, axis=0).T).sum()) for p in pieces]
    least = SPECK * sum(lengths)
    kept = [p for p, length in zip(pieces, lengths, strict=True) if length > least]
    if len(kept) < len(pieces):
        for before, after in pairwise(kept):
            after.control_points[0] = before.control_points[-1]
    return tuple(kept)


def _verified(
    frame: WorkingFrame,
    found: tuple[Piece, ...],
    contour: Contour,
    tolerance: float,
    degree: int,
    ends_fixed: bool,
) -> PiecesResult:
    """The result in the data's unit with its distances measured."""
    pieces = frame.restored(found)
    if ends_fixed and not contour.closed:  # but for the rounding of the frame they are
        pieces[0].control_points[0] = contour.points[0]
        pieces[-1].control_points[-1] = contour.points[-1]
    spline = joined(pieces, degree)
    sharp = [
        pieces[i].control_points[0]
        for i in range(0 if contour.closed else 1, len(pieces))
        if abs(turn_between(pieces[i - 1], pieces[i])) > SHARP_TURN
    ]
    nearest = {int(((contour.points - node) ** 2).sum(axis=1).argmin()) for node in sharp}
    return PiecesResult(
        pieces=pieces,
        spline=spline,
        corners=np.array(sorted(nearest), dtype=np.int64),
        distances=two_sided_distance(spline, contour),
        tolerance=tolerance,
        closed=contour.closed,
    )
