"""Few points, whose noise nobody knows: measured ones, and vertices as programs export them.

    python -m benchmarks.drawn.few_points

Shapes of lines and arcs are to come back as these; shapes of neither are to stay curves. Within a
tolerance corners between measured points are out of reach where their chord is farther off.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import shapespline as ss
from benchmarks.drawn.catalogue import drawings
from benchmarks.drawn.tables import SIZE, rendered
from benchmarks.drawn.truth import Arc, Line, sampled
from benchmarks.quality import own_corpus

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.drawn.truth import Array, Outline

# Measured points and their noise, parts of the box diagonal; tolerances over it. Chords of a
# quarter of a circle, and digits after the point of drawings 256 wide.
COUNTS, NOISES = (24, 36, 48, 60), (0.0, 0.0002, 0.0005, 0.001)
CHORDS, DIGITS = (6, 12, 24, 48), (None, 3, 2)
# Arcs of fewer chords are not told from edges, nor outlines of fewer vertices looked at.
LEAST_CHORDS, FEWEST_VERTICES = 4, 12
TOLERANCES = (None, 0.005)
# Steps of a dense sampling; organic outlines of the project's own corpus.
STEP = 0.01
ORGANIC = (
    "leaf840_closed",
    "hand620_closed",
    "fa_dove_c0",
    "NotoNaskhArabic-Regular_U0647_c0",
)


def _plate(width: float, height: float, radius: float, round_at: tuple[bool, ...]) -> Outline:
    """A rectangle, some of its corners round, counter-clockwise from the lower left."""
    corners = np.array([(0, 0), (width, 0), (width, height), (0, height)], dtype=float)
    along = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)], dtype=float)
    parts: list[Line | Arc] = []
    for k, (corner, after) in enumerate(zip(corners, along, strict=True)):
        if round_at[k]:
            centre = corner + radius * (after - along[k - 1])
            parts.append(Arc(centre, radius, np.pi + k * np.pi / 2, np.pi / 2))
        m = (k + 1) % 4
        begin = corner + radius * after * round_at[k]
        parts.append(Line(begin, corners[m] - radius * after * round_at[m]))
    return tuple(parts)


def _slot(length: float, radius: float) -> Outline:
    left, right = np.array([0.0, 0.0]), np.array([length, 0.0])
    up = np.array([0.0, radius])
    return (
        Line(left - up, right - up),
        Arc(right, radius, -np.pi / 2, np.pi),
        Line(right + up, left + up),
        Arc(left, radius, np.pi / 2, np.pi),
    )


SHAPES: dict[str, Outline] = {
    "circle": (Arc(np.array([20.0, 15.0]), 30.0, 0.1, 2 * np.pi),),
    "slot": _slot(40.0, 10.0),
    "plate": _plate(60.0, 40.0, 8.0, (True,) * 4),
    "rectangle": _plate(60.0, 40.0, 0.0, (False,) * 4),
    "bay": _plate(60.0, 40.0, 20.0, (False, False, True, True)),
    "tab": _plate(60.0, 40.0, 12.0, (True, False, False, True)),
}


def measured(outline: Outline, count: int, noise: float, random: np.random.Generator) -> Array:
    """Points at even steps from anywhere on, shaken."""
    dense = sampled(outline, STEP)
    first = int(random.integers(len(dense)))
    contour = ss.Contour.silently(np.roll(dense, -first, axis=0), closed=True)
    points = contour.resampled(count).points
    return points + random.normal(0, noise * contour.box_diagonal, points.shape)


def exported(outline: Outline, chords: int, digits: int | None) -> Array:
    """Ends of lines, and of so many chords of each quarter of a circle."""
    parts = []
    for one in outline:
        if isinstance(one, Arc):
            n = _n_chords(one, chords)
            parts.append(one.at(one.start + one.sweep * np.arange(n) / n))
        else:
            parts.append(one.points(np.inf))
    points = np.concatenate(parts)
    return points if digits is None else points.round(digits)


def _n_chords(arc: Arc, chords: int) -> int:
    return max(1, round(chords * abs(arc.sweep) / (np.pi / 2)))


def _shown(outline: Outline, chords: int) -> bool:
    """Whether there are lines and arcs alone, and enough chords tell each arc."""
    if not all(isinstance(one, Line | Arc) for one in outline):
        return False
    arcs = [_n_chords(one, chords) for one in outline if isinstance(one, Arc)]
    return bool(arcs) and min(arcs) >= LEAST_CHORDS and sum(arcs) >= FEWEST_VERTICES


def is_right(points: Array, outline: Outline, tolerance: float | None) -> bool:
    """Whether the fit has the lines and arcs that were drawn and nothing else."""
    return is_outline(fitted(points, tolerance), outline)


def is_outline(fit: ss.Fit, outline: Outline) -> bool:
    """Whether a fit has the lines and arcs of an outline and nothing else."""
    own = sorted(type(one).__name__.lower() for one in outline)
    return sorted(piece.kind for piece in fit.pieces) == own


def fitted(points: Array, tolerance: float | None) -> ss.Fit:
    """The fit of a closed outline, within a part of its box diagonal."""
    contour = ss.Contour.silently(points, closed=True)
    asked = None if tolerance is None else tolerance * contour.box_diagonal
    return ss.fit_curve(contour, tolerance=asked)


def measured_table(draws: int = 10) -> str:
    """Right fits of measured points."""
    cells = [(tolerance, noise) for tolerance in TOLERANCES for noise in NOISES]
    heads = [f"{said(tolerance)}, {100 * noise:g} % noise" for tolerance, noise in cells]
    lines = [f"Right of {draws * len(COUNTS)} | " + " | ".join(heads)]
    lines.append("|".join(["---"] * (1 + len(cells))))
    for name, outline in SHAPES.items():
        right = [
            sum(
                is_right(measured(outline, n, noise, _random(draw)), outline, tolerance)
                for n in COUNTS
                for draw in range(draws)
            )
            for tolerance, noise in cells
        ]
        lines.append(f"{name} | " + " | ".join(map(str, right)))
    return "".join(f"| {line} |\n" for line in lines)


def exported_table() -> str:
    """Right fits of vertices of all plates and icons, by their chords, digits and the tolerance."""
    cells = [(tolerance, digits) for tolerance in TOLERANCES for digits in DIGITS]
    heads = [
        f"{said(tolerance)}, {'all' if digits is None else digits} digits"
        for tolerance, digits in cells
    ]
    lines = ["Right, chords of a quarter | outlines | " + " | ".join(heads)]
    lines.append("|".join(["---"] * (2 + len(cells))))
    every = [outline for name in drawings() for outline in rendered(name, SIZE)[0]]
    for chords in CHORDS:
        outlines = [outline for outline in every if _shown(outline, chords)]
        right = [
            sum(is_right(exported(one, chords, digits), one, tolerance) for one in outlines)
            for tolerance, digits in cells
        ]
        lines.append(f"{chords} | {len(outlines)} | " + " | ".join(map(str, right)))
    return "".join(f"| {line} |\n" for line in lines)


def organic_table(draws: int = 10) -> str:
    """How often shapes without lines and arcs get arcs."""
    cells = [(tolerance, noise) for tolerance in TOLERANCES for noise in NOISES]
    heads = [f"{said(tolerance)}, {100 * noise:g} % noise" for tolerance, noise in cells]
    lines = [f"With arcs of {draws * len(COUNTS)} | " + " | ".join(heads)]
    lines.append("|".join(["---"] * (1 + len(cells))))
    for name, at in organic().items():
        with_arcs = [
            sum(
                any(
                    piece.kind == "arc"
                    for piece in fitted(shaken(at, n, noise, _random(draw)), tolerance).pieces
                )
                for n in COUNTS
                for draw in range(draws)
            )
            for tolerance, noise in cells
        ]
        lines.append(f"{name} | " + " | ".join(map(str, with_arcs)))
    return "".join(f"| {line} |\n" for line in lines)


def organic() -> dict[str, Callable[[int, float], Array]]:
    """Points of a closed curve by their number and phase."""

    def ellipse(n: int, phase: float) -> Array:
        t = 2 * np.pi * (np.arange(n) + phase) / n
        return np.column_stack([50 * np.cos(t), 30 * np.sin(t)])

    def egg(n: int, phase: float) -> Array:
        t = 2 * np.pi * (np.arange(n) + phase) / n
        return np.column_stack([50 * np.cos(t) + 8 * np.cos(2 * t), 30 * np.sin(t)])

    def of_corpus(contour: ss.Contour) -> Callable[[int, float], Array]:
        def at(n: int, phase: float) -> Array:
            first = int(phase * len(contour))
            rolled = ss.Contour.silently(np.roll(contour.points, -first, axis=0), closed=True)
            return rolled.resampled(n).points

        return at

    found = {"ellipse": ellipse, "egg": egg}
    corpus = {one.name: one.contour for one in own_corpus()}
    return found | {name: of_corpus(corpus[name]) for name in ORGANIC}


def shaken(
    at: Callable[[int, float], Array], n: int, noise: float, random: np.random.Generator
) -> Array:
    points = at(n, random.random())
    return points + random.normal(0, noise * np.hypot(*np.ptp(points, axis=0)), points.shape)


def _random(seed: int) -> np.random.Generator:
    return np.random.default_rng(seed)


def said(tolerance: float | None) -> str:
    """A part of the box diagonal in words."""
    return "none" if tolerance is None else f"{100 * tolerance:g} %"


def main() -> None:
    """Print the tables."""
    print(f"{measured_table()}\n{exported_table()}\n{organic_table()}")


if __name__ == "__main__":
    main()
