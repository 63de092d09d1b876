"""Ground: what a picture is worth where there is no ink, as a smooth function over blocks of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import BoolArray, FloatArray, IntArray

# Total degree of the polynomial.
DEGREE = 4
POWERS = tuple((i, j) for i in range(DEGREE + 1) for j in range(DEGREE + 1 - i))


class Grid(NamedTuple):
    """Blocks of a picture: where their rows and columns begin and end."""

    rows: IntArray
    columns: IntArray

    @classmethod
    def of(cls, shape: tuple[int, ...], size: float) -> Grid:
        """Blocks of about so many pixels a side; of a picture smaller than them a pixel is one."""
        counts = (min(max(1, round(n / size)), n) for n in shape[:2])
        edges = (np.linspace(0, n, k + 1) for n, k in zip(shape[:2], counts, strict=True))
        return cls(*(each.astype(int) for each in edges))

    @property
    def centres(self) -> tuple[FloatArray, FloatArray]:
        """Rows and columns of the middle of blocks."""
        rows, columns = (0.5 * (edges[1:] + edges[:-1]).astype(np.float64) for edges in self)
        return rows, columns

    @property
    def powers(self) -> FloatArray:
        """Of the middle of each block, row by row: what a smooth ground is the sum of."""
        ends = (self.rows[-1], self.columns[-1])
        y, x = (2 * c / n - 1 for c, n in zip(self.centres, ends, strict=True))
        return np.array([np.outer(y**i, x**j).ravel() for i, j in POWERS]).T


@dataclass(frozen=True, eq=False)
class SmoothGround:
    """A polynomial over a picture of that height and width."""

    coefficients: FloatArray
    shape: tuple[int, int]

    @classmethod
    def through(cls, values: FloatArray, used: BoolArray, grid: Grid) -> SmoothGround:
        """By least squares through some blocks, row by row."""
        solved = np.linalg.lstsq(grid.powers[used], values[used], rcond=None)[0]
        height, width = (int(edges[-1]) for edges in grid)
        return cls(np.asarray(solved, dtype=np.float64), (height, width))

    def __call__(self, rows: IntArray, columns: IntArray) -> FloatArray:
        """Values at rows and columns that broadcast."""
        y, x = (2 * (at + 0.5) / n - 1 for at, n in zip((rows, columns), self.shape, strict=True))
        own = dict(zip(POWERS, self.coefficients.tolist(), strict=True))
        found = np.zeros(np.broadcast_shapes(y.shape, x.shape))
        for i in range(DEGREE, -1, -1):  # by Horner in y, of what is Horner in x
            of_x = np.zeros(x.shape)
            for j in range(DEGREE - i, -1, -1):
                of_x *= x
                of_x += own[i, j]
            found *= y
            found += of_x
        return found
