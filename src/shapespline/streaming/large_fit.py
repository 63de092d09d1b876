"""LargeFit: a curve fitted to more points than it holds, and their parameters on demand."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from shapespline.values import Fit

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.geometry import CentredCurve
    from shapespline.streaming.stream import PointStream
    from shapespline.typing import FloatArray


def feet_of(points: FloatArray, curve: CentredCurve) -> FloatArray:
    """The nearest foot parameters of a chunk of points."""
    return curve.nearest(points).parameters


class FootParameters:
    """The nearest foot parameter of every point, found when it is asked for.

    Like an array of shape (n,) that can be read by indices and slices; ``numpy.asarray`` finds all.

    Examples
    --------
    >>> from shapespline import fit_large
    >>> t = np.linspace(0, 2 * np.pi, 5000, endpoint=False)
    >>> feet = fit_large(np.column_stack([np.cos(t), np.sin(t)]), tolerance=0.01).feet
    >>> len(feet), bool((np.diff(feet[1000:1004]) > 0).all()), np.asarray(feet).shape
    (5000, True, (5000,))
    """

    dtype = np.dtype(np.float64)

    def __init__(self, stream: PointStream, curve: CentredCurve) -> None:
        self._stream, self._curve = stream, curve

    @property
    def shape(self) -> tuple[int]:
        """One for each point."""
        return (self._stream.n_points,)

    def __len__(self) -> int:
        return self._stream.n_points

    def __getitem__(self, at: int | slice) -> Any:
        if not isinstance(at, slice):
            index = range(len(self))[at]
            return self._of(index, index + 1)[0]
        begin, end, step = at.indices(len(self))
        if step > 0:
            return self._of(begin, max(begin, end))[::step]
        lowest = range(begin, end, step)[-1] if begin > end else begin
        return self._of(lowest, begin + 1 if begin > end else begin)[::step]

    def __iter__(self) -> Iterator[float]:
        for part in self._stream.map(feet_of, [(self._curve,)] * len(self._stream)):
            yield from part.tolist()

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> FloatArray:
        if copy is False:
            raise ValueError("the parameters are found when they are asked for: copy them")
        parts = list(self._stream.map(feet_of, [(self._curve,)] * len(self._stream)))
        return np.concatenate(parts).astype(dtype or self.dtype, copy=False)

    def _of(self, begin: int, end: int) -> FloatArray:
        return feet_of(self._stream.read(begin, end), self._curve)


@dataclass(frozen=True, eq=False, kw_only=True)
class LargeFit(Fit):
    """A curve fitted to more points than it holds.

    ``contour`` and ``parameters`` are those of the thinned points that the search saw; the
    distances are those of all.

    Attributes
    ----------
    n_points : int
        Of all points.
    feet : FootParameters
        The foot parameter of each of them.
    """

    _BESIDE: ClassVar = Fit._BESIDE | {"feet"}

    n_points: int
    feet: FootParameters = field(repr=False)
