"""From a picture to its Field: what is looked at, what counts as ink, and where it is cut."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from shapespline.errors import (
    DegenerateContourError,
    InvalidInputError,
    PictureWarning,
    caller_level,
)
from shapespline.monitor import silent
from shapespline.tracing.crossings import Crossings, crossings
from shapespline.tracing.enlarged import Enlargement
from shapespline.tracing.falloff import without_falloff
from shapespline.tracing.field import Field
from shapespline.tracing.inks import cut_between_inks, softness_of
from shapespline.tracing.layer import Layer
from shapespline.tracing.level import halfway_to_other, noise_deviation, picture_level
from shapespline.tracing.lighting import (
    ALONG_NOTHING,
    BETTER,
    are_steps,
    evenly_lit,
    part_along_nothing,
)
from shapespline.tracing.linear_light import in_linear_light
from shapespline.tracing.pixels import (
    CHANNELS,
    STRONG,
    Channel,
    colour_distance,
    full_scale,
    has_alpha,
    pixel_values,
    shows_ground,
    validated_pixels,
)
from shapespline.tracing.raised_contrast import as_parts
from shapespline.validation import is_number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.monitor import Say
    from shapespline.typing import ArrayLike

Polarity: TypeAlias = Literal["auto", "dark", "light"]
Local: TypeAlias = float | Literal["auto", "off"]

POLARITIES = ("auto", "dark", "light")
# Lightness tells what a difference of colours does if its outlines are as many, and their lengths
# differ by no more than this part (TRC-21).
ALIKE = 0.05


@dataclass(frozen=True)
class Seeing:
    """How a picture is looked at; as in :func:`shapespline.trace`."""

    level: float | None = None
    polarity: Polarity = "auto"
    channel: Channel = "auto"
    color: str | None = None
    invert: bool = False
    local: Local = "auto"
    blur: float | None = None
    crop: str | Sequence[int] | None = None

    def __post_init__(self) -> None:
        checked_choice("polarity", self.polarity, POLARITIES)
        checked_choice("channel", self.channel, CHANNELS)
        if self.color is not None and (self.channel != "auto" or self.polarity != "auto"):
            raise InvalidInputError("color excludes channel and polarity: give one way to see ink")
        if self.blur is not None and not (is_number(self.blur) and 0 <= self.blur < np.inf):
            raise InvalidInputError(
                f"blur must be a number of pixels, at least 0, got {self.blur!r}"
            )
        if self.local not in ("auto", "off") and not is_number(self.local):
            raise InvalidInputError(
                f"local must be auto, off or a window in pixels, got {self.local!r}"
            )
        if self.level is not None and is_number(self.local):
            raise InvalidInputError("level is one for the whole picture: leave out local, or level")

    def field(self, image: ArrayLike, say: Say = silent) -> tuple[Field, Crossings]:
        """The picture as ink and ground, and the border between them.

        A warning tells if the level was found to have to follow the light.
        """
        pixels = cropped(validated_pixels(image), self.crop)
        free = self.local == "auto" and self.level is None and self.color is None
        if free:
            pixels = evened(pixels, say)
        say("looking for ink")
        field, found = self._cut(pixels, say)
        enlarged = Enlargement.of(field)
        if enlarged.factor > 1:
            say(f"looking at the picture as it was before it was enlarged by {enlarged.factor}")
            field = enlarged.undone(field)
            found = crossings(field, say)
            parts = as_parts(field, found) if free and not self.blur else None
            if parts is not None:
                field = replace(parts, scale=field.scale, interpolated=field.interpolated)
                found = crossings(field, say)
        between = cut_between_inks(field, found) if free else None
        if between is None:
            return field, found
        return between, crossings(between, say)

    def _cut(self, pixels: NDArray[Any], say: Say) -> tuple[Field, Crossings]:
        """Where one level parts ink and ground, or one that follows the light."""
        values, light, differs = self._values(pixels)
        if is_number(self.local):
            field = cut_field(evenly_lit(values, light, float(self.local)), light)
            return field, crossings(field, say)
        level = self.level
        if self.color is not None and level is None and not self.blur:
            level = halfway_to_other(values, full_scale(pixels))
        field = cut_field(values, light, level)
        found = crossings(field, say)
        if level is None and not self.blur:
            parts = as_parts(field, found)
            # Copies of pixels have steps and waves, too (TRC-38).
            if parts is not None and Enlargement.of(field).factor == 1:
                say("looking at the picture as it was before its contrast was raised")
                return parts, crossings(parts, say)
        if level is None and not (differs or self.blur or has_alpha(pixels)):
            linear = in_linear_light(field, found, full_scale(pixels))
            if linear is not None and not Enlargement.of(field).copied:
                say("looking at the picture as light, which its ink and ground were mixed as")
                return linear, crossings(linear, say)
        if differs and self.channel == "auto" and self.color is None:
            return self._by_lightness(pixels, field, found, say)
        if self.local == "off" or self.level is not None or differs:
            return field, found
        astray = part_along_nothing(field, found)
        if astray <= ALONG_NOTHING:
            return field, found
        # Where the light falls off, the rim does not show what the ground is.
        told = self.polarity != "auto"
        most = min(BETTER * astray, ALONG_NOTHING)
        edges = BETTER * (1 - astray) * len(found.row)
        ways = []
        for ink in (light,) if told else (light, not light):
            say("looking for the light on the ground")
            even = cut_field(evenly_lit(values, ink), ink)
            try:
                found_even = crossings(even, say)
            except DegenerateContourError:  # noise once its light is even
                continue
            left = part_along_nothing(even, found_even)
            enough = left <= most and (1 - left) * len(found_even.row) >= edges
            if enough and not are_steps(values, found_even):
                ways.append((left, len(found_even.row), (even, found_even)))
        if not ways:
            return field, found
        warnings.warn(
            "the ground is unevenly lit, so the level follows it:"
            " --local off (local='off') cuts at one level",
            PictureWarning,
            stacklevel=caller_level(),
        )
        # Of two that leave as much the shorter border.
        return min(ways, key=lambda way: way[:2])[2]

    def _by_lightness(
        self, pixels: NDArray[Any], field: Field, found: Crossings, say: Say
    ) -> tuple[Field, Crossings]:
        """The lightness of blurred colours where it tells the same: a camera sees it more sharply.

        Colours are seen by every other pixel, and kept so by JPEG (TRC-21).
        """
        if not softness_of(field, found).blur:
            return field, found
        try:
            values, light, _ = replace(self, channel="grey")._values(pixels)
            grey = cut_field(values, light)
            found_grey = crossings(grey, say)
        except DegenerateContourError:  # of one lightness
            return field, found
        few = abs(len(found_grey.row) - len(found.row)) <= ALIKE * len(found.row)
        same = few and len(found_grey.loops) == len(found.loops)
        if same and grey.contrast >= STRONG * field.contrast:
            return grey, found_grey
        return field, found

    def _values(self, pixels: NDArray[Any]) -> tuple[Layer, bool, bool]:
        """One value for each pixel, whether ink is light, and whether it differs from a colour."""
        if self.color is not None:
            values, light, is_difference = colour_distance(pixels, self.color), False, True
        else:
            lightness = self.level is not None or self.polarity != "auto"
            values, is_difference, is_alpha = pixel_values(
                pixels, self.channel, lightness=lightness
            )
            if self.polarity == "auto":
                cut = picture_level(values, self.level).cut
                ground = shows_ground(pixels)(values)
                light = is_difference or is_alpha or float(np.median(ground)) < cut
            else:
                light = self.polarity == "light"
        if self.blur:
            from scipy.ndimage import gaussian_filter

            whole = values[:].astype(np.float64)
            values = Layer(gaussian_filter(whole, self.blur, mode="nearest"))
        return values, light != self.invert, is_difference


def cut_field(values: Layer, light: bool, level: float | None = None) -> Field:
    """Values cut where ink and ground part."""
    found = picture_level(values, level)
    contrast = found.light - found.dark
    noise = noise_deviation(values, contrast) / contrast
    # A level that was asked for is half-way to what is drawn.
    middle = 0.5 * (found.dark + found.light) if level is None else found.cut
    return Field(values, found.cut, light, contrast, noise, middle)


def evened(pixels: NDArray[Any], say: Say) -> NDArray[Any]:
    """The picture without the light that falls off over it, which a warning tells."""
    say("looking for the light on the picture")
    even = None if has_alpha(pixels) else without_falloff(pixels)
    if even is None:
        return pixels
    warnings.warn(
        "the picture is unevenly lit, so it is looked at as an even light would show it:"
        " --local off (local='off') leaves it as it is",
        PictureWarning,
        stacklevel=caller_level(),
    )
    return even


def cropped(pixels: NDArray[Any], crop: str | Sequence[int] | None) -> NDArray[Any]:
    """A part of a picture, given by column and row of its upper left pixel, width and height.

    Examples
    --------
    >>> cropped(np.arange(12).reshape(3, 4), "1,0,2,2").tolist()
    [[1, 2], [5, 6]]
    """
    if crop is None:
        return pixels
    expected = f"crop must be column,row,width,height in whole pixels, got {crop!r}"
    try:
        given = [int(part) for part in (crop.split(",") if isinstance(crop, str) else crop)]
        x, y, width, height = given
    except (TypeError, ValueError):
        raise InvalidInputError(expected) from None
    rows, columns = pixels.shape[:2]
    if width < 1 or height < 1 or x < 0 or y < 0 or x + width > columns or y + height > rows:
        raise InvalidInputError(
            f"crop {x},{y},{width},{height} does not lie within the picture of {columns} x {rows}"
        )
    return pixels[y : y + height, x : x + width]


def checked_choice(name: str, value: str, choices: tuple[str, ...]) -> None:
    """Raise unless the value is one of the choices."""
    if value not in choices:
        raise InvalidInputError(f"{name} must be one of {', '.join(choices)}, got {value!r}")
