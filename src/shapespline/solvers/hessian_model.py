"""Approximations of the Hessian: immutable values that give a direction and take an update.

The formulas of the generalised BFGS family (METHOD, section 3; `quasi_newton` names the methods),
O(n) but for the dense one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from shapespline.solvers.line_search import dot

if TYPE_CHECKING:
    from shapespline.typing import FloatArray

_FLOOR = 1e-12  # of the old entry; a diagonal must stay positive in spite of round-off


@dataclass(frozen=True, slots=True)
class Pair:
    """A step s, the change of the gradient y and their product rho = y's > 0."""

    s: FloatArray
    y: FloatArray
    rho: float


class HessianModel(Protocol):
    """An immutable approximation of the Hessian."""

    def direction(self, gradient: FloatArray, /) -> FloatArray:
        """Return the search direction as a fresh array."""

    def updated(self, pair: Pair, /) -> HessianModel:
        """Return the model after a step; it may keep the pair's arrays."""


@dataclass(frozen=True, slots=True)
class FixedDiagonal:
    """B~ is the start diagonal (one-step secant), and the base of the other diagonals.

    With ``secant`` the model is BFGS(B~, pair) and ``diagonal`` is that of B~, one update behind;
    without, the model is the diagonal alone.
    """

    diagonal: FloatArray
    secant: bool = True
    pair: Pair | None = None

    def solve(self, v: FloatArray) -> FloatArray:
        """Replace v by B~^-1 v, in place."""
        v /= self.diagonal
        return v

    def diagonal_after(self, pair: Pair) -> FloatArray:
        """Return the diagonal that stands in for BFGS(B~, pair)."""
        return self.diagonal

    def direction(self, gradient: FloatArray) -> FloatArray:
        """Return -B+^-1 g, with the inverse as in Eq. 11 of [1] (Eq. 6.17 of [2])."""
        if self.pair is None:
            d = self.solve(gradient.copy())
            return np.negative(d, out=d)
        s, y, rho = self.pair.s, self.pair.y, self.pair.rho
        a = dot(s, gradient) / rho
        q = y * -a
        q += gradient
        z = self.solve(q)
        z += s * (a - dot(y, z) / rho)
        return np.negative(z, out=z)

    def updated(self, pair: Pair) -> FixedDiagonal:
        """Catch up by the pair kept (secant) or take the new one at once."""
        if not self.secant:
            return type(self)(self.diagonal_after(pair), False)
        diagonal = self.diagonal if self.pair is None else self.diagonal_after(self.pair)
        return type(self)(diagonal, True, pair)


class DirectDiagonal(FixedDiagonal):
    """B~ is the diagonal of the last matrix (Eq. 10 of [1])."""

    __slots__ = ()

    def diagonal_after(self, pair: Pair) -> FloatArray:
        """Return b + y^2 / rho - (b s)^2 / s'Bs, floored at a fraction of b."""
        b = self.diagonal
        bs = b * pair.s
        curvature = dot(bs, pair.s)
        bs *= bs
        bs /= curvature
        after = pair.y * pair.y
        after /= pair.rho
        after += b
        after -= bs
        return np.maximum(after, np.multiply(b, _FLOOR, out=bs), out=after)


class InverseDiagonal(FixedDiagonal):
    """B~^-1 is the diagonal of the last inverse (Algorithm 1 and Eq. 11 of [1])."""

    __slots__ = ()

    def solve(self, v: FloatArray) -> FloatArray:
        """Replace v by diag(H) v, in place."""
        v *= self.diagonal
        return v

    def diagonal_after(self, pair: Pair) -> FloatArray:
        """Return d (1 - s y / rho)^2 + s^2 (sum over j != i of d_j y_j^2) / rho^2 + s^2 / rho."""
        d, s, y, rho = self.diagonal, pair.s, pair.y, pair.rho
        after = y * y
        after *= d
        np.subtract(after.sum(), after, out=after)
        np.maximum(after, 0.0, out=after)  # round-off, where one entry is all of the sum
        after /= rho
        after += 1.0
        after *= s
        after *= s
        after /= rho
        kept = s * y
        kept /= -rho
        kept += 1.0
        kept *= kept
        kept *= d
        after += kept
        return after


@dataclass(frozen=True, slots=True)
class DenseInverse:
    """The full inverse matrix (Eq. 7 and 8 of [1]; Eq. 6.17 of [2])."""

    matrix: FloatArray

    def direction(self, gradient: FloatArray) -> FloatArray:
        """Return -H g."""
        return -_product(self.matrix, gradient)

    def updated(self, pair: Pair) -> DenseInverse:
        """H + (s w' + w s') / rho with w = (1 + y'Hy / rho) s / 2 - Hy."""
        s, y, rho = pair.s, pair.y, pair.rho
        hy = _product(self.matrix, y)
        w = s * (0.5 * (1.0 + dot(y, hy) / rho))
        w -= hy
        w /= rho
        rank_one = np.outer(s, w)
        matrix = self.matrix + rank_one
        matrix += rank_one.T
        return DenseInverse(matrix)


@dataclass(frozen=True, slots=True)
class LimitedMemory:
    """The last few updates of the inverse start (s'y / y'D0^-1 y) D0^-1 (Eq. 7.20 of [2])."""

    start: FloatArray
    capacity: int
    scale: float = 1.0
    pairs: tuple[Pair, ...] = ()

    def direction(self, gradient: FloatArray) -> FloatArray:
        """Algorithm 7.4 of [2], the two loops."""
        q = gradient.copy()
        scratch = np.empty_like(q)
        coefficients = []
        for pair in reversed(self.pairs):
            a = dot(pair.s, q) / pair.rho
            q -= np.multiply(pair.y, a, out=scratch)
            coefficients.append(a)
        q /= self.start
        q *= -self.scale  # now q is minus the r of [2]: the direction
        for pair, a in zip(self.pairs, reversed(coefficients), strict=True):
            q -= np.multiply(pair.s, a + dot(pair.y, q) / pair.rho, out=scratch)
        return q

    def updated(self, pair: Pair) -> LimitedMemory:
        """Add a pair and forget the oldest one beyond the capacity."""
        scale = pair.rho / dot(pair.y, pair.y / self.start)
        return replace(self, scale=scale, pairs=(*self.pairs, pair)[-self.capacity :])


def _product(matrix: FloatArray, v: FloatArray) -> FloatArray:
    """Matrix times vector without a threaded BLAS: the same bits with any number of threads."""
    product: FloatArray = np.einsum("ij,j->i", matrix, v)
    return product
