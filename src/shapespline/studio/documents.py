"""Documents: what a user opened, read within limits, never from a path that a page names."""

from __future__ import annotations

import io
import re
import threading
import warnings
from dataclasses import dataclass, field
from functools import cache
from pathlib import PurePosixPath, PureWindowsPath
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.analysis import looks_shuffled
from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats import FORMATS, read, readable
from shapespline.studio.examples import EXAMPLES, example_bytes
from shapespline.values import Contour, Drawing, Shape

if TYPE_CHECKING:
    from collections.abc import Mapping

    from shapespline.monitor import Say
    from shapespline.typing import FloatArray, IntArray

MOST_BYTES = 64_000_000
MOST_OUTLINES = 20_000
MOST_POINTS = 5_000_000
# The page draws no more points than this of a document; fits see all of them.
MOST_DRAWN = 20_000
LONGEST_NAME = 80
PICTURES = next(entry.suffixes for entry in FORMATS if entry.name == "image")
# Options of `read` that a page may say; others, and those of other formats, are refused there.
OPTIONS = {
    "level", "polarity", "channel", "color", "contours", "min_area", "invert", "local", "blur",
    "crop", "colors", "centerline", "unit", "scale", "dpi", "closed", "y_down", "unordered",
    "columns",
}  # fmt: skip
# Warnings are caught by a switch of the whole process: one document is read at a time.
_READING = threading.Lock()


@dataclass(frozen=True, eq=False)
class Document:
    """What was opened: outlines, the file that they came from, what the reader said of it.

    ``origin`` is subtracted from what is drawn, which goes as float32.
    """

    name: str
    content: bytes = field(repr=False)
    options: Mapping[str, Any]
    shape: Shape
    sentences: tuple[str, ...] = ()

    @property
    def is_picture(self) -> bool:
        """Whether the file is a picture, which has a level and specks."""
        return PurePosixPath(self.name).suffix.lower() in PICTURES

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Least and largest x and y of all points: x, y, x, y."""
        low = np.min([contour.points.min(axis=0) for contour in self.shape], axis=0)
        high = np.max([contour.points.max(axis=0) for contour in self.shape], axis=0)
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    @property
    def origin(self) -> FloatArray:
        """Middle of the box."""
        x, y, right, top = self.box
        return np.array([0.5 * (x + right), 0.5 * (y + top)])


def safe_name(name: object) -> str:
    r"""The last part of a file's name, without what could lead elsewhere.

    Examples
    --------
    >>> safe_name("../../etc/pass wd.svg"), safe_name("C:\\dir\\a<b>.PNG"), safe_name("..")
    ('pass wd.svg', 'a_b_.PNG', '_')
    """
    last = PureWindowsPath(str(name)).name or "_"
    clean = re.sub(r"[^\w.\- ()]", "_", last)
    clean = "_" if not clean.strip(". ") else clean
    stem, suffix = PurePosixPath(clean).stem, PurePosixPath(clean).suffix
    return stem[: LONGEST_NAME - len(suffix[:10])] + suffix[:10]


def checked(name: object, content: bytes, options: Mapping[str, Any]) -> str:
    """The name of a file, if it may be read: its size, its ending, and the options.

    Raises
    ------
    InvalidInputError, FormatError
        If the file is too large or of no known kind, or an option is not known.
    """
    name = safe_name(name)
    if len(content) > MOST_BYTES:
        raise InvalidInputError(
            f"{name}: files must have at most {MOST_BYTES // 1_000_000} MB, got"
            f" {len(content) / 1e6:.0f}; use the command line for larger ones"
        )
    if PurePosixPath(name).suffix.lower() not in readable():
        raise FormatError(
            f"{name}: no reader for this ending; readable endings: {' '.join(readable())}"
        )
    for option in options:
        if option not in OPTIONS:
            raise InvalidInputError(f"{option} is no option of reading; reload the page")
    return name


def opened(
    name: object, content: bytes, options: Mapping[str, Any], say: Say | None = None
) -> Document:
    """The document that some bytes are; told what comes next, `say` may raise to end the reading.

    Raises
    ------
    InvalidInputError, FormatError
        If the file is too large, of no known kind, broken, or without an outline.
    """
    name = checked(name, content, options)
    given = {option: value for option, value in options.items() if value not in (None, "", False)}
    file = io.BytesIO(content)
    file.name = name
    with _READING, warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        found = read(file, progress=say, **given)
    shape = found.shape if isinstance(found, Drawing) else found
    sentences = [
        str(warning.message) for warning in said if warning.category is not ResourceWarning
    ]
    n_points = sum(len(contour) for contour in shape)
    if len(shape) > MOST_OUTLINES or n_points > MOST_POINTS:
        raise InvalidInputError(
            f"{name}: a document must have at most {MOST_OUTLINES} outlines and {MOST_POINTS}"
            f" points, got {len(shape)} and {n_points}; leave out specks, or use the command line"
        )
    if any(looks_shuffled(contour) for contour in shape):
        sentences.append("The points look shuffled: tick 'in no order' to have them sorted.")
    return Document(name, content, dict(options), shape, tuple(dict.fromkeys(sentences)))


@cache
def opened_example(name: str) -> Document:
    """The document of an example; nothing changes it, so all pages share it."""
    content = example_bytes(name)
    return opened(EXAMPLES[name].file, content, {})


def drawn_points(contour: Contour, most: int, cell: float) -> IntArray:
    """Indices of the points that are drawn: all of few; of many the first in each cell passed.

    Parameters
    ----------
    contour : Contour
    most : int
        How many may be drawn.
    cell : float
        Side of a cell to begin with, data units; larger ones where that leaves too many.
    """
    points = contour.points
    kept = np.arange(len(points))
    while len(kept) > most:
        cells = np.floor(points / cell).astype(np.int64)
        new = np.ones(len(points), dtype=bool)
        new[1:] = (cells[1:] != cells[:-1]).any(axis=1)
        new[-1] = True
        kept = np.flatnonzero(new)
        cell *= 1.5
    return kept
