"""Unordered points: what comes back of the true order.

python -m benchmarks.ordering            a table
python -m benchmarks.ordering FOLDER     also a picture of every set
"""

from __future__ import annotations

import argparse
import itertools
import time
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import shapespline as ss
from benchmarks.quality import LARGE, OWN

HEADER = (
    "| set | points | true neighbours found | outlines | outliers | confidence | noise | s |\n"
    "|---|---|---|---|---|---|---|---|"
)


def adjacent(order: list[int], closed: bool) -> set[frozenset[int]]:
    """Pairs of neighbours."""
    pairs = {frozenset(pair) for pair in itertools.pairwise(order)}
    return pairs | {frozenset((order[-1], order[0]))} if closed else pairs


def ordered_sets() -> list[tuple[str, np.ndarray, bool]]:
    """Outlines whose order is known."""
    paths = [*sorted(OWN.glob("*.csv")), *sorted((LARGE / "truth_curves").glob("*_c?.csv"))]
    sets = []
    for path in paths:
        points = np.loadtxt(path, delimiter=",")
        points = points[np.sort(np.unique(points, axis=0, return_index=True)[1])]
        closed = not path.stem.endswith("_open") and ss.Contour(points).closed
        sets.append((path.stem, points, closed))
    return sets


def table(folder: Path | None) -> None:
    """One line a set."""
    print(HEADER)
    exact, sets = 0, ordered_sets()
    for name, points, closed in sets:
        shuffle = np.random.default_rng(0).permutation(len(points))
        began = time.perf_counter()
        try:
            found = ss.order_points(points[shuffle])
        except ss.OrderError as error:
            print(f"| {name} | {len(points)} | refused: {error} | | | | | |")
            continue
        seconds = time.perf_counter() - began
        pairs = set()
        for indices, contour in zip(found.indices, found.shape, strict=True):
            pairs |= adjacent(shuffle[indices].tolist(), contour.closed)
        true = adjacent(list(range(len(points))), closed)
        exact += true <= pairs
        _line(name, len(points), f"{len(true & pairs) / len(true):.4f}", found, seconds)
        if folder is not None:
            _draw(points, found, folder / f"{name}.png")
    print(f"\n{exact} of {len(sets)} sets of known order come back whole.\n")
    print(HEADER)
    clouds = [*sorted((LARGE / "pointsets").glob("*.csv")),
              *sorted((LARGE / "truth_curves").glob("*cloud*.csv"))]  # fmt: skip
    for path in clouds:
        points = np.loadtxt(path, delimiter=",")
        began = time.perf_counter()
        try:
            found = ss.order_points(points)
        except ss.OrderError as error:
            print(f"| {path.stem} | {len(points)} | refused: {error} | | | | | |")
            continue
        _line(path.stem, len(points), "unknown", found, time.perf_counter() - began)
        if folder is not None:
            _draw(points, found, folder / f"{path.stem}.png")
    t = np.linspace(0, 2 * np.pi, 100_000, endpoint=False)
    ring = np.column_stack([np.cos(t) * (3 + np.cos(5 * t)), np.sin(t) * (3 + np.cos(5 * t))])
    began = time.perf_counter()
    found = ss.order_points(np.random.default_rng(0).permutation(ring))
    _line("100 000 points", len(ring), "", found, time.perf_counter() - began)


def _line(name: str, count: int, part: str, found: ss.Ordering, seconds: float) -> None:
    print(
        f"| {name} | {count} | {part} | {len(found.shape)} | {len(found.outliers)}"
        f" | {found.confidence:.3f} | {found.noise:.3g} | {seconds:.2f} |",
        flush=True,
    )


def _draw(points: np.ndarray, found: ss.Ordering, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure = Figure(figsize=(8, 8), layout="constrained")
    axes = figure.subplots()
    axes.plot(*points.T, ".", color="#8A8A8A", ms=3)
    for contour in found.shape:
        axes.plot(*contour.polyline.T, lw=1)
    axes.set_aspect("equal")
    figure.savefig(path, dpi=80)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path, nargs="?", help="for a picture of each ordering")
    table(parser.parse_args().folder)
