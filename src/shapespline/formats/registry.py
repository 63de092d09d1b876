"""Read shapes, write drawings: one module and one line of the registry for each format.

A format's module offers ``read(path: Path, *, ...) -> Shape | Outlines | Drawing`` or
``encode(drawing: Drawing, *, ...) -> bytes`` or both. The keyword-only parameters are the
options of the format; what is not among them is refused. Units and scale are no such options:
they are seen to here, and a drawing says its own ``unit``. Points are returned as a Shape, exact
curves as Outlines, which become a Drawing here. Modules are imported when a file of their kind is
met.
"""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, cast

from shapespline.errors import (
    ArcsAsCurvesWarning,
    FormatError,
    InvalidInputError,
    ShapesplineError,
    UnknownFormatError,
    caller_level,
    require,
    require_installed,
)
from shapespline.formats.atomic import check_target, write_atomically
from shapespline.formats.known import known_options, option_names
from shapespline.formats.objects import read_object
from shapespline.formats.reader_process import Question, read_apart
from shapespline.formats.sources import as_path
from shapespline.geometry import Outlines, as_drawing, exact_drawing, in_unit

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from shapespline.formats.sources import File, Source
    from shapespline.geometry import Drawable
    from shapespline.monitor import Say
    from shapespline.values import Drawing, Shape


__all__ = [
    "FORMATS",
    "Format",
    "check_output",
    "read",
    "read_options",
    "readable",
    "writable",
    "write",
]

# Extras whose libraries some damaged files end: these are read in a process of their own (FMT-16).
APART = frozenset({"cad", "rhino"})


@dataclass(frozen=True)
class Format:
    """A line of the registry: file name endings, the module that knows them, what it can hold."""

    name: str
    suffixes: tuple[str, ...]
    module: str
    reads: bool = False
    writes: bool = False
    arcs: bool = True
    needs: tuple[str, str] | None = None  # a module, and the extra that brings it

    @property
    def required(self) -> tuple[tuple[str, str, str], ...]:
        """What it needs, as `require` takes it."""
        return () if self.needs is None else ((*self.needs, f"{self.name} files need"),)


FORMATS = (
    Format(
        "CSV", (".csv", ".txt", ".dat", ".xy", ".tsv"), "csv", reads=True, writes=True, arcs=False
    ),
    Format("CSV", (".xyz",), "csv", reads=True),
    Format("NumPy", (".npy",), "npy", reads=True),
    Format(
        "image",
        (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".webp", ".gif"),
        "image",
        reads=True,
    ),
    Format("picture", (".png",), "picture", writes=True),
    Format("SVG", (".svg",), "svg_reader", reads=True),
    Format("SVG", (".svg",), "svg_writer", writes=True),
    Format("DXF", (".dxf",), "dxf_reader", reads=True, needs=("ezdxf", "dxf")),
    Format("DXF", (".dxf",), "dxf_writer", writes=True, needs=("ezdxf", "dxf")),
    Format("JSON", (".json",), "json", reads=True, writes=True),
    Format("STEP", (".step", ".stp"), "step", reads=True, writes=True, needs=("OCP.Geom", "cad")),
    Format("IGES", (".iges", ".igs"), "iges", reads=True, writes=True, needs=("OCP.Geom", "cad")),
    Format("3dm", (".3dm",), "rhino", reads=True, writes=True, needs=("rhino3dm", "rhino")),
    Format("GeoJSON", (".geojson",), "geojson", reads=True, writes=True, arcs=False),
    Format("G-code", (".nc",), "gcode", writes=True),
    Format(
        "GLIF",
        (".glif",),
        "glif",
        reads=True,
        writes=True,
        arcs=False,
        needs=("fontTools.ufoLib", "fonts"),
    ),
    Format("PDF", (".pdf",), "pdf", writes=True, arcs=False),
    Format("Python", (".py",), "python", writes=True),
)
_PICTURES = next(entry.suffixes for entry in FORMATS if entry.name == "image")


