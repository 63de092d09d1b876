"""Write a file whole or not at all."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from shapespline.errors import FormatError


def check_target(path: str | os.PathLike[str]) -> Path:
    """Return the path to write to, or say why nothing can be written there.

    Meant to be asked before the work whose result is to be written.

    Raises
    ------
    FormatError
        If the folder does not exist, the path names a folder, or the file is write-protected.
    """
    path = Path(path)
    folder = path.parent
    if not folder.is_dir():
        reason = "is not a folder" if folder.exists() else "does not exist; create it first"
        raise FormatError(f"cannot write {path}: the folder {folder} {reason}")
    if path.is_dir():
        raise FormatError(f"cannot write {path}: it is a folder; name a file in it")
    if path.exists() and not os.access(path, os.W_OK):
        raise FormatError(f"cannot write {path}: the file is write-protected")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise FormatError(f"cannot write {path}: the folder {folder} is write-protected")
    return path


def write_atomically(path: str | os.PathLike[str], data: bytes) -> None:
    """Write bytes to a file so that it holds the old content or the new, never a part.

    The bytes go to a temporary file in the same folder, which then takes the place of the
    target; whatever happens, the temporary file does not stay. An existing file keeps its
    permissions, a new one gets the usual ones, a symbolic link keeps pointing to its target, and
    what is not a regular file (a named pipe) is written to directly.

    Parameters
    ----------
    path : path-like
    data : bytes

    Raises
    ------
    FormatError
        If the folder does not exist, or the operating system refuses.
    """
    path = check_target(path)
    try:
        target = path.resolve()
        if target.exists() and not target.is_file():
            target.write_bytes(data)
        else:
            _replace(target, data)
    except OSError as error:
        raise FormatError(f"cannot write {path}: {error.strerror or error}") from error


def _replace(target: Path, data: bytes) -> None:
    """Write a temporary file next to the target and rename it."""
    # A random name: no other run can be writing the same temporary file.
    temporary = target.with_name(f".{os.urandom(8).hex()}.tmp")
    try:
        # Created by open, not by tempfile: the permissions are then those of any new file.
        with temporary.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        if target.exists():
            temporary.chmod(stat.S_IMODE(target.stat().st_mode))
        temporary.replace(target)
    except BaseException:  # KeyboardInterrupt too: nothing may be left behind
        temporary.unlink(missing_ok=True)
        raise
