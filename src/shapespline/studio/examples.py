"""Examples: shapes that are drawn here, so that the first screen is never empty."""

from __future__ import annotations

import io
from functools import cache
from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from PIL import Image, ImageDraw

from shapespline.errors import InvalidInputError

SIDE = 480
# Drawn larger by this factor and made smaller again: an edge then covers parts of pixels.
FINER = 4
N_TEETH = 12


class Example(NamedTuple):
    """A file that a user could have: its name, what it is, and a tolerance that suits it."""

    file: str
    title: str
    tolerance: float


EXAMPLES = {
    "gear": Example("gear.png", "Gear, a picture", 0.5),
    "wing": Example("wing.csv", "Wing section, exact points", 0.0005),
    "scan": Example("scan.csv", "Noisy scan of a leaf", 0.6),
    "plate": Example("plate.svg", "Plate, a drawing in millimetres", 0.05),
    "loop": Example("loop.csv", "Open loop", 0.02),
}


def example_bytes(name: str) -> bytes:
    r"""The content of an example's file.

    Examples
    --------
    >>> example_bytes("gear")[:4], example_bytes("plate")[:4]
    (b'\x89PNG', b'<svg')
    """
    return _made(name)


@cache
def _made(name: str) -> bytes:
    makers = {"gear": _gear, "wing": _wing, "scan": _scan, "plate": _plate, "loop": _loop}
    if name not in makers:
        raise InvalidInputError(f"example must be one of {', '.join(makers)}, got {name!r}")
    return makers[name]()


def _gear() -> bytes:
    """A gear with round flanks and a bore, dark on light, edges covering parts of pixels."""
    middle, picture = 0.5 * SIDE * FINER, Image.new("L", (SIDE * FINER, SIDE * FINER), 250)
    draw = ImageDraw.Draw(picture)
    outer, root, bore = 0.93 * middle, 0.74 * middle, 0.26 * middle

    def at(radius: float, angle: float) -> tuple[float, float]:
        return middle + radius * cos(angle), middle + radius * sin(angle)

    def disc(radius: float, ink: int) -> None:
        draw.ellipse([middle - radius, middle - radius, middle + radius, middle + radius], fill=ink)

    disc(root, 30)
    step = 2 * pi / N_TEETH
    for k in range(N_TEETH):
        turn = k * step
        # A flank bends inwards like an involute; the head is a part of the outer circle.
        right = [(root * 0.97, 0.30), (root * 1.06, 0.265), (outer * 0.92, 0.22), (outer, 0.15)]
        head = [(outer, 0.15 - 0.30 * j / 12) for j in range(1, 12)]
        left = [(radius, -part) for radius, part in reversed(right)]
        corners = [at(radius, turn + part * step) for radius, part in (*right, *head, *left)]
        draw.polygon(corners, fill=30)
    disc(bore, 250)
    for k in range(6):
        x, y = at(0.5 * middle, k * pi / 3 + pi / 6)
        hole = 0.11 * middle
        draw.ellipse([x - hole, y - hole, x + hole, y + hole], fill=250)
    small = picture.resize((SIDE, SIDE), Image.Resampling.BOX)
    content = io.BytesIO()
    small.save(content, format="PNG", optimize=True)
    return content.getvalue()


def _table(points: np.ndarray, digits: int) -> bytes:
    return "".join(f"{x:.{digits}f},{y:.{digits}f}\n" for x, y in points.tolist()).encode()


def _wing() -> bytes:
    """NACA 2412 with a closed trailing edge, chord 1 (Abbott and von Doenhoff 1959, section 6.4).

    Stations are those of a cosine, as airfoil tables have them.
    """
    camber, place, thick = 0.02, 0.4, 0.12
    x = 0.5 - 0.5 * np.cos(np.linspace(0, pi, 101))
    half = (
        5
        * thick
        * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    )
    ahead = x < place
    below = np.where(ahead, place, 1 - place) ** 2
    mean = (
        camber / below * np.where(ahead, 2 * place * x - x**2, 1 - 2 * place + 2 * place * x - x**2)
    )
    lean = np.arctan(2 * camber / below * (place - x))
    upper = np.column_stack([x - half * np.sin(lean), mean + half * np.cos(lean)])
    lower = np.column_stack([x + half * np.sin(lean), mean - half * np.cos(lean)])
    return _table(np.vstack([upper[::-1], lower[1:-1]]), 6)


def _scan() -> bytes:
    """A lobed leaf of some 90 units with noise of 0.15, as a scanner sees it."""
    t = np.linspace(0, 2 * pi, 900, endpoint=False)
    radius = 30 + 9 * np.cos(5 * t) - 4 * np.cos(10 * t + 0.5) + 6 * np.sin(t)
    points = np.column_stack([1.15 * radius * np.cos(t), radius * np.sin(t)])
    return _table(points + np.random.default_rng(7).normal(scale=0.15, size=points.shape), 3)


def _plate() -> bytes:
    """A bracket with rounded corners, a slot, two bores and a keyhole, in millimetres."""

    def circle(x: float, y: float, r: float) -> str:
        return f"M{x - r} {y}a{r} {r} 0 1 0 {2 * r} 0a{r} {r} 0 1 0 {-2 * r} 0z"

    paths = [
        "M10 4H108a6 6 0 0 1 6 6V44a6 6 0 0 1 -6 6H82C72 50 70 74 52 74H10a6 6 0 0 1 -6 -6V10"
        "a6 6 0 0 1 6 -6z",
        "M70 18h22a5 5 0 0 1 0 10h-22a5 5 0 0 1 0 -10z",
        circle(18, 18, 6),
        circle(18, 60, 6),
        "M40 46a9 9 0 1 1 8 0v10h-8z",
    ]
    drawn = "".join(f'<path d="{path}"/>' for path in paths)
    drawn = f'<g fill="none" stroke="black" stroke-width="0.2">{drawn}</g>'
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" width="118mm" height="78mm"'
        f' viewBox="0 0 118 78">{drawn}</svg>'
    ).encode()


def _loop() -> bytes:
    """An open curve that crosses itself."""
    t = np.linspace(-2.1, 2.1, 260)
    return _table(np.column_stack([t**3 - 2.6 * t, 1.2 * t**2 - 0.25 * t**4 + 0.3 * t]), 5)
