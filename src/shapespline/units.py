"""Units of length that drawings are given in."""

from __future__ import annotations

from shapespline.errors import InvalidInputError

PIXEL = "px"
INCH = 25.4
# Length in millimetres. A pixel has none until somebody says how many make an inch.
MILLIMETRES = {
    "um": 1e-3,
    "mm": 1.0,
    "cm": 10.0,
    "dm": 100.0,
    "m": 1000.0,
    "km": 1e6,
    "mil": 0.0254,
    "in": INCH,
    "ft": 304.8,
    "yd": 914.4,
    "mi": 1609344.0,
    "pt": INCH / 72,
    "pc": INCH / 6,
    "Q": 0.25,
}
UNITS = (PIXEL, *MILLIMETRES)


def checked_unit(unit: str | None) -> str | None:
    """The unit, if it is a known one or None.

    Raises
    ------
    InvalidInputError
        If it is not.

    Examples
    --------
    >>> checked_unit("mm")
    'mm'
    """
    if unit is not None and unit not in UNITS:
        raise InvalidInputError(f"unit must be one of {', '.join(UNITS)}, got {unit!r}")
    return unit


def conversion(unit: str, wanted: str, dpi: float | None = None) -> float:
    """What a number in one unit is multiplied with to be in another.

    Parameters
    ----------
    unit, wanted : str
        Keys of ``MILLIMETRES``, or "px".
    dpi : float, optional
        Pixels per inch; needed where one of both is "px".

    Raises
    ------
    InvalidInputError
        If pixels are converted without a size, or a size is given and there are no pixels.

    Examples
    --------
    >>> conversion("in", "mm"), conversion("px", "in", dpi=300.0) == 1 / 300
    (25.4, True)
    """
    if unit == wanted:
        return 1.0
    if PIXEL not in (unit, wanted):
        return MILLIMETRES[unit] / MILLIMETRES[wanted]
    if dpi is None:
        raise InvalidInputError(
            f"unit={wanted!r} needs the size of a pixel: give dpi, pixels per inch, or scale, the"
            f" {wanted if unit == PIXEL else 'pixels'} that make one {unit}"
        )
    if unit == PIXEL:
        return INCH / dpi / MILLIMETRES[wanted]
    return MILLIMETRES[unit] * dpi / INCH
