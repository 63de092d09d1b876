"""Runs the commands of docs/howto and draws what other programs read in the files: `make figures`.

python -m benchmarks.howto_figures
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import ezdxf
import numpy as np
import svgelements
from matplotlib.figure import Figure
from PIL import Image

import shapespline as ss
from benchmarks import center_lines
from benchmarks.drawn.measuring import measured
from benchmarks.drawn.pixel_chains import level_line, mask_of, on_pixels
from benchmarks.drawn.shapes import rounded
from benchmarks.drawn.truth import sampled
from benchmarks.figure_style import save

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.axes import Axes

    from shapespline.typing import FloatArray

ROOT = Path(__file__).parent.parent
DATA = ROOT / "examples" / "data"
TARGET = ROOT / "docs" / "figures" / "howto"
# Pixels wide.
SHOWN_PEN = 12.0
# Corners and radii of a bracket, and how it was measured.
BRACKET = (
    [(0, 0), (100, 0), (100, 35), (40, 35), (40, 90), (0, 90)],
    [8.0, 8.0, 8.0, 12.0, 8.0, 0.0],
)
# Pixels of its mask.
MASK = 120
MEASURED = {
    "1 % strays": "one point of a hundred is a stray",
    "half three times as rough": "one half is rougher",
    "going on by 0.7": "errors go on",
}
BLUE, ORANGE, GREY = "#0072B2", "#D55E00", "#8A8A8A"


def run(folder: Path, *arguments: str) -> str:
    """The output of a shapespline command in a folder."""
    command = [sys.executable, "-m", "shapespline", *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    print("$ shapespline", *arguments)
    print(done.stdout + done.stderr, end="")
    return done.stdout


def canvas(count: int) -> tuple[Figure, list[Axes]]:
    figure = Figure(figsize=(6 * count, 5.6), layout="constrained")
    axes = np.atleast_1d(figure.subplots(1, count)).tolist()
    for one in axes:
        one.set_aspect("equal")
        one.axis("off")
    return figure, axes


def show_picture(axes: Axes, path: Path) -> None:
    picture = Image.open(path).convert("L")
    axes.imshow(picture, cmap="gray", extent=(0, picture.width, 0, picture.height))


def logo_to_dxf(folder: Path) -> None:
    """A logo, and what ezdxf reads in the two DXF files."""
    source = DATA / "images" / "gameicons_jet-fighter_256.png"
    (folder / "logo.png").write_bytes(source.read_bytes())
    run(folder, "fit", "logo.png", "-o", "logo.dxf", "--dpi", "96", "--tolerance", "0.1")
    run(folder, "fit", "logo.png", "-o", "arcs.dxf", "--dpi", "96", "--tolerance", "0.1", "--arcs")
    figure, (left, middle, right) = canvas(3)
    show_picture(left, folder / "logo.png")
    left.set_title("logo.png")
    for axes, name in ((middle, "logo.dxf"), (right, "arcs.dxf")):
        document = ezdxf.readfile(folder / name)
        kinds: dict[str, int] = {}
        for entity in document.modelspace():
            kinds[entity.dxftype()] = kinds.get(entity.dxftype(), 0) + 1
            path = ezdxf.path.make_path(entity)
            points = np.array([(p.x, p.y) for p in path.flattening(0.01)])
            axes.plot(*points.T, color=BLUE, lw=1.2)
            axes.plot(*points[[0, -1]].T, "o", color=ORANGE, ms=3)
        errors = len(document.audit().errors)
        said = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
        axes.set_title(f"{name} read by ezdxf: {said}; {errors} errors")
    save(figure, TARGET / "logo_to_dxf.png", dpi=80)


def machines(folder: Path) -> None:
    """A gear, and the lines and arcs that ezdxf finds in the bulges of its DXF."""
    source = DATA / "images" / "fa_gear_256.png"
    (folder / "gear.png").write_bytes(source.read_bytes())
    sized = ("--dpi", "96", "--tolerance", "0.1", "--arcs")
    run(folder, "fit", "gear.png", "-o", "gear.nc", *sized, "--depth", "1.5")
    run(folder, "fit", "gear.png", "-o", "gear.dxf", *sized)
    figure, (left, right) = canvas(2)
    show_picture(left, folder / "gear.png")
    left.set_title("gear.png")
    count = {"LINE": 0, "ARC": 0}
    for outline in ezdxf.readfile(folder / "gear.dxf").modelspace():
        for part in outline.virtual_entities():
            kind = part.dxftype()
            count[kind] += 1
            path = ezdxf.path.make_path(part)
            points = np.array([(p.x, p.y) for p in path.flattening(0.001)])
            right.plot(*points.T, color=BLUE if kind == "ARC" else ORANGE, lw=1.6)
            right.plot(*points[[0, -1]].T, "o", color=GREY, ms=3)
    right.set_title(f"lines and arcs: {count['LINE']} lines, {count['ARC']} arcs")
    save(figure, TARGET / "machines.png", dpi=80)


def leaf_to_step(folder: Path) -> None:
    """A leaf, and the STEP file read by OpenCASCADE."""
    source = DATA / "images" / "gameicons_oak-leaf_256.png"
    (folder / "leaf.png").write_bytes(source.read_bytes())
    run(folder, "fit", "leaf.png", "-o", "leaf.step", "--dpi", "150", "--contours", "longest")
    (fit,) = ss.read(folder / "leaf.step")
    figure, (left, right) = canvas(2)
    show_picture(left, folder / "leaf.png")
    left.set_title("leaf.png")
    right.plot(*fit.spline(np.linspace(0, 1, 8000)).T, color=BLUE, lw=1.5)
    ends = np.array([piece.control_points[0] for piece in fit.pieces])
    right.plot(*ends.T, "o", color=ORANGE, ms=3)
    right.set_title(f"leaf.step through OpenCASCADE: one closed wire, {len(fit.pieces)} edges")
    save(figure, TARGET / "leaf_to_step.png", dpi=80)


def points_to_svg(folder: Path) -> None:
    """Shuffled points, and the SVG file read by svgelements."""
    points = np.loadtxt(DATA / "outlines" / "hand620_closed.csv", delimiter=",")
    shuffled = np.random.default_rng(0).permutation(points)
    np.savetxt(folder / "cloud.csv", shuffled, delimiter=",")
    run(folder, "fit", "cloud.csv", "--unordered", "--tolerance", "0.2%", "-o", "cloud.svg")
    figure, (left, middle, right) = canvas(3)
    left.plot(*shuffled.T, color=GREY, lw=0.3)
    left.set_title("cloud.csv, joined as the points stand in it")
    middle.plot(*shuffled.T, ".", color=GREY, ms=3)
    middle.set_title("its points")
    for path in svgelements.SVG.parse(folder / "cloud.svg").elements(
        lambda element: isinstance(element, svgelements.Path)
    ):
        samples = np.array([path.point(t) for t in np.linspace(0, 1, 1500)], dtype=complex)
        right.plot(samples.real, -samples.imag, color=BLUE, lw=1.5)
    right.set_title("cloud.svg read by svgelements")
    save(figure, TARGET / "points_to_svg.png", dpi=80)


def folder_of_files(folder: Path) -> None:
    """Mixed files, one of them broken, and every output."""
    mixed = folder / "mixed"
    mixed.mkdir()
    for path in [*sorted((DATA / "images").glob("*_256.png"))[:4],
                 *sorted((DATA / "outlines").glob("*_closed.csv"))[:3]]:  # fmt: skip
        (mixed / path.name).write_bytes(path.read_bytes())
    (mixed / "broken.csv").write_text("1,2\n3,x\n")
    run(folder, "fit", "mixed", "-o", "out", "--format", "svg", "--tolerance", "0.3%", "-j", "2")
    outputs = sorted((folder / "out").iterdir())
    figure, axes = canvas(len(outputs))
    for one, path in zip(axes, outputs, strict=True):
        for fit in ss.read(path):
            one.fill(*fit.spline(np.linspace(0, 1, 3000)).T, color=BLUE, alpha=0.5)
        one.set_title(path.name, fontsize=8)
    figure.set_size_inches(16, 3)
    save(figure, TARGET / "folder_of_files.png", dpi=80)


def centerlines(_: Path) -> None:
    """Strokes of a pen, and the centre lines that are found in them."""
    shown = [d for d in center_lines.drawings() if d.width == SHOWN_PEN][-4:]
    figure, axes = canvas(len(shown))
    for one, drawing in zip(axes, shown, strict=True):
        picture = center_lines.rendered(drawing)
        height, width = picture.shape
        one.imshow(255 - (255 - picture) // 3, cmap="gray", vmin=0, extent=(0, width, 0, height))
        for contour in ss.trace(picture, centerline=True):
            one.plot(*contour.polyline.T, color=ORANGE, lw=1.8)
            if not contour.closed:
                one.plot(*contour.points[[0, -1]].T, "o", color=BLUE, ms=4)
    figure.set_size_inches(16, 3.2)
    save(figure, TARGET / "centerlines.png", dpi=80)


def boat() -> str:
    """A boat as programs export it that know polygons alone: a node each pixel or two."""
    t = np.linspace(0, 1, 120)
    disc = 100 + 88 * np.column_stack([np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)])[:-1]
    within = 100 + 86.5 / 88 * (disc - 100)  # its stroke is 3 wide
    low = within[within[:, 1] > 152]
    ends = low[:, 0].max(), low[:, 0].min()
    swell = np.column_stack([ends[1] + (ends[0] - ends[1]) * t, 152 + 3 * np.sin(5 * np.pi * t)])
    sea = np.vstack([swell, low[np.argsort(-low[:, 0])]])
    hull = np.column_stack([60 + 84 * t, 120 + 24 * np.sin(np.pi * t) ** 0.6])
    sail = np.vstack([np.column_stack([102 + 44 * t - 26 * t * (1 - t), 30 + 80 * t]), [102, 110]])
    jib = np.vstack([np.column_stack([96 - 40 * t + 14 * t * (1 - t), 40 + 70 * t]), [96, 110]])
    wave = np.column_stack([50 + 100 * t, 167 + 3 * np.sin(8 * np.pi * t)])

    def path(points: FloatArray, end: str, **style: str) -> str:
        told = " ".join(f'{name.replace("_", "-")}="{value}"' for name, value in style.items())
        steps = "L".join(f"{x:.3f} {y:.3f}" for x, y in points)
        return f'<path {told} d="M{steps}{end}"/>'

    edge = {"stroke": "#1b2a49", "stroke_width": "3", "stroke_linejoin": "round"}
    body = [
        path(disc, "z", fill="#bfe3f2", **edge),
        path(sea, "z", fill="#2f7fb5"),
        path(wave, "", fill="none", stroke="#ffffff", stroke_width="3", stroke_linecap="round"),
        path(hull, "z", fill="#c0392b", **edge),
        path(sail, "z", fill="#ffffff", **edge),
        path(jib, "z", fill="#f2b632", **edge),
    ]
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 200">{"".join(body)}</svg>'


def drawings(folder: Path) -> None:
    """A drawing of many nodes, and what is left of them."""
    (folder / "boat.svg").write_text(boat())
    run(folder, "fit", "boat.svg", "-t", "0.15", "-o", "smooth.svg")
    figure, axes = canvas(2)
    for one, name in zip(axes, ("boat.svg", "smooth.svg"), strict=True):
        drawing = ss.read(folder / name)
        ss.write(folder / "shown.png", drawing)
        one.imshow(Image.open(folder / "shown.png"), extent=(0, 200, 0, 200))
        ends = [piece.control_points[0] for fit in drawing for piece in fit.pieces]
        one.plot(*np.array(ends).T, "o", color=BLUE, mfc="white", ms=3.5, mew=0.8)
        points = sum(fit.n_stored_points for fit in drawing)
        one.set_title(f"{name}: {points} points, {(folder / name).stat().st_size / 1000:.0f} kB")
    save(figure, TARGET / "drawings.png", dpi=80)


def plate(path: Path) -> None:
    """A plate as a program exports it: fillets, slot and holes as chords, two digits."""

    def arc(x: float, y: float, radius: float, begin: float, end: float) -> FloatArray:
        angle = np.radians(np.linspace(begin, end, round(abs(end - begin) / 7.5) + 1))
        return np.array([x, y]) + radius * np.column_stack([np.cos(angle), np.sin(angle)])

    corners = ((72, 42, 0), (8, 42, 90), (8, 8, 180), (72, 8, 270))
    outlines = [np.concatenate([arc(x, y, 8, begin, begin + 90) for x, y, begin in corners])]
    outlines.append(np.concatenate([arc(52, 25, 6, -90, 90), arc(28, 25, 6, 90, 270)]))
    outlines += [arc(x, y, 3, 0, 352.5) for x, y, _ in corners]
    document = ezdxf.new("R2010", units=4)  # millimetres
    for points in outlines:
        document.modelspace().add_lwpolyline(points.round(2), close=True)
    document.saveas(path)


def chords(folder: Path) -> None:
    """A plate of chords, and the lines, arcs and circles that come back."""
    plate(folder / "plate.dxf")
    run(folder, "fit", "plate.dxf", "-o", "arcs.dxf", "--tolerance", "0.02")
    figure, axes = canvas(2)
    for one, name in zip(axes, ("plate.dxf", "arcs.dxf"), strict=True):
        pieces = [piece for fit in ss.read(folder / name) for piece in fit.pieces]
        for piece in pieces:
            curve = ss.BSplineCurve(piece.knots, piece.control_points, piece.degree)
            points = curve(np.linspace(*piece.knots[[0, -1]], 200))
            one.plot(*points.T, color=BLUE if piece.kind == "arc" else ORANGE, lw=1.6)
            one.plot(*points[[0, -1]].T, "o", color=GREY, ms=3)
        count = {kind: sum(piece.kind == kind for piece in pieces) for kind in ("line", "arc")}
        one.set_title(f"{name}: {count['line']} lines, {count['arc']} arcs and circles")
    save(figure, TARGET / "chords.png", dpi=80)


def bracket(way: str) -> FloatArray:
    """Points of a bracket, measured in some way."""
    return measured(sampled(rounded(*BRACKET), 0.02), way, 0.0025, np.random.default_rng(1))


def _show_pieces(axes: Axes, pieces: Iterable[ss.Piece]) -> None:
    """Lines and arcs in their colours."""
    for piece in pieces:
        curve = ss.BSplineCurve(piece.knots, piece.control_points, piece.degree)
        along = curve(np.linspace(*piece.knots[[0, -1]], 200))
        axes.plot(*along.T, color=BLUE if piece.kind == "arc" else ORANGE, lw=2.0)
        axes.plot(*piece.control_points[[0, -1]].T, "o", color="black", ms=3)


def measured_parts(_: Path) -> None:
    """A bracket measured in three ways, and the lines and arcs that come back."""
    figure, axes = canvas(len(MEASURED))
    for one, (way, said) in zip(axes, MEASURED.items(), strict=True):
        points = bracket(way)
        fit = ss.fit_curve(points, closed=True)
        one.plot(*points.T, ".", color=GREY, ms=4)
        _show_pieces(one, fit.pieces)
        count = {kind: sum(p.kind == kind for p in fit.pieces) for kind in ("line", "arc")}
        one.set_title(f"{said}: {count['line']} lines, {count['arc']} arcs")
    save(figure, TARGET / "measured.png", dpi=80)


def masks(_: Path) -> None:
    """A bracket's mask, its border, and the lines and arcs that come back."""
    outline = on_pixels(sampled(rounded(*BRACKET), 0.02), MASK, np.random.default_rng(1))
    mask = mask_of(outline)
    border = level_line(mask)
    fit = ss.fit_curve(border, closed=True)
    figure, (left, middle, right) = canvas(3)
    for one in (left, middle, right):
        one.imshow(mask, cmap="Greys", vmax=4, origin="lower")
    left.set_title(f"a mask of {MASK} pixels")
    for one in (middle, right):
        one.plot(*border.T, ".-", color=GREY, ms=3, lw=0.6)
        _show_pieces(one, fit.pieces)
    right.set_xlim(border[:, 0].max() - 30, border[:, 0].max() + 3)
    right.set_ylim(border[:, 1].min() - 3, border[:, 1].min() + 30)
    right.set_title("its corner at the lower right, enlarged")
    count = {kind: sum(p.kind == kind for p in fit.pieces) for kind in ("line", "arc")}
    middle.set_title(f"its border, {count['line']} lines, {count['arc']} arcs")
    save(figure, TARGET / "mask.png", dpi=80)


def main() -> None:
    """All of them, in a temporary folder."""
    pages = (logo_to_dxf, machines, leaf_to_step, points_to_svg, folder_of_files, centerlines)
    pages += (drawings, chords, measured_parts, masks)
    for page in pages:
        with tempfile.TemporaryDirectory() as folder:
            page(Path(folder))


if __name__ == "__main__":
    main()
