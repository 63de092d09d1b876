"""Circles that touch two directed lines, and the arcs between these."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import BoolArray, FloatArray, IntArray

# Half a turn and nearly so leads to the side on which the other one lies, whatever its angle.
NEARLY_BACK = np.radians(150.0)
# Circles that move out by one move their arcs by no less, or none is told; the sides of others turn
# by less than 16 degrees (TRC-49).
SHALLOWEST = 0.01
# Points of an arc.
ARC_POINTS = 9
_ARC = np.linspace(0.0, 1.0, ARC_POINTS)
_FLAT = np.linspace(0.0, 1.0, ARC_POINTS - 2)


class Arcs(NamedTuple):
    """Circular arcs: middles, radii, directions from the middle to the beginning, turns."""

    centres: FloatArray
    radii: FloatArray
    firsts: FloatArray
    turns: FloatArray

    def points(self, radii: FloatArray) -> FloatArray:
        """Points of each, of other radii, shape (k, ARC_POINTS, 2)."""
        angle = self.firsts[:, None] + _ARC * self.turns[:, None]
        ways = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return self.centres[:, None] + radii[:, None, None] * ways

    @property
    def along(self) -> FloatArray:
        """Points of each."""
        return self.points(self.radii)

    @property
    def half_length(self) -> FloatArray:
        """From the middle of each to its end."""
        return 0.5 * self.radii * np.abs(self.turns)

    @property
    def cut_off(self) -> FloatArray:
        """Square pixels between each and the corner that it is in place of; of an end no bound."""
        half = np.minimum(0.5 * np.abs(self.turns), 0.5 * NEARLY_BACK)
        return self.radii**2 * (np.tan(half) - half)

    @property
    def chord_radii(self) -> FloatArray:
        """Radii with which the chords between the points enclose as much as the arcs do."""
        step = np.abs(self.turns) / (ARC_POINTS - 1)
        return np.asarray(self.radii / np.sqrt(np.sinc(step / np.pi)))


class Touching:
    """Circles that touch two directed lines each, of which one number is left.

    Middle and radius solve two equations: the distances from the lines are the radius. What is left
    moves the middle by one along the way out, from between the sides to where they turn.
    """

    def __init__(self, sides: Sequence[tuple[FloatArray, FloatArray]]) -> None:
        (p1, u1), (p2, u2) = self.sides = sides
        turns = np.arctan2(_cross(u1, u2), (u1 * u2).sum(axis=1))
        back, other_side = np.abs(turns) > NEARLY_BACK, np.sign(_cross(u1, p2 - p1))
        self.ways = np.where(back, other_side, np.where(turns < 0, -1.0, 1.0))
        wrong = back & (np.sign(turns) != self.ways)
        self.turns = np.where(wrong, turns + 2 * np.pi * self.ways, turns)
        self.inward = [
            self.ways[:, None] * np.stack([-u[:, 1], u[:, 0]], axis=-1) for u in (u1, u2)
        ]
        # Equations in middle and radius, and the shortest solution.
        one, two = (np.column_stack([n, -np.ones(len(n))]) for n in self.inward)
        right = [(n * p).sum(axis=1) for n, p in zip(self.inward, (p1, p2), strict=True)]
        dot = (one * two).sum(axis=1)
        det = np.maximum(4.0 - dot**2, 1e-9)
        first, second = ((2 * a - dot * b) / det for a, b in (right, right[::-1]))
        self.one = first[:, None] * one + second[:, None] * two
        out = u1 - u2
        self.out = out / np.maximum(np.hypot(*out.T), 1e-9)[:, None]
        free = np.cross(one, two)
        size = (free[:, :2] * self.out).sum(axis=1)
        self.free = free / np.where(np.abs(size) < 1e-9, 1e-9, size)[:, None]

    def chosen(self, which: BoolArray | IntArray) -> Touching:
        """Some of them."""
        return Touching([(p[which], u[which]) for p, u in self.sides])

    def through(self, apex: FloatArray) -> FloatArray:
        """The number with which arcs are as far out as some points."""
        gap = ((apex - self.one[:, :2]) * self.out).sum(axis=1) - self.one[:, 2]
        return gap / np.maximum(1.0 + self.free[:, 2], SHALLOWEST)

    def arcs(self, shift: FloatArray) -> Arcs:
        """Those of some numbers."""
        x = self.one + shift[:, None] * self.free
        firsts = np.arctan2(-self.inward[0][:, 1], -self.inward[0][:, 0])
        return Arcs(x[:, :2], np.maximum(x[:, 2], 0.0), firsts, self.turns)

    def square_ends(self, arcs: Arcs) -> FloatArray:
        """Points of square ends with as much ink, in place of those between the ends of arcs."""
        points = arcs.points(arcs.radii)
        ahead = 0.25 * np.pi * arcs.radii[:, None]
        one = points[:, 0] + ahead * self.sides[0][1]
        two = points[:, -1] - ahead * self.sides[1][1]
        return np.asarray(one[:, None] + _FLAT[:, None] * (two - one)[:, None])

    def apexes(self, arcs: Arcs) -> FloatArray:
        """Where lines meet, in place of points between the ends of arcs; of ends square ones."""
        points = arcs.points(arcs.radii)
        ahead = np.tan(0.5 * np.minimum(np.abs(self.turns), NEARLY_BACK)) * arcs.radii
        apex = points[:, 0] + ahead[:, None] * self.sides[0][1]
        corner = np.broadcast_to(apex[:, None], (len(apex), len(_FLAT), 2))
        is_end = np.abs(self.turns) >= NEARLY_BACK
        return np.where(is_end[:, None, None], self.square_ends(arcs), corner)

    def step_for(self, ink: FloatArray, arcs: Arcs) -> FloatArray:
        """By how much the number has to rise for so many square pixels of ink more."""
        turn, shrinks = np.abs(self.turns), self.free[:, 2]
        # What is swept by a step d is d radius w + d^2 shrinks w / 2.
        w = 2.0 * np.sin(0.5 * turn) + shrinks * turn
        swept, more = arcs.radii * w, self.ways * ink
        root = np.sqrt(np.maximum(swept**2 + 2.0 * shrinks * w * more, 0.0))
        return np.asarray(2.0 * more / np.maximum(swept + root, 0.05))


def _cross(u: FloatArray, v: FloatArray) -> FloatArray:
    return np.asarray(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
