"""SVG drawings read and written again, as they look before and after.

    python -m benchmarks.repainted FOLDER ...            a line for each folder of .svg files
    python -m benchmarks.repainted FOLDER --every 60     each sixtieth of its files
    python -m benchmarks.repainted FOLDER --fit          fitted within 0.1 % of the size in between
    python -m benchmarks.repainted FOLDER --sheet F.png  the worst 24 side by side, to be looked at

Both are drawn by CairoSVG, 128 pixels wide on white. A pixel is off by its largest difference of
red, green and blue; told are the mean over a drawing's pixels, in the mean and the median of the
drawings, and in how many it is above 2 and 5 %.
"""

from __future__ import annotations

import argparse
import io
import tempfile
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from PIL import Image

import shapespline as ss

if TYPE_CHECKING:
    from numpy.typing import NDArray

PIXELS, WORST, A_ROW = 128, 24, 6


class Pair(NamedTuple):
    """A drawing's name, and its picture before and after."""

    name: str
    before: NDArray[np.uint8]
    after: NDArray[np.uint8]

    @property
    def off(self) -> float:
        """Mean difference of the pixels, from 0 to 1."""
        difference = np.abs(self.before.astype(float) - self.after.astype(float))
        return float(difference.max(axis=2).mean()) / 255


def rendered(data: bytes) -> NDArray[np.uint8]:
    """The picture of an SVG, shape (height, width, 3)."""
    import cairosvg

    png = cairosvg.svg2png(bytestring=data, output_width=PIXELS, background_color="white")
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"))


def again(path: Path, *, fit: bool) -> Pair:
    """A file as it is, and as it is written again."""
    drawing = ss.read(path)
    if fit:
        drawing = ss.fit_shape(drawing.shape, tolerance="0.1%")
    with tempfile.TemporaryDirectory() as folder:
        written = Path(folder) / "again.svg"
        ss.write(written, drawing)
        return Pair(path.name, rendered(path.read_bytes()), rendered(written.read_bytes()))


def sheet(pairs: list[Pair]) -> Image.Image:
    """Pairs side by side."""
    page = Image.new("RGB", (A_ROW * (2 * PIXELS + 8), -(-len(pairs) // A_ROW) * (PIXELS + 8)))
    for k, pair in enumerate(pairs):
        x, y = k % A_ROW * (2 * PIXELS + 8), k // A_ROW * (PIXELS + 8)
        for number, picture in enumerate((pair.before, pair.after)):
            page.paste(Image.fromarray(picture[:PIXELS]), (x + number * PIXELS, y))
    return page


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--fit", action="store_true")
    parser.add_argument("--sheet", type=Path)
    asked = parser.parse_args()
    pairs: list[Pair] = []
    print(f"{'folder':<32} files refused    mean  median  > 2 %  > 5 %")
    for folder in asked.folders:
        found, refused = [], 0
        for path in sorted(folder.rglob("*.svg"))[:: asked.every]:
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", ss.SkippedContentWarning)
                    found.append(again(path, fit=asked.fit))
            except ss.ShapesplineError as error:
                refused += 1
                print(f"  {path.name}: {error}")
        off = np.array([pair.off for pair in found] or [np.nan])
        print(
            f"{folder.name:<32} {len(found):5} {refused:7}  {off.mean():.4f}  {np.median(off):.4f}"
            f"  {(off > 0.02).sum():5}  {(off > 0.05).sum():5}"
        )
        pairs += found
    if asked.sheet:
        sheet(sorted(pairs, key=lambda pair: -pair.off)[:WORST]).save(asked.sheet)


if __name__ == "__main__":
    main()
