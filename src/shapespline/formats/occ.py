"""STEP and IGES through OpenCASCADE: curves in the plane z = 0, to wires and faces and back.

Needs the extra ``cad``.
"""

from __future__ import annotations

import contextlib
import io
import os
import sys
from math import atan2, cos, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import FormatError
from shapespline.formats.chains import chained, wire
from shapespline.formats.cubics import groups
from shapespline.formats.entities import entities
from shapespline.formats.splines import spline_pieces
from shapespline.geometry import Outlines
from shapespline.values import Arc, Piece

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.formats.entities import Entity
    from shapespline.typing import FloatArray
    from shapespline.values import Drawing, Fit

# Of the largest coordinate: what counts as the plane z = 0, and how near the cubics come that stand
# for ellipses and other rational curves.
FLAT, CONVERTED = 1e-9, 1e-10


def wires(drawing: Drawing, scale: float) -> Any:
    """A drawing as a wire, or a compound of wires."""
    return _together([_wire(fit, scale) for fit in drawing])


def faces(drawing: Drawing, scale: float) -> Any:
    """A drawing as plane faces with holes; what makes no valid face, open curves too, as wires."""
    shapes = []
    for group in groups(drawing):
        bounds = [_wire(drawing.fits[index], scale) for index in group]
        face = _face(bounds) if drawing.is_area(group[0]) else None
        shapes += bounds if face is None else [face]
    return _together(shapes)


def _face(bounds: list[Any]) -> Any | None:
    """The plane face within the first wire and outside the others, None where there is none."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.gp import gp_Pln
    from OCP.ShapeFix import ShapeFix_Face

    maker = BRepBuilderAPI_MakeFace(gp_Pln(), bounds[0], True)
    for hole in bounds[1:]:
        maker.Add(hole)
    if not maker.IsDone():
        return None
    fix = ShapeFix_Face(maker.Face())
    fix.FixOrientation()  # holes run the other way
    face = fix.Face()
    return face if BRepCheck_Analyzer(face).IsValid() else None


def _together(shapes: list[Any]) -> Any:
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound

    if len(shapes) == 1:
        return shapes[0]
    compound, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(compound)
    for shape in shapes:
        builder.Add(compound, shape)
    return compound


def _wire(fit: Fit, scale: float) -> Any:
    """Edges end to end; neighbours share their vertex."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeWire

    parts = entities(fit)
    starts = [_vertex(part.curve.control_points[0], scale) for part in parts]
    end = starts[0] if fit.closed else _vertex(parts[-1].curve.control_points[-1], scale)
    maker = BRepBuilderAPI_MakeWire()
    for part, first, last in zip(parts, starts, [*starts[1:], end], strict=True):
        if part.is_line:
            edge = BRepBuilderAPI_MakeEdge(first, last)
        elif part.arc is not None:
            circle, turn = _circle(part.arc, scale), abs(part.arc.sweep)
            edge = BRepBuilderAPI_MakeEdge(circle, first, last, 0.0, turn)
        else:
            edge = BRepBuilderAPI_MakeEdge(_geometry(part, scale), first, last, 0.0, 1.0)
        if not edge.IsDone():
            raise FormatError("OpenCASCADE refuses a piece of the curve: it is too small for CAD")
        maker.Add(edge.Edge())
        if not maker.IsDone():
            raise FormatError("OpenCASCADE cannot join the pieces: they are too small for CAD")
    return maker.Wire()


def _vertex(point: Any, scale: float) -> Any:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex

    return BRepBuilderAPI_MakeVertex(_point(point, scale)).Vertex()


def _point(point: Any, scale: float) -> Any:
    from OCP.gp import gp_Pnt

    return gp_Pnt(float(scale * point[0]), float(scale * point[1]), 0.0)


