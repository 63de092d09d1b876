"""Plates of random forms and places, level or not: what comes back of points and pictures.

    python -m benchmarks.drawn.random_plates

Regular ones have edges at right angles and fillets of one or two radii, some corners sharp;
irregular ones have no two directions and no two radii alike. How many fits have the lines and arcs
that were drawn and nothing else, and how far the curves are from what was drawn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

import shapespline as ss
from benchmarks.drawn import tables
from benchmarks.drawn.few_points import fitted, is_outline, is_right, said
from benchmarks.drawn.found import Found
from benchmarks.drawn.renderers import RENDERERS
from benchmarks.drawn.shapes import rounded
from benchmarks.drawn.truth import Arc, placed, sampled

if TYPE_CHECKING:
    from benchmarks.drawn.truth import Array, Outline

# Corners, sides up to one; forms are drawn so many times each.
FORMS = {
    "L": [(0, 0), (1, 0), (1, 0.35), (0.4, 0.35), (0.4, 0.9), (0, 0.9)],
    "T": [
        *((0.35, 0), (0.65, 0), (0.65, 0.6), (1, 0.6)),
        *((1, 0.9), (0, 0.9), (0, 0.6), (0.35, 0.6)),
    ],
    "U": [(0, 0), (1, 0), (1, 0.8), (0.7, 0.8), (0.7, 0.3), (0.3, 0.3), (0.3, 0.8), (0, 0.8)],
    "Z": [(0, 0), (0.6, 0), (0.6, 0.4), (1, 0.4), (1, 0.8), (0.35, 0.8), (0.35, 0.35), (0, 0.35)],
    "box": [(0, 0), (1, 0), (1, 0.6), (0, 0.6)],
    "steps": [
        (0, 0),
        (1, 0),
        (1, 0.3),
        (0.7, 0.3),
        (0.7, 0.55),
        (0.35, 0.55),
        (0.35, 0.8),
        (0, 0.8),
    ],
}
DRAWS = 6
# Sizes; radii of fillets, what corners of irregular plates are off by, both parts of the size; how
# many corners have the usual fillet, and none of the others.
SIZE, RADII, SHAKEN, USUAL, SHARP = 100.0, (0.04, 0.06, 0.08), 0.02, 0.7, 0.5
# Points without noise, and tolerances over the box diagonal; noise over that, and points.
COUNTS, TOLERANCES = (300, 1000), (None, 0.001, 0.003)
NOISES = ((0.0002, 200), (0.001, 200), (0.005, 200), (0.002, 400), (0.001, 1000), (0.005, 1000))
# Noise, points and a tolerance.
WITHIN = ((0.0002, 400, 0.001), (0.0002, 400, 0.003), (0.0002, 1000, 0.001), (0.0005, 1000, 0.003))
# Pictures: renderers and pixels.
PICTURED, PIXELS = (tables.EXACT, "Cairo", tables.JPEG), (128, 256, 512)
# Step of a dense sampling, and the part of it that distances are measured from.
STEP, EVERY = 0.02, 5


def plate(form: str, draw: int, *, regular: bool) -> Outline:
    """A rounded polygon, level in half of the draws."""
    random = _random(form, draw)
    corners = np.array(FORMS[form])
    usual = random.choice(RADII)
    if regular:
        others = np.where(random.random(len(corners)) < SHARP, 0.0, 1.5 * usual)
        radii = np.where(random.random(len(corners)) < USUAL, usual, others)
    else:
        corners = corners + random.normal(0, SHAKEN, corners.shape)
        radii = usual * random.uniform(0.6, 1.4, len(corners))
    turn = 0.0 if draw % 2 else random.uniform(0, np.pi)
    turned = corners @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    return rounded((SIZE * turned).tolist(), (SIZE * radii).tolist())


def points_of(dense: Array, count: int, noise: float, random: np.random.Generator) -> Array:
    """Points at equal steps, shaken by a part of the box diagonal."""
    points = ss.Contour(dense, closed=True).resampled(count).points
    return points + random.normal(0, noise * _diagonal(dense), points.shape)


def clean_table() -> str:
    """Right fits of points without noise."""
    cells = [(tolerance, count) for tolerance in TOLERANCES for count in COUNTS]
    heads = [f"{said(tolerance)}, {count}" for tolerance, count in cells]
    lines = [f"Right of {DRAWS * len(FORMS)} | " + " | ".join(heads)]
    lines.append("|".join(["---"] * (1 + len(cells))))
    for regular in (True, False):
        right = dict.fromkeys(cells, 0)
        for form, draw in _all():
            outline = plate(form, draw, regular=regular)
            dense = sampled(outline, STEP)
            for tolerance, count in cells:
                points = points_of(dense, count, 0.0, _random(form, draw))
                right[tolerance, count] += is_right(points, outline, tolerance)
        lines.append(f"{_kind(regular)} | " + " | ".join(map(str, right.values())))
    return "".join(f"| {line} |\n" for line in lines)


def noisy_table() -> str:
    """Right fits of noisy points, and the distance to the plate in deviations."""
    heads = [f"{100 * noise:g} %, {count}" for noise, count in NOISES]
    lines = [f"Right of {DRAWS * len(FORMS)}, distance | " + " | ".join(heads)]
    lines.append("|".join(["---"] * (1 + len(NOISES))))
    for regular in (True, False):
        cells = []
        for noise, count in NOISES:
            right, off = 0, []
            for form, draw in _all():
                outline = plate(form, draw, regular=regular)
                dense = sampled(outline, STEP)
                fit = fitted(points_of(dense, count, noise, _random(form, draw)), None)
                right += is_outline(fit, outline)
                away = cKDTree(Found.of_fits([fit]).curve).query(dense[::EVERY])[0]
                off.append(float(np.sqrt((away**2).mean())) / (noise * _diagonal(dense)))
            cells.append(f"{right}, {np.exp(np.mean(np.log(off))):.2f}")
        lines.append(f"{_kind(regular)} | " + " | ".join(cells))
    return "".join(f"| {line} |\n" for line in lines)


def within_table() -> str:
    """Right fits of noisy points within a tolerance, and stored points over the drawing's own."""
    heads = [f"{100 * noise:g} %, {count}, {said(within)}" for noise, count, within in WITHIN]
    lines = [f"Right of {DRAWS * len(FORMS)}, points | " + " | ".join(heads)]
    lines.append("|".join(["---"] * (1 + len(WITHIN))))
    for regular in (True, False):
        cells = []
        for noise, count, within in WITHIN:
            right, stored, own = 0, 0, 0
            for form, draw in _all():
                outline = plate(form, draw, regular=regular)
                points = points_of(sampled(outline, STEP), count, noise, _random(form, draw))
                fit = fitted(points, within)
                right += is_outline(fit, outline)
                stored += fit.n_stored_points
                own += sum(2 if isinstance(one, Arc) else 1 for one in outline)
            cells.append(f"{right}, {stored / own:.2f}")
        lines.append(f"{_kind(regular)} | " + " | ".join(cells))
    return "".join(f"| {line} |\n" for line in lines)


