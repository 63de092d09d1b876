"""Pictures of drawings, 8 bits: exact coverage, Cairo, a browser, JPEG, scans, photographs."""

from __future__ import annotations

import atexit
import io
from contextlib import ExitStack
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageFilter
from scipy.ndimage import gaussian_filter

from benchmarks.drawn.truth import Cubic, Line

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from benchmarks.drawn.truth import Array, Outline

    Picture = NDArray[np.uint8]


# Of prints: what is seen of the disc beside a drawing, pixels, and colours, red, green and blue.
BESIDE = 64
PAPER, INKS = (247, 244, 236), ((200, 40, 30), (30, 42, 68))
# Of drawings that fill their picture.
CUT = "cut to the ink"
# Of pictures of one bit.
BITS = "black and white"


class MissingError(Exception):
    """What a renderer or a tracer needs is not on this machine; the sentence says what."""


def exact(outlines: Sequence[Outline], size: int) -> Picture:
    """By the coverage of each pixel."""
    return np.rint(255 * (1 - coverage(outlines, size))).astype(np.uint8)


def jpeg(picture: Picture, quality: int = 90) -> Picture:
    """Written as JPEG and read back."""
    stream = io.BytesIO()
    Image.fromarray(picture).save(stream, "JPEG", quality=quality)
    return np.asarray(Image.open(stream))


def enlarged(
    outlines: Sequence[Outline], size: int, way: Image.Resampling, by: float = 2.0
) -> Picture:
    """By the coverage of pixels that much wider, and enlarged."""
    small = round(size / by)
    drawn = [
        tuple(one.moved(small / size, 0.0, np.zeros(2)) for one in outline) for outline in outlines
    ]
    return np.asarray(Image.fromarray(exact(drawn, small)).resize((size, size), way))


def sampled(outlines: Sequence[Outline], size: int, each: int) -> Picture:
    """By so many by so many samples in each pixel."""
    large = [
        tuple(one.moved(float(each), 0.0, np.zeros(2)) for one in outline) for outline in outlines
    ]
    hit = (coverage(large, each * size) >= 0.5).reshape(size, each, size, each)
    return np.rint(255 * (1 - hit.mean(axis=(1, 3)))).astype(np.uint8)


def in_light(outlines: Sequence[Outline], size: int) -> Picture:
    """By the coverage of each pixel, ink and ground mixed as light, not as values."""
    return np.rint(255 * (1 - coverage(outlines, size)) ** (1 / 2.2)).astype(np.uint8)


def raised(outlines: Sequence[Outline], size: int) -> Picture:
    """By the coverage of each pixel, its contrast doubled: a quarter is cut off at either end."""
    doubled = 2.0 * exact(outlines, size).astype(float) - 127.5
    return np.rint(np.clip(doubled, 0, 255)).astype(np.uint8)


def sharpened(outlines: Sequence[Outline], size: int) -> Picture:
    """By the coverage of each pixel, then an unsharp mask."""
    mask = ImageFilter.UnsharpMask(radius=1.0, percent=100, threshold=0)
    return np.asarray(Image.fromarray(exact(outlines, size)).filter(mask))


def scanned(outlines: Sequence[Outline], size: int, blur: float, grain: float) -> Picture:
    """Dark grey on light grey, spread by a lens (pixels), under grain (of 255)."""
    sharp = 20 + 0.8 * exact(outlines, size).astype(float)
    noise = np.random.default_rng(1).normal(0.0, grain, sharp.shape)
    return np.rint(np.clip(gaussian_filter(sharp, blur) + noise, 0, 255)).astype(np.uint8)


def bits(picture: Picture) -> Picture:
    """Cut half-way between its ink and its ground."""
    half = 0.5 * (float(np.quantile(picture, 0.02)) + float(np.quantile(picture, 0.98)))
    return np.where(picture > half, 255, 0).astype(np.uint8)


def printed(outlines: Sequence[Outline], size: int) -> Picture:
    """In one ink on tinted paper, beside it a disc of another; shape (size, size + BESIDE, 3)."""
    ink = np.pad(coverage(outlines, size), ((0, 0), (0, BESIDE)))[..., None]
    y, x = np.mgrid[:size, : size + BESIDE] + 0.5
    off = np.hypot(x - size - 0.5 * BESIDE, y - 0.5 * size)
    disc = np.clip(0.35 * BESIDE - off + 0.5, 0.0, 1.0)[..., None]
    paper, first, second = np.array(PAPER), np.array(INKS[0]), np.array(INKS[1])
    picture = paper + ink * (first - paper) + disc * (second - paper)
    return np.rint(picture).astype(np.uint8)


