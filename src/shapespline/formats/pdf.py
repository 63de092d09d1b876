"""PDF: exact cubic Beziers, filled or stroked, on a page of the drawing's size."""

from __future__ import annotations

import zlib
from typing import TYPE_CHECKING

import numpy as np

from shapespline.formats.cubics import (
    as_cubics,
    broadest,
    is_straight,
    is_tiled,
    is_whole,
    painted,
    turning_points,
)
from shapespline.units import MILLIMETRES
from shapespline.values import BLACK

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import Drawing

# Of the longer side: the border, and the width of a stroke.
MARGIN, STROKE = 0.02, 0.0025
# A drawing without a unit has a longer side of so many points, that of a sheet of A4.
LONGER_SIDE = 842.0
# Coordinates in points with so many decimals: a ten-thousandth of what a printer resolves.
DECIMALS = 6
# What PDF calls the ends and turns of strokes.
CAP_NUMBERS = {"butt": 0, "round": 1, "square": 2}
JOIN_NUMBERS = {"miter": 0, "round": 1, "bevel": 2}


def encode(drawing: Drawing, *, fill: bool = True) -> bytes:
    """Bytes of a PDF of one page.

    Parameters
    ----------
    drawing : Drawing
        In its unit (pixels at 96 per inch); without one the longer side is that of A4.
    fill : bool
        Fill closed curves, black ones by the even-odd rule; otherwise they are stroked like open
        ones. Strokes of their own are drawn with them.

    Returns
    -------
    bytes
        The same for the same drawing: no time, no random identity.
    """
    cubics = [as_cubics(fit) for fit in drawing]
    extremes = np.concatenate([turning_points(curves) for curves in cubics])
    low, high = extremes.min(axis=0), extremes.max(axis=0)
    longer = float((high - low).max()) or 1.0
    margin = MARGIN * longer + broadest(drawing)
    scale = _points_a_unit(drawing.unit) or LONGER_SIDE / (longer + 2 * margin)
    corner = low - margin
    width, height = scale * (high - low + 2 * margin)
    lines = [f"{_number(STROKE * scale * longer)} w 1 j 1 J"]
    paths, together = [], painted(drawing)
    for group in together:
        data = "\n".join(
            _path(scale * (cubics[index] - corner), drawing.fits[index].closed) for index in group
        )
        paths.append((data, *_paint(drawing, group, scale, fill=fill)))
    if fill and is_tiled(drawing):
        # Beneath the areas their outlines: viewers smooth each area by itself, and what lies
        # beneath shows on the border of two. Nothing of them shows beside the picture.
        box = " ".join(map(_number, [*(scale * (low - corner)), *(scale * (high - low))]))
        lines += ["q", f"{box} re W n"]
        colors = [_color(drawing.colors[group[0]] or BLACK) for group in together]
        lines += [f"{c} RG\n{data}\nS" for c, (data, *_) in zip(colors, paths, strict=True)]
        lines.append("Q")
    for data, pen, operator in paths:
        lines += [*(["q", pen] if pen else []), data, operator, *(["Q"] if pen else [])]
    content = zlib.compress("\n".join(lines).encode("ascii"), 9)
    box = f"[0 0 {_number(width)} {_number(height)}]"
    return _file(
        [
            b"<< /Type /Catalog /Pages 2 0 R >>",
            b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
            f"<< /Type /Page /Parent 2 0 R /MediaBox {box} /Contents 4 0 R"
            " /Resources << >> >>".encode("ascii"),
            f"<< /Length {len(content)} /Filter /FlateDecode >>\nstream\n".encode("ascii")
            + content
            + b"\nendstream",
        ]
    )


def _paint(drawing: Drawing, group: list[int], scale: float, *, fill: bool) -> tuple[str, str]:
    """How a path is to be drawn: what is set before it, and the operator after it."""
    index = group[0]
    color, width, stroke = drawing.colors[index], drawing.widths[index], drawing.strokes[index]
    filled = fill and drawing.is_filled(index)
    pen = [f"{_color(color)} rg"] if filled and color else []
    if width is not None:
        pen.append(f"{_number(scale * width)} w")
    if stroke is not None:
        cap, join = CAP_NUMBERS[stroke.cap], JOIN_NUMBERS[stroke.join]
        pen.append(f"{_color(stroke.color)} RG {cap} J {join} j 4 M")
    if not filled:
        return "\n".join(pen), "S"
    operator = "f" if width is None else "B"
    return "\n".join(pen), operator if is_whole(drawing, group) else f"{operator}*"


def _color(color: str) -> str:
    return " ".join(_number(int(color[k : k + 2], 16) / 255) for k in (1, 3, 5))


def _points_a_unit(unit: str | None) -> float | None:
    if unit == "px":
        return 72 / 96
    return MILLIMETRES[unit] / MILLIMETRES["pt"] if unit is not None else None


def _path(cubics: FloatArray, closed: bool) -> str:
    """Operators of one curve: m, then c or l for each piece, and h if closed."""
    commands = [f"{_pair(cubics[0, 0])} m"]
    for cubic in cubics:
        if is_straight(cubic):
            commands.append(f"{_pair(cubic[3])} l")
        else:
            commands.append(" ".join(map(_pair, cubic[1:])) + " c")
    return "\n".join([*commands, "h"] if closed else commands)


def _pair(point: FloatArray) -> str:
    return f"{_number(point[0])} {_number(point[1])}"


def _number(value: float) -> str:
    """PDF knows no exponents."""
    return f"{value + 0.0:.{DECIMALS}f}".rstrip("0").rstrip(".")


def _file(objects: list[bytes]) -> bytes:
    """Objects, the table of where they begin, and the trailer."""
    out = bytearray(b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n")
    starts = []
    for number, content in enumerate(objects, start=1):
        starts.append(len(out))
        out += b"%d 0 obj\n%b\nendobj\n" % (number, content)
    table = len(out)
    out += b"xref\n0 %d\n0000000000 65535 f \n" % (len(objects) + 1)
    for start in starts:
        out += b"%010d 00000 n \n" % start
    out += b"trailer\n<< /Size %d /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (
        len(objects) + 1,
        table,
    )
    return bytes(out)
