"""A polyline of few vertices that stands for a stream of points, a proven distance away."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.analysis import (
    FEW_LEFT,
    MOST_SCATTER,
    WIDTHS,
    Averages,
    at_end,
    averages,
    best_width,
    joint,
)
from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from shapespline.streaming.passes import Passes, Seen
    from shapespline.streaming.stream import PointStream
    from shapespline.typing import FloatArray, IntArray

# Thinning may use these parts of the tolerance, one after another. The first leaves few vertices of
# clean points; averages of others are thinned by it as well.
THINNINGS = (0.01, 0.03, 0.1, 0.3)
FEW_VERTICES, MOST_VERTICES = 20_000, 200_000


class ProxyPolyline(NamedTuple):
    """Vertices that stand for all points.

    ``indices`` (k,) tell where among the points they belong; ``error_bound`` is a bound of the
    distances between their polyline and that of the points, both ways.
    """

    points: FloatArray
    indices: IntArray
    error_bound: float

    @classmethod
    def of(
        cls, passes: Passes, seen: Seen, closed: bool, tolerance: float, longest: float
    ) -> ProxyPolyline:
        """Vertices for the points of a stream, in one more pass over them.

        Parameters
        ----------
        passes : Passes
        seen : Seen
            What the first of them told.
        closed : bool
        tolerance, longest : float
            What ``error_bound`` must stay below by far, and the longest chord of thinned vertices.

        Raises
        ------
        InvalidInputError
            If too many points would have to stay.
        """
        # Each chunk goes on to the first point of the next, so that nothing lies between them.
        ahead: list[FloatArray | None] = [*seen.firsts[1:], seen.firsts[0] if closed else None]

        def trial(part: float) -> _Trial:
            return _Trial.of(passes.stream, ahead, part * tolerance, longest)

        for part in THINNINGS[:2]:
            tried = trial(part)
            if tried.expected <= FEW_VERTICES:
                return cls._thinned(passes, tried)
        scatters = [_scatter(passes.stream, width) for width in WIDTHS]
        scatter, width = min(scatters), best_width(scatters)
        if scatter <= MOST_SCATTER * tolerance:
            averaged = cls._averaged(passes, seen, closed, width)
            tried = trial(THINNINGS[2])
            few = min(FEW_VERTICES, FEW_LEFT * passes.stream.n_points)
            if tried.expected <= few and THINNINGS[2] * tolerance < averaged.error_bound:
                return cls._thinned(passes, tried)
            if averaged.error_bound <= MOST_SCATTER * tolerance:
                return averaged._kept_of(THINNINGS[0] * tolerance, longest, closed)
        for part in THINNINGS:
            tried = trial(part)
            if tried.expected <= MOST_VERTICES:
                return cls._thinned(passes, tried)
        raise InvalidInputError(
            f"tolerance must be larger for these points, got {tolerance:.6g}: they scatter by about"
            f" {scatter:.3g}, and thinned by {part:g} of the tolerance {tried.expected:.2g} of"
            f" {passes.stream.n_points} stay, more than {MOST_VERTICES}"
        )

    @classmethod
    def _thinned(cls, passes: Passes, tried: _Trial) -> ProxyPolyline:
        kept = passes.over_all(_thin, tried.arguments, tried.thinned)
        begins = passes.stream.begins
        indices = [begin + part.indices for begin, part in zip(begins, kept, strict=False)]
        points = np.concatenate([part.points for part in kept])
        return cls(points, np.concatenate(indices), kept[0].error_bound)

    @classmethod
    def _averaged(cls, passes: Passes, seen: Seen, closed: bool, width: int) -> ProxyPolyline:
        parts: list[Averages] = passes.over_all(averages, [(width,)] * len(passes.stream))
        bounds = [part.error_bound for part in parts]
        bounds += [joint(before, after) for before, after in pairwise(parts)]
        begins = passes.stream.begins
        points = np.concatenate([part.nodes for part in parts])
        indices = np.concatenate(
            [begin + part.indices for begin, part in zip(begins, parts, strict=False)]
        )
        if closed:
            bounds.append(joint(parts[-1], parts[0]))
            return cls(points, indices, max(bounds))
        first, last = seen.firsts[0], seen.last
        bounds += [at_end(first, parts[0].head), at_end(last, parts[-1].tail[::-1])]
        points = np.concatenate([first[None], points, last[None]])
        indices = np.concatenate([[0], indices, [begins[-1] - 1]])
        return cls(points, indices, max(bounds))

    def _kept_of(self, distance: float, longest: float, closed: bool) -> ProxyPolyline:
        """Some of the vertices, a distance from the others."""
        kept = _thin(self.points, self.points[0] if closed else None, distance, longest)
        return ProxyPolyline(kept.points, self.indices[kept.indices], self.error_bound + distance)


def _tried(stream: PointStream) -> list[int]:
    """Chunks that tell of all: the first, one in the middle, the last."""
    return sorted({0, len(stream) // 2, len(stream) - 1})


class _Trial(NamedTuple):
    """Thinning by one distance, of a few chunks as yet: about how many points it leaves of all."""

    arguments: list[tuple[Any, ...]]
    thinned: dict[int, ProxyPolyline]
    expected: float

    @classmethod
    def of(
        cls,
        stream: PointStream,
        ahead: list[FloatArray | None],
        distance: float,
        longest: float,
    ) -> _Trial:
        arguments = [(after, distance, longest) for after in ahead]
        tried = _tried(stream)
        found = stream.map(_thin, [arguments[k] for k in tried], tried)
        thinned = dict(zip(tried, found, strict=True))
        asked = sum(stream.begins[k + 1] - stream.begins[k] for k in tried)
        left = sum(len(part.indices) for part in thinned.values())
        return cls(arguments, thinned, left * stream.n_points / asked)


def _scatter(stream: PointStream, width: int) -> float:
    """About how far points lie from their averages."""
    tried = _tried(stream)
    return max(part.error_bound for part in stream.map(averages, [(width,)] * len(tried), tried))


def _thin(
    points: FloatArray, after: FloatArray | None, distance: float, longest: float
) -> ProxyPolyline:
    """Vertices a distance from the polyline that goes on to the point after it."""
    track = points if after is None else np.concatenate([points, after[None]])
    kept_indices = np.array(_kernels.thinned(track, distance, longest, None), dtype=np.int64)
    kept_indices = kept_indices if after is None else kept_indices[:-1]
    return ProxyPolyline(points[kept_indices], kept_indices, distance)
