"""Corners as they were drawn: put back where the sides that run into them meet.

The square of a pixel averages a corner with the ground around it, so that every level line cuts it:
a right angle by 0.42 pixels in the mean and 0.71 at most, an acute one by more, and a lens or a
scanner by as much again for each pixel of blur. Beyond that the sides show undisturbed; lines or
parabolas through them meet in the corner. It is taken if it lies no farther from the level line
than square and blur can have cut off, and if the ink of the pixels around it adds up to that of the
drawing with it: a rounding has less.
"""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.coverage import border_coverage
from shapespline.tracing.sides import (
    BLURRED,
    DISTURBED,
    NONE,
    SAME_CORNER,
    SHORT_SIDE,
    SIDE,
    SQUARE,
    Ways,
    length_of,
    meetings,
    stations_of,
    turns_of,
)
from shapespline.tracing.softness import SHARP

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import TypeAlias

    from shapespline.tracing.field import Field
    from shapespline.tracing.sides import Corners
    from shapespline.tracing.softness import Softness
    from shapespline.typing import BoolArray, FloatArray, IntArray

    # Values of pixels around some corners, at rows and columns.
    Pixels: TypeAlias = Callable[[IntArray, IntArray, IntArray], FloatArray]

# Angle between the sides, degrees, and the farthest that the level line of a drawing can be from
# the corner, pixels: measured over all directions and places, area coverage.
ANGLES = (0.0, 15.0, 20.0, 30.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 135.0, 150.0, 165.0, 180.0)
CUT_OFF = (4.0, 3.9, 2.95, 2.03, 1.49, 1.22, 0.93, 0.715, 0.55, 0.42, 0.315, 0.223, 0.154, 0.05)
# The same for a blur, in its deviations, beside: half of it around a wedge is ink there (TRC-20).
CUT_OFF_BLURRED = (8.0, 5.17, 3.88, 2.61, 1.74, 1.29, 0.99, 0.77, 0.6, 0.45, 0.33, 0.21, 0.11, 0.0)
# A picture that was turned, or made larger or smaller a little, is blurred by less than is told:
# level lines are as far from corners as that blur lets them be (TRC-43).
SOFTENED = 0.25
# Pixels on either side of a corner whose ink is added up. No more of it may be missing, or be too
# much, than a rounding of this radius takes or a tip of this length has, and this many square
# pixels; so many more for each pixel of blur, as the blur is not known exactly (TRC-20).
AROUND, ROUNDING, TIP, UNCERTAIN, UNCERTAIN_BLUR = 3, 0.5, 1.5, 0.03, 0.25
# Where edges are rippled, what pixels farther than so many from a corner miss is ripples: so many
# deviations in each are not told of the sum, but no more than a rounding of this radius takes
# (TRC-37).
BESIDE, RIPPLES, RIPPLED_OFF = 2, 5.0, 1.5
# And so many where they are not, at turns that are no part of a rounding: what a picture's
# resampling leaves (TRC-43).
RESAMPLED, SHARP_TURN = 0.8, np.radians(45.0)
# Few greys leave the sum uncertain by so many square roots of their step, and no more than such a
# rounding takes (TRC-39).
FEW_GREYS = 0.6
# Corners whose ink is added up at once.
TOGETHER = 10_000
# From which sides corners are looked for: how far they are disturbed, and how far they go.
FROM = (*((disturbed, SIDE) for disturbed in DISTURBED), (DISTURBED[0], SHORT_SIDE))
# At last those that resampling lets them be, but among ripples (TRC-43).
LOOKS = (*((look, False) for look in FROM), *((look, True) for look in FROM[:3]))
# Under grain sides tell a corner better the longer they are; such ones scatter by this part of what
# a point alone does, so that arcs on them are told from lines (TRC-44).
LONG_SIDE, LONG_SCATTERS = 24.0, 0.25
LONG_LOOK = ((DISTURBED[0], LONG_SIDE), False)
# Shorter outlines have no sides that show undisturbed.
SHORTEST_OUTLINE = 16.0


