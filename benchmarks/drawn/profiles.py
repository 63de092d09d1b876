"""Points of profiles, straight edges and free-form ones between corners, with noise and without.

Half of them were looked at while constants were chosen; the others, marked, were not. Each draw is
turned by another angle, the first half of the draws are level.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

import shapespline as ss
from benchmarks.drawn.tables import SAMPLINGS
from benchmarks.drawn.truth import Arc, Cubic, Line, sampled

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from benchmarks.drawn.truth import Array, Outline

# Samples of a fit, and the step of those of a drawing 100 wide.
SAMPLES, STEP = 3000, 0.01
# Tolerances over the box diagonal and numbers of points without noise, so many that corners between
# them are near enough to their chords; a piece shorter than that part of it is none of a profile.
CLEAN = (
    *((None, n) for n in (200, 500, 2000)),
    (0.001, 2000),
    *((0.005, n) for n in (200, 500, 2000)),
)
BIT = 0.02


def _outline(start: tuple[float, float], *steps: Sequence[tuple[float, float]]) -> Outline:
    """Lines to one point, cubics to three, back to the start."""
    elements: list[Line | Arc | Cubic] = []
    at = np.array(start, dtype=float)
    for step in steps:
        points = np.array([at, *step], dtype=float)
        elements.append(Line(*points) if len(points) == 2 else Cubic(points))
        at = points[-1]
    return tuple(elements)


PROFILES: dict[str, Outline] = {
    "cover": _outline(
        (0, 0),
        [(100, 0)],
        [(100, 37)],
        [(80, 20), (70, 38), (50, 40)],
        [(30, 42), (20, 58), (0, 43)],
        [(0, 0)],
    ),
    "knife": _outline(
        (0, 0),
        [(0, 20)],
        [(110, 20)],
        [(100, 5), (75, -6), (40, -6)],
        [(40, 0)],
        [(0, 0)],
    ),
    "flag": _outline(
        (0, 0),
        [(0, 60)],
        [(30, 75), (60, 45), (100, 60)],
        [(100, 0)],
        [(60, -15), (30, 15), (0, 0)],
    ),
    "lute": _outline(
        (0, 0),
        [(0, 60)],
        [(25, 50), (75, 75), (75, 30)],
        [(75, 0), (25, -10), (0, 0)],
    ),
    "sail (aside)": _outline(
        (0, 0), [(0, 95)], [(20, 70), (50, 35), (60, 6)], [(40, -4), (20, -2), (0, 0)]
    ),
    "spade (aside)": _outline(
        (-8, 100),
        [(8, 100)],
        [(8, 45)],
        [(30, 45)],
        [(32, 20), (18, 5), (0, -5)],
        [(-18, 5), (-32, 20), (-30, 45)],
        [(-8, 45)],
        [(-8, 100)],
    ),
    "saddle (aside)": _outline(
        (0, 0), [(90, 0)], [(90, 40)], [(70, 10), (25, 15), (0, 50)], [(0, 0)]
    ),
    "hull (aside)": _outline(
        (0, 30), [(120, 34)], [(110, 10), (80, 0), (60, 0)], [(35, 0), (10, 8), (0, 30)]
    ),
}


def noisy_profile(
    name: str, draw: int, draws: int
) -> Iterator[tuple[tuple[float, int], Array, Array]]:
    """Sampling, points and the drawing's own dense points, of each sampling."""
    random = np.random.default_rng(draw)
    turn = 0.0 if draw < draws / 2 else float(random.uniform(0.0, 2.0 * np.pi))
    own = [one.moved(1.0, turn, np.zeros(2)) for one in PROFILES[name]]
    dense = sampled(own, STEP)
    size = float(np.hypot(*np.ptp(dense, axis=0)))
    for noise, n in SAMPLINGS:
        points = ss.Contour(dense, closed=True).resampled(n).points
        yield (noise, n), points + random.normal(0, 0.01 * noise * size, (n, 2)), dense


def profiles_table(draws: int = 10) -> str:
    """How often a fit has the profile's edges and curves, and how far it is from the truth."""
    heads = [f"{noise} %, {n}" for noise, n in SAMPLINGS]
    lines = ["profile, edges | " + " | ".join(heads), "|".join(["---"] * (1 + len(heads)))]
    for name, outline in PROFILES.items():
        edges = sum(isinstance(one, Line) for one in outline)
        right = dict.fromkeys(SAMPLINGS, 0)
        ratios: dict[tuple[float, int], list[float]] = {key: [] for key in SAMPLINGS}
        for draw in range(draws):
            for key, points, dense in noisy_profile(name, draw, draws):
                drawn = ss.fit_curve(points, closed=True)
                kinds = [piece.kind for piece in drawn.pieces]
                right[key] += kinds.count("line") == edges and "arc" not in kinds
                fewest = ss.fit_curve(points, closed=True, character="fewest")
                tree = cKDTree(dense)
                ratios[key].append(_far(drawn, tree) / _far(fewest, tree))
        means = [float(np.exp(np.mean(np.log(ratios[key])))) for key in SAMPLINGS]
        cells = [f"{right[key]}, {mean:.2f}" for key, mean in zip(SAMPLINGS, means, strict=True)]
        lines.append(f"{name}, {edges} | " + " | ".join(cells))
    return "".join(f"| {line} |\n" for line in lines)


def clean_profile(name: str, draw: int, draws: int, n: int) -> ss.Contour:
    """Points without noise that begin anywhere, so that corners lie between them."""
    random = np.random.default_rng(draw)
    turn = 0.0 if draw < draws / 2 else float(random.uniform(0.0, 2.0 * np.pi))
    own = [one.moved(1.0, turn, np.zeros(2)) for one in PROFILES[name]]
    dense = sampled(own, STEP)
    dense = np.roll(dense, int(random.integers(len(dense))), axis=0)
    return ss.Contour(dense, closed=True).resampled(n)


def clean_table(draws: int = 10) -> str:
    """Points without noise: how many fits have the profile's edges and curves, and no bit more."""
    heads = [f"{f'{100 * within:g} %' if within else 'none'}, {n}" for within, n in CLEAN]
    lines = ["profile, edges | " + " | ".join(heads), "|".join(["---"] * (1 + len(heads)))]
    for name, outline in PROFILES.items():
        edges = sum(isinstance(one, Line) for one in outline)
        cells = []
        for within, n in CLEAN:
            right = 0
            for draw in range(draws):
                contour = clean_profile(name, draw, draws, n)
                size = contour.box_diagonal
                fit = ss.fit_curve(contour, tolerance=within and within * size)
                found = [piece.kind for piece in fit.pieces]
                bits = any(piece.polygon_length < BIT * size for piece in fit.pieces)
                right += found.count("line") == edges and "arc" not in found and not bits
            cells.append(str(right))
        lines.append(f"{name}, {edges} | " + " | ".join(cells))
    return "".join(f"| {line} |\n" for line in lines)


def _far(fit: ss.Fit, tree: cKDTree) -> float:
    """Root mean square distance of a curve from the truth."""
    distances = tree.query(fit.curve(np.linspace(0.0, 1.0, SAMPLES)))[0]
    return float(np.sqrt((distances**2).mean()))


if __name__ == "__main__":
    print(profiles_table())
    print(clean_table())
