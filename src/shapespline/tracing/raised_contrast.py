"""Pictures whose contrast was raised, or that were sharpened: the parts of pixels that are ink.

A pixel that an edge passes through is grey by the part of it that is ink. Where light was made
lighter and dark darker, as scanners do, programs for photographs and every advice on tracing, small
parts are none and large ones all: edges are steps, and an outline is off to and fro. But the steps
of many crossings beside each other tell where an edge leads, and so what it covers of its pixels.
A grey stands for the part that such pixels are covered of in the mean, whatever curve was taken;
the two ends of that curve are taken for alike. Pixels that were cut off hold what the edge covers.
Each tells the other, round by round.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.tracing.edges import EVEN, drawn_shares, level_shares
from shapespline.tracing.inks import softness_of
from shapespline.tracing.layer import Layer, strips
from shapespline.tracing.level import with_values
from shapespline.tracing.parabolas import Parabolas

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray, IntArray

# Crossings before and behind one through which an edge is laid, a parabola; outlines of fewer than
# so many times as many are too small (TRC-42).
BESIDE, LEAST_LOOP = 5, 4
# Slopes to their row or column of edges that tell a curve: level ones and such at 45 degrees cover
# all of their pixels alike (TRC-42).
TELLING = (0.05, 0.92)
# What ripples of JPEG leave ground and ink within, of the contrast (TRC-42).
RIPPLES = 0.05
# Grey pixels that tell a curve at least, of at most so many crossings that are looked at; means of
# so many parts of them, dark and light alike (TRC-42).
ENOUGH, MOST, MEANS = 20, 20_000, 6
# By how much more of their pixels edges cover, in the mean over greys of less than this, where
# contrast was raised; so much less, over those up to a half, where edges are laid badly (TRC-42).
SMALL, RAISED = 0.2, 0.04
# How far crossings may lie off the edge through them, root mean square in pixels, round by round;
# in the first one (TRC-42).
STRAIGHT, ROUNDS = 0.3, (0.3, 0.2, 0.15, 0.12)
# What stays unknown of edges that are level, as a step of greys would leave it: a part of what was
# cut off (TRC-42).
UNTOLD = 0.6
# Crossings that are looked at together.
CHUNK = 50_000


def as_parts(field: Field, found: Crossings) -> Field | None:
    """The picture with the parts of its pixels that are ink; None where greys are these."""
    outlines = _Outlines.of(found)
    height = field.shape[0]
    level = found.places(height, level_shares(field, found))
    few = outlines.every(len(outlines.order) // MOST + 1)
    tone = _Tone.of(field, _Border.along(field, found, few, level, STRAIGHT), EVEN)
    if tone is None:
        return None
    even = RIPPLES if softness_of(field, found).rippled else EVEN
    greys = np.empty(field.shape, dtype=np.float32)
    columns = np.arange(field.shape[1])[None, :]
    for rows in strips(field.shape):
        greys[rows] = field.coverage(np.arange(height)[rows, None], columns)
    parts = np.where(greys <= even, 0, np.where(greys >= 1 - even, 1, greys))
    grey = np.flatnonzero((parts > 0) & (parts < 1))
    lower = replace(field, values=Layer(parts), cut=0.5, light=True, contrast=1.0, middle=0.5)
    for straight in ROUNDS:
        shares = drawn_shares(lower, found, level_shares(lower, found)).shares
        border = _Border.along(lower, found, outlines, found.places(height, shares), straight)
        tone = _Tone.of(field, border, even) or tone
        parts.flat[grey] = tone(greys.flat[grey].astype(np.float64))
        _fill(parts, greys, border, tone, even)
    return replace(with_values(lower, Layer(parts)), step=UNTOLD * tone.cut_off)


class _Outlines(NamedTuple):
    """Crossings of outlines that are not too small, in order; where each's begin, and how many."""

    order: IntArray
    first: IntArray
    size: IntArray
    looked_at: IntArray

    @classmethod
    def of(cls, found: Crossings) -> _Outlines:
        """All of a picture."""
        long = [loop for loop in found.loops if len(loop) >= LEAST_LOOP * BESIDE]
        sizes = np.array([len(loop) for loop in long], dtype=np.int64)
        first = np.repeat(np.cumsum(sizes) - sizes, sizes)
        order = np.concatenate([np.zeros(0, dtype=np.int64), *long])
        return cls(order, first, np.repeat(sizes, sizes), np.arange(len(order)))

    def every(self, step: int) -> _Outlines:
        """Looked at only at every so many crossings."""
        return self._replace(looked_at=self.looked_at[::step])

    def chunks(self) -> Iterator[IntArray]:
        """Each crossing that is looked at, with those before and behind it, some at a time."""
        steps = np.arange(-BESIDE, BESIDE + 1)
        for at in np.array_split(self.looked_at, len(self.looked_at) // CHUNK + 1):
            first, size = self.first[at, None], self.size[at, None]
            yield self.order[first + (at[:, None] - first + steps) % size]


class _Border(NamedTuple):
    """Pixels that edges pass through, by row and column; what these cover of them.

    ``telling`` are those of edges that cover theirs by all parts in turn.
    """

    row: IntArray
    column: IntArray
    covered: FloatArray
    telling: BoolArray

    @classmethod
    def along(
        cls,
        field: Field,
        found: Crossings,
        outlines: _Outlines,
        places: FloatArray,
        straight: float,
    ) -> _Border:
        """Of edges through crossings; those that lie farther off theirs than ``straight`` not."""
        height, width = field.shape
        keys, covered, telling = [np.zeros(0, dtype=np.int64)], [np.zeros(0)], [np.zeros(0, bool)]
        for around in outlines.chunks():
            middle = around[:, BESIDE]
            edges = Parabolas.through(places, around, places[middle])
            part = found.chosen(middle)
            tells = _tells(part, edges)
            to_ink = np.where(part.ink_first, 1.0, -1.0)[:, None] * np.where(
                part.upright[:, None], (0.0, 1.0), (-1.0, 0.0)
            )
            ink_left = edges.along[:, 0] * to_ink[:, 1] > edges.along[:, 1] * to_ink[:, 0]
            for second in (False, True):
                row = part.row + (part.upright & second)
                column = part.column + (~part.upright & second)
                left = edges.covered(np.column_stack([column + 0.5, height - row - 0.5]))
                known = (edges.off < straight) & (row >= 0) & (column >= 0)
                known &= (row < height) & (column < width)
                keys.append((row * width + column)[known])
                covered.append(np.where(ink_left, left, 1.0 - left)[known])
                telling.append(tells[known])
        key, place = np.unique(np.concatenate(keys), return_inverse=True)
        count = np.maximum(np.bincount(place, minlength=len(key)), 1)
        mean = np.bincount(place, np.concatenate(covered), len(key)) / count
        told = np.bincount(place, np.concatenate(telling), len(key)) > 0
        return cls(*np.divmod(key, width), mean, told)


class _Tone(NamedTuple):
    """Greys between ground and ink, and the parts of pixels that they stand for."""

    greys: FloatArray
    parts: FloatArray

    @classmethod
    def of(cls, field: Field, border: _Border, even: float) -> _Tone | None:
        """Told by a border; None where greys are the parts, or too few tell."""
        grey = field.coverage(border.row[border.telling], border.column[border.telling])
        covered = border.covered[border.telling]
        between = (grey > even) & (grey < 1.0 - even)
        grey, covered = grey[between], covered[between]
        # Both ends alike: dark as light.
        grey = np.concatenate([grey, 1.0 - grey])
        covered = np.concatenate([covered, 1.0 - covered])
        small, middling = grey < SMALL, (grey >= SMALL) & (grey < 0.5)
        if small.sum() < ENOUGH // 2 or len(grey) < 2 * ENOUGH:
            return None
        more = covered - grey
        if more[small].mean() < RAISED or (middling.any() and more[middling].mean() < -RAISED):
            return None
        order = np.argsort(grey)[: len(grey) // 2]
        means = [(grey[some].mean(), covered[some].mean()) for some in np.array_split(order, MEANS)]
        greys, parts = np.array(means).T
        # Towards ground as between the first two.
        slope = (parts[1] - parts[0]) / max(greys[1] - greys[0], 1e-9)
        cut_off = np.clip(parts[0] - slope * greys[0], 0.0, 0.5)
        greys = np.concatenate([[0.0], greys, 1.0 - greys[::-1], [1.0]])
        parts = np.concatenate([[cut_off], parts, 1.0 - parts[::-1], [1.0 - cut_off]])
        return cls(greys, parts)

    @property
    def cut_off(self) -> float:
        """Smaller parts are none; larger ones than one less it are all."""
        return float(self.parts[0])

    def __call__(self, greys: FloatArray) -> FloatArray:
        """Parts for greys between ground and ink."""
        return np.asarray(np.interp(greys, self.greys, self.parts))


def _tells(part: Crossings, edges: Parabolas) -> BoolArray:
    """Crossings of edges that are neither level nor at 45 degrees."""
    x, y = np.abs(edges.direction).T
    slope = np.where(part.upright, y, x) / np.maximum(np.where(part.upright, x, y), 1e-9)
    return np.asarray((slope > TELLING[0]) & (slope < TELLING[1]))


def _fill(
    parts: NDArray[Any], greys: NDArray[Any], border: _Border, tone: _Tone, even: float
) -> None:
    """Put into pixels that were cut off what the edges through them cover."""
    row, column, covered = border.row, border.column, border.covered
    grey, cut_off = greys[row, column], tone.cut_off
    none, full = grey <= even, grey >= 1.0 - even
    told = np.where(none, np.clip(covered, 0.0, cut_off), np.clip(covered, 1.0 - cut_off, 1.0))
    parts[row, column] = np.where(none | full, told, parts[row, column])
