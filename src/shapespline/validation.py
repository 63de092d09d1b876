"""Arguments turned into arrays and numbers, or into one clear sentence why not."""

from __future__ import annotations

import sys
from numbers import Integral, Real
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike, FloatArray, IntArray


def float_array(values: ArrayLike, name: str) -> FloatArray:
    """Values as a fresh C-contiguous float64 array of any shape.

    Raises
    ------
    InvalidInputError
        If they are no real numbers, or rows differ in length; the message begins with the name.

    Examples
    --------
    >>> float_array([1, 2], "weights").tolist()
    [1.0, 2.0]
    """
    if hasattr(values, "__geo_interface__"):
        raise InvalidInputError(
            f"{name} must be an array of numbers, got a geometry ({type(values).__name__}); read"
            " it first: fit_shape(read(geometry))"
        )
    masked = sys.modules.get("numpy.ma")  # whoever has a masked array has imported it
    if masked is not None and isinstance(values, masked.MaskedArray) and masked.is_masked(values):
        raise InvalidInputError(f"{name} must not be masked; drop the masked rows first")
    try:
        array = np.asarray(values)
        if array.dtype.kind in "mM":
            raise TypeError(f"dtype {array.dtype}")
        if array.dtype.kind == "c":
            raise InvalidInputError(
                f"{name} must be real, got complex numbers; pass real and imaginary parts as two"
                " columns"
            )
        return np.array(array, dtype=np.float64, order="C")
    except InvalidInputError:
        raise
    except (TypeError, ValueError) as error:
        raise InvalidInputError(
            f"{name} must be an array of numbers, got {type(values).__name__}: {error}"
        ) from None


def median(values: FloatArray) -> float:
    """Median of a few numbers; numpy's own asks what they are and imports masked arrays (PKG-08).

    Examples
    --------
    >>> median(np.array([3.0, 1.0, 2.0])), median(np.array([4.0, 1.0, 2.0, 3.0]))
    (2.0, 2.5)
    """
    middle = len(values) // 2
    below = middle - 1 + len(values) % 2
    part = np.partition(values, (below, middle))
    return 0.5 * (float(part[below]) + float(part[middle]))


def smallest_of(values: FloatArray, part: float) -> float:
    """The value that a part of all are not above, without numpy's percentile (PKG-08).

    Examples
    --------
    >>> smallest_of(np.array([5.0, 1.0, 4.0, 2.0, 3.0]), 0.75)
    4.0
    """
    k = int(part * (len(values) - 1))
    return float(np.partition(values, k)[k])


def distinct(*indices: IntArray) -> IntArray:
    """All of them, each once, sorted; numpy's own function imports masked arrays (PKG-08)."""
    return np.array(sorted({i for part in indices for i in part.tolist()}), dtype=np.int64)


def is_number(value: object) -> bool:
    """Whether a value is a real number, and neither a truth value nor a text."""
    if type(value) in (float, int):  # at once: to ask an abstract class takes ten times as long
        return True
    return isinstance(value, Real) and not isinstance(value, bool)


def whole_number(value: object) -> int | None:
    """A number without fraction (3, 3.0, numpy.int64(3)) as an int; None for anything else."""
    if type(value) is int:
        return value
    if isinstance(value, bool) or not isinstance(value, Real):
        return None
    if isinstance(value, Integral):
        return int(value)
    return int(float(value)) if float(value).is_integer() else None


def checked_choice(name: str, value: object, choices: tuple[str, ...]) -> None:
    """Raise unless a value is one of some words."""
    if not (isinstance(value, str) and value in choices):
        raise InvalidInputError(f"{name} must be one of {', '.join(choices)}, got {value!r}")


def checked_flag(name: str, value: object) -> bool:
    """A truth value."""
    if not isinstance(value, bool | np.bool_):
        raise InvalidInputError(f"{name} must be True or False, got {value!r}")
    return bool(value)


def checked_indices(name: str, values: ArrayLike, expected: str) -> IntArray:
    """Indices, sorted, each once; ``expected`` is what the message says of them."""
    if isinstance(values, str):
        raise InvalidInputError(f"{name} must be {expected}, got {values!r}")
    given = float_array(values, name)
    if given.ndim > 1 or (given != np.floor(given)).any() or (given < 0).any():
        raise InvalidInputError(f"{name} must be {expected}, got {values!r}")
    return distinct(given.ravel().astype(np.int64))
