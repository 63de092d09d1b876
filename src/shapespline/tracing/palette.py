"""Palette: the few colours of a picture, and which of them each pixel is.

The colours are those of its even parts, quantised by Pillow. What lies between two even parts is a
mixture of their colours and belongs to the one of which it has more: an edge never becomes a third
colour. What is no mixture of colours nearby, a thin stroke, is one with any other of the palette.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.tracing.layer import strips
from shapespline.tracing.smeared import are_smeared
from shapespline.tracing.threads import LACKS, is_thread

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from shapespline.typing import BoolArray, FloatArray, IntArray

MOST_COLORS = 64
# Even pixels that tell the colours well enough, and pixels that are looked at together.
SAMPLE, TOGETHER = 2_000_000, 1_000_000
# Neighbours of an even pixel differ by no more, of 255 in each channel.
EVEN = 10
# "auto" finds no more colours than this; each has at least this part of the even pixels, and is at
# least so far from all others (root mean square over the channels, of 255).
AUTO_MOST, AUTO_PART, AUTO_APART = 16, 0.001, 14.0
# A colour that so many pixels of a class share is the colour of the class, exactly.
EXACT_PART = 0.3
# Even pixels within so many pixels are nearby. A pixel farther than this from a mixture of two of
# their colours is a mixture with another.
NEARBY, MIXED = 2, 20.0
# Edges of JPEG's colours are looked for between even pixels so far away; of what is no mixture this
# part is theirs where it is theirs at all; they ring by so much (TRC-25).
SMEARED, MOST_SMEARED, RINGING = 8, 0.6, 30.0
# So many pixels, and this part of the picture, that are no mixtures have a colour of their own:
# that of this part of them, the farthest from the colours around them.
THIN, THIN_PART, FARTHEST_PART = 6, 1e-5, 0.1


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
    even = _even(pixels)
    told = even if even.sum() > 0.01 * even.size else np.ones_like(even)
    found = _with_thin(pixels, even, _chosen(pixels, told, colors), colors)
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


def _even(pixels: NDArray[np.uint8]) -> BoolArray:
    """Pixels that hardly differ from their eight neighbours."""
    from scipy import ndimage

    even = np.empty(pixels.shape[:2], dtype=bool)
    for rows in strips(even.shape, TOGETHER):
        above = max(rows.start - 1, 0)
        seen = pixels[above : rows.stop + 1]
        spread = [
            ndimage.maximum_filter(channel, 3) - ndimage.minimum_filter(channel, 3)
            for channel in np.moveaxis(seen, -1, 0)
        ]
        own = slice(rows.start - above, rows.stop - above)
        even[rows] = np.max(spread, axis=0)[own] <= EVEN
    return even


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
        member = _nearest(exact.astype(np.float64), table)
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


def _with_thin(
    pixels: NDArray[np.uint8], even: BoolArray, colors: FloatArray, wanted: int | str
) -> FloatArray:
    """A palette with the colours of strokes too thin to have even pixels.

    Those are pixels that no two colours of the palette mix to; of them the farthest from it.
    """
    most = AUTO_MOST if wanted == "auto" else int(wanted)
    while True:
        strange, nearby = _strange(pixels, even, colors)
        if len(strange) < max(THIN, THIN_PART * even.size):
            break
        nearby[~nearby.any(axis=1)] = True
        off = np.sqrt(((strange[:, None] - colors) ** 2).mean(axis=2))
        off = np.where(nearby, off, np.inf).min(axis=1)
        farthest = strange[off >= np.quantile(off, 1 - FARTHEST_PART)]
        new = np.median(farthest, axis=0)
        if len(colors) == most:  # in place of the rarest, if that is a shade of another
            apart = np.sqrt(((colors[:-1] - colors[-1]) ** 2).mean(axis=1)).min()
            if apart > 3 * AUTO_APART:
                break
            colors = colors[:-1]
        if np.sqrt(((colors - new) ** 2).mean(axis=1)).min() < AUTO_APART:
            break
        colors = np.concatenate([[new], colors])
    return colors


def _strange(
    pixels: NDArray[np.uint8], even: BoolArray, colors: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """Values that no two colours mix to, and which colours are near each.

    Where most of them are seen to be smeared edges, what may be one is.
    """
    found, near = [np.empty((0, 3))], [np.empty((0, len(colors)), dtype=bool)]
    smeared = [np.empty(0, dtype=bool)]
    labels, count = _even_labels(pixels, even, colors), len(colors)
    for (where, nearby), (_, around) in zip(
        _uneven(even, labels, count), _uneven(even, labels, count, SMEARED), strict=True
    ):
        values = pixels[where].astype(np.float64)
        is_strange = _unmixed(values, nearby, colors)[1]
        found.append(values[is_strange])
        near.append(nearby[is_strange])
        smeared.append(are_smeared(values[is_strange], around[is_strange], colors, MIXED))
    values, nearby, edges = np.concatenate(found), np.concatenate(near), np.concatenate(smeared)
    if len(edges) and edges.mean() >= MOST_SMEARED:
        kept = ~are_smeared(values, np.ones_like(nearby), colors, RINGING)
        values, nearby = values[kept], nearby[kept]
    return values, nearby


def _even_labels(
    pixels: NDArray[np.uint8], even: BoolArray, colors: FloatArray
) -> NDArray[np.int8]:
    labels = np.zeros(even.shape, dtype=np.int8)
    for rows in strips(even.shape, TOGETHER):
        own = even[rows]
        labels[rows][own] = _nearest(pixels[rows][own].astype(np.float64), colors)
    return labels


def _uneven(
    even: BoolArray, labels: NDArray[np.int8], count: int, reach: int = NEARBY
) -> Iterator[tuple[tuple[IntArray, IntArray], BoolArray]]:
    """Places of pixels that are not even, some at a time.

    And which colours the even ones around each have, shape (n, count).
    """
    for rows in strips(even.shape, TOGETHER):
        row, column = np.nonzero(~even[rows])
        if len(row) == 0:
            continue
        above = max(rows.start - reach, 0)
        seen = slice(above, rows.stop + reach)
        # A bit for each colour.
        bits = np.where(even[seen], np.uint64(1) << labels[seen].astype(np.uint64), np.uint64(0))
        for side in (bits, bits.T):
            alone = side.copy()
            for step in range(1, reach + 1):
                side[step:] |= alone[:-step]
                side[:-step] |= alone[step:]
        near = bits[row + rows.start - above, column]
        known = (near[:, None] >> np.arange(count, dtype=np.uint64)) & np.uint64(1)
        yield (row + rows.start, column), known.astype(bool)


def _clearly_different(
    classes: list[tuple[int, FloatArray]], total: int
) -> list[tuple[int, FloatArray]]:
    """Classes that are large enough, and not shades of larger ones."""
    kept: list[tuple[int, FloatArray]] = []
    for count, color in classes:
        apart = [float(np.sqrt(((color - other) ** 2).mean())) for _, other in kept]
        if count >= AUTO_PART * total and min(apart, default=np.inf) >= AUTO_APART:
            kept.append((count, color))
    return kept[:AUTO_MOST]


def _nearest(values: FloatArray, colors: FloatArray) -> IntArray:
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


def _labels(pixels: NDArray[np.uint8], even: BoolArray, colors: FloatArray) -> NDArray[np.int8]:
    """Index of a colour for each pixel."""
    labels = _even_labels(pixels, even, colors)
    for where, nearby in _uneven(even, labels.copy(), len(colors)):
        own, _, other, share = _unmixed(pixels[where].astype(np.float64), nearby, colors)
        may_be = np.flatnonzero(share >= 0.5 - LACKS)
        at = (where[0][may_be], where[1][may_be])
        of_thread = _on_threads(pixels, at, colors[own[may_be]], colors[other[may_be]])
        threads = may_be[of_thread]
        own[threads] = other[threads]
        labels[where] = own
    return labels


def _on_threads(
    pixels: NDArray[np.uint8], at: tuple[IntArray, ...], colors: FloatArray, others: FloatArray
) -> BoolArray:
    """Which pixels lie on strokes of another colour about a pixel wide, of which they have less."""
    offsets = np.arange(-2, 3)
    height, width = pixels.shape[:2]
    found = np.zeros(len(colors), dtype=bool)
    for part in np.array_split(np.arange(len(colors)), len(colors) // 100_000 + 1):
        row = np.clip(at[0][part, None, None] + offsets[:, None], 0, height - 1)
        column = np.clip(at[1][part, None, None] + offsets, 0, width - 1)
        along = others[part] - colors[part]
        seen = ((pixels[row, column] - colors[part, None, None]) * along[:, None, None]).sum(axis=3)
        found[part] = is_thread(seen / (along**2).sum(axis=1)[:, None, None])
    return found


def _unmixed(
    values: FloatArray, nearby: BoolArray, colors: FloatArray
) -> tuple[IntArray, BoolArray, IntArray, FloatArray]:
    """The colour of which each value has more, mixed of two with one nearby; which are none.

    And the other of the two, with how much of it there is.
    """
    # Where nothing nearby is even any two may be mixed.
    nearby = nearby | ~nearby.any(axis=1, keepdims=True)
    label = _nearest(values, colors)
    best = np.full(len(values), MIXED**2 * 3)
    other, least = label.copy(), np.zeros(len(values))
    for pairs in (_nearby_pairs, _pairs_with_one):
        open_values = np.flatnonzero(best == MIXED**2 * 3)
        if len(open_values) == 0:
            break
        for a, b in combinations(range(len(colors)), 2):
            own = open_values[pairs(nearby[open_values], a, b)]
            along = colors[b] - colors[a]
            from_a = values[own] - colors[a]
            share = np.clip(from_a @ along / (along @ along), 0.0, 1.0)
            off = ((from_a - share[:, None] * along) ** 2).sum(axis=1)
            closer = off < best[own]
            best[own[closer]] = off[closer]
            less = share[closer] < 0.5
            label[own[closer]], other[own[closer]] = np.where(less, a, b), np.where(less, b, a)
            least[own[closer]] = np.minimum(share[closer], 1.0 - share[closer])
    return label, best == MIXED**2 * 3, other, least


def _nearby_pairs(nearby: BoolArray, a: int, b: int) -> BoolArray:
    return nearby[:, a] & nearby[:, b]


def _pairs_with_one(nearby: BoolArray, a: int, b: int) -> BoolArray:
    return nearby[:, a] | nearby[:, b]


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
