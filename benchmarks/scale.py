"""Time and memory against the number of points, the tolerance and the number of control points.

    python -m benchmarks.scale              all tables, up to 10 000 000 points; some minutes
    python -m benchmarks.scale --most 8     up to 10^8 points, from a file of 1.6 GB
    python -m benchmarks.scale --figures F  also the plots of docs/performance.md

One thread, but where two processes are named. The curve is the wiggly one of the peers' table, with
a box diagonal of 100; splprep runs in the same process at the s that gives it the same maximum.
"""

from __future__ import annotations

import argparse
import functools
import gc
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
import warnings
from concurrent.futures import ProcessPoolExecutor
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.interpolate import splev, splprep
from scipy.spatial import cKDTree

import shapespline as ss
from benchmarks.peers import polyline_points, splprep_points
from benchmarks.quality import LARGE, OWN, large_corpus

if TYPE_CHECKING:
    from collections.abc import Callable

# The coastlines' tolerances, parts of the box diagonal, coarse to fine.
COAST_PARTS = (0.005, 0.002, 0.001, 0.0005, 0.0002, 0.0001)
DENSE = np.linspace(0, 1, 200_000)
COASTS = ("ne10m_iceland", "gshhg_h_newfoundland", "gshhg_f_hokkaido")


class Run(NamedTuple):
    """One size: seconds and stored points of ours, seconds of one splprep call."""

    n: int
    seconds: float
    n_points: int
    kept: bool
    splprep: float


def wiggly(n: int, begin: int = 0, end: int | None = None) -> np.ndarray:
    """Some points of n on the wiggly closed curve, box diagonal 100."""
    t = 2 * np.pi * np.arange(begin, n if end is None else end) / n
    r = 10 + 1.5 * np.sin(5 * t + 0.3) + 0.9 * np.sin(13 * t + 1) + 0.35 * np.sin(29 * t)
    return np.column_stack([r * np.cos(t), 0.8 * r * np.sin(t)]) * WIGGLY_SCALE


WIGGLY_SCALE = 1.0
WIGGLY_SCALE = 100.0 / float(np.hypot(*np.ptp(wiggly(100_000), axis=0)))


def median_of(call: Callable[[], object], runs: int) -> float:
    """Median seconds of some calls."""
    seconds = []
    for _ in range(runs):
        began = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - began)
    return statistics.median(seconds)


@functools.cache
def splprep_knob() -> float:
    """The largest sum of squares a point that keeps 0.1, found on 10 000 of them."""
    return splprep_points(wiggly(10_000), closed=True, tolerance=0.1).knob / 10_000


def splprep_seconds(points: np.ndarray, runs: int) -> float:
    """One call of splprep on a closed outline."""
    s = splprep_knob() * len(points)
    track = np.concatenate([points, points[:1]]).T
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return median_of(lambda: splprep(track, s=s, per=True), runs)


def exponent(x: list[float], y: list[float]) -> float:
    """Slope of the line through the logarithms."""
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def by_size(effort: str, most: int) -> list[Run]:
    """The wiggly curve at 0.1, a thousandth of its diagonal."""
    runs = []
    for n in [200, 840] + [10**k for k in range(3, most + 1)]:
        repeats = 5 if n <= 1e5 else 3 if n <= 1e6 else 1
        if n <= 1e6:
            points = wiggly(n)
            fit = ss.fit_curve(points, closed=True, tolerance=0.1, effort=effort)
            seconds = median_of(
                lambda p=points: ss.fit_curve(p, closed=True, tolerance=0.1, effort=effort),
                repeats,
            )
            peer = splprep_seconds(points, min(repeats, 3))
        else:
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "wiggly.npy"
                _fill(path, n)
                mapped = np.load(path, mmap_mode="r")
                began = time.perf_counter()
                fit = ss.fit_large(mapped, closed=True, tolerance=0.1, effort=effort)
                seconds, peer = time.perf_counter() - began, float("nan")
        runs.append(Run(n, seconds, fit.n_stored_points, fit.kept, peer))
    return runs


