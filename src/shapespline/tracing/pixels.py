"""Pictures to one value per pixel: lightness, a channel, alpha, or distance from the ground."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, cast

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.tracing.layer import Layer, strips
from shapespline.tracing.level import noise_deviation

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from shapespline.typing import ArrayLike, FloatArray, IntArray

    # What is made of pixels, whichever they are.
    Work: TypeAlias = Callable[[NDArray[Any]], NDArray[Any]]

Channel: TypeAlias = Literal["auto", "grey", "red", "green", "blue", "alpha", "difference"]

CHANNELS = ("auto", "grey", "red", "green", "blue", "alpha", "difference")

# Rec. ITU-R BT.601-7, section 2.5.1: the luma weights that Pillow and most viewers use.
LUMA = (0.299, 0.587, 0.114)
# Lightness tells colours apart that differ in it by so much of what they differ by (TRC-21).
STRONG = 0.6
# Median of the mean square of three normal variables, of their variance (TRC-45).
GROUND_NOISE = 0.789
# Width of the rim that shows the background, as a part of the shorter side: wider than the thin
# frames that programs draw around pictures.
RIM = 0.02
# Corners show the ground if they differ by no more than the first part of the full scale, and are
# lighter than most of the rim by the second; where fewer than four are, no more than the third part
# of the rim is dark. A frame leaves less than the last part of the outermost pixels as dark
# (TRC-24).
ALIKE, LIGHTER, LITTLE_MORE, FRAMED = 0.1, 0.25, 2 / 3, 0.2
# A picture is coloured if this part of its pixels spreads this far over its channels: more than
# JPEG leaves of a grey scan.
COLOURED_PIXELS = 0.001
COLOURED_SPREAD = 0.1
# Visible pixels this close (part of the full scale) are one colour: the shape is in the alpha.
ONE_COLOUR = 0.02


class PixelValues(NamedTuple):
    """One value per pixel, whether it is the distance from the ground, or how opaque it is."""

    values: Layer
    is_difference: bool = False
    is_alpha: bool = False


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


def colour_distance(pixels: NDArray[Any], color: str) -> Layer:
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
    >>> colour_distance(image, "red")[:].round().tolist()
    [[147.0, 0.0]]
    >>> colour_distance(image, "@0,0")[:].tolist()
    [[0.0, 147.22431864335456]]
    """
    layers = _layers_of(pixels)
    wanted = _colour(color, pixels)
    noise = _noise_squared(pixels)

    def distance(part: NDArray[Any]) -> FloatArray:
        found = layers(part)
        squares = sum((found[k % len(found)] - wanted[k]) ** 2 for k in range(3))
        return _without(noise, squares / 3)

    return Layer(pixels, distance)


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
        own = [layer[0, 0] for layer in _layers_of(pixels)(pixels[row : row + 1, [column]])]
        return np.resize(np.array(own, dtype=np.float64), 3)
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
        As in :func:`shapespline.trace`.
    lightness : bool
        Whether "auto" has to be lightness.

    Raises
    ------
    InvalidInputError
        If the picture does not have the channel.
    """
    transparent = has_alpha(pixels)
    if channel == "alpha" and not transparent:
        raise InvalidInputError("channel 'alpha' needs a picture with transparency; leave it out")
    free = channel == "auto" and not lightness
    if channel == "alpha" or (free and transparent and _is_one_colour(pixels)):
        return PixelValues(Layer(pixels, lambda part: part[..., -1]), is_alpha=True)
    laid = _laid(pixels)
    is_grey = pixels.ndim == 2 or pixels.shape[2] == 2
    if channel in ("red", "green", "blue"):
        if is_grey:
            raise InvalidInputError(f"channel {channel!r} needs a colour picture; use 'grey'")
        index = ("red", "green", "blue").index(channel)
        return PixelValues(Layer(pixels, lambda part: laid(part)[..., index]))
    if channel == "difference" or (free and not is_grey and _is_coloured(pixels)):
        return PixelValues(_difference(pixels), is_difference=True)
    return PixelValues(Layer(pixels, laid) if is_grey else _grey(pixels))


def full_scale(pixels: NDArray[Any]) -> float:
    """Value of white and opaque: the largest integer, or 1 for floats."""
    return float(np.iinfo(pixels.dtype).max) if pixels.dtype.kind == "u" else 1.0


def has_alpha(pixels: NDArray[Any]) -> bool:
    """Whether the last channel is one of opacity."""
    return pixels.ndim == 3 and pixels.shape[2] in (2, 4)


def _is_one_colour(pixels: NDArray[Any]) -> bool:
    """Whether all pixels that are more than half opaque look alike, some pixel being clear."""
    full = full_scale(pixels)
    n_visible, ends = 0, []
    for rows in strips(pixels.shape):
        visible = pixels[rows][pixels[rows][:, :, -1] > 0.5 * full][:, :-1]
        n_visible += len(visible)
        if len(visible):
            ends += [visible.min(axis=0), visible.max(axis=0)]
    if n_visible in (0, pixels.shape[0] * pixels.shape[1]):
        return False
    return bool(np.ptp(np.array(ends, dtype=np.float64), axis=0).max() <= ONE_COLOUR * full)


def on_ground(pixels: NDArray[Any]) -> NDArray[Any]:
    """Pixels laid on white, or on black if what is visible is mostly light; without alpha."""
    return _laid(pixels)(pixels)


def _laid(pixels: NDArray[Any]) -> Work:
    """What lays pixels of a picture on white or black; grey ones have no axis of channels then."""
    if not has_alpha(pixels):
        return lambda part: part
    full = full_scale(pixels)
    ground = _ground(pixels, full)

    def laid(part: NDArray[Any]) -> NDArray[Any]:
        flat = part[..., :-1]
        if ground is not None:
            flat = ground + (flat - ground) * (part[..., -1:] / full)
            if pixels.dtype.kind == "u":
                flat = np.rint(flat).astype(pixels.dtype)
        return flat[..., 0] if pixels.shape[2] == 2 else flat

    return laid


def _ground(pixels: NDArray[Any], full: float) -> float | None:
    """White, black if what is visible is mostly light, or None where all is opaque."""
    opaque, ink, cover = True, 0.0, 0.0
    for rows in strips(pixels.shape):
        alpha = pixels[rows][:, :, -1]
        opaque = opaque and bool((alpha == full).all())
        share = (alpha / full)[:, :, None]
        ink += float((pixels[rows][:, :, :-1] * share).sum())
        cover += float(share.sum()) * (pixels.shape[2] - 1)
    if opaque:
        return None
    return 0.0 if ink > 0.5 * full * max(cover, 1e-300) else full


def _layers_of(pixels: NDArray[Any]) -> Callable[[NDArray[Any]], list[NDArray[Any]]]:
    """What gives the channels of pixels laid on a ground: one, or red, green and blue."""
    laid = _laid(pixels)
    if pixels.ndim == 2 or pixels.shape[2] == 2:
        return lambda part: [laid(part)]
    return lambda part: list(np.moveaxis(laid(part), -1, 0))


def _is_coloured(pixels: NDArray[Any]) -> bool:
    """Whether enough pixels differ enough between their channels."""
    count, layers_of = 0, _layers_of(pixels)
    least = COLOURED_PIXELS * pixels.shape[0] * pixels.shape[1]
    for rows in strips(pixels.shape):
        layers = layers_of(pixels[rows])
        spread = np.maximum.reduce(layers) - np.minimum.reduce(layers)
        count += int((spread > COLOURED_SPREAD * full_scale(pixels)).sum())
        if count > least:
            return True
    return False


def _grey(pixels: NDArray[Any]) -> Layer:
    """Lightness of each pixel, exact if its channels are equal."""
    equal, layers_of = True, _layers_of(pixels)
    for rows in strips(pixels.shape):
        red, green, blue = layers_of(pixels[rows])
        equal = equal and bool((red == green).all() and (green == blue).all())
    if equal:
        return Layer(pixels, lambda part: layers_of(part)[0])

    def luma(part: NDArray[Any]) -> NDArray[Any]:
        red, green, blue = layers_of(part)
        return np.asarray(LUMA[0] * red + LUMA[1] * green + LUMA[2] * blue)

    return Layer(pixels, luma)


def _difference(pixels: NDArray[Any]) -> Layer:
    """Root mean square difference from the colour of the ground, in the unit of the image.

    A norm of the difference keeps sub-pixel positions: where object and ground mix linearly, it
    is linear in the mixture.
    """
    layers_of = _layers_of(pixels)
    ground = [float(np.median(layer)) for layer in layers_of(shows_ground(pixels)(pixels))]
    noise = _noise_squared(pixels)

    if pixels.dtype == np.uint8:  # squares are looked up: half the time
        tables = [(np.arange(256.0) - one) ** 2 for one in ground]

    def difference(part: NDArray[Any]) -> FloatArray:
        layers = layers_of(part)
        if pixels.dtype == np.uint8:
            squares = tables[0][layers[0]]
            for layer, table in zip(layers[1:], tables[1:], strict=True):
                squares += table[layer]
        else:
            squares = sum((layer - one) ** 2 for layer, one in zip(layers, ground, strict=True))
        return _without(noise, squares / len(ground))

    return Layer(pixels, difference)


def _noise_squared(pixels: NDArray[Any]) -> float:
    """What noise alone has for a mean square difference, in the median over pixels."""
    layers_of, full = _layers_of(pixels), full_scale(pixels)

    def variance(k: int) -> float:
        return noise_deviation(Layer(pixels, lambda part: layers_of(part)[k]), full) ** 2

    count = len(layers_of(pixels[:1]))
    return GROUND_NOISE * sum(variance(k) for k in range(count)) / count


def _without(noise: float, squares: FloatArray) -> FloatArray:
    """Roots of mean squares less what noise adds to them: the ground is nothing in the median."""
    left = squares - noise
    return cast("FloatArray", np.copysign(np.sqrt(np.abs(left)), left))


def shows_ground(pixels: NDArray[Any]) -> Callable[[NDArray[Any] | Layer], NDArray[Any]]:
    """What takes the pixels of a picture's values that show the ground: its rim, or its corners.

    The corners do around a figure with round corners that fills the picture: they are clear, or
    alike and lighter than most of the rim, as paper is, and the picture has no frame. Some of them
    do so beside a figure that fills little more than half of the rim (TRC-24).
    """
    four = np.arange(4)
    if has_alpha(pixels) and (corners(pixels, four)[:, -1] < 0.5 * full_scale(pixels)).all():
        return partial(corners, which=four)
    layers_of = _layers_of(pixels)

    def lightness(part: NDArray[Any]) -> FloatArray:
        return np.mean([np.asarray(layer, dtype=np.float64) for layer in layers_of(part)], axis=0)

    at_rim, at_corners = lightness(rim(pixels)), lightness(corners(pixels, four))
    lightest = at_corners.max()
    full = max(full_scale(pixels), lightest - at_rim.min())  # floats may have any range
    light = np.flatnonzero(at_corners >= lightest - ALIKE * full)
    darker = lightest - LIGHTER * full
    if np.median(at_rim) > darker:
        return rim
    if len(light) < 4 and (at_rim <= darker).mean() > LITTLE_MORE:
        return rim
    if (lightness(rim(pixels, 1)) <= darker).mean() <= FRAMED:
        return rim
    return partial(corners, which=light)


def corners(values: NDArray[Any] | Layer, which: IntArray) -> NDArray[Any]:
    """Pixels in some corners of a picture, of upper left, upper right, lower left, lower right."""
    height, width = values.shape[:2]
    return values[which // 2 * (height - 1), which % 2 * (width - 1)]


def rim(values: NDArray[Any] | Layer, wide: int | None = None) -> NDArray[Any]:
    """Pixels of the picture's rim, one after the other."""
    height, width = values.shape[:2]
    if wide is None:
        wide = max(1, round(RIM * min(height, width)))
    if 2 * wide >= min(height, width):
        sides = [values[:]]
    else:
        inner = slice(wide, -wide)
        sides = [values[:wide], values[-wide:], values[inner, :wide], values[inner, -wide:]]
    return np.concatenate([part.reshape(-1, *part.shape[2:]) for part in sides])
