"""Chord-to-point distance accumulation (CPDA): how much an outline bends at each point.

H_r sums the perpendicular distances of point r to the chords of L steps around it (the paper's
section 4; Awrangjeb and Lu 2008). On points d apart along a curve of curvature k it is
k d^2 L (L^2 - 1) / 12 to leading order (METHOD, reading 6). Its local maxima are the dominant
points of the outline.
"""

from __future__ import annotations

from bisect import bisect_left
from operator import ge, gt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.analysis.noise import noise_level
from shapespline.errors import InvalidInputError
from shapespline.validation import whole_number

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour

    Comparison = Callable[[float, float], bool]

# Standard deviations of the noise of H that a maximum must rise above its surroundings.
NOISE_SIGMAS = 4.0
# Chords, in parts of L, whose H together measure how much an outline bends: the short ones see a
# corner, the long ones the bow between two corners (PAP-07).
BENDING_SCALES = (1, 2, 4)


class Cpda(NamedTuple):
    """The accumulation along a contour and its local maxima.

    Attributes
    ----------
    values : ndarray, shape (n,)
        H, smoothed: what the maxima are taken of. Data units, not negative.
    signed : ndarray, shape (n,)
        The smoothed signed sums, positive where the outline turns left.
    raw : ndarray, shape (n,)
        H before smoothing.
    maxima : ndarray, shape (k,)
        Indices of the local maxima, increasing.
    length : int
        The chord length L in points.
    window : int
        Points of the moving average.
    floor : float
        The prominence that a maximum had to reach, data units.
    """

    values: FloatArray
    signed: FloatArray
    raw: FloatArray
    maxima: IntArray
    length: int
    window: int
    floor: float

    def curvature(self, spacing: float) -> FloatArray:
        """Signed curvature estimate from H, 1 / data units, for points ``spacing`` apart."""
        return _curvature(self.signed, self.length, spacing)


def _curvature(accumulated: FloatArray, length: int, spacing: float) -> FloatArray:
    """Curvature that H stands for: H = k d^2 L (L^2 - 1) / 12 on points d apart."""
    return accumulated * 12.0 / (spacing**2 * length * (length**2 - 1))


def accumulate(contour: Contour, length: int) -> tuple[FloatArray, FloatArray]:
    """Signed and unsigned chord-to-point distance sums of every point, each shape (n,).

    Parameters
    ----------
    contour : Contour
        Closed data wrap around; beyond the ends of open data stands their point reflection.
    length : int
        Chord length L in points, at least 2 (the chords s = 0 and s = L end at the point itself).

    Raises
    ------
    InvalidInputError
        If L is below 2 or too long for the data.

    Examples
    --------
    >>> from shapespline import Contour
    >>> square = Contour([(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)])
    >>> signed, unsigned = accumulate(square, 2)
    >>> signed.round(3).tolist()
    [0.707, 0.0, 0.707, 0.0, 0.707, 0.0, 0.707, 0.0]
    """
    steps = whole_number(length)
    if steps is None or steps < 2:
        raise InvalidInputError(
            f"length must be a whole number of points, at least 2, got {length!r}:"
            " with L = 1 every distance is zero"
        )
    longest = len(contour) // 2 if contour.closed else len(contour) - 1
    if steps > longest:
        raise InvalidInputError(
            f"length must be at most {longest} for {len(contour)} points, got {length};"
            " shorten it or sample the outline more densely"
        )
    signed, unsigned = np.empty(len(contour)), np.empty(len(contour))
    _kernels.accumulate_chord_distances(contour.points, steps, contour.closed, signed, unsigned)
    return signed, unsigned


