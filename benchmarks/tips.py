"""Corners between curves among noise, without a tolerance: which come back, and which are none.

    python -m benchmarks.tips                three noises, 300, 1000 and 5000 points, three seeds
    python -m benchmarks.tips --seeds 10

Lenses with tips of 60 to 140 degrees, a drop, a heart; and smooth shapes, which have none. A tip is
found where the curve has a corner within 2 % of the box diagonal, once: a second one there is a
blunt tip and counts as false.
"""

from __future__ import annotations

import argparse
import warnings
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import shapespline as ss
from benchmarks.estimation import scaled, shaken

if TYPE_CHECKING:
    from numpy.typing import NDArray

SIZES, PERCENTS = (300, 1000, 5000), (0.05, 0.2, 1.0)
NEAR = 2.0  # per cent of the box diagonal, which is 100


class Drawn(NamedTuple):
    """A dense outline and where it has corners."""

    outline: ss.Contour
    tips: NDArray[np.float64]


def drawn(points: NDArray[np.float64], *tips: tuple[float, float]) -> Drawn:
    """An outline with a box diagonal of 100, its corners with it."""
    contour = ss.Contour(points, closed=True)
    return Drawn(scaled(contour), np.reshape(tips, (-1, 2)) * (100 / contour.box_diagonal))


def lens(degrees: float) -> Drawn:
    """Two arcs that meet at so many degrees."""
    half = np.radians(degrees) / 2
    angle = np.linspace(-half, half, 4000)[:-1]
    above = np.column_stack([np.sin(angle), np.cos(angle) - np.cos(half)]) / np.sin(half)
    return drawn(np.concatenate([above, -above]), (-1, 0), (1, 0))


def shapes() -> dict[str, Drawn]:
    """Outlines with tips, then without."""
    t = np.linspace(0, 2 * np.pi, 8000, endpoint=False)
    c, s = np.cos(t), np.sin(t)
    drop = np.column_stack([c, 0.56 * s * np.abs(np.sin(t / 2))])
    heart = np.column_stack(
        [16 * s**3, 13 * c - 5 * np.cos(2 * t) - 2 * np.cos(3 * t) - np.cos(4 * t)]
    )
    wavy = (10 + 1.5 * np.sin(5 * t + 0.3) + 0.9 * np.sin(3 * t))[:, None]
    petals = (10 + 2.2 * np.cos(5 * t))[:, None]
    return {
        "lens, 60 degrees": lens(60),
        "lens, 110 degrees": lens(110),
        "lens, 140 degrees": lens(140),
        "drop": drawn(drop, (1, 0)),
        "heart": drawn(heart, (0, 5), (0, -17)),
        "waves": drawn(wavy * np.column_stack([4 * c, 3 * s])),
        "ellipse 5:1": drawn(np.column_stack([5 * c, s])),
        "petals": drawn(petals * np.column_stack([c, s])),
    }


def counted(fit: ss.Fit, tips: NDArray[np.float64]) -> tuple[int, int]:
    """Tips that came back, and corners that are none or too many."""
    corners = fit.spline(np.asarray(fit.corners)) if len(fit.corners) else np.empty((0, 2))
    far = np.hypot(*(corners[:, None] - tips[None]).transpose(2, 0, 1))
    found = int((far.min(axis=0, initial=np.inf) <= NEAR).sum())
    return found, len(corners) - found


def main(arguments: list[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seeds", type=int, default=3, help="noises of each kind")
    n_seeds = parser.parse_args(arguments).seeds
    warnings.simplefilter("ignore")
    print("## Tips found of those that are there, false corners (points stored)\n")
    print("| shape | " + " | ".join(f"noise {percent} %" for percent in PERCENTS) + " |")
    print("|---|" + "---|" * len(PERCENTS))
    total = np.zeros((len(PERCENTS), 3), dtype=int)
    for name, (outline, tips) in shapes().items():
        cells = []
        for k, percent in enumerate(PERCENTS):
            sums, stored = np.zeros(3, dtype=int), []
            for n in SIZES:
                clean = outline.resampled(n)
                for seed in range(n_seeds):
                    fit = ss.fit_curve(shaken(clean, percent, seed))
                    sums += [*counted(fit, tips), len(tips)]
                    stored.append(fit.n_stored_points)
            total[k] += sums
            cells.append(f"{sums[0]} of {sums[2]}, {sums[1]} ({np.median(stored):.0f})")
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)
    print("| all | " + " | ".join(f"{a} of {c}, {b}" for a, b, c in total) + " |")


if __name__ == "__main__":
    main()
