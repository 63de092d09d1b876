"""``python -m benchmarks.fuzz --minutes 10``: what readers make of damaged files of all formats."""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

from benchmarks.fuzz.child import calls_library, outcome
from benchmarks.fuzz.mutate import mutated
from benchmarks.fuzz.seeds import endings, sound

# Of what faulthandler writes when a process ends: the file of the innermost frame of Python.
INNERMOST = re.compile(r'\(most recent call first\):\n\s+File "([^"]+)"')
FOLDER = Path("bench-output/fuzz")


def fuzzed(ending: str, first: int, seconds: float) -> tuple[Counter[str], dict[str, int]]:
    """How many files were read, said, at fault or the end; of each kind of fault the first seed."""
    counts: Counter[str] = Counter()
    faults: dict[str, int] = {}
    until, seed = time.monotonic() + seconds, first
    while (left := until - time.monotonic()) > 0:
        command = [sys.executable, "-m", "benchmarks.fuzz.child", ending, str(seed), str(left)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        lines = [line.split(" ", 2) for line in done.stdout.splitlines() if line[:1].isdigit()]
        for number, *words in lines:
            counts[words[0]] += 1
            if words[0] == "FAULT":
                faults.setdefault(re.sub(r"\d+", "0", words[1])[:90], int(number))
        begun = re.findall(r"^reading (\d+)", done.stdout, re.MULTILINE)
        if done.returncode:
            # A library that dies, or does not come back, takes the process along.
            innermost = INNERMOST.findall(done.stderr)
            last = int(begun[-1]) if begun else seed
            kind = "library" if innermost and calls_library(innermost[0]) else "FAULT"
            where = f" in {innermost[0]}" if innermost else ""
            faults.setdefault(f"the process ended with {done.returncode}{where}", last)
            # What users see of a death: a sentence, since files are read apart.
            if kind == "library" and done.returncode < 0:
                kind = outcome(mutated(sound(ending), ending, last), ending)
                kind = "FAULT" if kind.startswith("FAULT") else "library"
            counts[kind] += 1
        seed = int(begun[-1]) + 1 if begun else seed + 1
    return counts, faults


def main() -> int:
    """Prints one row a format; the exit code tells whether a fault was found."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fuzz")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=0, help="of the first file")
    parser.add_argument("--format", choices=endings(), help="this one only")
    asked = parser.parse_args()
    wanted = [asked.format] if asked.format else list(endings())
    print("| format | files | read | refused in a sentence | faults | its library hung or died |")
    print("|---" * 6 + "|")
    wrong = 0
    for ending in wanted:
        counts, faults = fuzzed(ending, asked.seed, 60 * asked.minutes / len(wanted))
        row = (counts.total(), counts["read"], counts["said"], counts["FAULT"], counts["library"])
        print(f"| {ending} | " + " | ".join(map(str, row)) + " |", flush=True)
        wrong += counts["FAULT"]
        for words, seed in faults.items():
            FOLDER.mkdir(parents=True, exist_ok=True)
            path = FOLDER / f"{seed}.{ending}"
            path.write_bytes(mutated(sound(ending), ending, seed))
            print(f"  {path}: {words}", flush=True)
    return int(wrong > 0)


if __name__ == "__main__":
    raise SystemExit(main())
