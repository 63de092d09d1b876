"""A logo with small letters through shapespline, potrace and vtracer, enlarged, side by side.

    python -m benchmarks.picture_peers

Writes docs/figures/howto/pictures_peers.png, and photograph.png: a part of a photographed sign in
colours. potrace and vtracer get the picture with their own options; a panel stays empty where one
is not installed.
"""

from __future__ import annotations

import io
import re
import shutil
import subprocess
import tempfile
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
import svgelements
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outline
from PIL import Image, ImageDraw, ImageFont

import shapespline as ss
from benchmarks.figure_style import save
from benchmarks.howto_figures import TARGET, canvas
from benchmarks.sign_maker import LARGER, drawn, photographed

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

SIZE, FINE, TOLERANCE = (128, 64), 8, 0.15
SAMPLES = np.linspace(0.0, 1.0, 17)
# The sign that is photographed, and the part of it that is shown: left, right, lower, upper.
SIGN, PART = 7, (150.0, 460.0, 130.0, 470.0)


def logo() -> Image.Image:
    """A gear with a slot, a small word, and lines of one and two pixels."""
    n = FINE
    image = Image.new("L", (SIZE[0] * n, SIZE[1] * n), 255)
    pen = ImageDraw.Draw(image)
    t = np.radians(np.arange(0, 360, 30))
    for low, high in zip(t - 0.13, t + 0.13, strict=True):
        ring = [(30 + r * np.cos(a), 27 + r * np.sin(a)) for r, a in
                ((18, low), (24, low), (24, high), (18, high))]  # fmt: skip
        pen.polygon([(n * x, n * y) for x, y in ring], fill=0)
    pen.ellipse((n * 10, n * 7, n * 50, n * 47), fill=0)
    pen.rounded_rectangle((n * 20, n * 22, n * 40, n * 32), radius=5 * n, fill=255)
    path = f"{matplotlib.get_data_path()}/fonts/ttf/DejaVuSans.ttf"
    pen.text((59 * n, 8 * n), "jäger", font=ImageFont.truetype(path, 18 * n), fill=0)
    pen.text((59 * n, 30 * n), "No. 9, gä", font=ImageFont.truetype(path, 14 * n), fill=0)
    pen.line([(n * 59, n * 51), (n * 119, n * 54)], fill=0, width=n + 1)
    pen.line([(n * 8, n * 57), (n * 119, n * 60)], fill=0, width=2 * n)
    return image.resize(SIZE, Image.Resampling.BOX)


def ours(source: Path, target: Path) -> None:
    """Traced and fitted."""
    with warnings.catch_warnings():
        # The smallest letters are told to a little more than the tolerance.
        warnings.simplefilter("ignore", ss.PictureWarning)
        ss.write(target, ss.fit_shape(ss.read(source), tolerance=TOLERANCE))


def potrace(source: Path, target: Path) -> None:
    """Its usual threshold and options."""
    bitmap = io.BytesIO()
    Image.open(source).save(bitmap, format="PPM")
    subprocess.run(
        ["potrace", "-b", "svg", "--flat", "-r", "72", "-o", str(target), "-"],
        input=bitmap.getvalue(), check=True,
    )  # fmt: skip


def vtracer(source: Path, target: Path) -> None:
    """Black and white, splines."""
    import vtracer as program

    program.convert_image_to_svg_py(str(source), str(target), colormode="binary")


def show(axes: Axes, path: Path, size: tuple[int, int] = SIZE) -> int:
    """Fill what is drawn, in its colours; the number of its points."""
    text = re.sub(r"<\?xml.*?\?>|<!DOCTYPE.*?>", "", path.read_text(), flags=re.DOTALL)
    text = re.sub(r"<use [^>]*>", "", text)  # the seams beneath our areas
    drawing = svgelements.SVG.parse(io.StringIO(text), reify=True, ppi=72)
    scale = size[0] / float(drawing.width)
    count = 0
    for element in drawing.elements(lambda item: isinstance(item, svgelements.Path)):
        vertices, codes = [], []
        for part in element.as_subpaths():
            own = []
            for segment in svgelements.Path(part):
                if isinstance(segment, svgelements.Move) or segment.start is None:
                    continue
                count += len([point for point in segment if point is not None]) - 1
                own += [segment.point(t) for t in SAMPLES]
            if len(own) > 2:
                vertices += [(scale * p.x, size[1] - scale * p.y) for p in own]
                codes += [Outline.MOVETO, *[Outline.LINETO] * (len(own) - 1)]
        if vertices:
            color = element.fill.hexrgb or "black"
            axes.add_patch(PathPatch(Outline(vertices, codes), color=color, linewidth=0))
    return count


def photograph() -> None:
    """A sign as it was photographed, and its areas by vtracer and by this package."""
    picture, _ = photographed(drawn(SIGN, LARGER), SIGN)
    size = (picture.shape[1], picture.shape[0])

    def areas(source: Path, target: Path) -> None:
        shape = ss.trace(source, colors="auto")
        ss.write(target, ss.fit_shape(shape, shared_boundaries=True))

    def peer(source: Path, target: Path) -> None:
        import vtracer as program

        program.convert_image_to_svg_py(str(source), str(target))

    figure, panels = canvas(3)
    figure.set_size_inches(13.5, 5.2)
    panels[0].imshow(picture, extent=(0, size[0], 0, size[1]))
    panels[0].set_title("a photograph", fontsize=13)
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.PictureWarning)
        source, target = Path(folder) / "sign.png", Path(folder) / "sign.svg"
        Image.fromarray(picture).save(source)
        for axes, name, run in ((panels[1], "vtracer", peer), (panels[2], "shapespline", areas)):
            try:
                run(source, target)
                axes.set_title(f"{name}: {show(axes, target, size)} points", fontsize=13)
            except ImportError:
                axes.set_title(f"{name} is not installed", fontsize=13)
    for axes in panels:
        axes.set(xlim=PART[:2], ylim=PART[2:], aspect="equal")
    save(figure, TARGET / "photograph.png", dpi=90)


def main() -> None:
    """Four panels, and three of the photograph."""
    photograph()
    tracers: dict[str, Callable[[Path, Path], None]] = {
        "shapespline": ours, "potrace": potrace, "vtracer": vtracer,
    }  # fmt: skip
    figure, _ = canvas(1)
    figure.clear()
    figure.set_size_inches(14, 8.6)
    panels = figure.subplots(2, 2).ravel()
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder) / "logo.png", Path(folder) / "logo.svg"
        logo().save(source)
        panels[0].imshow(logo(), cmap="gray", extent=(0, SIZE[0], 0, SIZE[1]))
        panels[0].set_title(f"the picture, {SIZE[0]} x {SIZE[1]} pixels", fontsize=13)
        for axes, (name, run) in zip(panels[1:], tracers.items(), strict=True):
            try:
                if name == "potrace" and shutil.which(name) is None:
                    raise ImportError
                run(source, target)
                axes.set_title(f"{name}: {show(axes, target)} points", fontsize=13)
            except ImportError:
                axes.set_title(f"{name} is not installed", fontsize=13)
    for axes in panels:
        axes.set(xlim=(0, SIZE[0]), ylim=(0, SIZE[1]), aspect="equal")
        axes.axis("off")
    save(figure, TARGET / "pictures_peers.png", dpi=80)


if __name__ == "__main__":
    main()
