"""SVG: arcs and cubic Beziers, exact up to degree 3, filled and stroked in their colours."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats.cubics import (
    as_cubics,
    broadest,
    cubics_and_arcs,
    is_straight,
    is_tiled,
    is_whole,
    painted,
    turning_points,
)
from shapespline.formats.svg_tree import UNDERLAY
from shapespline.units import MILLIMETRES, PIXEL
from shapespline.validation import is_number
from shapespline.values import Piece, Stroke, ViewBox

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.typing import FloatArray
    from shapespline.values import Arc, Drawing, Fit

# Units that CSS knows; the page of a drawing in another one is sized in millimetres.
PAGE_UNITS = (PIXEL, "mm", "cm", "in", "pt", "pc", "Q")
# Of the longer side: the border around a drawing without a frame, and the width of a stroke.
MARGIN, STROKE = 0.02, 0.0025
# The colour of what has none of its own.
INK = "black"
# View boxes that begin so many times their size from the origin are far: there coordinates in
# single precision are off by a fortieth of a pixel of a screen of 4000 (FMT-14).
FAR = 100.0
LINKS = ' xmlns:xlink="http://www.w3.org/1999/xlink"'


class Placement(NamedTuple):
    """The view box, y down, and where its points stand in the file.

    Attributes
    ----------
    view_box : ViewBox
    origin : tuple of float
        What coordinates count from: the origin of the data, or the corner of a view box that is
        far from it.
    """

    view_box: ViewBox
    origin: tuple[float, float]

    def __call__(self, points: FloatArray) -> FloatArray:
        """Points of the data as points of the file, shape (..., 2): mirrored in the view box."""
        x, y = self.origin
        top = 2 * self.view_box.y + self.view_box.height
        return np.stack([points[..., 0] - x, top - points[..., 1] - y], axis=-1)


def encode(
    drawing: Drawing,
    *,
    fill: bool = True,
    stroke_width: float | None = None,
    band: float | None = None,
) -> bytes:
    """Text of an SVG file with one path for each outline and its holes.

    Closed curves are filled, black and by the even-odd rule if they have no colour of their own;
    open ones are stroked and unfilled, strokes of known width by a pen of this width. y is
    turned over once, within the view box: the frame, or without one the bounding box of the curves
    with a small margin. Coordinates are those of the data, so that they read back the same; of a
    view box far from the origin (maps) they count from its corner, in a group that is moved there,
    so that they survive programs that draw in single precision.
    Coordinates are written with the shortest digits that read back to the same double.

    Parameters
    ----------
    drawing : Drawing
        Its unit sizes the page; without one viewers fit the page into their window.
    fill : bool
        Fill closed curves; otherwise they are stroked like open ones.
    stroke_width : float, optional
        Width of all strokes, data units. If not given it is that of the drawing's ``widths``, else
        1/400 of the longer side of the view box.
    band : float, optional
        Draw the pointwise band of this level, such as 0.95, around every fit to points with errors.

    Returns
    -------
    bytes
        UTF-8; the same for the same drawing.

    Raises
    ------
    InvalidInputError
        If an option is out of range.
    FormatError
        If the frame has no area, or the nesting names a fit that does not exist or runs in a
        circle.

    Notes
    -----
    Exact, but for one rounding of each coordinate, up to degree 3; arcs are A commands of a quarter
    of a circle at most. Above, within 1e-6 of the
    diagonal of the contour's bounding box (a rigorous bound, up to rounding) and
    tangent-continuous, but no longer of continuous curvature.

    Examples
    --------
    >>> from shapespline.values import Contour
    >>> from shapespline.values import BSplineCurve
    >>> from shapespline.values import Drawing, Fit, Status
    >>> from shapespline.values import clamped_knots
    >>> curve = BSplineCurve(clamped_knots(4, 3), [(0, 0), (0, 4), (8, 4), (8, 0)], degree=3)
    >>> fit = Fit(
    ...     spline=curve, contour=Contour([(0, 0), (8, 0)]), parameters=np.array([0.0, 1.0]),
    ...     max_distance=0.0, rms_distance=0.0, hausdorff_distance=3.0, tolerance=3.0,
    ...     status=Status.KEPT, history=(), method="by hand",
    ... )
    >>> text = encode(Drawing([fit], frame=ViewBox(0, 0, 8, 6))).decode()
    >>> print(text.split(' d="')[1].split('"')[0])
    M0 6C0 2 8 2 8 6
    """
    if stroke_width is not None and not (is_number(stroke_width) and 0 < stroke_width < math.inf):
        raise InvalidInputError(f"stroke_width must be a positive number, got {stroke_width!r}")
    paths = painted(drawing)
    pieces = [as_cubics(fit) for fit in drawing]
    placement = _placement(drawing.frame, pieces, stroke_width or broadest(drawing))
    box = placement.view_box
    width = stroke_width or _rounded(STROKE * max(box.width, box.height))
    tiled = fill and is_tiled(drawing)
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<svg xmlns="http://www.w3.org/2000/svg"'
        f"{LINKS if tiled else ''}{_page(box, drawing.unit)}"
        f' viewBox="{" ".join(map(_number, box))}">',
    ]
    moved = placement.origin != (0.0, 0.0)
    if moved:
        lines.append(f'<g transform="translate({_pair(placement.origin)})">')
    if tiled:
        lines += _underlay(width)
    for group in paths:
        first = group[0]
        own = None if stroke_width else drawing.widths[first]
        color = drawing.colors[first] or INK
        if fill and drawing.is_filled(first):
            rule = "" if is_whole(drawing, group) else ' fill-rule="evenodd"'
            style = f'fill="{color}"{rule}'
            if drawing.widths[first] is not None:
                style += f" {_stroked(width, own, drawing.strokes[first])}"
            elif tiled:
                style += f' stroke="{color}"'
        else:
            style = f'fill="none" {_stroked(width, own, drawing.strokes[first])}'
        data = "".join(_path_data(drawing.fits[index], placement) for index in group)
        lines.append(f'<path {style} d="{data}"/>')
    if tiled:
        lines += ["</g>", "</g>"]
    if band is not None:
        lines += [_band_path(fit, band, placement) for fit in drawing if fit.uncertainty]
    if moved:
        lines.append("</g>")
    lines.append("</svg>\n")
    return "\n".join(lines).encode("utf-8")


def _stroked(width: float, own: float | None, stroke: Stroke | None) -> str:
    """Attributes of a stroke: thin and round at its turns, or as it was drawn."""
    look = stroke or Stroke(INK, "round" if own else "butt")
    # What SVG takes without being told is left out.
    cap = "" if look.cap == "butt" else f' stroke-linecap="{look.cap}"'
    join = "" if look.join == "miter" else f' stroke-linejoin="{look.join}"'
    return f'stroke="{look.color}" stroke-width="{_number(own or width)}"{cap}{join}'


def _underlay(width: float) -> list[str]:
    """Areas first drawn with outlines of their own colours, then once more without.

    Viewers smooth each area by itself: on the border of two that cover a pixel by half each a
    quarter of what lies beneath shows. The outlines lie beneath, and show in no other place.
    """
    return [
        f'<use class="{UNDERLAY}" xlink:href="#areas" stroke-width="{_number(width)}"'
        ' stroke-linejoin="round"/>',
        '<g stroke-width="0">',
        '<g id="areas">',
    ]


def _band_path(fit: Fit, level: float, placement: Placement) -> str:
    """The strip between both edges of a band, red and half transparent."""
    band = fit.band(level)
    edges = [placement(band.left), placement(band.right)[::-1]]
    if fit.closed:  # two rings
        data = "".join(f"M{'L'.join(map(_pair, edge))}Z" for edge in edges)
    else:
        data = f"M{'L'.join(map(_pair, np.concatenate(edges)))}Z"
    return f'<path fill="#c0392b" fill-opacity="0.4" fill-rule="evenodd" d="{data}"/>'


# Placement


def _placement(frame: ViewBox | None, pieces: list[FloatArray], stroke_width: float) -> Placement:
    """The frame, or the bounding box of the curves, as a view box."""
    if frame is None:
        extreme = np.concatenate([turning_points(cubics) for cubics in pieces])
        low, high = extreme.min(axis=0), extreme.max(axis=0)
        longer = float((high - low).max()) or 1.0
        margin = _rounded(MARGIN * longer) + stroke_width
        frame = ViewBox(*(low - margin).tolist(), *(high - low + 2 * margin).tolist())
    elif not (frame.width > 0 and frame.height > 0 and np.isfinite(frame).all()):
        raise FormatError(f"the frame must be finite and have an area, got {tuple(frame)}")
    far = max(abs(frame.x), abs(frame.y)) > FAR * max(frame.width, frame.height)
    return Placement(frame, (frame.x, frame.y) if far else (0.0, 0.0))


# Text


def _path_data(fit: Fit, placement: Placement) -> str:
    """Commands of one curve: M, then C, L or A for each piece, and Z if closed."""
    parts = cubics_and_arcs(fit)
    first = parts[0].control_points[0] if isinstance(parts[0], Piece) else parts[0][0, 0]
    commands = [f"M{_pair(placement(first))}"]
    for part in parts:
        if isinstance(part, Piece):
            commands += _arc_commands(part, placement)
            continue
        for cubic in placement(part):
            if is_straight(cubic):
                commands.append(f"L{_pair(cubic[3])}")
            else:
                commands.append("C" + " ".join(map(_pair, cubic[1:])))
    if fit.closed and commands[-1].startswith("L"):  # Z draws the line
        del commands[-1]
    return "".join(commands) + ("Z" if fit.closed else "")


def _arc_commands(piece: Piece, placement: Placement) -> Iterator[str]:
    """A for each quarter at most: the ends of half a turn tell half the digits of its centre."""
    arc = cast("Arc", piece.arc)
    count = max(1, math.ceil(abs(arc.sweep) / (0.5 * math.pi) - 1e-9))
    ends = placement(arc.at(np.arange(1, count + 1) / count))
    ends[-1] = placement(piece.control_points[-1])
    radius = _number(arc.radius)
    for end in ends:
        # y runs down: what turned left turns right.
        yield f"A{radius} {radius} 0 0 {int(arc.sweep < 0)} {_pair(end)}"


def _pair(point: FloatArray | tuple[float, float]) -> str:
    return f"{_number(point[0])} {_number(point[1])}"


def _number(value: float) -> str:
    """Shortest decimal that reads back to the same double."""
    text = repr(float(value) + 0.0)  # no negative zero
    return text.removesuffix(".0")


def _page(box: ViewBox, unit: str | None) -> str:
    """The size of the page, in a unit that CSS knows; no size where no unit tells one."""
    if unit is None:
        return ""
    factor = 1.0
    if unit not in PAGE_UNITS:
        factor, unit = MILLIMETRES[unit], "mm"
    width, height = _number(factor * box.width), _number(factor * box.height)
    return f' width="{width}{unit}" height="{height}{unit}"'


def _rounded(value: float) -> float:
    """Round a length to two significant digits: nobody reads more of a margin."""
    return float(f"{value:.1e}")
