"""Image to shape: sub-pixel outlines of what stands out from the background.

The picture is reduced to one value per pixel, cut at one level, and the level line is drawn by
linear interpolation between pixel centres (contourpy). Everything automatic here looks at the
whole picture once: the level is Otsu's [1]_, the background is what most of the rim is. That is
right for drawings, scans, glyphs and objects on an even ground; it is no segmentation of busy
photographs, where a picture with the object cut out (transparent ground) serves better.

References
----------
.. [1] N. Otsu, "A threshold selection method from gray-level histograms", IEEE Trans. Systems,
   Man, and Cybernetics 9(1), 1979, 62-66, equations (12) and (18).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias, cast

import numpy as np
from contourpy import LineType, contour_generator

from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.geometry import containing, signed_area
from shapespline.tracing.pixels import (
    CHANNELS,
    Channel,
    colour_distance,
    pixel_values,
    rim,
    validated_pixels,
)
from shapespline.units import PIXEL
from shapespline.values import Contour, Shape, ViewBox, nesting_depth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.typing import ArrayLike, FloatArray

Polarity: TypeAlias = Literal["auto", "dark", "light"]
Selection: TypeAlias = Literal["all", "longest"]

POLARITIES = ("auto", "dark", "light")
SELECTIONS = ("all", "longest")

# Specks: at most this part of the picture, but never fewer or more square pixels than these.
SPECK_PART = 0.0005
SPECK_AREAS = (8.0, 400.0)
# Two level line points closer than this (pixels) surround one pixel centre: one is enough.
SAME_POINT = 1e-3
FLOAT_BINS = 1024
# Pixels, root mean square over traced glyphs and icons whose outlines are known: anti-aliased (JPEG
# hardly differs) and one-bit.
ACCURACY, ONE_BIT_ACCURACY = 0.07, 0.25


def trace_image(
    image: ArrayLike,
    *,
    level: float | None = None,
    polarity: Polarity = "auto",
    channel: Channel = "auto",
    color: str | None = None,
    contours: Selection = "all",
    min_area: float | None = None,
) -> Shape:
    """Trace the outlines of an image at one level, between the pixels.

    Parameters
    ----------
    image : array_like, shape (h, w) or (h, w, c)
        Grey, grey + alpha (c = 2), RGB (3) or RGBA (4); first row on top. Integers of 8 or 16
        bits, or floats (alpha and colours then in 0 to 1), or booleans (h, w).
    level : float, optional
        Where to cut, in the unit of the image (0 to 255 for 8 bits); pixels at or above it are
        light. Otsu's level if not given.
    polarity : {"auto", "dark", "light"}
        Whether the shape is darker or lighter than the level. "auto": the background is what
        most of the image's rim is.
    channel : {"auto", "grey", "red", "green", "blue", "alpha", "difference"}
        The value of a pixel. "difference" is the root mean square difference from the median
        colour of the rim, so that red on green of the same lightness is found. "auto" is grey
        for grey pictures and whenever ``level`` or ``polarity`` is given (both speak of
        lightness); the alpha for one colour on a transparent ground; else the difference.
        Partly transparent pictures of several colours are laid on white, or on black if what is
        visible is mostly light.
    color : str, optional
        The shape is what has this colour: a name or code as in CSS, or "@column,row" for the
        colour of a pixel. ``level`` is then the largest difference that counts as it. Excludes
        ``channel`` and ``polarity``.
    contours : {"all", "longest"}
        Which outlines to return.
    min_area : float, optional
        Outlines that enclose less (square pixels) are dropped. By default 0.05 % of the image,
        but no fewer than 8 and no more than 400.

    Returns
    -------
    Shape
        Closed contours, largest area first, outer ones counter-clockwise and holes clockwise.
        Unit pixel, y up, pixel centres at half-integers: x = column + 0.5,
        y = h - (row + 0.5); ``frame`` is (0, 0, w, h). Shapes cut off by the rim are closed
        along it. Their ``accuracy`` is that of drawings with known outlines: 0.07 pixels where
        edges have grey in between, 0.25 where they are black or white alone.

    Raises
    ------
    InvalidInputError
        If the image or an option cannot be understood.
    DegenerateContourError
        If there is no outline: a constant image, a level outside its values, or only specks.

    Notes
    -----
    The level is lowered to lie between two grey values, so that no pixel lies on it: for integer
    images by half a unit at most. On a straight edge rendered by area coverage, linear
    interpolation is at most 0.086 px off (at coverage 1/sqrt(2)); on real edges blur and noise
    decide.

    Examples
    --------
    >>> image = np.full((8, 8), 255, dtype=np.uint8)
    >>> image[2:6, 2:6] = 0
    >>> contour = trace_image(image).longest
    >>> contour.closed, contour.points.min(axis=0).tolist(), contour.points.max(axis=0).tolist()
    (True, [2.0, 2.0], [6.0, 6.0])
    """
    _check_choice("polarity", polarity, POLARITIES)
    _check_choice("channel", channel, CHANNELS)
    _check_choice("contours", contours, SELECTIONS)
    if min_area is not None and not min_area >= 0:
        raise InvalidInputError(f"min_area must be at least 0 square pixels, got {min_area}")
    pixels = validated_pixels(image)
    if color is not None:
        if channel != "auto" or polarity != "auto":
            raise InvalidInputError("color excludes channel and polarity: give one way to see ink")
        values, is_difference = colour_distance(pixels, color), False
        polarity = "dark"
    else:
        lightness = level is not None or polarity != "auto"
        values, is_difference = pixel_values(pixels, channel, lightness=lightness)
    cut = _level(values, level)
    if polarity == "auto":
        light = is_difference or float(np.median(rim(values))) < cut
    else:
        light = polarity == "light"
    field = values - cut if light else cut - values
    height, width = field.shape
    lines = _level_lines(field)
    if contours == "longest":
        lines = sorted(lines, key=_length)[-1:]
    frame = ViewBox(0, 0, width, height)
    lines = _without_specks(lines, min_area, height * width)
    return nested(lines, frame, PIXEL, _accuracy(lines))


def nested(
    outlines: Sequence[FloatArray],
    frame: ViewBox | None = None,
    unit: str | None = None,
    accuracy: float | None = None,
) -> Shape:
    """Make a shape of outlines that do not cross: sorted by area, oriented, nesting found.

    Parameters
    ----------
    outlines : sequence of ndarray, shape (n_i, 2)
        Vertices of simple polygons, none crossing another.
    frame : ViewBox, optional
    unit : str, optional
    accuracy : float, optional
        Of each contour.

    Returns
    -------
    Shape
        Largest area first, so a parent comes before its children. Outer contours run
        counter-clockwise, those inside an odd number of others clockwise.

    Examples
    --------
    >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> nested([square, 4 * square - 1]).parents
    (-1, 0)
    """
    areas = [signed_area(points) for points in outlines]
    order = sorted(range(len(outlines)), key=lambda i: -abs(areas[i]))
    polygons = [outlines[i] for i in order]
    parents = containing(polygons)
    outers = [nesting_depth(parents, index) % 2 == 0 for index in range(len(polygons))]
    contours = [
        Contour(points[:: 1 if outer == (areas[i] > 0) else -1], closed=True, accuracy=accuracy)
        for i, points, outer in zip(order, polygons, outers, strict=True)
    ]
    return Shape(contours, parents, frame, unit)


def _accuracy(lines: Sequence[FloatArray]) -> float:
    """Standard deviation of the outlines: between two values alone all crossings are midway."""
    twice = 2 * np.concatenate(lines)
    midway = np.abs(twice - np.rint(twice)).max(axis=1) < 1e-9
    return ONE_BIT_ACCURACY if midway.mean() > 0.5 else ACCURACY


def otsu_level(values: NDArray[Any]) -> float:
    """Level that separates two classes of values best.

    The classes are Otsu's: their between-class variance is largest [1]_. The level is half-way
    between their medians, which is where an edge between two even regions lies; the thin
    grey seam of an anti-aliased drawing would pull their means.

    Parameters
    ----------
    values : ndarray
        Unsigned integers of 8 or 16 bits, or floats (sorted into 1024 bins); at least two
        different ones.

    Examples
    --------
    >>> otsu_level(np.array([0, 0, 10, 200, 200], dtype=np.uint8))
    100.0
    """
    if values.dtype.kind == "u":
        counts = np.bincount(values.ravel())
        centres = np.arange(len(counts), dtype=np.float64)
    else:
        counts, edges = np.histogram(values, FLOAT_BINS)
        centres = 0.5 * (edges[1:] + edges[:-1])
    n_below = np.cumsum(counts)[:-1]
    n_above = counts.sum() - n_below
    total = np.cumsum(counts * centres)
    splits = (n_below > 0) & (n_above > 0)
    distance = np.zeros(len(n_below))  # between the class means
    distance[splits] = (total[-1] - total[:-1][splits]) / n_above[splits] - total[:-1][
        splits
    ] / n_below[splits]
    cut = int(np.argmax(n_below * (n_above * distance**2))) + 1
    low = _histogram_median(counts[:cut], centres[:cut])
    high = _histogram_median(counts[cut:], centres[cut:])
    return 0.5 * (low + high)


def _histogram_median(counts: NDArray[Any], centres: FloatArray) -> float:
    """Centre of the bin that holds the middle of the counted values."""
    cumulative = np.cumsum(counts)
    return float(centres[np.searchsorted(cumulative, 0.5 * cumulative[-1])])


def _check_choice(name: str, value: str, choices: tuple[str, ...]) -> None:
    if value not in choices:
        raise InvalidInputError(f"{name} must be one of {', '.join(choices)}, got {value!r}")


def _level(values: NDArray[Any], level: float | None) -> float:
    """Cut asked for or Otsu's, moved off the integers; some pixels on either side of it."""
    lowest, highest = float(values.min()), float(values.max())
    if lowest == highest:
        raise DegenerateContourError(
            f"every pixel has the value {lowest:g}; there is no outline: choose another file or"
            " channel"
        )
    if level is not None and not np.isfinite(level):
        raise InvalidInputError(f"level must be a finite number, got {level}")
    cut = otsu_level(values) if level is None else float(level)
    if values.dtype.kind == "u":
        # Half an integer: no pixel lies on it, and no two points of the level line coincide.
        cut = float(np.ceil(cut)) - 0.5
    elif lowest < cut and (values == cut).any():
        cut = 0.5 * (cut + float(values[values < cut].max()))
    if not lowest < cut <= highest:
        raise DegenerateContourError(
            f"level {level} leaves no outline: the pixels range from {lowest:g} to {highest:g};"
            " choose a level in between, or none"
        )
    return cut


