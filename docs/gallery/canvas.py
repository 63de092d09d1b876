"""What the scripts of the gallery draw with; the shapes that come along."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path as Polygon
from PIL import Image

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.axes import Axes

    import shapespline as ss

DATA = Path(__file__).resolve().parents[2] / "examples" / "data"
# Okabe and Ito's palette: told apart by the colour-blind too.
BLUE, ORANGE, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#9A9A9A"


def outline(name: str) -> np.ndarray:
    """Points of an outline of the corpus."""
    return np.loadtxt(DATA / "outlines" / f"{name}.csv", delimiter=",")


def image(name: str) -> Path:
    """Path of a picture of the corpus."""
    return DATA / "images" / name


def panels(count: int = 1) -> list[Axes]:
    """Axes side by side that show the plane, four of them as two by two; for a thumbnail, too."""
    rows = 2 if count == 4 else 1
    columns, height = count // rows, 4.2 if count < 3 else 3.0
    _, axes = plt.subplots(
        rows,
        columns,
        figsize=(height * max(1.25, columns), height * rows),
        layout="constrained",
        squeeze=False,
    )
    for one in axes.flat:
        one.set_aspect("equal")
        one.set_axis_off()
    return axes.ravel().tolist()


def picture(axes: Axes, path: Path) -> None:
    """A picture, pale, in the coordinates of its outlines."""
    pixels = Image.open(path).convert("RGBA")
    ground = Image.new("RGBA", pixels.size, "white")
    shown = np.asarray(Image.alpha_composite(ground, pixels).convert("RGB"), dtype=float)
    extent = (0, pixels.width, 0, pixels.height)
    axes.imshow((255 - (255 - shown) * 0.4).astype(np.uint8), extent=extent)


def dots(axes: Axes, points: np.ndarray, size: float = 3) -> None:
    """Data points."""
    axes.plot(*points.T, ".", ms=size, color=GREY, mew=0, zorder=1)


def closer(whole: Axes, near: Axes, middle: np.ndarray, reach: float) -> None:
    """Show in ``near`` what lies about a point, and frame it in ``whole``."""
    x, y = (middle - reach).tolist()
    near.set(xlim=(x, x + 2 * reach), ylim=(y, y + 2 * reach))
    whole.add_patch(Rectangle((x, y), 2 * reach, 2 * reach, fill=False, ec=ORANGE, lw=1, zorder=6))


def curves(
    axes: Axes,
    fits: Iterable[ss.Fit],
    *,
    filled: bool = False,
    points: bool = True,
    color: str = BLUE,
) -> None:
    """Curves, and the points that a file of them stores."""
    lines = []
    for fit in fits:
        lines.append(fit.spline(np.linspace(0, 1, 4000)))
        axes.plot(*lines[-1].T, color=color, lw=1.8, zorder=3)
        for piece in fit.pieces if points else ():
            axes.plot(*piece.control_points.T, color=ORANGE, lw=0.5, alpha=0.6, zorder=4)
            axes.plot(*piece.control_points.T, ".", ms=4, color=ORANGE, mew=0, zorder=4)
            ends = piece.control_points[[0, -1]].T
            axes.plot(*ends, "s", ms=3.5, mfc="white", mec=ORANGE, mew=0.9, zorder=5)
    if filled:
        codes = [np.r_[Polygon.MOVETO, np.full(len(one) - 1, Polygon.LINETO)] for one in lines]
        area = Polygon(np.vstack(lines), np.concatenate(codes))
        axes.add_patch(PathPatch(area, fc=color, ec="none", alpha=0.15))


def stored(fits: Iterable[ss.Fit]) -> int:
    """Points that a file of the curves stores."""
    return sum(fit.n_stored_points for fit in fits)
