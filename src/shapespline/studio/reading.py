"""Reading: files are read in processes of their own.

So reading can be ended at any moment, has a limit of time, and a library that dies on a damaged
file takes nothing else along (STU-05).
"""

from __future__ import annotations

import tempfile
import threading
import traceback
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from time import monotonic
from typing import TYPE_CHECKING, Any

from shapespline.errors import FormatError, InvalidInputError, ShapesplineError
from shapespline.formats import ChildProcess
from shapespline.studio.documents import Document, checked, opened
from shapespline.studio.jobs import Cancelled

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from shapespline.monitor import Say
    from shapespline.studio.jobs import Ticket

# Reading one file ends after so many seconds.
MOST_SECONDS = 120.0
# Seconds between two looks at whether a file is still wanted.
LOOK = 0.1


@dataclass
class Doing:
    """What a process does just now, in words."""

    text: str

    def told(self, text: str) -> None:
        """It does something else now."""
        self.text = text


class Readers:
    """Processes that read: one stands ready, more are started where several pages read at once."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._idle: ChildProcess | None = None
        self._closed = False

    def prepare(self) -> None:
        """Have a process ready, which takes a second to begin."""
        with self._lock:
            if self._idle is None and not self._closed:
                self._idle = _begun()

    def close(self) -> None:
        """End the process that stands ready."""
        with self._lock:
            self._closed = True
            idle, self._idle = self._idle, None
        if idle is not None:
            idle.end()

    def opened(
        self, name: object, content: bytes, options: Mapping[str, Any], ticket: Ticket
    ) -> Document:
        """The document that some bytes are, as `documents.opened` finds it.

        Raises
        ------
        Cancelled
            If it is no longer wanted: the process is ended at once.
        InvalidInputError, FormatError
            As there; also if reading takes too long, or ends the process.
        """
        name, began = checked(name, content, options), monotonic()
        with self._lock:
            process = self._idle or _begun()
            self._idle = None
        # Its temporary files are deleted here, however it ends.
        doing = Doing(f"reading {name}")
        with tempfile.TemporaryDirectory() as folder, _watched(process, doing, ticket):
            answer = process.asked((folder, name, content, dict(options)), doing.told)
        if answer is None:
            self.prepare()
            ticket.check()
            raise FormatError(
                f"{name}: files must be read within {MOST_SECONDS:.0f} s, and this one is not"
                if monotonic() - began > MOST_SECONDS
                else f"{name}: a library ended while it read the file, which must be damaged"
            )
        self._keep(process)
        ticket.check()
        shape, sentences, error = answer
        if error is not None:
            raise error
        return Document(name, content, dict(options), shape, sentences)

    def _keep(self, process: ChildProcess) -> None:
        """Have a process stand ready, or end it where one does."""
        with self._lock:
            wanted = self._idle is None and not self._closed
            if wanted:
                self._idle = process
        if not wanted:
            process.end()


def serve() -> None:
    """The life of a process that reads."""
    ChildProcess.serve(_answer)


def _answer(question: tuple[str, str, bytes, Mapping[str, Any]], say: Say) -> Any:
    """Shape, sentences and None; or the error."""
    tempfile.tempdir, name, content, options = question
    try:
        document = opened(name, content, options, say)
    except ShapesplineError as error:
        return None, (), type(error)(str(error))
    except Exception as error:
        return None, (), RuntimeError(f"{error!r}\n{traceback.format_exc()}")
    return document.shape, document.sentences, None


def _begun() -> ChildProcess:
    try:
        return ChildProcess(__name__)
    except OSError as error:
        raise InvalidInputError(f"no process to read files can be begun: {error}") from error


@contextmanager
def _watched(process: ChildProcess, doing: Doing, ticket: Ticket) -> Iterator[None]:
    """Meanwhile say what it does; end it when it is not wanted, or takes too long."""
    done, began = threading.Event(), monotonic()

    def watch() -> None:
        while not done.wait(LOOK):
            seconds = monotonic() - began
            if not ticket.wanted or seconds > MOST_SECONDS:
                process.kill()
                return
            with suppress(Cancelled):
                ticket.say(f"{doing.text} for {seconds:.0f} s")

    watcher = threading.Thread(target=watch, name="studio-watch", daemon=True)
    watcher.start()
    try:
        yield
    finally:
        done.set()
        watcher.join()
