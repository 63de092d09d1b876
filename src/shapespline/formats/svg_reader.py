"""SVG drawings as exact curves: every path and shape, transforms and units, by svgelements.

What is drawn is read: the borders of fills, the centre lines of strokes, and their colours. Hidden
elements, elements painted with nothing, definitions that nobody uses and text, pictures and effects
are not.
:mod:`shapespline.formats.svg_tree` prepares the document.
"""

from __future__ import annotations

import io
import math
import warnings
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import numpy as np

from shapespline.errors import FormatError, SkippedContentWarning, caller_level
from shapespline.formats.elliptic import elliptical_arc
from shapespline.formats.pieces import SAME_END, bezier, closed_up
from shapespline.formats.svg_areas import SubPath
from shapespline.formats.svg_looks import nested_as_painted, side_by_side
from shapespline.formats.svg_paint import Paint, paint_of
from shapespline.formats.svg_tree import prepared
from shapespline.geometry import Outlines

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from svgelements import Arc, PathSegment, Shape

    from shapespline.typing import FloatArray
    from shapespline.values import Piece


# A path of no length is a dot where the stroke's end is round or square, and a line so long, in
# widths of the stroke (FMT-17).
DOT = 0.01


def read(path: Path) -> Outlines:
    """Read the outlines of an SVG drawing.

    Lines, arcs of circles and Beziers are exact; arcs of ellipses become cubics within a billionth
    of their size. A sub-path that is filled is closed by a line, as it is when painted; one with
    fill="none" stays as it is. y is turned over within the view box, which is the frame. Where
    width or height have a unit of length (mm, cm, in, pt, pc, Q), coordinates are in that unit,
    otherwise they are those of the view box, "px". An outline inside another one is its hole where
    the colour that is seen changes across it. Colours and strokes are kept; a drawing of areas that
    are all black has none.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Outlines
        A sub-path each, in the order of drawing, with their nesting.

    Raises
    ------
    FormatError
        If the file is no SVG, is cut off, declares entities, is built to exhaust memory, or draws
        nothing.

    Warns
    -----
    SkippedContentWarning
        If there is text, a picture, a clip path, a mask, a gradient, a dash or a white ground:
        those are left out, gradients but for their mean; and if areas lie partly over each other.
    """
    page = prepared(path.read_bytes())
    paths = list(_sub_paths(page.root))
    nested = side_by_side(paths) if page.tiled else nested_as_painted(paths)
    skipped = [*page.skipped, "white areas on white"] if nested.white else page.skipped
    if skipped:
        warnings.warn(
            f"{path.name}: no outlines and left out: {', '.join(skipped)}; convert text to paths"
            " and apply clips and styles in the drawing program",
            SkippedContentWarning,
            stacklevel=caller_level(),
        )
    if not nested.kept:
        raise FormatError("the drawing holds no visible path or shape")
    if nested.crossing:
        warnings.warn(
            f"{path.name}: areas that lie partly over each other are neither united nor cut; do so"
            " in the drawing program",
            SkippedContentWarning,
            stacklevel=caller_level(),
        )
    curves = [paths[k].pieces for k in nested.kept]
    height = page.turning_height
    if height is None:
        y = np.concatenate([piece.control_points[:, 1] for pieces in curves for piece in pieces])
        height = float(y.min() + y.max())
    across, down = page.scale
    scale, shift = np.diag([across, -down]), np.array([0.0, height * down])
    turned = [[piece.moved(scale, shift) for piece in pieces] for pieces in curves]
    colors, widths, strokes = zip(*nested.looks, strict=True)
    pen = math.sqrt(across * down)
    return Outlines(
        turned,
        page.frame,
        page.unit,
        nested.parents,
        colors,
        [None if width is None else pen * width for width in widths],
        strokes,
    )


