"""Whether points are the vertices of what was drawn: they repeat themselves, which noise does not.

Teeth, slots and steps whose vertices alone are given leave as much of local cubics as noise does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.validation import median, smallest_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import FloatArray

# Lengths are alike that differ by less than this part of the noise; so many neighbours that are
# all as far from each other as so many others are alike by chance in a hundredth of all noisy
# outlines. So many vertices are looked at (ANA-19).
ALIKE, WINDOW, MOST_VERTICES = 0.01, 8, 4096
# So large a part of the vertices was drawn then; teeth leave of cubics at least this part of their
# short edges, where digits of a file that repeat themselves leave little (ANA-19).
DRAWN_PART, STEP_PART, SHORT_EDGES = 0.5, 0.25, 0.1
# Steps along the axes are pixels if so many are multiples of one length, but for this part of it,
# and the noise is less than so many of them. Their windows are alike sooner (ANA-19).
PIXEL_PART, OFF_PIXEL, PIXELS_OF_NOISE, PIXEL_WINDOW = 0.95, 0.05, 2.0, 16
# Of an outline of pixels so large a part of the edges turns back, as those of teeth (ANA-19).
TEETH_PART = 0.4
# Windows are compared with so many that are next to them by the sum of their lengths.
BESIDE = 4


def are_drawn_vertices(points: FloatArray, closed: bool, noise: float) -> bool:
    """Whether most points are corners at right angles, or repeat others with all about them.

    What would be their noise, were they noisy, tells what is alike.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
    closed : bool
    noise : float
        Standard deviation across the outline that local cubics leave, data units.

    Examples
    --------
    >>> angle = np.pi * np.arange(80) / 40
    >>> radius = np.where(np.arange(80) % 2, 7.0, 10.0)
    >>> star = radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    >>> are_drawn_vertices(star, True, 2.4)
    True
    >>> shaken = star + np.random.default_rng(1).normal(0, 1.0, star.shape)
    >>> are_drawn_vertices(shaken, True, 2.4)
    False
    """
    points = points[:MOST_VERTICES]
    row = np.concatenate([points, points[:1]]) if closed else points
    edges = np.diff(row, axis=0)
    if noise < STEP_PART * smallest_of(np.hypot(*edges.T), SHORT_EDGES):
        return False
    if _is_of_pixels(edges, noise):
        is_drawn = _repeated(points, PIXEL_WINDOW, ALIKE * noise)
        if np.mean(_turns_back(edges, ALIKE * noise)) < TEETH_PART:
            return False
    else:
        is_drawn = _repeated(points, WINDOW, ALIKE * noise)
        is_drawn[1 : len(edges)] |= _at_right_angles(edges, ALIKE * noise)
    return bool(np.mean(is_drawn) >= DRAWN_PART)


def _is_of_pixels(edges: FloatArray, noise: float) -> bool:
    """Whether steps are multiples of one length, and stray by less than pixels do."""
    steps = np.abs(edges).ravel()
    steps = steps[steps > OFF_PIXEL * ALIKE * noise]
    pixel = steps.min()
    pixel = median(steps[np.round(steps / pixel) == 1.0])
    multiples = steps / pixel
    on = np.abs(multiples - np.round(multiples)) <= OFF_PIXEL
    return bool(noise < PIXELS_OF_NOISE * pixel and np.mean(on) >= PIXEL_PART)


def _at_right_angles(edges: FloatArray, alike: float) -> NDArray[np.bool_]:
    """For each edge but the last whether the next one stands on it."""
    lengths = np.hypot(*edges.T)
    longer = np.maximum(lengths[:-1], lengths[1:])
    return np.asarray(np.abs((edges[:-1] * edges[1:]).sum(axis=1)) <= alike * longer)


def _turns_back(edges: FloatArray, alike: float) -> NDArray[np.bool_]:
    """For each edge but the first and the last whether its neighbours stand on it on one side."""
    at_right = _at_right_angles(edges, alike)
    x, y = edges.T
    turns = x[:-1] * y[1:] - y[:-1] * x[1:]
    return np.asarray(at_right[:-1] & at_right[1:] & (turns[:-1] * turns[1:] > 0))


def _repeated(points: FloatArray, width: int, alike: float) -> NDArray[np.bool_]:
    """For each point whether it begins a window that is congruent to another, either way round.

    Told by the distances of neighbours, of second and of third ones.
    """
    count = len(points) - width + 1
    found = np.zeros(len(points), dtype=bool)
    if count < 2:
        return found
    forward, backward = [], []
    for k in (1, 2, 3):
        far = np.hypot(*(points[k:] - points[:-k]).T)
        lengths = np.lib.stride_tricks.sliding_window_view(far, width - k)[:count]
        forward.append(lengths)
        backward.append(lengths[:, ::-1])
    windows = np.concatenate([np.hstack(forward), np.hstack(backward)])
    # Unlike weights: a window and one whose lengths are in another order are far apart.
    order = np.argsort(windows @ np.sqrt(np.arange(2.0, 2.0 + windows.shape[1])), kind="stable")
    windows, own = windows[order], np.tile(np.arange(count), 2)[order]
    for k in range(1, BESIDE + 1):
        same = (np.abs(windows[k:] - windows[:-k]) <= alike).all(axis=1) & (own[k:] != own[:-k])
        found[own[k:][same]] = found[own[:-k][same]] = True
    return found
