"""Pictures of few colours traced in colours, and drawn again from the file.

    python -m benchmarks.color_areas              a line for each logo and illustration
    python -m benchmarks.color_areas -o DIR       and what was read in the files, as pictures

vtracer (PyPI) and potrace (the layers of our palette, one run for each colour), where they are
installed, get the same pictures with their own options. Files are drawn by the same program,
sixteen samples a pixel on magenta: colour distance is the mean absolute difference to the picture
over the channels, of 255; gaps are samples that nothing covers, of a million. Seams are what a
browser (chromium, where it is installed) shows at four times the size: pixels, of a million, in
which the ground of the page can be seen.
"""

from __future__ import annotations

import argparse
import io
import re
import shutil
import subprocess
import tempfile
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import matplotlib
import numpy as np
import svgelements
from PIL import Image, ImageChops, ImageDraw, ImageFont

import shapespline as ss
from shapespline.tracing.palette import palette_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

SIZE, LARGER, SAMPLES = (320, 200), 8, 4
TOLERANCE = 0.3
# How much larger a browser draws, and the difference, of 255, that can be seen.
ZOOM, VISIBLE = 4, 8
LARGE = Path(__file__).parent.parent.parent / "shared" / "data" / "photos"
PALETTES = (
    ("#ffffff", "#145aa0", "#dc1e28", "#ffdc00"),
    ("#0b3d2e", "#f4f1de", "#e07a5f", "#81b29a"),
    ("#fff8e7", "#2b2d42", "#ef233c", "#8d99ae"),
    ("#222222", "#ffbe0b", "#fb5607", "#3a86ff"),
)
WORDS = ("jäger & söhne", "No. 9", "gizmo", "café", "8 a 6")


class Result(NamedTuple):
    """What a tracer made of a picture."""

    n_bytes: int
    n_points: int
    distance: float
    gaps: float
    seams: float
    seconds: float


def logos() -> Iterator[tuple[str, Image.Image]]:
    """Twenty logos: four palettes, five words, discs, bars and a wedge that touch."""
    folder = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    for p, (ground, first, second, third) in enumerate(PALETTES):
        for w, text in enumerate(WORDS):
            n, rng = LARGER, np.random.default_rng(10 * p + w)
            image = Image.new("RGB", (SIZE[0] * n, SIZE[1] * n), ground)
            draw = ImageDraw.Draw(image)
            x, y, r = rng.uniform((60, 60, 30), (120, 90, 50)) * n
            draw.rectangle((0, 0, SIZE[0] * n, float(y)), fill=first)
            draw.ellipse((x - r, y - r, x + r, y + r), fill=second)
            draw.ellipse((x - r / 2, y - r / 2, x + r / 2, y + r / 2), fill=third)
            wedge = rng.uniform((180, 20), (310, 120), (3, 2)) * n
            draw.polygon([tuple(point) for point in wedge.tolist()], fill=third)
            face = ImageFont.truetype(str(folder / "DejaVuSans-Bold.ttf"), (18 + 6 * p) * n)
            draw.text((12 * n, 150 * n), text, font=face, fill=first if p != 3 else second)
            name = f"{text} {p + 1}"
            yield name, image.resize(SIZE, Image.Resampling.BOX)


def illustrations() -> Iterator[tuple[str, Image.Image]]:
    """Three drawings with shades, from the corpus."""
    for name in ("opencv_HappyFish", "opencv_LinuxLogo", "skimage_logo"):
        path = LARGE / f"{name}.png"
        if path.exists():
            flat = Image.open(path).convert("RGBA")
            ground = Image.new("RGBA", flat.size, "white")
            yield name, Image.alpha_composite(ground, flat).convert("RGB")


def seams(path: Path, size: tuple[int, int]) -> float:
    """Pixels of a million that show the ground of the page; NaN without a browser."""
    browser = shutil.which("chromium")
    if browser is None:
        return float("nan")
    seen = []
    with tempfile.TemporaryDirectory() as folder:
        page, shot = Path(folder) / "page.html", Path(folder) / "shot.png"
        width, height = (ZOOM * side for side in size)
        for ground in ("#ff00ff", "#00ff00"):
            page.write_text(
                f'<body style="margin:0;background:{ground}"><img src="{path.as_uri()}"'
                f' width="{width}" height="{height}" style="display:block">'
            )
            subprocess.run(
                [browser, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                 f"--screenshot={shot}", f"--window-size={width},{height}", page.as_uri()],
                check=True, capture_output=True,
            )  # fmt: skip
            seen.append(np.asarray(Image.open(shot).convert("RGB")).astype(int))
    return 1e6 * float((np.abs(seen[0] - seen[1]).max(axis=2) > VISIBLE).mean())