def read(
    path: Source,
    *,
    format: str | None = None,
    closed: bool | None = None,
    y_down: bool = False,
    unit: str | None = None,
    scale: float | None = None,
    dpi: float | None = None,
    sampling: float | None = None,
    progress: Say | None = None,
    **options: object,
) -> Shape | Drawing:
    """Read a shape, or a drawing of curves, from a file, its format told by its ending.

    Parameters
    ----------
    path : path-like, bytes, open file, geometry or glyph
        Bytes and open files are read whole. A geometry has ``__geo_interface__`` (shapely,
        geopandas and others; a coordinate reference is kept); a glyph has ``draw(pen)``
        (fontTools, ufoLib2, defcon) and may take ``glyph_set``, where its components are.
    format : str, optional
        The ending, such as ".csv", of bytes or an open file whose kind neither its name nor its
        first bytes tell: PNG, JPEG, TIFF, BMP, NumPy, SVG, STEP and 3dm tell it.
    closed : bool, optional
        Whether the outline is closed; found from its ends if not given (CSV, NumPy).
    y_down : bool
        Whether y runs down in the file; it is then turned over within its own bounding box (CSV,
        NumPy).
    unit : str, optional
        The unit wanted, such as "mm" or "in". Coordinates are converted if the unit of the file is
        known (DXF, most SVG files), otherwise they are in this unit from now on.
    scale : float, optional
        Further factor for all coordinates; of a picture, the units that a pixel measures.
    dpi : float, optional
        Pixels per inch, for pictures and other files in pixels; the unit is "mm" if none is named.
    sampling : float, optional
        How closely the contours of a drawing follow its exact curves, data units; 1e-4 of the
        size of each if not given. Counts after unit and scale. Files of points have no need of it.
    progress : callable, optional
        Called with a sentence on what comes next, of pictures; an exception that it raises ends the
        work.
    **options
        Further options of the format, as keyword arguments of the ``read`` of its module:
        :mod:`shapespline.formats.image` takes those of :func:`shapespline.trace`. One
        that is None counts as not given; one that the format does not take is refused.

    Returns
    -------
    Shape or Drawing
        A Drawing from the formats that hold curves (JSON), else a Shape.

    Raises
    ------
    UnknownFormatError
        If no reader is registered for the ending.
    MissingExtraError
        If the format needs a package that is not installed.
    InvalidInputError
        If the format does not take an option.
    FormatError
        If the file is missing, empty, unreadable or broken.

    Examples
    --------
    >>> read("outline.abc")
    Traceback (most recent call last):
    ...
    shapespline.errors.UnknownFormatError: outline.abc: no reader for '.abc'; readable endings: \
.3dm .bmp .csv .dat .dxf .geojson .gif .glif .iges .igs .jpeg .jpg .json .npy .png .step .stp .svg \
.tif .tiff .tsv .txt .webp .xy .xyz
    """
    options |= {"closed": closed, "y_down": y_down or None}
    held = read_object(path, options)
    if held is not None:
        return _as_wanted(held, unit, scale, dpi, sampling)
    with as_path(cast("File", path), format) as file:
        if file.suffix.lower() in _PICTURES:
            options["progress"] = progress
        return _read(file, options, lambda found: _as_wanted(found, unit, scale, dpi, sampling))


def _as_wanted(
    found: Shape | Drawing | Outlines,
    unit: str | None,
    scale: float | None,
    dpi: float | None,
    sampling: float | None,
) -> Shape | Drawing:
    """What a reader found, in the unit that is wanted, exact curves as a drawing."""
    converted = in_unit(found, unit, scale, dpi)
    if isinstance(converted, Outlines):
        return exact_drawing(converted, sampling=sampling)
    return converted


def _read(
    path: Path,
    given: Mapping[str, object],
    finish: Callable[[Shape | Drawing | Outlines], Shape | Drawing],
) -> Shape | Drawing:
    """What the format's reader finds, finished; errors name the file."""
    if path.is_dir():
        raise FormatError(f"cannot read {path}: it is a folder; name a file in it")
    entry, reader = _entry(path, "read"), _function(path, "read")
    arguments = _checked(path, reader, given)
    try:
        _check_source(path)
        if entry.needs is not None and entry.needs[1] in APART:
            question = Question(reader.__module__, entry.required, path.absolute(), arguments)
            found = read_apart(question)
        else:
            found = reader(path, **arguments)
        return finish(cast("Shape | Outlines | Drawing", found))
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror or error}") from error
    except ShapesplineError as error:
        if path.name in str(error):
            raise
        raise type(error)(f"{path.name}: {error}") from error


def check_output(path: str | os.PathLike[str], **options: object) -> None:
    """Raise unless :func:`write` could write there: before the work whose result is to be written.

    Raises
    ------
    UnknownFormatError
        If no writer is registered for the ending.
    FormatError
        If the folder does not exist or the file cannot be written.
    MissingExtraError
        If the format needs a package that is not installed.
    InvalidInputError
        If the format does not take an option.
    """
    check_target(path)
    _checked(Path(path), _function(Path(path), "encode"), options)


