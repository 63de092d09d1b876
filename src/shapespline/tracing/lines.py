"""Outlines of a Field: put where the grey tells, or left on the level line."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.monitor import silent
from shapespline.tracing.corners import sharpened
from shapespline.tracing.dots import dotted
from shapespline.tracing.edges import NOISIEST, drawn_shares, level_shares, no_edges
from shapespline.tracing.grain import averaged, squarely
from shapespline.tracing.inks import inks_of, moved_to_own
from shapespline.tracing.roundings import rounded
from shapespline.tracing.softness import Softness

if TYPE_CHECKING:
    from shapespline.monitor import Say
    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray

# Two points closer than this (pixels) surround one pixel centre: one is enough.
SAME_POINT = 1e-3
# Where rows pass an edge more squarely than columns, their crossings tell its place, and those of
# the columns only lie between them; nearly at 45 degrees both do. Outlines of few points keep all.
LEAST_ACROSS, FEW_POINTS = 0.65, 12
# Crossings on either side between which an edge has its direction.
CHORD = 2
# Pixels, root mean square over traced glyphs and icons whose outlines are known: where the grey
# tells the edge, and where there is no grey.
DRAWN_ACCURACY, ONE_BIT_ACCURACY = 0.02, 0.25
# Part of an outline's points that have to be of a kind for it to be of that kind; steps of one
# pixel that a drawing of edges along rows and columns has at most.
MOST, FEW_STEPS = 0.5, 4


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
    outlines, level_lines, accuracies, cornered = [], [], [], []
    begin = 0
    for loop, ink in zip(loops, inks.tolist(), strict=True):
        own = slice(begin, begin + len(loop))
        begin += len(loop)
        across = _across(places[loop], part.upright[own])
        level_line = distinct(_with_rim_corners(places[loop], height, width))
        inner = ~at_rim[own]
        upright = part.upright[own]
        # Without an inner crossing it is the rim alone.
        known = not inner.any() or _is_known(edges.known[own][inner], across[inner])
        accuracy = drawn if known else soft.accuracy
        one_bit = _is_one_bit(midway[own][inner], upright[inner])
        if one_bit:
            accuracy = ONE_BIT_ACCURACY
        points = places_drawn[own]
        if soft.grainy and not one_bit:
            told = squarely(points, upright) | ~inner
            points = averaged(points[told], soft.scatter / ink, ~inner[told])
            points = np.clip(points, 0, (width, height))
        elif len(loop) >= FEW_POINTS and (accuracy == drawn or (soft.on_level and ink != 1.0)):
            told = (across >= LEAST_ACROSS) | ~inner
            points = _bent(points[told], part.upright[own][told], edges.known[own][told])
            points = np.clip(points, 0, (width, height))
        points = distinct(_with_rim_corners(points, height, width))
        outlines.append(points if len(points) >= 3 else level_line)
        level_lines.append(level_line)
        accuracies.append(accuracy)
        cornered.append(not one_bit and (known or on_level_too))
    say(f"looking for the corners of {len(outlines)} outlines")
    outlines = sharpened(outlines, level_lines, cornered, field, soft, inks)
    if not soft.blur:
        outlines = rounded(outlines, cornered, field, inks)
        if field.noise <= NOISIEST:
            outlines, dots = dotted(outlines, level_lines, field, inks)
            accuracies = np.where(dots, DRAWN_ACCURACY, accuracies).tolist()
    outlines = [np.clip(points, 0, (width, height)) for points in outlines]
    return [Line(*line) for line in zip(outlines, level_lines, accuracies, strict=True)]


def _across(places: FloatArray, upright: BoolArray) -> FloatArray:
    """How squarely an outline passes the row or column of each crossing, 0 to 1."""
    chords = np.roll(places, -CHORD, axis=0) - np.roll(places, CHORD, axis=0)
    length = np.maximum(np.hypot(chords[:, 0], chords[:, 1]), 1e-12)
    return np.abs(np.where(upright, chords[:, 0], chords[:, 1])) / length


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


def _is_one_bit(midway: BoolArray, upright: BoolArray) -> bool:
    """Whether an outline is that of a picture of one bit: steps of a pixel without grey.

    Edges along rows and columns without grey may lie on the lines between pixels.
    """
    turns = upright != np.roll(upright, 1)
    steps = turns & np.roll(turns, -1) & midway
    return bool(len(midway) and midway.mean() > MOST and steps.sum() >= FEW_STEPS)


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
