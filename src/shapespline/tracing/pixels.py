"""Pictures to one value per pixel: lightness, a channel, alpha, or distance from the ground."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, cast

import numpy as np

from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import ArrayLike, FloatArray

Channel: TypeAlias = Literal["auto", "grey", "red", "green", "blue", "alpha", "difference"]

CHANNELS = ("auto", "grey", "red", "green", "blue", "alpha", "difference")

# Rec. ITU-R BT.601-7, section 2.5.1: the luma weights that Pillow and most viewers use.
LUMA = (0.299, 0.587, 0.114)
# Width of the rim that shows the background, as a part of the shorter side: wider than the thin
# frames that programs draw around pictures.
RIM = 0.02
# A picture is coloured if this part of its pixels spreads this far over its channels: more than
# JPEG leaves of a grey scan.
COLOURED_PIXELS = 0.001
COLOURED_SPREAD = 0.1
# Visible pixels this close (part of the full scale) are one colour: the shape is in the alpha.
ONE_COLOUR = 0.02


class PixelValues(NamedTuple):
    """One value per pixel, shape (h, w), and whether it is the distance from the ground."""

    values: NDArray[Any]
    is_difference: bool


def validated_pixels(image: ArrayLike) -> NDArray[Any]:
    """Pixels as uint8, uint16 or finite float64, shape (h, w) or (h, w, 2 to 4).

    Other integers become the smallest of the two unsigned types that holds them.

    Raises
    ------
    InvalidInputError
        If the image has another shape, no pixel, or values that are not finite real numbers.

    Examples
    --------
    >>> validated_pixels([[0, 300]]).dtype.name
    'uint16'
    """
    pixels = np.asarray(image)
    channels = pixels.shape[2] if pixels.ndim == 3 else 1
    if pixels.ndim not in (2, 3) or not 1 <= channels <= 4 or pixels.size == 0:
        raise InvalidInputError(
            "image must have shape (h, w) or (h, w, c) with 1 to 4 channels and at least one"
            f" pixel, got {pixels.shape}"
        )
    if pixels.dtype.kind not in "buif":
        raise InvalidInputError(f"image must hold real numbers, got dtype {pixels.dtype}")
    if pixels.dtype.kind == "b":
        pixels = pixels.astype(np.uint8)
    elif pixels.dtype.kind in "ui" and pixels.dtype not in (np.uint8, np.uint16):
        holding = (t for t in (np.uint8, np.uint16) if pixels.max() <= np.iinfo(t).max)
        pixels = pixels.astype(next(holding, np.float64) if pixels.min() >= 0 else np.float64)
    elif pixels.dtype.kind == "f":
        pixels = pixels.astype(np.float64)
        if not np.isfinite(pixels).all():
            raise InvalidInputError("image must be finite, got NaN or infinite pixels; repair them")
    return pixels[:, :, 0] if channels == 1 and pixels.ndim == 3 else pixels


def colour_distance(pixels: NDArray[Any], color: str) -> FloatArray:
    """Root mean square difference of each pixel from a colour, in the unit of the image.

    Parameters
    ----------
    pixels : ndarray, shape (h, w) or (h, w, 2 to 4)
        As :func:`validated_pixels` returns them; transparent ones are laid on white or black.
    color : str
        A name or code as in CSS ("red", "#f80", "rgb(255, 128, 0)"), or "@column,row": the colour
        of that pixel, counted from the upper left corner.

    Raises
    ------
    InvalidInputError
        If the colour cannot be understood, or its pixel lies outside.

    Examples
    --------
    >>> image = np.zeros((1, 2, 3), dtype=np.uint8)
    >>> image[0, 1] = (255, 0, 0)
    >>> colour_distance(image, "red").round().tolist(), colour_distance(image, "@0,0").tolist()
    ([[147.0, 0.0]], [[0.0, 147.22431864335456]])
    """
    if pixels.ndim == 3 and pixels.shape[2] in (2, 4):
        pixels = on_ground(pixels)
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[:, :, None], 3, axis=2)
    wanted = _colour(color, pixels)
    squares = ((pixels - wanted).astype(np.float64) ** 2).sum(axis=2)
    return cast("FloatArray", np.sqrt(squares / 3))


def _colour(color: str, pixels: NDArray[Any]) -> FloatArray:
    """Three values in the unit of the image."""
    expected = (
        f"color must be a CSS colour such as '#ff8800' or 'red', or '@column,row', got {color!r}"
    )
    if not isinstance(color, str):
        raise InvalidInputError(expected)
    if color.startswith("@"):
        try:
            column, row = (int(part) for part in color[1:].split(","))
        except ValueError:
            raise InvalidInputError(expected) from None
        height, width = pixels.shape[:2]
        if not (0 <= column < width and 0 <= row < height):
            raise InvalidInputError(
                f"color names the pixel {column},{row}, but the picture has {width} x {height}"
            )
        return pixels[row, column].astype(np.float64)
    from PIL import ImageColor

    try:
        rgb = ImageColor.getrgb(color)[:3]
    except ValueError:
        raise InvalidInputError(expected) from None
    return np.array(rgb) / 255 * full_scale(pixels)


def pixel_values(pixels: NDArray[Any], channel: Channel, *, lightness: bool) -> PixelValues:
    """Reduce validated pixels to the channel asked for, or find one.

    Parameters
    ----------
    pixels : ndarray, shape (h, w) or (h, w, 2 to 4)
        As :func:`validated_pixels` returns them.
    channel : Channel
        As in :func:`shapespline.trace.trace_image`.
    lightness : bool
        Whether "auto" has to be lightness.

    Raises
    ------
    InvalidInputError
        If the picture does not have the channel.
    """
    has_alpha = pixels.ndim == 3 and pixels.shape[2] in (2, 4)
    if channel == "alpha" and not has_alpha:
        raise InvalidInputError("channel 'alpha' needs a picture with transparency; leave it out")
    free = channel == "auto" and not lightness
    if channel == "alpha" or (free and has_alpha and _is_one_colour(pixels)):
        return PixelValues(pixels[:, :, -1], is_difference=False)
    if has_alpha:
        pixels = on_ground(pixels)
    if channel in ("red", "green", "blue"):
        if pixels.ndim == 2:
            raise InvalidInputError(f"channel {channel!r} needs a colour picture; use 'grey'")
        index = ("red", "green", "blue").index(channel)
        return PixelValues(pixels[:, :, index], is_difference=False)
    if channel == "difference" or (free and _is_coloured(pixels)):
        return PixelValues(_difference(pixels), is_difference=True)
    return PixelValues(_grey(pixels), is_difference=False)


def full_scale(pixels: NDArray[Any]) -> float:
    """Value of white and opaque: the largest integer, or 1 for floats."""
    return float(np.iinfo(pixels.dtype).max) if pixels.dtype.kind == "u" else 1.0


def _is_one_colour(pixels: NDArray[Any]) -> bool:
    """Whether all pixels that are more than half opaque look alike, some pixel being clear."""
    alpha, full = pixels[:, :, -1], full_scale(pixels)
    visible = pixels[alpha > 0.5 * full][:, :-1]
    if len(visible) == 0 or len(visible) == alpha.size:
        return False
    spread = visible.max(axis=0).astype(np.float64) - visible.min(axis=0)
    return bool(spread.max() <= ONE_COLOUR * full)


def on_ground(pixels: NDArray[Any]) -> NDArray[Any]:
    """Pixels laid on white, or on black if what is visible is mostly light; without alpha."""
    full = full_scale(pixels)
    alpha = pixels[:, :, -1]
    colours = pixels[:, :, :-1]
    if (alpha == full).all():
        flat = colours
    else:
        cover = (alpha / full)[:, :, None]
        mean = (colours * cover).sum() / max(float(cover.sum()) * colours.shape[2], 1e-300)
        ground = 0.0 if mean > 0.5 * full else full
        flat = ground + (colours - ground) * cover
        if pixels.dtype.kind == "u":
            flat = np.rint(flat).astype(pixels.dtype)
    return flat[:, :, 0] if flat.shape[2] == 1 else flat


def _is_coloured(pixels: NDArray[Any]) -> bool:
    """Whether enough pixels differ enough between their channels."""
    if pixels.ndim == 2:
        return False
    layers = [pixels[:, :, k] for k in range(pixels.shape[2])]
    spread = np.maximum.reduce(layers) - np.minimum.reduce(layers)
    return bool((spread > COLOURED_SPREAD * full_scale(pixels)).mean() > COLOURED_PIXELS)


def _grey(pixels: NDArray[Any]) -> NDArray[Any]:
    """Lightness of each pixel, exact if its channels are equal."""
    if pixels.ndim == 2:
        return pixels
    red, green, blue = (pixels[:, :, k] for k in range(3))
    if (red == green).all() and (green == blue).all():
        return red
    return LUMA[0] * red + LUMA[1] * green + LUMA[2] * blue


def _difference(pixels: NDArray[Any]) -> FloatArray:
    """Root mean square difference from the rim's median colour, in the unit of the image.

    A norm of the difference keeps sub-pixel positions: where object and ground mix linearly, it
    is linear in the mixture.
    """
    layers = [pixels] if pixels.ndim == 2 else [pixels[:, :, k] for k in range(pixels.shape[2])]
    squares = np.zeros(pixels.shape[:2])
    for layer in layers:
        squares += (layer - float(np.median(rim(layer)))) ** 2
    return cast("FloatArray", np.sqrt(squares / len(layers)))


def rim(values: NDArray[Any]) -> NDArray[Any]:
    """Values of the picture's rim, as one row."""
    width = max(1, round(RIM * min(values.shape)))
    if 2 * width >= min(values.shape):
        return values.ravel()
    middle = values[width:-width]
    strips = values[:width], values[-width:], middle[:, :width], middle[:, -width:]
    return np.concatenate([strip.ravel() for strip in strips])
