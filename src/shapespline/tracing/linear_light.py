"""Pictures that were blended in linear light: greys as shares of light, not of values.

Values of a picture are a power of the light that they stand for, about the 1/2.2th (IEC 61966-2-1).
Most programs mix ink and ground by their values; some mix the light of both and store its power:
renderers of scenes, graphics cards that are told to, pictures made smaller the careful way, many
letters on screens. Half of a pixel is then no half-way grey, and every edge lies up to 0.2 pixels
beside its place, to and fro along it with the part of the pixels that it covers. The power that
takes these waves away is the one that was taken.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.tracing.edges import EVEN, REACH, places_across, profiles_across
from shapespline.tracing.inks import softness_of
from shapespline.tracing.layer import Layer
from shapespline.tracing.level import with_values

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.typing import FloatArray, IntArray

# Powers that are in use (TRC-40).
POWERS = (1.8, 2.2)
# Root mean square of the third differences of the places of an edge, pixels, from which on it
# waves; what a power leaves of it if it was taken; how many of them tell (TRC-40).
WAVY, LEFT, ENOUGH = 0.07, 0.45, 25
# Larger ones are those of corners, smaller ones those of level edges, which tell nothing (TRC-40).
CORNER, LEVEL = 0.5, 0.004
# Crossings that are looked at (TRC-40).
MOST = 20_000


def in_linear_light(field: Field, found: Crossings, full: float) -> Field | None:
    """The light of a picture, where edges are straighter in it; None where they are not.

    Parameters
    ----------
    field : Field
    found : Crossings
    full : float
        Value of white.
    """
    lowest, highest = field.values.range
    if lowest < 0.0 or highest > full:
        return None
    part, fours = _runs(found)
    if len(fours) < ENOUGH:
        return None
    bends = _bends(field, part, fours)
    telling = (np.abs(bends) < CORNER) & (np.abs(bends) > LEVEL)
    if telling.sum() < ENOUGH or _size(bends[telling]) < WAVY:
        return None
    if softness_of(field, found).rippled:  # which wave, too
        return None
    ways = []
    for power in POWERS:
        other = _decoded(field, full, power)
        others = _bends(other, part, fours)
        both = telling & (np.abs(others) < CORNER)
        if both.sum() >= ENOUGH:
            ways.append((_size(others[both]) / _size(bends[both]), power))
    left, power = min(ways, default=(1.0, 1.0))
    if left > LEFT:
        return None
    light = _decoded(field, full, power)
    return with_values(light, light.values)


def _decoded(field: Field, full: float, power: float) -> Field:
    """The light that the values of a picture stand for."""

    def light(values: NDArray[Any]) -> FloatArray:
        return full * np.asarray(values / full, dtype=np.float64) ** power

    half = 0.5 * field.contrast * (1 if field.light else -1)
    ground, ink = (float(light(np.array(field.middle + side))) for side in (-half, half))
    middle = 0.5 * (ground + ink)
    values = Layer(field.values, light)
    return replace(field, values=values, cut=middle, middle=middle, contrast=abs(ink - ground))


def _runs(found: Crossings) -> tuple[Crossings, IntArray]:
    """Crossings in order, and the first of each four beside each other that cross the same way."""
    order = np.concatenate(found.loops)[:MOST]
    part = found.chosen(order)
    along = np.where(part.upright, part.column, part.row)
    base = np.where(part.upright, part.row, part.column)
    steps = np.diff(along)
    alike = (part.upright[1:] == part.upright[:-1]) & (part.ink_first[1:] == part.ink_first[:-1])
    alike &= (np.abs(np.diff(base)) <= 1) & (np.abs(steps) == 1)
    on = alike[:-1] & alike[1:] & (steps[1:] == steps[:-1])
    return part, np.flatnonzero(on[:-1] & on[1:])


def _bends(field: Field, part: Crossings, fours: IntArray) -> FloatArray:
    """Third differences of the places where the grey puts an edge; infinite where it puts none."""
    places = places_across(profiles_across(field, part), EVEN, pure=True)
    base = np.where(part.upright, part.row, part.column)
    places = base + np.where(part.ink_first, REACH - places, places - REACH)
    bends = np.diff(places, n=3)[fours]
    return np.where(np.isnan(bends), np.inf, bends)


def _size(bends: FloatArray) -> float:
    """Root mean square."""
    return float(np.sqrt((bends**2).mean()))