def sharpened(
    outlines: Sequence[FloatArray],
    level_lines: Sequence[FloatArray],
    drawn: Sequence[bool],
    field: Field,
    soft: Softness,
    inks: FloatArray,
) -> list[FloatArray]:
    """Outlines with the corners that the picture shows; all others as they are.

    Parameters
    ----------
    outlines : sequence of ndarray, shape (n_i, 2)
        Closed, in picture coordinates, ink on the left.
    level_lines : sequence of ndarray
        The level line of each.
    drawn : sequence of bool
        Which of them lie where the picture's grey tells, or noise about it lets them; the others
        keep the corners that they have.
    field : Field
    soft : Softness
    inks : ndarray, shape (n,)
        What the ink of each is worth, of that of the picture.
    """

    def fit(corners: Corners, tried: Sequence[FloatArray], soft: Softness) -> BoolArray:
        ink = inks[corners.own, None, None]
        covered = border_coverage(tried, *field.shape)
        missing = missing_around(
            corners.points,
            field.shape,
            soft,
            picture=lambda some, r, c: field.ink(r, c) / ink[some],
            drawing=lambda _some, r, c: covered.at(r, c, field.shape[1]),
        )
        return missing.fits(corners, soft, field.noise)

    return put_back(outlines, level_lines, drawn, [True] * len(outlines), fit, soft)


def put_back(
    lines: Sequence[FloatArray],
    level_lines: Sequence[FloatArray],
    drawn: Sequence[bool],
    closed: Sequence[bool],
    fit: Callable[[Corners, Sequence[FloatArray], Softness], BoolArray],
    soft: Softness = SHARP,
) -> list[FloatArray]:
    """Outlines and open lines with the corners that fit the picture.

    How far sides are disturbed is not known: those that do not fit are looked for again, from
    farther sides (TRC-07).

    Parameters
    ----------
    lines, level_lines, drawn
        As for `sharpened`.
    closed : sequence of bool
    fit : callable
        Which corners fit the picture, of some and the lines with them, as soft as it is taken for.
    soft : Softness
    """
    long = [length >= SHORTEST_OUTLINE for length in map(length_of, lines)]
    used = np.flatnonzero(np.array(drawn, dtype=bool) & np.array(long))
    if len(used) == 0:
        return list(lines)
    chosen = used.tolist()
    ways = Ways([lines[k] for k in chosen], [closed[k] for k in chosen])
    turns = turns_of(ways, soft)
    corners = NONE
    looks = LOOKS[: len(FROM)] if soft.rippled else LOOKS
    if soft.grainy:
        looks = (LONG_LOOK, *looks)
    for (disturbed, side), resampled in looks:
        seen = soft._replace(resampled=resampled)
        blur = max(soft.blur, SOFTENED) if resampled else soft.blur
        most = np.array(CUT_OFF) + blur * np.array(CUT_OFF_BLURRED)
        found = meetings(ways, turns, disturbed, side, _left(soft, side))
        found = found._replace(own=used[found.own])
        far = _distances(found.points, found.own, level_lines, closed)
        cut_off = np.interp(np.degrees(np.pi - found.turns), ANGLES, most)
        found = corners.joined(found.chosen((far <= cut_off) & _away(found, corners)))
        if len(found.points) > len(corners.points):
            corners = found.chosen(fit(found, with_corners(lines, found, closed), seen))
        if len(corners.points) == len(turns.own):
            break
    return with_corners(lines, corners, closed)


def _left(soft: Softness, side: float) -> Softness:
    """A picture as soft as sides of a length are."""
    return soft._replace(scatter=LONG_SCATTERS * soft.scatter) if side == LONG_SIDE else soft


