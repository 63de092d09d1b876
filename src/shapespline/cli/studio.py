"""``shapespline studio``."""

from __future__ import annotations

import sys
from pathlib import Path  # noqa: TC003 - annotations are read
from typing import Annotated

import click

import shapespline as ss
from shapespline.cli.declared import Argument, Option


def studio(
    path: Annotated[
        Path | None,
        Argument("[FILE]", help="A file to begin with (default: an example)."),
    ] = None,
    *,
    port: Annotated[
        int, Option(least=0, most=65535, help="Port to listen at; 0 takes a free one.")
    ] = 0,
    host: Annotated[
        str, Option(help="Address to listen at; the default is for this machine alone.")
    ] = "127.0.0.1",
    browser: Annotated[
        bool,
        Option("--browser/--no-browser", help="Whether to open the page; its address is printed."),
    ] = True,
) -> None:
    """See a fit, steer it, take it away: a local page in the browser."""

    def announce(address: str) -> None:
        click.echo(f"shapespline studio: {address}")
        click.echo("Ctrl-C ends it.")
        sys.stdout.flush()

    ss.open_studio(path, port=port, host=host, browser=browser, announce=announce)
