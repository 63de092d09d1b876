"""The promise and the size of the fits over a corpus, with peers in the same run.

    python -m benchmarks.quality              the project's own corpus
    python -m benchmarks.quality --all        every outline of ../shared/data beside it
    python -m benchmarks.quality --every 10   each tenth of them
    python -m benchmarks.quality --no-peers   the promise alone
    python -m benchmarks.quality --jobs 2     two outlines at a time; the times then mean less
    python -m benchmarks.quality --figures F  also pictures of the worst ten fits, to be looked at
    python -m benchmarks.quality --pin        write the sizes on the own corpus that CI holds

Every curve is checked by the outside checker, which shares nothing with the package.
"""

from __future__ import annotations

import argparse
import csv
import functools
import time
import warnings
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from tests.support import sizes

import shapespline as ss
from benchmarks.peers import polyline_points, splprep_points
from benchmarks.worst_fits import draw_fit
from checks import turns, two_sided

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from numpy.typing import NDArray

ROOT = Path(__file__).parent.parent
OWN = ROOT / "examples" / "data" / "outlines"
LARGE = ROOT.parent / "shared" / "data"
TOLERANCES = (0.5, 0.1, 0.02)  # per cent of the box diagonal
LONGEST = 20_000
# How far from a node the data are asked what they turn, tolerances.
ABOUT = 3.0
# Degrees that a joint turns which is neither smooth nor a corner.
LITTLE = (1.01, 30.0)
# What the certified bound may miss of the sampled distance: rounding alone.
SLACK = 1 + 1e-9


class Outline(NamedTuple):
    """A contour and where it is from."""

    name: str
    category: str
    contour: ss.Contour


class Row(NamedTuple):
    """One outline at one tolerance."""

    name: str
    category: str
    percent: float
    n_data: int
    n_points: int
    status: str
    relative: float  # sampled two-sided distance over the tolerance
    broken: bool
    seconds: float
    splprep: float
    splprep_seconds: float
    polyline: float
    joints: int  # beside a curve
    turning: int  # of those, turn a little: no corner, nor smooth
    turning_alone: int  # of these, where the data turn less


def own_corpus() -> Iterator[Outline]:
    """The outlines that the project carries."""
    for path in sorted(OWN.glob("*.csv")):
        closed = not path.stem.endswith("_open")
        yield Outline(path.stem, "own", ss.Contour(np.loadtxt(path, delimiter=","), closed=closed))


def large_corpus() -> Iterator[Outline]:
    """The ordered outlines beside the project; a clear end where they are missing."""
    manifest = LARGE / "manifest.csv"
    if not manifest.exists():
        raise SystemExit(f"the large corpus is not at {LARGE}: leave out --all and --every")
    with manifest.open() as file:
        rows = [row for row in csv.DictReader(file) if row["file"].endswith(".csv")]
    for row in rows:
        if "point set" in row["kind"] or int(row["points_or_pixels_or_segments"]) > LONGEST:
            continue
        points = np.loadtxt(LARGE / row["category"] / row["file"], delimiter=",")
        known = {"closed": True, "yes": True, "open": False}.get(row["closed"])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ss.DroppedPointsWarning)
            try:
                contour = ss.Contour(points, closed=known)
            except ss.DegenerateContourError:
                continue
        yield Outline(row["file"].removesuffix(".csv"), row["category"], contour)


def measure(outline: Outline, percent: float, *, peers: bool, **options: object) -> Row:
    """Fit one outline at one tolerance, check it, and ask the peers."""
    contour = outline.contour
    tolerance = percent / 100 * contour.box_diagonal
    began = time.perf_counter()
    fit = ss.fit_curve(contour, tolerance=tolerance, **options)
    seconds = time.perf_counter() - began
    found = two_sided(fit.curve, contour.points, closed=contour.closed, step=tolerance / 10)
    splprep = polyline = None
    if peers:
        asked = {"closed": contour.closed, "tolerance": tolerance}
        splprep = splprep_points(contour.points, **asked)
        polyline = polyline_points(contour.points, **asked)
    return Row(
        outline.name,
        outline.category,
        percent,
        len(contour),
        fit.n_stored_points,
        fit.status.name,
        found.larger / tolerance,
        fit.kept and found.larger > tolerance * SLACK,
        seconds,
        splprep.n_points if splprep else float("nan"),
        splprep.seconds if splprep else float("nan"),
        polyline.n_points if polyline else float("nan"),
        *joints(fit),
    )


