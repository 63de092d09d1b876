"""Mixtures of two colours: which two a value may be mixed of, and how much of each."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import BoolArray, FloatArray, IntArray

# A value farther than this (root mean square over the channels, of 255) from each mixture of two
# colours is none.
MIXED = 20.0
# Of the way to an ink this part at least leads aside from the way to another ground (TRC-35).
ASIDE = 0.3


def nearest_color(values: FloatArray, colors: FloatArray) -> IntArray:
    """Index of the nearest colour of each value."""
    channels = np.ascontiguousarray(values.T)  # one after the other is twice as fast
    best = np.full(len(values), np.inf)
    index = np.zeros(len(values), dtype=np.int64)
    for k, color in enumerate(colors):
        off = sum((channel - value) ** 2 for channel, value in zip(channels, color, strict=True))
        closer = off < best
        np.copyto(best, off, where=closer)
        index[closer] = k
    return index


def off_mixture(
    values: FloatArray, first: FloatArray, second: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """How far values are from the nearest mixture of two colours, squared; and its share."""
    along = second - first
    from_first = values - first
    share = np.clip(from_first @ along / (along @ along), 0.0, 1.0)
    return ((from_first - share[:, None] * along) ** 2).sum(axis=1), share


def ink_axis(along: FloatArray, step: FloatArray) -> FloatArray:
    """What values, less their ground, are multiplied by to tell how much of an ink they have.

    Parameters
    ----------
    along : ndarray, shape (n, 3)
        From the ground to the ink.
    step : ndarray, shape (n, 3)
        From the ground to another one on the other side of the ink; zero where there is none. What
        is mixed of all three is told apart, unless the second ground lies towards the ink.

    Examples
    --------
    >>> white_to_black, white_to_blue = np.full((1, 3), -255.0), np.array([(-255.0, -255, 0)])
    >>> half_of_both = np.array([-255.0, -255, -127.5])
    >>> float((ink_axis(white_to_black, white_to_blue) @ half_of_both).item())
    0.5
    """
    length = np.maximum((step**2).sum(axis=1), 1e-9)
    towards = along - ((along * step).sum(axis=1) / length)[:, None] * step
    aside = (towards**2).sum(axis=1) >= ASIDE**2 * (along**2).sum(axis=1)
    towards = np.where(aside[:, None], towards, along)
    return np.asarray(towards / np.maximum((towards * along).sum(axis=1), 1e-9)[:, None])


def unmixed(
    values: FloatArray, nearby: BoolArray, colors: FloatArray, around: BoolArray | None = None
) -> tuple[IntArray, IntArray, BoolArray, FloatArray]:
    """Which two colours each value is mixed of, one of them nearby.

    Parameters
    ----------
    values : ndarray, shape (n, 3)
        Red, green and blue, 0 to 255.
    nearby, around : ndarray of bool, shape (n, k)
        Which colours are near each; and which may be the other one, rather than any.
    colors : ndarray, shape (k, 3)

    Returns
    -------
    label, other : ndarray of int, shape (n,)
        The colour of which each has more (if it is no mixture, the nearest), and the other one.
    is_none : ndarray of bool, shape (n,)
        Which are no mixtures.
    least : ndarray, shape (n,)
        How much of the other one there is.

    Examples
    --------
    >>> inks = np.array([(255.0, 255, 255), (0, 0, 0), (255, 0, 0)])
    >>> values, nearby = np.array([(255.0, 204, 204), (0, 0, 255)]), np.ones((2, 3), bool)
    >>> label, other, is_none, least = unmixed(values, nearby, inks)
    >>> label[0], other[0], float(least[0].round(3)), is_none.tolist()
    (np.int64(0), np.int64(2), 0.2, [False, True])
    """
    # Where nothing nearby is even any two may be mixed.
    nearby = nearby | ~nearby.any(axis=1, keepdims=True)
    every = np.ones_like(nearby)
    label = nearest_color(values, colors)
    best = np.full(len(values), MIXED**2 * 3)
    other, least = label.copy(), np.zeros(len(values))
    for others in (nearby, every) if around is None else (nearby, around, every):
        open_values = np.flatnonzero(best == MIXED**2 * 3)
        if len(open_values) == 0:
            break
        one, two = nearby[open_values].T.copy(), others[open_values].T.copy()
        for a, b in combinations(range(len(colors)), 2):
            own = open_values[(one[a] & two[b]) | (one[b] & two[a])]
            off, share = off_mixture(values[own], colors[a], colors[b])
            closer = off < best[own]
            best[own[closer]] = off[closer]
            less = share[closer] < 0.5
            label[own[closer]], other[own[closer]] = np.where(less, a, b), np.where(less, b, a)
            least[own[closer]] = np.minimum(share[closer], 1.0 - share[closer])
    return label, other, best == MIXED**2 * 3, least
