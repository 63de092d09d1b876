"""Small fillets in pictures that are not exact: boxes, hexagons and octagons, level and turned.

    python -m benchmarks.drawn.fillets

How many of eight places have the lines and arcs that were drawn and nothing else.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import shapespline as ss
from benchmarks.drawn.few_points import is_outline
from benchmarks.drawn.renderers import exact, jpeg, scanned
from benchmarks.drawn.shapes import box, rounded

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.drawn.renderers import Picture
    from benchmarks.drawn.truth import Outline

# Pixels: of fillets, of the picture; degrees.
RADII, SIZE, TURNS = (3.0, 4.0, 5.0, 6.0, 8.0, 12.0), 256, (0.0, 17.0)
PLACES = 8


def _regular(n: int) -> list[tuple[float, float]]:
    return [(100 * np.cos(angle), 100 * np.sin(angle)) for angle in 2 * np.pi * np.arange(n) / n]


SHAPES: dict[str, Callable[[float], Outline]] = {
    "box": lambda radius: box(200.0, 120.0, radius),
    "hexagon": lambda radius: rounded(_regular(6), radius),
    "octagon": lambda radius: rounded(_regular(8), radius),
}
PICTURES: dict[str, Callable[[list[Outline]], Picture]] = {
    "exact coverage": lambda drawn: exact(drawn, SIZE),
    "JPEG 90": lambda drawn: jpeg(exact(drawn, SIZE)),
    "blurred by 0.5": lambda drawn: scanned(drawn, SIZE, 0.5, 0.0),
    "blurred by 0.5, grain of 2, JPEG 90": lambda drawn: jpeg(scanned(drawn, SIZE, 0.5, 2.0)),
    "blurred by 1, grain of 8, JPEG 90": lambda drawn: jpeg(scanned(drawn, SIZE, 1.0, 8.0)),
}


def drawn_at(shape: str, radius: float, turn: float, place: int) -> Outline:
    """A shape about the middle of the picture, off by a part of a pixel."""
    off = 0.5 * SIZE + np.random.default_rng(place).uniform(-0.5, 0.5, 2)
    return tuple(one.moved(1.0, np.radians(turn), off) for one in SHAPES[shape](radius))


def comes_back(outline: Outline, picture: str) -> bool:
    """Whether a picture's outline has the lines and arcs that were drawn and nothing else."""
    fits = ss.fit_shape(ss.trace(PICTURES[picture]([outline])), character="drawn").fits
    return len(fits) == 1 and is_outline(fits[0], outline)


def fillets_table() -> str:
    """Right fits, by radius."""
    heads = " | ".join(f"radius {radius:g}" for radius in RADII)
    lines = [f"Right of {PLACES} | {heads}", "|".join(["---"] * (1 + len(RADII)))]
    for shape in SHAPES:
        for turn in TURNS:
            for picture in PICTURES:
                right = [
                    sum(
                        comes_back(drawn_at(shape, radius, turn, place), picture)
                        for place in range(PLACES)
                    )
                    for radius in RADII
                ]
                label = f"{shape}, {'turned' if turn else 'level'}, {picture}"
                lines.append(f"{label} | " + " | ".join(map(str, right)))
    return "".join(f"| {line} |\n" for line in lines)


if __name__ == "__main__":
    print(fillets_table())
