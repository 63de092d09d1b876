"""Short sides between fillets in pictures: arcs of two radii, a small box, a step of a plate.

    python -m benchmarks.drawn.short_sides

How many of eight places, level and turned, have the lines and arcs that were drawn and nothing
else.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from benchmarks.drawn.fillets import PICTURES, PLACES, SIZE, TURNS, comes_back
from benchmarks.drawn.shapes import box, rounded

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.drawn.truth import Outline

# Pixels.
SIDES = (2.0, 3.0, 4.0, 5.0, 6.0, 8.0)
FEW, MANY, RADIUS = 12.0, 28.0, 8.0


def _of_two(side: float) -> Outline:
    """A plate on a side between fillets of two radii."""
    width, height = FEW + side + MANY, MANY + 20.0
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    return rounded([(x - width / 2, y - height / 2) for x, y in corners], (FEW, MANY, 0.0, 0.0))


def _step(side: float) -> Outline:
    """A plate with a step of such a side between a fillet inside and one outside."""
    low, high = -20.0, -20.0 + 2.0 * RADIUS + side
    corners = [(-80.0, -60.0), (80.0, -60.0), (80.0, low), (10.0, low), (10.0, high), (-80.0, high)]
    return rounded(corners, (0.0, 0.0, 0.0, RADIUS, RADIUS, 0.0))


SHAPES: dict[str, Callable[[float], Outline]] = {
    "12 and 28": _of_two,
    "small box": lambda side: box(28.0, 2.0 * RADIUS + side, RADIUS),
    "step": _step,
}


def drawn_at(shape: str, side: float, turn: float, place: int) -> Outline:
    """A shape about the middle of the picture, off by a part of a pixel."""
    off = 0.5 * SIZE + np.random.default_rng(place).uniform(-0.5, 0.5, 2)
    return tuple(one.moved(1.0, np.radians(turn), off) for one in SHAPES[shape](side))


def short_sides_table() -> str:
    """Right fits, by the length of the side."""
    heads = " | ".join(f"{side:g} pixels" for side in SIDES)
    lines = [f"Right of {len(TURNS) * PLACES} | {heads}", "|".join(["---"] * (1 + len(SIDES)))]
    for shape in SHAPES:
        for picture in PICTURES:
            right = [
                sum(
                    comes_back(drawn_at(shape, side, turn, place), picture)
                    for turn in TURNS
                    for place in range(PLACES)
                )
                for side in SIDES
            ]
            lines.append(f"{shape}, {picture} | " + " | ".join(map(str, right)))
    return "".join(f"| {line} |\n" for line in lines)


if __name__ == "__main__":
    print(short_sides_table())
