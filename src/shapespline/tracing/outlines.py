"""Image to shape: sub-pixel outlines of what stands out from the background.

The picture is reduced to one value per pixel and cut at one level. The level line leads along the
edges; where the grey across an edge is that of a drawing, the outline is put where it was drawn
(:mod:`shapespline.tracing.edges`), corners included (:mod:`shapespline.tracing.corners`).
Everything automatic here looks at the whole picture once: the level is Otsu's, the background is
what most of the rim is. That is right for drawings, scans, glyphs and objects on an even ground; it
is no segmentation of busy photographs, where a picture with the object cut out (transparent ground)
serves better.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from shapespline.errors import DegenerateContourError, InvalidInputError, PictureWarning
from shapespline.geometry import containing, signed_area
from shapespline.tracing.edges import level_shares
from shapespline.tracing.lines import distinct, drawn_lines
from shapespline.tracing.seeing import Seeing, checked_choice
from shapespline.tracing.specks import is_speck, loop_areas
from shapespline.units import PIXEL
from shapespline.values import Contour, Shape, ViewBox, nesting_depth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.tracing.lines import Line
    from shapespline.tracing.pixels import Channel
    from shapespline.tracing.seeing import Local, Polarity
    from shapespline.typing import ArrayLike, BoolArray, FloatArray

Selection: TypeAlias = Literal["all", "longest"]

SELECTIONS = ("all", "longest")

# Outlines that stand out from the noise; with more a picture is no drawing.
MOST_OUTLINES = 20_000


def trace_image(
    image: ArrayLike,
    *,
    level: float | None = None,
    polarity: Polarity = "auto",
    channel: Channel = "auto",
    color: str | None = None,
    contours: Selection = "all",
    min_area: float | None = None,
    invert: bool = False,
    local: Local = "auto",
    blur: float | None = None,
    crop: str | Sequence[int] | None = None,
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
        colour of a pixel. ``level`` is then the largest difference that counts as it; half-way
        to the next colour of even parts if not given. Excludes
        ``channel`` and ``polarity``.
    contours : {"all", "longest"}
        Which outlines to return.
    min_area : float, optional
        Outlines that enclose less (square pixels) are left out. If not given, those that the noise
        and the texture of the picture explain are, and a warning tells their number.
    invert : bool
        Take the ground for the shape and the shape for the ground.
    local : float or {"auto", "off"}
        Whether the level follows the light that falls on the ground. "auto": where one level for
        the whole picture leaves lines that run along no edge, and a local one does not; a warning
        tells. A number is the size in pixels of windows that each show some ground.
    blur : float, optional
        Standard deviation, pixels, of a blur that takes grain and screens away before the cut.
    crop : str or sequence of int, optional
        Column and row of the upper left pixel, width and height, as "40,20,300,200": as if nothing
        else were in the picture.

    Returns
    -------
    Shape
        Closed contours, largest area first, outer ones counter-clockwise and holes clockwise.
        Unit pixel, y up, pixel centres at half-integers: x = column + 0.5,
        y = h - (row + 0.5); ``frame`` is (0, 0, w, h). Shapes cut off by the rim are closed
        along it. Each contour has the ``level_line`` that it was read along, and the ``accuracy``
        that drawings with known outlines have been found with: 0.02 pixels where the grey tells the
        edge, 0.07 where only the level does, 0.25 where there is no grey. What was left out as
        noise is in ``left_out``.

    Raises
    ------
    InvalidInputError
        If the image or an option cannot be understood.
    DegenerateContourError
        If there is no outline: a constant image, a level outside its values, only specks,
        or so many outlines that it is noise.

    Warns
    -----
    PictureWarning
        If outlines were left out as noise: how many, how large, and how to have them; and if the
        ground was found to be unevenly lit.

    Notes
    -----
    The level is moved to lie between two grey values, so that no pixel lies on it: for integer
    images by half a unit at most. On a straight edge rendered by area coverage the level line is
    at most 0.086 pixels off, and the outline 0.01; on real edges blur and noise decide.

    Examples
    --------
    >>> image = np.full((8, 8), 255, dtype=np.uint8)
    >>> image[2:6, 2:6] = 0
    >>> contour = trace_image(image).longest
    >>> contour.closed, contour.points.min(axis=0).tolist(), contour.points.max(axis=0).tolist()
    (True, [2.0, 2.0], [6.0, 6.0])
    """
    checked_choice("contours", contours, SELECTIONS)
    if min_area is not None and not min_area >= 0:
        raise InvalidInputError(f"min_area must be at least 0 square pixels, got {min_area}")
    seeing = Seeing(level, polarity, channel, color, invert, local, blur, crop)
    field, found = seeing.field(image)
    shares = level_shares(field, found)
    places = found.places(field.values.shape[0], shares)
    areas = loop_areas(places, found.loops)
    kept = _kept(field, found, places, areas, min_area)
    if contours == "longest":
        longest = max(np.flatnonzero(kept), key=lambda index: _length(places[found.loops[index]]))
        kept, selected = np.arange(len(kept)) == longest, kept
    else:
        selected = kept
    drawn = drawn_lines(field, found, places, kept)
    # Around a pixel that differs from the level by a rounding there is no outline.
    lines = [line for line in drawn if min(len(line.points), len(line.level_line)) > 2]
    if not lines:
        raise DegenerateContourError(
            "the outlines of the picture enclose nothing; choose another level or channel"
        )
    specks = [places[found.loops[index]] for index in np.flatnonzero(~selected)]
    return _shape(lines, specks, field)


