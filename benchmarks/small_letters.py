"""Words in small letters, drawn, traced and counted, every part and every hole.

    python -m benchmarks.small_letters              200 renderings, 12 to 96 pixels high
    python -m benchmarks.small_letters --jpeg 90    the same through JPEG
    python -m benchmarks.small_letters -o DIR       those that fail, as pictures

The truth is the same word drawn eight times larger. A rendering shows it if its own pixels, cut
at half grey and joined by sides or by corners, have those parts and holes and no others, each in
its place; only such renderings count, and outlines are judged in the same way. potrace, where it is
installed, gets the same pictures (specks of two pixels and less left out, as is its usual way);
of its outlines the numbers alone are compared.
"""

from __future__ import annotations

import argparse
import io
import shutil
import subprocess
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy import ndimage

import shapespline as ss
from shapespline.tracing import trace

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

WORDS = (
    "jäger & söhne", "Éclair, No. 9", "fig. 8a-e", "Größe: 36 %", "mini-bike.io", "café ôté, à",
    "gizmo; Ω 0.5", "R&D ¡olé!", "@agäbe #86", "3½ × 6¾",
)  # fmt: skip
FONTS = ("DejaVuSans.ttf", "DejaVuSans-Bold.ttf", "DejaVuSerif.ttf", "DejaVuSerif-Italic.ttf")
HEIGHTS = (12, 16, 24, 48, 96)
LARGER = 8
EIGHT = np.ones((3, 3), dtype=int)


class Topology(NamedTuple):
    """How many parts the ink has, and how many holes."""

    parts: int
    holes: int


def drawn(word: str, font: str, height: int) -> NDArray[np.uint8]:
    """A word black on white, its capitals about so many pixels high."""
    return rendered(word, font, height).pixels


class Rendering(NamedTuple):
    """A word in pixels, where its pen began, and how many pixels an em has."""

    pixels: NDArray[np.uint8]
    begin: NDArray[np.float64]
    em: int


