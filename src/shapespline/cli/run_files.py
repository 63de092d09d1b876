"""From the names on the command line to reports: what every command on many files does."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import click

import shapespline as ss
from shapespline.cli import places
from shapespline.cli.jobs import run_all

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from shapespline.cli.reports import Report

# Exit code where everything was written, and a tolerance is not kept.
EXCEEDED = 3


@dataclass(frozen=True)
class Batch:
    """What the user said about inputs, outputs and how to run."""

    given: Sequence[str]
    output: str | None
    ending: str | None
    stdin_ending: str
    as_json: bool
    n_jobs: int = 1
    scheduler: str | None = None
    resume: bool = False
    writing: Mapping[str, object] = field(default_factory=dict)
    force: bool = False

    def targets(self, sources: Sequence[Path], output: str | None) -> list[Path]:
        """The file to write for each input."""
        if output is None:
            return places.beside(
                sources, self.ending, self.writing, force=self.force, resume=self.resume
            )
        return places.outputs(sources, output, self.ending, self.writing)


def run_files(
    work_on: Callable[[Sequence[Path]], Callable[[Path, Path], Report]], batch: Batch
) -> None:
    """Work on every input and show each report.

    ``work_on`` is given the files that were found, of which it may refuse to work on any, and
    returns what to do with each.

    Raises
    ------
    click.exceptions.Exit
        With code 1 if an input failed; the others have been written. With code 3 if all were
        written, and a curve keeps less than its tolerance.
    """
    if batch.output is None and places.STREAM in batch.given:
        raise ss.InvalidInputError("say with --output where the result of standard input goes")
    to_stream = batch.output == places.STREAM
    with contextlib.ExitStack() as stack:
        given = stack.enter_context(places.standard_input(batch.given, batch.stdin_ending))
        output = stack.enter_context(places.standard_output(batch.output, batch.ending))
        sources = places.inputs(given)
        if to_stream and len(sources) > 1:
            raise ss.InvalidInputError(
                f"standard output takes one drawing, got {len(sources)} inputs; name a folder"
            )
        work = work_on(sources)
        pairs = list(zip(sources, batch.targets(sources, output), strict=True))
        if batch.resume:
            pairs = [pair for pair in pairs if not places.is_done(*pair)]
        n_failed = n_exceeded = 0
        for report in run_all(work, pairs, n_jobs=batch.n_jobs, scheduler=batch.scheduler):
            report.show(batch.as_json, named=len(sources) > 1, on_stderr=to_stream)
            n_failed += report.error is not None
            n_exceeded += report.exceeded
    if n_failed:
        raise click.exceptions.Exit(1)
    if n_exceeded:
        raise click.exceptions.Exit(EXCEEDED)
