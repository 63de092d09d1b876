"""``shapespline compare`` and ``shapespline info``: what files hold, and how far they differ."""

from __future__ import annotations

import json
from dataclasses import asdict, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import shapespline as ss
from shapespline.cli import options, places
from shapespline.cli.gathering import gathers
from shapespline.cli.jobs import run_all
from shapespline.cli.reports import Report, drawing_record, say

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline import Drawing, Shape

# What pixels and files that say no unit are in.
NUMBERS = "pixels or plain numbers"


@gathers(reading=options.Reading)
def compare(
    first: options.Input,
    second: options.Input,
    as_json: options.AsJson = False,
    stdin_format: options.StdinFormat = "csv",
    *,
    reading: options.Reading,
) -> None:
    """Print how far the curves or outlines of two files lie apart, both ways."""
    with places.standard_input([first, second], stdin_format) as given:
        a, b = (one.read(path) for path, one in _each(reading, Path(given[0]), Path(given[1])))
    units = [NUMBERS if one.unit in (None, "px") else one.unit for one in (a, b)]
    if units[0] != units[1]:
        say(
            f"{first} is in {units[0]}, {second} in {units[1]}: their numbers are compared;"
            " --unit says one for both"
        )
    found = ss.compare(a, b)
    if as_json:
        record = {**asdict(found), "hausdorff_distance": found.hausdorff_distance}
        click.echo(json.dumps({"first": first, "second": second, **record}))
        return
    click.echo(f"{first} to {second}: max {found.forward_max:.6g}, rms {found.forward_rms:.6g}")
    click.echo(f"{second} to {first}: max {found.reverse_max:.6g}, rms {found.reverse_rms:.6g}")
    click.echo(
        f"two-sided distance {found.hausdorff_distance:.6g}, sampled every {found.spacing:.3g}"
    )


def _each(
    reading: options.Reading, first: Path, second: Path
) -> Iterator[tuple[Path, options.Reading]]:
    """The files with their options: one that only the format of the other takes is not theirs."""
    from shapespline.formats import read_options

    taken = set(read_options(first)), set(read_options(second))
    for path, own, other in zip((first, second), taken, reversed(taken), strict=True):
        theirs: dict[str, Any] = {
            one.name: one.default for one in fields(reading) if one.name in other - own
        }
        yield path, replace(reading, **theirs)


@gathers(reading=options.Reading)
def info(
    sources: options.Inputs,
    as_json: options.AsJson = False,
    stdin_format: options.StdinFormat = "csv",
    *,
    reading: options.Reading,
) -> None:
    """Print what every INPUT holds: outlines or curves, points, size, nesting."""

    def describe(source: Path, _: Path) -> Report:
        held = reading.read(source)
        record = _record(held)
        return Report(str(source), text=f"{source}: {_sentence(record)}", record=record)

    n_failed = 0
    with places.standard_input(sources, stdin_format) as given:
        found = places.inputs(given)
        for report in run_all(describe, [(source, source) for source in found]):
            report.show(as_json, named=len(found) > 1)
            n_failed += report.error is not None
    if n_failed:
        raise click.exceptions.Exit(1)


def _record(held: Shape | Drawing) -> dict[str, Any]:
    """What a file holds, for scripts."""
    import numpy as np

    contours = list(held) if isinstance(held, ss.Shape) else [fit.contour for fit in held]
    points = np.concatenate([contour.points for contour in contours])
    low, high = points.min(axis=0), points.max(axis=0)
    record: dict[str, Any] = {
        "outlines": len(contours),
        "closed": sum(contour.closed for contour in contours),
        "holes": sum(held.is_hole(index) for index in range(len(held))),
        "points": sum(contour.n_given for contour in contours),
        "length": sum(contour.length for contour in contours),
        "box": [*low.tolist(), *high.tolist()],
    }
    if not isinstance(held, ss.Shape):
        record |= drawing_record(held)
    return record


def _sentence(record: dict[str, Any]) -> str:
    x0, y0, x1, y1 = record["box"]
    size = f"{x1 - x0:.6g} x {y1 - y0:.6g} at ({x0:.6g}, {y0:.6g}), length {record['length']:.6g}"
    if "curves" in record:
        curves = record["curves"]
        stored = sum(curve["stored_points"] for curve in curves)
        degrees = sorted({curve["degree"] for curve in curves})
        kind = f"{len(curves)} curve{'s' * (len(curves) > 1)} of degree {_listed(degrees)}"
        kind += f", {stored} stored points, fitted to {record['points']} points"
    else:
        kind = f"{record['outlines']} outline{'s' * (record['outlines'] > 1)}"
        kind += f", {record['points']} points"
    return f"{kind}, {record['closed']} closed, {record['holes']} holes; {size}"


def _listed(values: list[int]) -> str:
    return ", ".join(map(str, values))
