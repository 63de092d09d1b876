"""Python: a file that makes the curves as scipy BSplines, (t, c, k), to the last bit.

Where there are lines and arcs, it holds them, too, as a list of pieces for each curve.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import Drawing, Fit, Piece

HEAD = '''"""Curves as B-splines: curves[i](u) are points, u from 0 to 1.

{says}
"""

import numpy as np
from scipy.interpolate import BSpline

curves = []
'''
PIECES = """
# Each curve end to end: ("line", begin, end), ("arc", centre, radius, start angle, sweep) in
# radians, anticlockwise if positive, or ("spline", t, c, k).
pieces = []
"""
BESIDE = 4  # numbers of a line


def encode(drawing: Drawing) -> bytes:
    """Source text that imports numpy and scipy and defines ``curves``, a list of BSpline.

    If a curve has arcs also ``pieces``, for each curve a list of lines, arcs and splines.

    Numbers are written with the shortest digits that read back to the same double.
    """
    count = len(drawing)
    says = f"{count} curve{'s' * (count > 1)}"
    if drawing.unit is not None:
        says += f", in {drawing.unit}"
    if count > 1:
        says += f"; the one around each, -1 for none: {list(drawing.parents)}"
    text = HEAD.format(says=f"{says}.") + "".join(_curve(fit) for fit in drawing)
    if any(piece.arc for fit in drawing for piece in fit.sections):
        text += PIECES + "".join(_pieces(fit) for fit in drawing)
    return text.encode("utf-8")


def _curve(fit: Fit) -> str:
    spline = fit.spline
    mode = '"periodic"' if spline.periodic else "True"
    return (
        f"\nt = np.array([\n{_rows(spline.knots)}])\n"
        f"c = np.array([\n{_rows(spline.coefficients.ravel())}]).reshape(-1, 2)\n"
        f"curves.append(BSpline(t, c, {spline.degree}, extrapolate={mode}))\n"
    )


def _pieces(fit: Fit) -> str:
    return (
        "pieces.append([\n" + "".join(f"    {_piece(piece)!r},\n" for piece in fit.pieces) + "])\n"
    )


def _piece(piece: Piece) -> tuple[object, ...]:
    if piece.arc is not None:
        arc = piece.arc
        return ("arc", arc.centre, arc.radius, arc.start_angle, arc.sweep)
    points = [tuple(point) for point in piece.control_points.tolist()]
    if piece.kind == "line":
        return ("line", *points)
    return ("spline", piece.knots.tolist(), points, piece.degree)


def _rows(values: FloatArray) -> str:
    numbers = [repr(value) for value in values.tolist()]
    rows = [numbers[k : k + BESIDE] for k in range(0, len(numbers), BESIDE)]
    return "".join(f"    {', '.join(row)},\n" for row in rows)
