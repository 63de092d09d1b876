"""Options that several commands share."""

from __future__ import annotations

import functools
import inspect
from contextlib import suppress
from dataclasses import dataclass, fields
from enum import StrEnum
from pathlib import Path  # noqa: TC003 - typer reads annotations
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline import Drawing, Shape


# What the samples on an exact curve may be off, of the tolerance of the fit to them.
SAMPLING_PART = 0.02


class Selection(StrEnum):
    """Which outlines of a picture to take."""

    all = "all"
    longest = "longest"


class Polarity(StrEnum):
    """Whether the shapes of a picture are darker or lighter than its ground."""

    auto = "auto"
    dark = "dark"
    light = "light"


class Channel(StrEnum):
    """The value of a pixel."""

    auto = "auto"
    grey = "grey"
    red = "red"
    green = "green"
    blue = "blue"
    alpha = "alpha"
    difference = "difference"


@dataclass(frozen=True)
class Reading:
    """How to read an input; every field is an option of the command line."""

    closed: Annotated[
        bool | None,
        typer.Option("--closed/--open", help="Whether the outline is closed (default: found)."),
    ] = None
    y_down: Annotated[
        bool, typer.Option("--y-down", help="The y axis of the outline file runs down (CSV, NPY).")
    ] = False
    level: Annotated[
        float | None,
        typer.Option(help="Grey level between shape and ground of a picture (default: Otsu)."),
    ] = None
    polarity: Annotated[
        Polarity, typer.Option(help="Dark shapes on light ground, or light on dark.")
    ] = Polarity.auto
    channel: Annotated[Channel, typer.Option(help="What is cut at the level in a picture.")] = (
        Channel.auto
    )
    contours: Annotated[
        Selection, typer.Option(help="Outlines of a picture: all, or the longest.")
    ] = Selection.all
    min_area: Annotated[
        float | None, typer.Option(help="Smallest outline of a picture, square pixels.")
    ] = None
    unit: Annotated[
        str | None,
        typer.Option(
            help="Unit to work in, such as mm or in: numbers are converted if the file says its"
            " unit, else they are in this one."
        ),
    ] = None
    scale: Annotated[
        float | None,
        typer.Option(help="Factor for all numbers; of a picture, the units that a pixel measures."),
    ] = None
    dpi: Annotated[
        float | None, typer.Option(help="Pixels per inch, of pictures (unit: mm if none is named).")
    ] = None

    def read(self, path: Path, sampling: float | None = None) -> Shape | Drawing:
        """What the file holds."""
        options: dict[str, object] = {}
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, StrEnum):  # the first of each is the reader's own choice
                value = None if value is next(iter(type(value))) else value.value
            options[field.name] = value
        return ss.read(path, sampling=sampling, **options)  # type: ignore[arg-type]

    def outlines(self, path: Path, tolerance: str | None = None) -> Shape:
        """The outlines in the file; of a drawing those that it was fitted to.

        Exact curves are sampled to a small part of the tolerance that they are to be fitted to.
        """
        sampling = None
        with suppress(TypeError, ValueError):  # none given, or a part of the size
            sampling = SAMPLING_PART * float(tolerance)  # type: ignore[arg-type]
        shape = self.read(path, sampling if sampling and sampling > 0 else None)
        if isinstance(shape, ss.Shape):
            return shape
        contours = [fit.contour for fit in shape]
        return ss.Shape(contours, shape.parents, shape.frame, shape.unit)


def with_reading(command: Callable[..., Any]) -> Callable[..., Any]:
    """Give a command the options of `Reading`, gathered in its argument ``reading``.

    Typer builds options from a signature; this one is the command's with ``reading`` replaced by
    the fields.
    """
    own = inspect.signature(command, eval_str=True)
    hints = get_type_hints(Reading, include_extras=True)
    options = [
        inspect.Parameter(
            field.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=field.default,
            annotation=hints[field.name],
        )
        for field in fields(Reading)
    ]

    @functools.wraps(command)
    def gathered(**given: Any) -> Any:
        reading = Reading(**{option.name: given.pop(option.name) for option in options})
        return command(**given, reading=reading)

    parameters = [
        parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY)
        for parameter in own.parameters.values()
        if parameter.name != "reading"
    ]
    # Typer reads both.
    gathered.__signature__ = inspect.Signature([*parameters, *options])  # type: ignore[attr-defined]
    gathered.__annotations__ = {item.name: item.annotation for item in [*parameters, *options]}
    return gathered


Inputs = Annotated[
    list[str],
    typer.Argument(
        metavar="INPUT...",
        help="Files, folders or patterns: outlines (CSV, TXT, NPY), pictures (PNG, JPEG, TIFF,"
        " BMP), drawings (SVG, DXF, JSON and more); - for standard input.",
        show_default=False,
    ),
]
Input = Annotated[str, typer.Argument(metavar="INPUT", help="A file; - for standard input.")]
Output = Annotated[
    str,
    typer.Option(
        "--output",
        "-o",
        help="File to write, or a folder for many; - for standard output.",
    ),
]
Format = Annotated[
    str | None,
    typer.Option(
        "--format", "-f", help="Ending of the files to write into a folder or standard output."
    ),
]
StdinFormat = Annotated[
    str, typer.Option("--stdin-format", help="Ending that standard input would have as a file.")
]
Jobs = Annotated[
    int, typer.Option("--jobs", "-j", min=1, help="Files to work on at the same time.")
]
Scheduler = Annotated[
    str | None,
    typer.Option(help="Address of a dask scheduler to work on, such as tcp://host:8786."),
]
Resume = Annotated[
    bool,
    typer.Option("--resume", help="Skip inputs whose output is there and newer than they are."),
]
AsJson = Annotated[
    bool, typer.Option("--json", help="Print one line of JSON for each input, for scripts.")
]
Degree = Annotated[int, typer.Option(help="Degree of the curve, 1 to 9.")]
Arcs = Annotated[
    bool,
    typer.Option("--arcs", help="Write DXF as lines and arcs, for machines that read no splines."),
]
ArcTolerance = Annotated[
    float | None,
    typer.Option(
        help="Largest distance of the arcs to the curve, on top of the tolerance of the fit"
        " (default: a quarter of it)."
    ),
]