def rendered(word: str, font: str, height: int) -> Rendering:
    """A word as `drawn` draws it."""
    path = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / font
    em = round(height / 0.73)
    face = ImageFont.truetype(str(path), em, layout_engine=0)
    left, top, right, bottom = face.getbbox(word)
    margin = max(2, height // 4)
    size = (int(right - left) + 2 * margin, int(bottom - top) + 2 * margin)
    image = Image.new("L", size, 255)
    ImageDraw.Draw(image).text((margin - left, margin - top), word, font=face, fill=0)
    return Rendering(np.asarray(image), np.array([margin - top, margin - left]), em)


def of_pixels(ink: NDArray[np.bool_]) -> set[Topology]:
    """Parts and holes of pixels that touch by sides, and by corners."""
    return {
        Topology(int(parts.max()), int(holes.max()))
        for parts, holes in (labels(ink, by_corners) for by_corners in (False, True))
    }


def labels(ink: NDArray[np.bool_], by_corners: bool) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """The number of each pixel's part, and of its hole, from 1; ground outside and ink have 0."""
    parts, _ = ndimage.label(ink, EIGHT if by_corners else None)
    ground, _ = ndimage.label(~np.pad(ink, 1), None if by_corners else EIGHT)
    # The first is that of the upper left corner, outside.
    return parts, np.maximum(ground[1:-1, 1:-1] - 1, 0)


class Word:
    """A small rendering of a word, and its true parts and holes in a large one."""

    def __init__(self, word: str, font: str, height: int) -> None:
        self.small = rendered(word, font, height)
        large = rendered(word, font, height * LARGER)
        ink = ndimage.median_filter(large.pixels, 3) < 128
        self._truth = labels(ink, by_corners=True)
        places = np.indices(ink.shape).reshape(2, -1).T + 0.5
        # Row and column in the small one of each pixel of the large one.
        self._at = (places - large.begin) * (self.small.em / large.em) + self.small.begin

    @property
    def topology(self) -> Topology:
        """How many parts and holes it has."""
        return Topology(*(int(each.max()) for each in self._truth))

    @property
    def is_shown(self) -> bool:
        """Whether the pixels of the small rendering have all of them and no others."""
        return any(self._are(*labels(self.small.pixels < 128, corner)) for corner in (False, True))

    def is_found(self, shape: ss.Shape) -> bool:
        """Whether outlines have all of them, each in its place, and no others."""
        height, width = self.small.pixels.shape
        parts, holes = (Image.new("I", (width * LARGER, height * LARGER)) for _ in range(2))
        counts = [0, 0]
        for index, contour in enumerate(shape):  # parents come first
            hole = shape.is_hole(index)
            counts[hole] += 1
            polygon = [(LARGER * x - 0.5, LARGER * (height - y) - 0.5) for x, y in contour.points]
            for which, plane in enumerate((parts, holes)):
                ImageDraw.Draw(plane).polygon(polygon, fill=counts[hole] if which == hole else 0)
        return tuple(counts) == self.topology and self._are(np.asarray(parts), np.asarray(holes))

    def _are(self, *found: NDArray[np.int32]) -> bool:
        """Whether parts and holes, by their numbers in a picture of the word, are the true ones."""
        at = self._at * (found[0].shape[0] / self.small.pixels.shape[0])
        row, column = np.clip(at.astype(int), 0, np.array(found[0].shape) - 1).T
        return all(
            _are_those(true.ravel(), own[row, column], int(own.max()))
            for true, own in zip(self._truth, found, strict=True)
        )


def _are_those(true: NDArray[np.int32], found: NDArray[np.int32], n_found: int) -> bool:
    """Whether every true part lies on one of its own of those found, and there are no others."""
    n_true = int(true.max())
    if n_true != n_found:
        return False
    shared = np.zeros((n_true + 1, n_found + 1), dtype=int)
    np.add.at(shared, (true, found), 1)
    own = shared[1:, 1:]
    return n_true == 0 or bool(
        own.max(axis=1).all() and len(set(own.argmax(axis=1).tolist())) == n_true
    )


def of_shape(shape: ss.Shape) -> Topology:
    """Parts and holes of outlines."""
    holes = sum(shape.is_hole(index) for index in range(len(shape)))
    return Topology(len(shape) - holes, holes)


def by_potrace(image: NDArray[np.uint8]) -> Topology | None:
    """Parts and holes that potrace finds; None where it is not installed."""
    program = shutil.which("potrace")
    if program is None:
        return None
    bitmap = io.BytesIO()
    Image.fromarray(image).save(bitmap, format="PPM")
    done = subprocess.run(
        [program, "-b", "geojson", "-o", "-", "-"],
        input=bitmap.getvalue(), capture_output=True, check=True,
    )  # fmt: skip
    import json

    features = json.loads(done.stdout)["features"]
    rings = [len(feature["geometry"]["coordinates"]) for feature in features]
    return Topology(len(rings), sum(rings) - len(rings))


def through_jpeg(image: NDArray[np.uint8], quality: int) -> NDArray[np.uint8]:
    """What is left of a picture after JPEG."""
    held = io.BytesIO()
    Image.fromarray(image).save(held, format="JPEG", quality=quality)
    return np.asarray(Image.open(held))


def words() -> Iterator[tuple[str, Word]]:
    """Names and words."""
    for word in WORDS:
        for font in FONTS:
            for height in HEIGHTS:
                yield f"{word} {font[:-4]} {height}", Word(word, font, height)


def main() -> None:
    """Read the arguments and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--jpeg", type=int, help="quality")
    parser.add_argument("-o", "--output", type=Path, help="folder for pictures of what fails")
    chosen = parser.parse_args()
    shown, right, theirs, failures = 0, 0, 0, []
    for name, word in words():
        if not word.is_shown:
            continue
        truth, image = word.topology, word.small.pixels
        if chosen.jpeg is not None:
            image = through_jpeg(image, chosen.jpeg)
        shown += 1
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ss.PictureWarning)
            shape = trace(image)
        theirs += by_potrace(image) == truth
        if word.is_found(shape):
            right += 1
        else:
            failures.append((name, truth, of_shape(shape)))
            if chosen.output is not None:
                Image.fromarray(image).save(chosen.output / f"{len(failures)}.png")
    print(f"{shown} of {len(WORDS) * len(FONTS) * len(HEIGHTS)} renderings show their topology")
    other = f"potrace {theirs}" if shutil.which("potrace") else "potrace is not installed"
    print(f"shapespline has {right} of them right, {other}")
    for name, truth, found in failures:
        print(f"  {name}: {truth.parts} parts and {truth.holes} holes, found {tuple(found)}")


if __name__ == "__main__":
    main()
