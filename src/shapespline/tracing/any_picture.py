"""trace: a picture in memory or in a file -> Shape."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import TYPE_CHECKING, cast

from PIL import Image

from shapespline.errors import FormatError, InvalidInputError
from shapespline.geometry import scaled
from shapespline.monitor import silent
from shapespline.tracing.colors import checked_count, color_areas
from shapespline.tracing.outlines import SELECTIONS, ink_outlines
from shapespline.tracing.picture import load, pixels_of
from shapespline.tracing.seeing import Seeing, checked_choice
from shapespline.tracing.strokes import centerlines

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.monitor import Say
    from shapespline.tracing.outlines import Selection
    from shapespline.tracing.pixels import Channel
    from shapespline.tracing.seeing import Local, Polarity
    from shapespline.typing import ArrayLike
    from shapespline.values import Shape


def trace(
    image: ArrayLike | Image.Image | str | os.PathLike[str],
    *,
    level: float | None = None,
    polarity: Polarity = "auto",
    channel: Channel = "auto",
    color: str | None = None,
    contours: Selection = "all",
    min_area: float | None = None,
    invert: bool = False,
    local: Local | str = "auto",
    blur: float | None = None,
    crop: str | Sequence[int] | None = None,
    colors: int | str | None = None,
    centerline: bool = False,
    progress: Say | None = None,
) -> Shape:
    """Trace the outlines in a picture, between the pixels.

    Parameters
    ----------
    image : array_like, shape (h, w) or (h, w, c), PIL image, or path-like
        Grey, grey + alpha (c = 2), RGB (3) or RGBA (4), first row on top, integers of 8 or 16
        bits, or floats (alpha and colours then in 0 to 1), or booleans (h, w); or a PNG, JPEG,
        TIFF, BMP, WebP or GIF file. Arrays of integers are looked at strip by strip (but for
        ``blur`` and ``colors``), so that ``numpy.memmap`` serves for what does not fit the memory.
    level : float, optional
        Where to cut, in the unit of the image (0 to 255 for 8 bits); pixels at or above it are
        light. Otsu's level if not given; what shows to have been mixed as light is then looked at
        as light.
    polarity : {"auto", "dark", "light"}
        Whether the shape is darker or lighter than the level. "auto": the background is what
        most of the image's rim is, what shows in the corners of a figure that fills the image if
        that is lighter, or clear.
    channel : {"auto", "grey", "red", "green", "blue", "alpha", "difference"}
        The value of a pixel. "difference" is the root mean square difference from the median
        colour of the background, so that red on green of the same lightness is found. "auto" is
        grey for grey pictures and whenever ``level`` or ``polarity`` is given (both speak of
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
    colors : int or "auto", optional
        Areas of so many colours that share their borders, without gaps and without overlaps, in
        place of the outlines of ink; "auto" is as many as clearly differ, 16 at most. Outlines of
        areas come largest first, the holes in each after it; ``Shape.colors`` holds the colours.
        Of the other options ``min_area`` (smaller areas go to the neighbour with which they share
        most border), ``blur``, ``crop`` and ``local="off"`` act then, the others are refused.
    centerline : bool
        Return the centre lines of strokes instead of the outlines of the ink.
    progress : callable, optional
        Called with a sentence on what comes next; an exception that it raises ends the work.

    Returns
    -------
    Shape
        Closed contours, largest area first, outer ones counter-clockwise and holes clockwise.
        Unit pixel, y up, pixel centres at half-integers: x = column + 0.5,
        y = h - (row + 0.5); ``frame`` is (0, 0, w, h). Shapes cut off by the rim are closed
        along it; what ends in its pixels ends there. Each contour has the ``level_line`` that it
        was read along, and the ``accuracy`` that drawings with known outlines have been found with:
        0.02 pixels where the grey tells the edge, up to 0.09 where that has nine values or fewer,
        or its contrast was raised (level edges are then off by as much as was cut off), 0.07 where
        only the level tells it, 0.25 where there is no grey. What was left out as noise is in
        ``left_out``. Of a picture that was made 2, 3 or 4 times as large, by copies of its
        pixels or smoothly, all this is that of the smaller one, times as much.

    Raises
    ------
    InvalidInputError
        If the image is none, holds numbers that are not finite, an option is out of range, or the
        picture has fewer colours.
    FormatError
        If the file is missing, no picture, damaged, or has more than 80 megapixels (of grey 175).
    DegenerateContourError
        If there is no outline: a constant image, a level outside its values, only specks,
        or so many outlines that it is noise.

    Warns
    -----
    PictureWarning
        If outlines were left out as noise or small areas merged: how many, how large, and how to
        have them; and if the ground was found to be unevenly lit.

    Notes
    -----
    The level is moved to lie between two grey values, so that no pixel lies on it: for integer
    images by half a unit at most. On a straight edge rendered by area coverage the level line is
    at most 0.086 pixels off, and the outline 0.01; on real edges blur and noise decide.

    Examples
    --------
    >>> import numpy as np
    >>> image = np.full((8, 8), 255, dtype=np.uint8)
    >>> image[2:6, 2:6] = 0
    >>> contour = trace(image).longest
    >>> contour.closed, contour.points.min(axis=0).tolist(), contour.points.max(axis=0).tolist()
    (True, [2.0, 2.0], [6.0, 6.0])
    """
    checked_choice("contours", contours, SELECTIONS)
    if min_area is not None and not min_area >= 0:
        raise InvalidInputError(f"min_area must be at least 0 square pixels, got {min_area}")
    say = progress or silent
    if colors is not None:
        given = (level, polarity, channel, color, contours, invert, centerline)
        as_usual = given == (None, "auto", "auto", None, "all", False, False)
        if not as_usual or local not in ("auto", "off"):
            raise InvalidInputError(
                "colors are areas, not ink: give min_area, blur, crop and local='off' with them,"
                " nothing else"
            )
        return color_areas(
            _pixels(image, say),
            checked_count(colors),
            min_area=min_area,
            blur=blur,
            crop=crop,
            lit=local == "off",
            say=say,
        )
    with contextlib.suppress(TypeError, ValueError):  # a window, as a command line says it
        local = float(local)
    seeing = Seeing(level, polarity, channel, color, invert, cast("Local", local), blur, crop)
    shape, factor = ink_outlines(_pixels(image, say), seeing, contours, min_area, say)
    if centerline:
        say(f"looking for the centre lines of {len(shape)} outlines")
        shape = centerlines(shape)
    return cast("Shape", scaled(shape, factor, shape.unit)) if factor > 1 else shape


def _pixels(image: ArrayLike | Image.Image | str | os.PathLike[str], say: Say) -> ArrayLike:
    """Pixels of whatever a picture is given as."""
    if isinstance(image, Image.Image):
        return pixels_of(image)
    if not isinstance(image, str | os.PathLike):
        return image
    path = Path(image)
    if not path.is_file():
        raise FormatError(f"cannot trace {path}: there is no such file")
    say(f"reading {path.name}")
    try:
        return load(path)
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror or error}") from error
    except FormatError as error:
        raise FormatError(f"{path.name}: {error}") from error
