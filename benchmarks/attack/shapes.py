"""Seeded generators of shapes that find the weak places of a fit: arrays of points, and closed."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.random import Generator
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


class Drawn(NamedTuple):
    """A shape of a family."""

    family: str
    points: Array
    closed: bool


def polyline(rng: Generator) -> tuple[Array, bool]:
    """2 to 13 random points, some of them on a grid, some twice, some a rounding apart."""
    closed = bool(rng.integers(2))
    points = rng.normal(0, 1, (int(rng.integers(4 if closed else 2, 14)), 2))
    if rng.random() < 0.5:
        points = points.round(int(rng.integers(1, 3)))
    at = int(rng.integers(len(points)))
    if rng.random() < 0.2:
        points = np.insert(points, at, points[at], axis=0)
    elif rng.random() < 0.2:
        points = np.insert(points, at, points[at] * (1 + 3e-16) + 1e-16, axis=0)
    return points, closed


def fourier(rng: Generator) -> tuple[Array, bool]:
    """A smooth closed outline of a few frequencies."""
    t = np.linspace(0, 2 * np.pi, int(rng.integers(40, 600)), endpoint=False)
    k = np.arange(2, 9)
    size = rng.normal(0, 0.5, (len(k), 2)) / k[:, None]
    radius = 1 + np.cos(np.outer(t, k)) @ size[:, 0] + np.sin(np.outer(t, k)) @ size[:, 1]
    return np.column_stack([radius * np.cos(t), radius * np.sin(t)]), True


def rounded_polygon(rng: Generator) -> tuple[Array, bool]:
    """Straight sides and arcs between them."""
    n = int(rng.integers(3, 9))
    turn = 2 * np.pi * (np.arange(n) + 0.3 * rng.random(n)) / n
    corners = np.column_stack([np.cos(turn), np.sin(turn)]) * rng.uniform(0.5, 1, (n, 1))
    parts, share = [], float(rng.uniform(0.02, 0.4))
    s = np.linspace(0, 1, int(rng.integers(4, 25)))[:, None]
    for before, at, after in zip(
        np.roll(corners, 1, axis=0), corners, np.roll(corners, -1, axis=0), strict=True
    ):
        begin, end = at + share * (before - at), at + share * (after - at)
        parts.append((1 - s) ** 2 * begin + 2 * s * (1 - s) * at + s**2 * end)
    return np.concatenate(parts), True


def spiral(rng: Generator) -> tuple[Array, bool]:
    """Turns next to each other."""
    t = np.linspace(0.5, float(rng.uniform(2, 6)) * 2 * np.pi, int(rng.integers(150, 800)))
    return np.column_stack([t * np.cos(t), t * np.sin(t)]), False


def comb(rng: Generator) -> tuple[Array, bool]:
    """Teeth with slits that are narrower than most tolerances."""
    n, slit = int(rng.integers(2, 8)), float(10.0 ** rng.uniform(-4, -1))
    x = np.concatenate([[i, i, i + 1 - slit, i + 1 - slit] for i in range(n)])
    y = np.tile([0.2, 3.0, 3.0, 0.2], n)
    corners = np.column_stack([[*x, n, n, 0], [*y, 0.2, 0, 0]])
    return along(corners, int(rng.integers(80, 500)), closed=True), True


def cusps(rng: Generator) -> tuple[Array, bool]:
    """A hypocycloid, or a semicubical parabola."""
    if rng.random() < 0.5:
        k = int(rng.integers(3, 7))
        t = np.linspace(0, 2 * np.pi, int(rng.integers(60, 500)), endpoint=False)
        x = (k - 1) * np.cos(t) + np.cos((k - 1) * t)
        return np.column_stack([x, (k - 1) * np.sin(t) - np.sin((k - 1) * t)]), True
    t = np.linspace(-1, 1, int(rng.integers(41, 401)))
    return np.column_stack([t**2, t**3]), False


def airfoil(rng: Generator) -> tuple[Array, bool]:
    """A thin trailing edge, closed or a hair open."""
    n, thick = int(rng.integers(40, 200)), float(rng.uniform(0.03, 0.2))
    x = 0.5 * (1 - np.cos(np.linspace(0, np.pi, n)))
    y = 5 * thick * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3)
    y += -5 * thick * float(rng.choice([0.1015, 0.1036])) * x**4
    camber = float(rng.uniform(0, 0.4)) * x * (1 - x)
    lower, upper = np.column_stack([x, camber - y]), np.column_stack([x, camber + y])
    return np.concatenate([upper[::-1], lower[1:]]), bool(rng.integers(2))


def pixels(rng: Generator) -> tuple[Array, bool]:
    """A smooth outline in whole pixels, without repetitions."""
    points, _ = fourier(rng)
    fine = along(points, 4000, closed=True)
    chain = np.round(float(rng.uniform(10, 90)) * fine)
    different = (chain != np.roll(chain, 1, axis=0)).any(axis=1)
    return chain[different], True


def retraced(rng: Generator) -> tuple[Array, bool]:
    """A stroke there and back, on itself or a hair beside."""
    x = np.linspace(0, 10, int(rng.integers(20, 200)))
    there = np.column_stack([x, np.sin(float(rng.uniform(0.2, 2)) * x)])
    hair = float(rng.choice([0.0, 1e-12, 1e-3]))
    return np.concatenate([there, there[-2::-1] + np.array([0.0, hair])]), bool(rng.integers(2))


def uneven(rng: Generator) -> tuple[Array, bool]:
    """Steps over many orders of magnitude."""
    t = np.cumsum(10.0 ** rng.uniform(-6, 0, int(rng.integers(20, 200))))
    t *= 2 * np.pi / t[-1]
    t = t[:-1]
    return np.column_stack([3 * np.cos(t), np.sin(t) + 0.3 * np.sin(3 * t)]), True


def walk(rng: Generator) -> tuple[Array, bool]:
    """A random walk: nothing is smooth."""
    return np.cumsum(rng.normal(0, 1, (int(rng.integers(20, 200)), 2)), axis=0), False


FAMILIES: dict[str, Callable[[Generator], tuple[Array, bool]]] = {
    "polyline": polyline,
    "fourier": fourier,
    "rounded": rounded_polygon,
    "spiral": spiral,
    "comb": comb,
    "cusps": cusps,
    "airfoil": airfoil,
    "pixels": pixels,
    "retraced": retraced,
    "uneven": uneven,
    "walk": walk,
}


def drawn(seed: int, family: str | None = None) -> Drawn:
    """The shape of a seed: of a family, now and then far away, tiny or huge."""
    rng = np.random.default_rng(seed)
    name = str(rng.choice(list(FAMILIES)))
    points, closed = FAMILIES[name if family is None else family](rng)
    size = float(np.ptp(points, axis=0).max())
    if rng.random() < 0.1:
        points = points * float(rng.choice([1e-9, 1e9]))
    elif rng.random() < 0.1:
        points = points + 1e9 * size * 1e-3
    return Drawn(name if family is None else family, points, closed)


def along(corners: Array, n: int, *, closed: bool) -> Array:
    """Points at equal steps along a polyline, its corners among them."""
    track = np.concatenate([corners, corners[:1]]) if closed else corners
    at = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(track, axis=0).T))])
    stations = np.unique(np.concatenate([np.linspace(0, at[-1], n), at]))
    stations = stations[:-1] if closed else stations
    return np.column_stack([np.interp(stations, at, axis) for axis in track.T])
