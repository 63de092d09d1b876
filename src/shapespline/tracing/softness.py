"""Softness: how far a lens, a scanner or a resampling spread the edges of a picture, and its noise.

The grey across a straight edge rises as a distribution does. Its variance is that of the blur, of
the pixel's square and of the unit between two rows: read along a column that the edge crosses at an
angle a to the row, (s^2 + 1/12) / cos^2 a + 1/12.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.edges import NOISIEST, REACH, profiles_across

if TYPE_CHECKING:
    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.typing import FloatArray

# Edges that tell the blur: so many of them, that cross their row or column by this part of the
# square of their slope; the two outermost pixels of ground and of ink are even, but for so many
# deviations of the noise. They are so much of all, or nothing is known of the picture (TRC-20).
ENOUGH, LEAST_ACROSS, EVEN, EVEN_NOISE, PLAIN = 100_000, 0.4, 0.02, 2.0, 0.2
# Grey that falls by more of the contrast, and so many deviations of the noise, from one pixel to
# the next on its way from ground to ink is that of other strokes beside (TRC-28).
FALLS, FALLS_NOISE = 0.25, 4.0
# Edges of less blur than this are those of a renderer: sharp (TRC-20).
LEAST_BLUR = 0.5
# Less than that shows in arcs of few pixels, but for what JPEG alone seems to spread (TRC-47).
LEAST_SPREAD = 0.4
# Variance of a place within a pixel, and of a value between two pixels, of theirs: in the mean over
# all places there.
WITHIN_PIXEL, BETWEEN_PIXELS = 1 / 12, 2 / 3


# Level lines are straight through edges blurred by so many pixels, or blurred at all where noise
# scatters them by as much: it adds up in what is summed (TRC-20).
SOFT, SCATTERED = 0.75, 0.01
# Root mean square error of level lines, pixels, over traced glyphs and icons whose outlines are
# known; of such straight ones. Noise has no bound as other errors of pictures have: it is allowed
# four deviations, those three (TRC-20).
LEVEL_ACCURACY, SOFT_ACCURACY, UNBOUNDED = 0.07, 0.04, 4 / 3
# In more noise than this, of the contrast, ink tells no corner from a rounding (TRC-20); where
# outlines are averaged in more than this (TRC-44).
NOISIEST_CORNER, NOISIEST_AVERAGED = 0.065, 0.13
# Where more than this part of the outermost pixels are off the usual ground and ink by these parts
# of the contrast, edges have ripples beside them, as JPEG lets them: those that a renderer draws
# have not (TRC-37).
RIPPLED, LEAST_RIPPLE, LARGEST_RIPPLE = 0.035, 0.001, 0.03
# Few greys are multiples of an equal step, at most so many of it, but for a rounding; this part of
# the greys has to be such, and this part of the multiples has to be seen. Edges scatter by so many
# square roots of the step (TRC-39).
MOST_STEPS, ROUNDED, ARE_STEPS, SEEN, SCATTER = 25, 0.004, 0.95, 0.75, 0.16
# With a larger step they do so by more than what is drawn exactly is told by (TRC-39).
COARSE = 0.1


class Softness(NamedTuple):
    """Standard deviations in pixels: of the blur, and of how noise scatters a level line.

    Both are 0 where the grey does not tell. ``rippled`` are sharp edges with ripples beside them.
    ``step`` is what the few greys of sharp edges are multiples of, of the contrast: those edges
    scatter, too. ``resampled`` is a picture taken for one that was turned or scaled by little.
    ``spread`` is the blur, or less than that if it is more than a renderer's.
    """

    blur: float = 0.0
    scatter: float = 0.0
    rippled: bool = False
    step: float = 0.0
    resampled: bool = False
    spread: float = 0.0

    @classmethod
    def of(cls, field: Field, found: Crossings, inks: FloatArray) -> Softness:
        """Of a picture, told by its edges; ``inks`` are what the ink of each is worth."""
        index = np.flatnonzero(~found.at_rim(*field.shape))
        index = index[:: len(index) // ENOUGH + 1]
        part, ink = found.chosen(index), inks[index]
        before, behind = (
            field.coverage(
                part.row + np.where(part.upright, 0, side),
                part.column + np.where(part.upright, side, 0),
            )
            for side in (-1, 1)
        )
        profiles = profiles_across(field, part) / ink[:, None]
        soft = cls.told(profiles, (behind - before) / ink, field.noise, field.step)
        # What interpolation takes beyond ground and ink is cut off at black and white (TRC-38).
        return soft._replace(rippled=soft.rippled or field.interpolated)

    @classmethod
    def told(
        cls, profiles: FloatArray, beside: FloatArray, noise: float, step: float = 0.0
    ) -> Softness:
        """Of a picture, told by the grey across its edges.

        Parameters
        ----------
        profiles : ndarray, shape (n, 2 REACH)
            From ground to ink, the edge in the middle.
        beside : ndarray, shape (n,)
            By how much the pixel of the ground differs between its two neighbours along the edge.
        noise : float
            Of the contrast.
        step : float
            That greys are known to have at least.
        """
        spread = _blur(profiles, beside, noise)
        if spread is None:
            step = max(_step(profiles), step)
            return cls(0.0, SCATTER * step**0.5, _is_rippled(profiles), step)
        blur = spread if spread >= LEAST_BLUR else 0.0
        step = 0.0 if blur else max(_step(profiles), step)
        rippled = not blur and _is_rippled(profiles)
        scatter = max(cls(blur).scattered_by(noise), SCATTER * step**0.5)
        spread = spread if spread >= LEAST_SPREAD else 0.0
        return cls(blur, scatter, rippled, step, spread=spread)

    def scattered_by(self, noise: float) -> float:
        """How noise of the contrast scatters a level line: over the slope of an edge, pixels."""
        slope = 1.0 / np.sqrt(2 * np.pi * (self.blur**2 + WITHIN_PIXEL))
        return noise * float(np.sqrt(BETWEEN_PIXELS) / slope)

    @property
    def on_level(self) -> bool:
        """Whether level lines tell more than what is summed across edges."""
        return self.blur >= SOFT or self.grainy

    @property
    def grainy(self) -> bool:
        """Whether noise scatters level lines by so much that they are averaged."""
        return self.blur > 0 and self.scatter >= SCATTERED

    @property
    def accuracy(self) -> float:
        """Of level lines, pixels."""
        # Averaged ones are nearer, but what is left goes on along them (TRC-44).
        scatter = self.scatter if self.grainy else UNBOUNDED * self.scatter
        return max(SOFT_ACCURACY if self.on_level else LEVEL_ACCURACY, scatter)

    @property
    def coarseness(self) -> float:
        """How far edges lie from where few greys put them, pixels; 0 where greys tell enough."""
        return SCATTER * self.step**0.5 if self.step > COARSE else 0.0

    def shows_corners(self, noise: float) -> bool:
        """Whether corners of level lines are told from roundings, in noise of the contrast."""
        left = self.on_level or noise > NOISIEST
        noisiest = NOISIEST_AVERAGED if self.grainy else NOISIEST_CORNER
        return left and self.scatter > 0 and noise <= noisiest


# Edges as a renderer draws them.
SHARP = Softness()


def _is_rippled(profiles: FloatArray) -> bool:
    """Whether ground and ink, where they are bare, are not quite even."""
    if not len(profiles):
        return False
    ground, ink = profiles[:, :2], profiles[:, -2:]
    off = np.abs(np.concatenate([ground - np.median(ground), ink - np.median(ink)], axis=1))
    bare, slightly = off <= LARGEST_RIPPLE, off > LEAST_RIPPLE
    return bool(bare.sum() > PLAIN * bare.size and (bare & slightly).sum() > RIPPLED * bare.size)


def _step(profiles: FloatArray) -> float:
    """What greys are multiples of, of the contrast; 0 where they are many."""
    if not len(profiles):
        return 0.0
    ground, ink = np.median(profiles[:, :2]), np.median(profiles[:, -2:])
    if ink <= ground:
        return 0.0
    between = ((profiles - ground) / (ink - ground)).ravel()
    grey = between[np.abs(between - 0.5) < 0.5 - 2 * ROUNDED]
    if not len(grey):
        return 0.0
    for count in range(3, MOST_STEPS + 1):
        nearest = np.rint(grey * count)
        if (np.abs(grey - nearest / count) <= ROUNDED).mean() >= ARE_STEPS:
            seen = np.unique(nearest[(nearest > 0) & (nearest < count)])
            return 1.0 / count if len(seen) >= SEEN * (count - 1) else 0.0
    return 0.0


def _blur(profiles: FloatArray, beside: FloatArray, noise: float) -> float | None:
    """As edges tell it; None where too few are plain."""
    even = EVEN + EVEN_NOISE * noise
    off = np.concatenate([profiles[:, :2], profiles[:, -2:] - 1.0], axis=1)
    plain = (np.abs(off) <= even).all(axis=1)
    steps = np.diff(profiles, axis=1)
    plain &= (steps >= -FALLS - FALLS_NOISE * noise).all(axis=1)
    across, along = steps[:, REACH - 1], 0.5 * beside
    with np.errstate(divide="ignore", invalid="ignore"):
        share = across**2 / (across**2 + along**2)  # cos^2 a
    plain &= share >= LEAST_ACROSS
    if not plain.sum() > PLAIN * len(plain):
        return None
    steps, share = steps[plain], share[plain]
    at = np.arange(steps.shape[1])
    total = steps.sum(axis=1)
    middle = steps @ at / total
    variance = (steps @ at**2 / total - middle**2 - WITHIN_PIXEL) * share - WITHIN_PIXEL
    return float(np.sqrt(max(np.median(variance), 0.0)))
