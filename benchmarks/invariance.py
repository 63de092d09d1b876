"""The same outline from elsewhere: what changes in its fit, and by how much.

    python -m benchmarks.invariance             the project's own corpus
    python -m benchmarks.invariance --all       the outlines of ../shared/data beside it, too
    python -m benchmarks.invariance --every 2   each second of all

Again, reversed and from another first point the curve must be the same to the bit; turned, mirrored
and scaled outlines are others, but for rounding not to a person: their stored points are compared.
The exit code is 1 if a bit changed.
"""

from __future__ import annotations

import argparse
import warnings
from typing import TYPE_CHECKING

import numpy as np

import shapespline as ss
from benchmarks.quality import large_corpus, own_corpus

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from benchmarks.quality import Outline

    Array = NDArray[np.float64]

PART = 0.001  # of the box diagonal
# Radians, and a factor that is no power of two.
TURN, SCALE = 0.7, 3.7
# What is counted as another size.
FAR = 0.05


def main() -> int:
    """Prints what changed its bits, and the table of sizes."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.invariance")
    parser.add_argument("--all", action="store_true", help="the large corpus, too")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--character", choices=("drawn", "fewest"), default="fewest")
    asked = parser.parse_args()
    outlines = [*own_corpus(), *(large_corpus() if asked.all else ())][:: asked.every]
    changed: dict[str, list[str]] = {"again": [], "direction": [], "start": []}
    ratios: dict[str, list[tuple[float, str]]] = {"turned": [], "mirrored": [], "scaled": []}
    for outline in outlines:
        contour = outline.contour
        tolerance = PART * contour.box_diagonal
        once = fitted(contour.points, contour.closed, tolerance, asked.character)
        for name, points in same(outline):
            again = fitted(points, contour.closed, tolerance, asked.character)
            if points_of(again) != points_of(once):
                changed[name].append(outline.name)
        for name, points, scale in alike(outline):
            other = fitted(points, contour.closed, scale * tolerance, asked.character)
            ratios[name].append((other.n_stored_points / once.n_stored_points, outline.name))
    print(f"{len(outlines)} outlines, 0.1 %, {asked.character}")
    for name, names in changed.items():
        print(f"{name}: {len(names)} changed {' '.join(names[:8])}")
    print("| | mean | smallest | largest | farther than 5 % |")
    print("|---" * 5 + "|")
    for name, found in ratios.items():
        sizes = np.array([size for size, _ in found])
        far = [other for size, other in found if abs(size - 1) > FAR]
        figures = f"{sizes.mean():.4f} | {sizes.min():.3f} | {sizes.max():.3f}"
        print(f"| {name} | {figures} | {len(far)}: {' '.join(far[:5])} |")
    return int(any(changed.values()))


def fitted(points: Array, closed: bool, tolerance: float, character: str) -> ss.Fit:
    """The balanced fit of an outline."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ss.fit_curve(points, closed=closed, tolerance=tolerance, character=character)


def same(outline: Outline) -> list[tuple[str, Array]]:
    """The points in other orders."""
    points, n = outline.contour.points, len(outline.contour)
    orders = [("again", points.copy()), ("direction", points[::-1].copy())]
    if outline.contour.closed:
        orders.append(("start", np.roll(points, n // 3, axis=0)))
    return orders


def alike(outline: Outline) -> list[tuple[str, Array, float]]:
    """The outline turned, mirrored and scaled, and by how much its tolerance grows with it."""
    points = outline.contour.points
    c, s = np.cos(TURN), np.sin(TURN)
    return [
        ("turned", points @ np.array([[c, s], [-s, c]]), 1.0),
        ("mirrored", points * [-1.0, 1.0], 1.0),
        ("scaled", points * SCALE, SCALE),
    ]


def points_of(fit: ss.Fit) -> list[tuple[float, ...]]:
    """All control points of a fit, whichever comes first."""
    points = np.concatenate([piece.control_points for piece in fit.pieces])
    return sorted(map(tuple, points.tolist()))


if __name__ == "__main__":
    raise SystemExit(main())
