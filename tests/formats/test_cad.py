"""STEP, IGES and 3dm: the same geometry for readers that we did not write, and back."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.make_fit import blob, fit_of, nested, wave
from tests.support.pieces import bezier, square
from tests.support.round_trip import round_trip

import shapespline as ss
from shapespline.geometry.exact import exact_fit
from shapespline.geometry.nearest import nearest
from shapespline.values.drawing import Drawing

rhino3dm = pytest.importorskip("rhino3dm", reason="needs shapespline[rhino]")

# Their libraries take seconds to load.
pytestmark = pytest.mark.slow

ENDINGS = ["step", "iges", "3dm"]


@pytest.fixture(autouse=True, scope="module")
def _open_cascade():
    """Loaded with the first test, not when tests are collected: it takes seconds."""
    pytest.importorskip("OCP.Geom", reason="needs shapespline[cad]")


@pytest.fixture
def drawings(outline):
    square = ss.Contour([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True).resampled(80)
    return {
        "ring": Drawing([fit_of(blob())]),
        "wave": Drawing([fit_of(wave())]),
        "nested": nested(),
        "degree 5": Drawing([fit_of(blob(degree=5))]),
        "square": Drawing([ss.fit_curve(square, tolerance=0.01)]),
        "hand": Drawing([ss.fit_curve(outline("hand620_closed"), tolerance=0.3)]),
        "loop": Drawing([ss.fit_curve(outline("loop500_open"), tolerance=0.2)]),
    }


NAMES = ["ring", "wave", "nested", "degree 5", "square", "hand", "loop"]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("ending", ENDINGS)
def test_round_trip(drawings, tmp_path, ending, name):
    round_trip(drawings[name], tmp_path / f"drawing.{ending}")


@pytest.mark.parametrize("ending", [*ENDINGS, "dxf"])
def test_areas_that_share_a_side_stay_areas(tmp_path, ending):
    boxes = [exact_fit(square(10, at)) for at in [(0, 0), (10, 0), (5, 10)]]
    within, path = exact_fit(square(2, (4, 4))), exact_fit([bezier((0, 0), (0, -5), (9, -9))])
    drawing = Drawing([*boxes, within, path], [-1, -1, -1, 0, -1], unit="mm")
    again = round_trip(drawing, tmp_path / f"drawing.{ending}")
    assert again.area == pytest.approx(3 * 100 - 4)


def test_sheets_that_share_an_edge_are_two_outlines(tmp_path):
    """As programs write bodies: faces sewn together have one edge in common."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Sewing
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    from shapespline.formats import occ

    sewing = BRepBuilderAPI_Sewing()
    for at in [(0, 0), (10, 0)]:
        sewing.Add(occ.faces(Drawing([exact_fit(square(10, at))]), 1.0))
    sewing.Perform()
    path = tmp_path / "sheets.step"
    writer = STEPControl_Writer()
    writer.Transfer(sewing.SewedShape(), STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(path))
    assert path.read_text().count("EDGE_CURVE(") == 7
    again = ss.read(path)
    assert [fit.closed for fit in again] == [True, True]
    assert again.area == pytest.approx(200)


@pytest.mark.parametrize("ending", ["step", "iges"])
def test_the_same_bytes(drawings, tmp_path, ending):
    for name in ("first", "second"):
        ss.write(tmp_path / f"{name}.{ending}", drawings["hand"])
    assert (tmp_path / f"first.{ending}").read_bytes() == (
        tmp_path / f"second.{ending}"
    ).read_bytes()


@pytest.mark.parametrize("ending", ENDINGS)
def test_units(drawings, tmp_path, ending):
    path = tmp_path / f"drawing.{ending}"
    ss.write(path, drawings["square"], unit="in")
    again = ss.read(path, unit="in")
    assert again.unit == "in"
    assert abs(again.fits[0].contour.box_diagonal - 4 * np.sqrt(2)) < 0.03
    plain = ss.read(path)
    in_mm = 25.4 if plain.unit == "mm" else 1.0
    assert abs(plain.fits[0].contour.box_diagonal - in_mm * 4 * np.sqrt(2)) < 0.03 * in_mm


@pytest.mark.parametrize("name", ["ring", "square", "hand"])
def test_opencascade_sees_one_valid_closed_wire(drawings, tmp_path, name):
    from OCP.BRep import BRep_Tool
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_EDGE, TopAbs_WIRE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    path = tmp_path / "drawing.step"
    ss.write(path, drawings[name])
    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    shape = reader.OneShape()
    assert BRepCheck_Analyzer(shape).IsValid()

    def count(kind):
        explorer, found = TopExp_Explorer(shape, kind), []
        while explorer.More():
            found.append(explorer.Current())
            explorer.Next()
        return found

    (wire,) = count(TopAbs_WIRE)
    assert BRep_Tool.IsClosed_s(TopoDS.Wire(wire))
    from shapespline.formats.entities import entities

    assert len(count(TopAbs_EDGE)) == len(entities(drawings[name].fits[0]))
    text = path.read_text()
    assert ("B_SPLINE_CURVE_WITH_KNOTS" in text) == (name != "square")
    assert "RATIONAL" not in text


