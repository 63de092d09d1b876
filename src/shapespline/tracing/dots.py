"""Dots and small holes as they were drawn: circles and upright rectangles that their ink tells.

An outline of a few pixels has no sides that show undisturbed. But a circle is told by its area and
its middle, an upright rectangle by what is missing along each of its four edges: Newton's method
for these numbers, the whole drawing covered anew each time. The one that the pixels about agree
with better, one by one, is taken, if they agree with either.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry import signed_area
from shapespline.tracing.corners import around
from shapespline.tracing.coverage import border_coverage
from shapespline.tracing.roundings import most_missed

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapespline.tracing.coverage import Covered
    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray

# Outlines that extend over no more pixels, and enclose so many square pixels at least.
LARGEST, LEAST_AREA = 8.0, 1.2
# Pixels on either side of a dot's middle that are looked at, and how far beyond its outline.
REACH, BESIDE = 6, 1.1
ROUNDS = 4
# A rectangle misses them by so much less than a circle (TRC-31).
CLEARLY = 0.006
# Points of a circle, and of each side of a rectangle.
POINTS, SIDE_POINTS = 24, 6
_ANGLES = np.arange(POINTS) * (2.0 * np.pi / POINTS)
_CIRCLE = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])
# The polygon of its points encloses as much as a circle of one.
_AS_LARGE = np.sqrt(2 * np.pi / POINTS / np.sin(2 * np.pi / POINTS))
_RECTANGLE = np.concatenate(
    [
        np.linspace(one, two, SIDE_POINTS, endpoint=False)
        for one, two in (((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 1)), ((0, 1), (0, 0)))
    ]
)


def dotted(
    outlines: Sequence[FloatArray],
    level_lines: Sequence[FloatArray],
    field: Field,
    inks: FloatArray,
) -> tuple[list[FloatArray], BoolArray]:
    """Outlines with the dots that the picture shows, and which these are; all others as they are.

    Parameters
    ----------
    outlines, level_lines : sequence of ndarray, shape (n_i, 2)
        Closed, in picture coordinates, ink on the left.
    field : Field
    inks : ndarray, shape (n,)
        What the ink of each is worth, of that of the picture.
    """
    told = np.zeros(len(outlines), dtype=bool)
    areas = np.array([signed_area(line) if len(line) else 0.0 for line in level_lines])
    sizes = np.array([np.ptp(line, axis=0).max() if len(line) else 0.0 for line in level_lines])
    small = np.flatnonzero((sizes <= LARGEST) & (np.abs(areas) >= LEAST_AREA))
    out = list(outlines)
    if len(small) == 0:
        return out, told
    ways, ink = np.sign(areas[small]), inks[small]
    least, most = (
        np.array([end(level_lines[k], axis=0) for k in small.tolist()]) for end in (np.min, np.max)
    )
    middle = 0.5 * (least + most)
    pixels = _Pixels(middle, field, ink)

    def drawn(points: FloatArray) -> FloatArray:
        for k, one, way in zip(small, points, ways, strict=True):
            out[k] = one[:: int(way)]
        return ways[:, None, None] * pixels.missed(border_coverage(out, *field.shape))

    radii = np.sqrt(np.abs(areas[small]) / np.pi)
    circles, off_circles = _circles(middle.copy(), radii, pixels, drawn)
    boxes, off_boxes = _boxes(least, most, pixels, drawn)
    # A round dot on four pixels and a square one are the same: round dots are drawn more often.
    is_box = off_boxes + CLEARLY < off_circles
    good = np.where(is_box, off_boxes, off_circles) <= most_missed(field.noise)
    told[small] = good
    for k, box, circle, boxed, fits, way in zip(
        small, boxes, circles, is_box, good, ways, strict=True
    ):
        out[k] = (box if boxed else circle)[:: int(way)] if fits else outlines[k]
    return out, told


class _Pixels:
    """Pixels about some places, one square of them for each."""

    def __init__(self, middle: FloatArray, field: Field, ink: FloatArray) -> None:
        height, self._width = field.shape
        r, c, self._inside = around(middle, field.shape, REACH)
        self.x, self.y = c + 0.5, height - r - 0.5
        self._r, self._c = np.clip(r, 0, height - 1), np.clip(c, 0, self._width - 1)
        self._ink = field.ink(self._r, self._c) / ink[:, None, None]

    def missed(self, covered: Covered) -> FloatArray:
        """What they have and a drawing does not."""
        missed = self._ink - covered.at(self._r, self._c, self._width)
        return np.where(self._inside, missed, 0.0)


def _circles(
    middle: FloatArray,
    radii: FloatArray,
    pixels: _Pixels,
    drawn: Callable[[FloatArray], FloatArray],
) -> tuple[FloatArray, FloatArray]:
    """Points of circles, and how far the pixels about miss them in the mean."""
    for last in (*(False,) * (ROUNDS - 1), True):
        missed = drawn(middle[:, None] + (_AS_LARGE * radii)[:, None, None] * _CIRCLE)
        x, y = pixels.x - middle[:, :1, None], pixels.y - middle[:, 1:, None]
        about = np.hypot(x, y) <= radii[:, None, None] + BESIDE
        missed = np.where(about, missed, 0.0)
        if last:
            break
        area = np.pi * radii**2
        step = np.stack([(missed * x).sum(axis=(1, 2)), (missed * y).sum(axis=(1, 2))], axis=1)
        middle = middle + np.clip(step / area[:, None], -0.5, 0.5)
        radii = np.sqrt(np.maximum(area + missed.sum(axis=(1, 2)), 0.25 * area) / np.pi)
    off = np.sqrt((missed**2).sum(axis=(1, 2)) / about.sum(axis=(1, 2)))
    return middle[:, None] + radii[:, None, None] * _CIRCLE, off


def _boxes(
    least: FloatArray, most: FloatArray, pixels: _Pixels, drawn: Callable[[FloatArray], FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Points of upright rectangles, and how far the pixels about miss them in the mean."""
    sides = np.concatenate([least, most], axis=1)  # left, bottom, right, top
    for last in (*(False,) * (ROUNDS - 1), True):
        least, size = sides[:, None, :2], (sides[:, 2:] - sides[:, :2])[:, None]
        points = least + size * _RECTANGLE
        missed = drawn(points)
        beyond = np.stack(
            [
                sides[:, 0, None, None] - pixels.x,
                sides[:, 1, None, None] - pixels.y,
                pixels.x - sides[:, 2, None, None],
                pixels.y - sides[:, 3, None, None],
            ]
        )
        about = beyond.max(axis=0) <= BESIDE
        missed = np.where(about, missed, 0.0)
        if last:
            break
        nearest = np.argmax(beyond, axis=0)
        more = np.stack([np.where(nearest == k, missed, 0.0).sum(axis=(1, 2)) for k in range(4)])
        length = np.maximum(size[:, 0, ::-1], 0.5)
        step = np.clip(more.T / np.concatenate([length, length], axis=1), -0.5, 0.5)
        sides = sides + step * np.array([-1.0, -1.0, 1.0, 1.0])
    off = np.sqrt((missed**2).sum(axis=(1, 2)) / about.sum(axis=(1, 2)))
    return points, off
