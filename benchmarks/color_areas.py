"""Logos of few colours, drawn, traced in colours, and drawn again from the file.

    python -m benchmarks.color_areas              a line for each logo
    python -m benchmarks.color_areas -o DIR       and what was read in the files, as pictures

vtracer (PyPI), where it is installed, gets the same pictures with its own options. Files are drawn
by the same program, sixteen samples a pixel on magenta: colour distance is the mean absolute
difference to the picture over the channels, of 255; gaps are samples that nothing covers, of a
million.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import matplotlib
import numpy as np
import svgelements
from PIL import Image, ImageChops, ImageDraw, ImageFont

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

SIZE, LARGER, SAMPLES = (320, 200), 8, 4
TOLERANCE = 0.3
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


def drawn(path: Path) -> tuple[NDArray[np.uint8], float, int]:
    """The picture in an SVG file, samples that nothing covers, and the points stored."""
    scale = SAMPLES
    size = (SIZE[0] * scale, SIZE[1] * scale)
    canvas, covered = Image.new("RGB", size, "#ff00ff"), Image.new("1", size)
    n_points = 0
    for element in svgelements.SVG.parse(str(path), reify=True, ppi=96).elements():
        if not isinstance(element, svgelements.Path) or element.fill.value is None:
            continue
        mask = Image.new("1", size)
        for part in element.as_subpaths():
            own = svgelements.Path(part)
            n_points += sum(len([q for q in segment if q is not None]) - 1 for segment in own)
            outline = [
                (point.x * scale, point.y * scale)
                for segment in own
                for point in (
                    [segment.point(t) for t in np.linspace(0, 1, 33)]
                    if isinstance(segment, svgelements.CubicBezier)
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


def result(path: Path, picture: Image.Image, seconds: float) -> tuple[Result, NDArray[np.uint8]]:
    """What a file holds, against the picture."""
    seen, bare, n_points = drawn(path)
    distance = float(np.abs(seen.astype(float) - np.asarray(picture)).mean())
    return Result(path.stat().st_size, n_points, distance, bare, seconds), seen


def main() -> None:
    """Read the arguments and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", type=Path, help="folder for pictures")
    chosen = parser.parse_args()
    try:
        import vtracer
    except ImportError:
        vtracer = None
    print("| logo | colours | ours: bytes | points | distance | gaps | s"
          " | vtracer: bytes | points | distance | gaps | s |")  # fmt: skip
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    every = []
    with tempfile.TemporaryDirectory() as folder:
        source, target, other = (Path(folder) / name for name in ("in.png", "a.svg", "b.svg"))
        for index, (name, picture) in enumerate(logos()):
            picture.save(source)
            began = time.perf_counter()
            shape = ss.read(source, colors="auto")
            fitted = ss.fit_shape(shape, tolerance=TOLERANCE, shared_boundaries=True)
            ss.write(target, fitted)
            ours, seen = result(target, picture, time.perf_counter() - began)
            row = [ours]
            if vtracer is not None:
                began = time.perf_counter()
                vtracer.convert_image_to_svg_py(str(source), str(other))
                row.append(result(other, picture, time.perf_counter() - began)[0])
            every.append(row)
            if chosen.output is not None:
                Image.fromarray(seen).save(chosen.output / f"{index}.png")
            count = len({color for color in shape.colors if color})
            print(f"| {name} | {count} | " + " | ".join(
                f"{r.n_bytes} | {r.n_points} | {r.distance:.2f} | {r.gaps:.0f} | {r.seconds:.2f}"
                for r in row) + " |")  # fmt: skip
    means = np.mean(every, axis=0)
    print("| mean | | " + " | ".join(" | ".join(f"{v:.2f}" for v in own) for own in means) + " |")


if __name__ == "__main__":
    main()
