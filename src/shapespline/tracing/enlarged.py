"""Enlarged pictures: how many pixels stand for one of the picture that was enlarged, and that one.

Between the middles of two pixels of the smaller picture a straight or cubic interpolation all but
lets higher differences vanish, across them not; copies of a pixel have no differences at all
within. So the mean square of differences has the period of the enlargement (Gallagher, "Detection
of linear and cubic interpolation in JPEG compressed images", Canadian Conference on Computer and
Robot Vision, 2005).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.tracing.layer import STRIP, Layer, strips
from shapespline.tracing.level import with_values

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.tracing.field import Field
    from shapespline.typing import FloatArray

# How often pictures may have been enlarged: as tips for tracing and screens of many pixels do.
FACTORS = (2, 3, 4)
# Root mean squares of the differences within, of those across: interpolated, and copied; and of all
# first differences by factors, for those of sharp edges are large anywhere (TRC-38).
WITHIN, COPIED, SMOOTH = 0.6, 0.15, {2: 0.48, 3: 0.4, 4: 0.3}
# Grey has these parts of the contrast, and this part of the edges has it, of so many kinds: of
# blocks of few colours the corners tell more than their middles would (TRC-38).
GREY, GREY_PART, KINDS = (0.1, 0.9), 0.25, 8
# Blocks along the shorter side, at least; pixels and rows or columns that tell (TRC-38).
FEWEST_BLOCKS, SAMPLE, LINES = 8, 20_000, 64


class Enlargement(NamedTuple):
    """Pixels along each side of a block that stands for one, and whether all of it are copies."""

    factor: int
    copied: bool = False

    @classmethod
    def of(cls, field: Field) -> Enlargement:
        """Of a picture; a factor of 1 where it was not enlarged.

        Examples
        --------
        >>> from shapespline.tracing.field import Field
        >>> small = np.clip(np.hypot(*np.mgrid[-9.3:9, -8.8:10]) - 5.5, 0.0, 1.0)
        >>> Enlargement.of(Field(Layer(small), 0.51, False, 1.0, 0.0, 0.5)).factor
        1
        >>> large = np.kron(small, np.ones((3, 3)))
        >>> Enlargement.of(Field(Layer(large), 0.51, False, 1.0, 0.0, 0.5))
        Enlargement(factor=3, copied=True)
        """
        height, width = field.shape
        sums = [_differences(field.values, order) for order in (1, 2, 3)]
        every = sum(float(along.sum()) for along in sums[0])
        found = {}
        for factor in FACTORS:
            if height % factor or width % factor or min(height, width) < FEWEST_BLOCKS * factor:
                continue
            copied, _ = _within(sums[0], factor, range(factor - 1))
            if copied <= COPIED:
                found[cls(factor, copied=True)] = copied
            # What may vanish from the middle of one block to that of the next: second differences
            # of three or four pixels, third ones where two pixels lie on either side of a middle.
            order, count = (3, 1) if factor == 2 else (2, factor + factor % 2 - 2)
            begins = range(factor // 2, factor // 2 + count)
            ratio, total = _within(sums[order - 1], factor, begins)
            if ratio <= WITHIN and total <= SMOOTH[factor] ** 2 * every:
                found[cls(factor)] = ratio
        if not found or not _is_grey(field):
            return cls(1)
        # Of copies those of four are those of two as well.
        best = min(found.values())
        return max(one for one, ratio in found.items() if ratio == best)

    def undone(self, field: Field) -> Field:
        """The picture that was enlarged, a pixel for each block.

        The mean over a block is the pixel where all are copies of it. Interpolated ones lie around
        its middle with the variance of their places, which its neighbours take away again.
        """
        factor = self.factor
        height, width = (side // factor for side in field.shape)
        small = np.empty((height, width))
        for rows in strips(small.shape, STRIP // factor**2):
            blocks = field.values[rows.start * factor : rows.stop * factor].astype(np.float64)
            small[rows] = blocks.reshape(-1, factor, width, factor).mean(axis=(1, 3))
        if not self.copied:
            spread = (1.0 - 1.0 / factor**2) / 12.0
            for side in (small, small.T):
                steps = np.diff(side, axis=0)
                side[:-1] += -0.5 * spread * steps
                side[1:] += 0.5 * spread * steps
        found = with_values(field, Layer(small))
        return replace(found, scale=factor, interpolated=not self.copied)


def _differences(values: Layer, order: int) -> list[FloatArray]:
    """Sums of squares of differences that begin at each column, and at each row."""
    found = []
    for sample in (values[:: _step(values, 0)], values[:, :: _step(values, 1)].T):
        lines: NDArray[Any] = np.ascontiguousarray(sample, dtype=np.float64)
        found.append((np.diff(lines, n=order, axis=1) ** 2).sum(axis=0))
    return found


def _step(values: Layer, axis: int) -> int:
    """From one row or column that is looked at to the next."""
    return max(1, min(round(values.size / SAMPLE), values.shape[axis] // LINES))


def _within(sums: Sequence[FloatArray], factor: int, begins: range) -> tuple[float, float]:
    """Root mean square of the differences that begin there over that of others, and their sum.

    Of columns or rows, whichever is more.
    """
    inner = [k % factor for k in begins]
    ratios, total = [], 0.0
    for along in sums:
        means = np.array([along[k::factor].mean() for k in range(factor)])
        across = float(np.delete(means, inner).mean())
        ratios.append(float(np.sqrt(means[inner].mean() / across)) if across else np.inf)
        total += sum(float(along[k::factor].sum()) for k in inner)
    return max(ratios), total


def _is_grey(field: Field) -> bool:
    """Whether many pixels beside edges are neither ground nor ink, and not of a few colours."""
    rows = np.arange(0, field.shape[0], _step(field.values, 0))
    part = field.coverage(rows[:, None], np.arange(field.shape[1])[None, :])
    low, high = np.minimum(part[:, :-1], part[:, 1:]), np.maximum(part[:, :-1], part[:, 1:])
    beside = (low < 0.5) & (high > 0.5)
    between = np.concatenate([side[beside] for side in (low, high)])
    grey = between[(between > GREY[0]) & (between < GREY[1])]
    return bool(len(grey) > GREY_PART * beside.sum() and len(np.unique(grey)) >= KINDS)
