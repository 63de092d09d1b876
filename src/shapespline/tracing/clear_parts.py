"""Clear parts of a picture in colours: laid on a colour that nothing has, they are no area.

On white paper a white shape and the paper around it would be one (TRC-27).
"""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

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
    share = np.clip(pixels[..., -1:] / full, 0.0, 1.0)
    is_visible = share[..., 0] >= HALF
    if is_visible.all() or not is_visible.any():
        return None
    flat = np.clip(pixels[..., :-1] / full, 0.0, 1.0) * WHITE
    if flat.shape[2] == 1:
        flat = np.repeat(flat, 3, axis=2)
    ground = _farthest(flat[is_visible])
    on_ground, on_paper = (
        np.rint(own + (flat - own) * share).astype(np.uint8) for own in (ground, WHITE)
    )
    return OnClear(on_ground, on_paper, ground)


def _farthest(colors: FloatArray) -> FloatArray:
    """Of pure colours, black and white the one that is farthest from all visible ones."""
    seen = colors[:: len(colors) // MOST_ASKED + 1]
    pure = WHITE * np.array(list(product((0.0, 1.0), repeat=3)))
    least = [float(((seen - one) ** 2).sum(axis=1).min()) for one in pure]
    return np.asarray(pure[int(np.argmax(least))])
