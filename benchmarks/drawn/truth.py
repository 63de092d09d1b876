"""Drawings whose truth is known: outlines of lines, circular arcs and cubics, in data units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

# Pixels from the sides at which a drawing that fills its picture begins, but for rounding there,
# and ends.
BEGINS, ENDS_BEFORE = 1e-6, 0.3


@dataclass(frozen=True, eq=False)
class Line:
    """From a point to another."""

    begin: Array
    end: Array

    def points(self, step: float) -> Array:
        """Points on it, without its last."""
        n = max(1, int(np.ceil(np.hypot(*(self.end - self.begin)) / step)))
        return self.begin + np.arange(n)[:, None] / n * (self.end - self.begin)

    def moved(self, scale: float, angle: float, shift: Array) -> Line:
        """Turned, scaled and shifted."""
        a, b = _moved(np.stack([self.begin, self.end]), scale, angle, shift)
        return Line(a, b)


@dataclass(frozen=True, eq=False)
class Arc:
    """Part of a circle: from an angle on by a sweep, counter-clockwise if positive."""

    centre: Array
    radius: float
    start: float
    sweep: float

    def at(self, angle: Array | float) -> Array:
        """Points at angles."""
        return self.centre + self.radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    @property
    def begin(self) -> Array:
        """First point."""
        return self.at(self.start)

    @property
    def end(self) -> Array:
        """Last point."""
        return self.at(self.start + self.sweep)

    def points(self, step: float) -> Array:
        """Points on it, without its last."""
        n = max(4, int(np.ceil(abs(self.sweep) * self.radius / step)))
        return self.at(self.start + self.sweep * np.arange(n) / n)

    def moved(self, scale: float, angle: float, shift: Array) -> Arc:
        """Turned, scaled and shifted."""
        centre = _moved(self.centre[None], scale, angle, shift)[0]
        return Arc(centre, self.radius * scale, self.start + angle, self.sweep)


@dataclass(frozen=True, eq=False)
class Cubic:
    """A Bezier of four control points."""

    control: Array

    @property
    def begin(self) -> Array:
        """First point."""
        return self.control[0]

    @property
    def end(self) -> Array:
        """Last point."""
        return self.control[3]

    def points(self, step: float) -> Array:
        """Points on it, without its last."""
        n = max(8, int(np.ceil(np.hypot(*np.diff(self.control, axis=0).T).sum() / step)))
        t = (np.arange(n) / n)[:, None]
        p, q, r, s = self.control
        return (1 - t) ** 3 * p + 3 * (1 - t) ** 2 * t * q + 3 * (1 - t) * t**2 * r + t**3 * s

    def moved(self, scale: float, angle: float, shift: Array) -> Cubic:
        """Turned, scaled and shifted."""
        return Cubic(_moved(self.control, scale, angle, shift))


Element = Line | Arc | Cubic
Outline = tuple[Element, ...]


def _moved(points: Array, scale: float, angle: float, shift: Array) -> Array:
    c, s = scale * np.cos(angle), scale * np.sin(angle)
    return points @ np.array([[c, s], [-s, c]]) + shift


def sampled(outline: Sequence[Element], step: float) -> Array:
    """Points of a closed outline, each once."""
    return np.concatenate([element.points(step) for element in outline])


def placed(outlines: Sequence[Outline], size: int, turn: float, seed: int) -> list[Outline]:
    """Outlines in the middle of a square picture, off the grid of its pixels."""
    shift = np.zeros(2)
    turned = [[e.moved(1.0, np.radians(turn), shift) for e in outline] for outline in outlines]
    points = np.concatenate([sampled(outline, 0.01) for outline in turned])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = 0.84 * size / float((high - low).max())
    random = np.random.default_rng(seed)
    shift = 0.5 * size - scale * 0.5 * (low + high) + random.uniform(-0.5, 0.5, 2)
    return [tuple(e.moved(scale, 0.0, shift) for e in outline) for outline in turned]


def filling(outlines: Sequence[Outline], size: int) -> list[Outline]:
    """Outlines as large as a square picture, as cut to the ink, in the middle the other way.

    They touch its left or lower side, and end in a pixel of the opposite one.
    """
    points = np.concatenate([sampled(outline, 0.01) for outline in outlines])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = (size - BEGINS - ENDS_BEFORE) / float((high - low).max())
    middle = 0.5 * (size - scale * (high - low))
    shift = np.where(high - low == (high - low).max(), BEGINS, middle) - scale * low
    return [tuple(e.moved(scale, 0.0, shift) for e in outline) for outline in outlines]


def turn_of(before: Element, after: Element) -> float:
    """Degrees between an element and the next."""
    a, b = _direction(before, end=True), _direction(after, end=False)
    return float(np.degrees(np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b)))


def _direction(element: Element, *, end: bool) -> Array:
    if isinstance(element, Line):
        return element.end - element.begin
    if isinstance(element, Arc):
        angle = element.start + (element.sweep if end else 0.0)
        return np.array([-np.sin(angle), np.cos(angle)]) * np.sign(element.sweep)
    legs = np.diff(element.control, axis=0)
    legs = legs[np.hypot(*legs.T) > 1e-9]
    return legs[-1] if end else legs[0]
