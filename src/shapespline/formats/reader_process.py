"""A process of its own for readers that call libraries in C++.

Some damage to a file ends such a library, and the process that called it along with it. Here that
is the process that reads, which the caller hears of in a sentence (FMT-16); and what does not come
back can be interrupted.
"""

from __future__ import annotations

import atexit
import os
import sys
import threading
import traceback
import warnings
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from shapespline.errors import FormatError, ShapesplineError, caller_level, require
from shapespline.formats.child_process import ChildProcess

if TYPE_CHECKING:
    from collections.abc import Mapping

    from shapespline.monitor import Say


class Question(NamedTuple):
    """A file to read: the module whose ``read`` knows it, and what that needs, as for `require`."""

    module: str
    needs: tuple[tuple[str, str, str], ...]
    path: Path
    options: Mapping[str, object]


class ReaderProcess:
    """Reads one file after the other; begun when it is first asked, and again after it has died."""

    def __init__(self) -> None:
        self._process: ChildProcess | None = None
        self._lock = threading.Lock()

    def read(self, question: Question) -> Any:
        """What the format's reader finds; its errors and warnings are raised and given here."""
        with self._lock:
            try:
                answer = self._asked(question)
            except BaseException:  # interrupted: the answer is still to come
                self._end()
                raise
        if answer is None:
            raise FormatError(
                "the library that reads such files ended: this one must be damaged; write it again,"
                " or as DXF or SVG"
            )
        found, said, error = answer
        for category, text in said:
            warnings.warn(text, category, stacklevel=caller_level())
        if error is not None:
            raise error
        return found

    def _asked(self, question: Question) -> Any:
        """The answer of the process; None if it ended."""
        if self._process is None or self._process.has_ended:
            try:
                self._process = ChildProcess(__name__)
            except OSError as error:
                raise FormatError(f"no process to read the file can be begun: {error}") from error
        return self._process.asked(question)

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.end()

    def close(self) -> None:
        """End the process."""
        with self._lock:
            self._end()

    def forget(self) -> None:
        """In a copy of the program that fork made: the process is not its own."""
        self._process, self._lock = None, threading.Lock()


def read_apart(question: Question) -> Any:
    """What the format's reader finds, in a process of its own where one can be begun.

    Raises
    ------
    FormatError
        If reading ends the process.
    ShapesplineError, OSError
        As the reader does.
    """
    return _READER.read(question) if can_begin() else read_here(question)


def serve() -> None:
    """The life of the process that reads."""
    ChildProcess.serve(_answer)


def _answer(question: Question, _: Say) -> Any:
    """What was found, warnings, and None; or the error."""
    found, error = None, cast("Exception | None", None)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            found = read_here(question)
        except (ShapesplineError, OSError) as refusal:
            error = refusal.with_traceback(None)
        except Exception as fault:
            error = RuntimeError(f"{fault!r}\n{traceback.format_exc()}")
    return found, [(one.category, str(one.message)) for one in said], error


def read_here(question: Question) -> Any:
    """What the format's reader finds, in this process."""
    for needed in question.needs:
        require(*needed)
    return import_module(question.module).read(question.path, **question.options)


def can_begin() -> bool:
    """Whether a process is wanted and this program begins Python when it is begun again.

    Not if Python lies within it.
    """
    program = Path(sys.executable or "").stem.lower()
    alone = ChildProcess.is_this or getattr(sys, "frozen", False)
    return not alone and ("python" in program or "pypy" in program)


_READER = ReaderProcess()
atexit.register(_READER.close)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_READER.forget)