def tinted(outlines: Sequence[Outline], size: int) -> Picture:
    """In one ink on tinted paper, shape (size, size, 3)."""
    ink, paper = coverage(outlines, size)[..., None], np.array(PAPER)
    return np.rint(paper + ink * (np.array(INKS[0]) - paper)).astype(np.uint8)


def printed_scanned(outlines: Sequence[Outline], size: int) -> Picture:
    """Such a print, badly scanned: spread by 1.2 pixels, grain of 12 in each colour, JPEG."""
    picture = gaussian_filter(printed(outlines, size).astype(float), (1.2, 1.2, 0.0))
    grain = np.random.default_rng(2).normal(0.0, 12.0, picture.shape)
    return jpeg(np.rint(np.clip(picture + grain, 0, 255)).astype(np.uint8))


def photographed(outlines: Sequence[Outline], size: int) -> Picture:
    """Such a print: out of focus by a pixel, darker towards its corners, grain, JPEG."""
    picture = gaussian_filter(printed(outlines, size).astype(float), (1.0, 1.0, 0.0))
    y, x = np.mgrid[-1 : 1 : size * 1j, -1 : 1 : (size + BESIDE) * 1j]
    light = 0.97 - 0.10 * (x**2 + y**2) - 0.05 * x
    grain = np.random.default_rng(1).normal(0.0, 2.0, picture.shape)
    seen = np.clip(light[..., None] * picture + grain, 0, 255)
    return jpeg(np.rint(seen).astype(np.uint8), 88)


def is_ink(color: Sequence[int]) -> bool:
    """Whether a colour is nearer to the ink of a printed drawing than to the paper."""
    off = [np.abs(np.subtract(color[:3], one)).sum() for one in (INKS[0], PAPER)]
    return bool(off[0] < off[1])


def by_cairo(outlines: Sequence[Outline], size: int) -> Picture:
    """By CairoSVG."""
    try:
        import cairosvg
    except (ImportError, OSError) as error:
        raise MissingError("Cairo was left out: CairoSVG is not installed") from error
    return _grey(cairosvg.svg2png(bytestring=svg(outlines, size).encode()))


def by_browser(outlines: Sequence[Outline], size: int) -> Picture:
    """By a browser that Playwright starts."""
    page = _page()
    page.set_viewport_size({"width": size, "height": size})
    page.set_content(f"<body style='margin:0'>{svg(outlines, size)}</body>")
    return _grey(page.screenshot())


@cache
def _page() -> Any:
    """One page for all pictures; the process takes it along when it ends."""
    try:
        from benchmarks.studio import browser_path, browsing
    except ImportError as error:
        raise MissingError("Chromium was left out: Playwright is not installed") from error
    if browser_path() is None:
        raise MissingError("Chromium was left out: no browser is installed")
    stack = ExitStack()
    atexit.register(stack.close)
    return stack.enter_context(browsing()).new_page()


def _grey(png: bytes) -> Picture:
    image = Image.open(io.BytesIO(png)).convert("RGBA")
    white = Image.new("RGBA", image.size, "white")
    return np.asarray(Image.alpha_composite(white, image).convert("L"))


def svg(outlines: Sequence[Outline], size: int) -> str:
    """A picture's source, y down: arcs as A, cubics as C."""
    path = "".join(_path(outline, size) for outline in outlines)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}"'
        f' style="display:block"><path fill-rule="evenodd" d="{path}"/></svg>'
    )


