"""Specks: outlines that the noise of a picture makes, told from small things that were drawn.

What was drawn stands out: a dot of two by two pixels has the full contrast to its ground. What
noise makes is at most a few of its deviations beyond the level, whatever its size.
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
# contrast, what an edge leaves of itself in one pixel, and this many deviations of the noise.
FAINT, DEVIATIONS = 0.05, 5.0
# Larger ones are no specks, however faint: at most this part of the picture, within these bounds.
LARGEST_PART, LARGEST = 0.0005, (8.0, 400.0)


def loop_areas(places: FloatArray, loops: Sequence[IntArray]) -> FloatArray:
    """Signed areas of outlines, square pixels."""
    if not loops:
        return np.empty(0)
    order = np.concatenate(loops)
    starts = np.concatenate([[0], np.cumsum([len(loop) for loop in loops])[:-1]])
    ahead = np.concatenate([np.append(loop[1:], loop[0]) for loop in loops])
    a, b = places[order], places[ahead]
    return 0.5 * np.add.reduceat(a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1], starts)


def is_speck(field: Field, found: Crossings, areas: FloatArray) -> BoolArray:
    """Which outlines are no more than noise.

    Parameters
    ----------
    field : Field
    found : Crossings
    areas : ndarray
        Of its loops, signed: negative around ground.
    """
    first, second = found.excesses(field)
    order = np.concatenate(found.loops)
    starts = np.concatenate([[0], np.cumsum([len(loop) for loop in found.loops])[:-1]])
    ink = np.maximum.reduceat(np.maximum(first, second)[order], starts)
    ground = -np.minimum.reduceat(np.minimum(first, second)[order], starts)
    depth = np.where(areas > 0, ink, ground)
    largest = np.clip(LARGEST_PART * field.values.size, *LARGEST)
    faint = depth < FAINT + DEVIATIONS * field.noise
    return faint & (np.abs(areas) < largest)
