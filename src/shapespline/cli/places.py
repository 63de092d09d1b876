"""Which files a command reads and which it writes: folders, patterns, standard streams."""

from __future__ import annotations

import contextlib
import glob
import re
import shutil
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

# Stands for standard input, or standard output.
STREAM = "-"
# Of a result whose name was not given: every browser and drawing program opens it.
DEFAULT_ENDING = "svg"
# Begins the names of the files in which standard streams are kept; no message names them.
STREAM_FILE = "shapespline-stream"


def inputs(given: Sequence[str]) -> list[Path]:
    """The files meant: those named, those of a pattern, those of a folder that can be read.

    Each once, in the order given, those of a folder or pattern sorted.
    """
    from shapespline.formats import readable

    found: dict[Path, None] = {}
    for text in given:
        path = Path(text)
        if path.is_dir():
            inside = sorted(p for p in path.iterdir() if p.suffix.lower() in readable())
            if not inside:
                raise ss.FormatError(
                    f"{text} holds no file that can be read; readable endings:"
                    f" {' '.join(readable())}"
                )
            found.update(dict.fromkeys(inside))
        elif glob.has_magic(text) and not path.exists():
            matches = sorted(Path(match) for match in glob.iglob(text, recursive=True))  # noqa: PTH207 - absolute ones too
            if not matches:
                raise ss.FormatError(f"no file matches {text}")
            found.update(dict.fromkeys(match for match in matches if match.is_file()))
        else:
            found[path] = None
    return list(found)


def beside(
    sources: Sequence[Path],
    ending: str | None,
    writing: Mapping[str, object],
    *,
    force: bool,
    resume: bool,
) -> list[Path]:
    """For each input a file of its name beside it, which is not there yet, or may be replaced."""
    from shapespline.formats import check_output

    suffix = f".{(ending or DEFAULT_ENDING).lstrip('.').lower()}"
    targets = [source.with_suffix(suffix) for source in sources]
    for source, target in zip(sources, targets, strict=True):
        if targets.count(target) > 1:
            raise ss.InvalidInputError(
                f"several inputs would be written to {target}; name a folder with --output"
            )
        never_the_input(source, target)
        if target.exists() and not (force or resume):
            raise ss.InvalidInputError(
                f"{target} exists; say --force to replace it, or another name with --output"
            )
        check_output(target, **writing)
    return targets


def outputs(
    sources: Sequence[Path], output: str, ending: str | None, writing: Mapping[str, object]
) -> list[Path]:
    """For each input the file to write: the one named, or one of its name in the folder named.

    Inputs that differ in their ending alone keep it: ``logo.png.svg``. Nothing is written yet,
    but everything that can be known beforehand is checked.
    """
    from shapespline.formats import check_output

    target = Path(output)
    suffix = "" if ending is None else f".{ending.lstrip('.').lower()}"
    in_folder = len(sources) > 1 or target.is_dir() or (bool(suffix) and not target.suffix)
    if not in_folder:
        targets = [target]
    elif target.suffix and not target.is_dir():
        raise ss.InvalidInputError(
            f"{target} is one file for {len(sources)} inputs; name a folder, and --format"
        )
    elif not suffix:
        raise ss.InvalidInputError(
            f"{target} is a folder: say with --format which files to write into it"
        )
    else:
        stems = [source.stem for source in sources]
        targets = [
            target / f"{source.stem if stems.count(source.stem) == 1 else source.name}{suffix}"
            for source in sources
        ]
        twice = next((path for path in targets if targets.count(path) > 1), None)
        if twice is not None:
            raise ss.InvalidInputError(
                f"several inputs would be written to {twice}; fit them into different folders"
            )
    for source, path in zip(sources, targets, strict=True):
        never_the_input(source, path)
        # A folder yet to be made is checked by making it, when everything else is known to be well.
        check_output(Path(path.name) if in_folder and not target.exists() else path, **writing)
    if in_folder and not target.exists():
        target.mkdir()
    return targets


def never_the_input(source: Path, target: Path) -> None:
    """Raise if a result would take the place of what it is made from."""
    if target.exists() and source.exists() and target.samefile(source):
        raise ss.InvalidInputError(f"{target} is the input itself; choose another name")


def is_done(source: Path, target: Path) -> bool:
    """Whether an earlier run wrote the target: it is there, whole, and newer than its input."""
    return target.exists() and source.exists() and target.stat().st_mtime >= source.stat().st_mtime


def unnamed_stream(text: str) -> str:
    """A message without the names of the files that stand for the standard streams meanwhile."""
    for role, said in (("in", "standard input"), ("out", "standard output")):
        text = re.sub(rf"(?:\S*[\\/])?{STREAM_FILE}-{role}\.\w+", said, text)
    return text


@contextlib.contextmanager
def standard_input(given: Sequence[str], ending: str) -> Iterator[list[str]]:
    """The same names, with ``-`` replaced by a temporary file that holds standard input."""
    if STREAM not in given:
        yield list(given)
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{STREAM_FILE}-in.{ending.lstrip('.').lower()}"
        path.write_bytes(sys.stdin.buffer.read())
        yield [str(path) if text == STREAM else text for text in given]


@contextlib.contextmanager
def standard_output(output: str | None, ending: str | None) -> Iterator[str | None]:
    """The same name, or for ``-`` a temporary file that is copied to standard output at the end."""
    if output != STREAM:
        yield output
        return
    if ending is None:
        raise ss.InvalidInputError("say with --format what to write to standard output")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{STREAM_FILE}-out.{ending.lstrip('.').lower()}"
        yield str(path)
        if path.exists():
            with path.open("rb") as file:
                shutil.copyfileobj(file, sys.stdout.buffer)
            sys.stdout.buffer.flush()
