"""Edges of colours that JPEG smeared: it keeps colours of every other pixel, lightness of each.

So the colours of an edge reach farther than its lightness, and what lies on it is no mixture of
those of its two sides (chroma subsampling).
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from shapespline.tracing.pixels import LUMA

if TYPE_CHECKING:
    from shapespline.typing import BoolArray, FloatArray

# Lightness, and how far blue and red are from it, as JFIF has them (ITU-T T.871, section 7).
_Y, (_RED, _, _BLUE) = np.array(LUMA), np.eye(3)
TO_YCC = np.column_stack([_Y, 0.5 * (_BLUE - _Y) / (1 - _Y[2]), 0.5 * (_RED - _Y) / (1 - _Y[0])])


def are_smeared(
    values: FloatArray, around: BoolArray, colors: FloatArray, most: float
) -> BoolArray:
    """Which values lie between two colours in lightness, and between them in colour elsewhere.

    Parameters
    ----------
    values : ndarray, shape (n, 3)
        Red, green and blue, 0 to 255.
    around : ndarray of bool, shape (n, k)
        Which colours each may lie between.
    colors : ndarray, shape (k, 3)
    most : float
        How far from there they may be.

    Examples
    --------
    >>> red_and_white = np.array([(230.0, 60, 40), (255, 255, 255)])
    >>> edge, stroke = (196.0, 104.0, 92.0), (20.0, 30.0, 20.0)
    >>> are_smeared(np.array([edge, stroke]), np.ones((2, 2), bool), red_and_white, 20.0).tolist()
    [True, False]
    """
    found = np.zeros(len(values), dtype=bool)
    seen, known = values @ TO_YCC, colors @ TO_YCC
    for a, b in combinations(range(len(colors)), 2):
        own = np.flatnonzero(around[:, a] & around[:, b])
        light, tint = seen[own, 0], seen[own, 1:] - known[a, 1:]
        low, high = sorted((known[a, 0], known[b, 0]))
        beyond = np.maximum(np.maximum(low - light, light - high), 0.0)
        along = known[b, 1:] - known[a, 1:]
        share = np.clip(tint @ along / max(along @ along, 1.0), 0.0, 1.0)
        off = np.hypot(*(tint - share[:, None] * along).T)
        found[own[np.hypot(beyond, off) <= most]] = True
    return found
