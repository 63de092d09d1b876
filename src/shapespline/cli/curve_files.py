"""``shapespline trace`` and ``shapespline convert``: files to files without fitting."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import shapespline as ss
from shapespline.cli import options
from shapespline.cli.declared import Option
from shapespline.cli.gathering import gathers
from shapespline.cli.reports import Report, drawing_record
from shapespline.cli.run_files import Batch, run_files
from shapespline.cli.waiting import said_when_long

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(frozen=True)
class TraceFile:
    """Write the outlines of one file as they were found, as polylines."""

    reading: options.Reading
    writing: options.Writing
    left_out: bool
    alone: bool

    def __call__(self, source: Path, target: Path) -> Report:
        """Report of the file."""
        with said_when_long(self.alone) as say:
            shape = self.reading.outlines(source, say=say)
        n_left_out = len(shape.left_out)
        if self.left_out:
            if not shape.left_out:
                raise ss.InvalidInputError(f"nothing was left out of {source}: nothing to write")
            shape = ss.Shape(shape.left_out, frame=shape.frame, unit=shape.unit)
        ss.write(target, shape, **self.writing.given())
        n_points = sum(len(contour) for contour in shape)
        known = [width for width in shape.widths if width is not None]
        noun = "stroke" if known else "outline"
        outlines = f"1 {noun}" if len(shape) == 1 else f"{len(shape)} {noun}s"
        if known:
            outlines += f" {min(known):.3g} to {max(known):.3g} wide"
        return Report(
            str(source),
            text=f"{target}: {outlines}, {n_points} points",
            record={
                "output": str(target),
                "left_out": n_left_out,
                "outlines": [
                    {
                        "closed": contour.closed,
                        "points": len(contour),
                        **({} if width is None else {"width": width}),
                    }
                    for contour, width in zip(shape, shape.widths, strict=True)
                ],
                "parents": list(shape.parents),
            },
        )


@dataclass(frozen=True)
class ConvertFile:
    """Write the curves of one file in another format."""

    reading: options.Reading
    writing: options.Writing

    def __call__(self, source: Path, target: Path) -> Report:
        """Report of the file."""
        drawing = self.reading.read(source)
        if isinstance(drawing, ss.Shape):
            raise ss.InvalidInputError(
                f"{source} holds points, not curves: fit it, or write its outlines with trace"
            )
        ss.write(target, drawing, **self.writing.given())
        points = sum(fit.n_stored_points for fit in drawing)
        curves = "1 curve" if len(drawing) == 1 else f"{len(drawing)} curves"
        return Report(
            str(source),
            text=f"{target}: {curves}, {points} points",
            record={"output": str(target), **drawing_record(drawing)},
        )


@gathers(reading=options.Reading, writing=options.Writing)
def trace(
    sources: options.Inputs,
    output: options.Output,
    ending: options.Format = None,
    jobs: options.Jobs = 1,
    scheduler: options.Scheduler = None,
    resume: options.Resume = False,
    as_json: options.AsJson = False,
    stdin_format: options.StdinFormat = "png",
    *,
    left_out: Annotated[
        bool,
        Option("--left-out", help="Write what was left out as noise, not what was kept."),
    ] = False,
    reading: options.Reading,
    writing: options.Writing,
) -> None:
    """Write the outlines of pictures, or of other files, as polylines: nothing is fitted."""
    run_files(
        lambda found: TraceFile(reading, writing, left_out, alone=len(found) == 1),
        Batch(
            sources, output, ending, stdin_format, as_json, jobs, scheduler, resume, writing.given()
        ),
    )


@gathers(reading=options.Reading, writing=options.Writing)
def convert(
    sources: options.Inputs,
    output: options.Output,
    ending: options.Format = None,
    jobs: options.Jobs = 1,
    scheduler: options.Scheduler = None,
    resume: options.Resume = False,
    as_json: options.AsJson = False,
    stdin_format: options.StdinFormat = "json",
    *,
    reading: options.Reading,
    writing: options.Writing,
) -> None:
    """Write the curves of drawings in another format: the same curves, nothing is fitted."""
    run_files(
        lambda _: ConvertFile(reading, writing),
        Batch(
            sources, output, ending, stdin_format, as_json, jobs, scheduler, resume, writing.given()
        ),
    )
