"""Outlines of masks as points: what comes back of plates, and how near smooth outlines are.

    python -m benchmarks.drawn.pixel_chains

The pixels whose middles lie within an outline are its mask. Programs give its border as the middles
of its outermost pixels (OpenCV), as corners of pixels (polygons of maps) or as the level line at
one half (scikit-image, Matplotlib), all of these points or those alone where the border turns.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from contourpy import contour_generator
from scipy.spatial import cKDTree

from benchmarks.drawn.few_points import ORGANIC, fitted, is_outline
from benchmarks.drawn.random_plates import DRAWS, FORMS, STEP, plate
from benchmarks.drawn.truth import sampled
from benchmarks.quality import own_corpus

if TYPE_CHECKING:
    from collections.abc import Callable

    import shapespline as ss
    from benchmarks.drawn.truth import Array

# Pixels of the longer side, and about the outline.
PIXELS, MARGIN = (200, 500), 3
# Samples of a curve and of an outline.
SAMPLES = 8000


def mask_of(outline: Array) -> Array:
    """Whether the middle of each pixel, at whole numbers, lies within a closed outline."""
    width, height = np.ceil(outline.max(axis=0)).astype(int) + MARGIN
    mask = np.zeros((height, width), dtype=bool)
    (x, y), (next_x, next_y) = outline.T, np.roll(outline, -1, axis=0).T
    for row in range(height):
        passes = (y <= row) != (next_y <= row)
        part = (row - y[passes]) / (next_y[passes] - y[passes])
        at = np.sort(x[passes] + part * (next_x[passes] - x[passes]))
        for begin, end in at.reshape(-1, 2):
            mask[row, int(np.ceil(begin)) : int(np.floor(end)) + 1] = True
    return mask


def level_line(mask: Array) -> Array:
    """Middles of the sides of pixels along the longest border."""
    lines = contour_generator(z=mask.astype(float)).lines(0.5)
    return np.asarray(max(lines, key=len))[:-1]


def corners(mask: Array) -> Array:
    """Corners of pixels along it: each is between two middles that follow each other."""
    before = level_line(mask)
    after = np.roll(before, -1, axis=0)
    across = np.where(before % 1 == 0.5, before, after)
    return np.where(before % 1 == after % 1, 0.5 * (before + after), across)


def outermost(mask: Array) -> Array:
    """Middles of the pixels along it."""
    middles = level_line(mask)
    down, up = np.floor(middles).astype(int), np.ceil(middles).astype(int)
    inside = mask[down[:, 1], down[:, 0]]
    chain = np.where(inside[:, None], down, up).astype(float)
    return chain[(chain != np.roll(chain, 1, axis=0)).any(axis=1)]


def turns_of(chain: Array) -> Array:
    """The points alone where a chain turns."""
    ahead = np.roll(chain, -1, axis=0) - chain
    return chain[(ahead != np.roll(ahead, 1, axis=0)).any(axis=1)]


BORDERS: dict[str, Callable[[Array], Array]] = {
    "middles of pixels": outermost,
    "corners of pixels": corners,
    "level line": level_line,
}
POINTS: dict[str, Callable[[Array], Array]] = {"all": lambda chain: chain, "at turns": turns_of}


def on_pixels(dense: Array, pixels: int, random: np.random.Generator) -> Array:
    """A closed outline so many pixels long, anywhere on them."""
    scale = pixels / float(np.ptp(dense, axis=0).max())
    return scale * (dense - dense.min(axis=0)) + MARGIN + random.random(2)


def off(fit: ss.Fit, outline: Array) -> float:
    """Root mean square distance, but for the mean: middles of pixels lie inside, by half of one."""
    along = np.roll(outline, -1, axis=0) - outline
    normals = np.column_stack([along[:, 1], -along[:, 0]]) / np.hypot(*along.T)[:, None]
    curve = fit.curve(np.linspace(0.0, 1.0, SAMPLES))
    nearest = cKDTree(outline).query(curve)[1]
    return float(((curve - outline[nearest]) * normals[nearest]).sum(axis=1).std())


def chains_table() -> str:
    """Right fits of plates; stored points of smooth outlines, and how far off they are, pixels."""
    plates = [plate(form, draw, regular=True) for form in FORMS for draw in range(DRAWS)]
    smooth = [one.contour.resampled(SAMPLES).points for one in own_corpus() if one.name in ORGANIC]
    heads = [
        head.format(pixels)
        for pixels in PIXELS
        for head in (f"right of {len(plates)}, {{}} pixels", "points, off, {} pixels")
    ]
    lines = ["Border, points | " + " | ".join(heads), "|".join(["---"] * (1 + len(heads)))]
    for border, border_of in BORDERS.items():
        for points, points_of in POINTS.items():
            cells = []
            for pixels in PIXELS:
                random, right, stored, away = np.random.default_rng(pixels), 0, 0, []
                for outline in plates:
                    dense = on_pixels(sampled(outline, STEP), pixels, random)
                    fit = fitted(points_of(border_of(mask_of(dense))), None)
                    right += is_outline(fit, outline)
                for one in smooth:
                    dense = on_pixels(one, pixels, random)
                    fit = fitted(points_of(border_of(mask_of(dense))), None)
                    stored += fit.n_stored_points
                    away.append(off(fit, dense))
                cells += [f"{right}", f"{stored}, {np.exp(np.mean(np.log(away))):.2f}"]
            lines.append(f"{border}, {points} | " + " | ".join(cells))
    return "".join(f"| {line} |\n" for line in lines)


if __name__ == "__main__":
    print(chains_table())
