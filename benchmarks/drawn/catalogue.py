"""The drawings by name: plates, icons, letters, words and organic outlines.

Of each kind the first of a pair may be looked at while constants are chosen; the second is kept
aside, for judging.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, NamedTuple

from benchmarks.drawn.glyphs import word
from benchmarks.drawn.icons import icons
from benchmarks.drawn.shapes import (
    box,
    comb,
    cross,
    disc,
    gear,
    grid,
    hole,
    keyhole,
    leaf,
    polygon,
    ring_of,
    rounded,
    slot,
    star,
    wavy,
)

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeAlias

    from benchmarks.drawn.truth import Outline

    # What makes the outlines, and the degrees that they are turned by.
    Makers: TypeAlias = dict[str, tuple[Callable[[], tuple[Outline, ...]], float]]

KINDS = ("plate", "icon", "letter", "word", "organic")
WORDS = ("gear", "No. 42", "jäger", "Plate 7")


class Drawing(NamedTuple):
    """Outlines, the angle (degrees) that they are turned by, and what they are."""

    outlines: tuple[Outline, ...]
    turn: float
    kind: str  # of KINDS
    aside: bool


@cache
def drawings() -> dict[str, Drawing]:
    """All drawings by name; every other one of a kind is kept aside."""
    letters = {
        f"{font.lower()} {one}": (word(one, font), 0.0)
        for font, few in (("Sans", "ERSgBaKt"), ("Serif", "Mae5"))
        for one in few
    }
    made = {
        "plate": {name: (make(), turn) for name, (make, turn) in _plates().items()},
        "icon": {name: (one, 0.0) for name, one in icons("icon").items()},
        "letter": letters,
        "word": {one: (word(one), 0.0) for one in WORDS},
        "organic": {name: (make(), turn) for name, (make, turn) in _organic().items()}
        | {name: (one, 0.0) for name, one in icons("organic").items()},
    }
    return {
        name: Drawing(outlines, turn, kind, bool(k % 2))
        for kind in KINDS
        for k, (name, (outlines, turn)) in enumerate(made[kind].items())
    }


def names_of(*kinds: str, aside: bool | None = None) -> list[str]:
    """Names of the drawings of some kinds; those kept aside, the others, or all."""
    return [
        name for name, one in drawings().items() if one.kind in kinds and aside in (None, one.aside)
    ]


def _plates() -> Makers:
    def plate(radius: float, size: float, middle: float) -> tuple[Outline, ...]:
        at = [(-0.35, -0.25), (0.35, -0.25), (0.35, 0.25), (-0.35, 0.25)]
        return (box(1.0, 0.8, radius), *(hole(x, y, size) for x, y in at), hole(0, 0, middle))

    ell = [(-0.4, -0.5), (0.4, -0.5), (0.4, -0.28), (-0.15, -0.28), (-0.15, 0.5), (-0.4, 0.5)]
    tee = [
        (-0.5, 0.2),
        (-0.12, 0.2),
        (-0.12, -0.5),
        (0.12, -0.5),
        (0.12, 0.2),
        (0.5, 0.2),
        (0.5, 0.45),
        (-0.5, 0.45),
    ]
    arrow = [
        (-0.5, -0.1),
        (0.1, -0.1),
        (0.1, -0.28),
        (0.5, 0.0),
        (0.1, 0.28),
        (0.1, 0.1),
        (-0.5, 0.1),
    ]
    house = [(-0.4, -0.4), (0.4, -0.4), (0.4, 0.15), (0.0, 0.5), (-0.4, 0.15)]
    return {
        "box": (lambda: (box(1.0, 0.6),), 8.1),
        "box level": (lambda: (box(0.9, 0.7),), 0.0),
        "box rounded": (lambda: (box(1.0, 0.6, 0.15),), 17.3),
        "box little rounded": (lambda: (box(0.9, 0.6, 0.03),), 0.0),
        "slot": (lambda: (slot(0, 0, 1.26, 0.26),), 30.7),
        "slot level": (lambda: (slot(0, 0, 1.2, 0.4),), 0.0),
        "gear 18": (lambda: (gear(18, 0.40, 0.5), hole(0, 0, 0.15)), 3.0),
        "gear 12": (lambda: (gear(12, 0.37, 0.5, 0.45), hole(0, 0, 0.2)), 11.0),
        "gear 24": (lambda: (gear(24, 0.42, 0.5), hole(0, 0, 0.1)), 0.0),
        "keyhole": (lambda: (keyhole(0.3, 0.09, 0.8),), -63.0),
        "keyhole level": (lambda: (keyhole(0.3, 0.12, 0.9),), 90.0),
        "plate": (lambda: plate(0.08, 0.06, 0.16), 11.0),
        "plate level": (lambda: plate(0.12, 0.07, 0.13), 0.0),
        "bracket": (lambda: (rounded(ell, [0, 0.06, 0.06, 0.12, 0.06, 0.06]),), 0.0),
        "tee": (lambda: (rounded(tee, [0.05, 0.1, 0, 0, 0.1, 0.05, 0.05, 0.05]),), 5.0),
        "star 5": (lambda: (star(5, 0.22),), 0.0),
        "star 7": (lambda: (star(7, 0.3),), 12.0),
        "arrow": (lambda: (polygon(*arrow),), 0.0),
        "house": (
            lambda: (
                polygon(*house),
                rounded([(-0.1, -0.3), (-0.1, 0.05), (0.1, 0.05), (0.1, -0.3)], 0),
            ),
            0.0,
        ),
        "ring": (lambda: (disc(0, 0, 0.5), hole(0, 0, 0.32)), 0.0),
        "washer": (lambda: (disc(0, 0, 0.5), hole(0.05, 0, 0.2)), 20.0),
        "hexagon": (lambda: (star(3, 0.5), hole(0, 0, 0.28)), 4.0),
        "flange 6": (lambda: (disc(0, 0, 0.5), hole(0, 0, 0.2), *ring_of(6, 0.35, 0.06)), 7.0),
        "flange 8": (lambda: (disc(0, 0, 0.5), hole(0, 0, 0.15), *ring_of(8, 0.36, 0.05)), 0.0),
        "row of holes": (lambda: (box(1.0, 0.3, 0.05), *grid(5, 1, 0.18, 0.18, 0.05)), 0.0),
        "row of holes turned": (lambda: (box(1.0, 0.3), *grid(4, 1, 0.22, 0.22, 0.06)), 23.0),
        "grid of holes": (lambda: (box(0.9, 0.9, 0.08), *grid(3, 3, 0.26, 0.26, 0.07)), 0.0),
        "grid of holes wide": (lambda: (box(1.0, 0.6), *grid(4, 2, 0.22, 0.26, 0.06)), 0.0),
        "vents": (
            lambda: (
                box(1.0, 0.8, 0.1),
                *(slot(0, y, 0.7, 0.08) for y in (-0.24, -0.08, 0.08, 0.24)),
            ),
            0.0,
        ),
        "vents turned": (
            lambda: (box(1.0, 0.7, 0.06), *(slot(0, y, 0.6, 0.09) for y in (-0.2, 0.0, 0.2))),
            14.0,
        ),
        "cross": (lambda: (cross(0.5, 0.16), hole(0, 0, 0.09)), 0.0),
        "cross rounded": (lambda: (cross(0.5, 0.18, 0.06),), 19.0),
        "comb": (lambda: (comb(7, 0.07, 0.35),), 0.0),
        "comb turned": (lambda: (comb(5, 0.1, 0.3),), 40.0),
    }


def _organic() -> Makers:
    return {
        "pebble": (lambda: (wavy(0.35, (2, 0.08, 0.4), (3, 0.05, -1.57), (5, 0.025, 1.0)),), 0.0),
        "blob": (lambda: (wavy(0.36, (2, 0.06, 1.4), (4, 0.04, 0.5), (7, 0.012, 1.0)),), 30.0),
        "lobed": (lambda: (wavy(0.36, (5, 0.09, 0.3), (3, 0.03, -1.57), (11, 0.01, -1.57)),), 0.0),
        "flower": (lambda: (wavy(0.36, (6, 0.08, 0.2), (2, 0.02, 0.3)),), 10.0),
        "leaf": (lambda: (leaf(0.06, 0.22),), 20.0),
        "leaf wide": (lambda: (leaf(0.03, 0.3),), -35.0),
    }
