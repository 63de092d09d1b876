"""Thin lines, small text, outlines and straight borders in colours that are known, traced.

    python -m benchmarks.fine_colors              a line for each kind of picture
    python -m benchmarks.fine_colors --all        and one for each picture
    python -m benchmarks.fine_colors -o DIR       and what was traced beside the pictures, enlarged

Every picture is drawn with eight by eight samples a pixel, as PNG and as JPEG of quality 90, and
traced with ``colors="auto"``, the PNG with the number of its colours, too. A part is one line, one
word or all outlines of a picture. Its hue error is the distance of the colour that most of its
middle came back in from the true one (OKLab, times 100; 2 can just be seen), lost is the share of
its middle that came back nearer to another colour of the picture. Of borders the nib is the largest
distance of a sample in a wrong area from where it would be right, corners left out, in pixels.
"""

from __future__ import annotations

import argparse
import io
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy import ndimage

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

SAMPLES, QUALITY, ZOOM = 8, 90, 6
WIDTHS, TYPE_SIZES, OUTLINES = (1.0, 1.5, 2.0, 3.0, 4.0), (14, 20, 28), (1.0, 1.5, 2.0, 3.0)
# The ground and what is drawn on it.
PALETTES = {
    "plain": ("#ffffff", "#ff0000", "#00aa00", "#0000ff", "#000000"),
    "set": ("#ffffff", "#e41a1c", "#377eb8", "#4daf4a", "#984ea3"),
    "chart": ("#ffffff", "#1f77b4", "#ff7f0e", "#2ca02c", "#d62728"),
    "greys": ("#ffffff", "#000000", "#808080", "#c8c8c8", "#d62728"),
    "shades": ("#ffffff", "#7f0000", "#d00000", "#ff8080", "#ffb000"),
    "map": ("#9fd3f0", "#7bbf6a", "#e8c96b", "#d9776a", "#8d6fae"),
    "dark": ("#202830", "#ffd54f", "#ef5350", "#90a4ae", "#ffffff"),
}
KINDS = ("PNG", "JPEG", "counted")
FILLS = ("#ffffff", "#f44336", "#2196f3", "#ffeb3b", "#222222")
BORDERS = 30
# Samples of a border so near to a corner, in pixels, are left out.
CORNER = 3.0


class Drawn(NamedTuple):
    """A drawing: colours, the index of one for each sample, and the middles of its parts."""

    name: str
    colors: tuple[str, ...]
    samples: NDArray[np.uint8]
    middles: list[tuple[int, NDArray[np.bool_]]]
    corners: NDArray[np.float64]

    def picture(self) -> Image.Image:
        """As pixels."""
        table = np.array([rgb(color) for color in self.colors], dtype=np.uint8)
        return Image.fromarray(table[self.samples]).reduce(SAMPLES)


def rgb(color: str) -> tuple[int, ...]:
    """Of #rrggbb."""
    return tuple(bytes.fromhex(color[1:]))


