"""What the foundation must reach: kernels, memory, and the methods against each other.

Every section prints a table; times are medians of several runs, ratios are formed in one run.
"""

from __future__ import annotations

import gc
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import BSpline, splprep

import shapespline as ss
from checks import distance_to_curve, two_sided
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.paper.run import run_paper, timed_start
from shapespline.solvers.iteration import Limits

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.monitor import Iteration

DATA = Path(__file__).parent.parent / "examples" / "data"
EQUAL_COUNT = (("hand620_closed", 36), ("leaf840_closed", 70), ("loop500_open", 24))
PAPER = (("leaf840", 2), ("palm620", 3), ("airplane1100", 4))


def outline(name: str, folder: str = "outlines", *, closed: bool = True) -> ss.Contour:
    """A contour of the project's own corpus."""
    return ss.Contour(np.loadtxt(DATA / folder / f"{name}.csv", delimiter=","), closed=closed)


def median_seconds(call: Callable[[], object], runs: int = 7, inner: int = 1) -> float:
    """Median over runs of the mean time of ``inner`` calls, after one call to warm up."""
    call()
    times = []
    for _ in range(runs):
        began = time.perf_counter()
        for _ in range(inner):
            call()
        times.append((time.perf_counter() - began) / inner)
    return statistics.median(times)


def flower(n: int) -> ss.Contour:
    """A wavy closed curve of n points."""
    t = 2 * np.pi * np.arange(n) / n
    r = 10 + 2 * np.cos(5 * t) + 0.7 * np.sin(12 * t)
    return ss.Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)


def initial_curve_time() -> None:
    """The initial curve of 840 points."""
    contour = outline("leaf840_closed")
    fresh = median_seconds(
        lambda: ss.initial_curve(ss.Contour(contour.points, closed=True), length=8), 15, 20
    )
    print("## Initial curve, 840 points (validation of the input included)\n")
    print(f"{1e3 * fresh:.2f} ms (to reach: 1 ms)\n")


def kernel_times() -> None:
    """Cost, gradient and Levenberg-Marquardt step, beside the same sums by scipy and numpy."""
    print("## Kernels, 100 000 points, 40 control points, one thread: ns a point\n")
    print("| degree | cost | cost and gradient | step | scipy and numpy | ratio |")
    print("|---|---|---|---|---|---|")
    contour = flower(100_000)
    for degree in (1, 2, 3, 5, 9):
        start = ss.initial_curve(contour, arc_length=2.0, degree=degree)
        problem = CurveProblem(contour.points, start.spline)
        x = problem.pack(start.spline.control_points, start.parameters)
        nano = 1e9 / len(contour)
        cost = nano * median_seconds(lambda p=problem, x=x: p.cost(x))
        gradient = nano * median_seconds(lambda p=problem, x=x: p.cost_and_gradient(x))
        step = nano * median_seconds(lambda p=problem, x=x: p.damped_step(x, 1e-3))
        peer = nano * median_seconds(lambda p=problem, x=x: scipy_gradient(p, x), 3)
        print(
            f"| {degree} | {cost:.1f} | {gradient:.1f} | {step:.1f} | {peer:.0f}"
            f" | {peer / gradient:.0f} |"
        )
    print("\n(to reach: cost and gradient under 30 at degree 3)\n")


def scipy_gradient(problem: CurveProblem, x: np.ndarray) -> tuple[float, np.ndarray]:
    """Cost and gradient of a periodic problem from scipy's design matrix."""
    control_points, parameters = problem.unpack(x)
    template = problem.template
    u = np.mod(parameters, 1.0)
    design = BSpline.design_matrix(u, template.knots, template.degree)
    curve = template.to_scipy()
    residuals = design @ curve.c - problem.points
    unrolled = design.T @ residuals
    folded = np.zeros_like(control_points)
    np.add.at(folded, np.arange(len(unrolled)) % len(folded), unrolled)
    along = (residuals * curve(u, nu=1)).sum(axis=1)
    return 0.5 * float((residuals**2).sum()), np.concatenate([folded.ravel(), along])


def million_points() -> None:
    """Direct D-BFGS on a million points: time and peak memory, in a process of its own."""
    print("## Direct D-BFGS, 1 000 000 points, 25 iterations\n")
    done = subprocess.run(
        [sys.executable, "-m", "benchmarks.foundation", "million"],
        capture_output=True,
        text=True,
        check=True,
        env=os.environ | {"OMP_NUM_THREADS": "1"},
    )
    print(done.stdout)