def pictures_table() -> str:
    """Right fits of traced pictures."""
    cells = [(tolerance, size) for tolerance in tables.TOLERANCES for size in PIXELS]
    heads = [f"{'none' if tolerance is None else tolerance}, {size}" for tolerance, size in cells]
    lines = [f"Right of {DRAWS * len(FORMS)} | " + " | ".join(heads)]
    lines.append("|".join(["---"] * (1 + len(cells))))
    for renderer in PICTURED:
        for regular in (True, False):
            right = dict.fromkeys(cells, 0)
            for form, draw in _all():
                outline = plate(form, draw, regular=regular)
                for size in PIXELS:
                    outlines = placed([outline], size, 0.0, seed=draw)
                    traced = ss.trace(RENDERERS[renderer](outlines, size))
                    for tolerance in tables.TOLERANCES:
                        fits = [ss.fit_curve(one, tolerance=tolerance) for one in traced]
                        right[tolerance, size] += len(fits) == 1 and is_outline(fits[0], outline)
            found = " | ".join(map(str, right.values()))
            lines.append(f"{renderer}, {_kind(regular)} | {found}")
    return "".join(f"| {line} |\n" for line in lines)


def _all() -> list[tuple[str, int]]:
    return [(form, draw) for form in FORMS for draw in range(DRAWS)]


def _random(form: str, draw: int) -> np.random.Generator:
    return np.random.default_rng([draw, *form.encode()])


def _diagonal(points: Array) -> float:
    return float(np.hypot(*np.ptp(points, axis=0)))


def _kind(regular: bool) -> str:
    return "regular" if regular else "irregular"


if __name__ == "__main__":
    print(clean_table())
    print(noisy_table())
    print(within_table())
    print(pictures_table())