def _fill(path: Path, n: int) -> None:
    mapped = np.lib.format.open_memmap(path, mode="w+", dtype=np.float64, shape=(n, 2))
    for begin in range(0, n, 1 << 20):
        end = min(n, begin + (1 << 20))
        mapped[begin:end] = wiggly(n, begin, end)
    mapped.flush()  # the file is there before the time begins


def sizes(most: int) -> dict[str, list[Run]]:
    """Print the table of sizes."""
    found = {effort: by_size(effort, most) for effort in ("balanced", "fast")}
    print("## One outline, tolerance 0.1 % of the diagonal; above 10^6 points from a file\n")
    print("| points | effort | stored points | kept | s | ns a point | splprep s | times faster |")
    print("|---|---|---|---|---|---|---|---|")
    for effort, runs in found.items():
        for run in runs:
            print(
                f"| {run.n} | {effort} | {run.n_points} | {'yes' if run.kept else 'NO'}"
                f" | {run.seconds:.4f} | {1e9 * run.seconds / run.n:.0f} | {run.splprep:.4f}"
                f" | {run.splprep / run.seconds:.2f} |"
            )
    for effort, runs in found.items():
        large = [run for run in runs if run.n >= 10_000]
        slope = exponent([run.n for run in large], [run.seconds for run in large])
        last, before = large[-1], large[-2]
        print(
            f"\n{effort}: exponent in n from 10^4 on {slope:.2f}; the last step"
            f" {exponent([before.n, last.n], [before.seconds, last.seconds]):.2f}"
        )
    return found


def tolerances() -> None:
    """Print points and time against the tolerance."""
    points = wiggly(100_000)
    print("\n## 100 000 points against the tolerance, balanced\n")
    print("| tolerance, % | stored points | kept | s |\n|---|---|---|---|")
    for percent in (0.5, 0.2, 0.1, 0.05, 0.02, 0.01):
        fit = ss.fit_curve(points, closed=True, tolerance=percent)
        seconds = median_of(lambda p=percent: ss.fit_curve(points, closed=True, tolerance=p), 3)
        print(f"| {percent} | {fit.n_stored_points} | {fit.kept} | {seconds:.3f} |")


def noisy() -> None:
    """Print what points that scatter cost."""
    print("\n## 300 000 points that scatter, tolerance 0.1 % of the diagonal\n")
    print("| standard deviation, tolerances | stored points | kept | s |\n|---|---|---|---|")
    for part in (0.01, 0.05, 0.1, 0.17):
        scatter = np.random.default_rng(1).normal(0, 0.1 * part, (300_000, 2))
        began = time.perf_counter()
        fit = ss.fit_curve(wiggly(300_000) + scatter, closed=True, tolerance=0.1)
        seconds = time.perf_counter() - began
        print(f"| {part} | {fit.n_stored_points} | {fit.kept} | {seconds:.2f} |")


def passes() -> None:
    """Print a fit of a million points in passes that find their residuals and do nothing else."""
    points = wiggly(1_000_000)
    fit = ss.fit_curve(points, closed=True, tolerance=0.1)
    one = median_of(lambda: fit.spline(fit.parameters) - points, 5)
    whole = median_of(lambda: ss.fit_curve(points, closed=True, tolerance=0.1), 5)
    polyline = polyline_points(points, closed=True, tolerance=0.1).seconds
    print(
        f"\nwhole fit of 1 000 000 points, balanced: {whole / one:.1f} residual passes,"
        f" {whole / (2 * polyline):.2f} of two Douglas-Peucker passes in numpy"
    )


