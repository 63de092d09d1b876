"""Corners as they were drawn: put back where the sides that run into them meet.

The square of a pixel averages a corner with the ground around it, so that every level line cuts it:
a right angle by 0.43 pixels in the mean and 0.64 at most, an acute one by more. Beyond that the
sides show undisturbed; lines or parabolas through them meet in the corner. It is taken if it lies
no farther from the level line than the square can have cut off, and if the ink of the pixels around
it adds up to that of the drawing with it: a rounding has less.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.coverage import border_coverage

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray

# Angle between the sides, degrees, and the farthest that the level line of a drawing can be from
# the corner, pixels: measured over all directions and places, area coverage.
ANGLES = (0.0, 20.0, 30.0, 45.0, 60.0, 90.0, 120.0, 150.0, 180.0)
CUT_OFF = (4.0, 2.7, 1.9, 1.3, 1.0, 0.64, 0.40, 0.21, 0.05)
# A turn of more, between chords that begin and end so many pixels before and behind.
LEAST_TURN = np.radians(22.0)
CHORD = (1.0, 3.4)
# Candidates nearer than this are one; sides are looked at as far as this, and over no less.
SAME_CORNER, SIDE, SHORTEST_SIDE = 1.6, 6.0, 0.9
# A side is disturbed this far from the corner: half a pixel for its column, and what the other
# side's square reaches over.
DISTURBED, SQUARE = 0.75, 0.5
# Root mean square distance in pixels of a side to a line and a parabola. The line is taken where it
# is not so many times worse.
SMOOTH, TIE, TIE_FACTOR = 0.05, 0.004, 1.5
SAMPLES, ROUNDS = 9, 4
# Sides that are still farther apart (pixels) where they are nearest do not meet (TRC-13).
MEET = 0.01
_SHARES = np.linspace(0.0, 1.0, SAMPLES)
_POWERS = _SHARES[:, None] ** np.arange(3)
# Coefficients of least squares, those beyond the degree nothing.
_SOLVED = {
    degree: np.pad(np.linalg.pinv(_POWERS[:, : degree + 1]), ((0, 2 - degree), (0, 0)))
    for degree in (1, 2)
}
# Pixels on either side of a corner whose ink is added up. No more of it may be missing, or be too
# much, than a rounding of this radius takes and this many square pixels.
AROUND, ROUNDING, UNCERTAIN = 3, 0.5, 0.03
# Decimals of a pixel that a corner's place has.
DIGITS = 9
# Shorter outlines have no sides that show undisturbed.
SHORTEST_OUTLINE = 16.0


class _Found(NamedTuple):
    """Corners of one outline: places, turns, and the arc lengths where their sides take over."""

    points: FloatArray
    turns: FloatArray
    begins: FloatArray
    ends: FloatArray


_NONE = _Found(np.empty((0, 2)), *(np.empty(0) for _ in range(3)))


def sharpened(
    outlines: Sequence[FloatArray],
    level_lines: Sequence[FloatArray],
    drawn: Sequence[bool],
    field: Field,
) -> list[FloatArray]:
    """Outlines with the corners that the picture shows; all others as they are.

    Parameters
    ----------
    outlines : sequence of ndarray, shape (n_i, 2)
        Closed, in picture coordinates, ink on the left.
    level_lines : sequence of ndarray
        The level line of each.
    drawn : sequence of bool
        Which of them the grey of the picture told; the others keep the corners that they have.
    field : Field
    """
    found = [
        _corners(points, line) if certain else _NONE
        for points, line, certain in zip(outlines, level_lines, drawn, strict=True)
    ]
    tried = [_with(points, corners) for points, corners in zip(outlines, found, strict=True)]
    at = np.concatenate([corners.points for corners in found])
    if len(at) == 0:
        return list(outlines)
    turns = np.concatenate([corners.turns for corners in found])
    rounded = ROUNDING**2 * (np.tan(0.5 * turns) - 0.5 * turns)
    noise = field.noise * (2 * AROUND + 1)
    good = np.abs(_missing(at, tried, field)) <= UNCERTAIN + rounded + 3 * noise
    ends = np.cumsum([len(corners.points) for corners in found])
    return [
        _with(points, _Found(*(column[kept] for column in corners)))
        for points, corners, kept in zip(outlines, found, np.split(good, ends[:-1]), strict=True)
    ]


def _corners(points: FloatArray, line: FloatArray) -> _Found:
    """Where the sides of an outline meet, as far as its level line allows."""
    s = _stations(points)
    if s[-1] < SHORTEST_OUTLINE:
        return _NONE
    at, turn = _candidates(points, s)
    if len(at) == 0:
        return _NONE
    turn = np.abs(turn)
    for _ in range(ROUNDS):
        near = DISTURBED + SQUARE * np.tan(0.5 * turn)
        ahead = np.diff(np.append(at, at[0] + s[-1]))
        behind = np.roll(ahead, 1)
        sides, wide = [], np.full(len(at), np.inf)
        for room, sign in ((behind, -1.0), (ahead, 1.0)):
            far = np.minimum(SIDE, room - near)
            sides.append(_side(points, s, at, near, far, sign))
            wide = np.minimum(wide, far - near)
        meets, turn, off, apart = _meeting(*(side[0] for side in sides))
        at = at + np.clip(off, -SAME_CORNER, SAME_CORNER)
        in_order = np.argsort(at)
        if (in_order != np.arange(len(at))).any():
            return _NONE
    cut_off = np.interp(np.degrees(np.pi - turn), ANGLES, CUT_OFF)
    good = sides[0][1] & sides[1][1] & (wide >= SHORTEST_SIDE) & (turn > LEAST_TURN)
    # The sides of a stroke's round end run side by side and meet nowhere.
    good &= apart <= MEET
    good &= _distance(meets, line) <= cut_off
    # Edges along the rows and columns meet on whole numbers, but for a rounding.
    meets = np.round(meets, DIGITS)
    return _Found(meets[good], turn[good], (at - near)[good], (at + near)[good])


def _stations(points: FloatArray) -> FloatArray:
    """Arc length at each vertex and, at the end, of the whole closed outline."""
    steps = np.roll(points, -1, axis=0) - points
    return np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])


def _at(points: FloatArray, s: FloatArray, where: FloatArray) -> FloatArray:
    x, y = (np.interp(where, s[:-1], axis, period=s[-1]) for axis in points.T)
    return np.stack([x, y], axis=-1)


def _candidates(points: FloatArray, s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Arc lengths where an outline turns most, and by how much."""
    step = 0.25
    at = np.arange(0.0, s[-1], step)
    near, far = CHORD
    before = _at(points, s, at - near) - _at(points, s, at - far)
    after = _at(points, s, at + far) - _at(points, s, at + near)
    turn = _turn(before, after)
    reach = round(SAME_CORNER / step)
    padded = np.pad(np.abs(turn), reach, mode="wrap")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1)
    top = (np.abs(turn) >= windows.max(axis=1) - 1e-6) & (np.abs(turn) > LEAST_TURN)
    index = np.flatnonzero(top)
    if len(index) == 0:
        return np.empty(0), np.empty(0)
    # Of a flat top the middle.
    groups = np.split(index, np.flatnonzero(np.diff(index) > reach) + 1)
    if len(groups) > 1 and groups[0][0] + len(at) - groups[-1][-1] <= reach:
        groups[0] = np.concatenate([groups.pop() - len(at), groups[0]])
    middle = np.array([group.mean() for group in groups])
    return step * middle, turn[np.round(middle).astype(int)]


