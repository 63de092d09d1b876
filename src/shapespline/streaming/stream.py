"""Points in a row too long for the memory, seen chunk by chunk."""

from __future__ import annotations

import mmap
from collections import deque
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.validation import float_array

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from concurrent.futures import Executor, Future

    from shapespline.typing import FloatArray

# Points of a chunk: two megabytes, which the caches of a core hold and whose handling costs
# far more than calling for it (STR-02).
CHUNK = 1 << 17
# Chunks that are under way at a time: on an executor, and as blocks of a dask array.
UNDER_WAY = 8

Result = TypeVar("Result")


class PointStream:
    """Chunks of an array that need not fit into the memory, and functions mapped over them.

    Parameters
    ----------
    points : array-like, shape (n, 2)
        Anything with ``shape``, ``dtype`` and slices along the first axis: an array, one that is
        mapped from a file (``numpy.load(path, mmap_mode="r")``) or a zarr array; or a dask array,
        whose blocks stay where they are. Numbers of other types are converted chunk by chunk.
    executor : concurrent.futures.Executor, optional
        Where to work; in this thread when not given. A dask array is worked on where dask works.

    Attributes
    ----------
    n_points : int
    begins : list of int
        First index of each chunk, and the number of points.

    Raises
    ------
    InvalidInputError
        If the points are no array (n, 2) of real numbers.

    Examples
    --------
    >>> stream = PointStream(np.zeros((300_000, 2), dtype=np.float32))
    >>> stream.begins, [len(chunk) for chunk in stream.map(np.asarray)]
    ([0, 131072, 262144, 300000], [131072, 131072, 37856])
    """

    def __init__(self, points: Any, executor: Executor | None = None) -> None:
        shape, dtype = getattr(points, "shape", None), getattr(points, "dtype", None)
        if shape is None or dtype is None:
            raise InvalidInputError(
                f"points must be an array in memory, on disk or of dask, got"
                f" {type(points).__name__}; give lists to fit_curve"
            )
        if len(shape) != 2 or shape[1] != 2:
            raise InvalidInputError(f"points must have shape (n, 2), got {tuple(shape)}")
        if np.dtype(dtype).kind not in "fiu":
            raise InvalidInputError(f"points must be real numbers, got dtype {dtype}")
        self._points, self._executor = points, executor
        self._blocks: Sequence[Any] | None = None
        if hasattr(points, "to_delayed"):
            # Blocks of one size whatever the layout is: sums and thinning go chunk by chunk.
            points = points.rechunk({0: CHUNK, 1: -1})
            self._blocks = points.to_delayed().ravel().tolist()
            self.begins = [0, *np.cumsum(points.chunks[0]).tolist()]
        else:
            self.begins = [*range(0, int(shape[0]), CHUNK), int(shape[0])]
        self.n_points = self.begins[-1]

    def __len__(self) -> int:
        """Number of chunks."""
        return len(self.begins) - 1

    def read(self, begin: int, end: int) -> FloatArray:
        """Some of the points, shape (end - begin, 2), float64."""
        rows = self._points[begin:end]
        if type(rows) is np.ndarray and rows.dtype == np.float64 and rows.flags.c_contiguous:
            rows.setflags(write=False)  # of this view: nobody writes to what is the caller's
            return rows
        read = float_array(rows.compute() if self._blocks is not None else rows, "points")
        mapped = getattr(self._points, "_mmap", None)
        if mapped is not None and self._points.mode == "r" and hasattr(mmap, "MADV_DONTNEED"):
            mapped.madvise(mmap.MADV_DONTNEED)  # the pages would count as this process's memory
        return read

    def map(
        self,
        function: Callable[..., Result],
        arguments: Sequence[tuple[Any, ...]] | None = None,
        chunks: Sequence[int] | None = None,
    ) -> Iterator[Result]:
        """Results of a function of every chunk (or some), in order.

        ``arguments`` holds more of them for each chunk that is asked.
        """
        chosen = range(len(self)) if chunks is None else chunks
        given = [()] * len(chosen) if arguments is None else arguments
        if self._blocks is not None:
            yield from _map_blocks(function, [self._blocks[k] for k in chosen], given)
        elif self._executor is None:
            for chunk, more in zip(chosen, given, strict=True):
                yield function(self.read(*self._ends(chunk)), *more)
        else:
            yield from self._map_on(self._executor, function, chosen, given)

    def _ends(self, chunk: int) -> tuple[int, int]:
        return self.begins[chunk], self.begins[chunk + 1]

    def _map_on(
        self,
        executor: Executor,
        function: Callable[..., Result],
        chunks: Sequence[int],
        arguments: Sequence[tuple[Any, ...]],
    ) -> Iterator[Result]:
        """Reads here, works there, a few chunks ahead."""
        waiting: deque[Future[Result]] = deque()
        try:
            for chunk, more in zip(chunks, arguments, strict=True):
                waiting.append(executor.submit(function, self.read(*self._ends(chunk)), *more))
                if len(waiting) == UNDER_WAY:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()


class TurnedRows:
    """Rows of an array from another one on, forwards or backwards, without a copy of them.

    What is set are rows of one number.

    Examples
    --------
    >>> points = np.arange(10.0).reshape(5, 2)
    >>> TurnedRows(points, 3, 1)[0:3].tolist(), TurnedRows(points, 1, -1)[1:3].tolist()
    ([[6.0, 7.0], [8.0, 9.0], [0.0, 1.0]], [[0.0, 1.0], [8.0, 9.0]])
    """

    def __init__(self, rows: FloatArray, start: int, step: int) -> None:
        self._rows = rows[::step]
        self._first = start if step > 0 else len(rows) - 1 - start
        self.shape, self.dtype = rows.shape, rows.dtype

    def __getitem__(self, part: slice) -> FloatArray:
        here, beyond = self._pieces(part)
        return (
            self._rows[here]
            if beyond.stop == 0
            else np.concatenate([self._rows[here], self._rows[beyond]])
        )

    def __setitem__(self, part: slice, values: FloatArray) -> None:
        here, beyond = self._pieces(part)
        split = len(values) - beyond.stop
        self._rows[here], self._rows[beyond] = values[:split], values[split:]

    def _pieces(self, part: slice) -> tuple[slice, slice]:
        """Rows up to the last one, and those that go on from the first."""
        n = len(self._rows)
        begin = (self._first + part.start) % n
        end = begin + part.stop - part.start
        return slice(begin, min(end, n)), slice(0, max(end - n, 0))


def _map_blocks(
    function: Callable[..., Result], blocks: Sequence[Any], arguments: Sequence[tuple[Any, ...]]
) -> Iterator[Result]:
    """Works where dask has the blocks; only results travel."""
    dask: Any = import_module("dask")
    asked = dask.delayed(_of_block(function), pure=True)
    tasks = [asked(block, *more) for block, more in zip(blocks, arguments, strict=True)]
    for begin in range(0, len(tasks), UNDER_WAY):
        yield from dask.compute(*tasks[begin : begin + UNDER_WAY])


def _of_block(function: Callable[..., Result]) -> Callable[..., Result]:
    def converted(block: Any, *more: Any) -> Result:
        return function(float_array(block, "points"), *more)

    return converted
