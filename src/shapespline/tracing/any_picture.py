"""trace: a picture in memory or in a file -> Shape."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from PIL import Image

from shapespline.errors import FormatError
from shapespline.tracing.centerline import centerlines
from shapespline.tracing.outlines import trace_image
from shapespline.tracing.picture import load, pixels_of

if TYPE_CHECKING:
    from collections.abc import Sequence

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
    local: Local = "auto",
    blur: float | None = None,
    crop: str | Sequence[int] | None = None,
    centerline: bool = False,
) -> Shape:
    """Trace the outlines in a picture.

    Parameters
    ----------
    image : array_like, shape (h, w) or (h, w, c), PIL image, or path-like
        Grey, grey + alpha, RGB or RGBA, first row on top; or a PNG, JPEG, TIFF, BMP,
        WebP or GIF file.
    level, polarity, channel, color, contours, min_area, invert, local, blur, crop
        As in :func:`shapespline.tracing.trace_image`.
    centerline : bool
        Return the centre lines of strokes instead of the outlines of the ink.

    Returns
    -------
    Shape
        In pixels, y up; ``frame`` is the picture.

    Raises
    ------
    InvalidInputError
        If the array is no picture, holds numbers that are not finite, or an option is out of range.
    FormatError
        If the file is missing, no picture, damaged, or has more than 80 megapixels.
    DegenerateContourError
        If there is no outline in it.

    Examples
    --------
    >>> import numpy as np
    >>> picture = np.full((40, 40), 255, dtype=np.uint8)
    >>> picture[10:30, 15:25] = 0
    >>> trace(picture)._repr_svg_()[:4], len(trace(picture))
    ('<svg', 1)
    """
    if isinstance(image, Image.Image):
        pixels: ArrayLike = pixels_of(image)
    elif isinstance(image, str | os.PathLike):
        path = Path(image)
        if not path.is_file():
            raise FormatError(f"cannot trace {path}: there is no such file")
        try:
            pixels = load(path)
        except OSError as error:
            raise FormatError(f"cannot read {path}: {error.strerror or error}") from error
        except FormatError as error:
            raise FormatError(f"{path.name}: {error}") from error
    else:
        pixels = image
    shape = trace_image(
        pixels,
        level=level,
        polarity=polarity,
        channel=channel,
        color=color,
        contours=contours,
        min_area=min_area,
        invert=invert,
        local=local,
        blur=blur,
        crop=crop,
    )
    return centerlines(shape) if centerline else shape
