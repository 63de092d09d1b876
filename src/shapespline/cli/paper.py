"""``shapespline paper``."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import click

from shapespline.cli import options
from shapespline.cli.declared import Option
from shapespline.cli.gathering import gathers


@dataclass(frozen=True)
class Method:
    """How to read the paper; every field is an option of the command line."""

    length: Annotated[
        int | None,
        Option("--length", "-L", help="Chord length L of the CPDA, in points (default: 8)."),
    ] = None
    arc_length: Annotated[float | None, Option(help="The same as a length in data units.")] = None
    literal: Annotated[bool, Option("--literal", help="Take the paper at its word everywhere.")] = (
        False
    )
    reading: Annotated[
        list[str] | None,
        Option(
            metavar="FIELD=VALUE",
            help="One field of the reading, such as window=7 or start=park-lee; as often as you"
            " like.",
        ),
    ] = None
    method: Annotated[
        str | None, Option(help="Optimiser, such as levenberg-marquardt or l-bfgs.")
    ] = None
    n_control_points: Annotated[
        int | None, Option("--control-points", "-n", help="Number of control points.")
    ] = None
    degree: options.Degree = 3


@gathers(how=Method, source=options.Reading)
def paper(
    path: options.Input,
    output: Annotated[
        Path,
        Option("--output", "-o", help="Folder for the figures and the files."),
    ],
    *,
    how: Method,
    source: options.Reading,
) -> None:
    """Run the published method on INPUT: figures, tables, curves; a folder for each outline."""
    from shapespline.paper import LITERAL, SENSIBLE, check_folder, run_paper, write_report

    chosen = (LITERAL if how.literal else SENSIBLE).changed(how.reading or ())
    check_folder(output)
    contours = source.outlines(Path(path)).contours
    for index, contour in enumerate(contours):
        folder = output if len(contours) == 1 else output / f"outline-{index + 1}"
        run = run_paper(
            contour,
            how.length,
            arc_length=how.arc_length,
            reading=chosen,
            method=how.method,
            degree=how.degree,
            n_control_points=how.n_control_points,
            snapshots=1,
        )
        output.mkdir(exist_ok=True)
        for file in write_report(run, folder):
            click.echo(str(file))