def _away(found: Corners, corners: Corners) -> BoolArray:
    """Which of the corners found are none of some others, looked for again."""
    if len(corners.own) == 0:
        return np.ones(len(found.own), dtype=bool)
    # Outlines one after the other, farther apart than any two places of one.
    span = 2.0 * float(max(found.ends.max(initial=0.0), corners.ends.max())) + SIDE
    held, places = (c.own * span + 0.5 * (c.begins + c.ends) for c in (corners, found))
    after = np.searchsorted(held, places)
    beside = held[np.stack([np.maximum(after - 1, 0), np.minimum(after, len(held) - 1)])]
    return np.asarray(np.abs(beside - places).min(axis=0) > SAME_CORNER)


def rounded_off(corners: Corners) -> FloatArray:
    """Square pixels that a rounding takes from corners which is none to speak of.

    Half of it where less of the sides than usual is taken for disturbed.
    """
    most = taken_off(corners.turns, ROUNDING)
    disturbed = 0.5 * (corners.ends - corners.begins) - SQUARE * np.tan(0.5 * corners.turns)
    return np.where(disturbed < 0.5 * DISTURBED[0], 0.5 * most, most)


def taken_off(turns: FloatArray, radius: float) -> FloatArray:
    """Square pixels that a rounding takes from corners, of acute ones no more than a tip has."""
    half = np.tan(0.5 * turns)
    return np.minimum(radius**2 * (half - 0.5 * turns), TIP**2 / half)


