"""Equal outlines of one drawing: moved, turned or mirrored, each told as it was drawn and alike.

    python -m benchmarks.drawn.equal_outlines

How many of six outlines each have the lines and arcs that were drawn and nothing else, and how
often all six are one to rounding. Nearly equal ones, of two kinds by turns, must not be made equal:
it is counted how many are what they are.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import shapespline as ss
from benchmarks.drawn.few_points import is_outline
from benchmarks.drawn.renderers import LESS_EXACT
from benchmarks.drawn.shapes import box, keyhole, polygon, rounded
from benchmarks.drawn.truth import Arc, Line, sampled

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.drawn.renderers import Picture
    from benchmarks.drawn.truth import Outline

SIZE, COPIES, DRAWS = 256, 6, 2
# Points of each outline, and their noise in parts of its box diagonal.
POINTS, NOISE, STEP = 400, 0.005, 0.02
WAYS = ("moved", "mirrored", "on a ring")
PICTURES = {name: partial(picture, size=SIZE) for name, picture in LESS_EXACT.items()}


def window(inner: float, outer: float, spoke: float, fillet: float) -> Outline:
    """An opening between two of six spokes, half as wide: two arcs, two edges, four fillets."""
    edge = np.pi / 6  # direction of the upper spoke
    low, high = (
        radius * np.array([np.cos(angle), np.sin(angle)])
        for radius in (inner + fillet, outer - fillet)
        for angle in [edge - np.arcsin((spoke + fillet) / radius)]
    )
    upward = np.array([-np.sin(edge), np.cos(edge)])
    feet = [centre + fillet * upward for centre in (high, low)]
    a, b = (float(np.arctan2(*centre[::-1])) for centre in (low, high))
    up, origin, flip = edge + np.pi / 2, np.zeros(2), np.array([1.0, -1.0])
    return (
        Arc(origin, outer, -b, 2 * b),
        Arc(high, fillet, b, up - b),
        Line(feet[0], feet[1]),
        Arc(low, fillet, up, a + np.pi - up),
        Arc(origin, inner, a, -2 * a),
        Arc(low * flip, fillet, np.pi - a, a + np.pi - up),
        Line(feet[1] * flip, feet[0] * flip),
        Arc(high * flip, fillet, -up, up - b),
    )


def crescent(width: float, bend: float) -> Outline:
    """A bent slot: two arcs about one centre, round ends."""
    origin, r = np.zeros(2), 0.5 * width
    a = 0.5
    ends = [bend * np.array([np.cos(t), np.sin(t)]) for t in (a, -a)]
    return (
        Arc(origin, bend + r, -a, 2 * a),
        Arc(ends[0], r, a, np.pi),
        Arc(origin, bend - r, a, -2 * a),
        Arc(ends[1], r, np.pi - a, np.pi),
    )


def lens(half: float, radius: float) -> Outline:
    """Two equal arcs that meet in two tips."""
    a = float(np.arcsin(half / radius))
    y = np.sqrt(radius**2 - half**2)
    return (
        Arc(np.array([0.0, -y]), radius, np.pi / 2 - a, 2 * a),
        Arc(np.array([0.0, y]), radius, -np.pi / 2 - a, 2 * a),
    )


def dee(radius: float, cut: float) -> Outline:
    """A disc with a flat side."""
    a = float(np.arccos(cut / radius))
    arc = Arc(np.zeros(2), radius, a, 2 * np.pi - 2 * a)
    return (arc, Line(arc.end, arc.begin))


_TEE = [(-20, -14), (20, -14), (20, -4), (6, -4), (6, 16), (-6, 16), (-6, -4), (-20, -4)]
_TRIANGLE = [(-20.0, -14.0), (22.0, -14.0), (-8.0, 18.0)]
# The first half was looked at while constants were chosen, the others were kept aside.
SHAPES: dict[str, Outline] = {
    "pad": box(36.0, 20.0, 5.0),
    "window": window(26.0, 62.0, 4.0, 4.0),
    "tee": rounded(_TEE, [3, 3, 0, 3, 0, 0, 3, 0]),
    "bent slot": crescent(11.0, 34.0),
    "triangle": rounded(_TRIANGLE, 4.0),
    "keyhole": keyhole(10.0, 3.5, 26.0),
    "lens": lens(20.0, 26.0),
    "bar": polygon((-5, -20), (5, -20), (5, 20), (-5, 20)),
    "flat disc": dee(14.0, 8.0),
    "wedge": rounded([(-18, -8), (18, -15), (18, 15), (-18, 8)], [2.5, 5, 5, 2.5]),
}
# Outlines of two kinds that are nearly the same.
TWINS: dict[str, tuple[Outline, Outline]] = {
    "pad, one corner sharp": (
        box(36.0, 20.0, 5.0),
        rounded([(-18, -10), (18, -10), (18, 10), (-18, 10)], [5, 5, 5, 0]),
    ),
    "bar, one corner cut": (
        polygon((-5, -20), (5, -20), (5, 20), (-5, 20)),
        polygon((-5, -20), (5, -20), (5, 18), (3, 20), (-5, 20)),
    ),
    "flat disc, whole disc": (dee(14.0, 12.5), (Arc(np.zeros(2), 14.0, 0.0, 2 * np.pi),)),
}


class Told(NamedTuple):
    """Of one drawing: how many outlines are right, whether all are copies of one to rounding."""

    right: int
    equal: bool


def mirrored(outline: Outline) -> Outline:
    """At the second axis, run through backwards."""
    flip = np.array([-1.0, 1.0])
    return tuple(
        Line(one.end * flip, one.begin * flip)
        if isinstance(one, Line)
        else Arc(one.centre * flip, one.radius, np.pi - one.start - one.sweep, one.sweep)
        for one in reversed(outline)
        if isinstance(one, Line | Arc)
    )


def laid_out(kinds: list[Outline], draw: int, way: str) -> list[Outline]:
    """Outlines in three columns and two rows, or on a ring; off by parts of a pixel."""
    random = np.random.default_rng([draw, WAYS.index(way)])
    drawn = []
    for k, outline in enumerate(kinds):
        off = random.uniform(-0.5, 0.5, 2)
        turn = 0.0 if draw % 2 else np.radians(17.0)
        middle = np.mean([one.begin for one in outline], axis=0)
        if way == "on a ring":
            angle = turn + 2 * np.pi * k / COPIES
            about = 0.5 * SIZE + np.random.default_rng(draw).uniform(-0.5, 0.5, 2)
            if np.hypot(*middle) < 30.0:  # none that was drawn about the middle of the ring
                outline = tuple(one.moved(1.0, 0.0, np.array([70.0, 0.0])) for one in outline)
            drawn.append(tuple(one.moved(1.0, angle, about) for one in outline))
            continue
        if way == "mirrored" and k % 2:
            outline = mirrored(outline)
            middle = middle * np.array([-1.0, 1.0])
        at = np.array([50.0 + 78.0 * (k % 3), 70.0 + 115.0 * (k // 3)]) + off
        turned = tuple(one.moved(1.0, turn, np.zeros(2)) for one in outline)
        middle = np.mean([one.begin for one in turned], axis=0)
        drawn.append(tuple(one.moved(1.0, 0.0, at - middle) for one in turned))
    return drawn


def _traced(picture: Callable[[list[Outline]], Picture], drawn: list[Outline]) -> ss.Shape:
    return ss.trace(picture(drawn))


def measured(drawn: list[Outline]) -> ss.Shape:
    """Noisy points at equal steps."""
    random = np.random.default_rng(1)
    contours = []
    for outline in drawn:
        points = ss.Contour(sampled(outline, STEP), closed=True).resampled(POINTS).points
        noise = NOISE * float(np.hypot(*np.ptp(points, axis=0)))
        contours.append(ss.Contour(points + random.normal(0, noise, points.shape), closed=True))
    return ss.Shape(contours)


SOURCES: dict[str, Callable[[list[Outline]], ss.Shape]] = {
    **{name: partial(_traced, picture) for name, picture in PICTURES.items()},
    "points, 0.5 % noise": measured,
}


def told(drawn: list[Outline], source: str) -> Told:
    """What comes back of some outlines, which are matched by their places."""
    drawing = ss.fit_shape(SOURCES[source](drawn), character="drawn")
    places = np.array([fit.contour.points.mean(axis=0) for fit in drawing])
    right = 0
    for outline in drawn:
        middle = np.concatenate([one.points(1.0) for one in outline]).mean(axis=0)
        fit = drawing.fits[int(np.hypot(*(places - middle).T).argmin())]
        right += is_outline(fit, outline)
    copies = (one.pieces for one in drawing.regularities if one.name == "equal-copies")
    return Told(right, any(len(one) == len(drawn) for one in copies))


def equal_table() -> str:
    """Right outlines, and drawings all of whose outlines are equal, by shape."""
    n = len(WAYS) * DRAWS
    lines = [f"Right of {n * COPIES}, equal of {n} | " + " | ".join(SOURCES)]
    lines.append("|".join(["---"] * (1 + len(SOURCES))))
    for name in SHAPES:
        cells = []
        for source in SOURCES:
            found = [
                told(laid_out([SHAPES[name]] * COPIES, draw, way), source)
                for way in WAYS
                for draw in range(DRAWS)
            ]
            cells.append(f"{sum(one.right for one in found)}, {sum(one.equal for one in found)}")
        lines.append(f"{name} | " + " | ".join(cells))
    return "".join(f"| {line} |\n" for line in lines)


def twins_table() -> str:
    """Right outlines of two kinds by turns."""
    lines = [f"Right of {DRAWS * COPIES} | " + " | ".join(SOURCES)]
    lines.append("|".join(["---"] * (1 + len(SOURCES))))
    for name, kinds in TWINS.items():
        cells = [
            sum(
                told(laid_out([*kinds] * (COPIES // 2), draw, "moved"), source).right
                for draw in range(DRAWS)
            )
            for source in SOURCES
        ]
        lines.append(f"{name} | " + " | ".join(map(str, cells)))
    return "".join(f"| {line} |\n" for line in lines)


if __name__ == "__main__":
    print(equal_table())
    print(twins_table())