def _turn(before: FloatArray, after: FloatArray) -> FloatArray:
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.arctan2(cross, (before * after).sum(axis=1))


def _side(
    points: FloatArray,
    s: FloatArray,
    at: FloatArray,
    near: FloatArray,
    far: FloatArray,
    sign: float,
) -> tuple[FloatArray, BoolArray]:
    """Polynomials of degree 2 in the distance from each corner, shape (k, 3, 2); which fit."""
    span = np.maximum(far - near, SHORTEST_SIDE)
    t = near[:, None] + _SHARES * span[:, None]
    seen = _at(points, s, (at[:, None] + sign * t).ravel()).reshape(len(at), SAMPLES, 2)
    line, line_off = _fitted(seen, 1)
    bent, bent_off = _fitted(seen, 2)
    straight = line_off <= TIE_FACTOR * bent_off + TIE
    c0, c1, c2 = np.moveaxis(np.where(straight[:, None, None], line, bent), 1, 0)
    # From a share of the side to the distance from the corner.
    begin, unit = (near / span)[:, None], 1 / span[:, None]
    fitted = [c0 - begin * c1 + begin**2 * c2, unit * (c1 - 2 * begin * c2), unit**2 * c2]
    return np.stack(fitted, axis=1), np.where(straight, line_off, bent_off) <= SMOOTH


