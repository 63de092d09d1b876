"""docs/drawn.md and its picture: the tables, and drawings side by side, worst first."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from scipy.spatial import cKDTree

import shapespline as ss
from benchmarks.drawn.__main__ import DOCS, rendered
from benchmarks.drawn.measure import STEP
from benchmarks.drawn.shapes import drawings
from benchmarks.drawn.truth import sampled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from benchmarks.drawn.truth import Array

SHOWN = 12
WINDOW = 11.0  # pixels on either side of what is worst
# What follows it in the page is written here.
MARK = "<!-- python -m benchmarks.drawn --page writes what follows -->\n"


def write_page(tables: Sequence[str]) -> None:
    """The page and its picture."""
    points = (
        "\n## Measured points\n\nPoints at equal steps of drawings 256 pixels large, noise in per"
        " cent of the diagonal, no tolerance: kinds of pieces, largest distance to the truth.\n\n"
    )
    page = DOCS / "drawn.md"
    text = page.read_text("utf-8").partition(MARK)[0]
    text += MARK + "\n" + "\n".join(tables[:-1]) + points + tables[-1]
    page.write_text(text, encoding="utf-8")
    contact_sheet()


def contact_sheet() -> None:
    """Windows about the places where the fewest points are worst."""
    mpl.use("Agg")
    import matplotlib.pyplot as plt

    found = []
    for name in drawings():
        outlines, image = rendered(name, 256, False)
        shape = ss.trace(image)
        curves = [
            [
                fit.spline(np.linspace(0, 1, max(500, int(fit.length / STEP))))
                for fit in ss.fit_shape(shape, tolerance=0.35, character=word).fits
            ]
            for word in ("fewest", "drawn")
        ]
        true = [sampled(outline, STEP) for outline in outlines]
        all_points = np.concatenate(curves[0])
        away = cKDTree(np.concatenate(true)).query(all_points)[0]
        at = int(np.argmax(away))
        found.append((float(away[at]), name, image, true, curves, all_points[at]))
    found.sort(key=lambda one: -one[0])
    figure, axes = plt.subplots(3, 4, figsize=(10, 7.9))
    for panel, (_, name, image, true, curves, place) in zip(axes.flat, found[:SHOWN], strict=False):
        size = len(image)
        panel.imshow(image, cmap="gray", extent=(0, size, 0, size), vmin=-250, vmax=255)
        for lines, color, width in (
            (true, "black", 0.7),
            *zip(curves, ("#D55E00", "#0072B2"), (1.6, 1.0), strict=True),
        ):
            for line in lines:
                loop: Array = np.vstack([line, line[:1]])
                panel.plot(*loop.T, color=color, linewidth=width)
        (x, y) = place
        panel.set(
            xlim=(x - WINDOW, x + WINDOW), ylim=(y - WINDOW, y + WINDOW), xticks=[], yticks=[]
        )
        panel.set_title(name, fontsize=9)
    figure.tight_layout()
    figure.savefig(DOCS / "figures" / "drawn.png", dpi=75)
    plt.close(figure)
