"""Lanes: threads that work on the newest of their jobs; an older one ends.

The loops of a fit are in the kernel, which lets other threads run and asks a callback whether to go
on: so threads do, and nothing is copied to a process.
"""

from __future__ import annotations

import threading
from time import monotonic
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.monitor import Iteration

    Work: TypeAlias = Callable[["Ticket"], None]


# Seconds between two words on how a job goes.
BETWEEN = 0.4


class Cancelled(Exception):  # noqa: N818 - no error: a newer request took its place
    """A job's answer is no longer wanted."""


class Ticket:
    """What a job is asked with: its number, and whether it is still wanted."""

    def __init__(self, generation: int, tell: Callable[[str], None] | None = None) -> None:
        self.generation = generation
        self._tell = tell
        self._told = monotonic()
        self._ended = threading.Event()

    def end(self) -> None:
        """Say that the answer is no longer wanted."""
        self._ended.set()

    @property
    def wanted(self) -> bool:
        """Whether the answer is."""
        return not self._ended.is_set()

    def check(self, record: Iteration | None = None) -> None:
        """Raise unless the answer is wanted: the callback of every search; tell how it goes."""
        if record is None:
            self.say("")
        else:
            so_far = f", {record.cost:.0f} points so far" if record.cost >= 1 else ""
            self.say(f"fitting for {record.seconds:.0f} s{so_far}")

    def say(self, sentence: str) -> None:
        """Raise unless the answer is wanted; tell what comes next, not too often."""
        if self._ended.is_set():
            raise Cancelled
        now = monotonic()
        if sentence and self._tell is not None and now - self._told > BETWEEN:
            self._told = now
            self._tell(sentence)


class Lane:
    """One thread that does the newest job that it was given.

    Examples
    --------
    >>> done, lane = threading.Event(), Lane("fits")
    >>> ticket = lane.submit(1, lambda ticket: done.set())
    >>> done.wait(10)
    True
    >>> lane.close()
    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._changed = threading.Condition()
        self._waiting: tuple[Ticket, Work] | None = None
        self._ticket: Ticket | None = None
        self._thread: threading.Thread | None = None
        self._closed = False

    def submit(
        self, generation: int, work: Work, tell: Callable[[str], None] | None = None
    ) -> Ticket:
        """Do a job as soon as the one before it has ended, which is told to."""
        ticket = Ticket(generation, tell)
        with self._changed:
            self._end_all()
            if self._closed:
                ticket.end()
                return ticket
            self._waiting = ticket, work
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
                self._thread.start()
            self._changed.notify()
        return ticket

    def cancel(self) -> None:
        """End the job that runs, and forget the one that waits."""
        with self._changed:
            self._end_all()
            self._waiting = None

    def close(self, seconds: float = 0.0) -> None:
        """End everything; wait so long for the thread, which no program waits for when it ends."""
        with self._changed:
            self._closed = True
            self._end_all()
            self._waiting = None
            self._changed.notify()
            thread = self._thread
        if thread is not None:
            thread.join(seconds)

    def _end_all(self) -> None:
        if self._ticket is not None:
            self._ticket.end()
        if self._waiting is not None:
            self._waiting[0].end()

    def _run(self) -> None:
        while True:
            with self._changed:
                while self._waiting is None and not self._closed:
                    self._changed.wait()
                if self._waiting is None:
                    return
                self._ticket, work = self._waiting
                self._waiting = None
                ticket = self._ticket
            if ticket.wanted:
                work(ticket)
            with self._changed:
                self._ticket = None