def _sub_paths(root: ElementTree.Element) -> Iterator[SubPath]:
    """Every sub-path that is drawn, in the coordinates of the view box, y down."""
    from svgelements import SVG, Shape

    text = io.BytesIO(ElementTree.tostring(root))
    try:
        elements = SVG.parse(text, reify=False, on_error="raise").elements()
        for number, element in enumerate(elements):
            if not isinstance(element, Shape):
                continue
            paint = paint_of(element)
            if paint.fill or paint.stroke:
                for pieces in _pieces_of(element, paint):
                    if pieces:
                        yield SubPath(pieces, number, paint)
    except (ValueError, TypeError, ArithmeticError, LookupError, AttributeError) as error:
        # What the library stumbles over is an error of the document.
        raise FormatError(f"a path or shape cannot be understood: {error}") from error
    except RecursionError:
        raise FormatError("the drawing is nested too deeply") from None


def _pieces_of(shape: Shape, paint: Paint) -> Iterator[list[Piece]]:
    """Pieces of each sub-path of an element."""
    from svgelements import Close, Move

    def close(pieces: list[Piece]) -> list[Piece]:
        found = _filled_up(pieces) if paint.fill else closed_up(pieces)
        if not found and pieces and paint.stroke and paint.cap != "butt":
            place = pieces[0].control_points[0]
            found = [bezier([place, place + np.array([DOT * paint.width, 0.0])])]
        return found

    m = shape.transform
    axes, origin = np.array([[m.a, m.c], [m.b, m.d]]), np.array([m.e, m.f])
    pieces: list[Piece] = []
    for segment in shape.segments(transformed=False):
        if isinstance(segment, Move):
            yield close(pieces)
            pieces = []
            continue
        pieces += [piece.moved(axes, origin) for piece in _pieces_of_segment(segment)]
        if isinstance(segment, Close):
            yield close(pieces)
            pieces = []
    yield close(pieces)


def _filled_up(pieces: list[Piece]) -> list[Piece]:
    """A sub-path as it is filled: closed by a line (SVG 2, 13.4.1), unless it holds no area."""
    points = [point for piece in pieces for point in piece.control_points]
    if pieces and not _on_a_line(np.array(points)):
        pieces = [*pieces, bezier([points[-1], points[0]])]
    return closed_up(pieces)


def _on_a_line(points: FloatArray) -> bool:
    """Whether points lie on a line, but for a billionth of their extent."""
    offsets = points - points[0]
    size = float(np.abs(offsets).max())
    if size == 0.0:
        return True
    offsets = offsets / size
    far = offsets[np.argmax(np.hypot(*offsets.T))]
    beside = np.abs(offsets @ np.array([-far[1], far[0]]))
    return bool(beside.max() <= SAME_END * (far @ far))


def _pieces_of_segment(segment: PathSegment) -> list[Piece]:
    from svgelements import Arc, CubicBezier, QuadraticBezier

    if segment.start is None or segment.end is None:
        return []
    if isinstance(segment, Arc):
        return _arc(segment)
    inner = []
    if isinstance(segment, CubicBezier):
        inner = [segment.control1, segment.control2]
    elif isinstance(segment, QuadraticBezier):
        inner = [segment.control]
    return [bezier([_xy(point) for point in (segment.start, *inner, segment.end)])]


def _arc(arc: Arc) -> list[Piece]:
    start, end = _xy(arc.start), _xy(arc.end)
    if not (arc.rx and arc.ry):  # by the standard a line
        return [bezier([start, end])]
    centre = _xy(arc.center)
    first, second = _xy(arc.prx) - centre, _xy(arc.pry) - centre
    pieces = elliptical_arc(centre, first, second, arc.get_start_t(), arc.sweep)
    pieces[0] = pieces[0].meeting(begin=start)
    pieces[-1] = pieces[-1].meeting(end=end)
    return pieces


def _xy(point: object) -> FloatArray:
    place = np.array([point.x, point.y], dtype=np.float64)  # type: ignore[attr-defined]
    if not np.isfinite(place).all():
        raise FormatError("a coordinate of a path or shape is no finite number")
    return place
