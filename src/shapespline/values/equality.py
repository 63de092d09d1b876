"""Equality and hash by value, for dataclasses that hold arrays."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator


class ByValue:
    """Equal to an object of the same class whose fields are equal, arrays element by element.

    Fields named in ``_BESIDE`` tell how the value was found and are not compared.
    """

    _BESIDE: ClassVar[frozenset[str]] = frozenset()

    def _compared(self) -> Iterator[Any]:
        # Every user is a dataclass; this base is none, so that it adds no field.
        for field in fields(self):  # type: ignore[arg-type]
            if field.name not in self._BESIDE:
                yield getattr(self, field.name)

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if not isinstance(other, ByValue) or type(other) is not type(self):
            return NotImplemented
        return all(map(same, self._compared(), other._compared()))

    def __hash__(self) -> int:
        return hash((type(self), *map(hashed, self._compared())))


def same(one: Any, other: Any) -> bool:
    """Whether two values are equal, arrays by shape and elements, NaN with NaN."""
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return one.shape == other.shape and bool(((one == other) | _both_nan(one, other)).all())
    if type(one) is tuple and type(other) is tuple:
        return len(one) == len(other) and all(map(same, one, other))
    return bool(one == other)


def _both_nan(one: np.ndarray[Any, Any], other: np.ndarray[Any, Any]) -> Any:
    return (one != one) & (other != other)


def hashed(value: Any) -> int:
    """A hash that equal values share: of an array that of its elements, without negative zeros.

    Examples
    --------
    >>> hashed(np.array([0.0, 1.0])) == hashed(np.array([-0.0, 1.0]))
    True
    """
    if isinstance(value, np.ndarray):
        return hash((value.shape, (value + 0.0).tobytes()))
    if type(value) is tuple:
        return hash(tuple(map(hashed, value)))
    return hash(value)
