"""The single spline: points, distances, time and fairness, beside splprep in the same run.

``python -m benchmarks.removal`` prints the table on the outlines that come with the project;
``python -m benchmarks.removal FOLDER`` takes every outline of a folder (``_open`` in the name says
open) instead.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from scipy.interpolate import BSpline, splprep

import shapespline as ss
from benchmarks.foundation import DATA, median_seconds
from shapespline.analysis import NormalizedContour
from shapespline.engines.spline import SplineAttempt, attempts
from shapespline.engines.spline.engine import LEVELS
from shapespline.geometry import Distances, two_sided_distance
from shapespline.monitor import Monitor
from shapespline.values.curve import BSplineCurve

PEERS = ("hand620_closed", "leaf840_closed", "plane1100_closed", "loop500_open")
# Control points to reach without fairness, at 0.1 and 0.5 % of the box diagonal.
TARGETS = {
    "hand620_closed": (38, 27),
    "leaf840_closed": (58, 33),
    "plane1100_closed": (38, 28),
    "loop500_open": (12, 10),
    "wiggly10000_closed": (58, 0),
}
TOLERANCES = (0.1, 0.5)


def wiggly(n: int) -> ss.Contour:
    """The wiggly closed curve of the peers' table."""
    t = 2 * np.pi * np.arange(n) / n
    r = 10 + 1.5 * np.sin(5 * t + 0.3) + 0.9 * np.sin(13 * t + 1) + 0.35 * np.sin(29 * t)
    return scaled(np.column_stack([r * np.cos(t), 0.8 * r * np.sin(t)]), closed=True)


def scaled(points: np.ndarray, *, closed: bool) -> ss.Contour:
    """A contour of box diagonal 100."""
    return ss.Contour(points * (100 / np.hypot(*np.ptp(points, axis=0))), closed=closed)


def outlines(folder: Path, names: tuple[str, ...]) -> dict[str, ss.Contour]:
    """Contours of a folder, named after their files; no names mean all."""
    paths = [folder / f"{name}.csv" for name in names] or sorted(folder.glob("*.csv"))
    return {
        path.stem: scaled(np.loadtxt(path, delimiter=","), closed=not path.stem.endswith("_open"))
        for path in paths
    }


def best_splprep(contour: ss.Contour, tolerance: float) -> tuple[int, float]:
    """Fewest points of splprep within the tolerance both ways, and seconds for one call."""
    best, best_s = 0, 0.0
    for factor in np.geomspace(1e-3, 10, 25):
        s = factor * len(contour) * tolerance**2
        curve = splprep_curve(contour, s)
        found = two_sided_distance(curve, contour)
        if found.hausdorff_distance <= tolerance:
            best, best_s = curve.n_control_points, s
    seconds = median_seconds(lambda: splprep(contour.polyline.T, s=best_s, per=contour.closed), 5)
    return best, seconds


def splprep_curve(contour: ss.Contour, s: float) -> BSplineCurve:
    """Its cubic spline as a curve of ours."""
    (knots, coefficients, degree), _ = splprep(contour.polyline.T, s=s, per=contour.closed)
    c = np.transpose(coefficients)
    if contour.closed:
        return BSplineCurve(knots, c[: len(c) - degree], degree, periodic=True)
    return BSplineCurve.from_scipy(BSpline(knots, c, degree))


def best_attempt(
    contour: ss.Contour, tolerance: float, effort: str, *, fair: bool
) -> tuple[SplineAttempt, Distances]:
    """The last spline that the engine tries, told after each whether it keeps the tolerance."""
    options = {"degree": 3, "effort": effort, "monitor": Monitor(), "fair": fair}
    tried = attempts(contour, NormalizedContour.of(contour), tolerance, **options)
    attempt = next(tried)
    while True:
        found = two_sided_distance(attempt.curve, contour)
        try:
            attempt = tried.send(found.hausdorff_distance <= tolerance)
        except StopIteration:
            return attempt, found


def row(name: str, contour: ss.Contour, tolerance: float, effort: str, *, fair: bool) -> str:
    """One line of the table."""

    def call() -> tuple[SplineAttempt, Distances]:
        return best_attempt(contour, tolerance, effort, fair=fair)

    (attempt, found), seconds = call(), median_seconds(call, 3)
    report, kept = attempt.fairness, found.hausdorff_distance <= tolerance
    return (
        f"| {name} | {tolerance} | {effort} | {'yes' if fair else 'no'}"
        f" | {attempt.curve.n_control_points}"
        f" | {found.max_distance:.4f} | {found.reverse_distance:.4f}"
        f" | {'' if kept else 'MISSED'} | {1e3 * seconds:.0f} | {report.interval_ratio:.0f}"
        f" | {report.speed_ratio:.3f} | {report.n_crossings} ({report.n_data_crossings}) |"
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path, nargs="?", help="of outlines, the project's if none")
    folder = parser.parse_args().folder
    if folder is not None:
        contours = outlines(folder, ())
    else:
        contours = outlines(DATA / "outlines", PEERS) | {"wiggly10000_closed": wiggly(10_000)}
    print("## One cubic B-spline, both distances certified (box diagonal 100)\n")
    print(
        "| outline | tolerance | effort | fair | points | max | reverse | kept | ms | gap ratio"
        " | slowest / median speed | crossings (data) |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for name, contour in contours.items():
        for i, tolerance in enumerate(TOLERANCES):
            points, seconds = best_splprep(contour, tolerance)
            target = TARGETS.get(name, (0, 0))[i]
            print(
                f"| {name} | {tolerance} | splprep, best s | | {points} | | | | {1e3 * seconds:.1f}"
                f" | | to reach: {target or '-'} | |"
            )
            for effort in LEVELS:
                for fair in (False, True):
                    print(row(name, contour, tolerance, effort, fair=fair), flush=True)
    print()


if __name__ == "__main__":
    main()
