"""Pictures, through Pillow: decoded here, traced in :mod:`shapespline.trace`."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, cast

from shapespline.errors import InvalidInputError
from shapespline.tracing import centerlines, load, trace_colors, trace_image

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from shapespline.tracing import Channel, Local, Polarity, Selection
    from shapespline.values import Shape


def read(
    path: Path,
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
) -> Shape:
    """Trace the outlines in a PNG, JPEG, TIFF, BMP, WebP or GIF picture.

    Parameters
    ----------
    path : Path
    level, polarity, channel, color, contours, min_area, invert, local, blur, crop
        As in :func:`shapespline.trace.trace_image`. The unit of ``level`` is that of the
        picture: 0 to 255, or to 65535 for 16-bit grey.
    colors : int or "auto", optional
        Return areas of so many colours that share their borders instead of the outlines of ink;
        see :func:`shapespline.tracing.trace_colors`. Of the other options min_area, blur and crop
        act then, the others are refused.
    centerline : bool
        Return the centre lines of strokes instead of the outlines of the ink; see
        :func:`shapespline.centerline.centerlines`.

    Returns
    -------
    Shape
        In pixels, y up; ``frame`` is the picture.

    Raises
    ------
    FormatError
        If the file is no picture, is damaged, or has more than 80 megapixels.
    DegenerateContourError
        If there is no outline in it.
    """
    if colors is not None:
        given = (level, polarity, channel, color, contours, invert, local, centerline)
        if given != (None, "auto", "auto", None, "all", False, "auto", False):
            raise InvalidInputError(
                "colors are areas, not ink: give min_area, blur and crop with them, nothing else"
            )
        count = int(colors) if str(colors).isdecimal() else colors
        return trace_colors(load(path), count, min_area=min_area, blur=blur, crop=crop)
    shape = trace_image(
        load(path),
        level=level,
        polarity=polarity,
        channel=channel,
        color=color,
        contours=contours,
        min_area=min_area,
        invert=invert,
        local=_window(local),
        blur=blur,
        crop=crop,
    )
    return centerlines(shape) if centerline else shape


def _window(local: Local | str) -> Local:
    """A window as the command line says it, with a number for a number."""
    with contextlib.suppress(ValueError):
        return float(local)
    return cast("Local", local)