def _circle(arc: Arc, scale: float) -> Any:
    """The circle of an arc, its parameter an angle from the beginning of the arc."""
    from OCP.Geom import Geom_Circle
    from OCP.gp import gp_Ax2, gp_Dir

    up = gp_Dir(0.0, 0.0, 1.0 if arc.sweep > 0 else -1.0)
    towards = gp_Dir(cos(arc.start_angle), sin(arc.start_angle), 0.0)
    return Geom_Circle(gp_Ax2(_point(arc.centre, scale), up, towards), scale * arc.radius)


def _geometry(part: Entity, scale: float) -> Any:
    """Non-rational clamped B-spline over [0, 1]."""
    from OCP.collections import Array1_double, Array1_gp_Pnt, Array1_int
    from OCP.Geom import Geom_BSplineCurve

    curve = part.curve
    knots, counts = np.unique(curve.knots, return_counts=True)
    poles = Array1_gp_Pnt(1, curve.n_control_points)
    for index, point in enumerate(curve.control_points, start=1):
        poles.SetValue(index, _point(point, scale))
    values, multiplicities = Array1_double(1, len(knots)), Array1_int(1, len(knots))
    for index, (knot, count) in enumerate(zip(knots.tolist(), counts.tolist(), strict=True), 1):
        values.SetValue(index, knot)
        multiplicities.SetValue(index, count)
    return Geom_BSplineCurve(poles, values, multiplicities, curve.degree)


def outlines(shape: Any, unit: str, name: str) -> Outlines:
    """Curves of an OpenCASCADE shape: bounds of faces and wires as they are, edges chained.

    Parameters
    ----------
    shape : TopoDS_Shape or None
    unit : str
        Of its coordinates.
    name : str
        Of the file, for warnings.
    """
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    if shape is None or shape.IsNull():
        raise FormatError("the file holds no geometry")
    runs: list[Sequence[Piece]] = []
    # Two faces that share an edge have two bounds, each of which holds it.
    for bound in _parts(shape, Kind.TopAbs_WIRE):
        runs += wire([_pieces(edge) for edge in _parts(bound, Kind.TopAbs_EDGE)])
    runs += [_pieces(edge) for edge in _parts(shape, Kind.TopAbs_EDGE, outside=Kind.TopAbs_WIRE)]
    if not any(runs):
        raise FormatError("the file holds no curve; points and surfaces without edges are not read")
    return Outlines(chained(runs, name), unit=unit)


def _parts(shape: Any, kind: Any, outside: Any | None = None) -> list[Any]:
    """Parts of a shape, each once, or those that are in no part of another kind."""
    from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher
    from OCP.TopExp import TopExp_Explorer

    found = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher()
    avoided = () if outside is None else (outside,)
    explorer = TopExp_Explorer(shape, kind, *avoided)
    while explorer.More():
        found.Add(explorer.Current())
        explorer.Next()
    return [found.FindKey(number) for number in range(1, found.Extent() + 1)]