def _fitted(seen: FloatArray, degree: int) -> tuple[FloatArray, FloatArray]:
    """Least squares polynomials of degree 2 at most, and the root mean square of what is left."""
    fitted = _SOLVED[degree] @ seen
    return fitted, np.sqrt(((_POWERS @ fitted - seen) ** 2).sum(axis=2).mean(axis=1))


def _meeting(
    first: FloatArray, second: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Where pairs of sides meet, by Newton's method; turn; how far along; how far apart still."""
    t = np.zeros((len(first), 2))

    def value(side: FloatArray, u: FloatArray) -> FloatArray:
        return side[:, 0] + u[:, None] * (side[:, 1] + u[:, None] * side[:, 2])

    def slope(side: FloatArray, u: FloatArray) -> FloatArray:
        return side[:, 1] + 2 * u[:, None] * side[:, 2]

    for _ in range(6):
        gap = value(second, t[:, 1]) - value(first, t[:, 0])
        a, b = slope(first, t[:, 0]), slope(second, t[:, 1])
        det = b[:, 0] * a[:, 1] - a[:, 0] * b[:, 1]
        det = np.where(np.abs(det) < 1e-9, 1e-9, det)
        t[:, 0] += (b[:, 0] * gap[:, 1] - b[:, 1] * gap[:, 0]) / det
        t[:, 1] += (a[:, 0] * gap[:, 1] - a[:, 1] * gap[:, 0]) / det
        t = np.clip(t, -SIDE, SIDE)
    ends = value(first, t[:, 0]), value(second, t[:, 1])
    meets, apart = 0.5 * (ends[0] + ends[1]), np.hypot(*(ends[0] - ends[1]).T)
    turn = np.abs(_turn(-slope(first, t[:, 0]), slope(second, t[:, 1])))
    return meets, turn, 0.5 * (t[:, 1] - t[:, 0]), apart


def _distance(points: FloatArray, line: FloatArray) -> FloatArray:
    """Of points to a closed polyline whose edges are short."""
    from scipy.spatial import cKDTree

    ahead = np.roll(line, -1, axis=0) - line
    dense = np.concatenate([line + share * ahead for share in np.arange(0.0, 1.0, 0.125)])
    return np.asarray(cKDTree(dense).query(points)[0])


def _with(points: FloatArray, corners: _Found) -> FloatArray:
    """The outline with corners in place of what lies between their sides."""
    if len(corners.points) == 0:
        return points
    s = _stations(points)
    length = s[-1]
    kept = np.ones(len(points), dtype=bool)
    for begin, end in zip(corners.begins, corners.ends, strict=True):
        kept &= (s[:-1] - begin) % length > end - begin
    middles = (0.5 * (corners.begins + corners.ends)) % length
    order = np.argsort(np.concatenate([s[:-1][kept], middles]), kind="stable")
    return np.concatenate([points[kept], corners.points])[order]


def _missing(at: FloatArray, outlines: Sequence[FloatArray], field: Field) -> FloatArray:
    """Ink around each corner that the picture has and the outlines do not, square pixels."""
    height, width = field.values.shape
    keys, drawn = border_coverage(outlines, height, width)
    column = np.floor(at[:, 0]).astype(np.int64)
    row = np.floor(height - at[:, 1]).astype(np.int64)
    offsets = np.arange(-AROUND, AROUND + 1)
    r, c = np.broadcast_arrays(
        row[:, None, None] + offsets[:, None], column[:, None, None] + offsets
    )
    inside = (r >= 0) & (r < height) & (c >= 0) & (c < width)
    seen = field.coverage(r, c)
    key = np.where(inside, r * width + c, -1)
    place = np.minimum(np.searchsorted(keys, key), max(len(keys) - 1, 0))
    ours = np.where(keys[place] == key, drawn[place], np.rint(np.clip(seen, 0, 1)))
    return np.where(inside, seen - ours, 0.0).sum(axis=(1, 2))
