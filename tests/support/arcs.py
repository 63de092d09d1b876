"""Arcs from their definition."""

from __future__ import annotations

import math

import numpy as np


def on_segment(begin, end, bulge, n):
    """Points of an arc from its definition: the circle through both ends, angle 4 atan(bulge)."""
    t = np.linspace(0, 1, n)[:, None]
    if bulge == 0:
        return begin + t * (end - begin)
    turn = 4 * math.atan(bulge)
    middle = 0.5 * (begin + end)
    chord = end - begin
    centre = middle + np.array([-chord[1], chord[0]]) / (2 * math.tan(turn / 2))
    a = (turn * t).ravel()
    return centre + np.column_stack(
        [
            np.cos(a) * (begin - centre)[0] - np.sin(a) * (begin - centre)[1],
            np.sin(a) * (begin - centre)[0] + np.cos(a) * (begin - centre)[1],
        ]
    )
