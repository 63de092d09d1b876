"""Settings of a fit in a file, TOML or JSON, so that a job can be repeated."""

from __future__ import annotations

import json
import tomllib
from typing import TYPE_CHECKING, Any

import shapespline as ss

if TYPE_CHECKING:
    from pathlib import Path

    from shapespline.fitting import Settings

GOALS = ("tolerance", "n_control_points")
# Options of a fit that no command can say are not in a file either.
NAMES = (
    *GOALS, "degree", "corners", "form", "effort", "ends", "symmetric", "character", "regularities",
    "simplify", "smoothness", "outliers", "sigma", "loss", "time_limit",
)  # fmt: skip


def load(path: Path) -> dict[str, Any]:
    """Options in a file.

    Raises
    ------
    FormatError
        If the file is missing, no TOML or JSON, of another version, or names an unknown option.
    """
    from shapespline.fitting import SETTINGS_VERSION

    try:
        text = path.read_text(encoding="utf-8")
        found = json.loads(text) if path.suffix.lower() == ".json" else tomllib.loads(text)
    except OSError as error:
        raise ss.FormatError(f"cannot read {path}: {error.strerror or error}") from error
    except ValueError as error:
        kind = "JSON" if path.suffix.lower() == ".json" else "TOML"
        raise ss.FormatError(f"{path}: no settings in {kind}: {error}") from error
    if not isinstance(found, dict):
        raise ss.FormatError(
            f"{path}: settings are names with values, got a {type(found).__name__}"
        )
    version = found.pop("version", SETTINGS_VERSION)
    if version != SETTINGS_VERSION:
        raise ss.FormatError(
            f"{path}: settings of version {version}; this program reads version {SETTINGS_VERSION}:"
            " save them again with --save-settings"
        )
    for name in found:
        if name not in NAMES:
            raise ss.FormatError(f"{path}: {name} is no setting; these are: {', '.join(NAMES)}")
    for name in ("corners", "regularities"):
        if found.get(name) == "none":
            found[name] = None
    return found


def merged(saved: dict[str, Any], typed: dict[str, Any]) -> dict[str, Any]:
    """What was typed before what was saved; a goal that was typed takes the place of the other.

    Examples
    --------
    >>> merged({"tolerance": 1.0, "effort": "fast"}, {"n_control_points": 12})
    {'effort': 'fast', 'n_control_points': 12}
    """
    if any(name in typed for name in GOALS):
        saved = {name: value for name, value in saved.items() if name not in GOALS}
    return {**saved, **typed}


def save(path: Path, settings: Settings) -> None:
    """Write settings; what differs from the defaults is in the file, nothing else.

    Raises
    ------
    FormatError
        If the file cannot be written.
    """
    from shapespline.formats import write_atomically

    text = settings.to_toml()
    if path.suffix.lower() == ".json":
        text = json.dumps(tomllib.loads(text), indent=2) + "\n"
    write_atomically(path, text.encode("utf-8"))
