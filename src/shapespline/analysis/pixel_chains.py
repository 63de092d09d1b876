"""Chains of pixels: outlines of masks as points, whose steps tell how exact they are.

What was drawn on pixels is off by up to half of one wherever it is not level: it goes on in stairs.
Neighbours tell nothing of that where most of an outline is level.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis.noise import tells_noise
from shapespline.analysis.straight_runs import in_parts
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray

# Coordinates are on a grid but for this part of its step. So many stairs tell a chain of pixels; of
# a polygon, which may have been drawn so, that many beside level edges and as many beside upright
# ones. No longer chain is put together from a polygon (ANA-24).
OFF_GRID, FEWEST_STAIRS, FEWEST_EACH_WAY, LONGEST_CHAIN = 0.05, 3, 4, 200_000
# Neighbours scatter by so much of a pixel where a chain is not level, and errors go on along its
# stairs as if they were so much (ANA-24).
STAIRS, GOING_ON = 12.0**-0.5, 0.6
# So many steps tell at once that points are no such chain.
FIRST_STEPS = 16


class _Stairs(NamedTuple):
    """How many stairs a chain has: all, beside level edges, beside upright ones."""

    total: int
    level: int
    upright: int


NO_STAIRS = _Stairs(0, 0, 0)


def pixel_of(contour: Contour) -> float:
    """Side of the pixels that points go along one by one, in stairs; 0 where they do not.

    From the middle of a pixel to that of a neighbour, from corner to corner, or between the middles
    of their sides, as the level line of a mask does. Few points tell of none, nor those whose
    accuracy is known.

    Examples
    --------
    >>> angle = np.pi * np.arange(2000) / 1000
    >>> circle = np.rint(40 * np.column_stack([np.cos(angle), np.sin(angle)]))
    >>> chain = 0.5 * circle[(circle != np.roll(circle, 1, axis=0)).any(axis=1)]
    >>> pixel_of(Contour(chain, closed=True)), pixel_of(Contour(chain[:-9:3], closed=True))
    (0.5, 0.0)
    """
    if contour.accuracy is not None or not tells_noise(contour):
        return 0.0
    pixel, stairs = _chain(contour)
    return pixel if stairs.total >= FEWEST_STAIRS else 0.0


def along_pixels(contour: Contour) -> Contour | None:
    """A polygon of pixels with those points that are straight between others; None if it is none.

    Programs leave them out. Where none is left out it is no polygon, but a chain; where the
    accuracy is known, as of drawings, it was drawn so.

    Examples
    --------
    >>> angle = np.pi * np.arange(2000) / 1000
    >>> circle = np.rint(20 * np.column_stack([np.cos(angle), np.sin(angle)]))
    >>> chain = circle[(circle != np.roll(circle, 1, axis=0)).any(axis=1)]
    >>> turns = np.diff(chain, 2, axis=0, prepend=chain[-1:], append=chain[:1]).any(axis=1)
    >>> whole = along_pixels(Contour(chain[turns], closed=True))
    >>> turns.sum() < len(chain) == len(whole)
    True
    """
    if contour.accuracy is not None:
        return None
    polyline, closed = contour.polyline, contour.closed
    counts = _counts_between_turns(np.diff(polyline, axis=0), closed)
    if counts is None or counts.sum() > LONGEST_CHAIN:
        return None
    chain = Contour.trusted(in_parts(polyline, counts, closed), closed)
    _, stairs = _chain(chain)
    return chain if min(stairs.level, stairs.upright) >= FEWEST_EACH_WAY else None


def _whole(steps: FloatArray, grid: float) -> IntArray | None:
    """Steps in those of a grid, if they are whole numbers of them."""
    counts = steps / grid
    whole = np.rint(counts)
    return None if (np.abs(counts - whole) > OFF_GRID).any() else whole.astype(np.int64)


def _counts_between_turns(steps: FloatArray, closed: bool) -> IntArray | None:
    """How many pixels each step passes, if all are level, upright or oblique and all turn."""
    sizes = np.abs(steps)
    largest = float(sizes.max())
    finest = float(sizes[sizes > largest / LONGEST_CHAIN].min())
    grids = (_whole(steps, grid) for grid in (finest, 0.5 * finest))
    whole = next((found for found in grids if found is not None), None)
    if whole is None:
        return None
    across, up = np.abs(whole).T
    oblique = (across > 0) & (up > 0)
    counts = np.maximum(across, up)
    if (oblique & (across != up)).any() or not counts.all():
        return None
    ways = whole // counts[:, None]
    turns = (ways != np.roll(ways, 1, axis=0)).any(axis=1)
    if not turns[0 if closed else 1 :].all():
        return None
    # The level line of a mask has points on sides of pixels, across a corner half as far apart.
    if oblique.any() and not (counts[~oblique] % 2).any():
        counts[~oblique] //= 2
    return counts


def _chain(contour: Contour) -> tuple[float, _Stairs]:
    """Side of the pixels that points go along one by one, and the stairs."""
    if _halves(np.diff(contour.points[: FIRST_STEPS + 1], axis=0))[1] is None:
        return 0.0, NO_STAIRS
    pixel, halves = _halves(np.diff(contour.polyline, axis=0))
    if halves is not None and not (halves % 2).any():
        return pixel, _stairs_of(halves, contour.closed, between=False)
    if halves is not None and (np.abs(halves).sum(axis=1) == 2).all():
        return pixel, _stairs_of(halves, contour.closed, between=True)
    return pixel, NO_STAIRS


def _halves(steps: FloatArray) -> tuple[float, IntArray | None]:
    """The largest step along an axis, and all in halves of it, if they are whole numbers."""
    largest = float(np.abs(steps).max())
    return largest, _whole(steps, 0.5 * largest)


def _stairs_of(steps: IntArray, closed: bool, *, between: bool) -> _Stairs:
    """Stairs of a chain: a step of one pixel turns back what the one before it has turned.

    ``between`` the sides of pixels a step across a corner has half of their length.
    """
    turning = (steps != np.roll(steps, 1, axis=0)).any(axis=1)
    turning[0] |= not closed
    begins = np.flatnonzero(turning)
    if len(begins) < 3:
        return NO_STAIRS
    ends = np.append(begins[1:], len(steps) + (begins[0] if closed else 0))
    ways = steps[begins]
    (ax, ay), (bx, by) = np.roll(ways, 1, axis=0).T, ways.T
    turns = np.sign(ax * by - ay * bx)
    lengths = (ends - begins) * np.where(between & (ways != 0).all(axis=1), 0.5, 1.0)
    turns_back = turns * np.roll(turns, -1) < 0
    stairs = (lengths <= 1.0) & turns_back
    if not closed:
        stairs[[0, -1]] = False
    # Teeth turn twice one way, then twice the other.
    stairs &= np.roll(turns_back, 1) | np.roll(turns_back, -1)
    # One beside edges of one pixel alone may be beside either kind.
    longer = np.maximum(np.roll(lengths, 1), np.roll(lengths, -1)) > 1.0
    flat, steep = longer & (np.abs(ax) > np.abs(ay)), longer & (np.abs(ax) < np.abs(ay))
    return _Stairs(int(stairs.sum()), int((stairs & flat).sum()), int((stairs & steep).sum()))
