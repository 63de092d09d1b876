"""SVG: cubic Beziers, exact up to degree 3, filled as a silhouette.

Knot insertion cuts a B-spline into Beziers without changing it. Those of degree 1 to 3 are cubics
(or lines), so the file holds the fitted curve to the last bit but one. Cubics cannot hold degrees
4 to 9: such a piece is replaced by cubics with the same ends and end tangents, halved until they
are provably within ``CUBIC_TOLERANCE`` times the diagonal of the contour's bounding box.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.arrays import is_number
from shapespline.contour import Frame
from shapespline.errors import FormatError, InvalidInputError
from shapespline.units import MILLIMETRES, PIXEL

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.drawing import Drawing, Fit
    from shapespline.typing import FloatArray

# Units that CSS knows; the page of a drawing in another one is sized in millimetres.
PAGE_UNITS = (PIXEL, "mm", "cm", "in", "pt", "pc", "Q")
# Of the box diagonal: what a cubic may deviate from a piece of degree 4 or more.
CUBIC_TOLERANCE = 1e-6
# Of the longer side: the border around a drawing without a frame, and the width of a stroke.
MARGIN, STROKE = 0.02, 0.0025
EPS = float(np.finfo(np.float64).eps)


class Placement(NamedTuple):
    """Where data go: x to ``x - x_shift``, y to ``y_top - y``; and the view box, y down."""

    x_shift: float
    y_top: float
    view_box: Frame

    def __call__(self, points: FloatArray) -> FloatArray:
        """Points of the data as points of the file, shape (..., 2)."""
        return np.stack([points[..., 0] - self.x_shift, self.y_top - points[..., 1]], axis=-1)


def encode(
    drawing: Drawing,
    *,
    fill: bool = True,
    stroke_width: float | None = None,
) -> bytes:
    """Text of an SVG file with one path for each outline and its holes.

    Closed curves are filled black by the even-odd rule; open ones are stroked and unfilled. y is
    turned over once. With a frame the view box is the frame and coordinates stay within it; without
    one the view box begins at (0, 0) and is the bounding box of the curves with a small margin, so
    that coordinates far from the origin (maps) survive programs that draw in single precision.
    Coordinates are written with the shortest digits that read back to the same double.

    Parameters
    ----------
    drawing : Drawing
        Its unit sizes the page; without one its numbers are pixels.
    fill : bool
        Fill closed curves; otherwise they are stroked like open ones.
    stroke_width : float, optional
        Width of strokes, data units; 1/400 of the longer side of the view box if not given.

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
    Exact, but for one rounding of each coordinate, up to degree 3. Above, within 1e-6 of the
    diagonal of the contour's bounding box (a rigorous bound, up to rounding) and
    tangent-continuous, but no longer of continuous curvature.

    Examples
    --------
    >>> from shapespline.contour import Contour
    >>> from shapespline.curve import BSplineCurve
    >>> from shapespline.drawing import Drawing, Fit, Status
    >>> from shapespline.knots import clamped_knots
    >>> curve = BSplineCurve(clamped_knots(4, 3), [(0, 0), (0, 4), (8, 4), (8, 0)], degree=3)
    >>> fit = Fit(
    ...     spline=curve, contour=Contour([(0, 0), (8, 0)]), parameters=np.array([0.0, 1.0]),
    ...     max_distance=0.0, rms_distance=0.0, hausdorff_distance=3.0, tolerance=3.0,
    ...     status=Status.KEPT, history=(), method="by hand",
    ... )
    >>> text = encode(Drawing([fit], frame=Frame(0, 0, 8, 6))).decode()
    >>> print(text.split(' d="')[1].split('"')[0])
    M0 6C0 2 8 2 8 6
    """
    if stroke_width is not None and not (is_number(stroke_width) and 0 < stroke_width < math.inf):
        raise InvalidInputError(f"stroke_width must be a positive number, got {stroke_width!r}")
    groups = _groups(drawing)
    pieces = [_as_cubics(fit) for fit in drawing]
    placement = _placement(drawing.frame, pieces, stroke_width or 0.0)
    box = placement.view_box
    width = stroke_width or _rounded(STROKE * max(box.width, box.height))
    stroked = f'fill="none" stroke="black" stroke-width="{_number(width)}" stroke-linejoin="round"'
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<svg xmlns="http://www.w3.org/2000/svg"'
        f' width="{_page_length(box.width, drawing.unit)}"'
        f' height="{_page_length(box.height, drawing.unit)}"'
        f' viewBox="{" ".join(map(_number, box))}">',
    ]
    for group in groups:
        filled = fill and drawing.fits[group[0]].closed
        style = 'fill="black" fill-rule="evenodd"' if filled else stroked
        data = "".join(
            _path_data(placement(pieces[index]), drawing.fits[index].closed) for index in group
        )
        lines.append(f'<path {style} d="{data}"/>')
    lines.append("</svg>\n")
    return "\n".join(lines).encode("utf-8")


# Nesting


def _groups(drawing: Drawing) -> list[list[int]]:
    """Return the fits of each path: an outline and its holes, or an open curve alone."""
    groups: dict[int, list[int]] = {}
    holes: list[tuple[int, int]] = []
    for index, fit in enumerate(drawing):
        parent = drawing.parents[index]
        if drawing.is_hole(index) and fit.closed and drawing.fits[parent].closed:
            holes.append((parent, index))
        else:
            groups[index] = [index]
    for parent, index in holes:
        groups[parent].append(index)
    return list(groups.values())


# Cubics


def _as_cubics(fit: Fit) -> FloatArray:
    """Cubic Beziers of a fit end to end, data coordinates, shape (s, 4, 2)."""
    points = fit.spline.beziers().points
    if fit.degree <= 3:
        cubics = points
        while cubics.shape[1] < 4:
            cubics = elevated(cubics)
    else:
        # Below the rounding of the coordinates no halving could reach the tolerance.
        rounding = 64 * EPS * float(np.abs(points).max())
        tolerance = max(CUBIC_TOLERANCE * fit.contour.box_diagonal, rounding)
        cubics = np.array([cubic for piece in points for cubic in _cubics(piece, tolerance)])
    if fit.closed:
        cubics[-1, -1] = cubics[0, 0]  # knot insertion may miss it by a rounding
    return cubics


def elevated(points: FloatArray) -> FloatArray:
    """Raise the degree of Beziers by one, exactly: shape (s, degree + 2, 2).

    Q_i = i/(p+1) P_{i-1} + (1 - i/(p+1)) P_i, without a rounding where P_{i-1} = P_i.
    """
    share = (np.arange(1, points.shape[1]) / points.shape[1])[:, None]
    inner = points[:, 1:] + share * (points[:, :-1] - points[:, 1:])
    return np.concatenate([points[:, :1], inner, points[:, -1:]], axis=1)


def _cubics(piece: FloatArray, tolerance: float) -> Iterator[FloatArray]:
    """Cubics with the end points and end derivatives of a Bezier or of its halves.

    Two Beziers of one degree differ nowhere by more than their control points do, since the
    Bernstein polynomials are positive and sum to one: so the elevated cubic bounds the error.
    """
    degree = len(piece) - 1
    cubic = np.array(
        [
            piece[0],
            piece[0] + degree / 3 * (piece[1] - piece[0]),
            piece[-1] + degree / 3 * (piece[-2] - piece[-1]),
            piece[-1],
        ]
    )
    same_degree = cubic[None]
    while same_degree.shape[1] <= degree:
        same_degree = elevated(same_degree)
    if np.hypot(*(same_degree[0] - piece).T).max() <= tolerance:
        yield cubic
    else:
        for half in _halves(piece):
            yield from _cubics(half, tolerance)


def _halves(piece: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Cut a Bezier into its two halves (de Casteljau)."""
    first, last = [piece[0]], [piece[-1]]
    while len(piece) > 1:
        piece = 0.5 * (piece[:-1] + piece[1:])
        first.append(piece[0])
        last.append(piece[-1])
    return np.array(first), np.array(last[::-1])


