"""The drawings: plates, gears, slots, letters and leaves, in units of about one.

The first of each pair may be looked at while constants are chosen; the second is kept aside, for
judging. Outer outlines run counter-clockwise, holes clockwise.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from benchmarks.drawn.truth import Arc, Cubic, Line, Outline

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from benchmarks.drawn.truth import Array, Element


class Drawing(NamedTuple):
    """Outlines, the angle (degrees) that they are turned by, and what they are."""

    outlines: tuple[Outline, ...]
    turn: float
    kind: str  # "geometric", "letter" or "organic"
    aside: bool


def rounded(corners: Sequence[tuple[float, float]], radii: float | Sequence[float]) -> Outline:
    """A polygon whose corners are rounded by tangent arcs; a radius of 0 leaves one sharp."""
    points = np.asarray(corners, dtype=float)
    n = len(points)
    sizes = np.broadcast_to(np.asarray(radii, dtype=float), n)
    begins, ends, arcs = [], [], []
    for i in range(n):
        here = points[i]
        back, ahead = points[i - 1] - here, points[(i + 1) % n] - here
        back, ahead = back / np.hypot(*back), ahead / np.hypot(*ahead)
        half = 0.5 * np.arccos(np.clip(back @ ahead, -1, 1))
        cut = sizes[i] / np.tan(half)
        begins.append(here + cut * back)
        ends.append(here + cut * ahead)
        bisector = (back + ahead) / np.hypot(*(back + ahead))
        centre = here + bisector * sizes[i] / np.sin(half)
        way = 1.0 if back[0] * ahead[1] - back[1] * ahead[0] < 0 else -1.0
        out = begins[-1] - centre
        start = float(np.arctan2(out[1], out[0]))
        arcs.append(Arc(centre, float(sizes[i]), start, way * (np.pi - 2 * float(half))))
    elements: list[Element] = []
    for i in range(n):
        if sizes[i] > 0:
            elements.append(arcs[i])
        if np.hypot(*(begins[(i + 1) % n] - ends[i])) > 1e-9:
            elements.append(Line(ends[i], begins[(i + 1) % n]))
    return tuple(elements)


def polygon(*corners: tuple[float, float]) -> Outline:
    """All corners sharp."""
    return rounded(corners, 0.0)


def box(width: float, height: float, radius: float = 0.0) -> Outline:
    """A rectangle about the origin."""
    x, y = width / 2, height / 2
    return rounded([(-x, -y), (x, -y), (x, y), (-x, y)], radius)


def hole(x: float, y: float, radius: float) -> Outline:
    """A whole circle, clockwise."""
    return (Arc(np.array([x, y], dtype=float), radius, 0.0, -2 * np.pi),)


def disc(x: float, y: float, radius: float) -> Outline:
    """A whole circle, counter-clockwise."""
    return (Arc(np.array([x, y], dtype=float), radius, 0.0, 2 * np.pi),)


def gear(teeth: int, root: float, tip: float, share: float = 0.5, slant: float = 0.12) -> Outline:
    """Arcs of two circles about the origin, joined by straight flanks."""
    pitch, origin = 2 * np.pi / teeth, np.zeros(2)
    elements: list[Element] = []
    for k in range(teeth):
        a = k * pitch
        b = a + pitch * (1 - share) * (1 - slant)
        c = b + pitch * slant * 0.5
        d = c + pitch * share * (1 - slant)
        low, high = Arc(origin, root, a, b - a), Arc(origin, tip, c, d - c)
        after = Arc(origin, root, a + pitch, 0.1)
        elements += [low, Line(low.end, high.begin), high, Line(high.end, after.begin)]
    return tuple(elements)


def star(points: int, inner: float, outer: float = 0.5) -> Outline:
    """Sharp tips and notches in turn."""
    angle = 0.1 + np.pi * np.arange(2 * points) / points
    radius = np.where(np.arange(2 * points) % 2 == 0, outer, inner)
    return polygon(
        *zip((radius * np.cos(angle)).tolist(), (radius * np.sin(angle)).tolist(), strict=True)
    )


def keyhole(radius: float, half: float, length: float) -> Outline:
    """A circle with a straight slot."""
    x, a = np.sqrt(radius**2 - half**2), float(np.arcsin(half / radius))
    arc = Arc(np.zeros(2), radius, a, 2 * np.pi - 2 * a)
    p, q = np.array([length, half]), np.array([length, -half])
    return (Line(p, np.array([x, half])), arc, Line(np.array([x, -half]), q), Line(q, p))


def smooth(points: Array, corner: bool = False) -> Outline:
    """A closed cubic spline through points, with a corner at the first if asked."""
    loop = np.vstack([points, points[:1]])
    s = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(loop, axis=0).T))])
    curve = CubicSpline(s, loop, bc_type="not-a-knot" if corner else "periodic")
    slopes, thirds = curve(s, 1), np.diff(s)[:, None] / 3
    return tuple(
        Cubic(
            np.stack(
                [
                    loop[i],
                    loop[i] + thirds[i] * slopes[i],
                    loop[i + 1] - thirds[i] * slopes[i + 1],
                    loop[i + 1],
                ]
            )
        )
        for i in range(len(points))
    )


def wavy(radius: float, *waves: tuple[int, float, float]) -> Outline:
    """Waves (number, height, phase) on a circle, through 60 points."""
    t = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    r = radius + sum(height * np.cos(n * t + phase) for n, height, phase in waves)
    return smooth(np.column_stack([r * np.cos(t), r * np.sin(t)]))


def leaf(bend: float, width: float) -> Outline:
    """Two bent sides that meet in a tip and a stalk."""
    u = np.linspace(0, 2, 13)[:-1]
    x = np.where(u < 1, u, 2 - u)
    side = np.where(u < 1, -1, 1)
    y = side * width * np.sin(np.pi * x) ** 0.9 * (1.2 - 0.5 * x) + bend * np.sin(3 * x)
    return smooth(np.column_stack([x - 0.5, y]), corner=True)


def letter(character: str, bold: bool = False) -> tuple[Outline, ...]:
    """A glyph of DejaVu Sans, which comes with matplotlib."""
    import matplotlib
    from fontTools.pens.recordingPen import DecomposingRecordingPen
    from fontTools.ttLib import TTFont

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    font = TTFont(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / name)
    glyphs, unit = font.getGlyphSet(), font["head"].unitsPerEm
    pen = DecomposingRecordingPen(glyphs)
    glyphs[font.getBestCmap()[ord(character)]].draw(pen)
    outlines: list[Outline] = []
    elements: list[Element] = []
    first = here = np.zeros(2)
    for command, arguments in pen.value:
        given = [np.array(a, dtype=float) / unit for a in arguments if a is not None]
        if command == "moveTo":
            elements, first, here = [], given[0], given[0]
        elif command == "lineTo":
            elements.append(Line(here, given[0]))
            here = given[0]
        elif command == "qCurveTo":
            inner = given[:-1]
            for k, q in enumerate(inner):
                to = given[-1] if k == len(inner) - 1 else 0.5 * (q + inner[k + 1])
                elements.append(Cubic(np.stack([here, (here + 2 * q) / 3, (to + 2 * q) / 3, to])))
                here = to
        elif command == "closePath":
            if np.hypot(*(here - first)) > 1e-9:
                elements.append(Line(here, first))
            outlines.append(tuple(elements))
    return tuple(outlines)


def _pairs() -> dict[str, tuple[Callable[[], tuple[Outline, ...]], float, str]]:
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
        "box": (lambda: (box(1.0, 0.6),), 8.1, "geometric"),
        "box level": (lambda: (box(0.9, 0.7),), 0.0, "geometric"),
        "box rounded": (lambda: (box(1.0, 0.6, 0.15),), 17.3, "geometric"),
        "box little rounded": (lambda: (box(0.9, 0.6, 0.03),), 0.0, "geometric"),
        "slot": (lambda: (box(1.26, 0.26, 0.1299999),), 30.7, "geometric"),
        "slot level": (lambda: (box(1.2, 0.4, 0.1999999),), 0.0, "geometric"),
        "gear 18": (lambda: (gear(18, 0.40, 0.5), hole(0, 0, 0.15)), 3.0, "geometric"),
        "gear 12": (lambda: (gear(12, 0.37, 0.5, 0.45), hole(0, 0, 0.2)), 11.0, "geometric"),
        "gear 24": (lambda: (gear(24, 0.42, 0.5), hole(0, 0, 0.1)), 0.0, "geometric"),
        "keyhole": (lambda: (keyhole(0.3, 0.09, 0.8),), -63.0, "geometric"),
        "keyhole level": (lambda: (keyhole(0.3, 0.12, 0.9),), 90.0, "geometric"),
        "plate": (lambda: plate(0.08, 0.06, 0.16), 11.0, "geometric"),
        "plate level": (lambda: plate(0.12, 0.07, 0.13), 0.0, "geometric"),
        "bracket": (lambda: (rounded(ell, [0, 0.06, 0.06, 0.12, 0.06, 0.06]),), 0.0, "geometric"),
        "tee": (
            lambda: (rounded(tee, [0.05, 0.1, 0, 0, 0.1, 0.05, 0.05, 0.05]),),
            5.0,
            "geometric",
        ),
        "star 5": (lambda: (star(5, 0.22),), 0.0, "geometric"),
        "star 7": (lambda: (star(7, 0.3),), 12.0, "geometric"),
        "arrow": (lambda: (polygon(*arrow),), 0.0, "geometric"),
        "house": (
            lambda: (
                polygon(*house),
                rounded([(-0.1, -0.3), (-0.1, 0.05), (0.1, 0.05), (0.1, -0.3)], 0),
            ),
            0.0,
            "geometric",
        ),
        "ring": (lambda: (disc(0, 0, 0.5), hole(0, 0, 0.32)), 0.0, "geometric"),
        "washer": (lambda: (disc(0, 0, 0.5), hole(0.05, 0, 0.2)), 20.0, "geometric"),
        "hexagon": (lambda: (star(3, 0.5), hole(0, 0, 0.28)), 4.0, "geometric"),
        "pebble": (
            lambda: (wavy(0.35, (2, 0.08, 0.4), (3, 0.05, -1.57), (5, 0.025, 1.0)),),
            0.0,
            "organic",
        ),
        "blob": (
            lambda: (wavy(0.36, (2, 0.06, 1.4), (4, 0.04, 0.5), (7, 0.012, 1.0)),),
            30.0,
            "organic",
        ),
        "lobed": (
            lambda: (wavy(0.36, (5, 0.09, 0.3), (3, 0.03, -1.57), (11, 0.01, -1.57)),),
            0.0,
            "organic",
        ),
        "flower": (lambda: (wavy(0.36, (6, 0.08, 0.2), (2, 0.02, 0.3)),), 10.0, "organic"),
        "leaf": (lambda: (leaf(0.06, 0.22),), 20.0, "organic"),
        "leaf wide": (lambda: (leaf(0.03, 0.3),), -35.0, "organic"),
    } | {f"letter {c}": ((lambda c=c: letter(c)), 0.0, "letter") for c in "ERSgBaKt"}


def drawings() -> dict[str, Drawing]:
    """All drawings by name; every other one is kept aside."""
    return {
        name: Drawing(make(), turn, kind, bool(k % 2))
        for k, (name, (make, turn, kind)) in enumerate(_pairs().items())
    }
