"""3dm, the file of Rhino: NURBS curves, arcs and lines, an outline of several as one polycurve.

Needs the extra ``rhino``. The library writes the time and random identities into the file: of all
formats this is the one whose bytes differ from run to run. The geometry does not.
"""

from __future__ import annotations

from math import atan2, cos, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import FormatError
from shapespline.formats.chains import chained
from shapespline.formats.entities import entities
from shapespline.formats.splines import spline_pieces
from shapespline.geometry import Outlines
from shapespline.values import Arc, Piece

if TYPE_CHECKING:
    from pathlib import Path

    from shapespline.formats.entities import Entity
    from shapespline.typing import FloatArray
    from shapespline.values import Drawing

# Rhino's names of units.
UNITS = {
    "um": "Microns", "mm": "Millimeters", "cm": "Centimeters", "dm": "Decimeters", "m": "Meters",
    "km": "Kilometers", "mil": "Mils", "in": "Inches", "ft": "Feet", "yd": "Yards", "mi": "Miles",
}  # fmt: skip
# The version of Rhino whose files every later one reads.
VERSION = 6
# Of the largest coordinate: what counts as the plane z = constant.
FLAT = 1e-9


def encode(drawing: Drawing) -> bytes:
    """Bytes of a 3dm file.

    Parameters
    ----------
    drawing : Drawing
        In its unit, where Rhino knows it.
    """
    import rhino3dm

    model = rhino3dm.File3dm()
    if drawing.unit in UNITS:
        model.Settings.ModelUnitSystem = getattr(rhino3dm.UnitSystem, UNITS[drawing.unit])
    for fit in drawing:
        curves = [_curve(rhino3dm, entity) for entity in entities(fit)]
        if len(curves) == 1:
            model.Objects.AddCurve(curves[0])
            continue
        together = rhino3dm.PolyCurve()
        for curve in curves:
            together.AppendSegment(curve)
        model.Objects.AddCurve(together)
    options = rhino3dm.File3dmWriteOptions()
    options.Version = VERSION
    return _bytes(model, options)


def _bytes(model: Any, options: Any) -> bytes:
    """The library writes to a path only."""
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "drawing.3dm"
        if not model.Write(str(target), options.Version):
            raise FormatError("rhino3dm could not write the drawing")
        return target.read_bytes()


def _curve(rhino3dm: Any, entity: Entity) -> Any:
    """A line, or a clamped non-rational NURBS curve; openNURBS stores no first and last knot."""
    points = [rhino3dm.Point3d(float(x), float(y), 0.0) for x, y in entity.curve.control_points]
    if entity.is_line:
        return rhino3dm.LineCurve(*points)
    if entity.arc is not None:
        return _arc_curve(rhino3dm, entity.arc)
    degree = entity.curve.degree
    curve = rhino3dm.NurbsCurve(3, False, degree + 1, len(points))
    for index, point in enumerate(points):
        curve.Points[index] = rhino3dm.Point4d(point.X, point.Y, point.Z, 1.0)
    for index, knot in enumerate(entity.curve.knots[1:-1].tolist()):
        curve.Knots[index] = knot
    return curve


def _arc_curve(rhino3dm: Any, arc: Arc) -> Any:
    """An arc or a circle in its own plane, whose x axis leads to the beginning."""
    xyz = (float(arc.centre[0]), float(arc.centre[1]), 0.0)
    a, sign = arc.start_angle, 1.0 if arc.sweep > 0 else -1.0
    plane = rhino3dm.Plane(
        rhino3dm.Point3d(*xyz),
        rhino3dm.Vector3d(cos(a), sin(a), 0.0),
        rhino3dm.Vector3d(-sign * sin(a), sign * cos(a), 0.0),
    )
    circle = rhino3dm.Circle(arc.radius)
    circle.Plane = plane
    return rhino3dm.ArcCurve.CreateFromArc(rhino3dm.Arc(circle, abs(arc.sweep)))


