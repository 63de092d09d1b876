"""Sizes and times of this version beside those of an earlier commit, fits of both in turn.

    python -m benchmarks.versions 01e33ba             the project's outlines, pictures of drawings
    python -m benchmarks.versions 01e33ba --all       the outlines of ../shared/data, too
    python -m benchmarks.versions 01e33ba --every 4   each fourth of them

The commit is built into a folder that is removed again. Outlines are searched for the fewest points
in both, as the earlier version has nothing else, and as drawn in this one; pictures of 256 pixels
are fitted within 0.35 by default. Seconds of the processor, the best of three runs; the points of a
fit that one version refuses do not count.
"""

from __future__ import annotations

import argparse
import json
import os
import pickle
import subprocess
import sys
import tarfile
import tempfile
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from PIL import Image

from benchmarks.drawn.catalogue import drawings
from benchmarks.drawn.tables import rendered
from benchmarks.quality import large_corpus, own_corpus

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).resolve().parents[1]
CHILD = ROOT / "benchmarks" / "version_child.py"
PERCENT, WITHIN, SIZE = (0.5, 0.1, 0.02), 0.35, 256
FEWEST = {"character": "fewest"}


class Task(NamedTuple):
    """A row of the table, what is fitted, and what only this version is told."""

    row: str
    given: tuple[object, object, object, dict[str, object]]
    own: dict[str, object]

    def for_child(self, *, is_own: bool) -> tuple[object, ...]:
        """What the child is given."""
        points, closed, path, options = self.given
        return points, closed, path, options | (self.own if is_own else {})


def built(commit: str, folder: Path) -> Path:
    """Where the package of a commit lies once it is built."""
    archive = subprocess.run(
        ["git", "archive", commit], cwd=ROOT, check=True, capture_output=True
    ).stdout
    source, package = folder / "source", folder / "package"
    with tarfile.open(fileobj=BytesIO(archive)) as file:
        file.extractall(source, filter="data")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps"]
    subprocess.run([*pip, "--target", str(package), str(source)], check=True)
    return package


def tasks(folder: Path, asked: argparse.Namespace) -> Iterator[Task]:
    """Everything that both fit."""
    outlines = [*own_corpus(), *(large_corpus() if asked.all else ())][:: asked.every]
    for percent in PERCENT:
        for outline in outlines:
            contour = outline.contour
            options = {"tolerance": percent / 100 * contour.box_diagonal}
            given = (contour.points, contour.closed, None, options)
            yield Task(f"outlines at {percent:g} %, fewest points", given, FEWEST)
            yield Task(f"outlines at {percent:g} %, as drawn", given, {})
    for name, drawing in list(drawings().items())[:: asked.every]:
        path = folder / f"{name}.png"
        pixels = np.asarray(rendered(name, SIZE)[1])
        Image.fromarray(pixels).save(path)
        given = (None, None, str(path), {"tolerance": WITHIN})
        yield Task(f"pictures of {drawing.kind}s, as drawn", given, {})
        yield Task(f"pictures of {drawing.kind}s, fewest points", given, FEWEST)


def answers(
    package: Path | None, given: list[tuple[object, ...]], folder: Path
) -> list[list[float]]:
    """What a version makes of tasks, not a number where it refuses; None is the one installed."""
    before, after = folder / "tasks.pickle", folder / "found.json"
    before.write_bytes(pickle.dumps(given))
    subprocess.run(
        [
            sys.executable,
            "-P",
            str(CHILD),
            str(before),
            str(after),
            *([str(package)] if package else []),
        ],
        check=True,
        env=os.environ | {"OMP_NUM_THREADS": "1"},
    )
    found = json.loads(after.read_text(encoding="utf-8"))
    return [one or [np.nan, np.nan] for one in found]


def main() -> None:
    """Build, fit, print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.versions")
    parser.add_argument("commit")
    parser.add_argument("--all", action="store_true", help="the large corpus, too")
    parser.add_argument("--every", type=int, default=1)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        theirs = built(asked.commit, folder)
        all_tasks = list(tasks(folder, asked))
        rows = list(dict.fromkeys(task.row for task in all_tasks))
        print("| | fits | points: geometric mean, sum | seconds: median, sum |")
        print("|---|---|---|---|", flush=True)
        for row in rows:
            mine = [task for task in all_tasks if task.row == row]
            now, then = (
                np.array(answers(at, [task.for_child(is_own=own) for task in mine], folder))
                for at, own in ((None, True), (theirs, False))
            )
            ratios = now / then
            both = np.isfinite(ratios).all(axis=1)
            seconds, points = ratios[both].T
            sums = now[both].sum(axis=0) / then[both].sum(axis=0)
            print(
                f"| {row} | {both.sum()} | {np.exp(np.log(points).mean()):.3f}, {sums[1]:.3f}"
                f" | {np.median(seconds):.2f}, {sums[0]:.2f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