def bending(contour: Contour, length: int) -> FloatArray:
    """How much an outline bends at each point: its curvature as H measures it, shape (n,).

    The largest of the unsigned curvatures that H gives with chords of L, 2 L and 4 L points;
    chords longer than a quarter of the data are left out.

    Parameters
    ----------
    contour : Contour
        Points about equally spaced.
    length : int
        Chord length L in points.

    Examples
    --------
    >>> from shapespline import Contour
    >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    >>> circle = Contour(5 * np.column_stack([np.cos(t), np.sin(t)]), closed=True)
    >>> float(bending(circle, 8).min().round(2)), float(bending(circle, 8).max().round(2))
    (0.2, 0.2)
    """
    n = len(contour)
    step = contour.length / (n if contour.closed else n - 1)
    found = np.zeros(n)
    for scale in BENDING_SCALES:
        chord = scale * length
        if scale > 1 and chord > n // 4:
            break
        window = 2 * max(1, chord // 4) + 1
        signed = moving_average(accumulate(contour, chord)[0], window, closed=contour.closed)
        np.maximum(found, _curvature(np.abs(signed), chord, step), out=found)
    return found


def moving_average(values: FloatArray, window: int, *, closed: bool) -> FloatArray:
    """Centred mean of ``window`` values (odd), circular if closed, mirrored at open ends.

    Examples
    --------
    >>> moving_average(np.array([0.0, 3.0, 0.0, 0.0]), 3, closed=True).tolist()
    [1.0, 1.0, 1.0, 0.0]
    """
    half = min(check_window(window) // 2, len(values) - 1)
    if half == 0:
        return values
    before, after = (
        (values[-half:], values[:half])
        if closed
        else (values[half:0:-1], values[-2 : -half - 2 : -1])
    )
    padded = np.concatenate([before, values, after])
    return np.convolve(padded, np.full(2 * half + 1, 1.0 / (2 * half + 1)), mode="valid")


def check_window(window: int) -> int:
    """The number of points of a moving average: odd, or an error."""
    points = whole_number(window)
    if points is None or points < 1 or points % 2 == 0:
        raise InvalidInputError(f"window must be an odd number of points, got {window!r}; try 3")
    return points


def local_maxima(
    values: FloatArray, *, closed: bool, prominence: float = 0.0, spacing: int = 1
) -> IntArray:
    """Indices of local maxima: one per plateau, prominent and apart enough.

    The prominence of a maximum is its height above the higher of the two lowest values that
    separate it from higher ground on either side (or, on open data, from the end).

    Parameters
    ----------
    values : ndarray, shape (n,)
    closed : bool
        Whether the first value follows the last. The ends of open values are never maxima.
    prominence : float
        Maxima must rise more than this.
    spacing : int
        Of maxima closer than this many places only the highest stays.

    Examples
    --------
    >>> heights = np.array([0.0, 1, 1, 1, 0, 3, 2.9, 3, 0])
    >>> local_maxima(heights, closed=False, prominence=0.5).tolist()
    [2, 7]
    """
    # A closed sequence is read from its lowest value round to that value again: a plateau is whole
    # then, and no way from a maximum to higher ground leads past a lower place than the ends.
    start = int(np.argmin(values)) if closed else 0
    sequence = np.concatenate([values[start:], values[: start + 1]]) if closed else values
    first = np.flatnonzero(np.concatenate([[True], sequence[1:] != sequence[:-1]]))
    last = np.concatenate([first[1:], [len(sequence)]]) - 1
    heights = sequence[first]
    rises = np.diff(heights) > 0
    peaks = 1 + np.flatnonzero(rises[:-1] & ~rises[1:])
    if len(peaks) == 0:
        return np.empty(0, dtype=np.int64)
    tops = heights[peaks]
    valleys = np.minimum.reduceat(heights, np.concatenate([[0], peaks]))
    keep = _prominences(tops, valleys) > prominence
    index = ((first[peaks] + last[peaks]) // 2)[keep] + start
    return _spaced(index % len(values), tops[keep], spacing, len(values) if closed else None)


def _prominences(tops: FloatArray, valleys: FloatArray) -> FloatArray:
    """Height of each peak above its key saddle; valleys[i] and valleys[i + 1] enclose tops[i]."""

    def bases(tops: list[float], valleys: list[float], passes: Comparison) -> list[float]:
        """Lowest value between each peak and the one before it that it does not pass."""
        found: list[float] = []
        higher: list[int] = []
        for i, top in enumerate(tops):
            low = valleys[i]
            while higher and passes(top, tops[higher[-1]]):
                low = min(low, found[higher.pop()])
            found.append(low)
            higher.append(i)
        return found

    # Of two equal peaks the later counts as the higher, so that one of them stays.
    left = bases(tops.tolist(), valleys.tolist(), ge)
    right = bases(tops[::-1].tolist(), valleys[::-1].tolist(), gt)[::-1]
    return tops - np.maximum(left, right)


def _spaced(index: IntArray, heights: FloatArray, spacing: int, period: int | None) -> IntArray:
    """Of indices closer than ``spacing`` the highest, sorted; circular with a period."""
    if spacing <= 1 or len(index) < 2:
        return np.sort(index)
    kept: list[int] = []
    for candidate in index[np.argsort(-heights, kind="stable")].tolist():
        at = bisect_left(kept, candidate)
        if at > 0 and candidate - kept[at - 1] < spacing:
            continue
        if at < len(kept) and kept[at] - candidate < spacing:
            continue
        if period is not None and kept:  # around the seam
            round_about = (candidate + period - kept[-1], kept[0] + period - candidate)
            if min(round_about) < spacing:
                continue
        kept.insert(at, candidate)
    return np.array(kept, dtype=np.int64)


def round_off_floor(contour: Contour, length: int) -> float:
    """Largest value that H can have on a straight line for rounding alone, data units.

    Each coordinate carries half a unit in the last place; a distance to a chord amplifies it by no
    more than 4 near the middle of the data, and there are L - 1 of them.
    """
    largest = float(np.abs(contour.points).max())
    return 4.0 * np.finfo(float).eps * largest * (length - 1)


def chord_to_point(
    contour: Contour,
    length: int,
    *,
    signed: bool = True,
    window: int | None = None,
    prominence: float | None = None,
    spacing: int = 1,
) -> Cpda:
    """CPDA of a contour and its local maxima.

    Parameters
    ----------
    contour : Contour
        Points about equally spaced: L counts points.
    length : int
        Chord length L in points.
    signed : bool
        Sum signed distances and take the absolute value (the original CPDA), or sum absolute
        values (the paper).
    window : int, optional
        Odd number of points of the moving average. Grows with L and with the noise when not given.
    prominence : float, optional
        Part of the largest value that a maximum must rise above its surroundings, on top of noise
        and rounding. ``None`` takes every local maximum, as the paper does.
    spacing : int
        Least number of points between maxima.

    Examples
    --------
    >>> from shapespline import Contour
    >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    >>> ellipse = Contour(np.column_stack([2 * np.cos(t), np.sin(t)]), closed=True)
    >>> chord_to_point(ellipse, 8, prominence=0.05).maxima.tolist()
    [0, 100]
    """
    signed_sums, unsigned_sums = accumulate(contour, length)
    raw = np.abs(signed_sums) if signed else unsigned_sums
    # Noise of deviation sigma moves a point against its chords by sigma, in all L - 1 of them.
    noise = 0.0 if prominence is None else noise_level(contour) * (length - 1)
    required = 0.0 if prominence is None else prominence * float(raw.max())
    if window is None:
        window = _window(length, noise, required)
    smooth_signed = moving_average(signed_sums, window, closed=contour.closed)
    values = (
        np.abs(smooth_signed)
        if signed
        else moving_average(unsigned_sums, window, closed=contour.closed)
    )
    floor = 0.0
    if prominence is not None:
        required = prominence * float(values.max())
        floor = max(
            required,
            NOISE_SIGMAS * noise / np.sqrt(window),
            round_off_floor(contour, length),
        )
    maxima = local_maxima(values, closed=contour.closed, prominence=floor, spacing=spacing)
    return Cpda(values, smooth_signed, raw, maxima, int(length), window, floor)


def _window(length: int, noise: float, required: float) -> int:
    """Odd window of the moving average: half of L, more where noise hides what is looked for."""
    half = max(1, length // 4)
    if required > 0.0:
        # The mean of w values lowers the noise by sqrt(w); more than L blurs what L resolves.
        needed = (NOISE_SIGMAS * noise / required) ** 2
        half = max(half, min(length // 2, int(np.ceil((needed - 1) / 2))))
    return 2 * half + 1