def write(
    path: str | os.PathLike[str],
    drawing: Drawable,
    *,
    unit: str | None = None,
    scale: float | None = None,
    **options: object,
) -> None:
    """Write a drawing to a file told by its ending; whole or not at all.

    Parameters
    ----------
    path : path-like
    drawing : Drawing, Fit, Shape or Contour, or a list of fits or contours
        Outlines that have not been fitted are written as polylines; those of a list are nested by
        containment.
    unit : str, optional
        The unit of the file, such as "mm" or "in". Coordinates are converted if the unit of the
        drawing is known, otherwise they are in this unit.
    scale : float, optional
        Further factor for all coordinates; of a traced picture, the units that a pixel measures.
    **options
        Options of the format, as keyword arguments of the ``encode`` of its module. One that is
        None counts as not given; one that the format does not take is refused.

    Raises
    ------
    UnknownFormatError
        If no writer is registered for the ending.
    MissingExtraError
        If the format needs a package that is not installed.
    InvalidInputError
        If the path is none, or the format does not take an option.
    FormatError
        If the folder does not exist, the file cannot be written, or the format cannot hold the
        drawing.

    Warns
    -----
    ArcsAsCurvesWarning
        If the drawing has arcs and the format has none.
    """
    if not isinstance(path, str | os.PathLike):
        raise InvalidInputError(
            f"path must be a path, got {type(path).__name__}; the path comes first, then what is"
            " written"
        )
    path = Path(path)
    encode = _function(path, "encode")
    arguments = _checked(path, encode, options)
    check_target(path)
    held = cast("Drawing", in_unit(as_drawing(drawing), unit, scale))
    _say_of_arcs(path, held)
    write_atomically(path, cast("bytes", encode(held, **arguments)))


def _say_of_arcs(path: Path, drawing: Drawing) -> None:
    """Warn, once a file, where a format without arcs has to hold some."""
    suffix = path.suffix.lower()
    if any(entry.arcs for entry in FORMATS if entry.writes and suffix in entry.suffixes):
        return
    far = max((piece.twin_error for fit in drawing for piece in fit.sections), default=0.0)
    if far > 0:
        warnings.warn(
            f"{path.name}: {suffix} files know no arcs; curves within {far:.2g} stand there",
            ArcsAsCurvesWarning,
            stacklevel=caller_level(),
        )


def read_options(path: str | os.PathLike[str]) -> tuple[str, ...]:
    """Options of the format that a file's ending tells, as :func:`read` takes them.

    Examples
    --------
    >>> "columns" in read_options("a.csv"), read_options("a.svg")
    (True, ())
    """
    return option_names(_function(Path(path), "read"))


def readable() -> tuple[str, ...]:
    """File name endings that :func:`read` knows, sorted."""
    return tuple(sorted(suffix for entry in FORMATS if entry.reads for suffix in entry.suffixes))


def writable() -> tuple[str, ...]:
    """File name endings that :func:`write` knows, sorted.

    Examples
    --------
    >>> ".svg" in writable(), ".npy" in writable()
    (True, False)
    """
    return tuple(sorted(suffix for entry in FORMATS if entry.writes for suffix in entry.suffixes))


def _entry(path: Path, name: str) -> Format:
    """The line of a file's ending whose module has ``read`` or ``encode``."""
    suffix = path.suffix.lower()
    for entry in FORMATS:
        if suffix in entry.suffixes and (entry.reads if name == "read" else entry.writes):
            return entry
    role, verb, known = (
        ("reader", "readable", readable()) if name == "read" else ("writer", "writable", writable())
    )
    ending = f"for {path.suffix!r}" if suffix else "for a name without an ending"
    raise UnknownFormatError(f"{path.name}: no {role} {ending}; {verb} endings: {' '.join(known)}")


def _function(path: Path, name: str) -> Callable[..., object]:
    """Return the ``read`` or ``encode`` of the module registered for a file's ending."""
    entry = _entry(path, name)
    for module, extra, said in entry.required:
        # What is read apart is imported there.
        apart = name == "read" and extra in APART
        (require_installed if apart else require)(module, extra, said)
    found = import_module(f"shapespline.formats.{entry.module}")
    return cast("Callable[..., object]", getattr(found, name))


def _checked(
    path: Path, function: Callable[..., object], options: Mapping[str, object]
) -> dict[str, object]:
    """Options that were given, all of them known to the format's function."""
    return known_options(path.name, f"{path.suffix} files", function, options)


def _check_source(path: Path) -> None:
    """Say in a sentence why a file cannot be read, as far as that can be seen from outside."""
    if not path.exists():
        raise FormatError(f"cannot read {path}: there is no such file")
    if path.is_file() and path.stat().st_size == 0:
        raise FormatError(f"cannot read {path}: the file is empty")
