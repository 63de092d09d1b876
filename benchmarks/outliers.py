"""Outliers put onto clean outlines: how many are found, and how many points are accused wrongly.

python -m benchmarks.outliers [FOLDER of outlines]
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from shapespline import Contour
from shapespline.analysis.outliers import find_outliers

OUTLINES = Path(__file__).resolve().parents[1] / "examples" / "data" / "outlines"
PARTS, REACHES = (0.01, 0.05), (0.01, 0.03, 0.1, 0.2)


def outlines(folder: Path) -> list[tuple[str, Contour]]:
    """Every outline of a folder by its name."""
    found = []
    for path in sorted(folder.glob("*.csv")):
        points = np.loadtxt(path, delimiter=",")
        found.append((path.stem, Contour.silently(points, not path.stem.endswith("_open"))))
    return found


def contaminated(
    contour: Contour, part: float, reach: float, seed: int
) -> tuple[Contour, set[int]]:
    """The contour with a part of its inner points moved by a part of the diagonal, and which."""
    random = np.random.default_rng(seed)
    points = contour.points.copy()
    count = max(1, round(part * len(points)))
    moved = random.choice(np.arange(1, len(points) - 1), count, replace=False)
    angle = random.uniform(0, 2 * np.pi, count)
    points[moved] += reach * contour.box_diagonal * np.column_stack([np.cos(angle), np.sin(angle)])
    return Contour.silently(points, contour.closed), set(moved.tolist())


def main() -> None:
    """Print a line for each part and reach."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path, nargs="?", default=OUTLINES, help="of outlines")
    shapes = outlines(parser.parse_args().folder)
    clean = {name: len(find_outliers(contour)) for name, contour in shapes}
    accused = {name: count for name, count in clean.items() if count}
    n_points = sum(len(contour) for _, contour in shapes)
    print(f"{len(shapes)} clean outlines, {n_points} points: {sum(clean.values())} accused")
    print("  " + ", ".join(f"{name} {count}" for name, count in accused.items()))
    print("part  reach  moved  found  wrongly accused")
    for part in PARTS:
        for reach in REACHES:
            n_moved = n_found = n_wrong = 0
            for seed, (_, contour) in enumerate(shapes):
                data, moved = contaminated(contour, part, reach, seed)
                found = set(find_outliers(data).tolist())
                n_moved += len(moved)
                n_found += len(found & moved)
                n_wrong += len(found - moved)
            share = n_found / n_moved
            print(f"{part:4.0%}  {reach:5.0%}  {n_moved:5d}  {share:5.1%}  {n_wrong:6d}")


if __name__ == "__main__":
    main()
