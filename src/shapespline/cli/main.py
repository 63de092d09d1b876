"""The commands together, and what becomes of an error."""

from __future__ import annotations

import warnings
from typing import Annotated

import typer

import shapespline as ss
from shapespline.cli import curve_files, describe, fit, paper
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
for command in (
    fit.fit,
    curve_files.trace,
    curve_files.convert,
    describe.compare,
    describe.info,
    paper.paper,
):
    app.command()(command)


@app.callback(invoke_without_command=True)
def _main(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Show the version and exit.")] = False,
) -> None:
    if version:
        typer.echo(f"shapespline {ss.__version__}")
    elif context.invoked_subcommand is None:
        typer.echo(context.get_help())


def run() -> int:
    """Run the command line; the exit code."""
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_, **__: say(message)
        warnings.simplefilter("always", ss.DroppedPointsWarning)
        return _exit_code()


def _exit_code() -> int:
    """Run the command; every error that a user can cause is one line on standard error."""
    try:
        result = app(standalone_mode=False)
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