def _is_straight(cubic: FloatArray) -> bool:
    """Whether a cubic runs straight from end to end, to the rounding of its coordinates."""
    chord = cubic[3] - cubic[0]
    length = float(np.hypot(*chord))
    if length == 0.0:
        return bool((cubic == cubic[0]).all())
    inner = cubic[1:3] - cubic[0]
    offset = np.abs(inner[:, 0] * chord[1] - inner[:, 1] * chord[0]).max() / length
    along = inner @ chord / length**2
    # The cross product cancels: its rounding is that of the coordinates, not of the result.
    return bool(
        offset <= 4 * EPS * np.abs(cubic).max() and along.min() >= 0.0 and along.max() <= 1.0
    )


# Placement


def _placement(frame: Frame | None, pieces: list[FloatArray], stroke_width: float) -> Placement:
    """Mirror within the frame, or move the bounding box of the curves to the origin."""
    if frame is not None:
        if not (frame.width > 0 and frame.height > 0 and np.isfinite(frame).all()):
            raise FormatError(f"the frame must be finite and have an area, got {tuple(frame)}")
        return Placement(0.0, 2 * frame.y + frame.height, frame)
    extremes = np.concatenate([_extremes(cubics) for cubics in pieces])
    low, high = extremes.min(axis=0), extremes.max(axis=0)
    longer = float((high - low).max()) or 1.0
    margin = _rounded(MARGIN * longer) + stroke_width
    width, height = (high - low + 2 * margin).tolist()
    return Placement(
        float(low[0]) - margin, float(high[1]) + margin, Frame(0.0, 0.0, width, height)
    )


