"""Outputs: files to take away, and text that makes the same fit again."""

from __future__ import annotations

import json
import shlex
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from shapespline.errors import InvalidInputError
from shapespline.fitting import Settings
from shapespline.formats import writable, write

if TYPE_CHECKING:
    from collections.abc import Mapping

    from shapespline.studio.asked import Asked
    from shapespline.values import Drawing

# Options of `write` that a page may say.
OPTIONS = {"unit", "scale", "arcs", "arc_tolerance", "chord"}


def encoded(drawing: Drawing, ending: str, options: Mapping[str, Any] | None = None) -> bytes:
    """A drawing as the bytes of a file of a kind.

    Raises
    ------
    UnknownFormatError, FormatError, InvalidInputError, MissingExtraError
        If there is no such kind, or it cannot hold the drawing as asked.
    """
    if ending not in writable():
        raise InvalidInputError(f"format must be one of {' '.join(writable())}, got {ending!r}")
    for name in options or ():
        if name not in OPTIONS:
            raise InvalidInputError(f"{name} is no option of writing; reload the page")
    given = {
        name: value for name, value in (options or {}).items() if value not in (None, "", False)
    }
    with TemporaryDirectory() as folder:
        path = Path(folder, "drawing" + ending)
        write(path, drawing, **given)
        return path.read_bytes()


def settings_text(asked: Asked) -> str:
    """The settings as a file for ``--settings``."""
    return Settings.from_dict(asked.common).to_toml()


def command_line(asked: Asked) -> str:
    """The command that makes the same fits.

    Raises
    ------
    InvalidInputError
        If single outlines have settings of their own, which no option says.
    """
    if asked.own:
        raise InvalidInputError(
            "the command line knows no corners, held or moved points of single outlines;"
            " copy the Python, or undo them"
        )
    words = ["shapespline", "fit", asked.document.name]
    words += _words(asked.document.options) + _words(Settings.from_dict(asked.common).to_dict())
    words += ["-o", PurePosixPath(asked.document.name).stem + "_fit.svg"]
    return shlex.join(words)


def _words(options: Mapping[str, Any]) -> list[str]:
    """Options as the command line says them."""
    names = {"n_control_points": "control-points"}
    words = []
    for name, value in options.items():
        if value in (None, "", False) and name != "corners":
            continue
        if name == "closed" and value is False:
            words.append("--open")
            continue
        option = "--" + names.get(name, name.replace("_", "-"))
        words += [option] if value is True else [option, "none" if value is None else f"{value}"]
    return words


def python_text(asked: Asked) -> str:
    """A script that makes the same fits."""
    document = asked.document
    given = {
        name: value for name, value in document.options.items() if value not in (None, "", False)
    }
    reading = "".join(f", {name}={value!r}" for name, value in given.items())
    lines = ["import shapespline as ss", "", f"found = ss.read({document.name!r}{reading})"]
    common = Settings.from_dict(asked.common).to_dict()
    if PurePosixPath(document.name).suffix.lower() in (".svg", ".dxf", ".json", ".step", ".igs"):
        lines += ["shape = found.shape"]
    else:
        lines += ["shape = found"]
    if not asked.own:
        if asked.shared_boundaries:
            common = {**common, "shared_boundaries": True}
        lines += [f"drawing = ss.fit_shape(shape, {_arguments(common)})"]
    else:
        lines += [f"settings = dict({_arguments(common)})", "contours = list(shape)", "fits = []"]
        lines += ["own = {"]
        for index in sorted(asked.own):
            if asked.moves(index):
                raise InvalidInputError(
                    "a script reads the file, whose points were moved here by hand;"
                    " export them as JSON with the fit, or undo that"
                )
            own = asked.settings(index).to_dict()
            lines += [f"    {index}: { ({k: v for k, v in own.items() if common.get(k) != v})!r},"]
        lines += [
            "}",
            "for index, contour in enumerate(contours):",
            "    fits.append(ss.fit_curve(contour, **{**settings, **own.get(index, {})}))",
            "drawing = ss.Drawing.of(shape, fits)",
        ]
    target = PurePosixPath(document.name).stem + "_fit.svg"
    return "\n".join([*lines, f"ss.write({json.dumps(target)}, drawing)", ""])


def _arguments(options: Mapping[str, Any]) -> str:
    return ", ".join(f"{name}={value!r}" for name, value in options.items())
