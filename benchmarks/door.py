"""How long a person waits before anything happens, and what an installation weighs.

    python -m benchmarks.door

The weight is that of the fresh environment that ``make wheel`` leaves behind it.

Processes of their own, from the first instruction to the last. On a machine with other work the
seconds of processor tell more than those of the clock; both are the least of some runs.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage

ROOT = Path(__file__).parent.parent
DATA = ROOT / "examples" / "data"
OUTLINE = DATA / "outlines" / "hand620_closed.csv"
PICTURE = DATA / "images" / "mdi_leaf-maple_256.png"
FRESH = ROOT / "build" / "wheel" / "environment" / "bin" / "python"
RUNS = 7


@dataclass(frozen=True)
class Waited:
    """Seconds of processor and of the clock, the least of some runs."""

    processor: float
    clock: float

    def beside(self, other: Waited) -> Waited:
        """What comes on top of another."""
        return Waited(self.processor - other.processor, self.clock - other.clock)


def waited(arguments: list[str], folder: str, runs: int = RUNS) -> Waited:
    """What one process of this Python takes, its modules compiled before as an installation does.

    Parameters
    ----------
    arguments : list of str
    folder : str
        Where compiled modules may be kept.
    runs : int
        After one that counts for nothing.
    """
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    environment = {**kept, "PYTHONPYCACHEPREFIX": folder, "OPENBLAS_NUM_THREADS": "1"}
    processor, clock = [], []
    for _ in range(runs + 1):
        before, began = getrusage(RUSAGE_CHILDREN), time.perf_counter()
        done = subprocess.run(
            [sys.executable, *arguments], env=environment, capture_output=True, check=False
        )
        after = getrusage(RUSAGE_CHILDREN)
        if done.returncode:
            raise SystemExit(done.stderr.decode())
        clock.append(time.perf_counter() - began)
        processor.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return Waited(min(processor[1:]), min(clock[1:]))


def ways(folder: str) -> dict[str, list[str]]:
    """What is measured, by its name."""

    def fit(source: Path) -> list[str]:
        target = Path(folder, f"{source.stem}.svg")
        return ["-m", "shapespline", "fit", str(source), "-t", "0.5", "--force", "-o", str(target)]

    return {
        "python -c pass": ["-c", "pass"],
        "import numpy": ["-c", "import numpy"],
        "import shapespline": ["-c", "import shapespline"],
        "shapespline --help": ["-m", "shapespline", "--help"],
        "one small fit": fit(OUTLINE),
        "one small picture": fit(PICTURE),
    }


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        found = {name: waited(arguments, folder) for name, arguments in ways(folder).items()}
    print("| | processor | clock |\n|---|---:|---:|")
    for name, one in found.items():
        print(f"| {name} | {one.processor:.3f} s | {one.clock:.3f} s |")
    own = found["import shapespline"].beside(found["python -c pass"])
    print(f"| import alone | {own.processor:.3f} s | {own.clock:.3f} s |")
    if not FRESH.exists():
        print("\nFor the weight of an installation: make wheel, then this again.")
        return
    print()
    subprocess.run([FRESH, "-I", ROOT / "scripts" / "smoke.py", "--weight"], check=True)


if __name__ == "__main__":
    main()
