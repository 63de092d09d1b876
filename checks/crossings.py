"""Crossings of a polyline with itself and with another."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.spatial import cKDTree

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from checks.curves import Array

# Parts of all segments together, at most, for each segment.
PARTS = 4
# Every vertex is moved by so much of the size, in a direction that goes around once along the way:
# what meets in a vertex then crosses, or does not.
APART = 1e-9


class _Parts(NamedTuple):
    """Short segments that a polyline is cut into."""

    begin: Array
    end: Array

    @property
    def middle(self) -> Array:
        return 0.5 * (self.begin + self.end)

    @property
    def longest(self) -> float:
        return float(np.hypot(*(self.end - self.begin).T).max())


def self_crossings(polyline: Array) -> int:
    """How often a polyline crosses itself; a closed one repeats its first point."""
    parts = _cut(polyline)
    pairs = cKDTree(parts.middle).query_pairs(parts.longest, output_type="ndarray")
    one, other = np.sort(pairs, axis=1).T
    apart = other - one > 1
    if np.hypot(*(polyline[-1] - polyline[0])) <= APART * np.ptp(polyline, axis=0).max():
        apart &= other - one < len(parts.begin) - 1
    return int(_cross(parts, one[apart], parts, other[apart]).sum())


def crossings(one: Array, other: Array) -> int:
    """How often two polylines cross each other."""
    a, b = _cut(one), _cut(other)
    near = cKDTree(a.middle).query_ball_tree(cKDTree(b.middle), 0.5 * (a.longest + b.longest))
    i = np.repeat(np.arange(len(near)), [len(found) for found in near])
    j = np.array([k for found in near for k in found], dtype=np.int64)
    return int(_cross(a, i, b, j).sum())


def _cut(polyline: Array) -> _Parts:
    length = np.hypot(*np.diff(polyline, axis=0).T)
    size = np.ptp(polyline, axis=0).max()
    # Where pieces meet up to rounding is one point.
    keep = np.concatenate([[True], length > APART * size])
    angle = 2 * np.pi * np.concatenate([[0.0], np.cumsum(length)]) / length.sum()
    moved = polyline + APART * size * np.column_stack([np.cos(angle), np.sin(angle)])
    begin, side = moved[keep][:-1], np.diff(moved[keep], axis=0)
    length = np.hypot(*side.T)
    counts = np.ceil(length * PARTS * len(length) / length.sum()).astype(int)
    owner = np.repeat(np.arange(len(begin)), counts)
    k = np.concatenate([np.arange(n) for n in counts])
    first = begin[owner] + (k / counts[owner])[:, None] * side[owner]
    return _Parts(first, np.concatenate([first[1:], moved[-1:]]))


def _cross(a: _Parts, i: NDArray[np.int_], b: _Parts, j: NDArray[np.int_]) -> NDArray[np.bool_]:
    """Whether part i of one and part j of another have a point in common."""
    p, q, r, s = a.begin[i], a.end[i], b.begin[j], b.end[j]
    on_two_sides = (_side(p, q, r) > 0) != (_side(p, q, s) > 0)
    return on_two_sides & ((_side(r, s, p) > 0) != (_side(r, s, q) > 0))


def _side(a: Array, b: Array, point: Array) -> Array:
    """Twice the area of each triangle: positive where the point lies left of a to b."""
    u, v = b - a, point - a
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
