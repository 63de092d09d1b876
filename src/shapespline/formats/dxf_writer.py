"""DXF by ezdxf: splines, arcs and lines, or polylines with arcs for machines without splines.

Splines are what importers agree on: without weights, clamped, of degree 3, one entity from corner
to corner, a smooth closed curve in its exact clamped form with the closed flag. Lines are lines and
circles CIRCLE; an outline of several lines and arcs is one LWPOLYLINE with bulges, so that it stays
one where others meet it; an arc beside splines is an ARC.
"""

from __future__ import annotations

import io
from contextlib import contextmanager
from itertools import pairwise
from math import degrees, pi, tan
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.formats.arc_accuracy import arc_tolerance_of
from shapespline.formats.entities import entities
from shapespline.geometry import arc_polyline, bulged, joined, lines_and_arcs
from shapespline.values import Piece

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ezdxf.document import Drawing as Document
    from ezdxf.layouts import Modelspace

    from shapespline.formats.entities import Entity
    from shapespline.values import Arc, BSplineCurve, Drawing, Fit

# $INSUNITS; a drawing in another unit, or in pixels, is written without one.
UNITS = {"in": 1, "ft": 2, "mi": 3, "mm": 4, "cm": 5, "m": 6, "km": 7, "mil": 9, "yd": 10,
         "um": 13, "dm": 14}  # fmt: skip
DEGREE = 3
# An arc that turns further keeps too few digits of its centre in a bulge.
LARGEST_BULGE = 1.75 * pi
# Flags of a SPLINE.
CLOSED, PLANAR = 1, 8
RELEASES, R12 = ("R2000", "R12"), "AC1009"


def encode(
    drawing: Drawing,
    *,
    degree: int = DEGREE,
    arcs: bool = False,
    arc_tolerance: float | None = None,
    release: str = "R2000",
) -> bytes:
    """Text of a DXF file; areas and strokes of a colour lie on a layer color_rrggbb.

    Parameters
    ----------
    drawing : Drawing
        Its unit goes to $INSUNITS.
    degree : int
        Curves of lower degree are raised to it, exactly; those of a higher one stay as they are.
    arcs : bool
        Write each outline as one LWPOLYLINE of lines and arcs (bulges) instead. Of the ways to
        write arcs it is the one that keeps a contour together, so that a machine cuts it in one
        go; separate ARC and LINE entities have to be chained again.
    arc_tolerance : float, optional
        Largest distance between a curve and its arcs, data units. A quarter of the tolerance of
        the fit if not given, so that data and arcs are within 1.25 tolerances of each other.
    release : {"R2000", "R12"}
        R12 is what old machines read: each outline one POLYLINE of lines and arcs, as with
        ``arcs``; it has no splines and says no unit.

    Returns
    -------
    bytes
        ASCII; the same for the same drawing.

    Raises
    ------
    InvalidInputError
        If an option is out of range.

    Notes
    -----
    Exact but for rounding; with ``arcs`` within ``arc_tolerance``, both ways.
    """
    if degree not in (2, 3, 4, 5, 6, 7, 8, 9):
        raise InvalidInputError(f"degree must be a whole number from 2 to 9, got {degree!r}")
    if release not in RELEASES:
        raise InvalidInputError(f"release must be one of {', '.join(RELEASES)}, got {release!r}")
    arcs = arcs or release == "R12"
    if arc_tolerance is not None and not arcs:
        raise InvalidInputError("arc_tolerance acts with arcs only: ask for arcs, or leave it out")
    import ezdxf

    text = io.StringIO()
    with _without_time_and_chance():
        document = ezdxf.new(
            release, units=0 if release == "R12" else UNITS.get(drawing.unit or "", 0)
        )
        space = document.modelspace()
        for index, fit in enumerate(drawing):
            before = len(space)
            if arcs:
                _add_arcs(space, fit, arc_tolerance)
            else:
                _add_splines(space, fit, degree)
            color = _color_of(drawing, index)
            if color is not None:
                layer = _layer(document, color)
                for number in range(before, len(space)):
                    space[number].dxf.layer = layer
        # The library writes the extents of its model space over those of the header.
        box = drawing.bounds
        space.reset_extents((box.x_min, box.y_min, 0.0), (box.x_max, box.y_max, 0.0))
        document.write(text)
    return text.getvalue().encode(document.output_encoding, errors="dxfreplace")


