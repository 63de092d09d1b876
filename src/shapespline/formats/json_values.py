"""Values of a JSON document, checked: each function takes a value and where it stands."""

from __future__ import annotations

import json
import math
import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import FormatError
from shapespline.values import Stroke

if TYPE_CHECKING:
    from shapespline.typing import FloatArray


def without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """The fields of an object."""
    fields = dict(pairs)
    if len(fields) < len(pairs):
        names = [name for name, _ in pairs]
        raise FormatError(f"the field {max(names, key=names.count)!r} is given twice")
    return fields


def refused(constant: str) -> float:
    """Infinite numbers and NaN are none of JSON."""
    raise FormatError(f"numbers must be finite, found {constant}")


def checked_object(value: object, where: str, names: tuple[str, ...]) -> dict[str, Any]:
    """Return an object with exactly these fields."""
    if not isinstance(value, dict):
        raise FormatError(f"{where} must be an object, found {_kind(value)}")
    for name in names:
        if name not in value:
            raise FormatError(f"{where} lacks the field {name!r}")
    for name in value:
        if name not in names:
            raise FormatError(f"{where} has an unknown field {name!r}")
    return value


def checked_list(value: object, where: str) -> list[Any]:
    """Return an array."""
    if not isinstance(value, list):
        raise FormatError(f"{where} must be an array, found {_kind(value)}")
    return value


def checked_string(value: object, where: str) -> str:
    """Return a string."""
    if not isinstance(value, str):
        raise FormatError(f"{where} must be a string, found {_kind(value)}")
    return value


def checked_boolean(value: object, where: str) -> bool:
    """Return true or false."""
    if not isinstance(value, bool):
        raise FormatError(f"{where} must be true or false, found {_kind(value)}")
    return value


def checked_integer(value: object, where: str) -> int:
    """Return an integer."""
    # Beyond 2^53 other programs round, and nothing here counts that far.
    if not isinstance(value, int) or isinstance(value, bool) or abs(value) > 2**53:
        raise FormatError(f"{where} must be an integer, found {_kind(value)}")
    return value


def checked_number(value: object, where: str) -> float:
    """Return a float; programs that rewrite a file may have dropped the .0 of a whole number."""
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise FormatError(f"{where} must be a number, found {_kind(value)}")
    if abs(value) > sys.float_info.max:  # 1e999, or an integer of as many digits
        raise FormatError(f"{where} must be a number in the range of doubles")
    return float(value)


def checked_number_or_null(value: object, where: str) -> float:
    """Return a float, NaN for null."""
    return math.nan if value is None else checked_number(value, where)


def checked_numbers(value: object, where: str) -> FloatArray:
    """Return an array of floats, shape (n,)."""
    items = checked_list(value, where)
    return np.array(
        [checked_number(item, f"{where}[{i}]") for i, item in enumerate(items)], dtype=float
    )


def checked_points(value: object, where: str) -> FloatArray:
    """Return an array of points, shape (n, 2)."""
    rows = [
        checked_numbers(item, f"{where}[{i}]") for i, item in enumerate(checked_list(value, where))
    ]
    wrong = next((index for index, row in enumerate(rows) if len(row) != 2), None)
    if wrong is not None:
        raise FormatError(f"{where}[{wrong}] must hold x and y, found {len(rows[wrong])} numbers")
    return np.array(rows, dtype=float).reshape(-1, 2)


def checked_indices(value: object, where: str, first: int, count: int) -> list[int]:
    """Return integers from ``first`` to ``count - 1``."""
    indices = [
        checked_integer(item, f"{where}[{i}]") for i, item in enumerate(checked_list(value, where))
    ]
    for position, index in enumerate(indices):
        if not first <= index < count:
            raise FormatError(
                f"{where}[{position}] must be from {first} to {count - 1}, found {index}"
            )
    return indices


def stroke_or_null(value: object, where: str) -> Stroke | None:
    """How a stroke looks, written as its three words."""
    if value is None:
        return None
    words = checked_list(value, where)
    if len(words) != len(Stroke._fields):
        raise FormatError(f"{where} must be null or {', '.join(Stroke._fields)}, found {words!r}")
    return Stroke(*(checked_string(word, where) for word in words))


def _kind(value: object) -> str:
    """Name a JSON value for a message."""
    if isinstance(value, dict | list):
        return "an object" if isinstance(value, dict) else "an array"
    text = json.dumps(value)
    return text if len(text) <= 40 else f"{text[:37]}..."