def oklab(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of sRGB, 0 to 255 (B. Ottosson, 2020), times 100."""
    part = np.asarray(values, dtype=np.float64) / 255
    linear = np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)
    cones = linear @ np.array(
        [
            [0.4122214708, 0.2119034982, 0.0883024619],
            [0.5363325363, 0.6806995451, 0.2817188376],
            [0.0514459929, 0.1073969566, 0.6299787005],
        ]
    )
    return 100 * (
        np.cbrt(cones)
        @ np.array(
            [
                [0.2104542553, 1.9779984951, 0.0259040371],
                [0.7936177850, -2.4285922050, 0.7827717662],
                [-0.0040720468, 0.4505937099, -0.8086757660],
            ]
        )
    )


def lines() -> Iterator[Drawn]:
    """Four lines of each width on each ground, bent ones and straight ones."""
    n, size = SAMPLES, (190, 125)
    for name, colors in PALETTES.items():
        for width in WIDTHS:
            image = Image.new("L", (size[0] * n, size[1] * n))
            draw = ImageDraw.Draw(image)
            middles = []
            for k in range(4):
                at = np.arange(15.0)
                bent = 25 + 23 * k + 7 * np.sin(at * 1.3 + k) + 5 * np.cos(at * 2.1 * (k + 1))
                points = [*zip(10.3 + 8 * at, bent, strict=True)]
                straight = [(135.3, 12.4 + 29 * k), (184.1, 15.2 + (27, 30, 33, 36)[k] * k)]
                middle = Image.new("L", image.size)
                for way in (points, straight):
                    way = [(x * n, y * n) for x, y in way]
                    draw.line(way, fill=k + 1, width=round(width * n), joint="curve")
                    ImageDraw.Draw(middle).line(way, fill=1)
                middles.append((k + 1, np.asarray(middle) > 0))
            yield Drawn(f"{name} {width:g}", colors, np.asarray(image), middles, np.empty((0, 2)))


def texts() -> Iterator[Drawn]:
    """Four words of each size on each ground."""
    n = SAMPLES
    path = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    for name, colors in PALETTES.items():
        for size in TYPE_SIZES:
            face = ImageFont.truetype(str(path / "DejaVuSans.ttf"), size * n)
            image = Image.new("L", (size * 7 * n, size * 6 * n))
            middles = []
            for k, word in enumerate(("Colour 1", "jagged", "& Sons 9", "gizmo 48")):
                own = Image.new("1", image.size)
                at = ((8.3 + k / 4) * n, (4.6 + 1.37 * k * size) * n)
                ImageDraw.Draw(own).text(at, word, font=face, fill=1)
                image.paste(k + 1, mask=own)
                middles.append((k + 1, ndimage.binary_erosion(np.asarray(own), iterations=n // 4)))
            yield Drawn(f"{name} {size}", colors, np.asarray(image), middles, np.empty((0, 2)))


def outlined() -> Iterator[Drawn]:
    """Figures in three colours, two of them side by side, with a dark outline."""
    n = SAMPLES
    turn = np.linspace(0, 2 * np.pi, 200)
    star = np.where(np.arange(10) % 2, 11.0, 26.0)
    spin = np.arange(10) * np.pi / 5 + 0.2
    ways = [
        np.column_stack([35.3 + 24 * np.cos(turn), 36.6 + 22 * np.sin(turn)]),
        np.column_stack([100.2 + star * np.cos(spin), 36.4 + star * np.sin(spin)]),
        np.array([(140.3, 12.2), (182.4, 18.7), (176.1, 60.5), (150.4, 52.3)]),
        np.array([(12.4, 70.3), (90.1, 75.2), (90.1, 118.4), (20.7, 112.6)]),
        np.array([(90.1, 75.2), (170.8, 70.1), (150.3, 110.3), (90.1, 118.4)]),
    ]
    for width in OUTLINES:
        image = Image.new("L", (195 * n, 128 * n))
        draw, middle = ImageDraw.Draw(image), Image.new("L", image.size)
        for k, way in enumerate(ways):
            draw.polygon([(x * n, y * n) for x, y in way], fill=k % 3 + 1)
        for way in ways:
            closed = [(x * n, y * n) for x, y in [*way, way[0], way[1]]]
            draw.line(closed, fill=4, width=round(width * n), joint="curve")
            ImageDraw.Draw(middle).line(closed, fill=1)
        parts = [(4, np.asarray(middle) > 0)]
        yield Drawn(f"outline {width:g}", FILLS, np.asarray(image), parts, np.empty((0, 2)))


def borders() -> Iterator[Drawn]:
    """A polygon and a disc in colours at random, and those of a map."""
    n = SAMPLES
    corners = np.array([(12.3, 20.6), (70.2, 12.4), (80.1, 82.3), (22.2, 90.5)])
    for index in range(BORDERS + 3):
        rng = np.random.default_rng(index)
        colors = tuple(f"#{value:06x}" for value in rng.integers(0, 1 << 24, 3).tolist())
        if index >= BORDERS:
            ground, green, *others = PALETTES["map"]
            colors = (ground, green, others[index - BORDERS])
        apart = oklab(np.array([rgb(color) for color in colors]))
        if min(np.linalg.norm(apart[a] - apart[b]) for a, b in ((0, 1), (0, 2), (1, 2))) < 10:
            continue
        image = Image.new("L", (150 * n, 100 * n))
        draw = ImageDraw.Draw(image)
        draw.polygon([(x * n, y * n) for x, y in corners], fill=1)
        draw.ellipse([87.3 * n, 22.4 * n, 143.3 * n, 78.4 * n], fill=2)
        yield Drawn(f"border {index}", colors, np.asarray(image), [], corners)


def painted(shape: ss.Shape, size: tuple[int, int]) -> NDArray[np.uint8]:
    """The samples of a traced shape, RGB."""
    canvas = Image.new("RGB", size, "#ff00ff")
    for index, color in enumerate(shape.colors):
        if color is None:
            continue
        mask = np.zeros(size[::-1], dtype=bool)
        own = [index, *(k for k, parent in enumerate(shape.parents) if parent == index)]
        for k in own:
            points = shape.contours[k].points * (1, -1) + (0, size[1] / SAMPLES)
            ring = Image.new("1", size)
            # The middle of sample i is i + 0.5; Pillow draws a polygon from middle to middle.
            ImageDraw.Draw(ring).polygon([tuple(p) for p in (points * SAMPLES - 0.5).tolist()], 1)
            mask ^= np.asarray(ring)
        canvas.paste(color, mask=Image.fromarray(mask))
    return np.asarray(canvas)


class Told(NamedTuple):
    """What came back of a picture: for each part its hue error and what is lost; and the nib."""

    hues: list[float]
    lost: list[float]
    nib: float
    n_colors: int


def told(drawn: Drawn, seen: NDArray[np.uint8]) -> Told:
    """Compare what is seen with what was drawn."""
    true = oklab(np.array([rgb(color) for color in drawn.colors]))
    codes, back = np.unique(seen.reshape(-1, 3), axis=0, return_inverse=True)
    values = oklab(codes)
    nearest = np.linalg.norm(values[:, None] - true, axis=2).argmin(axis=1)
    back = back.reshape(seen.shape[:2])
    hues, lost = [], []
    for label, middle in drawn.middles:
        own = back[middle]
        usual = np.bincount(own).argmax()
        hues.append(float(np.linalg.norm(values[usual] - true[label])))
        lost.append(float((nearest[own] != label).mean()))
    nib = float("nan")
    if len(drawn.corners):
        wrong = nearest[back]
        off = np.zeros(back.shape)
        for label in range(len(true)):
            own = (wrong == label) & (drawn.samples != label)
            if own.any():
                off[own] = ndimage.distance_transform_edt(drawn.samples != label)[own]
        y, x = np.nonzero(off)
        at = (np.column_stack([x, y]) + 0.5) / SAMPLES
        far = np.linalg.norm(at[:, None] - drawn.corners, axis=2).min(axis=1) > CORNER
        nib = float(off[y, x][far].max(initial=0.0)) / SAMPLES
    return Told(hues, lost, nib, len(codes))


def main() -> None:
    """Read the arguments and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--all", action="store_true", help="a line for each picture")
    parser.add_argument("--only", default="", help="pictures with this in their name")
    parser.add_argument("-o", "--output", type=Path, help="folder for pictures")
    chosen = parser.parse_args()
    columns = "hue, median | worst | lost, mean % | worst | nib, median | worst | failed | s"
    print(f"| kind | {columns} |\n|---|---|---|---|---|---|---|---|---|")
    for group in (lines, texts, outlined, borders):
        for kind in KINDS:
            every: list[Told] = []
            failed, began = 0, time.perf_counter()
            for drawn in group():
                if chosen.only not in drawn.name:
                    continue
                picture, file = drawn.picture(), io.BytesIO()
                if kind == "JPEG":
                    picture.save(file, format="JPEG", quality=QUALITY)
                    picture = Image.open(file)
                pixels = np.asarray(picture)
                try:
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore", ss.PictureWarning)
                        count = len(drawn.colors) if kind == "counted" else "auto"
                        shape = ss.trace(pixels, colors=count)
                except ss.ShapesplineError as error:
                    failed += 1
                    if chosen.all:
                        print(f"  {drawn.name} {kind}: {error}")
                    continue
                seen = painted(shape, drawn.samples.shape[::-1])
                own = told(drawn, seen)
                every.append(own)
                if chosen.all:
                    hues = " ".join(f"{value:.0f}" for value in own.hues)
                    lost = " ".join(f"{100 * value:.0f}" for value in own.lost)
                    print(
                        f"  {drawn.name} {kind}: hue {hues}, lost {lost} %, nib {own.nib:.2f},"
                        f" {own.n_colors} colours of {len(drawn.colors)}"
                    )
                if chosen.output is not None:
                    width, height = picture.size
                    size = (width * ZOOM, height * ZOOM)
                    both = Image.new("RGB", (size[0], 2 * size[1] + 4), "#ff00aa")
                    both.paste(picture.resize(size, Image.Resampling.NEAREST))
                    both.paste(Image.fromarray(seen).resize(size), (0, size[1] + 4))
                    both.save(chosen.output / f"{drawn.name.replace(' ', '_')}_{kind}.png")
            if every:
                hue = np.array([h for t in every for h in t.hues] or [np.nan])
                lost = 100 * np.array([v for t in every for v in t.lost] or [np.nan])
                nib = np.array([t.nib for t in every])
                print(
                    f"| {group.__name__}, {kind} | {np.median(hue):.1f} | {hue.max():.0f}"
                    f" | {lost.mean():.1f} | {lost.max():.0f} | {np.median(nib):.2f}"
                    f" | {nib.max():.2f} | {failed} | {time.perf_counter() - began:.0f} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
