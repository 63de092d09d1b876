"""``shapespline paper``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from shapespline.cli import options


@options.gathers(reading=options.Reading)
def paper(
    source: options.Input,
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
    degree: options.Degree = 3,
    *,
    reading: options.Reading,
) -> None:
    """Run the published method on the longest outline of INPUT: figures and a table."""
    from shapespline.paper import check_folder, run_paper, write_report

    check_folder(output)
    shape = reading.outlines(Path(source))
    run = run_paper(shape.longest, length, literal=literal, degree=degree)
    for path in write_report(run, output):
        typer.echo(str(path))
