"""Arcs are arcs in every format that has them, for readers that we did not write, and come back."""

from __future__ import annotations

import io
from math import cos, degrees, pi, sin

import ezdxf
import numpy as np
import pytest
import svgelements
from tests.support.pieces import bezier
from tests.support.round_trip import round_trip

import shapespline as ss
from shapespline.geometry import exact_fit
from shapespline.values import Arc, Drawing, Piece, ViewBox

# Of the size: what a few roundings of written digits and of an arc tangent leave.
SAME = 1e-13


def slot(x, y, *, wide=4.0, r=1.0, turn=0.0):
    """Two lines and two half circles."""
    corners = [(x, y - r), (x + wide, y - r), (x + wide, y + r), (x, y + r)]
    a, b, c, d = (np.array(corner) for corner in corners)
    pieces = [
        bezier(a, b),
        Piece.of_arc(Arc((x + wide, y), r, -pi / 2, pi), begin=b, end=c),
        bezier(c, d),
        Piece.of_arc(Arc((x, y), r, pi / 2, pi), begin=d, end=a),
    ]
    fit = exact_fit(pieces)
    return fit.transformed([[cos(turn), -sin(turn)], [sin(turn), cos(turn)]]) if turn else fit


def keyhole():
    """An arc of more than half a turn, clockwise, and lines."""
    arc = Arc((10.0, 9.0), 2.0, -0.3 * pi, -1.4 * pi)
    begin, end = arc.begin, arc.end
    foot = np.array([10.0, 4.0])
    return exact_fit([Piece.of_arc(arc), bezier(end, foot), bezier(foot, begin)])


def mixed():
    """An arc that runs smoothly into a cubic, and a line: open."""
    arc = Arc((0.0, 20.0), 3.0, pi, -pi / 2)
    cubic = bezier((0, 23), (2, 23), (3, 25), (6, 25))
    return exact_fit(
        [bezier((-3, 18), (-3, 20)), Piece.of_arc(arc, begin=(-3, 20), end=(0, 23)), cubic]
    )


@pytest.fixture(scope="module")
def drawing():
    fits = [
        slot(0, 0),
        slot(12, -6, wide=3.3, r=0.7, turn=0.4),
        keyhole(),
        mixed(),
        exact_fit([Piece.of_arc(Arc((20.0, 1.0), 2.5, 0.4, 2 * pi))]),
        exact_fit([Piece.of_arc(Arc((-9.0, 1.0), 2.5, 2.0, -0.9))]),
    ]
    return Drawing(fits, frame=ViewBox(-12, -8, 40, 40), unit="mm")


def circles(drawing):
    """Centre, radius and part of a turn of every arc, in an order of their own."""
    arcs = [piece.arc for fit in drawing for piece in fit.pieces if piece.arc]
    return np.array(
        sorted((*np.round(arc.centre, 6), *arc.centre, arc.radius, abs(arc.sweep)) for arc in arcs)
    )


@pytest.mark.slow
@pytest.mark.parametrize("ending", ["svg", "dxf", "json", "step", "iges", "3dm"])
def test_round_trip(drawing, tmp_path, ending):
    if ending in ("step", "iges"):
        pytest.importorskip("OCP.Geom")
    if ending == "3dm":
        pytest.importorskip("rhino3dm")
    again = round_trip(drawing, tmp_path / f"drawing.{ending}")
    kinds = sorted(sorted(piece.kind for piece in fit.pieces) for fit in again)
    assert kinds == sorted(sorted(piece.kind for piece in fit.pieces) for fit in drawing)
    # 40 wide; IGES keeps the ends of an arc and finds its angles from them.
    lost = np.abs(circles(drawing) - circles(again))[:, 2:].max()
    assert lost <= 40 * (SAME if ending != "iges" else 1e-10)


def test_svg_for_another_reader(drawing, tmp_path):
    path = tmp_path / "drawing.svg"
    ss.write(path, drawing)
    text = path.read_text()
    assert text.count("A") == 4 + 4 + 3 + 1 + 4 + 1  # quarters
    held = svgelements.SVG.parse(str(path))
    paths = [element for element in held.elements() if isinstance(element, svgelements.Path)]
    assert sum(path.length() for path in paths) == pytest.approx(
        drawing.length * 96 / 25.4, rel=1e-6
    )  # lengths of cubics are approximations of the library's


def test_dxf_for_another_reader(drawing, tmp_path):
    path = tmp_path / "drawing.dxf"
    ss.write(path, drawing)
    document = ezdxf.readfile(path)
    assert not document.audit().errors
    space = document.modelspace()
    kinds = sorted(entity.dxftype() for entity in space)
    assert kinds == [
        "ARC",
        "ARC",
        "CIRCLE",
        "LINE",
        "LWPOLYLINE",
        "LWPOLYLINE",
        "LWPOLYLINE",
        "SPLINE",
    ]
    circle = space.query("CIRCLE").first
    assert (circle.dxf.center.xyz[:2], circle.dxf.radius) == ((20.0, 1.0), 2.5)
    angles = sorted(entity.dxf.end_angle - entity.dxf.start_angle for entity in space.query("ARC"))
    assert angles == pytest.approx([degrees(0.9), 90.0])
    first = space.query("LWPOLYLINE").first
    assert first.closed
    assert [row[4] for row in first.get_points()] == pytest.approx([0, 1, 0, 1])


