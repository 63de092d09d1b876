"""Delimited text: one point a line, two columns of numbers, a blank line between outlines."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import order_points
from shapespline.errors import FormatError, ShuffledPointsWarning, caller_level
from shapespline.formats.columns import COMMENT, picked
from shapespline.formats.dialects import Dialect, content_of, head_of, lines_of, number, shown
from shapespline.geometry import parents_of, sampled
from shapespline.values import Contour, Shape

if TYPE_CHECKING:
    from pathlib import Path

    from shapespline.typing import FloatArray
    from shapespline.values import Drawing, Fit

# Below this confidence an order that was found may be another one.
CLEAR = 0.995


def encode(drawing: Drawing, *, chord: float | None = None) -> bytes:
    """Points of every curve at a chordal tolerance, a blank line between curves.

    Parameters
    ----------
    drawing : Drawing
    chord : float, optional
        Largest distance between the curve and the polyline written, data units; 1e-4 of the box
        diagonal if not given. Straight pieces are two points whatever it is.

    Returns
    -------
    bytes
        Two columns with the shortest digits that read back to the same doubles, separated by
        commas. Closed curves repeat their first point at the end; open ones whose ends are no
        farther apart than a straight piece is long have points on it, so that they read back open.

    Raises
    ------
    InvalidInputError
        If ``chord`` is not positive, or absurdly small.
    """
    blocks = ["".join(f"{x!r},{y!r}\n" for x, y in _polyline(fit, chord)) for fit in drawing]
    return "\n".join(blocks).encode("ascii")


def _polyline(fit: Fit, chord: float | None) -> list[list[float]]:
    """Points of a curve as a file can hold them, which tells by them alone what is closed."""
    contour = sampled(fit.spline, chord, longest=np.inf)[0]
    if not contour.closed and Contour(contour.points).closed:
        contour = sampled(fit.spline, chord)[0]
    points: list[list[float]] = contour.polyline.tolist()
    return points


def read(
    path: Path,
    *,
    closed: bool | None = None,
    y_down: bool = False,
    unordered: bool = False,
    columns: str | None = None,
) -> Shape:
    """Read outlines from delimited text.

    Columns are separated by semicolons, commas, or blanks and tabs (a run of them counts once);
    which, is told by the first line of numbers. Where commas do not separate columns, and within
    quotes, they are decimal commas. ``#`` comments, quotes, a byte order mark, the line ``sep=;``
    of spreadsheets and header lines (no numbers in them) are skipped. A header that names the
    columns y and x, latitude and longitude or northing and easting turns them round. A blank line
    begins another outline, unless it would leave an outline of a single point. Airfoils in the
    layout of Lednicer (numbers of points above and below, then both surfaces from the leading edge)
    become one outline from the trailing edge around. UTF-8, else Latin-1.

    Parameters
    ----------
    path : Path
    closed : bool, optional
        Whether the outline is closed; found from the gap between its ends if not given, a
        repeated first point at the end being the plainest case.
    y_down : bool
        Turn y over within the bounding box: y -> y_min + y_max - y.
    unordered : bool
        Find the outlines that the points were taken from, whatever their order in the file; see
        `order_points`.
    columns : str, optional
        The columns of a wider table that hold x and y: two names of its first line or two numbers
        from 1, such as ``"east,north"`` or ``"2,3"``.

    Returns
    -------
    Shape
        Contours nested by containment, no frame.

    Raises
    ------
    FormatError
        Naming the line, if it does not hold exactly two finite numbers.
    InvalidInputError
        If the points make no contour, or no order can be found.
    """
    points, breaks = parse(path.read_bytes(), columns)
    if y_down:
        points = turned_over(points)
    if unordered:
        return in_order(points, closed)
    outlines = np.split(points, breaks)
    airfoil = around_airfoil(points)
    if airfoil is not None:
        outlines = [airfoil]
    elif min(map(len, outlines)) < 2:
        outlines = [points]
    contours = [Contour(outline, closed) for outline in outlines]
    return Shape(contours, parents_of(contours))


def in_order(points: FloatArray, closed: bool | None) -> Shape:
    """The outlines that points in no order were taken from; a warning says where that is in doubt.

    Warns
    -----
    ShuffledPointsWarning
        If there are several outlines, an open one that nobody spoke of, or points whose neighbours
        are not clear.
    """
    found = order_points(points, closed=closed)
    n_closed = sum(contour.closed for contour in found.shape)
    n_open = len(found.shape) - n_closed
    if len(found.shape) > 1 or (n_open and closed is None) or found.confidence < CLEAR:
        warnings.warn(
            f"the order of the points was found: {n_closed} closed and {n_open} open outlines,"
            f" confidence {found.confidence:.2f}; closed=True or closed=False says more of them,"
            " and a picture shows whether they are right",
            ShuffledPointsWarning,
            stacklevel=caller_level(),
        )
    return found.shape


def turned_over(points: FloatArray) -> FloatArray:
    """Points with y turned over within their bounding box.

    Examples
    --------
    >>> turned_over(np.array([(0.0, 1.0), (5.0, 3.0)])).tolist()
    [[0.0, 3.0], [5.0, 1.0]]
    """
    low, high = (points[:, 1].min(), points[:, 1].max()) if len(points) else (0.0, 0.0)
    return np.column_stack([points[:, 0], low + high - points[:, 1]])


def around_airfoil(points: FloatArray) -> FloatArray | None:
    """An airfoil in Lednicer's layout as one outline; None if the points are none.

    The first row holds the numbers of points of the upper and the lower surface, which follow, both
    from the leading edge to the trailing edge.

    Examples
    --------
    >>> rows = [(3, 3), (0, 0), (0.5, 0.1), (1, 0), (0, 0), (0.5, -0.1), (1, 0)]
    >>> around_airfoil(np.array(rows)).tolist()
    [[1.0, 0.0], [0.5, 0.1], [0.0, 0.0], [0.5, -0.1], [1.0, 0.0]]
    """
    if len(points) < 7 or (points[0] < 3).any() or points[0].sum() != len(points) - 1:
        return None
    upper, lower = np.split(points[1:], [int(points[0, 0])])
    if float(points[0, 0]) != len(upper):
        return None
    same = bool((upper[0] == lower[0]).all())
    return np.concatenate([upper[::-1], lower[int(same) :]])


def columns_of(path: Path, columns: str) -> FloatArray:
    """Numbers in two columns of a table of text, by name or number from 1, shape (n, 2).

    Raises
    ------
    FormatError
        If it is no table of text, or has no such column.
    """
    try:
        return parse(path.read_bytes(), columns).points
    except FormatError as error:
        raise FormatError(f"{path}: {error}") from error


class Parsed(NamedTuple):
    """All points, shape (n, 2), and how many of them stand before each blank line among them."""

    points: FloatArray
    breaks: list[int]


def parse(data: bytes, columns: str | None = None) -> Parsed:
    r"""Points of delimited text.

    Examples
    --------
    >>> points, breaks = parse(b"x;y\n1,5;2\n3;4,5\n\n0;0\n1;1\n")
    >>> points.tolist(), breaks
    ([[1.5, 2.0], [3.0, 4.5], [0.0, 0.0], [1.0, 1.0]], [2])
    """
    lines = lines_of(_decoded(data))
    if columns is not None:
        lines = picked(lines, columns)
    dialect, n_skipped, y_first = head_of(lines)
    body = lines[n_skipped:]
    if dialect.separator != "," and any("," in line for line in body):
        dialect = Dialect(dialect.separator, ",")
        body = [line.replace(",", ".") for line in body]
    try:
        points = np.loadtxt(
            body, delimiter=dialect.separator, comments=COMMENT, dtype=np.float64, ndmin=2
        )
        sound = points.shape[1] == 2 and bool(np.isfinite(points).all())
    except (ValueError, OverflowError):
        sound = False
    # Thirty times slower, but it names the line, and it skips blank lines that hold blanks.
    if not sound:
        points = _line_by_line(lines, n_skipped, dialect)
    if y_first and columns is None:
        points = np.ascontiguousarray(points[:, ::-1])
    return Parsed(points, _breaks(body, len(points)))


def _breaks(body: list[str], n_points: int) -> list[int]:
    """Numbers of points before the blank lines that have points on both sides."""
    found: dict[int, None] = {}
    before = 0
    for line in body:
        content = line.strip()
        if not content:
            found[before] = None
        elif not content.startswith(COMMENT):
            before += 1
    return [count for count in found if 0 < count < n_points]


def _decoded(data: bytes) -> str:
    """Text of a file, whatever its encoding."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        text = data.decode("utf-16", errors="replace")
    elif b"\0" in data:
        raise FormatError("no text but binary data; is the file's ending right?")
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("latin-1")
    return text


def _line_by_line(lines: list[str], start: int, dialect: Dialect) -> FloatArray:
    """Points of the lines, or the error of the first one without exactly two finite numbers."""
    points: list[float] = []
    for index, content in content_of(lines, start):
        fields = dialect.fields(content)
        if len(fields) != 2:
            wide = len(fields) > 2 and not points
            remedy = '; say which two: --columns 2,3 (columns="2,3")' if wide else ""
            raise FormatError(
                f"line {index + 1}: expected 2 columns (x and y), found {len(fields)}:"
                f" {shown(content)}{remedy}"
            )
        for field in fields:
            value = number(field)
            if value is None:
                raise FormatError(f"line {index + 1}: {shown(field)} is not a number")
            if not np.isfinite(value):
                raise FormatError(
                    f"line {index + 1}: {shown(field)} is not finite; remove or repair the point"
                )
            points.append(value)
    return np.array(points).reshape(-1, 2)
