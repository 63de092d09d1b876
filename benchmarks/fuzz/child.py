"""The process that reads damaged files: a crash takes it along, and its parent notes which."""

from __future__ import annotations

import argparse
import resource
import signal
import time
import warnings

import shapespline as ss
from benchmarks.fuzz.mutate import mutated
from benchmarks.fuzz.seeds import EXTRAS, sound

# A file of a few thousand bytes may not take longer, nor more memory than its process had.
SECONDS, MEGABYTES = 10.0, 1000.0
# More than that is not even lent. Libraries in C++ die of a refusal.
ADDRESS_SPACE = 8 << 30


class TooLongError(BaseException):
    """Raised by the alarm; no reader catches it."""


def outcome(data: bytes, ending: str) -> str:
    """What a reader makes of a file: "read", "said", or its fault in words."""
    before = _megabytes()
    signal.setitimer(signal.ITIMER_REAL, SECONDS)
    try:
        held = ss.read(data, format=f".{ending}")
        found = "read" if len(held) else "FAULT nothing was read and nothing said"
    except ss.ShapesplineError as error:
        found = "said" if len(str(error)) > 10 else f"FAULT the sentence is {error}"
    except TooLongError:
        found = f"FAULT more than {SECONDS:.0f} s"
    except BaseException as error:
        found = f"FAULT {type(error).__name__}: {error}"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    if _megabytes() > before + MEGABYTES:
        found = f"FAULT {_megabytes() - before:.0f} MB"
    return " ".join(found.split())


def _megabytes() -> float:
    """The most memory that this process has had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _alarm(*_: object) -> None:
    raise TooLongError


def main() -> None:
    """Reads files from a seed on until the time is over; one line before and one after each."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fuzz.child")
    parser.add_argument("ending")
    parser.add_argument("first", type=int)
    parser.add_argument("seconds", type=float)
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    signal.signal(signal.SIGALRM, _alarm)
    if asked.ending not in EXTRAS:
        resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
    files, until, seed = sound(asked.ending), time.monotonic() + asked.seconds, asked.first
    while time.monotonic() < until:
        print(f"reading {seed}", flush=True)
        print(f"{seed} {outcome(mutated(files, asked.ending, seed), asked.ending)}", flush=True)
        seed += 1


if __name__ == "__main__":
    main()