def _path(outline: Outline, size: int) -> str:
    def at(point: Array) -> str:
        return f"{point[0]:.6f},{size - point[1]:.6f}"

    said = [f"M{at(outline[0].begin)}"]
    for element in outline:
        if isinstance(element, Line):
            said.append(f"L{at(element.end)}")
        elif isinstance(element, Cubic):
            said.append("C" + " ".join(at(point) for point in element.control[1:]))
        else:
            parts = 1 + int(abs(element.sweep) // 3)
            way, r = int(element.sweep < 0), f"{element.radius:.6f}"
            for k in range(1, parts + 1):
                end = element.at(element.start + element.sweep * k / parts)
                said.append(f"A{r},{r} 0 0 {way} {at(end)}")
    return "".join(said) + "Z"


def coverage(outlines: Sequence[Outline], size: int) -> Array:
    """Part of each pixel that is inside (even-odd), exact for chords of a twentieth of a pixel.

    Signed areas left of each edge are added up, as in Levien's font-rs; row 0 is at the top.
    """
    areas = np.zeros((size, size + 2))
    for outline in outlines:
        for element in outline:
            step = 1e9 if isinstance(element, Line) else 0.25
            points = np.concatenate([element.points(step), element.end[None]])
            for (ax, ay), (bx, by) in zip(points[:-1].tolist(), points[1:].tolist(), strict=True):
                _add_edge(areas, ax, size - ay, bx, size - by)
    return np.clip(np.abs(np.cumsum(areas, axis=1)[:, :size]), 0.0, 1.0)


def _add_edge(areas: Array, ax: float, ay: float, bx: float, by: float) -> None:
    """The area right of an edge within its rows, as differences along them."""
    if ay == by:
        return
    sign = 1.0
    if ay > by:
        ax, ay, bx, by, sign = bx, by, ax, ay, -1.0
    slope = (bx - ax) / (by - ay)
    for row in range(int(np.floor(ay)), int(np.ceil(by))):
        top, bottom = max(ay, row), min(by, row + 1.0)
        left, right = sorted((ax + (top - ay) * slope, ax + (bottom - ay) * slope))
        height = sign * (bottom - top)
        for column in range(int(np.floor(left)), int(np.floor(right)) + 1):
            a, b = max(left, column), min(right, column + 1.0)
            share = 1.0 if right == left else (b - a) / (right - left)
            if share > 0.0:
                part = 1.0 - (0.5 * (a + b) - column)
                areas[row, column] += height * share * part
                areas[row, column + 1] += height * share * (1.0 - part)


RENDERERS: dict[str, Callable[[Sequence[Outline], int], Picture]] = {
    "exact coverage": exact,
    "Cairo": by_cairo,
    "Chromium": by_browser,
    "JPEG 90": lambda outlines, size: jpeg(exact(outlines, size)),
    "2 x 2 samples": lambda outlines, size: sampled(outlines, size, 2),
    "4 x 4 samples": lambda outlines, size: sampled(outlines, size, 4),
    "linear light": in_light,
    "contrast doubled": raised,
    "sharpened, JPEG 90": lambda outlines, size: jpeg(sharpened(outlines, size)),
    "enlarged twice": lambda outlines, size: enlarged(outlines, size, Image.Resampling.BICUBIC),
    "enlarged twice, JPEG 90": lambda outlines, size: jpeg(
        enlarged(outlines, size, Image.Resampling.BICUBIC)
    ),
    "enlarged by 1.25": lambda outlines, size: enlarged(
        outlines, size, Image.Resampling.BICUBIC, by=1.25
    ),
    "copied twice": lambda outlines, size: enlarged(outlines, size, Image.Resampling.NEAREST),
    "blurred by 1": lambda outlines, size: scanned(outlines, size, blur=1.0, grain=0.5),
    "blurred by 1.5": lambda outlines, size: scanned(outlines, size, blur=1.5, grain=0.5),
    "scanned, JPEG 90": lambda outlines, size: jpeg(scanned(outlines, size, blur=1.0, grain=8.0)),
    "badly scanned": lambda outlines, size: jpeg(scanned(outlines, size, blur=1.2, grain=12.0)),
    BITS: lambda outlines, size: bits(exact(outlines, size)),
    f"scanned, {BITS}": lambda outlines, size: bits(scanned(outlines, size, blur=1.0, grain=8.0)),
    f"badly scanned, {BITS}": lambda outlines, size: bits(
        scanned(outlines, size, blur=1.2, grain=14.0)
    ),
    CUT: exact,
    f"{CUT}, JPEG 90": lambda outlines, size: jpeg(exact(outlines, size)),
    f"{CUT}, scanned, JPEG 90": lambda outlines, size: jpeg(
        scanned(outlines, size, blur=1.0, grain=8.0)
    ),
    f"{CUT}, tinted": tinted,
    "printed": printed,
    "printed, badly scanned": printed_scanned,
    "photographed": photographed,
}

# Pictures that are less and less exact.
LESS_EXACT: dict[str, Callable[[Sequence[Outline], int], Picture]] = {
    "exact coverage": exact,
    "JPEG 90": lambda drawn, size: jpeg(exact(drawn, size)),
    "blurred by 0.5": lambda drawn, size: scanned(drawn, size, 0.5, 0.0),
    "blurred by 0.7, grain of 4, JPEG 90": lambda drawn, size: jpeg(scanned(drawn, size, 0.7, 4.0)),
    "blurred by 1, grain of 8, JPEG 90": lambda drawn, size: jpeg(scanned(drawn, size, 1.0, 8.0)),
}
