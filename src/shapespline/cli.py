"""The command line: ``shapespline fit`` and ``shapespline paper``.

Errors are one line on standard error: exit 1 for a file or value that cannot be used, 2 for a
wrong call, 130 after Ctrl-C. Numerical packages are imported inside the commands, so that the help
comes at once.
"""

from __future__ import annotations

import sys
import time
import warnings
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline import Drawing, Fit, Shape

# Exit code after Ctrl-C: 128 and the number of the signal.
INTERRUPTED = 130

app = typer.Typer(
    name="shapespline",
    help="From a 2D shape to the smallest B-spline that stays within your tolerance.",
    add_completion=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


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


Input = Annotated[
    Path,
    typer.Argument(
        metavar="INPUT", help="Outline (CSV, TXT, NPY), picture (PNG, JPEG, TIFF, BMP) or JSON."
    ),
]
Closed = Annotated[
    bool | None,
    typer.Option("--closed/--open", help="Whether the outline is closed (default: found)."),
]
YDown = Annotated[
    bool, typer.Option("--y-down", help="The y axis of the outline file runs down (CSV, NPY).")
]
Level = Annotated[
    float | None,
    typer.Option(help="Grey level between shape and ground of a picture (default: Otsu)."),
]
ShapePolarity = Annotated[
    Polarity, typer.Option("--polarity", help="Dark shapes on light ground, or light on dark.")
]
Outlines = Annotated[
    Selection, typer.Option("--contours", help="Outlines of a picture: all, or the longest.")
]
ValueOfPixels = Annotated[
    Channel, typer.Option("--channel", help="What is cut at the level in a picture.")
]
MinArea = Annotated[
    float | None, typer.Option(help="Smallest outline of a picture, square pixels.")
]
Degree = Annotated[int, typer.Option(help="Degree of the curve, 1 to 9.")]


@app.callback(invoke_without_command=True)
def _main(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Show the version and exit.")] = False,
) -> None:
    if version:
        typer.echo(f"shapespline {ss.__version__}")
    elif context.invoked_subcommand is None:
        typer.echo(context.get_help())


@app.command()
def fit(
    source: Input,
    output: Annotated[Path, typer.Option("--output", "-o", help="File to write: .svg or .json.")],
    tolerance: Annotated[
        str | None,
        typer.Option(
            "--tolerance",
            "-t",
            help="Largest distance between data and curve, both ways: in the unit of the data, or a"
            " part of the box diagonal such as 0.1%.",
        ),
    ] = None,
    control_points: Annotated[
        int | None,
        typer.Option(
            "--control-points",
            "-n",
            help="Control points of each curve (default without a tolerance: found from the noise"
            " of the points or from what they can show).",
        ),
    ] = None,
    degree: Degree = 3,
    corners: Annotated[
        Literal["auto", "free", "none"],
        typer.Option(help="With a tolerance: keep corners, be free to round them, or know none."),
    ] = "auto",
    form: Annotated[
        Literal["pieces", "spline"],
        typer.Option(help="With a tolerance: lines, Beziers and splines, or one spline."),
    ] = "pieces",
    effort: Annotated[
        Literal["fast", "balanced", "smallest"],
        typer.Option(help="With a tolerance: how long to search for a smaller curve."),
    ] = "balanced",
    plot: Annotated[
        Path | None,
        typer.Option(help="Also draw data, control polygon, curve and error as a PNG picture."),
    ] = None,
    closed: Closed = None,
    y_down: YDown = False,
    level: Level = None,
    polarity: ShapePolarity = Polarity.auto,
    channel: ValueOfPixels = Channel.auto,
    contours: Outlines = Selection.all,
    min_area: MinArea = None,
) -> None:
    """Fit B-spline curves to the outlines of INPUT and write them to a file."""
    from shapespline.formats import check_output

    check_output(output)
    if plot is not None:
        from shapespline.plot import check_picture

        check_picture(plot)
    for target in (output, plot):
        if target is not None and target.exists() and source.exists() and target.samefile(source):
            raise ss.InvalidInputError(f"{target} is the input itself; choose another name")
    shape = _read(source, closed, y_down, level, polarity, channel, contours, min_area)
    began = time.perf_counter()
    drawing = ss.fit_shape(
        shape,
        tolerance=tolerance,
        n_control_points=control_points,
        degree=degree,
        corners=None if corners == "none" else corners,
        form=form,
        effort=effort,
    )
    seconds = time.perf_counter() - began
    ss.write(output, drawing)
    if plot is not None:
        from shapespline.plot import plot_fit

        plot_fit(drawing, plot)
    typer.echo(_summary(output, drawing, seconds))


@app.command()
def paper(
    source: Input,
    output: Annotated[
        Path,
        typer.Option("--output", "-o", help="Folder for the figures and the table."),
    ],
    length: Annotated[
        int, typer.Option("--length", "-L", help="Chord length L of the CPDA, in points.")
    ] = 3,
    literal: Annotated[
        bool, typer.Option("--literal", help="Take the paper at its word everywhere.")
    ] = False,
    degree: Degree = 3,
    closed: Closed = None,
    y_down: YDown = False,
    level: Level = None,
    polarity: ShapePolarity = Polarity.auto,
    channel: ValueOfPixels = Channel.auto,
    min_area: MinArea = None,
) -> None:
    """Run the published method on the longest outline of INPUT: figures and a table."""
    from shapespline.paper import run_paper
    from shapespline.paper_report import check_folder, write_report

    check_folder(output)
    shape = _read(source, closed, y_down, level, polarity, channel, Selection.all, min_area)
    run = run_paper(shape.longest, length, literal=literal, degree=degree)
    for path in write_report(run, output):
        typer.echo(str(path))


def _read(
    source: Path,
    closed: bool | None,
    y_down: bool,
    level: float | None,
    polarity: Polarity,
    channel: Channel,
    contours: Selection,
    min_area: float | None,
) -> Shape:
    """The shape in a file; of a JSON drawing the outlines that it was fitted to."""
    shape = ss.read(
        source,
        closed=closed,
        y_down=y_down,
        level=level,
        polarity=None if polarity is Polarity.auto else polarity.value,
        channel=None if channel is Channel.auto else channel.value,
        contours=None if contours is Selection.all else contours.value,
        min_area=min_area,
    )
    if isinstance(shape, ss.Shape):
        return shape
    return ss.Shape([fit.contour for fit in shape], shape.parents, shape.frame)


def _summary(output: Path, drawing: Drawing, seconds: float) -> str:
    """One line on what was written, and one for every fit that keeps less than was asked."""
    fits = drawing.fits
    points = sum(fit.n_stored_points for fit in fits)
    farthest = max(fit.hausdorff_distance for fit in fits)
    curves = "1 curve" if len(fits) == 1 else f"{len(fits)} curves"
    line = (
        f"{output}: {curves}, {points} points, data and curve within {farthest:.4g}"
        f" of each other, {seconds:.2f} s"
    )
    return "\n".join([line, *_remarks(fits)])


def _remarks(fits: tuple[Fit, ...]) -> Iterator[str]:
    for index, fit in enumerate(fits):
        if not fit.kept:
            yield f"curve {index}: {fit.status.value}"


def _say(message: object) -> None:
    print(f"shapespline: {message}", file=sys.stderr)


def run() -> int:
    """Run the command line; the exit code."""
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_, **__: _say(message)
        warnings.simplefilter("always", ss.DroppedPointsWarning)
        return _exit_code()


def _exit_code() -> int:
    """Run the command; every error that a user can cause is one line on standard error."""
    try:
        result = app(standalone_mode=False)
    except (ss.ShapesplineError, OSError, MemoryError) as error:
        _say(" ".join(str(error).split()) or type(error).__name__)
        return 1
    except (typer.Abort, KeyboardInterrupt):
        result = INTERRUPTED
    except Exception as error:
        if hasattr(error, "format_message") and hasattr(error, "exit_code"):  # a usage error
            _say(f"{error.format_message()} (see shapespline --help)")
            return int(error.exit_code)
        raise
    if result == INTERRUPTED:
        _say("interrupted; nothing was left half written")
    return result if isinstance(result, int) else 0
