"""Plates of random forms as instruments measure them: what comes back of their lines and arcs.

    python -m benchmarks.drawn.measuring

Points at even steps with errors that are normal, alike and independent come first; then uneven
steps, a stretch that is missing or was measured twice, strays, errors with long tails, larger ones
on half of the outline, in one direction alone, and such that go on from point to point. All errors
have the same root mean square but for the strays. Last come coordinates of three digits.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.drawn.few_points import fitted, is_outline, said
from benchmarks.drawn.found import Found
from benchmarks.drawn.random_plates import DRAWS, EVERY, FORMS, STEP, plate
from benchmarks.drawn.truth import sampled

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.drawn.truth import Array

    Random = np.random.Generator
    # Shares of the length where points are, and their errors in deviations.
    Way = Callable[[int, Random], tuple[Array, Array]]

# Noise over the box diagonal, and a tolerance.
SAMPLINGS = ((0.001, None), (0.0005, 0.003))
COUNT = 400
# Strays: their part, and how many deviations they are off; what is missing, or measured twice.
PART, FAR, MISSING, TWICE = 0.01, 10.0, 0.05, 0.03
ROUGHER, FREEDOM = 3.0, 3.0
# The last digit, over the longer side.
DIGIT = 1e-3


def _even(n: int, random: Random) -> tuple[Array, Array]:
    return np.arange(n) / n, random.normal(0, 1, (n, 2))


def _uneven(n: int, random: Random) -> tuple[Array, Array]:
    return np.sort(random.random(n)), random.normal(0, 1, (n, 2))


def _missing(n: int, random: Random) -> tuple[Array, Array]:
    at = (random.random() + (1 - MISSING) * np.arange(n) / n) % 1.0
    return np.sort(at), random.normal(0, 1, (n, 2))


def _twice(n: int, random: Random) -> tuple[Array, Array]:
    both = round((1 + TWICE) * n)
    return np.arange(both) / n, random.normal(0, 1, (both, 2))


def _strays(n: int, random: Random) -> tuple[Array, Array]:
    at, errors = _even(n, random)
    strays = random.choice(n, round(PART * n), replace=False)
    errors[strays] += random.normal(0, FAR, (len(strays), 2))
    return at, errors


def _long_tails(n: int, random: Random) -> tuple[Array, Array]:
    return np.arange(n) / n, random.standard_t(FREEDOM, (n, 2)) / FREEDOM**0.5


def _rough_half(n: int, random: Random) -> tuple[Array, Array]:
    at, errors = _even(n, random)
    rough = np.where(at < 0.5, ROUGHER, 1.0)
    return at, rough[:, None] * errors / np.sqrt((rough**2).mean())


def _one_direction(n: int, random: Random) -> tuple[Array, Array]:
    at, errors = _even(n, random)
    return at, errors * [2**0.5, 0.0]


def _going_on(part: float) -> Way:
    """Each error is that part of the one before, and what is new (autoregressive)."""

    def way(n: int, random: Random) -> tuple[Array, Array]:
        at, errors = _even(n, random)
        for before, after in pairwise(errors):
            after[:] = part * before + (1 - part**2) ** 0.5 * after
        return at, errors

    return way


def _filtered(n: int, random: Random) -> tuple[Array, Array]:
    at, errors = _even(n, random)
    return at, (np.roll(errors, 1, axis=0) + errors + np.roll(errors, -1, axis=0)) / 3**0.5


WAYS: dict[str, Way] = {
    "even steps, alike": _even,
    "uneven steps": _uneven,
    "5 % missing": _missing,
    "3 % measured twice": _twice,
    "1 % strays": _strays,
    "long tails": _long_tails,
    "half three times as rough": _rough_half,
    "in one direction": _one_direction,
    "going on by 0.4": _going_on(0.4),
    "going on by 0.7": _going_on(0.7),
    "means of three": _filtered,
}
FEW_DIGITS = "three digits, no noise"


def measured(dense: Array, way: str, noise: float, random: Random) -> Array:
    """Points of a closed outline, given densely, with noise over its box diagonal."""
    around = np.concatenate([dense, dense[:1]])
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(around, axis=0).T))])
    shares, errors = WAYS.get(way, _even)(COUNT, random)
    at = shares % 1.0 * stations[-1]
    points = np.column_stack([np.interp(at, stations, axis) for axis in around.T])
    if way == FEW_DIGITS:
        step = DIGIT * np.ptp(dense, axis=0).max()
        return step * np.round(points / step)
    return points + deviation_of(dense, way, noise) * errors


def deviation_of(dense: Array, way: str, noise: float) -> float:
    """Root mean square of the errors of a coordinate."""
    if way == FEW_DIGITS:
        return float(DIGIT * np.ptp(dense, axis=0).max() / 12**0.5)
    return noise * float(np.hypot(*np.ptp(dense, axis=0)))


def measuring_table() -> str:
    """Right fits of each way of measuring, and the distance to the plate in deviations."""
    kinds = ("regular", "irregular")
    heads = [f"{said(tolerance)}, {kind}" for _, tolerance in SAMPLINGS for kind in kinds]
    lines = [f"Right of {DRAWS * len(FORMS)}, distance | " + " | ".join(heads)]
    lines.append("|".join(["---"] * (1 + len(heads))))
    for way in (*WAYS, FEW_DIGITS):
        cells = [
            _cell(way, noise, tolerance, regular=kind == "regular")
            for noise, tolerance in SAMPLINGS
            for kind in kinds
        ]
        lines.append(f"{way} | " + " | ".join(cells))
    return "".join(f"| {line} |\n" for line in lines)


def _cell(way: str, noise: float, tolerance: float | None, *, regular: bool) -> str:
    right, off = 0, []
    for form in FORMS:
        for draw in range(DRAWS):
            outline = plate(form, draw, regular=regular)
            dense = sampled(outline, STEP)
            random = np.random.default_rng([draw, *form.encode()])
            fit = fitted(measured(dense, way, noise, random), tolerance)
            right += is_outline(fit, outline)
            away = cKDTree(Found.of_fits([fit]).curve).query(dense[::EVERY])[0]
            off.append(float(np.sqrt((away**2).mean())) / deviation_of(dense, way, noise))
    return f"{right}, {np.exp(np.mean(np.log(off))):.2f}"


if __name__ == "__main__":
    print(measuring_table())
