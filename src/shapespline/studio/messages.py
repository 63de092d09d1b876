"""Messages: a header in JSON, arrays in binary after it; the same frame in both directions.

Four bytes say how long the header is (little endian), which is padded to a multiple of four, so
that the arrays behind it lie where a browser can read them in place. ``arrays`` of the header says
name, kind, shape and first byte of each.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from collections.abc import Mapping

KINDS: dict[str, np.dtype[Any]] = {"f": np.dtype("<f4"), "i": np.dtype("<i4"), "u": np.dtype("u1")}
LENGTH = 4
# What a header of the page says at most: lists of indices of some thousand points.
MOST_HEADER = 4_000_000


def packed(header: Mapping[str, Any], arrays: Mapping[str, np.ndarray] | None = None) -> bytes:
    """A message as bytes; numbers with a point go as float32, others as int32 or bytes.

    Examples
    --------
    >>> message = packed({"type": "shape"}, {"points": np.array([[1.0, 2.0]])})
    >>> unpacked(message)[0]["arrays"]
    {'points': ['f', [1, 2], 0]}
    """
    table, parts, at = {}, [], 0
    for name, array in (arrays or {}).items():
        kind = "u" if array.dtype == np.uint8 else "f" if array.dtype.kind == "f" else "i"
        content = np.ascontiguousarray(array, dtype=KINDS[kind]).tobytes()
        content += b"\0" * (-len(content) % LENGTH)
        table[name] = [kind, list(array.shape), at]
        parts.append(content)
        at += len(content)
    text = json.dumps({**header, "arrays": table}, allow_nan=False).encode()
    text += b" " * (-len(text) % LENGTH)
    return b"".join([len(text).to_bytes(LENGTH, "little"), text, *parts])


def unpacked(message: bytes) -> tuple[dict[str, Any], bytes]:
    """The header of a message, and what comes behind it.

    Raises
    ------
    InvalidInputError
        If it is no message.
    """
    length = int.from_bytes(message[:LENGTH], "little")
    text = message[LENGTH : LENGTH + length]
    try:
        if not 0 < length <= MOST_HEADER or len(text) != length:
            raise ValueError("no header")
        header = json.loads(text)
    except ValueError as error:
        raise InvalidInputError(
            f"message must begin with a header of JSON, got {len(message)} bytes that do not;"
            " reload the page"
        ) from error
    if not isinstance(header, dict) or not isinstance(header.get("type"), str):
        raise InvalidInputError("message must say its type in its header; reload the page")
    return header, message[LENGTH + length :]