def by_potrace(picture: Image.Image, path: Path) -> None:
    """Each colour of our palette by itself, the most frequent first."""
    palette = palette_of(np.asarray(picture), "auto")
    width, height = picture.size
    parts = []
    for index in np.argsort(-np.bincount(palette.labels.ravel())):
        bitmap = io.BytesIO()
        Image.fromarray(palette.labels != index).save(bitmap, format="PPM")
        text = subprocess.run(
            ["potrace", "-b", "svg", "--flat", "-o", "-", "-"],
            input=bitmap.getvalue(), capture_output=True, check=True,
        ).stdout.decode()  # fmt: skip
        color = "#" + "".join(f"{round(value):02x}" for value in palette.colors[index])
        inner = text[text.index("<g transform") : text.index("</svg>")]
        parts.append(inner.replace("#000000", color))
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}px" height="{height}px"'
        f' viewBox="0 0 {width} {height}">{"".join(parts)}</svg>'
    )


def drawn(path: Path, pixels: tuple[int, int]) -> tuple[NDArray[np.uint8], float, int]:
    """The picture in an SVG file, samples that nothing covers, and the points stored."""
    scale = SAMPLES
    size = (pixels[0] * scale, pixels[1] * scale)
    canvas, covered = Image.new("RGB", size, "#ff00ff"), Image.new("1", size)
    n_points = 0
    text = re.sub("<use [^>]*>", "", path.read_text())  # our underlay, which areas cover
    for element in svgelements.SVG.parse(io.StringIO(text), reify=True, ppi=96).elements():
        if not isinstance(element, svgelements.Path) or element.fill.value is None:
            continue
        mask = Image.new("1", size)
        for part in element.as_subpaths():
            own = svgelements.Path(part)
            n_points += sum(_n_points(segment) for segment in own)
            outline = [
                (point.x * scale, point.y * scale)
                for segment in own
                for point in (
                    [segment.point(t) for t in np.linspace(0, 1, 33)]
                    if isinstance(segment, svgelements.CubicBezier | svgelements.Arc)
                    else [segment.end]
                )
                if point is not None
            ]
            if len(outline) > 2:
                ring = Image.new("1", size)
                ImageDraw.Draw(ring).polygon(outline, fill=1)
                mask = ImageChops.logical_xor(mask, ring)
        canvas.paste(element.fill.hex[:7], mask=mask)
        covered = ImageChops.logical_or(covered, mask)
    bare = 1e6 * (1.0 - float(np.asarray(covered).mean()))
    return np.asarray(canvas.reduce(scale)), bare, n_points


def _n_points(segment: svgelements.PathSegment) -> int:
    """A line 1, an arc 2, a cubic 3."""
    if isinstance(segment, svgelements.Arc):
        return 2
    return len([point for point in segment if point is not None]) - 1


def result(path: Path, picture: Image.Image, seconds: float) -> tuple[Result, NDArray[np.uint8]]:
    """What a file holds, against the picture."""
    seen, bare, n_points = drawn(path, picture.size)
    distance = float(np.abs(seen.astype(float) - np.asarray(picture)).mean())
    own = Result(path.stat().st_size, n_points, distance, bare, seams(path, picture.size), seconds)
    return own, seen


def main() -> None:
    """Read the arguments and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", type=Path, help="folder for pictures")
    chosen = parser.parse_args()
    try:
        import vtracer
    except ImportError:
        vtracer = None
    tracers = ["ours"]
    tracers += ["vtracer"] if vtracer else []
    tracers += ["potrace"] if shutil.which("potrace") else []
    columns = "bytes | points | distance | gaps | seams | s"
    print("| picture | colours | " + " | ".join(f"{name}: {columns}" for name in tracers) + " |")
    print("|---|---" + 6 * len(tracers) * "|---" + "|")
    for group in (logos, illustrations):
        every = []
        with tempfile.TemporaryDirectory() as folder:
            source, target, other = (Path(folder) / name for name in ("in.png", "a.svg", "b.svg"))
            for index, (name, picture) in enumerate(group()):
                picture.save(source)
                began = time.perf_counter()
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", ss.PictureWarning)
                    shape = ss.read(source, colors="auto")
                fitted = ss.fit_shape(shape, tolerance=TOLERANCE, shared_boundaries=True)
                ss.write(target, fitted)
                ours, seen = result(target, picture, time.perf_counter() - began)
                row = [ours]
                for tracer in tracers[1:]:
                    began = time.perf_counter()
                    if tracer == "vtracer":
                        vtracer.convert_image_to_svg_py(str(source), str(other))
                    else:
                        by_potrace(picture, other)
                    row.append(result(other, picture, time.perf_counter() - began)[0])
                every.append(row)
                if chosen.output is not None:
                    Image.fromarray(seen).save(chosen.output / f"{group.__name__}_{index}.png")
                count = len({color for color in shape.colors if color})
                print(f"| {name} | {count} | {_cells(row)} |", flush=True)
        if every:
            means = [Result(*column) for column in np.mean(every, axis=0)]
            print(f"| mean of {group.__name__} | | {_cells(means)} |")


def _cells(row: Sequence[Result]) -> str:
    return " | ".join(
        f"{r.n_bytes:.0f} | {r.n_points:.0f} | {r.distance:.2f} | {r.gaps:.0f} | {r.seams:.0f}"
        f" | {r.seconds:.2f}"
        for r in row
    )


if __name__ == "__main__":
    main()
