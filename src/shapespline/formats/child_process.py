"""Python begun anew beside this program: a process that answers one question after the other.

What ends it ends nothing else, and it can be ended at any moment (FMT-16, STU-05).
"""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
from contextlib import suppress
from functools import partial
from typing import IO, TYPE_CHECKING, Any, ClassVar, cast

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.monitor import Say

# It begins without the file that the program was started with, which may begin such processes, too.
BEGIN = "import sys; sys.path[:] = sys.argv[1:]; from {module} import serve; serve()"


class ChildProcess:
    """A process whose life is the ``serve`` of a module, which calls :meth:`serve` here.

    Raises
    ------
    OSError
        If it cannot be begun.
    """

    # Whether this program is such a process itself.
    is_this: ClassVar[bool] = False

    def __init__(self, module: str) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-c", BEGIN.format(module=module), *sys.path],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )

    @property
    def pid(self) -> int:
        """Its number."""
        return self._process.pid

    @property
    def has_ended(self) -> bool:
        """Whether it is there no longer."""
        return self._process.poll() is not None

    def asked(self, question: Any, heard: Say | None = None) -> Any:
        """The answer; None if the process ended instead. ``heard`` is told what it says before."""
        try:
            _say(cast("IO[bytes]", self._process.stdin), question)
            while isinstance(answer := pickle.load(cast("IO[bytes]", self._process.stdout)), str):
                if heard is not None:
                    heard(answer)
        except (EOFError, OSError, pickle.UnpicklingError):
            self.end()
            return None
        return answer

    def kill(self) -> None:
        """End it while another thread waits for its answer."""
        self._process.kill()

    def end(self) -> None:
        """End it, and leave nothing of it."""
        self._process.kill()
        with self._process:
            pass

    @classmethod
    def serve(cls, answer: Callable[[Any, Say], Any]) -> None:
        """Answer what comes in; the life of such a process.

        Answers are not None and no strings; those are what ``answer`` may say meanwhile.
        """
        cls.is_this = True
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        # What libraries print must not come between the answers.
        answers = os.fdopen(os.dup(1), "wb")
        os.dup2(2, 1)
        say = partial(_say, answers)
        with suppress(EOFError):
            while True:
                say(answer(pickle.load(sys.stdin.buffer), say))


def _say(file: IO[bytes], said: Any) -> None:
    pickle.dump(said, file, pickle.HIGHEST_PROTOCOL)
    file.flush()
