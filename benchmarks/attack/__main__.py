"""``python -m benchmarks.attack --minutes 10``: the table of what a random attack finds."""

from __future__ import annotations

import argparse
import time
from collections import Counter, defaultdict

import numpy as np

from benchmarks.attack.judge import COUNTED, FAULTS, judged
from benchmarks.attack.options import drawn_options
from benchmarks.attack.shapes import FAMILIES, drawn


def main() -> int:
    """Prints one row a family; the exit code tells whether a fault was found."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.attack")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=0, help="of the first shape")
    parser.add_argument("--family", choices=list(FAMILIES))
    asked = parser.parse_args()
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    seeds: dict[str, list[int]] = defaultdict(list)
    until, seed = time.monotonic() + 60 * asked.minutes, asked.seed
    slowest = (0.0, 0)
    while time.monotonic() < until:
        shape = drawn(seed, asked.family)
        options = drawn_options(np.random.default_rng([seed, 1]), shape.points, shape.closed)
        began = time.monotonic()
        found = judged(shape, options)
        slowest = max(slowest, (time.monotonic() - began, seed))
        counts[shape.family].update(["fits", *found])
        for name in found:
            seeds[name].append(seed)
        seed += 1
    _print(counts, seeds, slowest)
    return int(any(row[name] for row in counts.values() for name in FAULTS))


def _print(
    counts: dict[str, Counter[str]], seeds: dict[str, list[int]], slowest: tuple[float, int]
) -> None:
    columns = ("fits", *FAULTS, *COUNTED)
    print("| family | " + " | ".join(columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    everything = sum(counts.values(), Counter())
    for family in (*(name for name in FAMILIES if name in counts), "all"):
        row = everything if family == "all" else counts[family]
        print(f"| {family} | " + " | ".join(str(row[name]) for name in columns) + " |")
    for name, found in seeds.items():
        print(f"{name}: seeds {found[:12]}")
    print(f"slowest shape, judged: {slowest[0]:.2f} s, seed {slowest[1]}")


if __name__ == "__main__":
    raise SystemExit(main())
