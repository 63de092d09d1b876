"""Where a reader reads from: a path as it is; bytes and open files by way of a temporary file."""

from __future__ import annotations

import os
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import IO, TYPE_CHECKING, Any, Protocol

from shapespline.errors import InvalidInputError, ShapesplineError, UnknownFormatError

if TYPE_CHECKING:
    from collections.abc import Iterator


class Geometry(Protocol):
    """What shapely, geopandas and others hold."""

    @property
    def __geo_interface__(self) -> Any:
        """GeoJSON as an object."""


class Glyph(Protocol):
    """What fontTools, ufoLib2, defcon and others hold."""

    def draw(self, pen: Any) -> Any:
        """Draw its outlines with a pen."""


File = str | os.PathLike[str] | bytes | IO[Any]
Source = File | Geometry | Glyph

# How files begin whose kind can be told from that.
BEGINNINGS = (
    (b"\x89PNG", ".png"),
    (b"\xff\xd8\xff", ".jpg"),
    (b"II*\x00", ".tif"),
    (b"MM\x00*", ".tif"),
    (b"BM", ".bmp"),
    (b"\x93NUMPY", ".npy"),
    (b"ISO-10303-21", ".step"),
    (b"3D Geometry File Format", ".3dm"),
)
# Of a text so many bytes are looked at for the root of an SVG document.
HEAD = 4096


@contextmanager
def as_path(source: File, ending: str | None) -> Iterator[Path]:
    """The path of a source; of bytes and open files that of a copy, while the context lasts.

    The kind is told by ``ending``, else by the name of the file, else by the first bytes.

    Examples
    --------
    >>> with as_path(b"0,0", "csv") as path:
    ...     path.name, path.read_bytes()
    ('data.csv', b'0,0')
    """
    if ending is not None and not isinstance(ending, str):
        raise InvalidInputError(f"format must be a file name's ending like '.svg', got {ending!r}")
    dotted = None if ending is None else f".{ending.lower().lstrip('.')}"
    if isinstance(source, str | os.PathLike):
        if dotted is not None and Path(source).suffix.lower() != dotted:
            raise InvalidInputError(
                f"format is for bytes and open files, got {ending!r} for a path; its ending tells"
            )
        yield Path(source)
        return
    name, data = "data", source
    if not isinstance(source, bytes | bytearray | memoryview):
        if not hasattr(source, "read"):
            raise InvalidInputError(
                "path must be a path, bytes, an open file, a geometry or a glyph, got"
                f" {type(source).__name__}; points make a Contour, pixels go to trace"
            )
        given = getattr(source, "name", "")
        name = Path(given).name if isinstance(given, str) and given else name
        data = source.read()
    content = data.encode() if isinstance(data, str) else bytes(data)
    suffix = dotted or Path(name).suffix or _told(content)
    with TemporaryDirectory() as folder:
        path = Path(folder, Path(name).stem + suffix)
        path.write_bytes(content)
        try:
            yield path
        except ShapesplineError as error:
            # The caller knows the name, not the folder.
            if folder not in str(error):
                raise
            raise type(error)(str(error).replace(f"{folder}{os.sep}", "")) from error


def _told(content: bytes) -> str:
    """The ending for what the content begins with."""
    for beginning, suffix in BEGINNINGS:
        if content.startswith(beginning):
            return suffix
    if b"<svg" in content[:HEAD]:
        return ".svg"
    raise UnknownFormatError(
        "the kind of the data cannot be told from its beginning; say it, such as format='.csv'"
    )