def _pieces(edge: Any) -> list[Piece]:
    """Geometry of an edge as clamped plane pieces over [0, 1]."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.Geom import Geom_TrimmedCurve
    from OCP.GeomAbs import GeomAbs_CurveType
    from OCP.GeomConvert import GeomConvert
    from OCP.TopoDS import TopoDS

    edge = TopoDS.Edge(edge)
    if BRep_Tool.Degenerated_s(edge):
        return []
    adaptor = BRepAdaptor_Curve(edge)
    begin, end = adaptor.FirstParameter(), adaptor.LastParameter()
    if adaptor.GetType() == GeomAbs_CurveType.GeomAbs_Line:
        ends = np.array([_xyz(adaptor.Value(at)) for at in (begin, end)])
        return [Piece("line", 1, np.array([0.0, 0, 1, 1]), _flat(ends))]
    if adaptor.GetType() == GeomAbs_CurveType.GeomAbs_Circle:
        return [_arc_piece(adaptor.Circle(), begin, end)]
    curve = adaptor.Curve().Curve().Transformed(adaptor.Trsf())
    spline = GeomConvert.CurveToBSplineCurve_s(Geom_TrimmedCurve(curve, begin, end))
    if spline.IsPeriodic():
        spline.SetNotPeriodic()
    if spline.IsRational() and adaptor.GetType() == GeomAbs_CurveType.GeomAbs_BSplineCurve:
        weights = [spline.Weight(i) for i in range(1, spline.NbPoles() + 1)]
        arcs = spline_pieces(spline.Degree(), _knots(spline), _poles(spline), weights)
        if all(piece.arc for piece in arcs):  # a circle, as programs without arcs write it
            return arcs
    return [_spline_piece(spline)]


def _arc_piece(circle: Any, begin: float, end: float) -> Piece:
    """An arc between two angles of a circle, which begins at its own x axis."""
    position = circle.Position()
    axis, across = _xyz(position.XDirection()), _xyz(position.YDirection())
    _flat(np.array([axis, across, (0.0, 0.0, 0.0)]))
    sign = float(np.sign(axis[0] * across[1] - axis[1] * across[0]))
    start = atan2(axis[1], axis[0]) + sign * begin
    x, y, _ = _xyz(circle.Location())
    return Piece.of_arc(Arc((x, y), circle.Radius(), start, sign * (end - begin)))


def _spline_piece(spline: Any) -> Piece:
    """Any B-spline as a non-rational one: exact if it is one, else within CONVERTED."""
    from OCP.GeomAbs import GeomAbs_Shape
    from OCP.GeomConvert import GeomConvert_ApproxCurve

    if spline.IsRational() or spline.Degree() > 9:
        size = max(abs(value) for i in range(1, spline.NbPoles() + 1) for value in
                   _xyz(spline.Pole(i)))  # fmt: skip
        near = GeomConvert_ApproxCurve(spline, CONVERTED * size, GeomAbs_Shape.GeomAbs_C1, 200, 8)
        if not near.HasResult() or near.MaxError() > 10 * CONVERTED * size:
            raise FormatError("a rational curve of the file cannot be written as a B-spline")
        spline = near.Curve()
    knots = _knots(spline)
    knots = (knots - knots[0]) / (knots[-1] - knots[0])
    kind = "spline" if spline.NbKnots() > 2 else "line" if spline.Degree() == 1 else "bezier"
    return Piece(kind, spline.Degree(), knots, _poles(spline))


def _knots(spline: Any) -> FloatArray:
    return np.repeat(
        [spline.Knot(i) for i in range(1, spline.NbKnots() + 1)],
        [spline.Multiplicity(i) for i in range(1, spline.NbKnots() + 1)],
    )


def _poles(spline: Any) -> FloatArray:
    poles: FloatArray = _flat(
        np.array([_xyz(spline.Pole(i)) for i in range(1, spline.NbPoles() + 1)])
    )
    return poles


def _xyz(point: Any) -> tuple[float, float, float]:
    return point.X(), point.Y(), point.Z()


def _flat(points: Any) -> Any:
    """The x and y of points that lie in a plane z = constant."""
    if np.ptp(points[:, 2]) > FLAT * max(1.0, np.abs(points).max()):
        raise FormatError(
            "a curve of the file does not lie in a plane z = constant; project it onto xy first"
        )
    return np.ascontiguousarray(points[:, :2])


@contextlib.contextmanager
def silent() -> Iterator[None]:
    """OpenCASCADE writes its progress to file descriptor 1, past Python's sys.stdout."""
    sys.stdout.flush()
    kept = os.dup(1)
    try:
        with open(os.devnull, "wb") as nowhere:  # noqa: PTH123 - a device, not a path
            os.dup2(nowhere.fileno(), 1)
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)


def stream(data: bytes = b"") -> io.BytesIO:
    """What OpenCASCADE reads from or writes to."""
    return io.BytesIO(data)
