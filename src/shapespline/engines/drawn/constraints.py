"""Equations between lines and circles: value and Jacobian over the few unknowns that they join.

Unknowns of a line are its direction of travel and its offset along the left normal, of a circle the
centre and the radius.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, hypot, sin
from operator import is_
from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.typing import FloatArray, IntArray

    ComplexArray = NDArray[np.complex128]


class Constraint(Protocol):
    """An equation h = 0."""

    @property
    def index(self) -> tuple[int, ...]:
        """The unknowns that it joins."""

    def value(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """h, and its Jacobian over them."""


@dataclass(frozen=True)
class Difference:
    """x[a] - sign x[b] = turn, for each of some pairs; of one unknown where b is missing."""

    a: tuple[int, ...]
    b: tuple[int, ...]
    turn: float = 0.0
    sign: float = 1.0

    @property
    def index(self) -> tuple[int, ...]:
        """The unknowns that it joins."""
        return self.a + self.b

    def value(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """h, and its Jacobian."""
        n = len(self.a)
        h, jacobian = x[list(self.a)] - self.turn, np.zeros((n, len(self.index)))
        rows = np.arange(n)
        jacobian[rows, rows] = 1.0
        if self.b:
            h = h - self.sign * x[list(self.b)]
            jacobian[rows, n + rows] = -self.sign
        return h, jacobian


@dataclass(frozen=True)
class LineTouches:
    """A line with unknowns at ``a`` touches the circle at ``b``, which turns by ``way``."""

    a: int
    b: int
    way: float

    @property
    def index(self) -> tuple[int, ...]:
        """The unknowns that it joins."""
        return self.a, self.a + 1, self.b, self.b + 1, self.b + 2

    def value(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """h, and its Jacobian."""
        return _touches(x[None, list(self.index)], np.array([self.way]))


@dataclass(frozen=True)
class CirclesTouch:
    """Two circles touch, one within the other if they turn alike."""

    a: int
    b: int
    alike: bool

    @property
    def index(self) -> tuple[int, ...]:
        """The unknowns that it joins."""
        return (*range(self.a, self.a + 3), *range(self.b, self.b + 3))

    def value(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """h, and its Jacobian."""
        ax, ay, r, bx, by, s = (float(x[i]) for i in self.index)
        d = max(hypot(ax - bx, ay - by), 1e-300)
        ux, uy = (ax - bx) / d, (ay - by) / d
        if not self.alike:
            return np.array([d - r - s]), np.array([[ux, uy, -1.0, -ux, -uy, -1.0]])
        sign = 1.0 if r > s else -1.0
        return np.array([d - sign * (r - s)]), np.array([[ux, uy, -sign, -ux, -uy, sign]])


@dataclass(frozen=True)
class PassesThrough:
    """A line or a circle with unknowns at ``a`` goes through a point."""

    a: int
    is_line: bool
    point: tuple[float, float]

    @property
    def index(self) -> tuple[int, ...]:
        """The unknowns that it joins."""
        return tuple(range(self.a, self.a + (2 if self.is_line else 3)))

    def value(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """h, and its Jacobian."""
        own, (px, py) = [float(x[i]) for i in self.index], self.point
        if self.is_line:
            c, s = cos(own[0]), sin(own[0])
            return np.array([c * py - s * px - own[1]]), np.array([[-c * px - s * py, -1.0]])
        ux, uy = px - own[0], py - own[1]
        far = max(hypot(ux, uy), 1e-300)
        return np.array([far - own[2]]), np.array([[-ux / far, -uy / far, -1.0]])


@dataclass(frozen=True)
class Images:
    """The elements at ``b`` are the images of those at ``a``: turned about a centre, or mirrored.

    All are lines, or all circles. ``angle`` is that of the turn; the centre is at ``at``. Without
    it the motion is a mirror, and direction and offset of its axis are there.
    """

    a: tuple[int, ...]
    b: tuple[int, ...]
    at: int
    is_line: bool
    angle: float | None = None

    @cached_property
    def index(self) -> tuple[int, ...]:
        """The unknowns that it joins, each once."""
        return tuple(dict.fromkeys(self._taken.ravel().tolist()))

    @cached_property
    def _taken(self) -> IntArray:
        """One row of unknowns for each pair: own, image's, the motion's."""
        n, motion = (2 if self.is_line else 3), (self.at, self.at + 1)
        pairs = zip(self.a, self.b, strict=True)
        return np.array([[*range(i, i + n), *range(j, j + n), *motion] for i, j in pairs])

    @cached_property
    def _columns(self) -> IntArray:
        """The same as places among those that it joins."""
        place = {i: k for k, i in enumerate(self.index)}
        return np.array([[place[i] for i in row] for row in self._taken.tolist()])

    def value(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """h, and its Jacobian by complex steps, which are exact to rounding."""
        taken, columns = self._taken, self._columns
        n_taken = taken.shape[1]
        # As they are, then each unknown a step beside.
        z = np.repeat(x[taken].astype(complex)[None], n_taken + 1, axis=0)
        z[np.arange(1, n_taken + 1), :, np.arange(n_taken)] += 1e-30j
        h, slopes = np.split(self._values(z), [1])
        rows = np.arange(h.size).reshape(h.shape)
        jacobian = np.zeros((h.size, len(self.index)))
        np.add.at(jacobian, (rows, columns.T[:, None]), np.imag(slopes) * 1e30)
        return np.real(h).ravel(), jacobian

    def _values(self, z: ComplexArray) -> ComplexArray:
        """Shape (tries, 2 or 3, pairs), of unknowns (tries, pairs, 6 or 8)."""
        u, v = z[..., -2], z[..., -1]
        if self.is_line:
            phi, d, psi, e = np.moveaxis(z[..., :4], -1, 0)
            if self.angle is not None:
                turned = phi + self.angle
                off = np.cos(phi) * v - np.sin(phi) * u - d  # of the centre from the line
                there = np.cos(turned) * v - np.sin(turned) * u - off
            else:
                turned = 2 * u - phi + np.pi
                px, py = -np.sin(phi) * d, np.cos(phi) * d  # the foot of the origin, mirrored
                far = np.cos(u) * py - np.sin(u) * px - v
                px, py = px + 2 * far * np.sin(u), py - 2 * far * np.cos(u)
                there = np.cos(turned) * py - np.sin(turned) * px
            return np.stack([np.sin(psi - turned), e - there], axis=-2)
        cx, cy, r, dx, dy, s = np.moveaxis(z[..., :6], -1, 0)
        if self.angle is not None:
            c, sine = cos(self.angle), sin(self.angle)
            px = u + c * (cx - u) - sine * (cy - v)
            py = v + sine * (cx - u) + c * (cy - v)
        else:
            far = np.cos(u) * cy - np.sin(u) * cx - v
            px, py = cx + 2 * far * np.sin(u), cy - 2 * far * np.cos(u)
        return np.stack([dx - px, dy - py, s - r], axis=-2)


class Equations:
    """All equations of a model; those of one kind at once, of which there may be many."""

    def __init__(self, constraints: Sequence[Constraint], n: int) -> None:
        self._constraints, self._n = tuple(constraints), n
        self._others = [c for c in constraints if not isinstance(c, Difference | LineTouches)]
        pairs = [
            (i, j, one.turn, one.sign if one.b else 0.0)
            for one in constraints
            if isinstance(one, Difference)
            for i, j in zip(one.a, one.b or one.a, strict=True)
        ]
        table = np.array(pairs).reshape(-1, 4)
        self._a, self._b = table[:, :2].astype(np.int64).T
        self._turn, self._sign = table[:, 2], table[:, 3]
        own = np.arange(len(table))
        self._differences = np.zeros((len(table), n))
        self._differences[own, self._a] += 1.0
        self._differences[own, self._b] -= self._sign
        touches = [one for one in constraints if isinstance(one, LineTouches)]
        self._touching = np.array([one.index for one in touches], dtype=np.int64).reshape(-1, 5)
        self._way = np.array([one.way for one in touches])

    def are_of(self, constraints: Sequence[Constraint], n: int) -> bool:
        """Whether they are those of so many unknowns."""
        if len(constraints) != len(self._constraints) or n != self._n:
            return False
        return all(map(is_, constraints, self._constraints))

    def at(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Values and Jacobian."""
        values = [x[self._a] - self._turn - self._sign * x[self._b]]
        rows = [self._differences]
        if len(self._way):
            h, slopes = _touches(x[self._touching], self._way)
            row = np.zeros((len(h), self._n))
            np.put_along_axis(row, self._touching, slopes, axis=1)
            values.append(h)
            rows.append(row)
        for one in self._others:
            h, slopes = one.value(x)
            row = np.zeros((len(h), self._n))
            row[:, one.index] = slopes
            values.append(h)
            rows.append(row)
        return np.concatenate(values), np.concatenate(rows)


def _touches(unknowns: FloatArray, way: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Of lines that touch circles, shape (m, 5): h, and its Jacobian over these unknowns."""
    phi, d, cx, cy, r = unknowns.T
    c, s = np.cos(phi), np.sin(phi)
    h = -s * cx + c * cy - d - way * r
    return h, np.column_stack([-c * cx - s * cy, -np.ones(len(way)), -s, c, -way])
