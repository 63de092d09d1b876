"""Points and time at the same two-sided tolerance on the four shapes of the peers, in one run.

    python -m benchmarks.peers_table

Every curve is checked by the outside checker. Times are medians, and the ratio is to
one call of splprep at its best s on the same data in the same run.
"""

from __future__ import annotations

import statistics
import time
from typing import TYPE_CHECKING, NamedTuple

import shapespline as ss
from benchmarks.foundation import outline
from benchmarks.peers import (
    Peer,
    make_splprep_points,
    occ_points,
    polyline_points,
    splprep_points,
)
from checks import two_sided

if TYPE_CHECKING:
    from collections.abc import Mapping

SHAPES = ("hand620_closed", "leaf840_closed", "plane1100_closed", "loop500_open")
TOLERANCES = (0.1, 0.5)
RUNS = 5


class Way(NamedTuple):
    """Options of fit_curve, and the points to reach for each shape at 0.1 and 0.5 %."""

    options: Mapping[str, object]
    to_reach: tuple[tuple[int, int], ...] = ()


WAYS = {
    "corners kept": Way({}, ((50, 28), (66, 36), (30, 27), (16, 11))),
    "corners kept, fast": Way({"effort": "fast"}),
    "corners kept, smallest": Way({"effort": "smallest"}),
    "corners free": Way({"corners": "free"}, ((45, 27), (55, 33), (30, 27), (12, 10))),
    "one spline": Way({"form": "spline"}, ((38, 27), (58, 33), (38, 28), (12, 10))),
    "one spline, fast": Way({"form": "spline", "effort": "fast"}),
    "one spline, smallest": Way({"form": "spline", "effort": "smallest"}),
}


class Ours(NamedTuple):
    """Stored points, median seconds, and whether the outside sampler finds the promise kept."""

    n_points: int
    seconds: float
    kept: bool


def ours(contour: ss.Contour, tolerance: float, options: Mapping[str, object]) -> Ours:
    """Fit some times, check the last."""
    seconds = []
    for _ in range(RUNS):
        began = time.perf_counter()
        fit = ss.fit_curve(contour, tolerance=tolerance, **options)
        seconds.append(time.perf_counter() - began)
    found = two_sided(fit.curve, contour.points, closed=contour.closed, step=tolerance / 10)
    kept = fit.kept and found.larger <= tolerance * (1 + 1e-9)
    return Ours(fit.n_stored_points, statistics.median(seconds), kept)


def table() -> None:
    """One block a tolerance, one line a way, one column a shape."""
    print("## Points at an equal two-sided tolerance, and time in calls of splprep\n")
    for which, tolerance in enumerate(TOLERANCES):
        print(f"| {tolerance} % | " + " | ".join(SHAPES) + " |")
        print("|---" * (len(SHAPES) + 1) + "|")
        contours = [outline(name, closed=name.endswith("closed")) for name in SHAPES]
        length = [tolerance / 100 * contour.box_diagonal for contour in contours]
        splprep = [_splprep(*pair) for pair in zip(contours, length, strict=True)]
        for label, way in WAYS.items():
            cells = []
            for k, (contour, within) in enumerate(zip(contours, length, strict=True)):
                found = ours(contour, within, way.options)
                to_reach = f" ({way.to_reach[k][which]})" if way.to_reach else ""
                missed = "" if found.kept else " NOT KEPT"
                cells.append(
                    f"{found.n_points}{to_reach}, {found.seconds / splprep[k].seconds:.1f}x{missed}"
                )
            print(f"| {label} | " + " | ".join(cells) + " |", flush=True)
        print("| splprep at its best s | " + " | ".join(map(_cell, splprep)) + " |")
        for label, peer in (
            ("make_splprep at its best s", make_splprep_points),
            ("OpenCASCADE", occ_points),
            ("polyline, Douglas-Peucker", polyline_points),
        ):
            found = [
                peer(contour.points, closed=contour.closed, tolerance=within)
                for contour, within in zip(contours, length, strict=True)
            ]
            print(f"| {label} | " + " | ".join(map(_cell, found)) + " |", flush=True)
        print()
    print("(in brackets the points to reach; to reach in time: 10x, fast 2x)\n")


def _splprep(contour: ss.Contour, tolerance: float) -> Peer:
    runs = [
        splprep_points(contour.points, closed=contour.closed, tolerance=tolerance)
        for _ in range(RUNS)
    ]
    return runs[0]._replace(seconds=statistics.median(run.seconds for run in runs))


def _cell(peer: Peer | None) -> str:
    return "not installed" if peer is None else f"{peer.n_points}, {1e3 * peer.seconds:.0f} ms"


if __name__ == "__main__":
    table()
