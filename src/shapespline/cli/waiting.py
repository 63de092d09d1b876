"""What is going on, said on a terminal when a step takes longer than two seconds."""

from __future__ import annotations

import contextlib
import sys
import threading
from time import monotonic
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# Seconds of silence that nobody minds, and between two lines after them.
PATIENCE = 2.0
EVERY = 0.5


@contextlib.contextmanager
def said_when_long(on: bool = True) -> Iterator[Callable[[str], None]]:
    """Take sentences on what is going on; the last one is shown, with the seconds it has taken.

    Nothing is shown within two seconds, nor where standard error is no terminal.
    """
    if not (on and sys.stderr.isatty()):
        yield lambda sentence: None
        return
    line = _Line()
    thread = threading.Thread(target=line.run, daemon=True)
    thread.start()
    try:
        yield line.say
    finally:
        line.over.set()
        thread.join()


class _Line:
    """One line of a terminal, written again and again, gone at the end."""

    def __init__(self) -> None:
        self.over = threading.Event()
        self._sentence = ""
        self._began = monotonic()

    def say(self, sentence: str) -> None:
        self._sentence = sentence

    def run(self) -> None:
        shown = 0
        wait = PATIENCE
        while not self.over.wait(wait):
            wait = EVERY
            text = f"{self._sentence}, {monotonic() - self._began:.0f} s"
            sys.stderr.write(f"\r{text.ljust(shown)}")
            sys.stderr.flush()
            shown = len(text)
        if shown:
            sys.stderr.write(f"\r{' ' * shown}\r")
            sys.stderr.flush()
