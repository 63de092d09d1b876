"""What the options of tracing do, side by side: the picture of docs/howto/pictures.md.

python -m benchmarks.picture_options
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy.ndimage import gaussian_filter

import shapespline as ss
from benchmarks.figure_style import save
from benchmarks.howto_figures import ORANGE, TARGET, canvas
from shapespline.tracing import trace

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

SIZE = (240, 130)


def words(ink: str = "#000000", ground: str = "#ffffff") -> Image.Image:
    """Small letters and a disc."""
    n = 4
    image = Image.new("RGB", (SIZE[0] * n, SIZE[1] * n), ground)
    draw = ImageDraw.Draw(image)
    path = f"{matplotlib.get_data_path()}/fonts/ttf/DejaVuSans.ttf"
    draw.text((12 * n, 20 * n), "jäger", font=ImageFont.truetype(path, 40 * n), fill=ink)
    draw.text((14 * n, 84 * n), "No. 9, gä", font=ImageFont.truetype(path, 18 * n), fill=ink)
    draw.ellipse((170 * n, 30 * n, 220 * n, 80 * n), fill="#c81e1e")
    return image.resize(SIZE, Image.Resampling.BOX)


def touching() -> NDArray[np.uint8]:
    """Two discs joined by what a blur leaves between them."""
    y, x = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    discs = np.minimum(np.hypot(x - 82, y - 65), np.hypot(x - 158, y - 65)) <= 36
    return np.rint(255 * (1 - gaussian_filter(discs.astype(float), 4))).astype(np.uint8)


def shadowed() -> NDArray[np.uint8]:
    """Words half of which lie in a bluish shadow."""
    image = np.asarray(words().convert("L"))[:, :, None] * np.ones(3)
    y, x = np.mgrid[: SIZE[1], : SIZE[0]]
    image[x + 0.5 * y > 150] *= (0.35, 0.4, 0.9)
    return np.rint(image).astype(np.uint8)


def panels() -> list[tuple[str, NDArray[Any], dict[str, Any]]]:
    """Titles, pictures and options."""
    rng = np.random.default_rng(1)
    plain = np.asarray(words())
    x = np.linspace(0, 1, SIZE[0])[None, :]
    lamp = np.asarray(words().convert("L")) * (1 - 0.65 * x)
    lamp = np.clip(lamp + 40 * (1 - 0.65 * x) + rng.normal(0, 2, lamp.shape), 0, 255)
    lamp = lamp.astype(np.uint8)
    grain = np.clip(np.asarray(words().convert("L")) * 0.5 + rng.normal(70, 28, lamp.shape), 0, 255)
    grain = grain.astype(np.uint8)
    return [
        ("nothing said", plain, {}),
        ("--color '#c81e1e'", plain, {"color": "#c81e1e"}),
        ("--crop 150,10,90,90", plain, {"crop": "150,10,90,90"}),
        ("--invert", plain, {"invert": True}),
        ("uneven light, --local off", lamp, {"local": "off"}),
        ("uneven light, nothing said", lamp, {}),
        ("--level 40", lamp, {"level": 40}),
        ("grain, nothing said", grain, {}),
        ("grain, --blur 1.2", grain, {"blur": 1.2}),
        ("--colors auto", plain, {"colors": "auto"}),
        ("touching, nothing said", touching(), {}),
        ("touching, --level 60", touching(), {"level": 60}),
        ("bluish shadow, nothing said", shadowed(), {}),
        ("bluish shadow, --channel blue", shadowed(), {"channel": "blue"}),
    ]


def show(axes: Axes, title: str, image: NDArray[Any], options: dict[str, Any]) -> None:
    """A picture, what was found in it, and in grey what was left out."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.PictureWarning)
        shape = trace(image, **options)
    if "crop" in options:
        x, y, width, height = (int(part) for part in options["crop"].split(","))
        image = image[y : y + height, x : x + width]
    frame = shape.frame
    assert frame is not None
    axes.imshow(image, cmap="gray", alpha=0.55, extent=(0, frame.width, 0, frame.height))
    for contour in shape.left_out:
        axes.plot(*contour.polyline.T, color="#0072B2", linewidth=0.5)
    for contour, color in zip(shape, shape.colors, strict=True):
        if color:
            axes.fill(*contour.polyline.T, color=color)
        axes.plot(*contour.polyline.T, color=ORANGE, linewidth=1.0)
    note = f"\n{len(shape)} outline{'s' * (len(shape) != 1)}"
    if shape.left_out:
        note += f", {len(shape.left_out)} left out (blue)"
    axes.set_title(title + note, fontsize=13)


def main() -> None:
    """Draw all panels in rows of two."""
    found = panels()
    figure, _ = canvas(1)
    figure.clear()
    figure.set_size_inches(12, 3.6 * (len(found) // 2))
    for one, panel in zip(figure.subplots(len(found) // 2, 2).ravel(), found, strict=True):
        one.set_aspect("equal")
        one.axis("off")
        show(one, *panel)
    save(figure, TARGET / "pictures.png", dpi=80)


if __name__ == "__main__":
    main()