def _extremes(cubics: FloatArray) -> FloatArray:
    """End points and points where x or y turns, of cubics, shape (k, 2)."""
    first, second, third = (3 * np.diff(cubics, axis=1)).transpose(1, 0, 2)
    # Derivative a t^2 + b t + c; its roots without cancellation, q as in Numerical Recipes 5.6.
    a, b, c = first - 2 * second + third, 2 * (second - first), first
    with np.errstate(divide="ignore", invalid="ignore"):
        q = -0.5 * (b + np.copysign(np.sqrt(b * b - 4 * a * c), b))
        roots = np.stack([q / a, c / q])
    roots = np.where((roots > 0) & (roots < 1), roots, 0.0)[..., None]
    rest = 1 - roots
    p0, p1, p2, p3 = (cubics[None, :, None, i] for i in range(4))
    turns = rest**3 * p0 + 3 * rest**2 * roots * p1 + 3 * rest * roots**2 * p2 + roots**3 * p3
    return np.concatenate([cubics[:, 0], cubics[:, 3], turns.reshape(-1, 2)])


# Text


def _path_data(cubics: FloatArray, closed: bool) -> str:
    """Commands of one curve: M, then C or L for each piece, and Z if closed."""
    commands = [f"M{_pair(cubics[0, 0])}"]
    for index, cubic in enumerate(cubics):
        if not _is_straight(cubic):
            commands.append("C" + " ".join(map(_pair, cubic[1:])))
        elif not closed or index < len(cubics) - 1:  # else Z draws the line
            commands.append(f"L{_pair(cubic[3])}")
    return "".join(commands) + ("Z" if closed else "")


def _pair(point: FloatArray) -> str:
    return f"{_number(point[0])} {_number(point[1])}"


def _number(value: float) -> str:
    """Shortest decimal that reads back to the same double."""
    text = repr(float(value) + 0.0)  # no negative zero
    return text.removesuffix(".0")


def _page_length(length: float, unit: str | None) -> str:
    """A side of the page, in a unit that CSS knows."""
    if unit is not None and unit not in PAGE_UNITS:
        length, unit = length * MILLIMETRES[unit], "mm"
    return f"{_number(length)}{unit or ''}"


def _rounded(value: float) -> float:
    """Round a length to two significant digits: nobody reads more of a margin."""
    return float(f"{value:.1e}")