def read(path: Path) -> Outlines:
    """Curves of a 3dm file in a plane z = constant: lines, arcs, polylines, NURBS, joined ones.

    Rational ones become arcs where they are parts of circles, else cubics within 1e-9 of their
    size.

    Raises
    ------
    FormatError
        If the file is no 3dm file, holds no curve, or one that is not plane.

    Warns
    -----
    SkippedContentWarning
        If curves that repeat others were left out.
    OpenOutlinesWarning
        If ends of open outlines almost meet.
    """
    import rhino3dm

    if not path.read_bytes()[:32].startswith(b"3D Geometry File Format"):
        raise FormatError("this is no 3dm file: it does not begin with 3D Geometry File Format")
    model = rhino3dm.File3dm.Read(str(path))
    if model is None:
        raise FormatError("rhino3dm cannot read the file: it is damaged")
    runs = [
        _pieces(rhino3dm, entry.Geometry)
        for entry in model.Objects
        if isinstance(entry.Geometry, rhino3dm.Curve)
    ]
    if not runs:
        raise FormatError("the file holds no curve")
    named = {getattr(rhino3dm.UnitSystem, name): unit for unit, name in UNITS.items()}
    return Outlines(chained(runs, path.name), unit=named.get(model.Settings.ModelUnitSystem))


def _pieces(rhino3dm: Any, curve: Any) -> list[Piece]:
    """Clamped plane pieces over [0, 1]."""
    if isinstance(curve, rhino3dm.PolyCurve):
        parts = [curve.SegmentCurve(index) for index in range(curve.SegmentCount)]
        return [piece for part in parts for piece in _pieces(rhino3dm, part)]
    if isinstance(curve, rhino3dm.PolylineCurve):
        points = _flat([curve.Point(index) for index in range(curve.PointCount)])
        ends = np.array([0.0, 0.0, 1.0, 1.0])
        return [Piece("line", 1, ends, points[k : k + 2]) for k in range(len(points) - 1)]
    if isinstance(curve, rhino3dm.ArcCurve):
        return [_arc_piece(curve)]
    spline = curve.ToNurbsCurve()
    if spline is None:
        raise FormatError("the file holds a curve that rhino3dm cannot make a NURBS curve of")
    poles = [spline.Points[index] for index in range(len(spline.Points))]
    weights = [pole.W for pole in poles]
    if not all(weights):
        raise FormatError("the file holds a curve with a weight of 0; rebuild it in Rhino first")
    points = _flat([rhino3dm.Point3d(p.X / p.W, p.Y / p.W, p.Z / p.W) for p in poles])
    inner = [spline.Knots[index] for index in range(len(spline.Knots))]
    return spline_pieces(spline.Degree, [inner[0], *inner, inner[-1]], points, weights)


def _arc_piece(curve: Any) -> Piece:
    """An arc between two angles of its plane's x axis."""
    arc = curve.Arc
    plane = arc.Plane
    _flat([arc.StartPoint, arc.MidPoint, arc.EndPoint])
    ux, uy, vx, vy = plane.XAxis.X, plane.XAxis.Y, plane.YAxis.X, plane.YAxis.Y
    sign = 1.0 if ux * vy - uy * vx > 0 else -1.0
    start = atan2(uy, ux) + sign * arc.StartAngle
    centre = (arc.Center.X, arc.Center.Y)
    return Piece.of_arc(Arc(centre, arc.Radius, start, sign * (arc.EndAngle - arc.StartAngle)))


def _flat(points: list[Any]) -> FloatArray:
    array = np.array([(point.X, point.Y, point.Z) for point in points])
    if np.ptp(array[:, 2]) > FLAT * max(1.0, float(np.abs(array).max())):
        raise FormatError(
            "a curve of the file does not lie in a plane z = constant; project it onto xy first"
        )
    return np.ascontiguousarray(array[:, :2])
