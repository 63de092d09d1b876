"""Estimation: the curve behind noisy points, when the caller gives neither tolerance nor size.

The thinnest curve in a band as wide as the noise is a bad estimate. So the outline is smoothed
first, run by run between its corners, by least squares whose sizes a criterion chooses; the pieces
are then those that follow the smoothed outline within a few of its own standard errors.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from shapespline.analysis import NormalizedContour, find_corners
from shapespline.engines.least_squares import Balanced, balanced_start
from shapespline.engines.pieces import SECTION_DEGREE, SHARP_TURN, fit_observed
from shapespline.errors import DegenerateContourError
from shapespline.geometry import joined, turn_between, two_sided_distance
from shapespline.solvers import Limits
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.engines.pieces import Effort
    from shapespline.typing import ArrayLike, FloatArray, IntArray
    from shapespline.values import Piece
from shapespline.analysis import NOISE_BAND, resolution
from shapespline.engines.least_squares import PENALTY, Smoothed, smoothed, straight_line

# A smoothed outline is followed within one of these numbers of its standard errors.
STANDARD_ERRORS = (1.5, 2.0, 3.0)
# Pieces must not cost more than this part of what one spline costs: with corners that are proven,
# which everybody sees, and without.
CHARACTER, NO_CORNERS = 1.02, 0.97
# A datum this many bands away tells that the estimate has missed something: a jump, a spike, a
# track too sparse to be smoothed.
FARTHEST = 1.5
# The start of a least-squares fit has been balanced already: what is left falls by 1e-4 and less.
FINAL_LIMITS = Limits(max_iterations=300, max_evaluations=1000, relative_decrease=1e-4)


def smooth_start(contour: Contour, degree: int, weights: FloatArray | None = None) -> Balanced:
    """One spline over the whole contour, of the size that the criterion chooses."""
    shown = resolution(contour)
    found = smoothed(contour, degree, max(shown.noise, shown.band / NOISE_BAND), weights)
    if found.start is not None:
        return found.start
    return balanced_start(contour, degree + 1, degree, weights, rounds=0, ends="fitted")


class Evidence(NamedTuple):
    """What the points say of a curve.

    ``cost`` is the sum of squared distances over the variance, and the price of what the curve
    stores; ``farthest`` the largest distance of a point, or of pieces
    in either direction, data units.
    """

    cost: float
    farthest: float
    n_stored_points: int
    n_proven_corners: int = 0

    def preferred_to(self, smooth: Evidence) -> bool:
        """Whether pieces are better than one spline: no larger, and not too dear."""
        part = CHARACTER if self.n_proven_corners else NO_CORNERS
        return self.cost <= part * smooth.cost and self.n_stored_points <= smooth.n_stored_points

    @classmethod
    def of_spline(cls, start: Balanced, contour: Contour, noise: float) -> Evidence:
        """Of one spline."""
        found = two_sided_distance(start.spline, contour)
        misfit = len(contour) * (found.rms_distance / noise) ** 2
        size = start.spline.n_control_points
        return cls(misfit + PENALTY * size, found.max_distance, size)

    @classmethod
    def of_pieces(
        cls,
        pieces: tuple[Piece, ...],
        degree: int,
        contour: Contour,
        noise: float,
        n_proven: int,
    ) -> Evidence:
        """Of pieces; a corner that is not proven is one of n places, which costs log n more."""
        found = two_sided_distance(joined(pieces, degree), contour)
        misfit = len(contour) * (found.rms_distance / noise) ** 2
        stored = sum(len(piece.control_points) - 1 for piece in pieces)
        stored += 0 if contour.closed else 1
        sharp = [
            abs(turn_between(before, after)) > SHARP_TURN
            for before, after in pairwise([*pieces, *(pieces[:1] if contour.closed else ())])
        ]
        price = PENALTY * stored + np.log(len(contour)) * max(0, sum(sharp) - n_proven)
        return cls(misfit + price, found.hausdorff_distance, stored, n_proven)


def estimated_pieces(
    contour: Contour,
    noise: float,
    *,
    corners: Literal["auto", "free"] | ArrayLike | None = "auto",
    degree: int = 3,
    effort: Effort = "balanced",
) -> tuple[tuple[Piece, ...], Evidence] | None:
    """Lines, Beziers and small splines behind noisy points, and what the points say of them.

    None where there is noise alone: what is left of it, smoothed, is a single point.

    Parameters
    ----------
    contour : Contour
    noise : float
        Standard deviation across the outline, data units, positive.
    corners, degree, effort
        See `fit_pieces`; corners found by "auto" and "free" stay only where the criterion prefers
        two runs to one.
    """
    frame = NormalizedContour.of(contour)
    band = NOISE_BAND * noise
    noise *= frame.scale
    work = frame.contour
    runs = _Runs(work, min(degree, SECTION_DEGREE), noise)
    if corners is None:
        at: IntArray = np.empty(0, dtype=np.int64)
    elif isinstance(corners, str):
        at = runs.kept_corners()
    else:
        at = np.unique(frame.place[np.asarray(corners, dtype=np.int64)])
    points, size = runs.joined(at)
    try:
        outline = Contour.silently(points, work.closed)
    except DegenerateContourError:
        return None
    observed = work.points[np.unique(outline.source, return_index=True)[1]]
    error = noise * float(np.sqrt(size / len(work)))
    free = isinstance(corners, str) and corners == "free"
    found: list[tuple[Evidence, tuple[Piece, ...]]] = []
    for part in STANDARD_ERRORS:
        pieces = fit_observed(
            outline,
            observed,
            part * error,
            noise,
            corners=None if free else outline.source[at],
            degree=degree,
            effort=effort,
        )
        said = Evidence.of_pieces(pieces, degree, work, noise, len(at))
        found.append((said._replace(farthest=said.farthest / frame.scale), pieces))
    said, pieces = min(found, key=lambda one: (one[0].farthest > FARTHEST * band, one[0].cost))
    return frame.restored(pieces), said


class _Runs:
    """A contour cut at corners, each run smoothed once."""

    def __init__(self, contour: Contour, degree: int, noise: float) -> None:
        self._contour, self._degree, self._noise = contour, degree, noise
        self._known: dict[tuple[int, int], Smoothed] = {}

    def kept_corners(self) -> IntArray:
        """Corners of the data, the faintest first given up where one run costs no more than two."""
        found = find_corners(self._contour, NOISE_BAND * self._noise)
        kept = found.indices.tolist()
        for corner in sorted(kept, key=lambda i: float(found.turns[i])):
            others = [i for i in kept if i != corner]
            price = np.log(len(self._contour))
            if self._cost(others, near=corner) <= self._cost(kept, near=corner) + price:
                kept = others
        return np.array(kept, dtype=np.int64)

    def joined(self, corners: IntArray) -> tuple[FloatArray, int]:
        """The smoothed points of all runs, which meet in corners, and their control points."""
        n = len(self._contour)
        cut = self._cut(corners.tolist())
        runs = [self._run(*run) for run in cut]
        pieces = [run.points.copy() for run in runs]
        for i in range(0 if len(corners) and self._contour.closed else 1, len(pieces)):
            self._meet(runs[i - 1], pieces[i - 1], runs[i], pieces[i])
        points = np.empty((n, 2))
        for run, piece in zip(cut, pieces, strict=True):
            points[np.arange(*run) % n] = piece
        return points, sum(run.n_control_points for run in runs)

    def _meet(self, before: Smoothed, left: FloatArray, after: Smoothed, right: FloatArray) -> None:
        """Ends two runs where their tangents cross, or half-way if that is beyond the noise."""
        u, v = before.tangent(-1), after.tangent(0)
        gap, turn = right[0] - left[-1], u[0] * v[1] - u[1] * v[0]
        corner = left[-1] + 0.5 * gap
        if abs(turn) > 1e-3:
            crossing = left[-1] + (gap[0] * v[1] - gap[1] * v[0]) / turn * u
            if np.hypot(*(crossing - corner)) <= NOISE_BAND * self._noise:
                corner = crossing
        reach = NOISE_BAND * self._noise
        for points, direction in ((left, u), (right, -v)):
            off = points - corner
            beyond = (off @ direction > 0) & (np.hypot(off[:, 0], off[:, 1]) <= reach)
            points[beyond] = corner
        left[-1] = right[0] = corner

    def _cost(self, corners: list[int], near: int) -> float:
        """Of the runs that hold a point."""
        n = len(self._contour)
        return sum(
            self._run(*run).cost
            for run in self._cut(corners)
            if (near - run[0]) % n < run[1] - run[0]
        )

    def _cut(self, corners: list[int]) -> list[tuple[int, int]]:
        """First and one past the last point of each run; neighbours share their corner."""
        n = len(self._contour)
        if not self._contour.closed:
            ends = sorted({0, *corners, n - 1})
            return [(a, b + 1) for a, b in pairwise(ends)]
        if not corners:
            return [(0, n)]
        around = sorted(corners)
        return [(a, b + 1) for a, b in zip(around, [*around[1:], around[0] + n], strict=True)]

    def _run(self, begin: int, end: int) -> Smoothed:
        if (begin, end) not in self._known:
            n = len(self._contour)
            if end - begin == n and self._contour.closed:
                run = self._contour
            else:
                points = self._contour.points[np.arange(begin, end) % n]
                run = Contour.silently(points, closed=False)
            few = len(run) <= self._degree + 1
            self._known[begin, end] = (
                straight_line(run, self._noise) if few else smoothed(run, self._degree, self._noise)
            )
        return self._known[begin, end]
