"""Equations between lines and circles: value and Jacobian over the few unknowns that they join.

Unknowns of a line are its direction of travel and its offset along the left normal, of a circle the
centre and the radius.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, sin
from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import FloatArray

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
        h = x[list(self.a)] - self.turn
        jacobian = np.eye(len(self.a))
        if self.b:
            h = h - self.sign * x[list(self.b)]
            jacobian = np.hstack([jacobian, -self.sign * jacobian])
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
        phi, d, cx, cy, r = (float(x[i]) for i in self.index)
        c, s = cos(phi), sin(phi)
        h = -s * cx + c * cy - d - self.way * r
        return np.array([h]), np.array([[-c * cx - s * cy, -1.0, -s, c, -self.way]])


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

    @property
    def index(self) -> tuple[int, ...]:
        """The unknowns that it joins, each once."""
        n = 2 if self.is_line else 3
        own = [i + k for i in self.a + self.b for k in range(n)]
        return tuple(dict.fromkeys([*own, self.at, self.at + 1]))

    def value(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """h, and its Jacobian by complex steps, which are exact to rounding."""
        n, m = (2 if self.is_line else 3), len(self.a)
        place = {i: k for k, i in enumerate(self.index)}
        # One row of unknowns for each pair: own, image's, the motion's.
        taken = np.array(
            [
                [*range(i, i + n), *range(j, j + n), self.at, self.at + 1]
                for i, j in zip(self.a, self.b, strict=True)
            ]
        )
        columns = np.array([[place[i] for i in row] for row in taken.tolist()])
        z = x[taken].astype(complex)
        h = self._values(z)
        jacobian = np.zeros((n * m, len(place)))
        rows = np.arange(n * m).reshape(n, m)
        for k in range(taken.shape[1]):
            z[:, k] += 1e-30j
            slopes = np.imag(self._values(z)) * 1e30
            z[:, k] = x[taken[:, k]]
            for one in range(n):
                np.add.at(jacobian, (rows[one], columns[:, k]), slopes[one])
        return np.real(h).ravel(), jacobian

    def _values(self, z: ComplexArray) -> ComplexArray:
        """Shape (2 or 3, pairs)."""
        u, v = z[:, -2], z[:, -1]
        if self.is_line:
            phi, d, psi, e = z[:, :4].T
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
            return np.stack([np.sin(psi - turned), e - there])
        cx, cy, r, dx, dy, s = z[:, :6].T
        if self.angle is not None:
            c, sine = cos(self.angle), sin(self.angle)
            px = u + c * (cx - u) - sine * (cy - v)
            py = v + sine * (cx - u) + c * (cy - v)
        else:
            far = np.cos(u) * cy - np.sin(u) * cx - v
            px, py = cx + 2 * far * np.sin(u), cy - 2 * far * np.cos(u)
        return np.stack([dx - px, dy - py, s - r])
