"""Options that several commands share."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, fields
from pathlib import Path  # noqa: TC003 - annotations are read
from typing import TYPE_CHECKING, Annotated, Any, Literal

import shapespline as ss
from shapespline.cli.declared import Argument, Option
from shapespline.cli.panels import FIT, INPUT, OUTPUT, PICTURE, RUN
from shapespline.cli.widths import read_wide

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np

    from shapespline import Drawing, Shape

    Command = Callable[..., Any]


# What the samples on an exact curve may be off, of the tolerance of the fit to them (GEO-01).
SAMPLING_PART = 0.02


@dataclass(frozen=True)
class Reading:
    """How to read an input; every field is an option of the command line."""

    closed: Annotated[
        bool | None,
        Option(
            "--closed/--open",
            help="Whether the outline is closed (default: found).",
            panel=INPUT,
        ),
    ] = None
    y_down: Annotated[
        bool,
        Option(
            "--y-down",
            help="The y axis of the outline file runs down (CSV, NPY).",
            panel=INPUT,
        ),
    ] = False
    unordered: Annotated[
        bool,
        Option(
            "--unordered",
            help="The points of the file are in no order: find it.",
            panel=INPUT,
        ),
    ] = False
    level: Annotated[
        float | None,
        Option(
            help="Grey level between shape and ground of a picture (default: Otsu).",
            panel=PICTURE,
        ),
    ] = None
    polarity: Annotated[
        Literal["auto", "dark", "light"],
        Option(help="Dark shapes on light ground, or light on dark.", panel=PICTURE),
    ] = "auto"
    channel: Annotated[
        Literal["auto", "grey", "red", "green", "blue", "alpha", "difference"],
        Option(help="What is cut at the level in a picture.", panel=PICTURE),
    ] = "auto"
    color: Annotated[
        str | None,
        Option(
            help="The shape of a picture is what has this colour: #ff8800, red, or @column,row of a"
            " pixel.",
            panel=PICTURE,
        ),
    ] = None
    invert: Annotated[
        bool,
        Option("--invert", help="Of a picture: the ground is the shape.", panel=PICTURE),
    ] = False
    local: Annotated[
        str,
        Option(
            help="Whether the level follows uneven light: auto, off, or a window in pixels.",
            panel=PICTURE,
        ),
    ] = "auto"
    blur: Annotated[
        float | None,
        Option(
            help="Blur a picture before it is cut, pixels (for grain and screens).",
            panel=PICTURE,
        ),
    ] = None
    crop: Annotated[
        str | None,
        Option(
            help="The part of a picture to look at: column,row,width,height.",
            panel=PICTURE,
        ),
    ] = None
    colors: Annotated[
        str | None,
        Option(
            help="Areas of so many colours of a picture, or auto, instead of ink; neighbours share"
            " their borders.",
            panel=PICTURE,
        ),
    ] = None
    centerline: Annotated[
        bool,
        Option(
            "--centerline",
            help="Centre lines of strokes, not their outlines.",
            panel=PICTURE,
        ),
    ] = False
    contours: Annotated[
        Literal["all", "longest"],
        Option(help="Outlines of a picture: all, or the longest.", panel=PICTURE),
    ] = "all"
    min_area: Annotated[
        float | None,
        Option(help="Smallest outline of a picture, square pixels.", panel=PICTURE),
    ] = None
    unit: Annotated[
        str | None,
        Option(
            help="Unit to work in, such as mm or in: numbers are converted if the file says its"
            " unit, else they are in this one.",
            panel=INPUT,
        ),
    ] = None
    scale: Annotated[
        float | None,
        Option(
            help="Factor for all numbers; of a picture, the units that a pixel measures.",
            panel=INPUT,
        ),
    ] = None
    dpi: Annotated[
        float | None,
        Option(
            help="Pixels per inch, of pictures (unit: mm if none is named).",
            panel=PICTURE,
        ),
    ] = None

    width: Annotated[
        float | None,
        Option(
            help="Width of all outlines together, in the --unit, whatever numbers the file holds.",
            panel=INPUT,
        ),
    ] = None
    columns: Annotated[
        str | None,
        Option(
            metavar="X,Y",
            help="Columns of a table that hold x and y, by name or number from 1, such as 2,3.",
            panel=INPUT,
        ),
    ] = None

    def given(self) -> dict[str, Any]:
        """Those that were given, as options of `shapespline.read`."""
        return {name: value for name, value in _given(self).items() if name != "width"}

    def read(self, path: Path, sampling: float | None = None, say: Any = None) -> Shape | Drawing:
        """What the file holds."""
        if self.width is None:
            return ss.read(path, sampling=sampling, progress=say, **self.given())
        return read_wide(path, self.width, sampling, self.given())

    def errors(self, path: Path, columns: str) -> np.ndarray:
        """Standard deviations of the points of a table, (n, 2), from one of its columns or two."""
        if self.width is not None or self.unordered:
            raise ss.InvalidInputError(
                "--sigma with columns and --width or --unordered exclude each other"
            )
        from shapespline.formats import columns_of

        x, _, y = columns.removeprefix("@").partition(",")
        found = columns_of(path, f"{x},{y or x}")
        return found if self.scale is None else found * self.scale

    def outlines(self, path: Path, tolerance: float | str | None = None, say: Any = None) -> Shape:
        """The outlines in the file; of a drawing those that it was fitted to.

        Exact curves are sampled to a small part of the tolerance that they are to be fitted to.
        """
        sampling = None
        with suppress(TypeError, ValueError):  # none given, or a part of the size
            sampling = SAMPLING_PART * float(tolerance)  # type: ignore[arg-type]
        shape = self.read(path, sampling if sampling and sampling > 0 else None, say)
        return shape if isinstance(shape, ss.Shape) else shape.shape


@dataclass(frozen=True)
class Writing:
    """How to write an output; every field is an option of the command line."""

    arcs: Annotated[
        bool,
        Option(
            "--arcs",
            help="Lines and arcs within the tolerance, for machines that know no splines.",
            panel=OUTPUT,
        ),
    ] = False
    arc_tolerance: Annotated[
        float | None,
        Option(
            help="Largest distance of arcs to a curve that they are made of, on top of the"
            " tolerance of the fit (default: a quarter of it).",
            panel=OUTPUT,
        ),
    ] = None
    band: Annotated[
        float | None,
        Option(
            help="Draw the band that holds the true curve at each place with this probability, such"
            " as 0.95 (SVG, with --sigma).",
            panel=OUTPUT,
        ),
    ] = None
    release: Annotated[
        str | None,
        Option(
            "--dxf-release",
            help="R2000 (the default), or R12 for old machines: polylines of lines and arcs.",
            panel=OUTPUT,
        ),
    ] = None
    feed: Annotated[
        float | None,
        Option(help="G-code: units a minute (default: 500 mm).", panel=OUTPUT),
    ] = None
    depth: Annotated[
        float | None,
        Option(help="G-code: how far below Z0 the tool cuts.", panel=OUTPUT),
    ] = None
    safe_height: Annotated[
        float | None,
        Option(help="G-code: height above Z0 between outlines (default: 5 mm).", panel=OUTPUT),
    ] = None
    chord: Annotated[
        float | None,
        Option(
            help="Largest distance between curve and polyline (CSV, GeoJSON), data unit.",
            panel=OUTPUT,
        ),
    ] = None

    def given(self) -> dict[str, Any]:
        """Those that were given, as options of `shapespline.write`."""
        return _given(self)


def _given(options: Reading | Writing) -> dict[str, Any]:
    values = {field.name: getattr(options, field.name) for field in fields(options)}
    return {
        field.name: values[field.name]
        for field in fields(options)
        if values[field.name] != field.default
    }


Inputs = Annotated[
    list[str],
    Argument(
        "INPUT...",
        help="Files, folders or patterns: outlines (CSV, TXT, NPY), pictures (PNG, JPEG, TIFF,"
        " BMP), drawings (SVG, DXF, JSON and more); - for standard input.",
        panel=INPUT,
    ),
]
Input = Annotated[
    str,
    Argument("INPUT", help="A file; - for standard input.", panel=INPUT),
]
Force = Annotated[
    bool,
    Option("--force", help="Replace a file that exists beside the input.", panel=OUTPUT),
]
OptionalOutput = Annotated[
    str | None,
    Option(
        "--output",
        "-o",
        help="File to write, its format told by its ending, or a folder for many; - for standard"
        " output (default: an SVG beside the input).",
        panel=OUTPUT,
    ),
]
Output = Annotated[
    str,
    Option(
        "--output",
        "-o",
        help="File to write, or a folder for many; - for standard output.",
        panel=OUTPUT,
    ),
]
Format = Annotated[
    str | None,
    Option(
        "--format",
        "-f",
        help="Ending of the files to write into a folder or standard output.",
        panel=OUTPUT,
    ),
]
StdinFormat = Annotated[
    str,
    Option(
        "--stdin-format",
        help="Ending that standard input would have as a file.",
        panel=INPUT,
    ),
]
Jobs = Annotated[
    int,
    Option("--jobs", "-j", least=1, help="Files to work on at the same time.", panel=RUN),
]
Scheduler = Annotated[
    str | None,
    Option(help="Address of a dask scheduler to work on, such as tcp://host:8786.", panel=RUN),
]
Resume = Annotated[
    bool,
    Option(
        "--resume",
        help="Skip inputs whose output is there and newer than they are.",
        panel=RUN,
    ),
]
AsJson = Annotated[
    bool,
    Option("--json", help="Print one line of JSON for each input, for scripts.", panel=OUTPUT),
]
Degree = Annotated[int, Option(help="Degree of the curve, 1 to 9.", panel=FIT)]
