"""Passes over all chunks of a stream of points, with their progress."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.errors import DegenerateContourError, InvalidInputError, ShapesplineError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from shapespline.geometry import CentredCurve
    from shapespline.streaming.stream import PointStream, TurnedRows
    from shapespline.typing import FloatArray

# Points that corners and noise are judged by.
SAMPLE = 20_000


class Seen(NamedTuple):
    """What a look at points tells.

    ``low`` and ``high`` are the corners of their box, ``firsts`` (k, 2) the first point of each
    chunk, ``sample`` every so many-th point.
    """

    low: FloatArray
    high: FloatArray
    firsts: FloatArray
    last: FloatArray
    longest_step: float
    sample: FloatArray

    @property
    def ends_meet(self) -> bool:
        """Whether the gap between the ends is no longer than the longest step."""
        return float(np.hypot(*(self.firsts[0] - self.last))) <= self.longest_step


class Measured(NamedTuple):
    """The largest squared distance from points to a curve, and the sum of all."""

    largest: float
    total: float


class Passes:
    """Passes over all chunks.

    Parameters
    ----------
    stream : PointStream
    progress : callable or None
        Called with the points passed and to pass, over ``in_all`` passes; a true answer ends them.

    Examples
    --------
    >>> from shapespline.streaming import PointStream
    >>> stream = PointStream(np.array([(0.0, 1.0), (2.0, 3.0)]))
    >>> Passes(stream, None, in_all=1).look().high.tolist()
    [2.0, 3.0]
    """

    def __init__(
        self, stream: PointStream, progress: Callable[[int, int], object] | None, in_all: int
    ) -> None:
        self.stream = stream
        self._progress, self._done, self._total = progress, 0, in_all * stream.n_points

    def look(self) -> Seen:
        """What all points tell, checked to be finite."""
        if self.stream.n_points == 0:
            raise DegenerateContourError("points must hold at least 2 distinct points, got none")
        stride = -(-self.stream.n_points // SAMPLE)
        found = self.over_all(_look, [(begin, stride) for begin in self.stream.begins[:-1]])
        return Seen(
            np.min([part.low for part in found], axis=0),
            np.max([part.high for part in found], axis=0),
            np.concatenate([part.firsts for part in found]),
            found[-1].last,
            max(part.longest_step for part in found),
            np.concatenate([part.sample for part in found]),
        )

    def measure(self, curve: CentredCurve, feet: TurnedRows | None = None) -> Measured:
        """Squared distances from all points to a curve.

        ``feet`` are rows in the order of the points that take the parameters of their feet.
        """
        begins = self.stream.begins[:-1]
        found = self.over_all(_measure, [(curve, feet, begin) for begin in begins])
        return Measured(max(m.largest for m in found), float(np.sum([m.total for m in found])))

    def reach(self, n_passes: int) -> None:
        """So many passes are over, or need not be made."""
        self._done = n_passes * self.stream.n_points

    def over_all(
        self,
        function: Any,
        arguments: Sequence[tuple[Any, ...]],
        known: Mapping[int, Any] | None = None,
    ) -> list[Any]:
        """Results of a function of every chunk, but those known; each is told to the caller."""
        known = {} if known is None else known
        asked = [k for k in range(len(self.stream)) if k not in known]
        found = self.stream.map(function, [arguments[k] for k in asked], asked)
        results = []
        for k, size in enumerate(np.diff(self.stream.begins).tolist()):
            results.append(known[k] if k in known else next(found))
            self._done += size
            if self._progress is not None and self._progress(self._done, self._total):
                raise ShapesplineError(
                    f"cancelled by the callback after {self._done} of {self._total} points"
                )
        return results


def _look(points: FloatArray, begin: int, stride: int) -> Seen:
    x, y = points[:, 0], points[:, 1]
    low, high = np.array([x.min(), y.min()]), np.array([x.max(), y.max()])
    if not (np.isfinite(low).all() and np.isfinite(high).all()):
        bad = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise InvalidInputError(
            f"points must be finite, got {points[bad].tolist()} at index {begin + bad};"
            " remove or repair such rows"
        )
    longest = 0.0
    if len(points) > 1:
        longest = float(np.sqrt((np.diff(x) ** 2 + np.diff(y) ** 2).max()))
    # Copies: a view would keep the whole chunk in memory.
    first, last = points[:1].copy(), points[-1].copy()
    return Seen(low, high, first, last, longest, points[-begin % stride :: stride].copy())


def _measure(
    points: FloatArray, curve: CentredCurve, feet: TurnedRows | None, begin: int
) -> Measured:
    parameters, distances_sq = curve.nearest(points)
    if feet is not None:
        feet[begin : begin + len(points)] = parameters
    return Measured(float(distances_sq.max()), float(distances_sq.sum()))
