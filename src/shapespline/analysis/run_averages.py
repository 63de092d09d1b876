"""Averages of noisy points in a row, and a proof of how far the points lie from their polyline.

Points that scatter by more than a small part of the tolerance cannot be left out one by one; their
averages over runs of some width can stand for them. For every two neighbouring averages the points
of both runs lie within some distance of the line through them. On the way from the one run to the
other the polyline of the points passes every foot on that segment, since an average lies between
its points; so no point of the segment is farther from the polyline than that, either.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray, IntArray


# Numbers of points to average over, and how much farther away wider runs, which are fewer and
# steadier, may lie than those that lie nearest.
WIDTHS = (16, 64, 256, 1024, 4096)
ABOUT_AS_NEAR = 1.1


class Averages(NamedTuple):
    """Averages of a chunk of points.

    ``nodes`` (k, 2) are the averages, ``indices`` (k,) the points in the middle of their runs,
    ``error_bound`` how far points and segments lie apart at most. ``head`` and ``tail`` are the
    points of the first two runs and of the last two, by which chunks are joined.
    """

    nodes: FloatArray
    indices: IntArray
    error_bound: float
    head: tuple[FloatArray, FloatArray]
    tail: tuple[FloatArray, FloatArray]


def averages(points: FloatArray, width: int, alone: IntArray | None = None) -> Averages:
    """Averages over runs of ``width`` points, at least four of them.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
    width : int
    alone : ndarray, optional
        Indices of points that are runs of their own.

    Examples
    --------
    >>> points = np.column_stack([np.arange(400.0), np.zeros(400)])
    >>> points[::2, 1] = 0.25
    >>> found = averages(points, 20)
    >>> found.nodes[:2].tolist(), found.error_bound
    ([[9.5, 0.125], [29.5, 0.125]], 0.125)
    """
    n_runs = max(4, len(points) // width)
    begins = len(points) * np.arange(n_runs) // n_runs
    if alone is not None and len(alone):
        begins = np.unique(np.concatenate([begins, alone, alone + 1]))
        begins = begins[begins < len(points)]
        n_runs = len(begins)
    counts = np.diff([*begins, len(points)])
    nodes = np.add.reduceat(points, begins) / counts[:, None]
    error_bound = strayed(nodes, points, np.repeat(np.arange(n_runs), counts))
    # Copies: a view would keep the whole chunk in memory.
    first, second = (p.copy() for p in np.split(points[: begins[2]], begins[1:2]))
    before, last = (p.copy() for p in np.split(points[begins[-2] :], [begins[-1] - begins[-2]]))
    return Averages(nodes, begins + counts // 2, error_bound, (first, second), (before, last))


def best_width(scatters: Sequence[float]) -> int:
    """The width to take of ``WIDTHS``, by how far the points lie from the averages of each."""
    enough = ABOUT_AS_NEAR * min(scatters)
    return max(w for w, s in zip(WIDTHS, scatters, strict=True) if s <= enough)


def averaged(points: FloatArray, closed: bool, alone: IntArray) -> Averages:
    """Averages over runs of the best width, joined at the ends of closed points.

    The ends of open ones are runs of their own, as are those that are to be ``alone``.
    """
    if not closed:
        alone = np.union1d(alone, [0, len(points) - 1])
    scatters = [_closed_up(averages(points, width, alone), closed).error_bound for width in WIDTHS]
    return _closed_up(averages(points, best_width(scatters), alone), closed)


def _closed_up(found: Averages, closed: bool) -> Averages:
    return (
        found._replace(error_bound=max(found.error_bound, joint(found, found))) if closed else found
    )


def joint(before: Averages, after: Averages) -> float:
    """How far points and segments lie apart where one chunk goes on in another."""
    nodes = np.concatenate([before.nodes[-2:], after.nodes[:2]])
    return _strayed_runs(nodes, [*before.tail, *after.head])


def at_end(end: FloatArray, runs: tuple[FloatArray, FloatArray]) -> float:
    """The same between an end of open points and the averages of the two runs next to it."""
    nodes = np.stack([end, *(run.mean(axis=0) for run in runs)])
    return _strayed_runs(nodes, [end[None], *runs])


def _strayed_runs(nodes: FloatArray, runs: list[FloatArray]) -> float:
    run = np.repeat(np.arange(len(runs)), [len(points) for points in runs])
    return strayed(nodes, np.concatenate(runs), run)


def strayed(nodes: FloatArray, points: FloatArray, run: IntArray) -> float:
    """How far points of runs lie from the segments between the runs' averages, and these from them.

    Of the first and the last run only what is said about the segments: their points have others.
    """
    along = np.diff(nodes, axis=0)
    length = np.maximum(np.hypot(along[:, 0], along[:, 1]), np.finfo(float).tiny)
    along /= length[:, None]
    farthest = 0.0
    nearest_sq = np.full(len(points), np.inf)
    for after in (0, 1):  # the segment that ends at the run's average, the one that begins there
        segment = run - 1 + after
        has = (segment >= 0) & (segment < len(along))
        at = segment[has]
        x, y = (points[has] - nodes[at]).T
        ux, uy = along[at].T
        across, foot = x * uy - y * ux, x * ux + y * uy
        if len(across):
            farthest = max(farthest, float(np.abs(across).max()))
        beyond = np.maximum(0.0, np.maximum(-foot, foot - length[at]))
        nearest_sq[has] = np.minimum(nearest_sq[has], across**2 + beyond**2)
    inner = (run > 0) & (run < len(nodes) - 1)
    if inner.any():
        farthest = max(farthest, float(np.sqrt(nearest_sq[inner].max())))
    return farthest