def _level_lines(field: FloatArray) -> list[FloatArray]:
    """Zero lines of a field, positive inside, all closed, in picture coordinates."""
    height = field.shape[0]
    padded = np.pad(field, 1, mode="edge")
    # Mirrored values put the line exactly on the image border where the shape touches it.
    for side in (padded[0], padded[-1], padded[1:-1, 0], padded[1:-1, -1]):
        np.negative(side, out=side, where=side > 0)
    generator = contour_generator(z=padded, name="serial", line_type=LineType.Separate)
    lines = []
    for line in cast("list[FloatArray]", generator.lines(0.0)):
        points = np.column_stack([line[:-1, 0] - 0.5, height - (line[:-1, 1] - 0.5)])
        points = _distinct(points)
        if len(points) >= 3:
            lines.append(points)
    return lines


def _distinct(points: FloatArray) -> FloatArray:
    """Points of a closed outline without those that all but equal the one before them."""
    steps = points - np.roll(points, 1, axis=0)
    return points[np.hypot(steps[:, 0], steps[:, 1]) > SAME_POINT]


def _without_specks(
    lines: list[FloatArray], min_area: float | None, n_pixels: int
) -> list[FloatArray]:
    """Outlines that enclose at least ``min_area`` square pixels, at least one."""
    if min_area is None:
        min_area = float(np.clip(SPECK_PART * n_pixels, *SPECK_AREAS))
    areas = [abs(signed_area(points)) for points in lines]
    kept = [points for points, area in zip(lines, areas, strict=True) if area >= min_area]
    if not kept:
        raise DegenerateContourError(
            f"no outline encloses {min_area:g} square pixels, the largest"
            f" {max(areas, default=0.0):.3g}; lower min_area or choose another level or channel"
        )
    return kept


def _length(points: FloatArray) -> float:
    steps = points - np.roll(points, 1, axis=0)
    return float(np.hypot(steps[:, 0], steps[:, 1]).sum())
