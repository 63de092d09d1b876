"""Layer: one value for each pixel of a picture, worked out where it is asked for.

A picture is kept as it came, in memory or in a mapped file. Whatever has to see all of it goes
strip by strip, so that nothing as large as the picture is made beside it.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from shapespline.typing import FloatArray, IntArray

    Part: TypeAlias = int | slice | IntArray
    Key: TypeAlias = Part | tuple[Part, Part]

# Pixels of a strip: what is made of it for a while, twenty bytes for each, fits anywhere (TRC-15).
STRIP = 4_000_000
FLOAT_BINS = 1024


class Layer:
    """Values of pixels, indexed by rows and columns as an array is.

    Parameters
    ----------
    pixels : ndarray, shape (h, w) or (h, w, c)
    work : callable, optional
        Makes one value of the channels of each pixel, whatever pixels it is given.

    Examples
    --------
    >>> layer = Layer(np.arange(12.0).reshape(2, 3, 2), lambda pixels: pixels.sum(axis=-1))
    >>> layer.shape, layer[1].tolist(), layer.range
    ((2, 3), [13.0, 17.0, 21.0], (1.0, 21.0))
    """

    def __init__(
        self,
        pixels: NDArray[Any] | Layer,
        work: Callable[[NDArray[Any]], NDArray[Any]] | None = None,
    ) -> None:
        self._pixels, self._work = pixels, work
        self.shape: tuple[int, int] = pixels.shape[:2]

    def __getitem__(self, key: Key) -> NDArray[Any]:
        """Values of a part, as numpy indexes it."""
        part = self._pixels[key]
        return part if self._work is None else self._work(part)

    @property
    def size(self) -> int:
        """How many pixels there are."""
        return self.shape[0] * self.shape[1]

    @cached_property
    def is_whole(self) -> bool:
        """Whether the values are unsigned integers."""
        return self[:1, :1].dtype.kind == "u"

    @cached_property
    def range(self) -> tuple[float, float]:
        """Least and largest value."""
        if self.is_whole:
            there = np.flatnonzero(self.counts)
            return float(there[0]), float(there[-1])
        ends = [(self[rows].min(), self[rows].max()) for rows in strips(self.shape)]
        return float(min(low for low, _ in ends)), float(max(high for _, high in ends))

    @cached_property
    def counts(self) -> IntArray:
        """How often each whole value occurs; of other values how many fall in each bin."""
        found = np.zeros(0, dtype=np.int64)
        for rows in strips(self.shape):
            own = self._counted(self[rows])
            longer = max(len(found), len(own))
            found, own = (np.pad(x, (0, longer - len(x))) for x in (found, own))
            found += own
        return found

    def _counted(self, values: NDArray[Any]) -> IntArray:
        if not self.is_whole:
            return np.histogram(values, FLOAT_BINS, self.range)[0]
        if values.dtype == np.uint8 and values.shape[1] % 2 == 0:
            # Two pixels at a time are half the work.
            pairs = np.ascontiguousarray(values).view(np.uint16).ravel()
            table = np.bincount(pairs, minlength=65536).reshape(256, 256)
            return np.trim_zeros(table.sum(axis=0) + table.sum(axis=1), "b")
        return np.bincount(values.ravel())

    @cached_property
    def bins(self) -> FloatArray:
        """Borders of the bins of values that are no whole numbers."""
        return np.linspace(*self.range, FLOAT_BINS + 1)


def strips(shape: tuple[int, ...], size: int | None = None) -> Iterator[slice]:
    """Rows of a picture, so many at once that they are a strip, or have that many pixels.

    Examples
    --------
    >>> list(strips((5, STRIP // 2)))
    [slice(0, 2, None), slice(2, 4, None), slice(4, 5, None)]
    """
    height, width = shape[:2]
    step = max(1, (STRIP if size is None else size) // width)
    for begin in range(0, height, step):
        yield slice(begin, min(begin + step, height))


def places_of(key: Key, shape: tuple[int, int]) -> tuple[IntArray, IntArray]:
    """Rows and columns of a part, which broadcast to its shape."""
    row, column = key if isinstance(key, tuple) else (key, slice(None))
    rows, columns = np.arange(shape[0])[row], np.arange(shape[1])[column]
    if isinstance(row, slice) or isinstance(column, slice):
        return rows[:, None], columns[None, :]
    return rows, columns
