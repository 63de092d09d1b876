"""The process that reads damaged files: a crash takes it along, and its parent notes which."""

from __future__ import annotations

import argparse
import faulthandler
import resource
import signal
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import shapespline as ss
from benchmarks.fuzz.mutate import mutated
from benchmarks.fuzz.seeds import EXTRAS, sound
from shapespline.formats import reader_process, registry

if TYPE_CHECKING:
    from types import FrameType

# A file of a few thousand bytes may not take longer, nor more memory than its process had.
SECONDS, MEGABYTES = 10.0, 1000.0
# More than that is not even lent. Libraries in C++ die of a refusal.
ADDRESS_SPACE = 8 << 30
# A process that is not back from one call for so long ends, and tells where it stood.
SILENCE = 3 * SECONDS
# Seconds from one look at the clock to the next.
TICK = 0.1
# Files that call libraries in C++.
CALLERS = frozenset({"occ.py", "step.py", "iges.py", "rhino.py"})


class TooLongError(BaseException):
    """Raised by the clock; no reader catches it."""


def calls_library(file: str) -> bool:
    """Whether code of a file, if it is the innermost of Python, stands in a call of a library."""
    path = Path(file)
    return path.parent.name == "formats" and path.name in CALLERS


class Clock:
    """Seconds of reading, those apart that calls of a library in C++ take in one go.

    A signal is heard between two steps of Python. One that comes late has waited for a call to
    return, in the frame where it is then heard. Short calls in a long loop are heard in time: the
    loop is ours.
    """

    def __init__(self) -> None:
        self.own = self.library = 0.0
        self.last = time.monotonic()

    def __enter__(self) -> Clock:
        signal.signal(signal.SIGALRM, self._heard)
        signal.setitimer(signal.ITIMER_REAL, TICK, TICK)
        return self

    def __exit__(self, *_: object) -> None:
        signal.setitimer(signal.ITIMER_REAL, 0)

    def _heard(self, _: int, frame: FrameType | None) -> None:
        now = time.monotonic()
        waited, self.last = now - self.last, now
        if waited > 2 * TICK and frame is not None and calls_library(frame.f_code.co_filename):
            self.library += waited
            return
        self.own += waited
        if self.own > SECONDS:
            signal.setitimer(signal.ITIMER_REAL, 0)
            raise TooLongError


def outcome(data: bytes, ending: str) -> str:
    """What becomes of a file: "read", "said", "library" if that hung, or a fault in words."""
    before, clock = _megabytes(), Clock()
    try:
        with clock:
            found = _read(data, ending)
    except TooLongError:
        found = f"FAULT more than {SECONDS:.0f} s"
    if not found.startswith("FAULT") and clock.library > SECONDS:
        found = "library"
    if _megabytes() > before + MEGABYTES:
        found = f"FAULT {_megabytes() - before:.0f} MB"
    return " ".join(found.split())


def _read(data: bytes, ending: str) -> str:
    try:
        held = ss.read(data, format=f".{ending}")
        found = "read" if len(held) else "FAULT nothing was read and nothing said"
    except ss.ShapesplineError as error:
        found = "said" if len(str(error)) > 10 else f"FAULT the sentence is {error}"
    except TooLongError:
        raise
    except BaseException as error:
        found = f"FAULT {type(error).__name__}: {error}"
    return found


def _megabytes() -> float:
    """The most memory that this process has had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> None:
    """Reads files from a seed on until the time is over; one line before and one after each."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fuzz.child")
    parser.add_argument("ending")
    parser.add_argument("first", type=int)
    parser.add_argument("seconds", type=float)
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    faulthandler.enable()
    # Libraries are called here: their time is told from ours, and what ends them ends this process.
    registry.read_apart = reader_process.read_here
    if asked.ending not in EXTRAS:
        resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
    files, until, seed = sound(asked.ending), time.monotonic() + asked.seconds, asked.first
    while time.monotonic() < until:
        print(f"reading {seed}", flush=True)
        faulthandler.dump_traceback_later(SILENCE, exit=True)
        print(f"{seed} {outcome(mutated(files, asked.ending, seed), asked.ending)}", flush=True)
        faulthandler.cancel_dump_traceback_later()
        seed += 1


if __name__ == "__main__":
    main()
