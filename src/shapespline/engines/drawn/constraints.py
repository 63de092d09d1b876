"""Equations between lines and circles: value and Jacobian over the few unknowns that they join.

Unknowns of a line are its direction of travel and its offset along the left normal, of a circle the
centre and the radius.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, hypot, sin
from typing import TYPE_CHECKING, Protocol, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.typing import FloatArray, IntArray

    ComplexArray = NDArray[np.complex128]
    Values: TypeAlias = tuple[FloatArray, IntArray, FloatArray]


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
        jacobian = np.eye(len(self.a))
        if self.b:
            jacobian = np.hstack([jacobian, -self.sign * jacobian])
        return self.values([self], x)[0], jacobian

    @staticmethod
    def values(ones: Sequence[Difference], x: FloatArray) -> Values:
        """H of some, the unknowns of each and the Jacobian over these."""
        rows = [
            (i, j, one.turn, one.sign if one.b else 0.0)
            for one in ones
            for i, j in zip(one.a, one.b or one.a, strict=True)
        ]
        table = np.array(rows).reshape(-1, 4)
        index, turn, sign = table[:, :2].astype(np.int64), table[:, 2], table[:, 3]
        h = x[index[:, 0]] - turn - sign * x[index[:, 1]]
        return h, index, np.column_stack([np.ones(len(h)), -sign])


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
        h, _, jacobian = self.values([self], x)
        return h, jacobian

    @staticmethod
    def values(ones: Sequence[LineTouches], x: FloatArray) -> Values:
        """H of some, the unknowns of each and the Jacobian over these."""
        index = np.array([one.index for one in ones], dtype=np.int64).reshape(-1, 5)
        way = np.array([one.way for one in ones])
        phi, d, cx, cy, r = x[index].T
        c, s = np.cos(phi), np.sin(phi)
        h = -s * cx + c * cy - d - way * r
        one = np.ones(len(ones))
        return h, index, np.column_stack([-c * cx - s * cy, -one, -s, c, -way])


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


def equations(constraints: Sequence[Constraint], x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values and Jacobian of all: those of one kind at once, of which there may be many."""
    values, rows = [np.empty(0)], [np.empty((0, len(x)))]
    differences = [one for one in constraints if isinstance(one, Difference)]
    touches = [one for one in constraints if isinstance(one, LineTouches)]
    for h, index, jacobian in (Difference.values(differences, x), LineTouches.values(touches, x)):
        row = np.zeros((len(h), len(x)))
        for column, slopes in zip(index.T, jacobian.T, strict=True):
            row[np.arange(len(h)), column] += slopes
        values.append(h)
        rows.append(row)
    for one in constraints:
        if not isinstance(one, Difference | LineTouches):
            h, own_slopes = one.value(x)
            row = np.zeros((len(h), len(x)))
            row[:, one.index] = own_slopes
            values.append(h)
            rows.append(row)
    return np.concatenate(values), np.concatenate(rows)
