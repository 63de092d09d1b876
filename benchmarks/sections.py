"""The structured fit on the shapes of the peers: points, distances, time, corners and joints.

Time is the median of some calls; beside it the time of one splprep call that keeps the tolerance
both ways (its s found by bisection), in the same run.
"""

from __future__ import annotations

import statistics
import sys
import time
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.interpolate import splprep

import shapespline as ss
from benchmarks.foundation import outline
from shapespline.corners import find_corners
from shapespline.curve import BSplineCurve
from shapespline.distance import two_sided_distance
from shapespline.sections import fit_pieces

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.sections import PiecesResult

SHAPES = ("hand620_closed", "leaf840_closed", "plane1100_closed", "loop500_open")
PARTS = (0.001, 0.005)
# Stored points to reach, by shape and tolerance: corners kept, corners free.
TARGETS = {
    "hand620_closed": ((50, 45), (28, 27)),
    "leaf840_closed": ((66, 55), (36, 33)),
    "plane1100_closed": ((30, 30), (27, 27)),
    "loop500_open": ((16, 12), (11, 10)),
}
RUNS = 3
BISECTIONS = 14


class Timed(NamedTuple):
    """A result and the median time of the calls that made it, seconds."""

    result: PiecesResult
    seconds: float


def timed(call: Callable[[], PiecesResult]) -> Timed:
    times = []
    for _ in range(RUNS):
        began = time.perf_counter()
        result = call()
        times.append(time.perf_counter() - began)
    return Timed(result, statistics.median(times))


def splprep_at_best_s(contour: ss.Contour, tolerance: float) -> tuple[int, float]:
    """Stored points and seconds of the splprep call with the largest s that keeps the tolerance."""
    data = contour.polyline.T
    low, high = 0.0, len(contour) * tolerance**2 * 4.0
    best = (0, np.nan)
    for _ in range(BISECTIONS):
        s = 0.5 * (low + high)
        began = time.perf_counter()
        (knots, coefficients, degree), _ = splprep(data, s=s, per=contour.closed, quiet=2)
        seconds = time.perf_counter() - began
        fitted = _clamped(knots, np.array(coefficients).T, degree)
        if two_sided_distance(fitted, contour).hausdorff_distance <= tolerance:
            best, low = (len(fitted.control_points) - int(contour.closed) * degree, seconds), s
        else:
            high = s
    return best


def _clamped(knots: np.ndarray, coefficients: np.ndarray, degree: int) -> BSplineCurve:
    from scipy.interpolate import BSpline

    return BSplineCurve.from_scipy(BSpline(knots, coefficients, degree))


def worst_turn_off_corners(result: PiecesResult, contour: ss.Contour) -> float:
    """The largest turn, degrees, of joints that are none of the result's corners."""
    turns = np.abs(np.degrees(list(result.turns())))
    first = 0 if result.closed else 1
    off = [
        turn
        for piece, turn in zip(result.pieces[first:], turns, strict=True)
        if int(((contour.points - piece.control_points[0]) ** 2).sum(axis=1).argmin())
        not in result.corners
    ]
    return max(off, default=0.0)


def table(effort: str = "balanced") -> None:
    """One row a shape, tolerance and mode."""
    print(
        f"structured fit, effort {effort}; max and reverse in parts of the tolerance, corners as"
        " found / in the result, turn: worst joint off them\n"
        f"{'shape':18} {'tol %':>5} {'corners':>7} {'points':>6} {'target':>6} {'max':>6}"
        f" {'reverse':>7} {'ms':>7} {'splprep ms':>10} {'ratio':>6} {'corners':>8} {'turn':>6}"
    )
    for name in SHAPES:
        contour = outline(name, closed=name.endswith("closed"))
        for part, target in zip(PARTS, TARGETS[name], strict=True):
            tolerance = part * contour.box_diagonal
            _, peer = splprep_at_best_s(contour, tolerance)
            found = len(find_corners(contour, tolerance).indices)
            for mode, points in zip(("auto", "free"), target, strict=True):
                result, seconds = timed(
                    lambda c=contour, t=tolerance, m=mode: fit_pieces(
                        c, t, corners=m, effort=effort
                    )
                )
                d = result.distances
                print(
                    f"{name:18} {100 * part:5.1f} {mode:>7} {result.n_stored_points:6d}"
                    f" {points:6d} {d.max_distance / tolerance:6.3f}"
                    f" {d.reverse_distance / tolerance:7.3f} {1e3 * seconds:7.1f}"
                    f" {1e3 * peer:10.1f} {seconds / peer:6.1f}"
                    f" {found:4d}/{len(result.corners):<3d}"
                    f" {worst_turn_off_corners(result, contour):6.2f}",
                    flush=True,
                )


def small_contour() -> None:
    """A contour of 200 points."""
    t = 2 * np.pi * np.arange(200) / 200
    r = 10 + 2 * np.cos(5 * t) + 0.7 * np.sin(12 * t)
    contour = ss.Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)
    for part in PARTS:
        fit = timed(partial(fit_pieces, contour, part * contour.box_diagonal))
        print(
            f"200 points, tolerance {100 * part:g} %: {fit.result.n_stored_points} points,"
            f" {1e3 * fit.seconds:.1f} ms"
        )


if __name__ == "__main__":
    table(sys.argv[1] if len(sys.argv) > 1 else "balanced")
    small_contour()