def run_million() -> None:
    """The child process of million_points."""
    n = 1_000_000
    points = np.array(flower(n).points)
    # Everything is imported and every buffer of the first call is made before the reading.
    ss.optimize(flower(1000), ss.initial_curve(flower(1000), 8), "d-bfgs")
    gc.collect()
    before = resident("VmRSS")
    began = time.perf_counter()
    contour = ss.Contour(points, closed=True)
    start = ss.initial_curve(contour, arc_length=2.0)
    limits = Limits(max_iterations=25, relative_decrease=0.0, gradient_tolerance=0.0)
    fit = ss.optimize(contour, start, "d-bfgs", limits=limits)
    seconds = time.perf_counter() - began
    extra = (resident("VmHWM") - before) / n
    first, last = fit.history[0], fit.history[-1]
    print(
        f"{seconds:.1f} s in all, {last.seconds:.1f} s in {last.iteration} iterations with"
        f" {last.evaluations} evaluations; E {first.paper_error:.4g} -> {last.paper_error:.4g};\n"
        f"peak memory over the input: {extra:.0f} bytes a point (to reach: 250)\n"
    )


def resident(name: str) -> int:
    """A field of /proc/self/status in bytes (Linux)."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(name):
            return 1024 * int(line.split()[1])
    raise SystemExit("peak memory is read from /proc/self/status: run this on Linux")


# The literal run is counted until it is this near its end, not until it stops.
NEAR_ITS_END = 1.01


def first_within(fit: ss.Fit, error: float) -> Iteration:
    """The first record of a fit with no larger error (but for rounding), else its last."""
    met = (record for record in fit.history if record.paper_error <= error * (1 + 1e-12))
    return next(met, fit.history[-1])


def literal_against_sensible() -> None:
    """Evaluations that direct D-BFGS from the sensible start needs to the literal run's error."""
    print("## The literal reading and the sensible one: evaluations to the same error\n")
    print("Literal: until it is within 1 % of the error that it ends at. Sensible: to that error,")
    print("from the start of `shapespline paper`, the plain problem.\n")
    print(
        "| outline, L | literal: points | E end | evaluations | sensible: points | E start |",
        end="",
    )
    print(" evaluations | part |\n|---|---|---|---|---|---|---|---|")
    for name, length in PAPER:
        contour = outline(name, "paper")
        literal = run_paper(contour, length, reading=ss.LITERAL)
        near = first_within(literal.fit, NEAR_ITS_END * literal.final_error)
        start = timed_start(contour, length).start
        target = Limits(
            target_cost=literal.fit.history[-1].cost,
            max_evaluations=5000,
            max_iterations=5000,
            relative_decrease=1e-9,
        )
        history = ss.optimize(contour, start, "d-bfgs", limits=target).history
        reached = history[-1].cost <= literal.fit.history[-1].cost
        print(
            f"| {name}, {length} | {literal.fit.n_control_points} | {literal.final_error:.4f}"
            f" | {near.evaluations} | {start.n_control_points} | {history[0].paper_error:.4f}"
            f" | {history[-1].evaluations if reached else 'not reached'}"
            f" | {history[-1].evaluations / near.evaluations:.5f} |"
        )
    print("\n(to reach: a part below 0.1)\n")


def equal_count() -> None:
    """Errors and times at an equal number of control points, splprep in the same run."""
    print("## Equal number of control points (box diagonal 100)\n")
    print("Two-sided by a dense sampler that shares nothing with the package.\n")
    print("| outline, points | rms | two-sided | ms | splprep: rms | two-sided | ms |")
    print("|---|---|---|---|---|---|---|")
    for name, count in EQUAL_COUNT:
        contour = outline(name, closed=name.endswith("closed"))
        fit = ss.fit_curve(contour, n_control_points=count)
        ours = median_seconds(lambda c=contour, k=count: ss.fit_curve(c, n_control_points=k), 5)
        curve, s = splprep_at(contour, count)
        theirs = median_seconds(lambda c=contour, s=s: splprep(c.polyline.T, s=s, per=c.closed), 5)
        print(
            f"| {name}, {count} | {_errors(fit.curve, contour)} | {1e3 * ours:.0f}"
            f" | {_errors(curve, contour)} | {1e3 * theirs:.1f} |"
        )
    print()


def _errors(curve: BSpline, contour: ss.Contour) -> str:
    """Root mean square and two-sided distance of a curve, as two cells."""
    distance = distance_to_curve(contour.points, curve, 0.01)
    both = two_sided(curve, contour.points, closed=contour.closed, step=0.01)
    return f"{np.sqrt((distance**2).mean()):.4f} | {both.larger:.3f}"


def splprep_at(contour: ss.Contour, count: int) -> tuple[BSpline, float]:
    """Splprep at the smallest s for which it needs no more than ``count`` points."""
    low, high = 1e-6, 1e6
    for _ in range(50):
        s = float(np.sqrt(low * high))
        (knots, _, degree), _ = splprep(contour.polyline.T, s=s, per=contour.closed)
        points = len(knots) - degree - 1 - (degree if contour.closed else 0)
        low, high = (s, high) if points > count else (low, s)
    (knots, coefficients, degree), _ = splprep(contour.polyline.T, s=high, per=contour.closed)
    return BSpline(knots, np.transpose(coefficients), degree), high


def main() -> None:
    """Print every section."""
    initial_curve_time()
    kernel_times()
    literal_against_sensible()
    equal_count()
    million_points()


if __name__ == "__main__":
    if sys.argv[1:] == ["million"]:
        run_million()
    else:
        main()