def _distances(
    points: FloatArray, own: IntArray, lines: Sequence[FloatArray], closed: Sequence[bool]
) -> FloatArray:
    """Of points to polylines whose edges are short, each to its own; infinite if far."""
    used = np.unique(own)
    if len(used) == 0:
        return np.empty(0)
    parts = [lines[k] if closed[k] else lines[k][:-1] for k in used]
    begins = np.concatenate(parts)
    steps = np.concatenate(
        [np.diff(lines[k], axis=0, append=lines[k][: int(closed[k])]) for k in used]
    )
    # Where edges begin, sorted by cells of a grid, a grid for each line, with free cells around.
    least = begins.min(axis=0)
    free = np.ptp(begins, axis=0) // SIDE + 3

    def cells(places: FloatArray, line: IntArray) -> IntArray:
        x, y = np.clip((places - least) // SIDE + 1, 0, free - 1).T
        return ((line * free[1] + y) * free[0] + x).astype(np.int64)

    keys = cells(begins, np.repeat(used, [len(part) for part in parts]))
    order = np.argsort(keys)
    keys = keys[order]
    found, middle = np.full(len(points), np.inf), cells(points, own)
    for row in middle + free[0].astype(np.int64) * np.array([[-1], [0], [1]]):
        first, last = np.searchsorted(keys, row - 1), np.searchsorted(keys, row + 1, "right")
        counts = last - first
        whose = np.repeat(np.arange(len(points)), counts)
        ahead = np.repeat(first - (np.cumsum(counts) - counts), counts)
        edges = order[ahead + np.arange(len(ahead))]
        off = begins[edges] - points[whose]
        best = np.full(len(edges), np.inf)
        for share in np.arange(0.0, 1.0, 0.125):
            best = np.minimum(best, np.hypot(*(off + share * steps[edges]).T))
        best[np.hypot(*off.T) > SIDE] = np.inf
        np.minimum.at(found, whose, best)
    return found


def with_corners(
    lines: Sequence[FloatArray], corners: Corners, closed: Sequence[bool]
) -> list[FloatArray]:
    """Outlines and open lines with corners in place of what lies between their sides."""
    return [
        _with(points, own, ring) if len(own.points) else points
        for points, own, ring in zip(lines, corners.by_outline(len(lines)), closed, strict=True)
    ]


def _with(points: FloatArray, corners: Corners, ring: bool) -> FloatArray:
    s = stations_of(np.concatenate([points, points[:1]]))
    length = s[-1]
    kept = np.ones(len(points), dtype=bool)
    for begin, end in zip(corners.begins, corners.ends, strict=True):
        kept &= (s[:-1] - begin) % length > end - begin
    size = corners.runs.shape[1]
    shares = (np.arange(size) + 1) / (size + 1)
    runs = corners.begins[:, None] + shares * (corners.ends - corners.begins)[:, None]
    order = np.argsort(np.concatenate([s[:-1][kept], runs.ravel() % length]), kind="stable")
    return np.concatenate([points[kept], corners.runs.reshape(-1, 2)])[order]


def around(
    at: FloatArray, size: tuple[int, ...], reach: int
) -> tuple[IntArray, IntArray, BoolArray]:
    """Rows and columns of pixels around places, square, and which are in the picture."""
    height, width = size
    column = np.floor(at[:, 0]).astype(np.int64)
    row = np.floor(height - at[:, 1]).astype(np.int64)
    offsets = np.arange(-reach, reach + 1)
    r, c = np.broadcast_arrays(
        row[:, None, None] + offsets[:, None], column[:, None, None] + offsets
    )
    return r, c, (r >= 0) & (r < height) & (c >= 0) & (c < width)


class Missing(NamedTuple):
    """What the pixels around each corner have and those of a drawing do not.

    Attributes
    ----------
    ink : ndarray, shape (n,)
        Added up, square pixels.
    beside : ndarray, shape (n,)
        Root mean square of the pixels that are no part of the corner.
    """

    ink: FloatArray
    beside: FloatArray

    def fits(self, corners: Corners, soft: Softness, noise: FloatArray | float) -> BoolArray:
        """Which corners miss no more than is not told, in noise of the contrast."""
        side = 2 * reach_of(soft) + 1
        uncertain = 3 * side * np.asarray(noise)
        sharp = soft.resampled & (corners.turns > SHARP_TURN)
        each = RIPPLES if soft.rippled else np.where(sharp, RESAMPLED, 0.0)
        ripples = each * side * self.beside
        ripples = np.maximum(ripples, FEW_GREYS * soft.step**0.5)
        most = taken_off(corners.turns, RIPPLED_OFF)
        uncertain = np.maximum(uncertain, np.minimum(ripples, most))
        uncertain = uncertain + UNCERTAIN + UNCERTAIN_BLUR * soft.blur
        return np.asarray(np.abs(self.ink) <= rounded_off(corners) + uncertain)


def missing_around(
    at: FloatArray,
    size: tuple[int, int],
    soft: Softness,
    picture: Pixels,
    drawing: Pixels,
) -> Missing:
    """What the pixels around each corner have and those of a blurred drawing do not.

    Parameters
    ----------
    at : ndarray, shape (n, 2)
    size : tuple of int
        Height and width of the picture.
    soft : Softness
    picture, drawing : callable
        Values of some pixels of each, given corners, rows and columns, shape (k, m, m).
    """
    reach, margin = reach_of(soft), ceil(BLURRED * soft.blur)
    shown = (slice(None), *(slice(margin, margin + 2 * reach + 1),) * 2)
    offsets = np.abs(np.arange(-reach, reach + 1))
    beside = np.maximum(offsets[:, None], offsets) > BESIDE
    ink, off = [], []
    for some in np.array_split(np.arange(len(at)), len(at) // TOGETHER + 1):
        r, c, inside = around(at[some], size, reach + margin)
        r, c = np.clip(r, 0, size[0] - 1), np.clip(c, 0, size[1] - 1)
        drawn = drawing(some, r, c)
        if soft.blur:
            from scipy.ndimage import gaussian_filter  # which takes a while to load

            drawn = gaussian_filter(drawn, soft.blur, axes=(1, 2), radius=margin)
        more = picture(some, r[shown], c[shown]) - drawn[shown]
        more = np.where(inside[shown], more, 0.0)
        ink.append(more.sum(axis=(1, 2)))
        off.append(np.sqrt((more[:, beside] ** 2).mean(axis=1)))
    return Missing(np.concatenate(ink), np.concatenate(off))


def reach_of(soft: Softness) -> int:
    """Pixels on either side of a corner whose ink is added up."""
    return AROUND + round(soft.blur)
