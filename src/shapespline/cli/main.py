"""The commands together, and what becomes of an error."""

from __future__ import annotations

import warnings
from typing import Annotated, cast

import typer

import shapespline as ss
from shapespline.cli import curve_files, describe, doctor, fit, paper, studio
from shapespline.cli.panels import PanelCommand, closing
from shapespline.cli.reports import say

# Exit code after Ctrl-C: 128 and the number of the signal.
INTERRUPTED = 130

app = typer.Typer(
    name="shapespline",
    help="From a 2D shape to the smallest B-spline that stays within your tolerance.",
    add_completion=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)
EXAMPLES = {
    fit.fit: (
        "shapespline fit logo.png",
        "shapespline fit logo.png -o logo.dxf --width 120 --unit mm -t 0.1 --arcs",
        "shapespline fit cloud.csv --unordered -t 0.2% -o cloud.step",
        "shapespline fit scan.csv -n 36 --degree 5 -o scan.json --plot scan_fit.png",
        "shapespline fit scans/ -o out/ --format svg --jobs 2",
    ),
    curve_files.trace: (
        "shapespline trace logo.png -o logo.csv",
        "shapespline trace logo.png -o logo.dxf --dpi 96",
        "shapespline trace logo.png -o logo.geojson --contours longest",
        "shapespline trace logo.png -o strokes.svg --centerline",
        "shapespline trace scans/*.png -o outlines/ --format csv",
    ),
    curve_files.convert: (
        "shapespline convert logo.svg -o logo.dxf",
        "shapespline convert logo.svg -o logo.pdf",
        "shapespline convert logo.dxf -o logo.igs --unit in",
        "shapespline convert logo.svg -o points.csv --chord 0.05",
        "shapespline convert drawings/ -o out/ --format dxf --arcs",
    ),
    describe.compare: (
        "shapespline compare logo.svg logo.dxf",
        "shapespline compare scan.csv scan.json",
        "shapespline compare logo.png logo.svg",
        "shapespline compare leaf.step leaf.svg --unit mm",
        "shapespline compare logo.svg logo.dxf --json",
    ),
    describe.info: (
        "shapespline info logo.png",
        "shapespline info logo.svg logo.dxf",
        "shapespline info scans/",
        "shapespline info logo.dxf --unit in",
        "shapespline info scans/ --json",
    ),
    paper.paper: (
        "shapespline paper profile.csv -o figures/",
        "shapespline paper profile.csv --length 2 -o figures/",
        "shapespline paper leaf.png --length 8 -o figures/",
        "shapespline paper profile.csv --literal -o figures/",
        "shapespline paper profile.csv --degree 2 -o figures/",
    ),
    studio.studio: (
        "shapespline studio",
        "shapespline studio logo.png",
        "shapespline studio profile.csv",
        "shapespline studio drawing.dxf",
        "shapespline studio --port 8765 --no-browser",
    ),
    doctor.doctor: ("shapespline doctor",),
}
for command, examples in EXAMPLES.items():
    app.command(cls=PanelCommand, epilog=closing(examples))(command)


@app.callback(invoke_without_command=True)
def _main(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Show the version and exit.")] = False,
) -> None:
    if version:
        typer.echo(f"shapespline {ss.__version__}")
    elif context.invoked_subcommand is None:
        typer.echo(context.get_help())


def help_pages() -> dict[str, str]:
    """What each command prints for ``--help``, by its name."""
    group = cast("typer.core.TyperGroup", typer.main.get_command(app))
    pages = {}
    with group.make_context("shapespline", [], resilient_parsing=True) as above:
        for name, command in group.commands.items():
            with command.make_context(name, [], parent=above, resilient_parsing=True) as context:
                pages[name] = command.get_help(context) + "\n"
    return pages


def run() -> int:
    """Run the command line; the exit code."""
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_, **__: say(message)
        warnings.simplefilter("always", ss.DroppedPointsWarning)
        return _exit_code()


def _exit_code() -> int:
    """Run the command; every error that a user can cause is one line on standard error."""
    try:
        result = app(prog_name="shapespline", standalone_mode=False)
    except (ss.ShapesplineError, OSError, MemoryError) as error:
        say(error)
        return 1
    except (typer.Abort, KeyboardInterrupt):
        result = INTERRUPTED
    except Exception as error:
        if hasattr(error, "format_message") and hasattr(error, "exit_code"):  # a usage error
            say(f"{error.format_message()} (see shapespline --help)")
            return int(error.exit_code)
        raise
    if result == INTERRUPTED:
        say("interrupted; nothing was left half written")
    return result if isinstance(result, int) else 0
