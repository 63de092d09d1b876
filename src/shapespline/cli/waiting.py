"""What is going on, said on a terminal when a step takes longer than two seconds."""

from __future__ import annotations

import contextlib
import sys
import threading
from time import monotonic
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

# Seconds of silence that nobody minds, and between two lines after them.
PATIENCE = 2.0
EVERY = 0.5


@contextlib.contextmanager
def said_when_long(on: bool = True) -> Iterator[Line]:
    """Take sentences on what is going on; the last one is shown, with the seconds it has taken.

    Nothing is shown within two seconds, nor where standard error is no terminal.
    """
    line = Line()
    if not (on and sys.stderr.isatty()):
        yield line
        return
    thread = threading.Thread(target=line.run, daemon=True)
    thread.start()
    try:
        yield line
    finally:
        line.over.set()
        thread.join()


class Line:
    """One line of a terminal, written again and again, gone at the end."""

    def __init__(self) -> None:
        self.over = threading.Event()
        self._writing = threading.Lock()
        self._sentence = ""
        self._began = monotonic()
        self._shown = 0

    def __call__(self, sentence: str) -> None:
        """What is going on from now on."""
        self._sentence = sentence

    def hide(self) -> None:
        """Make room for a line that stays; the next sentence is shown again."""
        with self._writing:
            self._sentence = ""
            if self._shown:
                self._write("")

    def run(self) -> None:
        """Show the sentences until it is over."""
        wait = PATIENCE
        while not self.over.wait(wait):
            wait = EVERY
            with self._writing:
                if self._sentence:
                    self._write(f"{self._sentence}, {monotonic() - self._began:.0f} s")
        self.hide()

    def _write(self, text: str) -> None:
        sys.stderr.write(f"\r{text.ljust(self._shown)}" + ("" if text else "\r"))
        sys.stderr.flush()
        self._shown = len(text)
