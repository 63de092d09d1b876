"""Specks: outlines that the noise of a picture makes, told from small things that were drawn.

What was drawn stands out: a dot of two by two pixels has the full contrast to its ground. What
noise makes is at most a few of its deviations beyond the level, whatever its size. Texture (scales,
grass, grain of paper) stands out as well, but has no least size: where outlines of less than a
pixel crowd, larger ones belong to them, the fewer the larger they are.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray, IntArray

# An outline is a speck if no pixel along it is farther beyond the level than this part of the
# contrast, what an edge leaves of itself in one pixel, and this many deviations of the noise
# (TRC-17).
FAINT, DEVIATIONS = 0.05, 5.0
# Larger ones are no specks, however faint: at most this part of the picture, within these bounds.
LARGEST_PART, LARGEST = 0.0005, (8.0, 400.0)
# Outlines of less than so many square pixels are dust, and texture if there are so many of them.
# Within so many pixels of n more of them there are about 4 n / a of any area larger than a: one is
# texture if that is at least 1, and the middle of the dust no farther than this part of them, which
# at the border of texture is 0.42. Where the noise is less than this, what is there was drawn
# (TRC-11).
DUST, LEAST_DUST, NEARBY, DUST_PART, AMONG, CLEAN = 1.0, 12, 48.0, 4.0, 0.5, 0.005
# More dust is no picture of something; and outlines whose neighbours are listed at once.
MOST_DUST, CHUNK = 50_000, 1000


def loop_areas(places: FloatArray, loops: Sequence[IntArray]) -> FloatArray:
    """Signed areas of outlines, square pixels."""
    if not loops:
        return np.empty(0)
    order = np.concatenate(loops)
    starts = np.concatenate([[0], np.cumsum([len(loop) for loop in loops])[:-1]])
    ahead = np.concatenate([np.append(loop[1:], loop[0]) for loop in loops])
    a, b = places[order], places[ahead]
    return 0.5 * np.add.reduceat(a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1], starts)


def is_speck(field: Field, found: Crossings, places: FloatArray, areas: FloatArray) -> BoolArray:
    """Which outlines are no more than noise or texture.

    Parameters
    ----------
    field : Field
    found : Crossings
    places : ndarray, shape (n, 2)
        Of the crossings.
    areas : ndarray
        Of its loops, signed: negative around ground.
    """
    noise = _is_noise(field, found, areas)
    if field.noise < CLEAN:
        return noise
    noise[~noise] = _is_texture(
        np.array([places[found.loops[k]].mean(axis=0) for k in np.flatnonzero(~noise)]).reshape(
            -1, 2
        ),
        np.abs(areas[~noise]),
    )
    return noise


def _is_texture(centres: FloatArray, sizes: FloatArray) -> BoolArray:
    """Which outlines are as large as chance makes some among so much dust around them."""
    dust = sizes < DUST
    if not LEAST_DUST <= dust.sum() <= MOST_DUST:
        return np.zeros(len(sizes), dtype=bool)
    from scipy.spatial import cKDTree

    grains = centres[dust]
    tree = cKDTree(grains)
    count, aside = np.zeros(len(centres)), np.full(len(centres), np.inf)
    for begin in range(0, len(centres), CHUNK):  # lists of neighbours are long
        near = tree.query_ball_point(centres[begin : begin + CHUNK], NEARBY)
        for index, found in enumerate(near, start=begin):
            if found:
                count[index] = len(found)
                aside[index] = np.hypot(*(grains[found].mean(axis=0) - centres[index]))
    return dust | ((sizes <= DUST_PART * (count - 1)) & (aside < AMONG * NEARBY))


def _is_noise(field: Field, found: Crossings, areas: FloatArray) -> BoolArray:
    """Which outlines are nowhere far enough beyond the level."""
    first, second = found.excesses(field)
    highest, lowest = np.maximum(first, second), np.minimum(first, second)
    if field.noise < CLEAN:  # pixels that an edge halves lie on the level, and those behind tell
        down, right = np.where(found.upright, 1, 0), np.where(found.upright, 0, 1)
        before = field.coverage(found.row - down, found.column - right) - 0.5
        after = field.coverage(found.row + 2 * down, found.column + 2 * right) - 0.5
        highest = np.maximum(highest, np.where(found.ink_first, before, after))
        lowest = np.minimum(lowest, np.where(found.ink_first, after, before))
    order = np.concatenate(found.loops)
    starts = np.concatenate([[0], np.cumsum([len(loop) for loop in found.loops])[:-1]])
    ink = np.maximum.reduceat(highest[order], starts)
    ground = -np.minimum.reduceat(lowest[order], starts)
    depth = np.where(areas > 0, ink, ground)
    largest = np.clip(LARGEST_PART * field.values.size, *LARGEST)
    faint = depth < FAINT + DEVIATIONS * field.noise
    return faint & (np.abs(areas) < largest)
