"""Draws the pictures of README.md from the project's own corpus: ``make figures``."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Path2D
from PIL import Image

import shapespline as ss
from benchmarks.peers import polyline_points, splprep_points

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROOT = Path(__file__).parent.parent
DATA = ROOT / "examples" / "data"
TARGET = ROOT / "docs" / "figures"
INK, BLUE, ORANGE, GREY = "#333333", "#0072B2", "#D55E00", "#8A8A8A"
# file, options of read, options of fit_shape
PICTURES = (
    ("opencv_butterfly.jpg", {"contours": "longest"}, {"tolerance": 1.5}),
    ("mdi_leaf-maple_256.png", {}, {"tolerance": 0.5}),
    ("NotoSerif-Regular_U0067_512.png", {}, {"tolerance": 0.5}),
)


def shown(axes: Axes, drawing: ss.Drawing, *, filled: bool = False) -> None:
    """Curves with the points that a file of them stores."""
    outline = []
    for fit in drawing:
        curve = fit.spline(np.linspace(0, 1, 4000))
        outline.append(curve)
        axes.plot(*curve.T, color=BLUE, lw=2.2, solid_joinstyle="round", zorder=3)
        for piece in fit.pieces:
            axes.plot(*piece.control_points.T, color=ORANGE, lw=0.6, alpha=0.7, zorder=4)
            axes.plot(*piece.control_points.T, "o", ms=3, color=ORANGE, mew=0, zorder=4)
            ends = piece.control_points[[0, -1]]
            axes.plot(*ends.T, "s", ms=4.5, mfc="white", mec=ORANGE, mew=1, zorder=5)
    if filled:
        codes = [np.r_[Path2D.MOVETO, np.full(len(one) - 1, Path2D.LINETO)] for one in outline]
        area = PathPatch(
            Path2D(np.vstack(outline), np.concatenate(codes)), fc=BLUE, ec="none", alpha=0.13
        )
        axes.add_patch(area)


def from_readme() -> None:
    """The picture that the lines of Python in README.md draw."""
    page = (ROOT / "README.md").read_text(encoding="utf-8")
    code = page.split("```python\n")[1].split("```")[0]
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "examples").symlink_to(ROOT / "examples")
        command = [sys.executable, "-c", code]
        subprocess.run(command, cwd=folder, env={**os.environ, "MPLBACKEND": "agg"}, check=True)
        shutil.copy(Path(folder, "dove.png"), TARGET)


def hero() -> None:
    """Four inputs and their curves: what the program is for, at a glance."""
    figure = Figure(figsize=(15, 4.9), layout="constrained")
    glyph, gear, noisy, horse = figure.subplots(1, 4)

    name = "EBGaramond12-Regular_U0026_256.png"
    pixels = np.asarray(Image.open(DATA / "images" / name).convert("L")).astype(float)
    glyph.imshow(255 - 0.35 * pixels, cmap="gray", vmin=0, vmax=255, extent=(0, 256, 0, 256))
    drawing = ss.fit_shape(ss.read(DATA / "images" / name), tolerance=0.5)
    shown(glyph, drawing)
    captioned(glyph, f"a picture: {pixels.size:,} pixels", drawing)

    drawing = ss.fit_shape(ss.read(DATA / "images" / "fa_gear_256.png"), tolerance=0.5)
    shown(gear, drawing, filled=True)
    captioned(gear, f"a part: {data_points(drawing):,} outline points", drawing)

    points = np.loadtxt(DATA / "outlines" / "loop500_n1_open.csv", delimiter=",")
    drawing = ss.Drawing([ss.fit_curve(points, closed=False)])
    noisy.plot(*points.T, ".", color=GREY, ms=4, zorder=1)
    shown(noisy, drawing)
    captioned(noisy, f"a measurement: {len(points):,} noisy points", drawing)

    drawing = ss.fit_shape(ss.read(DATA / "images" / "fa_horse_256.png"), tolerance=0.5)
    shown(horse, drawing, filled=True)
    captioned(horse, f"an icon: {data_points(drawing):,} outline points", drawing)
    figure.savefig(TARGET / "hero.png", dpi=100, metadata={"Software": None})


def data_points(drawing: ss.Drawing) -> int:
    """Points that a drawing was fitted to."""
    return sum(len(fit.contour) for fit in drawing)


def captioned(axes: Axes, given: str, drawing: ss.Drawing) -> None:
    """What was given, above; what is stored, below."""
    stored = sum(fit.n_stored_points for fit in drawing)
    axes.set_title(f"{given} \u2192 {stored}", fontsize=13, color=INK)
    axes.set_aspect("equal")
    axes.set_axis_off()


def from_pictures() -> None:
    """Three images with the curves that were fitted to them."""
    figure = Figure(figsize=(15, 5.6), layout="constrained")
    for axes, (name, reading, fitting) in zip(figure.subplots(1, 3), PICTURES, strict=True):
        path = DATA / "images" / name
        drawing = ss.fit_shape(ss.read(path, **reading), **fitting)
        picture = Image.open(path).convert("RGBA")
        ground = Image.new("RGBA", picture.size, "white")
        pixels = np.asarray(Image.alpha_composite(ground, picture).convert("RGB"))
        height, width = pixels.shape[:2]
        faded = 255 - (255 - pixels.astype(float)) * 0.45
        axes.imshow(faded.astype(np.uint8), extent=(0, width, 0, height))
        for fit in drawing:
            axes.plot(*fit.spline(np.linspace(0, 1, 6000)).T, color="#0072B2", lw=1.6)
            for piece in fit.pieces:
                axes.plot(*piece.control_points.T, "o", ms=2.6, color="#D55E00", mew=0)
        points = sum(fit.n_stored_points for fit in drawing)
        farthest = max(fit.hausdorff_distance for fit in drawing)
        axes.set_title(
            f"{name}\n{points} stored points, within {farthest:.2f} px both ways", fontsize=10
        )
        axes.set(xlim=(0, width), ylim=(0, height))
        axes.set_axis_off()
    figure.savefig(TARGET / "pictures.png", dpi=90, metadata={"Software": None})


def by_count() -> None:
    """One outline with 20, 36 and 60 control points."""
    points = np.loadtxt(DATA / "outlines" / "hand620_closed.csv", delimiter=",")
    figure = Figure(figsize=(15, 6.4), layout="constrained")
    for axes, count in zip(figure.subplots(1, 3), (20, 36, 60), strict=True):
        fit = ss.fit_curve(points, closed=True, n_control_points=count)
        polygon = np.vstack([fit.control_points, fit.control_points[:1]])
        axes.plot(*polygon.T, "o-", ms=3, lw=0.6, color="#D55E00", label="control polygon")
        axes.plot(*points.T, ".", ms=2.5, color="#999999", label="620 data points")
        axes.plot(*fit.spline(np.linspace(0, 1, 6000)).T, color="#0072B2", lw=1.4, label="B-spline")
        axes.set_title(
            f"n_control_points={count}: rms {fit.rms_distance:.3f},"
            f" both ways within {fit.hausdorff_distance:.2f}\n(box diagonal 100)",
            fontsize=10,
        )
        axes.set_aspect("equal")
        axes.set_axis_off()
    axes.legend(loc="lower right", frameon=False, fontsize=9)
    figure.savefig(TARGET / "by_count.png", dpi=90, metadata={"Software": None})


def by_tolerance() -> None:
    """Three outlines within half a per cent, with the points that the peers need."""
    figure = Figure(figsize=(15, 6.2), layout="constrained")
    names = ("hand620_closed", "leaf840_closed", "plane1100_closed")
    for axes, name in zip(figure.subplots(1, 3), names, strict=True):
        contour = ss.Contour(np.loadtxt(DATA / "outlines" / f"{name}.csv", delimiter=","), True)
        tolerance = 0.005 * contour.box_diagonal
        fit = ss.fit_curve(contour, tolerance=tolerance)
        asked = {"closed": True, "tolerance": tolerance}
        splprep = splprep_points(contour.points, **asked).n_points
        polyline = polyline_points(contour.points, **asked).n_points
        axes.plot(*contour.points.T, ".", ms=2.5, color="#999999", label="data")
        axes.plot(*fit.spline(np.linspace(0, 1, 6000)).T, color="#0072B2", lw=1.4, label="curve")
        ends = np.array([piece.control_points[0] for piece in fit.pieces])
        axes.plot(*ends.T, "o", ms=4, color="#D55E00", label="ends of pieces", mew=0)
        axes.set_title(
            f"{fit.n_stored_points} stored points within 0.5 % of the size, both ways\n"
            f"(splprep {splprep}, polyline {polyline})",
            fontsize=10,
        )
        axes.set_aspect("equal")
        axes.set_axis_off()
    axes.legend(loc="lower right", frameon=False, fontsize=9)
    figure.savefig(TARGET / "by_tolerance.png", dpi=90, metadata={"Software": None})


if __name__ == "__main__":
    TARGET.mkdir(parents=True, exist_ok=True)
    hero()
    from_readme()
    from_pictures()
    by_count()
    by_tolerance()
