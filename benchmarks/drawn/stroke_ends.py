"""Ends of strokes that are few pixels wide: bars, feet of letters, combs, and round ends.

    python -m benchmarks.drawn.stroke_ends

How many of eight places have the lines and arcs that were drawn and nothing else, and how far
joints of curves are from the corners of all of them: in the median, and the farthest.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import shapespline as ss
from benchmarks.drawn.few_points import is_outline
from benchmarks.drawn.renderers import LESS_EXACT
from benchmarks.drawn.shapes import box, polygon, slot

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from benchmarks.drawn.truth import Array, Outline

# Pixels: of the picture, and how long bars, stems and feet are, how wide stems; degrees.
SIZE, LENGTH, FOOT, STEM, TURNS = 96, 40.0, 24.0, 8.0, (0.0, 17.0)
# A plate in the picture's corner shows what ink is: thin strokes under a blur do not.
PLATE = tuple(one.moved(1.0, 0.0, np.array([11.2, 10.7])) for one in box(14.0, 14.0))
PLATE_ENDS = 19.5
PLACES = 8
PICTURES = {name: partial(picture, size=SIZE) for name, picture in LESS_EXACT.items()}


def letter_t(thick: float) -> Outline:
    """A stem with one foot, at its top."""
    x, y, s = 0.5 * FOOT, 0.5 * LENGTH, 0.5 * STEM
    below = y - thick
    right = [(s, -y), (s, below), (x, below), (x, y)]
    return polygon(*right, *((-a, b) for a, b in right[::-1]))


def letter_i(thick: float) -> Outline:
    """A stem with a foot at either end."""
    x, y, s = 0.5 * FOOT, 0.5 * LENGTH, 0.5 * STEM
    inner = y - thick
    right = [(x, -y), (x, -inner), (s, -inner), (s, inner), (x, inner), (x, y)]
    return polygon(*right, *((-a, -b) for a, b in right))


def comb(tine: float) -> Outline:
    """Four tines as far apart as they are wide, half as long as a bar, on a bar of six pixels."""
    y, back = 0.25 * LENGTH, 6.0
    tops = [(2 * k * tine, end) for k in range(4) for end in (0, 1)]
    points = [(0.0, -y - back), (7 * tine, -y - back)]
    for left, _ in tops[::-2]:
        points += [(left + tine, y), (left, y), (left, -y), (left - tine, -y)]
    return polygon(*((x - 3.5 * tine, at) for x, at in points[:-2]))


SHAPES: dict[str, Callable[[], Outline]] = {
    **{f"bar {wide:g}": partial(box, LENGTH, wide) for wide in (1.5, 2.0, 3.0, 4.0, 5.0)},
    **{f"T {thick:g}": partial(letter_t, thick) for thick in (4.0, 5.0)},
    **{f"I {thick:g}": partial(letter_i, thick) for thick in (4.0, 5.0)},
    **{f"comb {tine:g}": partial(comb, tine) for tine in (3.0, 4.0)},
    **{f"round {wide:g}": partial(slot, 0.0, 0.0, LENGTH, wide) for wide in (3.0, 4.0, 5.0)},
}


def drawn_at(shape: str, turn: float, place: int) -> Outline:
    """A shape about the middle of the picture, off by a part of a pixel."""
    off = 0.5 * SIZE + np.random.default_rng(place).uniform(-0.5, 0.5, 2)
    return tuple(one.moved(1.0, np.radians(turn), off) for one in SHAPES[shape]())


def fits_of(outline: Outline, picture: str) -> Sequence[ss.Fit]:
    """What comes back of an outline in a picture, but for the plate."""
    fits = ss.fit_shape(ss.trace(PICTURES[picture]([outline, PLATE])), character="drawn").fits
    return [one for one in fits if one.pieces[0].control_points[0].min() > PLATE_ENDS]


def corners_off(outline: Outline, fits: Sequence[ss.Fit]) -> Array:
    """Distances from where lines and arcs of an outline meet to the nearest joint of fits."""
    far = np.full((1, 2), np.inf)
    joints = np.concatenate(
        [far, *(piece.control_points[:1] for fit in fits for piece in fit.pieces)]
    )
    corners = np.array([one.begin for one in outline])
    return np.hypot(*(corners[:, None] - joints).T).min(axis=0)


def stroke_ends_table() -> str:
    """Right fits, and how far corners are off, by shape."""
    lines = [
        f"Right of {PLACES}; off | {' | '.join(SHAPES)}",
        "|".join(["---"] * (1 + len(SHAPES))),
    ]
    for turn in TURNS:
        for picture in PICTURES:
            cells = []
            for shape in SHAPES:
                drawn = [drawn_at(shape, turn, place) for place in range(PLACES)]
                fits = [fits_of(outline, picture) for outline in drawn]
                right = sum(
                    len(one) == 1 and is_outline(one[0], outline)
                    for outline, one in zip(drawn, fits, strict=True)
                )
                off = np.concatenate([corners_off(*pair) for pair in zip(drawn, fits, strict=True)])
                cells.append(f"{right}; {np.median(off):.2f}, {off.max():.2f}")
            lines.append(f"{'turned' if turn else 'level'}, {picture} | {' | '.join(cells)}")
    return "".join(f"| {line} |\n" for line in lines)


if __name__ == "__main__":
    print(stroke_ends_table())
