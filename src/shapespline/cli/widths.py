"""``--width``: outlines of a known size, whatever numbers their file holds."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any, cast

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from shapespline import Drawing, Shape


def read_wide(
    path: Path, width: float, sampling: float | None, given: Mapping[str, Any]
) -> Shape | Drawing:
    """What a file holds, so wide; ``given`` are the options of reading, its unit among them."""
    from shapespline.geometry import scaled

    unit = given.get("unit")
    if "scale" in given or "dpi" in given:
        raise ss.InvalidInputError("--width, --scale and --dpi exclude each other: give one")
    if not 0 < width < inf:
        raise ss.InvalidInputError(f"--width must be a positive number, got {width:g}")
    rest = {name: value for name, value in given.items() if name != "unit"}
    read = ss.read(path, **rest)
    factor = width / width_of(read)
    if isinstance(read, ss.Drawing):  # exact curves are sampled in their new size
        found = cast("Drawing", ss.read(path, scale=factor, sampling=sampling, **rest))
        return cast("Drawing", scaled(found, 1.0, unit))
    return cast("Shape", scaled(read, factor, unit))


def width_of(held: Shape | Drawing) -> float:
    """Extent in x of all outlines together."""
    contours = list(held) if isinstance(held, ss.Shape) else [fit.contour for fit in held]
    low = min(contour.points[:, 0].min() for contour in contours)
    high = max(contour.points[:, 0].max() for contour in contours)
    if not high > low:
        raise ss.InvalidInputError("--width needs outlines that are not a vertical line")
    return float(high - low)
