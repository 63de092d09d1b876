"""Drawings: what SVG and DXF lose on the way, and what arcs instead of splines cost.

python -m benchmarks.drawings
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import numpy as np

import shapespline as ss
from shapespline.formats.dxf_writer import ARC_PART
from shapespline.geometry.biarcs import arc_polyline

OUTLINES = Path(__file__).parents[1] / "examples" / "data" / "outlines"
TOLERANCE = "0.1%"


def chords(fit: ss.Fit, tolerance: float) -> int:
    """Lines that stay within a tolerance of a curve, as polyline writers take them: greedy."""
    curve = fit.spline(np.linspace(0, 1, 20_001))
    count, begin = 0, 0
    while begin < len(curve) - 1:
        low, high = begin + 1, len(curve) - 1
        while low < high:
            middle = (low + high + 1) // 2
            a, b = curve[begin], curve[middle]
            inner, chord = curve[begin : middle + 1] - a, b - a
            length = float(np.hypot(*chord)) or 1.0
            off = np.abs(inner[:, 0] * chord[1] - inner[:, 1] * chord[0]).max() / length
            low, high = (middle, high) if off <= tolerance else (low, middle - 1)
        count, begin = count + 1, low
    return count


def main() -> None:
    """Print one line for each outline, and the medians."""
    rows = []
    print("outline, fit points, lost by SVG / DXF (of the size), arcs, lines, off / asked, ms")
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(OUTLINES.glob("*.csv")):
            fit = ss.fit_curve(ss.read(path).longest, tolerance=TOLERANCE)
            size = fit.contour.box_diagonal
            lost = []
            for ending in ("svg", "dxf"):
                target = Path(folder) / f"drawing.{ending}"
                frame = ss.Frame(*fit.contour.points.min(axis=0), size, size)
                ss.write(target, ss.Drawing([fit], frame=frame))
                lost.append(ss.compare(ss.read(target), fit).hausdorff_distance / size)
            asked = ARC_PART * fit.tolerance
            began = time.perf_counter()
            arcs = arc_polyline(fit.spline, asked, closed=fit.closed)
            seconds = time.perf_counter() - began
            target = Path(folder) / "arcs.dxf"
            ss.write(target, fit, arcs=True)
            off = ss.compare(ss.read(target), fit).hausdorff_distance
            rows.append((*lost, arcs.n_segments, chords(fit, asked), off / asked, 1000 * seconds))
            print(
                f"{path.stem:34s} {fit.n_stored_points:4d}  {lost[0]:.1e} {lost[1]:.1e}"
                f"  {rows[-1][2]:4d} {rows[-1][3]:5d}  {rows[-1][4]:.2f} {rows[-1][5]:6.0f}"
            )
    table = np.array(rows)
    fewer = float(np.median(table[:, 3] / table[:, 2]))
    print(
        f"\n{len(table)} outlines at {TOLERANCE}: SVG and DXF lose at most"
        f" {table[:, :2].max():.1e} of the size; arcs are {fewer:.2f} times fewer than lines"
        f" (median), and at most {table[:, 4].max():.3f} of what was asked off the curve"
    )


if __name__ == "__main__":
    main()
