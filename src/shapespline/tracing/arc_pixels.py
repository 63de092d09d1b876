"""What the pixels along arcs have and those of a drawing do not, as soft as their picture is."""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.corners import around
from shapespline.tracing.coverage import border_coverage
from shapespline.tracing.sides import BLURRED, Ways, turns_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.coverage import Covered
    from shapespline.tracing.field import Field
    from shapespline.tracing.softness import Softness
    from shapespline.typing import BoolArray, FloatArray, IntArray

# Pixels whose middle is so near to an arc tell it, of those so near to its own middle (TRC-29); and
# so much farther for each pixel of blur (TRC-47).
ALONG, REACH, ALONG_BLURRED = 1.1, 7, 1.5
# Pixels of edges that a renderer drew exactly miss the drawing by no more; where edges miss it by
# more than so much, and so many times the noise, they are no edges of that blur (TRC-47).
EXACT, MOST_OFF, MOST_NOISE = 0.005, 0.03, 1.5
# The blur is that of these with which edges miss least, parts of the one that is told (TRC-47).
BLURS = (0.8, 0.9, 1.0, 1.1, 1.2, 1.3)
# Points of edges, and turns, from which is told what pixels miss; arcs that are looked at together.
ENOUGH, MOST_TURNS, TOGETHER = 5000, 500, 2000
# From the median to the deviation; which part of the pixels about turns miss less than is counted,
# as many are even, and how many deviations that is (TRC-47).
DEVIATION, MOST, OF_MOST = 1.4826, 0.9, 1.645


class Missed(NamedTuple):
    """What pixels around some arcs have and a drawing does not, where they are along the arcs."""

    ink: FloatArray
    along: BoolArray

    @property
    def seen(self) -> IntArray:
        """How many of them are along each arc: none of one beyond the rim."""
        return np.asarray(self.along.sum(axis=1))

    @property
    def mean(self) -> FloatArray:
        """Root mean square over those of each arc."""
        return np.sqrt((self.ink**2).sum(axis=1) / np.maximum(self.seen, 1))


class Border(NamedTuple):
    """Pixels that outlines pass through, and what the ink of each is worth."""

    row: IntArray
    column: IntArray
    ink: FloatArray

    @classmethod
    def of(cls, outlines: Sequence[FloatArray], inks: FloatArray, field: Field) -> Border:
        """Some of them, if there are many."""
        every = sum(map(len, outlines)) // ENOUGH + 1
        ink = np.repeat(inks, [len(one) for one in outlines])[::every]
        row, column, _ = around(np.concatenate(outlines)[::every], field.shape, 0)
        return cls(row, column, ink)

    def off(self, pixels: ArcPixels, covered: Covered) -> FloatArray:
        """By how much each misses a drawing."""
        seen = pixels.seen(self.row, self.column) / self.ink[:, None, None]
        return np.abs(seen - pixels.spread(covered, self.row, self.column))


class ArcPixels(NamedTuple):
    """A picture, by how many pixels its edges are spread, and what its pixels are off by usually.

    ``exact`` are those of a renderer, whose ``error`` is the noise of the picture, of the contrast.
    """

    field: Field
    blur: float
    error: float
    exact: bool = True

    @classmethod
    def of(
        cls,
        outlines: Sequence[FloatArray],
        drawn: Sequence[bool],
        field: Field,
        inks: FloatArray,
        soft: Softness,
    ) -> ArcPixels | None:
        """As those of its outlines tell that are where they were drawn; None if they do not."""
        used = np.flatnonzero(drawn).tolist()
        if not used:
            return None
        some = [outlines[k] for k in used]
        ways = Ways(some, [True] * len(some))
        own, at, _ = turns_of(ways)
        covered = border_coverage(outlines, *field.shape)
        border = Border.of(some, inks[used], field)
        return cls._told(field, soft, ways.at(own, at), border, covered)

    @classmethod
    def _told(
        cls, field: Field, soft: Softness, turns: FloatArray, border: Border, covered: Covered
    ) -> ArcPixels | None:
        """As its borders tell, most of which are where they were drawn; None if they tell nothing.

        ``turns`` are the places where outlines turn: JPEG leaves straight edges along its blocks as
        they were. ``covered`` is what all outlines cover.
        """
        if soft.step:  # few greys: what pixels are off by is their steps
            return cls(field, 0.0, field.noise)
        blur = soft.spread
        tried = [cls(field, blur * factor, field.noise) for factor in (BLURS if blur else (1.0,))]
        errors = [DEVIATION * float(np.median(border.off(one, covered))) for one in tried]
        error, some = min(zip(errors, tried, strict=True), key=lambda pair: pair[0])
        if error > MOST_OFF + MOST_NOISE * field.noise:
            return None if blur else some
        if len(turns):
            row, column, inside = around(turns[:: len(turns) // MOST_TURNS + 1], field.shape, REACH)
            off = np.abs(some.seen(row, column) - some.spread(covered, row, column))
            error = max(error, float(np.quantile(off[inside], MOST)) / OF_MOST)
        if not blur and error <= EXACT:
            return some
        return some._replace(error=max(field.noise, error), exact=False)

    def missed(self, points: FloatArray, covered: Covered, ink: FloatArray) -> Missed:
        """Of a drawing, along lines of points; ``ink`` is what that of each is worth."""
        parts = np.array_split(np.arange(len(ink)), len(ink) // TOGETHER + 1)
        found = [self._missed(points[some], covered, ink[some]) for some in parts]
        return Missed(*(np.concatenate(column) for column in zip(*found, strict=True)))

    def _missed(self, points: FloatArray, covered: Covered, ink: FloatArray) -> Missed:
        height, _ = shape = self.field.shape
        reach = REACH + ceil(self.blur)
        middles = 0.5 * (points.min(axis=1) + points.max(axis=1))
        row, column, inside = around(middles, shape, reach)
        x_off = (column[:, 0] + 0.5)[:, None] - points[..., :1]
        y_off = (height - row[:, :, 0] - 0.5)[:, None] - points[..., 1:]
        near = (y_off[..., None] ** 2 + x_off[:, :, None] ** 2).min(axis=1)
        along = inside & (near <= (ALONG + ALONG_BLURRED * self.blur) ** 2)
        missed = self.seen(row, column) / ink[:, None, None] - self.spread(covered, row, column)
        size = (len(ink), (2 * reach + 1) ** 2)
        return Missed(np.where(along, missed, 0.0).reshape(size), along.reshape(size))

    def seen(self, row: IntArray, column: IntArray) -> FloatArray:
        """Its pixels, beyond the rim those of the rim."""
        height, width = self.field.shape
        return self.field.ink(np.clip(row, 0, height - 1), np.clip(column, 0, width - 1))

    def spread(self, covered: Covered, row: IntArray, column: IntArray) -> FloatArray:
        """What a drawing covers of squares of pixels, shape (n, m, m), spread by the blur."""
        height, width = self.field.shape
        margin = ceil(BLURRED * self.blur)
        first = np.arange(row.shape[1] + 2 * margin) - margin
        row = np.clip(row[:, :1, :1] + first[:, None], 0, height - 1)
        column = np.clip(column[:, :1, :1] + first, 0, width - 1)
        row, column = np.broadcast_arrays(row, column)
        drawn = covered.at(row, column, width)
        if not self.blur:
            return drawn
        from scipy.ndimage import gaussian_filter  # which takes a while to load

        drawn = gaussian_filter(drawn, self.blur, axes=(1, 2), radius=margin)
        shown = slice(margin, drawn.shape[1] - margin)
        return np.asarray(drawn[:, shown, shown])