def squares() -> None:
    """Print least squares over all points beside those of a sample, and beside splprep's."""
    print("\n## 120 control points by least squares, scatter 0.3: how far from the true curve\n")
    print("| points | fit_large s | passes | rms | 20 000 of them | splprep, even knots, s | rms |")
    print("|---|---|---|---|---|---|---|")
    truth = wiggly(5000)

    def off(curve: object) -> float:
        return float(np.sqrt(np.mean(cKDTree(curve(DENSE)).query(truth)[0] ** 2)))

    for n in (100_000, 1_000_000):
        points = wiggly(n) + np.random.default_rng(0).normal(0, 0.3, (n, 2))
        began = time.perf_counter()
        fit = ss.fit_large(points, closed=True, n_control_points=120)
        seconds = time.perf_counter() - began
        sample = ss.fit_curve(points[:: n // 20_000], closed=True, n_control_points=120)
        track = np.concatenate([points, points[:1]]).T
        knots, u = np.linspace(0, 1, 121), np.linspace(0, 1, n + 1)
        began = time.perf_counter()
        (tck, _), *_ = splprep(track, u=u, t=knots, task=-1, per=True, full_output=True)
        peer = time.perf_counter() - began
        print(
            f"| {n} | {seconds:.2f} | {fit.history[-1].evaluations} | {off(fit.curve):.4f}"
            f" | {off(sample.curve):.4f} | {peer:.2f}"
            f" | {off(lambda u, tck=tck: np.column_stack(splev(u, tck))):.4f} |"
        )


def coastlines() -> list[tuple[str, int, float]]:
    """Print time against the number of control points."""
    print("\n## Coastlines, balanced: time against stored points\n")
    print("| coast | data points | tolerance, % | stored points | kept | s |")
    print("|---|---|---|---|---|---|")
    found = []
    for name in COASTS:
        path = LARGE / "gis" / f"{name}.csv"
        if not path.exists():
            print(f"| {name} | the large corpus is not at {LARGE} | | | | |")
            continue
        contour = ss.Contour.silently(np.loadtxt(path, delimiter=","), closed=True)
        for part in COAST_PARTS:
            began = time.perf_counter()
            fit = ss.fit_curve(contour, tolerance=part * contour.box_diagonal)
            seconds = time.perf_counter() - began
            found.append((name, fit.n_stored_points, seconds))
            print(
                f"| {name} | {len(contour)} | {100 * part:g} | {fit.n_stored_points}"
                f" | {fit.kept} | {seconds:.2f} |",
                flush=True,
            )
    if found:
        slope = exponent([n for _, n, _ in found], [s for _, _, s in found])
        print(f"\nexponent in the number of stored points: {slope:.2f}")
    return found


def small_outlines() -> None:
    """Print glyphs and icons fitted in a second."""
    paths = sorted(path for path in OWN.glob("*.csv") if not path.stem.endswith("_open"))
    contours = [ss.Contour(np.loadtxt(path, delimiter=","), closed=True) for path in paths]
    if (LARGE / "manifest.csv").exists():
        kinds = ("glyphs", "icons")
        contours = [o.contour for o in large_corpus() if o.category in kinds and o.contour.closed]
    print(f"\n## Many small outlines: {len(contours)} glyphs and icons, tolerance 0.5 %\n")
    heads = ("points each", "effort", "character", "median, ms", "a second, one core")
    print(f"| {' | '.join(heads)} | with two processes | ratio |\n|---|---|---|---|---|---|---|")
    for count in (None, 200):
        given = [c if count is None else c.resampled(min(count, len(c))) for c in contours] * (
            1 if count is None else 4
        )
        for effort, character in product(("balanced", "fast"), ("fewest", "drawn")):
            options = {"tolerance": "0.5%", "effort": effort, "character": character}
            ss.fit_many(given[:5], **options)
            each = 1e3 * statistics.median(
                median_of(lambda c=c, o=options: ss.fit_curve(c, **o), 1) for c in given
            )
            one = len(given) / median_of(lambda g=given, o=options: ss.fit_many(g, **o), 3)
            with ProcessPoolExecutor(2) as pool:
                ss.fit_many(given, executor=pool, **options)
                two = len(given) / median_of(
                    lambda g=given, o=options, p=pool: ss.fit_many(g, executor=p, **o), 3
                )
            mean = np.mean([len(c) for c in given])
            print(
                f"| {mean:.0f} | {effort} | {character} | {each:.1f} | {one:.0f} | {two:.0f}"
                f" | {two / one:.2f} |"
            )


def memory(most: int) -> None:
    """Print the peak memory over the input, each in a process of its own."""
    print("\n## Peak memory\n")
    print("| | points | over the input, MB | bytes a point |\n|---|---|---|---|")
    for how, n in (
        ("fit_curve, in memory", 1_000_000),
        ("fit_large, a file", 10**most),
        ("fit_large, a file, least squares", 10**most),
    ):
        done = subprocess.run(
            [sys.executable, "-m", "benchmarks.scale", "--child", how, str(n)],
            capture_output=True,
            text=True,
            check=True,
            env=os.environ | {"OMP_NUM_THREADS": "1"},
        )
        extra = json.loads(done.stdout)
        print(f"| {how} | {n} | {extra / 1e6:.0f} | {extra / n:.1f} |")


def child(how: str, n: int) -> None:
    """The process whose memory is looked at."""
    ss.fit_curve(wiggly(1000), closed=True, tolerance=0.1)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "wiggly.npy"
        if "file" in how:
            script = f"from benchmarks.scale import _fill, Path; _fill(Path({str(path)!r}), {n})"
            subprocess.run([sys.executable, "-c", script], check=True)
            points = np.load(path, mmap_mode="r")
        else:
            points = wiggly(n)
        gc.collect()
        Path("/proc/self/clear_refs").write_text("5")  # the peak begins here
        before = _resident("VmRSS")
        fit = ss.fit_large if "file" in how else ss.fit_curve
        wanted = {"n_control_points": 120} if "squares" in how else {"tolerance": 0.1}
        fit(points, closed=True, **wanted)
        print(_resident("VmHWM") - before)


def _resident(name: str) -> int:
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(name):
            return 1024 * int(line.split()[1])
    raise SystemExit("peak memory is read from /proc/self/status: run this on Linux")


def draw(found: dict[str, list[Run]], coasts: list[tuple[str, int, float]], folder: Path) -> None:
    """The plots of docs/performance.md."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    for (effort, runs), color in zip(found.items(), ("#0B6E99", "#D97706"), strict=True):
        left.loglog([r.n for r in runs], [r.seconds for r in runs], "o-", color=color, label=effort)
    peers = [r for r in found["balanced"] if np.isfinite(r.splprep)]
    left.loglog([r.n for r in peers], [r.splprep for r in peers], "s--", color="#6B7280",
                label="splprep, one call")  # fmt: skip
    left.set(xlabel="data points", ylabel="seconds", title="Wiggly curve, 0.1 %")
    for name, color in zip(COASTS, ("#0B6E99", "#D97706", "#15803D"), strict=True):
        some = [(n, s) for coast, n, s in coasts if coast == name]
        if some:
            right.loglog(*zip(*some, strict=True), "o-", color=color, label=name)
    right.set(xlabel="stored points", ylabel="seconds", title="Coastlines, 0.5 to 0.01 %")
    for axes in (left, right):
        axes.grid(alpha=0.3)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(frameon=False)
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / "performance.png", dpi=110)


def everything(most: int) -> tuple[dict[str, list[Run]], list[tuple[str, int, float]]]:
    """Print all tables; what the plots show."""
    found = sizes(most)
    tolerances()
    noisy()
    passes()
    squares()
    coasts = coastlines()
    small_outlines()
    memory(most)
    return found, coasts


def main() -> None:
    """Read the arguments, measure, print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--most", type=int, default=7, help="power of ten of points, 6 to 8")
    parser.add_argument("--figures", type=Path, help="a folder for the plots")
    parser.add_argument("--child", nargs=2, help=argparse.SUPPRESS)
    chosen = parser.parse_args()
    if chosen.child:
        child(chosen.child[0], int(chosen.child[1]))
        return
    found, coasts = everything(chosen.most)
    if chosen.figures is not None:
        draw(found, coasts, chosen.figures)


if __name__ == "__main__":
    main()