def test_rhino_evaluates_the_same_curve(drawings, tmp_path):
    path = tmp_path / "ring.3dm"
    ss.write(path, drawings["ring"])
    (entry,) = rhino3dm.File3dm.Read(str(path)).Objects
    curve, spline = entry.Geometry, drawings["ring"].fits[0].spline
    assert curve.IsClosed
    for u in np.linspace(0, 1, 57):
        point = curve.PointAt(float(u))
        assert np.abs(spline([u])[0] - (point.X, point.Y)).max() <= 1e-9 * 20


def test_arcs_of_other_programs(tmp_path):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge
    from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Pnt
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    def write(direction, path):
        circle = gp_Circ(gp_Ax2(gp_Pnt(5, 7, 2), direction), 3)
        writer = STEPControl_Writer()
        writer.Transfer(
            BRepBuilderAPI_MakeEdge(circle).Edge(), STEPControl_StepModelType.STEPControl_AsIs
        )
        writer.Write(str(path))

    flat, steep = tmp_path / "flat.step", tmp_path / "steep.step"
    write(gp_Dir(0, 0, 1), flat)
    write(gp_Dir(1, 0, 0), steep)
    (fit,) = ss.read(flat)
    assert fit.closed
    radius = np.hypot(*(fit.spline(np.linspace(0, 1, 999)) - (5, 7)).T)
    assert np.abs(radius - 3).max() <= 1e-8
    with pytest.raises(ss.FormatError, match="does not lie in a plane z = constant"):
        ss.read(steep)


def test_rational_curves_of_rhino(tmp_path):
    model = rhino3dm.File3dm()
    circle = rhino3dm.Circle(rhino3dm.Point3d(1, 2, 0), 3).ToNurbsCurve()
    assert circle.IsRational
    corners = [rhino3dm.Point3d(x, y, 0) for x, y in [(10, 0), (14, 0), (14, 5), (10, 5)]]
    periodic = rhino3dm.NurbsCurve.Create(True, 3, corners)
    heavy = rhino3dm.NurbsCurve(3, True, 3, 3)
    for index, (x, y, w) in enumerate([(0, 10, 1), (4, 10, 3), (4, 16, 1)]):
        heavy.Points[index] = rhino3dm.Point4d(w * x, w * y, 0, w)
    for index, knot in enumerate([0.0, 0, 1, 1]):
        heavy.Knots[index] = knot
    for curve in (circle, periodic, heavy):
        model.Objects.AddCurve(curve)
    model.Write(str(tmp_path / "a.3dm"), 6)
    found = ss.read(tmp_path / "a.3dm")
    assert [fit.closed for fit in found] == [True, True, False]
    assert [piece.kind for piece in found.fits[0].pieces] == ["arc"]
    for fit, curve in zip(found, (circle, periodic, heavy), strict=True):
        first, last = curve.Domain.T0, curve.Domain.T1
        there = [curve.PointAt(float(t)) for t in np.linspace(first, last, 50)]
        points = np.array([(point.X, point.Y) for point in there])
        # Cubics and the twin of an arc are within a billionth of the size, 10 at most.
        assert np.sqrt(nearest(fit.spline, points).distances_sq.max()) <= 1.1e-8


def test_a_circle_of_rational_splines_is_a_circle(tmp_path):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge
    from OCP.Geom import Geom_Circle
    from OCP.GeomConvert import GeomConvert
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    circle = Geom_Circle(gp_Ax2(gp_Pnt(5, 7, 0), gp_Dir(0, 0, 1)), 3)
    spline = GeomConvert.CurveToBSplineCurve_s(circle)
    assert spline.IsRational()
    writer = STEPControl_Writer()
    edge = BRepBuilderAPI_MakeEdge(spline).Edge()
    writer.Transfer(edge, STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(tmp_path / "a.step"))
    (fit,) = ss.read(tmp_path / "a.step")
    (piece,) = fit.pieces
    assert piece.arc.is_circle
    assert (piece.arc.centre, piece.arc.radius) == (pytest.approx((5, 7)), pytest.approx(3))


@pytest.mark.parametrize("ending", ENDINGS)
def test_damaged_files_are_sentences(drawings, tmp_path, ending):
    path = tmp_path / f"drawing.{ending}"
    ss.write(path, drawings["wave"])
    data = path.read_bytes()
    for broken in (data[: len(data) // 2], b"\x89PNG\r\n\x1a\n" * 20, b"hello\n" * 9):
        path.write_bytes(broken)
        with pytest.raises(ss.FormatError):
            ss.read(path)
