"""A map of cells with common borders."""

from __future__ import annotations

import numpy as np
from tests.support.shapes import on_circle

import shapespline as ss


def wavy(a, b, height, waves, n=60):
    """From a to b with a wave across; both ends exact."""
    t = np.linspace(0, 1, n)
    along = np.subtract(b, a)
    normal = np.array([-along[1], along[0]]) / np.hypot(*along)
    points = a + t[:, None] * along + (height * np.sin(waves * np.pi * t))[:, None] * normal
    points[0], points[-1] = a, b
    return points


def cells():
    """A map of four cells that meet in one point, with wavy borders, and an island in one."""
    corner = {name: np.array(at, float) for name, at in {
        "sw": (0, 0), "s": (10, 0), "se": (20, 0), "w": (0, 10), "c": (10, 10), "e": (20, 10),
        "nw": (0, 20), "n": (10, 20), "ne": (20, 20)}.items()}  # fmt: skip
    edges = {pair: wavy(corner[pair[0]], corner[pair[1]], 0.6, 3) for pair in [
        ("s", "c"), ("c", "n"), ("w", "c"), ("c", "e"), ("sw", "s"), ("s", "se"), ("se", "e"),
        ("e", "ne"), ("ne", "n"), ("n", "nw"), ("nw", "w"), ("w", "sw")]}  # fmt: skip

    def ring(*names):
        parts = []
        for a, b in zip(names, names[1:] + names[:1], strict=True):
            part = edges[a, b] if (a, b) in edges else edges[b, a][::-1]
            parts.append(part[:-1])
        return ss.Contour(np.concatenate(parts), closed=True)

    island = (3, 3) + 2 * on_circle(80)
    return [
        ring("sw", "s", "c", "w"),
        ring("s", "se", "e", "c"),
        ring("c", "e", "ne", "n"),
        ring("w", "c", "n", "nw"),
        ss.Contour(island, closed=True),
        ss.Contour(np.roll(island[::-1], 17, axis=0), closed=True),
    ]
