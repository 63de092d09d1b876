"""What the pictures of the documentation have in common: colours, axes, pieces, small files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from PIL import Image

import shapespline as ss
from shapespline.geometry import turn_between

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from shapespline.typing import FloatArray
    from shapespline.values import Contour, Piece

ROOT = Path(__file__).parent.parent
OUTLINES = ROOT / "examples" / "data" / "outlines"
# Where the pictures of docs/engines are.
ENGINES = ROOT / "docs" / "figures" / "engines"
BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
GREY, PALE, INK = "#8A8A8A", "#D0D0D0", "#333333"
KINDS = {"line": GREEN, "bezier": BLUE, "spline": RED}
FONT_SIZE = 11


def outline(name: str) -> Contour:
    """An outline of the corpus."""
    (contour,) = ss.read(OUTLINES / f"{name}.csv")
    return contour


def canvas(
    width: float, height: float, count: int = 1, **more: object
) -> tuple[Figure, list[Axes]]:
    """A figure with some axes side by side."""
    figure = Figure(figsize=(width, height), layout="constrained")
    axes = np.atleast_1d(figure.subplots(1, count, **more)).ravel().tolist()
    for one in axes:
        one.tick_params(labelsize=FONT_SIZE - 1)
        one.spines[["top", "right"]].set_visible(False)
    return figure, axes


def plane(axes: Axes, title: str) -> None:
    """Axes for shapes: equal units, nothing around."""
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(title, fontsize=FONT_SIZE + 1, color=INK)


def labelled(axes: Axes, x: str, y: str, title: str) -> None:
    """Axes for figures."""
    axes.set_xlabel(x, fontsize=FONT_SIZE)
    axes.set_ylabel(y, fontsize=FONT_SIZE)
    axes.set_title(title, fontsize=FONT_SIZE + 1, color=INK)


def save(figure: Figure, path: Path, dpi: int = 100) -> None:
    """A picture of few colours."""
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=dpi)
    Image.open(path).convert("P", palette=Image.Palette.ADAPTIVE, colors=64).save(
        path, optimize=True
    )
    print(f"{path.name}: {path.stat().st_size // 1000} kB")


def sampled(piece: Piece) -> FloatArray:
    """Points along a piece."""
    curve = ss.BSplineCurve(piece.knots, piece.control_points, piece.degree)
    return curve(np.linspace(0.0, 1.0, 2 if piece.degree == 1 else 60))


def draw_pieces(axes: Axes, pieces: Sequence[Piece], closed: bool) -> None:
    """Pieces by their kind; nodes open where the curve is smooth, full at corners."""
    for piece in pieces:
        axes.plot(*sampled(piece).T, color=KINDS[piece.kind], lw=2.0, zorder=3)
    for i in range(0 if closed else 1, len(pieces)):
        sharp = abs(turn_between(pieces[i - 1], pieces[i])) > np.radians(1.01)
        axes.plot(
            *pieces[i].control_points[0],
            "o",
            ms=5.5,
            mec=INK,
            mew=1.1,
            mfc=INK if sharp else "white",
            zorder=4,
        )
