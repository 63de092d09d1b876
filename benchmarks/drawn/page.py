"""docs/drawn.md and its picture: the tables, and drawings side by side, worst first."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import matplotlib as mpl
import numpy as np
from scipy.spatial import cKDTree

from benchmarks.drawn.catalogue import names_of
from benchmarks.drawn.found import STEP
from benchmarks.drawn.tables import SIZE, rendered
from benchmarks.drawn.tracers import CHARACTERS, ours
from benchmarks.drawn.truth import sampled

if TYPE_CHECKING:
    from benchmarks.drawn.renderers import Picture
    from benchmarks.drawn.tables import Tables
    from benchmarks.drawn.truth import Array

DOCS = Path(__file__).resolve().parent.parent.parent / "docs"

SHOWN, TOLERANCE = ("plate", "icon", "letter", "word"), 0.35
WINDOW = 11.0  # pixels on either side of what is worst
# Of the drawing, the fewest points, as drawn.
STYLES = (("black", 0.7), ("#D55E00", 1.6), ("#0072B2", 1.0))
# What follows it in the page is written here.
MARK = "<!-- python -m benchmarks.drawn --page writes what follows -->\n"


def write_page(pictures: Tables, points: str) -> None:
    """The page and its pictures."""
    said = (
        "\n## Measured points\n\nPoints at equal steps of drawings 256 pixels large, noise in per"
        " cent of the diagonal, no tolerance: kinds of pieces, largest distance to the truth.\n\n"
    )
    page = DOCS / "drawn.md"
    text = page.read_text("utf-8").partition(MARK)[0]
    text += MARK + "\n" + "\n".join([*pictures.texts, *pictures.left_out]) + said + points
    page.write_text(text, encoding="utf-8")
    contact_sheet()


class Worst(NamedTuple):
    """Where a drawing comes back worst: how far off, and what is there."""

    far: float
    name: str
    place: Array
    picture: Picture
    lines: tuple[list[Array], ...]  # of the drawing, with the fewest points, as drawn


def worst_of(name: str) -> Worst:
    """Of one drawing."""
    outlines, picture = rendered(name, SIZE)
    true = [sampled(outline, STEP) for outline in outlines]
    fewest, drawn = (ours(picture, TOLERANCE, one)[0] for one in CHARACTERS)
    truth = np.concatenate(true)
    there, back = cKDTree(truth).query(drawn.curve)[0], cKDTree(drawn.curve).query(truth)[0]
    place = drawn.curve[there.argmax()] if there.max() > back.max() else truth[back.argmax()]
    far = max(float(there.max()), float(back.max()))
    return Worst(far, name, place, picture, (true, fewest.sampled, drawn.sampled))


def contact_sheet() -> None:
    """Windows about the places where drawings come back worst."""
    mpl.use("Agg")
    import matplotlib.pyplot as plt

    found = sorted((worst_of(name) for name in names_of(*SHOWN)), key=lambda one: -one.far)
    figure, axes = plt.subplots(4, 5, figsize=(12.5, 10.4))
    for panel, one in zip(axes.flat, found, strict=False):
        size = len(one.picture)
        panel.imshow(one.picture, cmap="gray", extent=(0, size, 0, size), vmin=-250, vmax=255)
        for lines, (color, width) in zip(one.lines, STYLES, strict=True):
            for line in lines:
                panel.plot(*line.T, color=color, linewidth=width)
        x, y = one.place.tolist()
        panel.set(
            xlim=(x - WINDOW, x + WINDOW), ylim=(y - WINDOW, y + WINDOW), xticks=[], yticks=[]
        )
        panel.set_title(f"{one.name}, {one.far:.2f}", fontsize=9)
    figure.tight_layout()
    figure.savefig(DOCS / "figures" / "drawn.png", dpi=75)
    plt.close(figure)