def joints(fit: ss.Fit) -> tuple[int, int, int]:
    """Joints beside a curve, those that turn a little, and of these where the data turn less.

    One spline has none.
    """
    pieces = fit.sections
    if not pieces:
        return 0, 0, 0
    degree = np.array([piece.degree for piece in pieces])
    beside = np.maximum(degree, np.roll(degree, 1))[0 if fit.closed else 1 :] > 1
    turn = np.degrees(np.abs(turns(pieces, closed=fit.closed)))[beside]
    nodes = np.array([piece.control_points[0] for piece in pieces[0 if fit.closed else 1 :]])
    little = (turn > LITTLE[0]) & (turn < LITTLE[1])
    about = np.array([turned_about(fit, node) for node in nodes[beside]])
    return len(turn), int(little.sum()), int((about < turn)[little].sum())


def turned_about(fit: ss.Fit, node: NDArray[np.float64]) -> float:
    """Degrees between the directions of the data within ``ABOUT`` tolerances of a node."""
    track, at = fit.contour.polyline, fit.contour.arc_length
    middle = at[int(np.hypot(*(track - node).T).argmin())]
    reach = ABOUT * fit.tolerance
    first = max(int(np.searchsorted(at, middle - reach)) - 1, 0)
    last = min(int(np.searchsorted(at, middle + reach)) + 1, len(at))
    x, y = np.diff(track[first:last], axis=0).T
    return float(np.degrees(np.ptp(np.unwrap(np.arctan2(y, x)))))


def report(rows: list[Row]) -> None:
    """Ratios by tolerance and category, statuses, and the ten worst against the peers."""
    print(
        "| tolerance | outlines | points / splprep | points / polyline | time / splprep |", end=""
    )
    print(" never more than either | KEPT | broken |\n|---|---|---|---|---|---|---|---|")
    for percent in sorted({row.percent for row in rows}, reverse=True):
        _line(f"{percent} %", [row for row in rows if row.percent == percent])
    for category in sorted({row.category for row in rows}):
        _line(category, [row for row in rows if row.category == category])
    _line("all", rows)
    print("\nstatuses:", dict(Counter(row.status for row in rows)))
    n_joints, n_turning = sum(row.joints for row in rows), sum(row.turning for row in rows)
    n_less = sum(row.turning_alone for row in rows)
    print(
        f"joints beside a curve: {n_joints}, {n_turning} turn by 1 to 30 degrees,"
        f" {n_less} of them where the data turn less"
    )
    print("\nWorst ten against the better peer:")
    for row in worst(rows):
        print(
            f"  {row.category}/{row.name} at {row.percent} %: {row.n_points} points of"
            f" {row.n_data}, splprep {row.splprep:.0f}, polyline {row.polyline:.0f}"
        )
    print("\nSlowest ten:")
    for row in sorted(rows, key=lambda row: -row.seconds)[:10]:
        print(f"  {row.category}/{row.name} at {row.percent} %: {row.seconds:.2f} s, {row.n_data}")


