"""``python -m benchmarks.fuzz --minutes 10``: what readers make of damaged files of all formats."""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

from benchmarks.fuzz.child import SECONDS
from benchmarks.fuzz.mutate import mutated
from benchmarks.fuzz.seeds import EXTRAS, endings, sound

# A child that says nothing for longer than its alarm hangs where no alarm is heard.
SILENCE = 3 * SECONDS
FOLDER = Path("bench-output/fuzz")


def fuzzed(ending: str, first: int, seconds: float) -> tuple[Counter[str], dict[str, int]]:
    """How many files were read, said, at fault or the end; of each kind of fault the first seed."""
    counts: Counter[str] = Counter()
    faults: dict[str, int] = {}
    until, seed = time.monotonic() + seconds, first
    while (left := until - time.monotonic()) > 0:
        command = [sys.executable, "-m", "benchmarks.fuzz.child", ending, str(seed), str(left)]
        try:
            done = subprocess.run(
                command, capture_output=True, text=True, check=False, timeout=left + SILENCE
            )
            said, code = done.stdout, done.returncode
        except subprocess.TimeoutExpired as hung:
            said, code = (hung.stdout or b"").decode(), -9
        lines = [line.split(" ", 2) for line in said.splitlines() if line[:1].isdigit()]
        for number, *words in lines:
            # A library in C++ that hangs hears no alarm before it is back: not ours to promise.
            hung = ending in EXTRAS and words[1:] == [f"more than {SECONDS:.0f} s"]
            counts["library" if hung else words[0]] += 1
            if words[0] == "FAULT":
                faults.setdefault(re.sub(r"\d+", "0", words[1])[:90], int(number))
        begun = re.findall(r"^reading (\d+)", said, re.MULTILINE)
        if code:
            # Nor is one that dies and takes the process along.
            counts["library" if ending in EXTRAS else "FAULT"] += 1
            last = int(begun[-1]) if begun else seed
            faults.setdefault(f"the process ended with {code}", last)
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
