"""What drawings are made of: boxes, gears, slots, stars, leaves, in units of about one.

Outer outlines run counter-clockwise, holes clockwise.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import CubicSpline

from benchmarks.drawn.truth import Arc, Cubic, Line, Outline

if TYPE_CHECKING:
    from collections.abc import Sequence

    from benchmarks.drawn.truth import Array, Element


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


def slot(x: float, y: float, length: float, width: float) -> Outline:
    """A level slot with round ends, clockwise."""
    r, half = width / 2, 0.5 * (length - width)
    a, b = np.array([x - half, y]), np.array([x + half, y])
    up = np.array([0.0, r])
    return (
        Line(a + up, b + up),
        Arc(b, r, np.pi / 2, -np.pi),
        Line(b - up, a - up),
        Arc(a, r, -np.pi / 2, -np.pi),
    )


def grid(columns: int, rows: int, dx: float, dy: float, radius: float) -> list[Outline]:
    """Equal holes at equal steps about the origin."""
    return [
        hole((i - 0.5 * (columns - 1)) * dx, (j - 0.5 * (rows - 1)) * dy, radius)
        for j in range(rows)
        for i in range(columns)
    ]


def ring_of(count: int, pitch: float, radius: float) -> list[Outline]:
    """Equal holes at equal steps on a circle about the origin."""
    angles = (2 * np.pi * np.arange(count) / count).tolist()
    return [hole(pitch * float(np.cos(a)), pitch * float(np.sin(a)), radius) for a in angles]


def cross(arm: float, half: float, radius: float = 0.0) -> Outline:
    """Four equal arms, all corners rounded alike."""
    quarter = [(arm, -half), (arm, half), (half, half)]
    corners = []
    for _ in range(4):
        corners += quarter
        quarter = [(-y, x) for x, y in quarter]
    return rounded(corners, radius)


def comb(teeth: int, width: float, depth: float) -> Outline:
    """Equal teeth and gaps, upwards from a bar."""
    right = (2 * teeth - 1) * width / 2
    corners = [(-right, -depth / 2), (right, -depth / 2)]
    for k in range(teeth):
        x = right - 2 * k * width
        corners += [(x, depth), (x - width, depth)]
        if k < teeth - 1:
            corners += [(x - width, 0.0), (x - 2 * width, 0.0)]
    return polygon(*corners)