def _line(label: str, rows: list[Row]) -> None:
    def mean(ratios: list[float]) -> float:
        known = [ratio for ratio in ratios if np.isfinite(ratio) and ratio > 0]
        return float(np.exp(np.mean(np.log(known)))) if known else float("nan")

    smaller = [row.n_points <= min(row.splprep, row.polyline) for row in rows]
    print(
        f"| {label} | {len(rows)} | {mean([row.n_points / row.splprep for row in rows]):.3f}"
        f" | {mean([row.n_points / row.polyline for row in rows]):.3f}"
        f" | {mean([row.seconds / row.splprep_seconds for row in rows]):.1f}"
        f" | {np.mean(smaller):.1%} | {np.mean([row.status == 'KEPT' for row in rows]):.1%}"
        f" | {sum(row.broken for row in rows)} |"
    )


def run(outlines: list[Outline], *, peers: bool, n_jobs: int = 1, **options: object) -> list[Row]:
    """Measure every outline at every tolerance."""
    one = functools.partial(_at_every_tolerance, peers=peers, **options)
    if n_jobs == 1:
        return [row for outline in outlines for row in one(outline)]
    with ProcessPoolExecutor(n_jobs) as pool:
        return [row for found in pool.map(one, outlines) for row in found]


def _at_every_tolerance(outline: Outline, *, peers: bool, **options: object) -> list[Row]:
    rows = [measure(outline, percent, peers=peers, **options) for percent in TOLERANCES]
    for row in rows:
        if row.broken:
            print(f"BROKEN {row}", flush=True)
    return rows


def worst(rows: list[Row], count: int = 10) -> list[Row]:
    """Fits with the most points against the better peer, the worst first."""
    return sorted(rows, key=lambda row: -row.n_points / min(row.splprep, row.polyline))[:count]


def draw_worst(
    rows: Sequence[Row], contours: Mapping[str, ss.Contour], folder: Path, **options: object
) -> list[Path]:
    """One picture for each row, named after its rank and outline; the paths."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for rank, row in enumerate(rows, start=1):
        contour = contours[row.name]
        fit = ss.fit_curve(contour, tolerance=row.percent / 100 * contour.box_diagonal, **options)
        path = folder / f"{rank:02d}_{row.name}_{row.percent:g}.png"
        title = (
            f"{row.category}/{row.name} at {row.percent:g} %: {row.n_points} points"
            f" (splprep {row.splprep:.0f}, polyline {row.polyline:.0f})"
        )
        draw_fit(fit, title).savefig(path, dpi=100)
        paths.append(path)
    return paths


def main(arguments: list[str] | None = None) -> None:
    """Read the arguments, those of the command line if none are given; measure, print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--all", action="store_true", help="the large corpus")
    parser.add_argument("--every", type=int, help="each so many-th outline of the large corpus")
    parser.add_argument("--no-peers", action="store_true", help="the promise alone")
    parser.add_argument("--jobs", type=int, default=1, help="outlines at a time")
    parser.add_argument("--figures", type=Path, help="a folder for pictures of the worst ten")
    parser.add_argument("--pin", action="store_true", help="write the sizes that CI holds")
    parser.add_argument("--form", default="pieces")
    parser.add_argument("--corners", default="auto")
    parser.add_argument("--effort", default="balanced")
    parser.add_argument("--character", choices=["drawn", "fewest"], help="what --pin holds: fewest")
    chosen = parser.parse_args(arguments)
    if chosen.pin:
        rows = run(list(own_corpus()), peers=False, n_jobs=chosen.jobs, character="fewest")
        sizes.pin({(row.name, row.percent): row.n_points for row in rows})
        return
    large = chosen.all or chosen.every
    outlines = list(large_corpus() if large else own_corpus())[:: chosen.every or 1]
    names = ("form", "corners", "effort", "character")
    options = {name: getattr(chosen, name) for name in names}
    print(f"## {len(outlines)} outlines, {options}\n")
    rows = run(outlines, peers=not chosen.no_peers, n_jobs=chosen.jobs, **options)
    report(rows)
    if chosen.figures is not None:
        contours = {outline.name: outline.contour for outline in outlines}
        for path in draw_worst(worst(rows), contours, chosen.figures, **options):
            print(path)


if __name__ == "__main__":
    main()
