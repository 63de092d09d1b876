"""A contour cut at its corners into runs, each smoothed once by least squares."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import NOISE_BAND, find_corners
from shapespline.engines.least_squares import (
    FINAL_LIMITS,
    STRAY_WEIGHT,
    Smoothed,
    averaged,
    balanced_start,
    cheapest,
    minimized,
    named_solver,
    sizes_tried,
    smoothed_to,
    straight_line,
)
from shapespline.fitting.settings import DEFAULT_METHOD
from shapespline.fitting.smooth import as_piece
from shapespline.values import Contour, Piece

if TYPE_CHECKING:
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray, IntArray

# A corner is one of n places: two runs must be cheaper than one by so many log n (FIT-28). But what
# turns by so many radians over such a part of the box diagonal is a corner to everybody: there one
# run must be cheaper by as much (FIT-31).
CORNER_PRICE = 1.5
SHARP, SHARP_LENGTH = np.radians(90.0), 0.1
# A corner is moved by at most so many points either way to where it is cheapest (FIT-31).
MOST_MOVES = 4
# Newton steps to where two runs cross, and the least sine of the angle between them there (FIT-31).
CROSSING_STEPS, LEAST_CROSSING = 6, 1e-3


class KeptCorners(NamedTuple):
    """Indices of the corners that the data prove.

    ``worth`` is what one run would have to cost less for the sharp ones of them.
    """

    indices: IntArray
    worth: float


class Runs:
    """A contour cut at corners, each run smoothed once."""

    def __init__(self, contour: Contour, degree: int, noise: float, monitor: Monitor) -> None:
        self._contour, self._degree, self._noise = contour, degree, noise
        self._monitor = monitor
        self._known: dict[tuple[int, int], Smoothed] = {}

    def kept_corners(self) -> KeptCorners:
        """Corners of the data but those that one run spares, the faintest given up first.

        It must cost no more than two and their price; where they are sharp, less by this price.
        Those that are kept are moved to where the runs beside them cost least.
        """
        found = find_corners(self._contour, NOISE_BAND * self._noise)
        near = found.length <= SHARP_LENGTH * self._contour.box_diagonal
        price = CORNER_PRICE * float(np.log(len(self._contour)))
        kept = found.indices.tolist()
        sharp = [i for i in kept if near and found.turns[i] >= SHARP]
        for corner in sorted(kept, key=lambda i: float(found.turns[i])):
            others = [i for i in kept if i != corner]
            dearer = -price if corner in sharp else price
            if self._cost(others, near=corner) <= self._cost(kept, near=corner) + dearer:
                kept = others
        placed = np.array(sorted(self._placed(kept)), dtype=np.int64)
        return KeptCorners(placed, price * len(set(kept) & set(sharp)))

    def _placed(self, corners: list[int]) -> list[int]:
        """Corners moved to the points where the runs beside them, as large as they are, cost least.

        A run that begins beyond its corner goes round it.
        """
        n, placed = len(self._contour), list(corners)
        for k, corner in enumerate(corners):
            sizes = [self._run(*run).n_control_points for run in self._beside(placed, corner)]
            least = self._cost(placed, near=corner)
            for way in (1, -1):
                for _ in range(MOST_MOVES):
                    at = placed[k] + way
                    moved = [*placed[:k], at % n if self._contour.closed else at, *placed[k + 1 :]]
                    runs = self._beside(moved, moved[k])
                    short = any(end - begin <= self._degree + 1 for begin, end in runs)
                    if short or len(runs) < len(sizes):  # beside an end or another corner
                        break
                    cost = sum(
                        self._smoothed(*run, size).cost
                        for run, size in zip(runs, sizes, strict=True)
                    )
                    if cost >= least:
                        break
                    placed, least = moved, cost
        return placed

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

    def fitted(self) -> tuple[Piece, ...]:
        """An open contour as lines and splines that meet in its corners and end in its ends."""
        corners = self.kept_corners().indices
        points, _ = self.joined(corners)
        points[[0, -1]] = self._contour.points[[0, -1]]
        return tuple(
            self._piece(begin, end, points[[begin, end - 1]])
            for begin, end in self._cut(corners.tolist())
        )

    def continued(self, end: int) -> FloatArray:
        """The polynomial beyond the first (0) or last (-1) point of an open contour, whole."""
        return self._run(0, len(self._contour)).continued(end)

    def _piece(self, begin: int, end: int, ends: FloatArray) -> Piece:
        """A run from one point to before another: the mean of what several sizes tell (FIT-33)."""
        points = self._contour.points[begin:end].copy()
        points[[0, -1]] = ends
        run, degree = Contour.silently(points, closed=False), self._degree
        size = self._run(begin, end).n_control_points
        if size <= degree or len(run) <= degree + 1:
            return Piece("line", 1, np.array([0.0, 0.0, 1.0, 1.0]), ends)
        tried = sizes_tried(run, degree, self._noise, monitor=self._monitor)
        told = averaged(tried, run, degree, self._noise, monitor=self._monitor)
        if told is not None:
            points = told.outline.points.copy()
            points[[0, -1]] = ends
            run, size = Contour.silently(points, closed=False), told.start.spline.n_control_points
        start = balanced_start(run, size, degree, rounds=0, ask=self._monitor.ends)
        found = minimized(
            run,
            start,
            named_solver(DEFAULT_METHOD)[0],
            ends="fixed",
            stray_weight=STRAY_WEIGHT,
            limits=FINAL_LIMITS,
            ask=self._monitor.ends,
        )
        return as_piece(found.spline)

    def _meet(self, before: Smoothed, left: FloatArray, after: Smoothed, right: FloatArray) -> None:
        """Ends two runs where they cross if continued, or half-way if that is beyond the noise."""
        reach = NOISE_BAND * self._noise
        crossing = crossing_of(before.continued(-1), after.continued(0))
        corner = left[-1] + 0.5 * (right[0] - left[-1])
        u, v = before.tangent(-1), after.tangent(0)
        if crossing is not None and np.hypot(*(crossing.point - corner)) <= reach:
            corner, u, v = crossing
        for points, direction in ((left, u), (right, -v)):
            away = points - corner
            beyond = (away @ direction > 0) & (np.hypot(away[:, 0], away[:, 1]) <= reach)
            points[beyond] = corner
        left[-1] = right[0] = corner

    def _cost(self, corners: list[int], near: int) -> float:
        """Of the runs that hold a point."""
        return sum(self._run(*run).cost for run in self._beside(corners, near))

    def _beside(self, corners: list[int], near: int) -> list[tuple[int, int]]:
        """The runs that hold a point, one that begins there last."""
        n = len(self._contour)
        runs = [
            (begin, end) for begin, end in self._cut(corners) if (near - begin) % n < end - begin
        ]
        return sorted(runs, key=lambda run: run[0] % n == near)

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
            self._known[begin, end] = self._smoothed(begin, end, None)
        return self._known[begin, end]

    def _smoothed(self, begin: int, end: int, size: int | None) -> Smoothed:
        """Points from one to before another, smoothed to a size, or to that which costs least."""
        n = len(self._contour)
        if end - begin == n and self._contour.closed:
            run = self._contour
        else:
            points = self._contour.points[np.arange(begin, end) % n]
            run = Contour.silently(points, closed=False)
        if len(run) <= self._degree + 1 or (size is not None and size <= self._degree):
            return straight_line(run, self._noise)
        if size is None:
            return cheapest(sizes_tried(run, self._degree, self._noise, monitor=self._monitor))
        return smoothed_to(size, run, self._degree, self._noise, monitor=self._monitor)


class Crossing(NamedTuple):
    """Where two curves cross and their unit directions there."""

    point: FloatArray
    before: FloatArray
    after: FloatArray

    @property
    def turn(self) -> float:
        """Angle between the curves, radians, whichever way they go."""
        (ux, uy), (vx, vy) = self.before, self.after
        return float(np.arctan2(abs(ux * vy - uy * vx), abs(ux * vx + uy * vy)))


def crossing_of(before: FloatArray, after: FloatArray) -> Crossing | None:
    """Where two polynomials cross near 0, None if they do not; coefficients (k, 2) each."""
    at = np.zeros(2)
    for _ in range(CROSSING_STEPS):
        (p, u), (q, v) = (_of_polynomial(c, t) for c, t in zip((before, after), at, strict=True))
        turn = u[0] * v[1] - u[1] * v[0]
        if abs(turn) <= LEAST_CROSSING * np.hypot(*u) * np.hypot(*v) or np.abs(at).max() > 1.0:
            return None
        gap = q - p
        at = at + np.array([gap[0] * v[1] - gap[1] * v[0], gap[0] * u[1] - gap[1] * u[0]]) / turn
    (p, u), (_, v) = (_of_polynomial(c, t) for c, t in zip((before, after), at, strict=True))
    return Crossing(p, u / np.hypot(*u), v / np.hypot(*v))


def _of_polynomial(coefficients: FloatArray, at: float) -> tuple[FloatArray, FloatArray]:
    """Point and derivative."""
    powers = at ** np.arange(len(coefficients))
    slopes = np.arange(1, len(coefficients)) * powers[:-1]
    return powers @ coefficients, slopes @ coefficients[1:]
