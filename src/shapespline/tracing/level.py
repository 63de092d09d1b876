"""Level: the values of ink and ground of a picture, and the cut half-way between them.

The two classes of values are Otsu's [1]_: their between-class variance is largest. An edge between
two even regions lies half-way between their values, so that is where the picture is cut. What the
value of a class is, its even parts tell; of thin strokes, which have none, their darkest.

References
----------
.. [1] N. Otsu, "A threshold selection method from gray-level histograms", IEEE Trans. Systems,
   Man, and Cybernetics 9(1), 1979, 62-66, equations (12) and (18).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.tracing.layer import Layer, strips

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.tracing.field import Field
    from shapespline.typing import BoolArray, FloatArray, IntArray

# Neighbours are even if they differ by no more than this part of the range of values.
EVEN = 0.04
# A class with fewer even pixels than this part of it has none to speak of: its value is then that
# of the part of its pixels that is farthest from the other class.
EVEN_PART, FARTHEST_PART = 0.02, 0.02
# Even parts that differ from a colour by more than this part of the full scale have another; what
# differs by more than this is not of the colour, whatever others there are.
OTHER, FARTHEST = 0.04, 0.2
# Where grain leaves none, neighbours that differ by so many of its deviations are even (TRC-45).
EVEN_NOISE = 4.0
# Pixels that tell the values of ink and ground.
EVEN_SAMPLE = 4_000_000
# Pixels that tell the noise well enough; what an edge is among them, of the contrast; how many have
# to be beside none.
NOISE_SAMPLE, EDGE, LEAST_EVEN = 1_000_000, 0.35, 0.1
# Median of the absolute value of a normal variable, and the deviation of a second difference.
_NORMAL_MEDIAN, _SECOND_DIFFERENCE = 0.6744898, np.sqrt(6.0)


class Level(NamedTuple):
    """The cut, and the values of the darker and the lighter class."""

    cut: float
    dark: float
    light: float


class _Histogram(NamedTuple):
    counts: IntArray
    even: IntArray
    centres: FloatArray


def picture_level(values: Layer, level: float | None = None) -> Level:
    """The cut asked for or found, and the values of what it parts.

    The cut is moved off the values of pixels: for integers to the next half, so that no pixel lies
    on it and no two points of the level line coincide.

    Parameters
    ----------
    values : Layer
        Unsigned integers of 8 or 16 bits, or floats (sorted into 1024 bins).
    level : float, optional

    Raises
    ------
    InvalidInputError
        If the level is no finite number.
    DegenerateContourError
        If all pixels are on one side of the cut.

    Examples
    --------
    >>> picture_level(Layer(np.array([[0, 0, 10, 200, 200]], dtype=np.uint8)))
    Level(cut=99.5, dark=0.0, light=200.0)
    """
    lowest, highest = values.range
    if lowest == highest:
        raise DegenerateContourError(
            f"every pixel has the value {lowest:g}; there is no outline: choose another file or"
            " channel"
        )
    if level is not None and not np.isfinite(level):
        raise InvalidInputError(f"level must be a finite number, got {level}")
    histogram = _histogram(values)
    if level is None:
        split = otsu_split(histogram.counts, histogram.centres)
        dark, light = _classes(values, histogram, split)
        cut = 0.5 * (dark + light)
    else:
        cut = float(level)
    if values.is_whole:
        cut = float(np.ceil(cut)) - 0.5
    elif lowest < cut:
        cut = _off_values(values, cut)
    if not lowest < cut <= highest:
        raise DegenerateContourError(
            f"level {level} leaves no outline: the pixels range from {lowest:g} to {highest:g};"
            " choose a level in between, or none"
        )
    if level is not None:
        split = int(np.searchsorted(histogram.centres, cut))
        dark, light = _classes(values, histogram, split)
    return Level(cut, dark, light)


def _off_values(values: Layer, cut: float) -> float:
    """The cut, or half-way down from it to the next value if a pixel has it."""
    met, below = False, -np.inf
    for rows in strips(values.shape):
        part = values[rows]
        met = met or bool((part == cut).any())
        below = max(below, float(part.max(where=part < cut, initial=-np.inf)))
    return 0.5 * (cut + below) if met else cut


def noise_deviation(values: Layer, contrast: float) -> float:
    """Standard deviation of what changes from pixel to pixel where the picture is even.

    Of second differences between neighbours and between next ones, along rows and along columns:
    the median of their absolute values, the largest of the four. Grain that runs along rows or
    over two pixels shows in it. Differences beside an edge, of a good part of the contrast, do not
    count; where hardly any others are left, nothing is known of noise.

    Examples
    --------
    >>> grain = np.random.default_rng(1).normal(100.0, 3.0, (200, 200))
    >>> bool(2.9 < noise_deviation(Layer(grain), 50.0) < 3.1)
    True
    """
    step = max(1, round(values.size / NOISE_SAMPLE))
    found = [0.0]
    for sample in (values[::step], values[:, ::step].T):
        kind = np.int32 if values.is_whole else np.float64
        lines: NDArray[Any] = np.ascontiguousarray(sample, dtype=kind)
        for gap in (1, 2):
            if lines.shape[1] <= 2 * gap:
                continue
            steps = lines[:, gap:] - lines[:, :-gap]
            small = np.abs(steps) < EDGE * contrast
            even = small[:, gap:] & small[:, :-gap]
            if np.count_nonzero(even) > LEAST_EVEN * even.size:
                bends = steps[:, gap:] - steps[:, :-gap]
                found.append(float(np.median(np.abs(bends[even]))))
    return max(found) / (_NORMAL_MEDIAN * _SECOND_DIFFERENCE)


def with_values(field: Field, values: Layer) -> Field:
    """Ink and ground as they are known, in other pixels: cut off these, and their noise."""
    return replace(
        field,
        values=values,
        cut=picture_level(values, field.middle).cut,
        noise=noise_deviation(values, field.contrast) / field.contrast,
    )


def halfway_to_other(values: Layer, full: float) -> float | None:
    """Level half-way from nothing to the least other value that even parts have; None for none.

    Parameters
    ----------
    values : Layer
        How far pixels are from a colour.
    full : float
        The largest difference that there can be.

    Examples
    --------
    >>> values = np.zeros((9, 30))
    >>> values[:, 10:20], values[:, 20:] = 80.0, 200.0
    >>> bool(abs(halfway_to_other(Layer(values), 255.0) - 40) < 1)
    True
    """
    histogram = _histogram(values)
    even = np.where(histogram.centres > OTHER * full, histogram.even, 0)
    if not even.any():
        return None
    seen = np.cumsum(even)
    least = histogram.centres[np.searchsorted(seen, EVEN_PART * seen[-1])]
    return min(0.5 * float(least), FARTHEST * full)


def _histogram(values: Layer, near: float | None = None) -> _Histogram:
    """How often each value occurs, and how often on even pixels, of a sample of rows.

    Even pixels differ by no more than ``near`` from their neighbours.
    """
    rows = np.arange(1, values.shape[0] - 1, values.size // EVEN_SAMPLE + 1)
    counts, (lowest, highest) = values.counts, values.range
    near = EVEN * (highest - lowest) if near is None else near
    middle = values[rows]
    if values.is_whole:
        centres = np.arange(len(counts), dtype=np.float64)
        even = middle[_even(values, rows, int(near))]
        return _Histogram(counts, np.bincount(even, minlength=len(counts)), centres)
    edges = values.bins
    even = middle[_even(values, rows, near)]
    return _Histogram(counts, np.histogram(even, edges)[0], 0.5 * (edges[1:] + edges[:-1]))


def _even(values: Layer, rows: IntArray, near: float) -> BoolArray:
    """Which pixels of some rows differ from their four neighbours by no more."""
    middle = values[rows]
    even = np.zeros(middle.shape, dtype=bool)
    even[:, 1:-1] = True
    for other in (values[rows - 1], values[rows + 1]):
        even &= np.maximum(middle, other) - np.minimum(middle, other) <= near
    beside = np.maximum(middle[:, 1:], middle[:, :-1]) - np.minimum(middle[:, 1:], middle[:, :-1])
    even[:, 1:-1] &= (beside[:, 1:] <= near) & (beside[:, :-1] <= near)
    return even


def otsu_split(counts: IntArray, centres: FloatArray) -> int:
    """First bin of the upper of the two classes whose between-class variance is largest [1]_.

    Examples
    --------
    >>> otsu_split(np.array([2, 1, 0, 2]), np.array([0.0, 10.0, 100.0, 200.0]))
    2
    """
    n_below = np.cumsum(counts)[:-1]
    n_above = counts.sum() - n_below
    total = np.cumsum(counts * centres)
    splits = (n_below > 0) & (n_above > 0)
    distance = np.zeros(len(n_below))  # between the class means
    distance[splits] = (total[-1] - total[:-1][splits]) / n_above[splits] - total[:-1][
        splits
    ] / n_below[splits]
    return int(np.argmax(n_below * (n_above * distance**2))) + 1


def _classes(values: Layer, histogram: _Histogram, split: int) -> tuple[float, float]:
    """Values of the classes below a bin and from it on."""
    below, above = slice(None, split), slice(split, None)
    if not (_has_even(histogram, below) and _has_even(histogram, above)):
        # Grain hides what is even, or strokes are thin.
        lowest, highest = values.range
        contrast = _class_value(histogram, above, 1 - FARTHEST_PART) - _class_value(
            histogram, below, FARTHEST_PART
        )
        near = EVEN_NOISE * noise_deviation(values, contrast)
        if near > EVEN * (highest - lowest):
            histogram = _histogram(values, near)
    dark = _class_value(histogram, below, FARTHEST_PART)
    light = _class_value(histogram, above, 1 - FARTHEST_PART)
    return dark, light


def _has_even(histogram: _Histogram, bins: slice) -> bool:
    """Whether a class has even parts to speak of."""
    counts, even = histogram.counts[bins].sum(), histogram.even[bins].sum()
    return bool(even >= max(1, EVEN_PART * counts))


def _class_value(histogram: _Histogram, bins: slice, farthest: float) -> float:
    """Median of the even pixels of a class; of a class without, a quantile of all."""
    even = _has_even(histogram, bins)
    counts = (histogram.even if even else histogram.counts)[bins]
    part = 0.5 if even else farthest
    centres = histogram.centres[bins]
    cumulative = np.cumsum(counts)
    # Of an even number the mean of the two in the middle: inverted pictures are traced alike.
    places = [
        np.searchsorted(cumulative, part * cumulative[-1], side) for side in ("left", "right")
    ]
    return float(centres[np.minimum(places, len(centres) - 1)].mean())
