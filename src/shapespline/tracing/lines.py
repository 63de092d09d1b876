"""Outlines of a Field: put where the grey tells, or left on the level line."""

from __future__ import annotations

from itertools import compress, pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.monitor import silent
from shapespline.tracing.arc_pixels import ArcPixels
from shapespline.tracing.corners import sharpened
from shapespline.tracing.dots import dotted
from shapespline.tracing.edges import NOISIEST, drawn_shares, level_shares, no_edges
from shapespline.tracing.ends import squared
from shapespline.tracing.grain import LEAST_ACROSS, squareness, without_grain
from shapespline.tracing.inks import inks_of, moved_to_own
from shapespline.tracing.one_bit import (
    ONE_BIT_ACCURACY,
    RAGGED_SCATTER,
    are_ragged,
    is_one_bit,
    with_corners_of_bits,
)
from shapespline.tracing.roundings import rounded
from shapespline.tracing.softness import Softness

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.monitor import Say
    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray

# Two points closer than this (pixels) surround one pixel centre: one is enough.
SAME_POINT = 1e-3
# Outlines of fewer points keep all crossings.
FEW_POINTS = 12
# Crossings on either side between which an edge has its direction.
CHORD = 2
# Pixels, root mean square over traced glyphs and icons whose outlines are known, where the grey
# tells the edge.
DRAWN_ACCURACY = 0.02
# Part of an outline's points of which the grey has to tell the place for it to do so.
MOST = 0.5


class Line(NamedTuple):
    """An outline as it was drawn, its level line, and how accurate it is."""

    points: FloatArray
    level_line: FloatArray
    accuracy: float


def drawn_lines(
    field: Field, found: Crossings, places: FloatArray, kept: BoolArray, say: Say = silent
) -> list[Line]:
    """Outlines as they were drawn."""
    height, width = field.shape
    loops = [found.loops[index] for index in np.flatnonzero(kept)]
    used = np.concatenate(loops)
    part = found.chosen(used)
    say(f"placing {len(used)} points of edges")
    lengths = [len(loop) for loop in loops]
    inks = inks_of(field, part, lengths)
    ink_of_each = np.repeat(inks, lengths)
    soft = Softness.of(field, part, ink_of_each)
    shares = level_shares(field, part)
    if soft.on_level:
        edges = no_edges(moved_to_own(field, part, shares, ink_of_each))
    else:
        edges = drawn_shares(field, part, shares)
    places_drawn = part.places(height, edges.shares)
    # What ends at the rim is an edge like others, what is cut off there ends with it.
    at_rim = part.at_rim(height, width) & ~edges.known
    midway = np.abs(shares - 0.5) < 1e-9
    # Edges that blur or noise alone leave on the level line have corners, too (TRC-20).
    on_level_too = soft.shows_corners(field.noise)
    drawn = max(DRAWN_ACCURACY, soft.coarseness)
    each = _slices(lengths)
    of_bits = [is_one_bit(midway[own], part.upright[own], ~at_rim[own]) for own in each]
    ragged = are_ragged((places_drawn[own], part.upright[own]) for own in compress(each, of_bits))
    outlines, level_lines, accuracies, cornered = [], [], [], []
    for loop, own, ink, one_bit in zip(loops, each, inks.tolist(), of_bits, strict=True):
        upright, inner = part.upright[own], ~at_rim[own]
        across = squareness(places[loop], upright, CHORD)
        level_line = distinct(_with_rim_corners(places[loop], height, width))
        # Without an inner crossing it is the rim alone.
        known = not inner.any() or _is_known(edges.known[own][inner], across[inner])
        accuracy = drawn if known else soft.accuracy
        if one_bit:
            accuracy = ONE_BIT_ACCURACY
        points = places_drawn[own]
        if ragged if one_bit else soft.grainy:
            scatter = RAGGED_SCATTER if one_bit else soft.scatter / ink
            points = without_grain(points, upright, scatter, ~inner)
        elif len(loop) >= FEW_POINTS and (accuracy == drawn or (soft.on_level and ink != 1.0)):
            told = (across >= LEAST_ACROSS) | ~inner
            points = _bent(points[told], upright[told], edges.known[own][told])
        points = np.clip(points, 0, (width, height))
        points = distinct(_with_rim_corners(points, height, width))
        outlines.append(points if len(points) >= 3 else level_line)
        level_lines.append(level_line)
        accuracies.append(accuracy)
        cornered.append(not one_bit and (known or on_level_too))
    say(f"looking for the corners of {len(outlines)} outlines")
    outlines = sharpened(outlines, level_lines, cornered, field, soft, inks)
    if ragged:
        outlines = with_corners_of_bits(outlines, level_lines, of_bits)
    pixels = ArcPixels.of(outlines, cornered, field, inks, soft)
    if pixels is not None:
        outlines = rounded(outlines, cornered, pixels, inks)
        outlines = squared(outlines, cornered, pixels, inks)
    if not soft.blur and field.noise <= NOISIEST:
        outlines, dots = dotted(outlines, level_lines, field, inks)
        accuracies = np.where(dots, DRAWN_ACCURACY, accuracies).tolist()
    outlines = [np.clip(points, 0, (width, height)) for points in outlines]
    return [Line(*line) for line in zip(outlines, level_lines, accuracies, strict=True)]


def _slices(lengths: Sequence[int]) -> list[slice]:
    """Where each of some rows lies if they come one after the other."""
    ends = np.cumsum([0, *lengths]).tolist()
    return [slice(first, last) for first, last in pairwise(ends)]


def _bent(points: FloatArray, upright: BoolArray, known: BoolArray) -> FloatArray:
    """Points of an outline moved from the mean over their column or row to its middle.

    Over a unit, a curve f is f'' / 24 higher in the mean than in the middle.
    """
    before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
    moved = points.copy()
    for axis, own in ((1, upright), (0, ~upright)):
        across = 1 - axis
        even = np.abs(before[:, across] - points[:, across]) == 1.0
        even &= before[:, across] + after[:, across] == 2 * points[:, across]
        use = known & own & even & np.roll(own, 1) & np.roll(own, -1)
        second = (before + after - 2 * points)[use, axis]
        moved[use, axis] -= np.clip(second, -0.5, 0.5) / 24
    return moved


def _is_known(known: BoolArray, across: FloatArray) -> bool:
    """Whether the grey tells where most of an outline lies."""
    told = across >= LEAST_ACROSS
    return bool(told.any() and known[told].mean() > MOST)


def _with_rim_corners(points: FloatArray, height: int, width: int) -> FloatArray:
    """An outline that goes round a corner of the picture, through that corner."""
    ahead = np.roll(points, -1, axis=0)
    size = np.array([width, height])
    at_side = (points == 0) | (points == size)
    next_at_side = np.roll(at_side, -1, axis=0)
    turns = (at_side[:, 0] & next_at_side[:, 1]) | (at_side[:, 1] & next_at_side[:, 0])
    turns &= np.abs(ahead - points).max(axis=1) < 1.0
    where = np.flatnonzero(turns)
    if len(where) == 0:
        return points
    corner = np.where(points[where] + ahead[where] < size, 0, size)
    return np.insert(points, where + 1, corner, axis=0)


def distinct(points: FloatArray) -> FloatArray:
    """Points of a closed outline without those that all but equal the one before them."""
    steps = points - np.roll(points, 1, axis=0)
    return points[np.hypot(steps[:, 0], steps[:, 1]) > SAME_POINT]
