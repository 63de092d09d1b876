"""Parabolas: how edges lead through crossings beside each other, and what they cover of pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray


class Parabolas(NamedTuple):
    """Parabolas through points beside each other: y over x, which runs along their chord.

    ``at`` is one of the points, ``origin`` their mean; ``along`` the chord's direction, ``off`` the
    root mean square of how far the points lie from the parabola.
    """

    at: FloatArray
    origin: FloatArray
    along: FloatArray
    coefficients: FloatArray
    off: FloatArray

    @classmethod
    def through(cls, points: FloatArray, around: IntArray, at: FloatArray) -> Parabolas:
        """By least squares.

        Parameters
        ----------
        points : ndarray, shape (m, 2)
        around : ndarray of int, shape (n, k)
            Of each parabola the points that it leads through.
        at : ndarray, shape (n, 2)
            Where its tangent is asked for.

        Examples
        --------
        >>> points = np.array([(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0), (4.0, 4.0)])
        >>> edge = Parabolas.through(points, np.arange(5)[None, :], points[2:3])
        >>> edge.direction.round(3).tolist(), edge.covered(np.array([(2.0, 2.5)])).round(3).tolist()
        ([[0.707, 0.707]], [0.875])
        """
        near = points[around]
        along = near[:, -1] - near[:, 0]
        length = np.hypot(along[:, 0], along[:, 1])[:, None]
        # Of points that come back to where they begin any direction is as good.
        along = np.where(length > 0, along / np.where(length > 0, length, 1.0), (1.0, 0.0))
        origin = near.mean(axis=1)
        x, y = _turned(near - origin[:, None], along[:, None])
        powers = x[..., None] ** np.arange(3)
        products = np.einsum("nki,nkj->nij", powers, powers) + 1e-9 * np.eye(3)
        sums = np.einsum("nki,nk->ni", powers, y)
        solved = np.linalg.solve(products, sums[..., None])[..., 0]
        left = np.einsum("nki,ni->nk", powers, solved) - y
        off = np.sqrt((left**2).mean(axis=1))
        return cls(at, origin, along, solved, off)

    @property
    def direction(self) -> FloatArray:
        """Tangents, not of unit length."""
        return _turned_back(np.ones(len(self.at)), self._slope(self.at), self.along)

    def covered(self, centres: FloatArray) -> FloatArray:
        """The part of the pixel around each centre that lies on the left of its edge."""
        x, y = _turned(centres - self.origin, self.along)
        slope = self._slope(centres)
        length = np.hypot(1.0, slope)
        bow = (self.coefficients * x[:, None] ** np.arange(3)).sum(axis=1)
        normal = np.abs(_turned_back(-slope, np.ones(len(x)), self.along)) / length[:, None]
        return _half_plane((bow - y) / length, normal.max(axis=1), normal.min(axis=1))

    def _slope(self, points: FloatArray) -> FloatArray:
        x, _ = _turned(points - self.origin, self.along)
        return np.asarray(self.coefficients[:, 1] + 2.0 * self.coefficients[:, 2] * x)


def _turned(vectors: FloatArray, along: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Components along unit vectors and to their left."""
    x, y = vectors[..., 0], vectors[..., 1]
    return x * along[..., 0] + y * along[..., 1], y * along[..., 0] - x * along[..., 1]


def _turned_back(x: FloatArray, y: FloatArray, along: FloatArray) -> FloatArray:
    return np.column_stack([x * along[:, 0] - y * along[:, 1], x * along[:, 1] + y * along[:, 0]])


def _half_plane(distance: FloatArray, longer: FloatArray, shorter: FloatArray) -> FloatArray:
    """The part of a pixel that lies left of a line, its centre so far to the right of it.

    By the absolute components of the line's unit normal.
    """
    far = np.maximum(0.5 * (longer + shorter) - np.abs(distance), 0.0)
    within = np.abs(distance) <= 0.5 * (longer - shorter)
    beyond = far**2 / np.maximum(2.0 * longer * shorter, 1e-12)
    right = np.where(within, 0.5 - np.abs(distance) / longer, beyond)
    return np.where(distance > 0, right, 1.0 - right)
