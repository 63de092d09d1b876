"""The thresholds of uneven light and of specks, each tried over a range.

    python -m benchmarks.picture_thresholds

Light: words in two fonts under no light at all, lamps from the left and vignettes of several
strengths, with and without grain; right is what has the parts and holes of the word. Said is how
often the program finds the light uneven, of those lit evenly and of the others.

Specks: a word beside 40 dots of 2 x 2 pixels, 60 % as dark to fully dark, and a ground that passes
the level slowly, all under grain of several deviations (of 255); dots kept, and outlines that are
neither dots nor of the word, of which one is the border of that ground. The threshold
that stands in the program is marked.
"""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

import shapespline as ss
from benchmarks.small_letters import FONTS, drawn, of_pixels, of_shape
from shapespline.tracing import seeing, specks

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import ModuleType

    from numpy.typing import NDArray

GRAIN = (0.0, 3.0)
LAMPS, VIGNETTES = (0.15, 0.3, 0.4), (0.15, 0.25, 0.35)
DOTS, NOISES = 40, (0.0, 2.0, 5.0, 10.0, 16.0)


@contextmanager
def changed(module: ModuleType, name: str, value: float) -> Iterator[None]:
    """A constant with another value."""
    before = getattr(module, name)
    setattr(module, name, value)
    try:
        yield
    finally:
        setattr(module, name, before)


def lit() -> Iterator[tuple[bool, NDArray[np.uint8], NDArray[np.bool_]]]:
    """Whether the light is even, the picture, and the ink."""
    rng = np.random.default_rng(0)
    for font in FONTS[::2]:
        word = np.pad(drawn("No. 9 gä 8", font, 40), 40, constant_values=255)
        y, x = np.mgrid[-1 : 1 : word.shape[0] * 1j, -1 : 1 : word.shape[1] * 1j]
        lights = [(True, 1.0 + 0 * x)] * 3
        lights += [(False, 1 - lamp - lamp * x) for lamp in LAMPS]
        lights += [(False, 1 - fall * (x**2 + y**2)) for fall in VIGNETTES]
        for even, light in lights:
            for grain in GRAIN:
                seen = (40 + 0.8 * word) * light + rng.normal(0, grain, word.shape)
                yield even, np.rint(np.clip(seen, 0, 255)).astype(np.uint8), word < 128


def light_line(value: float, name: str) -> str:
    """How many pictures come out right with one threshold."""
    right, said, count = [0, 0], [0, 0], [0, 0]
    for even, picture, ink in lit():
        with changed(seeing, name, value), warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", ss.PictureWarning)
            try:
                good = of_shape(ss.trace(picture)) in of_pixels(ink)
            except ss.ShapesplineError:
                good = False
        count[even] += 1
        right[even] += good
        said[even] += any("unevenly lit" in str(one.message) for one in caught)
    mark = " <-" if value == getattr(seeing, name) else ""
    return (
        f"| {name} {value:g}{mark} | {right[1]}/{count[1]} | {said[1]} | {right[0]}/{count[0]}"
        f" | {said[0]} |"
    )


def dotted(noise: float) -> tuple[NDArray[np.uint8], NDArray[np.float64], int]:
    """A word and dots on grain, where the dots are (y up), and how high the word begins."""
    rng = np.random.default_rng(int(10 * noise))
    word = drawn("gizmo & jäger", FONTS[0], 40)
    image = np.full((word.shape[0] + 160, max(word.shape[1], 420)), 255.0)
    image[-40:] = np.linspace(80, 200, image.shape[1])
    image[: word.shape[0], : word.shape[1]] = word
    places = []
    for index in range(DOTS):
        row, column = word.shape[0] + 20 + 40 * (index // 20), 12 + 20 * (index % 20)
        image[row : row + 2, column : column + 2] = 255 * (1 - np.linspace(0.6, 1, DOTS)[index])
        places.append((column + 1, image.shape[0] - row - 1))
    seen = 30 + 0.75 * image + rng.normal(0, noise, image.shape)
    picture = np.rint(np.clip(seen, 0, 255)).astype(np.uint8)
    return picture, np.array(places, dtype=float), image.shape[0] - word.shape[0]


def speck_line(value: float, name: str) -> str:
    """Dots kept and noise kept with one threshold."""
    cells = []
    for noise in NOISES:
        picture, places, height = dotted(noise)
        with changed(specks, name, value), warnings.catch_warnings():
            warnings.simplefilter("ignore", ss.PictureWarning)
            shape = ss.trace(picture, local="off")
        middles = np.array([contour.points.mean(axis=0) for contour in shape])
        below = middles[middles[:, 1] < height]
        off = np.hypot(*(below[:, None] - places).T)
        kept = int((off < 2).any(axis=1).sum()) if len(below) else 0
        cells.append(f"{kept}, {int((off.min(axis=0) >= 2).sum()) if len(below) else 0}")
    mark = " <-" if value == getattr(specks, name) else ""
    return f"| {name} {value:g}{mark} | {' | '.join(cells)} |"


def main() -> None:
    """Print both tables."""
    print("| light | even: right | said | uneven: right | said |\n|---|---|---|---|---|")
    for name, values in (
        ("ALONG_NOTHING", (0.03, 0.12, 0.3)), ("BETTER", (0.3, 0.9)),
    ):  # fmt: skip
        for value in values:
            print(light_line(value, name), flush=True)
    heads = " | ".join(f"grain {noise:g}" for noise in NOISES)
    print(
        f"\nDots kept of {DOTS}, noise kept:\n\n| specks | {heads} |\n|---{len(NOISES) * '|---'}|"
    )
    for name, values in (
        ("DEVIATIONS", (1.0, 3.0, 5.0, 7.0, 10.0)), ("FAINT", (0.0, 0.05, 0.1, 0.2)),
    ):  # fmt: skip
        for value in values:
            print(speck_line(value, name), flush=True)


if __name__ == "__main__":
    main()
