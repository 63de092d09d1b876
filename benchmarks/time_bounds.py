"""How long a fit may take: outlines of up to 2000 points that are hard, and the corpus.

    python -m benchmarks.time_bounds             hard outlines and the project's own corpus
    python -m benchmarks.time_bounds --all       every outline of ../shared/data beside it
    python -m benchmarks.time_bounds --every 10  each tenth of them
    python -m benchmarks.time_bounds --hard      the hard outlines alone
    python -m benchmarks.time_bounds --single    a few outlines that times were asked for, alone

Seconds of the processor, one thread: other work on the machine does not count; of the corpus the
median of three runs. The exit code is 1 if a hard outline takes longer than two seconds.
"""

from __future__ import annotations

import argparse
import time
import warnings
from typing import TYPE_CHECKING

import numpy as np

import shapespline as ss
from benchmarks.attack.shapes import along
from benchmarks.drawn.catalogue import drawings
from benchmarks.drawn.tables import rendered
from benchmarks.peers import splprep_points
from benchmarks.quality import large_corpus, own_corpus
from benchmarks.scale import wiggly

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

# What is promised of outlines of up to so many points, balanced.
SECONDS, POINTS = 2.0, 2000
TOLERANCES = (0.0002, 0.001, 0.005, 0.02)
PERCENTILES = (50, 90, 95, 99, 100)
# Of the corpus: runs of each outline, of which the median counts.
REPEATS = 3
# Of single outlines: runs of which the best counts; pictures (pixels), their tolerance, and how
# many points outlines have that are looked at.
RUNS, PIXELS, WITHIN, LONG = 5, 256, 0.35, (800, 1200)


def hard_outlines(seed: int) -> Iterator[tuple[str, NDArray[np.float64], bool]]:
    """Name, points and closed: outlines that have nothing to go by, or too much."""
    rng = np.random.default_rng(seed)
    for n in (500, POINTS):
        yield f"walk of {n}", np.cumsum(rng.normal(0, 1, (n, 2)), axis=0), False
        yield f"closed walk of {n}", np.cumsum(rng.normal(0, 1, (n, 2)), axis=0), True
        yield f"scattered {n}", rng.normal(0, 1, (n, 2)), True
        t = np.linspace(0, 2 * np.pi, n, endpoint=False)
        ring = np.column_stack([np.cos(t), 0.6 * np.sin(t)])
        for noise in (0.001, 0.01):
            yield f"noisy ring of {n}, {noise}", ring + rng.normal(0, noise, ring.shape), True
        teeth = 1 + 0.2 * (np.arange(n) % 20 < 10)
        yield f"cogs of {n}", teeth[:, None] * ring, True
        yield f"scribble of {n}", np.column_stack([np.sin(17 * t), np.sin(23 * t + 1)]), True
        yield (
            f"spiral of {n}",
            t[1:, None] * np.column_stack([np.cos(9 * t), np.sin(9 * t)])[1:],
            False,
        )
        smooth = np.cumsum(np.cumsum(rng.normal(0, 1, (n, 2)), axis=0), axis=0)
        yield f"smooth walk of {n}", smooth, False
        chain = np.round(60 * along(ring * (1 + 0.2 * np.sin(7 * t))[:, None], n, closed=True))
        yield f"pixels of {n}", chain[(chain != np.roll(chain, 1, axis=0)).any(axis=1)], True


def seconds_of(points: NDArray[np.float64], *, closed: bool, tolerance: float) -> tuple[float, int]:
    """Time of the processor for a balanced fit, and its stored points."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        contour = ss.Contour(points, closed)
        began = time.process_time()
        fit = ss.fit_curve(contour, tolerance=tolerance * contour.box_diagonal)
    return time.process_time() - began, fit.n_stored_points


def main() -> int:
    """Prints the table of the hard ones, and percentiles over the corpus."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.time_bounds")
    parser.add_argument("--all", action="store_true", help="the large corpus, too")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--hard", action="store_true", help="without a corpus")
    parser.add_argument("--single", action="store_true", help="single outlines alone")
    parser.add_argument("--seeds", type=int, default=3)
    asked = parser.parse_args()
    seconds_of(np.random.default_rng(0).normal(0, 1, (50, 2)), closed=True, tolerance=0.01)
    if asked.single:
        _print_single()
        return 0
    rows = [
        (seconds_of(points, closed=closed, tolerance=tolerance)[0], name, tolerance, seed)
        for seed in range(asked.seeds)
        for name, points, closed in hard_outlines(seed)
        for tolerance in TOLERANCES
    ]
    rows.sort(reverse=True)
    print("| seconds | outline | tolerance | seed |\n|---|---|---|---|")
    for seconds, name, tolerance, seed in rows[:15]:
        print(f"| {seconds:.2f} | {name} | {100 * tolerance:g} % | {seed} |")
    if not asked.hard:
        _print_corpus(asked)
    return int(rows[0][0] > SECONDS)


def best_of(contour: ss.Contour, tolerance: float) -> float:
    """Milliseconds of the processor for a fit, the best of some runs."""
    each = []
    for _ in range(RUNS):
        began = time.process_time()
        ss.fit_curve(contour, tolerance=tolerance)
        each.append(1000 * (time.process_time() - began))
    return min(each)


def _print_single() -> None:
    (leaf,) = (outline.contour for outline in own_corpus() if outline.name == "leaf840_closed")
    wave = ss.Contour(wiggly(200), closed=True)
    print("| | ms | asked |\n|---|---|---|")
    print(f"| leaf of 840 points, 0.1 % | {best_of(leaf, 0.001 * leaf.box_diagonal):.0f} | 60 |")
    print(f"| wave of 200 points, 0.1 % | {best_of(wave, 0.001 * wave.box_diagonal):.0f} | 15 |")
    traced = [
        contour
        for name in drawings()
        for contour in ss.trace(rendered(name, PIXELS)[1])
        if LONG[0] <= len(contour) <= LONG[1]
    ]
    each = [best_of(contour, WITHIN) for contour in traced]
    said = f"outlines of {LONG[0]} to {LONG[1]} points of pictures, within {WITHIN}"
    print(f"| {len(each)} {said}: median, most | {np.median(each):.0f}, {max(each):.0f} | 40 |")


def _print_corpus(asked: argparse.Namespace) -> None:
    outlines = [*own_corpus(), *(large_corpus() if asked.all else ())][:: asked.every]
    # All of ours first: threads of a library that splprep calls go on for a while.
    ours = [
        np.median(
            [
                seconds_of(outline.contour.points, closed=outline.contour.closed, tolerance=0.001)[
                    0
                ]
                for _ in range(REPEATS)
            ]
        )
        for outline in outlines
    ]
    theirs = []
    for outline in outlines:
        contour = outline.contour
        tolerance = 0.001 * contour.box_diagonal
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            peer = splprep_points(contour.points, closed=contour.closed, tolerance=tolerance)
        theirs.append(peer.seconds if peer else np.nan)
    at = ", ".join(f"{p} %: {1000 * np.percentile(ours, p):.0f} ms" for p in PERCENTILES)
    ratio = np.nanmedian(np.array(ours) / np.array(theirs))
    print(f"{len(ours)} outlines at 0.1 %: {at}; median of the ratio to a splprep call {ratio:.2f}")


if __name__ == "__main__":
    raise SystemExit(main())
