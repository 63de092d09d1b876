"""Drawings whose truth is known, rendered, traced and fitted: what comes back of what was drawn.

python -m benchmarks.drawn            the tables
python -m benchmarks.drawn --page     the same, docs/drawn.md and its picture
"""

from __future__ import annotations

import argparse
import io
import time
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

import shapespline as ss
from benchmarks.drawn.measure import Figures
from benchmarks.drawn.shapes import drawings
from benchmarks.drawn.truth import picture, placed, sampled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from benchmarks.drawn.truth import Outline

DOCS = Path(__file__).resolve().parent.parent.parent / "docs"
SIZES, TOLERANCES, CHARACTERS = (128, 256, 512), (None, 0.35), ("fewest", "drawn")
HEADS = {
    "straight": "straight %",
    "one piece": "one piece %",
    "worst bow": "worst bow",
    "direction": "direction, deg",
    "level": "level exactly %",
    "arcs": "arcs %",
    "unround": "circles: unround",
    "corners": "corners %",
    "lost": "lost %",
    "false": "false",
    "points": "points",
    "RMS": "RMS",
    "H": "H median, worst",
    "exceeded": "exceeded",
    "seconds": "s",
}


@cache
def rendered(name: str, size: int, jpeg: bool) -> tuple[list[Outline], NDArray[np.uint8]]:
    """Outlines in pixels, and their picture."""
    drawing = drawings()[name]
    outlines = placed(drawing.outlines, size, drawing.turn, seed=1)
    image = picture(outlines, size)
    if jpeg:
        stream = io.BytesIO()
        Image.fromarray(image).save(stream, "JPEG", quality=90)
        image = np.asarray(Image.open(stream))
    return outlines, image


def figures(
    names: Sequence[str], size: int, tolerance: float | None, character: str, *, jpeg: bool = False
) -> Figures:
    """What one way to fit makes of some drawings."""
    found = Figures()
    for name in names:
        outlines, image = rendered(name, size, jpeg)
        shape = ss.trace(image)
        begin = time.process_time()
        fits = ss.fit_shape(shape, tolerance=tolerance, character=character).fits
        found.seconds += time.process_time() - begin
        found.add(name, outlines, fits)
    return found


def table(title: str, rows: Sequence[tuple[str, Figures]]) -> str:
    """Markdown."""
    lines = [f"**{title}**", "", "| | " + " | ".join(HEADS.values()) + " |"]
    lines.append("|---" * (len(HEADS) + 1) + "|")
    for label, found in rows:
        row = found.row()
        lines.append(f"| {label} | " + " | ".join(row[key] for key in HEADS) + " |")
    return "\n".join(lines) + "\n"


def pictures_tables() -> list[str]:
    """Sizes, renderers, tolerances; drawings kept aside in rows of their own."""
    every = drawings()
    tables = []
    for size in SIZES:
        for tolerance in TOLERANCES:
            rows = []
            for kind in ("geometric", "letter", "organic"):
                for aside in (False, True) if kind == "geometric" else (None,):
                    names = [
                        name
                        for name, one in every.items()
                        if one.kind == kind and aside in (None, one.aside)
                    ]
                    label = kind + {None: "", False: "", True: ", kept aside"}[aside]
                    for character in CHARACTERS:
                        found = figures(names, size, tolerance, character)
                        rows.append((f"{label}: {character}", found))
            said = "no tolerance" if tolerance is None else f"within {tolerance} pixels"
            tables.append(table(f"{size} pixels, {said}", rows))
    names = [name for name, one in every.items() if one.kind == "geometric"]
    rows = [(one, figures(names, 256, 0.35, one, jpeg=True)) for one in CHARACTERS]
    tables.append(table("256 pixels, JPEG of quality 90, within 0.35 pixels", rows))
    return tables


def sampled_table() -> str:
    """Points with noise on plates, structure and distance to the truth."""
    from scipy.spatial import cKDTree

    lines = ["| | noise % | n | pieces of the drawing | fewest: pieces, H | drawn: pieces, H |"]
    lines.append("|---|---|---|---|---|---|")
    random = np.random.default_rng(5)
    for name in ("slot", "box rounded", "bracket", "star 5", "keyhole", "pebble"):
        outline = rendered(name, 256, False)[0][0]
        dense = sampled(outline, 0.02)
        size = float(np.hypot(*np.ptp(dense, axis=0)))
        for noise in (0.02, 0.1, 0.5):
            for n in (200, 1000):
                contour = ss.Contour(dense, closed=True).resampled(n)
                points = contour.points + random.normal(0, 0.01 * noise * size, (n, 2))
                said = []
                for character in CHARACTERS:
                    fit = ss.fit_curve(points, closed=True, character=character)
                    curve = fit.spline(np.linspace(0, 1, 20_001))
                    far = max(
                        cKDTree(dense).query(curve)[0].max(), cKDTree(curve).query(dense)[0].max()
                    )
                    kinds = [piece.kind for piece in fit.pieces]
                    counts = (
                        f"{kinds.count('line')} L {kinds.count('arc')} A"
                        f" {len(kinds) - kinds.count('line') - kinds.count('arc')} C"
                    )
                    said.append(f"{counts}, {far:.2f}")
                lines.append(f"| {name} | {noise} | {n} | {len(outline)} | {said[0]} | {said[1]} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Print the tables; with --page write the page and its picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true", help="write docs/drawn.md and its picture")
    asked = parser.parse_args()
    tables = [*pictures_tables(), sampled_table()]
    print("\n".join(tables))
    if asked.page:
        from benchmarks.drawn.page import write_page

        write_page(tables)


if __name__ == "__main__":
    main()
