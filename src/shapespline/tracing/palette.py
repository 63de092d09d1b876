"""Palette: the few colours of a picture, and which of them each pixel is.

The colours are those of its even parts, quantised by Pillow. What lies between two even parts is a
mixture of their colours and belongs to the one of which it has more: an edge never becomes a third
colour. Thin strokes have none of these; their inks are told by what they mix to (thin_inks), and
which of them a stroke is of by its cores.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.tracing.cores import APART, BESIDE, NEARBY, with_cores
from shapespline.tracing.layer import strips
from shapespline.tracing.mixtures import ink_axis, nearest_color, unmixed
from shapespline.tracing.thin_inks import with_thin_inks
from shapespline.tracing.threads import LACKS, is_thread
from shapespline.tracing.told import TOGETHER, Told, even_pixels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import BoolArray, FloatArray, IntArray

MOST_COLORS = 64
# Even pixels that tell the colours well enough.
SAMPLE = 2_000_000
# "auto" finds no more colours than this; each has at least this part of the even pixels.
AUTO_MOST, AUTO_PART = 16, 0.001
# A colour that so many pixels of a class share is the colour of the class, exactly.
EXACT_PART = 0.3


class Palette(NamedTuple):
    """Colours, shape (k, 3), 0 to 255; and the index of one for each pixel, shape (h, w)."""

    colors: FloatArray
    labels: NDArray[np.int8]


def palette_of(pixels: NDArray[np.uint8], colors: int | str) -> Palette:
    """Quantise a picture.

    Parameters
    ----------
    pixels : ndarray of uint8, shape (h, w, 3)
    colors : int or "auto"
        How many colours; "auto" is as many as clearly differ, 16 at most.

    Raises
    ------
    InvalidInputError
        If the picture has fewer colours.
    DegenerateContourError
        If it has one only.
    """
    even = even_pixels(pixels)
    told = even if even.sum() > 0.01 * even.size else np.ones_like(even)
    most = AUTO_MOST if colors == "auto" else int(colors)
    found = with_thin_inks(pixels, even, _chosen(pixels, told, colors), most)
    if colors != "auto" and len(found) < int(colors):
        raise InvalidInputError(
            f"colors asks for {colors}, but the picture has {len(found)} that are no mixtures of"
            " others: ask for no more, or auto"
        )
    if len(found) < 2:
        raise DegenerateContourError(
            "the picture has one colour only: there is no border to trace; choose another file"
        )
    return Palette(found, _labels(pixels, even, found))


def _chosen(pixels: NDArray[np.uint8], told: BoolArray, colors: int | str) -> FloatArray:
    """The colours of a palette of the pixels that tell it, the most frequent first."""
    from PIL import Image

    wanted = MOST_COLORS if colors == "auto" else int(colors)
    step = int(told.sum()) // SAMPLE + 1
    samples, codes, numbers = [], [], []
    for rows in strips(told.shape, TOGETHER):
        seen = pixels[rows][told[rows]]
        samples.append(seen[::step])
        code, times = np.unique(seen.astype(np.int64) @ (65536, 256, 1), return_counts=True)
        codes.append(code)
        numbers.append(times)
    distinct, place = np.unique(np.concatenate(codes), return_inverse=True)
    counts = np.bincount(place, np.concatenate(numbers)).astype(np.int64)
    exact = np.stack(np.divmod(distinct, 65536)[:1] + np.divmod(distinct % 65536, 256), axis=1)
    image = Image.fromarray(np.concatenate(samples).reshape(1, -1, 3))
    most = min(wanted, len(distinct))
    if len(distinct) <= wanted:
        member = np.arange(len(distinct))
    else:
        quantised = image.quantize(most, method=Image.Quantize.MAXCOVERAGE, kmeans=3)
        table = np.array(quantised.getpalette()).reshape(-1, 3)[:most].astype(np.float64)
        member = nearest_color(exact.astype(np.float64), table)
    classes = []
    for index in np.unique(member):
        own = np.flatnonzero(member == index)
        number = counts[own]
        first = own[np.argmax(number)]
        if number.max() >= EXACT_PART * number.sum():
            color = exact[first].astype(np.float64)
        else:
            color = (exact[own] * number[:, None]).sum(axis=0) / number.sum()
        classes.append((int(number.sum()), color))
    classes.sort(key=lambda item: (-item[0], *item[1]))
    if colors == "auto":
        classes = _clearly_different(classes, int(told.sum()))
    return np.array([color for _, color in classes])


def _clearly_different(
    classes: list[tuple[int, FloatArray]], total: int
) -> list[tuple[int, FloatArray]]:
    """Classes that are large enough, and not shades of larger ones."""
    kept: list[tuple[int, FloatArray]] = []
    for count, color in classes:
        apart = [float(np.sqrt(((color - other) ** 2).mean())) for _, other in kept]
        if count >= AUTO_PART * total and min(apart, default=np.inf) >= APART:
            kept.append((count, color))
    return kept[:AUTO_MOST]


def _labels(pixels: NDArray[np.uint8], even: BoolArray, colors: FloatArray) -> NDArray[np.int8]:
    """Index of a colour for each pixel."""
    known = Told.by_even(pixels, even, colors)
    told = with_cores(pixels, known, colors)
    labels = told.labels.copy()
    for where in told.others():
        nearby, around = told.around(where, NEARBY), told.around(where, BESIDE)
        values = pixels[where].astype(np.float64)
        own, other, _, share = unmixed(values, nearby, colors, around)
        on_stroke, ink, part = _on_strokes(values, known.around(where, NEARBY), nearby, colors)
        inked = part >= 0.5
        ground = np.where(own == ink, other, own)
        own[on_stroke] = np.where(inked, ink, ground)[on_stroke]
        other[on_stroke] = np.where(inked, ground, ink)[on_stroke]
        share[on_stroke] = np.where(inked, 1.0 - part, part)[on_stroke]
        may_be = np.flatnonzero(share >= 0.5 - LACKS)
        at = (where[0][may_be], where[1][may_be])
        ground, ink = own[may_be], other[may_be]
        step = _to_third(nearby[may_be], ground, ink, colors)
        axis = ink_axis(colors[ink] - colors[ground], step)
        of_thread = _on_threads(pixels, at, colors[ground], axis)
        threads = may_be[of_thread]
        own[threads] = other[threads]
        labels[where] = own
    return labels


def _on_strokes(
    values: FloatArray, even: BoolArray, nearby: BoolArray, colors: FloatArray
) -> tuple[BoolArray, IntArray, FloatArray]:
    """Which values lie on a thin stroke between two grounds, its ink, and how much of it they have.

    Grounds have even pixels nearby, the stroke has cores alone.
    """
    inks = nearby & ~even
    ink, first = inks.argmax(axis=1), even.argmax(axis=1)
    second = even.shape[1] - 1 - even[:, ::-1].argmax(axis=1)
    step = colors[second] - colors[first]
    axis = ink_axis(colors[ink] - colors[first], step)
    told_apart = np.abs((axis * step).sum(axis=1)) < 1e-6
    on_stroke = (inks.sum(axis=1) == 1) & (even.sum(axis=1) == 2) & told_apart
    part = ((values - colors[first]) * axis).sum(axis=1)
    return on_stroke, ink, np.clip(part, 0.0, 1.0)


def _to_third(nearby: BoolArray, ground: IntArray, ink: IntArray, colors: FloatArray) -> FloatArray:
    """From a ground to the one other colour nearby that is not the ink; zero where is none."""
    third = nearby.copy()
    each = np.arange(len(ground))
    third[each, ground] = third[each, ink] = False
    step = colors[third.argmax(axis=1)] - colors[ground]
    return np.where((third.sum(axis=1) == 1)[:, None], step, 0.0)


def _on_threads(
    pixels: NDArray[np.uint8], at: tuple[IntArray, ...], grounds: FloatArray, axis: FloatArray
) -> BoolArray:
    """Which pixels lie on strokes of another colour about a pixel wide, of which they have less.

    Along an axis from each ground to that colour.
    """
    offsets = np.arange(-2, 3)
    height, width = pixels.shape[:2]
    found = np.zeros(len(grounds), dtype=bool)
    for part in np.array_split(np.arange(len(grounds)), len(grounds) // 100_000 + 1):
        row = np.clip(at[0][part, None, None] + offsets[:, None], 0, height - 1)
        column = np.clip(at[1][part, None, None] + offsets, 0, width - 1)
        seen = pixels[row, column] - grounds[part, None, None]
        found[part] = is_thread((seen * axis[part, None, None]).sum(axis=3))
    return found


def merged(palette: Palette, least: float) -> tuple[Palette, int]:
    """Parts of one colour smaller than so many pixels given to the neighbour they touch most.

    Returns
    -------
    palette : Palette
    count : int
        How many there were.
    """
    from scipy import ndimage

    labels = palette.labels.copy()
    count = 0
    for _ in range(3):
        parts = np.zeros(labels.shape, dtype=np.int32)
        n_parts = 0
        for k in range(len(palette.colors)):
            own, n_own = ndimage.label(labels == k, np.ones((3, 3)))
            np.add(own, n_parts, out=own, where=own > 0)
            parts += own
            n_parts += n_own
        sizes = np.zeros(n_parts + 1, dtype=np.int64)
        for rows in strips(labels.shape, TOGETHER):
            sizes += np.bincount(parts[rows].ravel(), minlength=n_parts + 1)
        small = sizes < least
        small[0] = False
        if not small.any():
            break
        touching = _touching(parts, labels, small)
        count += len(touching)
        target = np.full(n_parts + 1, -1, dtype=np.int8)
        for part, label in touching:
            target[part] = label
        for rows in strips(labels.shape, TOGETHER):
            taken = target[parts[rows]]
            labels[rows] = np.where(taken >= 0, taken, labels[rows])
    return Palette(palette.colors, labels), count


def _touching(
    parts: NDArray[np.int32], labels: NDArray[np.int8], small: BoolArray
) -> list[tuple[int, int]]:
    """Small parts, each with the colour that it touches most."""
    pairs = []
    for a, b in (
        ((slice(None), slice(1, None)), (slice(None), slice(None, -1))),
        ((slice(1, None),), (slice(None, -1),)),
    ):
        for one, other in ((a, b), (b, a)):
            use = small[parts[one]] & (labels[one] != labels[other])
            pairs.append(np.stack([parts[one][use], labels[other][use]], axis=1))
    seen, counts = np.unique(np.concatenate(pairs), axis=0, return_counts=True)
    order = np.lexsort((-counts, seen[:, 0]))
    first = np.unique(seen[order, 0], return_index=True)[1]
    return [(part, label) for part, label in seen[order][first].tolist()]
