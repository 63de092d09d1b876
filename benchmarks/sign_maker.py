"""Ten logos with small text, as renderings and as photographs, traced as a sign maker would.

    python -m benchmarks.sign_maker              a line for each rendering and each photograph
    python -m benchmarks.sign_maker -o DIR       and the pictures beside what was found, four times

A photograph has twice the pixels and is seen at an angle, out of focus, with the corners darker,
grain, and JPEG of quality 88. Traced are the ink and the colours, as they come. Parts are outlines
of the ink that are no holes, of the colours areas of those of the print; the truth is counted in
the same drawing eight times larger. Colour distance: mean absolute difference of the areas to the
picture in an even light, of 255. Last what the program said. Pictures show the curves, fitted
without a tolerance.
"""

from __future__ import annotations

import argparse
import io
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFilter, ImageFont
from scipy import ndimage

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

SIZE, LARGER, ZOOM, SAMPLES = (620, 280), 8, 4, 4000
# A photograph has so many times the pixels of a rendering.
CLOSER = 2
GROUND = "#f7f4ec"
# Name, small text, colour of the emblem, colour of the text.
SIGNS = (
    ("Jäger & Söhne", "Möbel, Türen, Böden: Tel. 0561-98 36", "#c8281e", "#1e2a44"),
    ("Café Ibiß", "täglich 8-19 Uhr, sonntags ab 9", "#2e7d4f", "#3b2314"),
    ("gizmo 36", "radio & video, fig. 8a-e, No. 9", "#1464b4", "#141414"),
    ("Ölmühle", "kaltgepreßt, 100 % natürlich; seit 1896", "#6b8e23", "#2f2f2f"),
    ("Fähre", "Abfahrt: 6.40, 8.20, 9.55 (ä. d. Brücke)", "#0077aa", "#0a2030"),
    ("R&D Büro", "Pläne, Maße, Aufmaß: info@rd-büro.de", "#e07b00", "#222244"),
    ("Bäckerei", "Brot @ 5 Uhr, Brötchen ab 6 Uhr!", "#a0522d", "#3c1414"),
    ("Éclair", "pâtisserie, thé, café: à côté du pont", "#b03060", "#301830"),
    ("mini-bike", "Räder, Öl, Schläuche: 9,90 bis 99,-", "#d4a017", "#102a10"),
    ("Größe 8", "Schuhe, Gürtel & Ä.; Größen 36-48½", "#4b3f9e", "#1a1a1a"),
)  # fmt: skip


class Sign(NamedTuple):
    """A picture, the same in an even light, and the number of parts and holes of its print.

    Of all ink, and colour by colour.
    """

    name: str
    picture: NDArray[np.uint8]
    even: NDArray[np.uint8]
    ink: tuple[int, int]
    colors: dict[str, int]


def drawn(index: int, n: int) -> Image.Image:
    """A sign, n times larger."""
    name, text, emblem, ink = SIGNS[index]
    folder = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    image = Image.new("RGB", (SIZE[0] * n, SIZE[1] * n), GROUND)
    pen = ImageDraw.Draw(image)
    pen.ellipse([n * x for x in (30, 30, 130, 130)], fill=emblem)
    pen.ellipse([n * x for x in (50, 50, 110, 110)], fill=ink)
    spikes = np.radians(90 + 36 * np.arange(10))
    reach = np.where(np.arange(10) % 2, 10.0, 24.0 + index % 3) * n
    star = np.column_stack([80 * n + reach * np.cos(spikes), 80 * n - reach * np.sin(spikes)])
    pen.polygon([tuple(point) for point in star.tolist()], fill=GROUND)
    pen.rectangle([n * x for x in (150, 122, 590, 130)], fill=emblem)
    for words, font, size, place in (
        (name, "DejaVuSans-Bold.ttf", 44, (150, 62)), (text, "DejaVuSans.ttf", 26, (30, 170)),
        (text, "DejaVuSerif.ttf", 22, (30, 220)),
    ):  # fmt: skip
        face = ImageFont.truetype(str(folder / font), size * n, layout_engine=0)
        pen.text((place[0] * n, place[1] * n), words, font=face, fill=ink)
    return image


def counted(pixels: NDArray[np.bool_]) -> tuple[int, int]:
    """Parts and holes of pixels."""
    ground = np.pad(~pixels, 1, constant_values=True)
    return ndimage.label(pixels, np.ones((3, 3)))[1], ndimage.label(ground)[1] - 1


