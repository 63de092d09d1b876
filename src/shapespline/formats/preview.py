"""Small pictures for notebooks: outlines or curves as one SVG element of some hundred pixels."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

import numpy as np

from shapespline.formats.cubics import as_cubics, groups, is_straight, turning_points
from shapespline.values import Contour, Drawing, Fit, Shape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray

# The longer side, pixels, of which a border stays free on either end; and the steps to which
# coordinates are rounded: a tenth of a pixel, which nobody sees.
SIDE, BORDER, DECIMALS = 240.0, 8.0, 1
FILL, LINE, NODE = "#0072B2", "#0072B2", "#D55E00"


def svg_preview(value: Contour | Shape | Fit | Drawing) -> str:
    """A small self-contained SVG element: closed outlines filled, nodes of fits as dots.

    Parameters
    ----------
    value : Contour, Shape, Fit or Drawing

    Returns
    -------
    str
        240 pixels on the longer side, coordinates to a tenth of a pixel; the same for the same
        value.

    Examples
    --------
    >>> text = svg_preview(Contour([(0, 0), (2, 0), (2, 1), (0, 1)], closed=True))
    >>> text[:44]
    '<svg xmlns="http://www.w3.org/2000/svg" widt'
    >>> text.split(' d="')[1].split('"')[0]
    'M8 120L232 120L232 8L8 8Z'
    """
    if isinstance(value, Contour):
        value = Shape([value])
    if isinstance(value, Fit):
        value = Drawing([value])
    cubics = [as_cubics(fit) for fit in value] if isinstance(value, Drawing) else []
    lines = [contour.points for contour in value] if isinstance(value, Shape) else []
    corners = np.concatenate([*lines, *(turning_points(curve) for curve in cubics)])
    low, high = corners.min(axis=0), corners.max(axis=0)
    factor = (SIDE - 2 * BORDER) / (float((high - low).max()) or 1.0)
    width, height = np.round(factor * (high - low) + 2 * BORDER, DECIMALS).tolist()

    def place(points: FloatArray) -> FloatArray:
        x = factor * (points[..., 0] - low[0]) + BORDER
        y = factor * (high[1] - points[..., 1]) + BORDER
        return np.round(np.stack([x, y], axis=-1), DECIMALS) + 0.0

    paths: list[tuple[bool | None, str]] = []
    if isinstance(value, Drawing):
        for group in groups(value):
            data = "".join(_curve(place(cubics[k]), value.fits[k].closed) for k in group)
            paths.append((value.is_area(group[0]), data))
        paths.append((None, _dots([place(_nodes(fit)) for fit in value])))
    else:
        for kind in (True, False):
            data = "".join(_line(place(c.points), kind) for c in value if c.closed == kind)
            paths.append((kind, data))
    drawn = "".join(_path(filled, data) for filled, data in paths if data)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" height="{height:g}"'
        f' viewBox="0 0 {width:g} {height:g}">{drawn}</svg>'
    )


def html_preview(value: Contour | Shape | Fit | Drawing) -> str:
    """The same picture with its one-line description below, as an HTML element.

    Examples
    --------
    >>> html_preview(Contour([(0, 0), (3, 4)])).split("<br/>")[1]
    '<code>Contour(open, 2 points, length 5)</code></div>'
    """
    return f"<div>{svg_preview(value)}<br/><code>{escape(repr(value))}</code></div>"


def _path(filled: bool | None, data: str) -> str:
    """One path: filled by the even-odd rule, a line, or (None) dots."""
    if filled is None:
        style = f'fill="none" stroke="{NODE}" stroke-width="4" stroke-linecap="round"'
    else:
        fill = f'"{FILL}" fill-opacity="0.15" fill-rule="evenodd"' if filled else '"none"'
        style = f'fill={fill} stroke="{LINE}" stroke-width="1.5" stroke-linejoin="round"'
    return f'<path {style} d="{data}"/>'


def _nodes(fit: Fit) -> FloatArray:
    """Where the pieces of a fit meet or end."""
    return np.array([[p.control_points[0], p.control_points[-1]] for p in fit.pieces])[:, 0]


def _dots(nodes: Sequence[FloatArray]) -> str:
    """Lines without length, each of which a round cap makes a dot."""
    distinct = dict.fromkeys(_pair(point) for points in nodes for point in points)
    return "".join(f"M{pair}h0" for pair in distinct)


def _line(points: FloatArray, closed: bool) -> str:
    """A polyline, without points that fall on the one before."""
    new = np.concatenate([[True], (points[1:] != points[:-1]).any(axis=1)])
    return "M" + "L".join(map(_pair, points[new])) + ("Z" if closed else "")


def _curve(cubics: FloatArray, closed: bool) -> str:
    """A chain of cubics, straight ones as lines."""
    commands = [f"M{_pair(cubics[0, 0])}"]
    for cubic in cubics:
        straight = is_straight(cubic)
        commands.append(
            f"L{_pair(cubic[3])}" if straight else "C" + " ".join(map(_pair, cubic[1:]))
        )
    return "".join(commands) + ("Z" if closed else "")


def _pair(point: FloatArray) -> str:
    return f"{point[0]:g} {point[1]:g}"
