"""A contour cut at its corners into runs, each smoothed once by least squares."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import NOISE_BAND, find_corners
from shapespline.engines.least_squares import Smoothed, smoothed, straight_line
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.monitor import Monitor
    from shapespline.typing import FloatArray, IntArray

# A corner is one of n places: two runs must be cheaper than one by so many log n (FIT-28).
CORNER_PRICE = 1.5


class Runs:
    """A contour cut at corners, each run smoothed once."""

    def __init__(self, contour: Contour, degree: int, noise: float, monitor: Monitor) -> None:
        self._contour, self._degree, self._noise = contour, degree, noise
        self._monitor = monitor
        self._known: dict[tuple[int, int], Smoothed] = {}

    def kept_corners(self) -> IntArray:
        """Corners of the data, the faintest first given up where one run costs no more than two."""
        found = find_corners(self._contour, NOISE_BAND * self._noise)
        kept = found.indices.tolist()
        for corner in sorted(kept, key=lambda i: float(found.turns[i])):
            others = [i for i in kept if i != corner]
            price = CORNER_PRICE * np.log(len(self._contour))
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
            away = points - corner
            beyond = (away @ direction > 0) & (np.hypot(away[:, 0], away[:, 1]) <= reach)
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
                straight_line(run, self._noise)
                if few
                else smoothed(run, self._degree, self._noise, monitor=self._monitor)
            )
        return self._known[begin, end]