def test_a_circle_is_converted_to_a_circle(tmp_path):
    document = ezdxf.new("R2000")
    space = document.modelspace()
    space.add_circle((3, 4), 2)
    block = document.blocks.new("part")
    block.add_arc((0, 0), 1, 30, 300)
    space.add_blockref("part", (20, 0), dxfattribs={"xscale": 2, "yscale": 2, "rotation": 30})
    space.add_blockref("part", (40, 0), dxfattribs={"xscale": 2, "yscale": 1})
    document.saveas(tmp_path / "in.dxf")
    drawing = ss.read(tmp_path / "in.dxf")
    assert [fit.pieces[0].kind for fit in drawing] == ["arc", "arc", "bezier"]
    assert drawing.fits[0].n_stored_points == 2
    turned = drawing.fits[1].pieces[0].arc
    assert turned.radius == pytest.approx(2)
    assert abs(turned.sweep) == pytest.approx(1.5 * pi)
    ss.write(tmp_path / "out.dxf", drawing)
    circle = ezdxf.readfile(tmp_path / "out.dxf").modelspace().query("CIRCLE").first
    assert (circle.dxf.center.xyz[:2], circle.dxf.radius) == ((3.0, 4.0), 2.0)
    svg = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><circle cx="4" cy="5" r="2"/>'
    svg += '<g transform="rotate(20) scale(0.5)" fill="none" stroke="red">'
    svg += '<path d="M1 1A2 2 0 0 1 5 1"/></g>'
    svg += '<ellipse cx="2" cy="2" rx="1" ry="0.5"/></svg>'
    read = ss.read(io.BytesIO(svg.encode()), format=".svg")
    arcs = [[piece.arc and piece.arc.radius for piece in fit.pieces] for fit in read]
    assert arcs[0] == [2.0]
    assert arcs[1] == pytest.approx([1.0])
    assert arcs[2][0] is None


def test_python_holds_arcs_beside_the_splines(drawing, tmp_path):
    path = tmp_path / "drawing.py"
    ss.write(path, drawing)
    held = {}
    exec(path.read_text(), held)
    assert len(held["curves"]) == len(held["pieces"]) == len(drawing)
    assert held["pieces"][4] == [("arc", (20.0, 1.0), 2.5, 0.4, 2 * pi)]
    assert [item[0] for item in held["pieces"][3]] == ["line", "arc", "spline"]


def test_release_12_is_polylines_with_bulges(drawing, tmp_path):
    path = tmp_path / "old.dxf"
    ss.write(path, drawing, release="R12", arc_tolerance=1e-3)
    document = ezdxf.readfile(path)
    assert document.dxfversion == "AC1009"
    assert not document.audit().errors
    assert {entity.dxftype() for entity in document.modelspace()} == {"POLYLINE"}
    again = ss.read(path)
    assert [fit.closed for fit in again] == [fit.closed for fit in drawing]
    for before, after in zip(drawing, again, strict=True):
        assert {piece.kind for piece in after.pieces} <= {"line", "arc"}
        assert ss.compare(before.spline, after.spline).hausdorff_distance <= 1.01e-3
    assert again.fits[4].pieces[0].arc.is_circle
    with pytest.raises(ss.InvalidInputError, match="release must be one of R2000, R12, got 'R14'"):
        ss.write(path, drawing, release="R14")


def test_flat_and_empty_arcs_are_read(tmp_path):
    document = ezdxf.new("R2000")
    rows = [(0, 0, 1e-18), (1, 0, -3e-9), (2, 0, 1e-4), (3, 0, 0)]
    document.modelspace().add_lwpolyline(rows, format="xyb")
    document.saveas(tmp_path / "flat.dxf")
    (fit,) = ss.read(tmp_path / "flat.dxf")
    assert [piece.kind for piece in fit.pieces] == ["line", "line", "arc"]
    assert max(piece.twin_error for piece in fit.pieces) < 3e-9  # a billionth of 2500
    svg = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
    svg += '<path d="M1 1A2 2 0 0 1 1 1L5 5A0 2 0 0 1 7 5" fill="none" stroke="red"/></svg>'
    (read,) = ss.read(io.BytesIO(svg.encode()), format=".svg")
    assert [piece.kind for piece in read.pieces] == ["line", "line"]


@pytest.mark.slow
def test_formats_without_arcs_say_so_once(drawing, tmp_path, recwarn):
    for ending in ("svg", "dxf", "nc", "png", "py"):
        ss.write(tmp_path / f"x.{ending}", drawing)
    assert not recwarn.list
    for ending in ("pdf", "csv", "geojson"):
        with pytest.warns(ss.ArcsAsCurvesWarning, match=rf"\.{ending} files know no arcs") as said:
            ss.write(tmp_path / f"x.{ending}", drawing)
        assert len(said) == 1
        assert said[0].filename == __file__


@pytest.mark.slow
def test_cad_for_other_readers(drawing, tmp_path):
    pytest.importorskip("OCP.Geom")
    rhino3dm = pytest.importorskip("rhino3dm")
    for ending in ("step", "iges", "3dm"):
        ss.write(tmp_path / f"x.{ending}", drawing)
    # Two slots of two, a keyhole, two arcs and a circle; bounds of faces lie in their planes, too.
    step = (tmp_path / "x.step").read_bytes()
    assert step.count(b"= CIRCLE(") >= 8
    assert step.count(b"B_SPLINE_CURVE_WITH_KNOTS(") == 1  # the cubic
    # An entity has two lines in the directory.
    directory = [line for line in (tmp_path / "x.iges").read_text().splitlines() if line[72] == "D"]
    assert sum(line[:8].strip() == "100" for line in directory) == 2 * 8
    model = rhino3dm.File3dm.Read(str(tmp_path / "x.3dm"))
    circle = model.Objects[4].Geometry
    assert isinstance(circle, rhino3dm.ArcCurve)
    assert circle.IsCompleteCircle
    assert (circle.Arc.Center.X, circle.Radius) == (20.0, 2.5)
