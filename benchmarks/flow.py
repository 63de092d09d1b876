"""The way of one fit through the rooms: ``python -m benchmarks.flow`` prints what it passes.

A fit within a tolerance is traced call by call. Told are the modules that it passes through, the
rooms, and how often a call leads from a room to one of a higher rank: by the table of arrows that
is never. Before it, the arrows between rooms that the imports draw.
"""

from __future__ import annotations

import ast
import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

PACKAGE = "shapespline"
# Rooms by rank, as in docs/architecture.md; files at the top are the ground, rank 0.
RANKS = {
    "values": 1,
    "geometry": 2,
    "solvers": 2,
    "analysis": 3,
    "tracing": 4,
    "streaming": 4,
    "formats": 4,
    "engines": 5,
    "plotting": 5,
    "fitting": 6,
    "paper": 7,
    "cli": 8,
    "studio": 8,
    "face": 9,
}


class Way(NamedTuple):
    """Modules that were passed, calls from one to another, and those of them that climb."""

    modules: frozenset[str]
    calls: Counter[tuple[str, str]]
    climbs: Counter[tuple[str, str]]


def room_of(module: str) -> str:
    """The room of a dotted module name; a file at the top is one of the ground, or the face."""
    parts = module.split(".")
    if parts[-1] in ("__init__", "__main__") and len(parts) == 2:
        return "face"
    return parts[1] if len(parts) > 2 or parts[-1] in RANKS else "ground"


def rank_of(module: str) -> int:
    """The rank of a module's room."""
    return RANKS.get(room_of(module), 0)


def way_of(call: Callable[[], object], rank: Callable[[str], int] = rank_of) -> Way:
    """The way of a call through the package's modules, by the profiler's events."""
    modules: set[str] = set()
    calls: Counter[tuple[str, str]] = Counter()

    def seen(frame: FrameType, event: str, _: object) -> None:
        here = frame.f_globals.get("__name__", "")
        if event != "call" or not here.startswith(PACKAGE):
            return
        modules.add(here)
        caller = frame.f_back
        while caller is not None and not caller.f_globals.get("__name__", "").startswith(PACKAGE):
            caller = caller.f_back
        there = "" if caller is None else caller.f_globals["__name__"]
        if there and there != here:
            calls[there, here] += 1

    sys.setprofile(seen)
    try:
        call()
    finally:
        sys.setprofile(None)
    climbs = Counter({pair: n for pair, n in calls.items() if rank(pair[1]) > rank(pair[0])})
    return Way(frozenset(modules), calls, climbs)


def import_arrows() -> set[tuple[str, str]]:
    """(room, room) of all imports in the package, those of types among them."""
    found = set()
    package = Path(ss.__file__).parent
    for path in package.rglob("*.py"):
        parts = path.relative_to(package.parent).with_suffix("").parts
        here = room_of(".".join(parts))
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(PACKAGE + "."):
                found.add((here, room_of(node.module or "")))
    return {(here, there) for here, there in found if here != there}


def outline() -> np.ndarray:
    """A slot with two corners cut off by a wave: lines, curves and corners."""
    t = np.linspace(0.0, np.pi, 80, endpoint=False)
    right = np.column_stack([4 + np.sin(t), -np.cos(t)])
    top = np.column_stack([np.linspace(4, -4, 120, endpoint=False), np.ones(120)])
    left = np.column_stack([-4 + 0.2 * np.sin(6 * t), np.linspace(1, -1, 80, endpoint=False)])
    bottom = np.column_stack([np.linspace(-4, 4, 120, endpoint=False), -np.ones(120)])
    return np.concatenate([right, top, left, bottom])


def main() -> None:
    """Print the way of one fit within a tolerance."""
    arrows = import_arrows()
    up = [(here, there) for here, there in arrows if RANKS.get(here, 0) < RANKS.get(there, 0)]
    print(f"{len(RANKS)} rooms and the face, {len(arrows)} arrows between them, {len(up)} run up")
    points = outline()
    ss.fit_curve(points, closed=True, tolerance=0.01, character="fewest")  # everything is loaded
    way = way_of(lambda: ss.fit_curve(points, closed=True, tolerance=0.01, character="fewest"))
    rooms = sorted({room_of(module) for module in way.modules}, key=lambda room: RANKS.get(room, 0))
    print(f"{len(way.modules)} modules of {len(rooms)} rooms: {', '.join(rooms)}")
    print(f"{sum(way.calls.values())} calls from one module to another by {len(way.calls)} arrows")
    print(f"{sum(way.climbs.values())} of them climb to a room of a higher rank")
    for (caller, called), count in sorted(way.climbs.items()):
        print(f"  {caller} -> {called}: {count}")


if __name__ == "__main__":
    main()
