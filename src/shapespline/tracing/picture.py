"""Pictures, through Pillow: decoded, turned upright, in one of the layouts that tracing knows."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageOps, UnidentifiedImageError

from shapespline.errors import FormatError, PictureWarning, caller_level

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

# Told by content, not by ending. Pillow knows more, among them formats that start programs.
CONTENTS = ("PNG", "JPEG", "TIFF", "BMP", "WEBP", "GIF")
# Pixels, which are decoded at once: four bytes for each, twice for a while, but one or two of grey.
# Pillow knows no larger ones than the second. Larger arrays are traced strip by strip.
LARGEST_IMAGE, LARGEST_GREY = 80_000_000, 175_000_000


def load(path: Path) -> NDArray[Any]:
    """Pixels of a picture as :func:`shapespline.trace` takes them, turned upright.

    Of several pages the first. Palettes and other colour models become RGB; 16-bit grey stays.

    Returns
    -------
    ndarray, shape (h, w) or (h, w, c)
        uint8, uint16 or float64.
    """
    with path.open("rb") as file, warnings.catch_warnings():
        # Pillow warns of what it may take for a bomb; here there are limits of our own.
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        # Damaged metadata says nothing about the pixels.
        warnings.filterwarnings("ignore", category=UserWarning, module="PIL")
        try:
            picture = Image.open(file, formats=CONTENTS)
            _check_size(picture)
            _note_frames(picture)
            return _pixels(_upright(picture))
        except UnidentifiedImageError as error:
            raise FormatError(
                "not a PNG, JPEG, TIFF, BMP, WebP or GIF picture, or damaged from the start"
            ) from error
        except Image.DecompressionBombError as error:
            raise FormatError(_too_large(LARGEST_GREY)) from error
        except (FormatError, MemoryError, PictureWarning):
            raise
        except Exception as error:  # decoders raise whatever damage makes them stumble over
            raise FormatError(f"the picture is damaged or cut off: {error}") from error


def _note_frames(picture: Image.Image) -> None:
    """Tell if there are more frames or pages than the one that is looked at."""
    count = getattr(picture, "n_frames", 1)
    if count > 1:
        warnings.warn(
            f"the picture has {count} frames or pages: the first one is looked at; save another one"
            " as a file of its own",
            PictureWarning,
            stacklevel=caller_level(),
        )


def _check_size(picture: Image.Image) -> None:
    is_grey = picture.mode in ("1", "L") or picture.mode.startswith("I;16")
    most = LARGEST_GREY if is_grey else LARGEST_IMAGE
    if picture.width * picture.height > most:
        raise FormatError(_too_large(most, f"{picture.width} x {picture.height} pixels, "))


def _too_large(most: int, size: str = "") -> str:
    return (
        f"the picture has {size}more than {most // 10**6} megapixels; scale it down, or give"
        " shapespline.trace its pixels as an array, such as a numpy.memmap"
    )


def _upright(picture: Image.Image) -> Image.Image:
    """Decode, and turn the way the camera was held, as viewers do."""
    picture.load()
    try:
        ImageOps.exif_transpose(picture, in_place=True)
    except Exception:  # unreadable EXIF data must not cost the picture
        return picture
    return picture


def _pixels(picture: Image.Image) -> NDArray[Any]:
    """Pixels in one of the few layouts that tracing knows."""
    mode = picture.mode
    if mode.startswith("I;16"):
        return np.asarray(picture).astype(np.uint16)
    if mode == "I":
        values = np.asarray(picture)
        # Some readers give 16-bit pictures as 32-bit integers.
        fits = values.min() >= 0 and values.max() <= np.iinfo(np.uint16).max
        return values.astype(np.uint16 if fits else np.float64)
    if mode == "F":
        return np.asarray(picture, dtype=np.float64)
    is_grey = mode in ("1", "L", "LA", "La")
    has_alpha = mode in ("LA", "La", "PA", "RGBA", "RGBa") or "transparency" in picture.info
    wanted = ("LA" if has_alpha else "L") if is_grey else ("RGBA" if has_alpha else "RGB")
    # A copy of a large picture is spared.
    return np.asarray(picture if mode == wanted else picture.convert(wanted))


def pixels_of(picture: Image.Image) -> NDArray[Any]:
    """Pixels of a picture that Pillow holds, turned upright, as `load` gives those of a file."""
    _check_size(picture)
    return _pixels(_upright(picture))
