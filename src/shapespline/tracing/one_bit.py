"""Outlines in pictures of one bit: steps of a pixel, ragged ones where the bits were grainy greys.

Black and white cut from a scan keep its grain: pixels beside an edge fall to either side of it, and
a column sticks out of a row of steps. Their mean tells the edge better than clean steps do, which
all lie on one side of it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.tracing.corners import put_back
from shapespline.tracing.grain import squarely
from shapespline.tracing.softness import Softness

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapespline.tracing.sides import Corners
    from shapespline.typing import BoolArray, FloatArray

# Root mean square error, pixels, over traced glyphs and icons whose outlines are known.
ONE_BIT_ACCURACY = 0.25
# Part of an outline's points that have to lie between pixels for it to be of one bit; steps of one
# pixel that a drawing of edges along rows and columns has at most.
MOST, FEW_STEPS = 0.5, 4
# Of ragged outlines so many crossings stick out alone; they scatter by so many pixels, and what was
# cut was about as soft as this (TRC-46).
RAGGED, RAGGED_SCATTER, BLUR = 0.01, 0.3, 0.8


def is_one_bit(midway: BoolArray, upright: BoolArray, inner: BoolArray) -> bool:
    """Whether an outline is that of a picture of one bit: steps of a pixel without grey.

    Edges along rows and columns without grey may lie on the lines between pixels. What the rim cuts
    off does not count.
    """
    midway, upright = midway[inner], upright[inner]
    turns = upright != np.roll(upright, 1)
    steps = turns & np.roll(turns, -1) & midway
    return bool(len(midway) and midway.mean() > MOST and steps.sum() >= FEW_STEPS)


def are_ragged(outlines: Iterable[tuple[FloatArray, BoolArray]]) -> bool:
    """Whether outlines of one bit, and which of their crossings lie in columns, are of grain."""
    lone, count = 0, 0
    for points, upright in outlines:
        told = squarely(points, upright)
        lone += _sticking_out(points[told], upright[told])
        count += int(told.sum())
    return lone > RAGGED * count


def _sticking_out(points: FloatArray, upright: BoolArray) -> int:
    """How many crossings are a pixel off both neighbours, one of which has another beside it."""
    height = np.where(upright, points[:, 1], points[:, 0])
    off = {k: height - np.roll(height, k) for k in (-2, -1, 1, 2)}
    alike = np.all([upright == np.roll(upright, k) for k in off], axis=0)
    lone = alike & (np.abs(off[1]) == 1.0) & (off[1] == off[-1])
    return int((lone & ((off[2] == off[1]) | (off[-2] == off[-1]))).sum())


def with_corners_of_bits(
    outlines: Sequence[FloatArray], level_lines: Sequence[FloatArray], ragged: Sequence[bool]
) -> list[FloatArray]:
    """Ragged outlines with corners where their sides meet: bits prove none."""

    def fit(corners: Corners, _tried: Sequence[FloatArray], _soft: Softness) -> BoolArray:
        return np.ones(len(corners.own), dtype=bool)

    closed, soft = [True] * len(outlines), Softness(BLUR, RAGGED_SCATTER)
    return put_back(outlines, level_lines, ragged, closed, fit, soft)
