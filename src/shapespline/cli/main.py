"""The commands together, and what becomes of an error."""

from __future__ import annotations

import warnings
from importlib import import_module
from typing import cast

import click
from click.shell_completion import get_completion_class

import shapespline as ss
from shapespline.cli.declared import command
from shapespline.cli.reports import say

# Exit code after Ctrl-C: 128 and the number of the signal.
INTERRUPTED = 130

# Command -> the module that has its function, and examples.
COMMANDS: dict[str, tuple[str, tuple[str, ...]]] = {
    "fit": (
        "fit",
        (
            "shapespline fit logo.png",
            "shapespline fit logo.png -o logo.dxf --width 120 --unit mm -t 0.1 --arcs",
            "shapespline fit cloud.csv --unordered -t 0.2% -o cloud.step",
            "shapespline fit scan.csv -n 36 --degree 5 -o scan.json --plot scan_fit.png",
            "shapespline fit scans/ -o out/ --format svg --jobs 2",
        ),
    ),
    "trace": (
        "curve_files",
        (
            "shapespline trace logo.png -o logo.csv",
            "shapespline trace logo.png -o logo.dxf --dpi 96",
            "shapespline trace logo.png -o logo.geojson --contours longest",
            "shapespline trace logo.png -o strokes.svg --centerline",
            "shapespline trace scans/*.png -o outlines/ --format csv",
        ),
    ),
    "convert": (
        "curve_files",
        (
            "shapespline convert logo.svg -o logo.dxf",
            "shapespline convert logo.svg -o logo.pdf",
            "shapespline convert logo.dxf -o logo.igs --unit in",
            "shapespline convert logo.svg -o points.csv --chord 0.05",
            "shapespline convert drawings/ -o out/ --format dxf --arcs",
        ),
    ),
    "compare": (
        "describe",
        (
            "shapespline compare logo.svg logo.dxf",
            "shapespline compare scan.csv scan.json",
            "shapespline compare logo.png logo.svg",
            "shapespline compare leaf.step leaf.svg --unit mm",
            "shapespline compare logo.svg logo.dxf --json",
        ),
    ),
    "info": (
        "describe",
        (
            "shapespline info logo.png",
            "shapespline info logo.svg logo.dxf",
            "shapespline info scans/",
            "shapespline info logo.dxf --unit in",
            "shapespline info scans/ --json",
        ),
    ),
    "paper": (
        "paper",
        (
            "shapespline paper profile.csv -o figures/",
            "shapespline paper profile.csv --length 2 -o figures/",
            "shapespline paper leaf.png --length 8 -o figures/",
            "shapespline paper profile.csv --literal -o figures/",
            "shapespline paper profile.csv --degree 2 -o figures/",
        ),
    ),
    "studio": (
        "studio",
        (
            "shapespline studio",
            "shapespline studio logo.png",
            "shapespline studio profile.csv",
            "shapespline studio drawing.dxf",
            "shapespline studio --port 8765 --no-browser",
        ),
    ),
    "doctor": ("doctor", ("shapespline doctor",)),
}
SHELLS = ("bash", "zsh", "fish")
COMPLETE = "_SHAPESPLINE_COMPLETE"


class Commands(click.Group):
    """The commands; each is made, and its module imported, when it is asked for (PKG-08)."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Their names, the usual ones first."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of a name."""
        if cmd_name not in COMMANDS:
            return None
        module, examples = COMMANDS[cmd_name]
        home = import_module(f"shapespline.cli.{module}")
        return command(getattr(home, cmd_name), examples)


@click.group(
    "shapespline",
    Commands,
    invoke_without_command=True,
    help="From a 2D shape to the smallest B-spline that stays within your tolerance.",
)
@click.version_option(ss.__version__, prog_name="shapespline", message="%(prog)s %(version)s")
@click.option(
    "--show-completion",
    type=click.Choice(SHELLS),
    help="Show what a shell needs to complete commands and options.",
)
@click.pass_context
def app(context: click.Context, show_completion: str | None) -> None:
    """Say how to go on if no command is named."""
    if show_completion is not None:
        kind = get_completion_class(show_completion)
        if kind is not None:
            click.echo(kind(app, {}, "shapespline", COMPLETE).source())
    elif context.invoked_subcommand is None:
        click.echo(context.get_help())


def help_pages() -> dict[str, str]:
    """What each command prints for ``--help``, by its name."""
    pages = {}
    with app.make_context("shapespline", [], resilient_parsing=True) as above:
        for name in app.list_commands(above):
            one = cast("click.Command", app.get_command(above, name))
            with one.make_context(name, [], parent=above, resilient_parsing=True) as context:
                pages[name] = one.get_help(context) + "\n"
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
    except (click.Abort, KeyboardInterrupt):
        result = INTERRUPTED
    except click.ClickException as error:  # a usage error
        say(f"{error.format_message()} (see shapespline --help)")
        return error.exit_code
    if result == INTERRUPTED:
        say("interrupted; nothing was left half written")
    return result if isinstance(result, int) else 0