def photographed(image: Image.Image, seed: int) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """A rendering seen at an angle, blurred, darker at its corners, with grain, through JPEG.

    And in an even light.
    """
    n, rng = LARGER // CLOSER, np.random.default_rng(seed)
    size = (SIZE[0] * CLOSER, SIZE[1] * CLOSER)
    w, h = image.size
    off = rng.uniform(-0.025, 0.025, (4, 2)) * (w, h) + np.array([0.02, 0.02]) * (w, h) * np.array(
        [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    )
    corners = np.array([(0, 0), (w, 0), (w, h), (0, h)])
    rows, values = [], []
    for (x, y), (u, v) in zip(corners, corners + off, strict=True):
        rows += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
        values += [u, v]
    seen = image.transform(
        image.size, Image.Transform.PERSPECTIVE,
        np.linalg.solve(np.array(rows, dtype=float), np.array(values, dtype=float)).tolist(),
        Image.Resampling.BICUBIC, fillcolor=GROUND,
    )  # fmt: skip
    seen = seen.filter(ImageFilter.GaussianBlur(1.0 * n)).resize(size, Image.Resampling.BOX)
    y, x = np.mgrid[-1 : 1 : size[1] * 1j, -1 : 1 : size[0] * 1j]
    light = (0.97 - 0.10 * (x**2 + y**2) - 0.05 * x)[:, :, None]
    even = np.asarray(seen)
    values_seen = even * light + rng.normal(0, 2.0, (size[1], size[0], 3))
    held = io.BytesIO()
    Image.fromarray(np.clip(values_seen, 0, 255).astype(np.uint8)).save(held, "JPEG", quality=88)
    brightest = np.rint(even * light.max()).astype(np.uint8)
    return np.asarray(Image.open(held).convert("RGB")), brightest


def signs() -> Iterator[tuple[Sign, Sign]]:
    """Each sign as a rendering and as a photograph."""
    for index, (name, _, emblem, ink) in enumerate(SIGNS):
        large = drawn(index, LARGER)
        pixels = np.asarray(large)
        colors = {}
        for color in (emblem, ink):
            own = (pixels == np.array(Image.new("RGB", (1, 1), color))[0, 0]).all(axis=2)
            colors[color] = counted(ndimage.median_filter(own, 3))[0]
        ground = (pixels == np.array(Image.new("RGB", (1, 1), GROUND))[0, 0]).all(axis=2)
        every = counted(~ndimage.median_filter(ground, 3))
        clean = np.asarray(large.resize(SIZE, Image.Resampling.BOX))
        yield (
            Sign(name, clean, clean, every, colors),
            Sign(f"{name}, photograph", *photographed(large, index), every, colors),
        )


def rgb(color: str) -> NDArray[np.float64]:
    """Red, green and blue of a code."""
    return np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)], dtype=float)


def painted(shape: ss.Shape, outlines: Sequence[NDArray[np.float64]], zoom: int) -> Image.Image:
    """Areas in their colours, so many times larger."""
    assert shape.frame is not None
    image = Image.new(
        "RGB", (int(shape.frame.width) * zoom, int(shape.frame.height) * zoom), "magenta"
    )
    pen = ImageDraw.Draw(image)
    for outline, color in zip(outlines, shape.colors, strict=True):
        if color:
            points = zoom * (outline * (1, -1) + (0, shape.frame.height))
            pen.polygon([tuple(point) for point in points.tolist()], fill=color)
    return image


def table_line(sign: Sign, output: Path | None) -> tuple[str, bool]:
    """What was found in one picture, and whether every letter is there."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", ss.PictureWarning)
        ink = ss.trace(sign.picture)
        areas = ss.trace(sign.picture, colors="auto")
    holes = sum(ink.is_hole(k) for k in range(len(ink)))
    parts = (len(ink) - holes, holes)
    names = [color for color in areas.colors if color]
    found = dict.fromkeys(sign.colors, 0)
    off = 0.0
    for color in names:
        near = min([*sign.colors, GROUND], key=lambda own: np.abs(rgb(own) - rgb(color)).sum())
        found[near] = found.get(near, 0) + 1
        off = max(off, float(np.abs(rgb(near) - rgb(color)).max()))
    seen = painted(areas, [contour.polyline for contour in areas], ZOOM).reduce(ZOOM)
    distance = float(np.abs(np.asarray(seen).astype(float) - sign.even).mean())
    if output is not None:
        before = Image.fromarray(sign.picture).resize(
            (ZOOM * sign.picture.shape[1], ZOOM * sign.picture.shape[0]), Image.Resampling.NEAREST
        )
        both = Image.new("RGB", (before.width, 2 * before.height))
        both.paste(before, (0, 0))
        fits = ss.fit_shape(areas, shared_boundaries=True)
        curves = [fit.curve(np.linspace(0, 1, SAMPLES)) for fit in fits]
        both.paste(painted(areas, curves, ZOOM), (0, before.height))
        both.save(output / f"{sign.name.replace(' ', '_').replace(',', '')}.png")
    right = parts == sign.ink and all(found[c] == sign.colors[c] for c in sign.colors)
    by_color = " ".join(f"{found[c]}/{n}" for c, n in sign.colors.items())
    remarks = "; ".join(dict.fromkeys(str(one.message).partition(":")[0] for one in said))
    return (
        f"| {sign.name} | {parts[0]}/{sign.ink[0]} | {parts[1]}/{sign.ink[1]} | {by_color}"
        f" | {len(set(names))} | {off:.0f} | {distance:.2f} | {remarks} |"
    ), right


def main() -> None:
    """Read the arguments and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", type=Path, help="folder for pictures")
    chosen = parser.parse_args()
    print("| sign | ink: parts | holes | areas by colour | colours | farthest colour | distance"
          " | said |")  # fmt: skip
    print("|---|---|---|---|---|---|---|---|")
    right = [0, 0]
    for pair in signs():
        for kind, sign in enumerate(pair):
            line, good = table_line(sign, chosen.output)
            right[kind] += good
            print(line, flush=True)
    print(f"\nEvery letter, dot and counter: {right[0]} of {len(SIGNS)} renderings,"
          f" {right[1]} of {len(SIGNS)} photographs")  # fmt: skip


if __name__ == "__main__":
    main()
