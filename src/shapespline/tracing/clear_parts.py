"""Clear parts of a picture in colours: laid on a colour that nothing has, they are no area.

On white paper a white shape and the paper around it would be one (TRC-27).
"""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.tracing.layer import strips
from shapespline.tracing.pixels import full_scale, has_alpha

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.tracing.palette import Palette
    from shapespline.typing import FloatArray

# What is less opaque than this part is clear (TRC-27).
HALF = 0.5
# About so many visible pixels tell which colour none of them has.
MOST_ASKED = 100_000
WHITE = 255.0


class OnClear(NamedTuple):
    """A picture on a ground that none of its colours is near.

    Attributes
    ----------
    pixels : ndarray of uint8, shape (h, w, 3)
        On that ground: where it is half opaque it is half-way to it.
    on_paper : ndarray of uint8, shape (h, w, 3)
        On white, as its colours are seen.
    ground : ndarray, shape (3,)
    """

    pixels: NDArray[np.uint8]
    on_paper: NDArray[np.uint8]
    ground: FloatArray

    def label(self, palette: Palette) -> int:
        """Which of the colours is the ground."""
        return int(((palette.colors - self.ground) ** 2).sum(axis=1).argmin())

    def seen_colors(self, palette: Palette) -> FloatArray:
        """Colours of a palette as they are seen on white paper, shape (k, 3)."""
        colors = palette.colors.copy()
        for k in range(len(colors)):
            own = palette.labels == k
            changed = (self.pixels[own] != self.on_paper[own]).any(axis=1)
            # Edges alone are mixtures; what is half clear all over looks like paper, too.
            if 2 * np.count_nonzero(changed) > len(changed):
                seen = self.on_paper[own]
                colors[k] = np.sort(seen, axis=0)[len(seen) // 2]
        return colors


def on_clear(pixels: NDArray[Any]) -> OnClear | None:
    """A picture on a ground of its own, None if nothing in it is clear.

    Parameters
    ----------
    pixels : ndarray, shape (h, w) or (h, w, c)
        As :func:`shapespline.trace` takes them.
    """
    if not has_alpha(pixels):
        return None
    full = full_scale(pixels)
    strip = list(strips(pixels.shape))
    visible = [_parts(pixels[rows], full)[1][..., 0] >= HALF for rows in strip]
    n_visible = sum(np.count_nonzero(part) for part in visible)
    if n_visible in (0, pixels.shape[0] * pixels.shape[1]):
        return None
    step = n_visible // MOST_ASKED + 1
    ground = _farthest(
        np.concatenate(
            [
                _parts(pixels[rows], full)[0][part][::step]
                for rows, part in zip(strip, visible, strict=True)
            ]
        )
    )
    on_ground, on_paper = (np.empty((*pixels.shape[:2], 3), dtype=np.uint8) for _ in range(2))
    for rows in strip:
        flat, share = _parts(pixels[rows], full)
        on_ground[rows] = np.rint(ground + (flat - ground) * share)
        on_paper[rows] = np.rint(WHITE + (flat - WHITE) * share)
    return OnClear(on_ground, on_paper, ground)


def _parts(pixels: NDArray[Any], full: float) -> tuple[FloatArray, FloatArray]:
    """Colours, 0 to 255 in three channels or one, and how opaque they are."""
    share = np.clip(pixels[..., -1:] / full, 0.0, 1.0)
    flat = np.clip(pixels[..., :-1] / full, 0.0, 1.0) * WHITE
    return np.broadcast_to(flat, (*flat.shape[:2], 3)), share


def _farthest(colors: FloatArray) -> FloatArray:
    """Of pure colours, black and white the one that is farthest from all of some colours."""
    pure = WHITE * np.array(list(product((0.0, 1.0), repeat=3)))
    least = [float(((colors - one) ** 2).sum(axis=1).min()) for one in pure]
    return np.asarray(pure[int(np.argmax(least))])