def _color_of(drawing: Drawing, index: int) -> str | None:
    """The colour of an area or else of its stroke; a hole has that of the area that it is in."""
    stroke, parent = drawing.strokes[index], drawing.parents[index]
    own = drawing.colors[index] or (stroke.color if stroke else None)
    return own or (drawing.colors[parent] if parent >= 0 else None)


def _layer(document: Document, color: str) -> str:
    """The name of the layer of a colour, made if it is not there, in the nearest of 255 colours."""
    from ezdxf.colors import DXF_DEFAULT_COLORS, int2rgb

    name = f"color_{color[1:]}"
    if name not in document.layers:
        wanted = [int(color[k : k + 2], 16) for k in (1, 3, 5)]
        table = np.array([int2rgb(value)[:3] for value in DXF_DEFAULT_COLORS[1:256]], dtype=float)
        nearest = int(np.argmin(((table - wanted) ** 2).sum(axis=1))) + 1
        document.layers.add(name, color=nearest)
    return name


@contextmanager
def _without_time_and_chance() -> Iterator[None]:
    """The same drawing gives the same bytes: the library has an option for it, a global one."""
    import ezdxf

    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


def _add_splines(space: Modelspace, fit: Fit, degree: int) -> None:
    """Lines, arcs and splines of one outline, end to end."""
    parts = entities(fit)
    if _is_polyline(parts):
        _add_polyline(space, parts, fit.closed)
        return
    for entity in parts:
        if entity.arc is not None:
            _add_arc(space, entity.arc)
        elif entity.curve.degree == 1:
            for begin, end in pairwise(entity.curve.control_points):
                space.add_line(begin, end)
        else:
            _add_spline(space, entity.curve, degree, closed=entity.closed)


def _is_polyline(parts: Sequence[Entity]) -> bool:
    """Whether an outline is lines and arcs, none of them so long that its chord tells little.

    One line or one arc alone is none.
    """
    arcs = [part.arc for part in parts if part.arc is not None]
    return (
        all(part.arc is not None or part.curve.degree == 1 for part in parts)
        and all(abs(arc.sweep) <= LARGEST_BULGE for arc in arcs)
        and (len(parts) > 1 or not (arcs or parts[0].is_line))
    )


def _add_polyline(space: Modelspace, parts: Sequence[Entity], closed: bool) -> None:
    rows = []
    for part in parts:
        bulge = 0.0 if part.arc is None else tan(0.25 * part.arc.sweep)
        rows += [(x, y, bulge) for x, y in part.curve.control_points[: 1 if bulge else -1].tolist()]
    if not closed:
        rows.append((*parts[-1].curve.control_points[-1].tolist(), 0.0))
    space.add_lwpolyline(rows, format="xyb", close=closed)


def _add_arc(space: Modelspace, arc: Arc) -> None:
    """DXF's arcs run anticlockwise, in degrees."""
    if arc.is_circle:
        space.add_circle(arc.centre, arc.radius)
        return
    begin, end = sorted((arc.start_angle, arc.end_angle))
    space.add_arc(arc.centre, arc.radius, degrees(begin), degrees(end))


def _add_spline(space: Modelspace, curve: BSplineCurve, degree: int, *, closed: bool) -> None:
    if curve.degree < degree:
        piece = Piece("spline", curve.degree, curve.knots, curve.control_points)
        curve = joined([piece], degree)
    entity = space.add_open_spline(curve.control_points, curve.degree, curve.knots.tolist())
    entity.dxf.flags = PLANAR | (CLOSED if closed else 0)


def _add_arcs(space: Modelspace, fit: Fit, arc_tolerance: float | None) -> None:
    accuracy = arc_tolerance_of(fit, arc_tolerance)
    if any(piece.arc for piece in fit.sections):
        found = bulged(lines_and_arcs(fit, accuracy), closed=fit.closed)
    else:
        found = arc_polyline(fit.spline, accuracy, closed=fit.closed)
    vertices = np.column_stack([found.points, found.bulges])
    _add_vertices(space, vertices.tolist(), found.closed)


def _add_vertices(space: Modelspace, rows: list[tuple[float, ...]], closed: bool) -> None:
    """One polyline; release 12 has an older kind of it."""
    if space.doc is not None and space.doc.dxfversion == R12:
        space.add_polyline2d(rows, format="xyb", close=closed)
    else:
        space.add_lwpolyline(rows, format="xyb", close=closed)
