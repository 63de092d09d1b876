"""Which polylines cross each other, or themselves: boxes swept in x, then signs of areas."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from shapespline.typing import FloatArray

# Pairs of segments looked at at a time.
CHUNK = 2_000_000


def crossing_pairs(
    polylines: Sequence[FloatArray], *, at_vertices: bool = False
) -> set[tuple[int, int]]:
    """Pairs of polylines of which a segment crosses one of the other, (i, j) with i < j.

    Touching is no crossing. With ``at_vertices`` a way through a vertex of the other is one, and
    one that only touches a vertex may count as one.

    Examples
    --------
    >>> cross = [np.array([(0.0, 0.0), (2.0, 2.0)]), np.array([(0.0, 2.0), (2.0, 0.0)])]
    >>> crossing_pairs([*cross, np.array([(5.0, 5.0), (6.0, 6.0)])])
    {(0, 1)}
    """
    if len(polylines) < 2:
        return set()
    lows = np.array([polyline.min(axis=0) for polyline in polylines])
    highs = np.array([polyline.max(axis=0) for polyline in polylines])
    return {
        (i, j) for i, j in _meeting(lows, highs) if _cross(polylines[i], polylines[j], at_vertices)
    }


def self_crossings(polyline: FloatArray) -> int:
    """Number of pairs of segments of a polyline that cross.

    A way through a vertex counts once, one that only touches it not at all or twice.

    Examples
    --------
    >>> self_crossings(np.array([(0.0, 0), (2, 2), (4, 4), (4, 0), (2, 2), (0, 4)]))
    1
    """
    return int(_kernels.count_crossings(np.ascontiguousarray(polyline)))


def _meeting(lows: FloatArray, highs: FloatArray) -> Iterator[tuple[int, int]]:
    """Pairs (i, j), i < j, of boxes that meet, found among those whose ranges of x do."""
    order = np.argsort(lows[:, 0], kind="stable")
    ends = np.searchsorted(lows[order, 0], highs[order, 0], side="right")
    for at, (k, end) in enumerate(zip(order, ends, strict=True)):
        others = order[at + 1 : end]
        meets = (lows[others, 1] <= highs[k, 1]) & (lows[k, 1] <= highs[others, 1])
        for other in others[meets].tolist():
            yield min(int(k), other), max(int(k), other)


def _cross(first: FloatArray, second: FloatArray, at_vertices: bool) -> bool:
    """Whether some segment crosses some other, among those in the common part of their boxes."""
    low = np.maximum(first.min(axis=0), second.min(axis=0))
    high = np.minimum(first.max(axis=0), second.max(axis=0))
    a, b = _within(first, low, high)
    c, d = _within(second, low, high)
    if not (len(a) and len(c)):
        return False
    step = max(1, CHUNK // len(c))
    return any(
        bool(_crossed(a[k : k + step], b[k : k + step], c, d, at_vertices).any())
        for k in range(0, len(a), step)
    )


def _within(
    polyline: FloatArray, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Ends of the segments whose boxes meet a box."""
    a, b = polyline[:-1], polyline[1:]
    meets = (np.minimum(a, b) <= high).all(axis=1) & (np.maximum(a, b) >= low).all(axis=1)
    return a[meets], b[meets]


def _crossed(
    a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray, at_vertices: bool
) -> NDArray[np.bool_]:
    """Whether segments a b and c d cross, every one with every other.

    In an inner point of both; or, as if a point on a segment lay to the left of it.
    """

    def side(p: FloatArray, q: FloatArray, r: FloatArray) -> FloatArray:
        u, v = q - p, r - p
        cross = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
        return np.where(cross >= 0, 1.0, -1.0) if at_vertices else np.sign(cross)

    a, b, c, d = a[:, None], b[:, None], c[None], d[None]
    return (side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)