def _kept(
    field: Field, found: Crossings, places: FloatArray, areas: FloatArray, min_area: float | None
) -> BoolArray:
    """Which outlines are more than specks, at least one; a warning tells of the others."""
    sizes = np.abs(areas)
    if min_area is not None:
        kept = sizes >= min_area
        if not kept.any():
            raise DegenerateContourError(
                f"no outline encloses {min_area:g} square pixels, the largest"
                f" {sizes.max(initial=0.0):.3g}; lower min_area or choose another level or channel"
            )
    else:
        kept = ~is_speck(field, found, places, areas)
        if not kept.any():
            raise DegenerateContourError(
                f"no outline stands out from the noise of the picture, {len(kept)} specks do not;"
                " blur it, choose another level or channel, or keep them with min_area=0"
            )
    if kept.sum() > MOST_OUTLINES:
        raise DegenerateContourError(
            f"the picture has {kept.sum()} outlines, more than {MOST_OUTLINES}: it is noise or a"
            " texture; blur it, scale it down or give a min_area"
        )
    if min_area is None and not kept.all():
        specks = "1 speck" if (~kept).sum() == 1 else f"{(~kept).sum()} specks"
        least = max(1, int(np.ceil(sizes[~kept].max())))
        warnings.warn(
            f"{specks} below {least} square pixel{'s' * (least > 1)} left out as noise or texture:"
            " --min-area 0 (min_area=0) keeps them",
            PictureWarning,
            stacklevel=3,
        )
    return kept


def _shape(lines: Sequence[Line], specks: Sequence[FloatArray], field: Field) -> Shape:
    """Outlines by area, oriented, their nesting found along the level lines, which do not cross."""
    height, width = field.values.shape
    parents, order, turned = nesting([line.level_line for line in lines])
    contours = [
        Contour(
            lines[index].points[:: -1 if turn else 1],
            closed=True,
            accuracy=lines[index].accuracy,
            level_line=lines[index].level_line[:: -1 if turn else 1],
        )
        for index, turn in zip(order, turned, strict=True)
    ]
    left_out = [Contour(points, closed=True) for points in map(distinct, specks) if len(points) > 2]
    return Shape(contours, parents, ViewBox(0, 0, width, height), PIXEL, left_out=left_out)


def nesting(outlines: Sequence[FloatArray]) -> tuple[list[int], list[int], list[bool]]:
    """Order, orientation and nesting of outlines that do not cross.

    Parameters
    ----------
    outlines : sequence of ndarray, shape (n_i, 2)
        Vertices of simple polygons, none crossing another.

    Returns
    -------
    parents : list of int
        In the new order, which is that of falling areas: a parent comes before its children.
    order : list of int
        The outlines in that order.
    turned : list of bool
        Which of them have to be reversed for outer ones to run counter-clockwise, and those inside
        an odd number of others clockwise.

    Examples
    --------
    >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> nesting([square, 4 * square - 1])
    ([-1, 0], [1, 0], [False, True])
    """
    areas = [signed_area(points) for points in outlines]
    order = sorted(range(len(outlines)), key=lambda i: -abs(areas[i]))
    parents = containing([outlines[i] for i in order])
    outers = [nesting_depth(parents, index) % 2 == 0 for index in range(len(order))]
    turned = [outer != (areas[i] > 0) for i, outer in zip(order, outers, strict=True)]
    return parents, order, turned


def _length(points: FloatArray) -> float:
    steps = points - np.roll(points, 1, axis=0)
    return float(np.hypot(steps[:, 0], steps[:, 1]).sum())
