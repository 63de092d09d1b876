"""Rotations and mirrors that map an outline of lines and arcs onto itself.

Kinds repeat cyclically (rotation, the highest order first) or backwards (mirror), nodes map within
a distance; then the centre or the axis are two more unknowns and the map a block of equations, kept
if no element fits badly.
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.engines.drawn.joints import distance_from, meeting
from shapespline.engines.drawn.segments import ARC, FREE, LINE

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Sequence

    from shapespline.engines.drawn.model import Misfit, Model
    from shapespline.typing import BoolArray, FloatArray

    Judge = Callable[[Model, dict[int, Misfit]], bool]

# Nodes may miss their images by this part of the extent and by so many deviations (DRA-05).
MISSED_PART, MISSED_DEVIATIONS = 0.003, 6.0
# Rounds that show whether a model bears a map; of mirrors that it does not so many are tried.
ROUNDS, MOST_FAILURES = 5, 3
ROUNDING = 1e-9


def symmetries(
    model: Model, allowed: Collection[str], fits_badly: Judge
) -> Iterator[tuple[str, int, float]]:
    """Name, order and largest miss of those that hold; the model is estimated under them."""
    found, n = model.row.found, len(model.row.found)
    if not model.seen.closed or n < 3 or any(segment.kind == FREE for segment in found):
        return
    kinds = [segment.kind for segment in found]
    reach = max(MISSED_PART * model.extent, MISSED_DEVIATIONS * model.seen.deviation)
    points = nodes_of(model)
    base = n  # segments that are no images of others
    if "rotation" in allowed:
        for step in range(1, n // 2 + 1):
            if n % step or kinds != kinds[step:] + kinds[:step]:
                continue
            order = n // step
            angle = 2 * pi / order * way_round(model.row.points)
            middle = points.mean(axis=0)
            off = _across(model, _turned(points - middle, angle) + middle, step)
            if off > reach:
                continue
            images = [(k, k + step) for k in range(n - step)]
            if _kept(model, images, middle, angle, fits_badly):
                base = step
                yield "rotation", order, off
                break
    if "mirror" not in allowed:
        return
    count = failed = 0
    points = nodes_of(model)
    able = _turns_of_mirrors(points, reach)
    for turn in range(n):
        image = [(turn - k) % n for k in range(n)]
        if not able[turn] or any(kinds[k] != kinds[image[k]] for k in range(n)):
            continue
        mirrored = points[[(turn - k - 1) % n for k in range(n)]]
        axis, off = _axis(points, mirrored)
        if off > reach:
            continue
        images = [(k, image[k]) for k in range(base) if image[k] >= k or base < n]
        if _kept(model, images, axis, None, fits_badly):
            yield "mirror", 2, off
            points = nodes_of(model)
            able = _turns_of_mirrors(points, reach)
            count += 1
        else:
            failed += 1
        if count == 2 or failed == MOST_FAILURES or (count and base < n):
            return


def nodes_of(model: Model) -> FloatArray:
    """Where each segment meets the next, shape (n, 2)."""
    found, n = model.row.found, len(model.row.found)
    points = model.row.points
    return np.array([meeting(model, k, (k + 1) % n, points[found[k].end]) for k in range(n)])


def _kept(
    model: Model,
    images: Sequence[tuple[int, int]],
    unknowns: FloatArray,
    angle: float | None,
    fits_badly: Judge,
) -> bool:
    """Whether the model bears a map; else it is as it was."""
    before, x, constraints = model.misfits(), model.x, list(model.constraints)
    at = len(x)
    model.x = np.concatenate([x, unknowns])
    for kind in (LINE, ARC):
        own = [(model.at[a], model.at[b]) for a, b in images if model.kind(a) == kind]
        if own:
            first, second = zip(*own, strict=True)
            model.constraints.append(_kernels.Images(first, second, at, kind == LINE, angle))
    model.solve(ROUNDS)
    bad = fits_badly(model, before)
    if bad:
        model.x, model.constraints = x, constraints
    return not bad


def way_round(points: FloatArray) -> float:
    """1 if a closed outline, its first point at its end too, turns left, else -1."""
    x, y = points.T
    return 1.0 if float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) > 0 else -1.0


def _turned(points: FloatArray, angle: float) -> FloatArray:
    c, s = cos(angle), sin(angle)
    return points @ np.array([[c, s], [-s, c]])


def _across(model: Model, images: FloatArray, step: int) -> float:
    """How far images of nodes are from the elements that they lie on.

    Along these nodes are known less where elements hardly turn.
    """
    n = len(images)
    return max(
        distance_from(model, (k + side) % n, *images[k - step].tolist())
        for k in range(n)
        for side in (0, 1)
    )


def _turns_of_mirrors(points: FloatArray, reach: float) -> BoolArray:
    """For each turn whether nodes are as far from their middle as those that they may map onto.

    Others miss by more than the reach whatever the axis.
    """
    n, far = len(points), np.hypot(*(points - points.mean(axis=0)).T)
    images = far[(np.arange(n)[:, None] - np.arange(n) - 1) % n]
    return np.asarray(np.abs(images - far).max(axis=1) <= (1.0 + ROUNDING) * reach)


def _missed(points: FloatArray, others: FloatArray) -> float:
    return float(np.hypot(*(points - others).T).max())


def _axis(points: FloatArray, mirrored: FloatArray) -> tuple[FloatArray, float]:
    """Direction and offset of the axis that maps points best, and how far it misses."""
    middle, other = points.mean(axis=0), mirrored.mean(axis=0)
    a, b = points - middle, mirrored - other
    twice = float(
        np.arctan2(
            (a[:, 0] * b[:, 1] + a[:, 1] * b[:, 0]).sum(),
            (a[:, 0] * b[:, 0] - a[:, 1] * b[:, 1]).sum(),
        )
    )
    c, s = cos(twice), sin(twice)
    off = _missed(a @ np.array([[c, s], [s, -c]]), b)
    half = 0.5 * twice
    centre = 0.5 * (middle + other)
    return np.array([half, cos(half) * centre[1] - sin(half) * centre[0]]), off
