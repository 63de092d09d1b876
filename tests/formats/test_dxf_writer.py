"""DXF files as ezdxf reads and audits them, against the curves that went in: lines, splines, arcs,
degrees, units, the way there and back, and options that do not go together.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections import Counter

import ezdxf
import numpy as np
import pytest
from tests.support.arcs import on_segment
from tests.support.make_fit import blob, fit_of, nested, wave
from tests.support.pieces import bezier
from tests.support.round_trip import flattened, round_trip

import shapespline as ss
from shapespline.errors import InvalidInputError
from shapespline.formats import dxf_writer
from shapespline.geometry.exact import Outlines, exact_drawing
from shapespline.geometry.nearest import nearest
from shapespline.values.drawing import Drawing


def opened(tmp_path, drawing, **options):
    """The entities of a drawing that was written, and audited."""
    path = tmp_path / "drawing.dxf"
    ss.write(path, drawing, **options)
    document = ezdxf.readfile(path)
    auditor = document.audit()
    assert not auditor.errors
    assert not auditor.fixes
    assert document.dxfversion == "AC1015"
    return list(document.modelspace())


def kinds(entities):
    return dict(Counter(entity.dxftype() for entity in entities))


# Splines and lines


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
@pytest.mark.parametrize("make", [blob, wave])
def test_splines_are_the_same_curve(tmp_path, make, degree):
    curve = make(11, degree)
    entities = opened(tmp_path, Drawing([fit_of(curve)]))
    if degree == 1:
        assert kinds(entities) == {"LWPOLYLINE": 1}
        assert entities[0].closed == (make is blob)
        assert len(entities[0]) == 11
        return
    (spline,) = entities
    tool = spline.construction_tool()
    assert not tool.is_rational
    assert tool.degree == max(degree, 3)
    assert tool.is_clamped
    assert spline.closed == (make is blob)
    u = np.linspace(0, 1, 1001)
    points = np.array([p.xyz for p in tool.points(u)])
    assert np.abs(points[:, :2] - curve(u)).max() <= 1e-9 * 20
    assert (points[:, 2] == 0).all()


def test_lines_splines_and_corners_are_entities_of_their_own(tmp_path):
    bend = bezier((4, 0), (6, 0), (6, 2))
    pieces = [
        bezier((0, 0), (4, 0)),
        bend,
        bezier((6, 2), (6, 4), (4, 4)),
        bezier((4, 4), (2, 7), (0, 0)),
    ]
    entities = opened(tmp_path, exact_drawing(Outlines([pieces])))
    assert [entity.dxftype() for entity in entities] == ["LINE", "SPLINE", "SPLINE"]
    assert [entity.construction_tool().count for entity in entities[1:]] == [6, 4]
    ends = [flattened(entity)[[0, -1]] for entity in entities]
    for before, after in zip(ends, ends[1:] + ends[:1], strict=True):
        assert np.abs(before[1] - after[0]).max() <= 1e-12


def test_outlines_of_lines_are_polylines_and_one_line_a_line(tmp_path):
    corners = [(0, 0), (4, 0), (4, 3), (0, 3)]
    sides = [bezier(*ends) for ends in zip(corners, corners[1:] + corners[:1], strict=True)]
    for pieces, closed in [(sides, True), (sides[:2], False)]:
        (entity,) = opened(tmp_path, exact_drawing(Outlines([pieces])))
        assert (entity.dxftype(), entity.closed) == ("LWPOLYLINE", closed)
        assert len(entity) == (4 if closed else 3)
    (entity,) = opened(tmp_path, exact_drawing(Outlines([sides[:1]])))
    assert entity.dxftype() == "LINE"


def test_degrees_that_are_asked_for(tmp_path):
    (spline,) = opened(tmp_path, Drawing([fit_of(wave(9, 2))]), degree=2)
    assert spline.dxf.degree == 2
    (spline,) = opened(tmp_path, Drawing([fit_of(wave(9, 2))]), degree=4)
    assert spline.dxf.degree == 4
    for degree in (1, 10, 2.5, "3"):
        with pytest.raises(InvalidInputError, match="degree must be a whole number from 2 to 9"):
            ss.write(tmp_path / "x.dxf", Drawing([fit_of(wave())]), degree=degree)


@pytest.mark.parametrize("unit", [None, "px", "mm", "in", "m", "pt"])
def test_what_was_written_comes_back(tmp_path, unit):
    drawing = Drawing(nested().fits, nested().parents, unit=unit)
    again = round_trip(drawing, tmp_path / "drawing.dxf")
    assert again.unit == (unit if unit in dxf_writer.UNITS else None)


def test_real_fits_come_back(tmp_path, outline):
    for name in ("hand620_closed", "plane1100_closed", "loop500_open"):
        fit = ss.fit_curve(outline(name), tolerance="0.1%")
        round_trip(Drawing([fit]), tmp_path / f"{name}.dxf")


@pytest.mark.slow
def test_the_same_drawing_gives_the_same_bytes(tmp_path):
    ss.write(tmp_path / "a.json", nested())
    program = (
        "import sys, shapespline as ss\n"
        "drawing = ss.read('a.json')\n"
        "ss.write(sys.argv[1], drawing)\n"
        "ss.write(sys.argv[2], drawing, arcs=True)\n"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    for run in ("1", "2"):
        names = [f"s{run}.dxf", f"a{run}.dxf"]
        command = [sys.executable, "-c", program, *names]
        subprocess.run(command, cwd=tmp_path, env=environment, check=True)
    for kind in "sa":
        one, two = ((tmp_path / f"{kind}{run}.dxf").read_bytes() for run in "12")
        assert one == two
        assert one.startswith(b"  0\nSECTION") or one.startswith(b"999")
    assert not ezdxf.options.write_fixed_meta_data_for_testing


# Arcs


@pytest.mark.parametrize("make", [blob, wave])
def test_arcs(tmp_path, make):
    fit = fit_of(make(11, 3))
    (polyline,) = opened(tmp_path, Drawing([fit]), arcs=True, arc_tolerance=0.01)
    assert polyline.dxftype() == "LWPOLYLINE"
    assert polyline.closed == (make is blob)
    vertices = np.array(polyline.get_points("xyb"))
    ends = np.roll(vertices, -1, axis=0)[: len(vertices) - (make is wave)]
    line = np.concatenate(
        [on_segment(a[:2], b[:2], a[2], 40) for a, b in zip(vertices, ends, strict=False)]
    )
    # The samples lie on the arcs to the rounding.
    assert np.sqrt(nearest(fit.spline, line).distances_sq.max()) <= 0.01
    (again,) = ss.read(tmp_path / "drawing.dxf")
    assert again.closed == fit.closed
    assert ss.compare(again.spline, fit.spline).hausdorff_distance <= 0.01 * 1.001


def test_the_arcs_of_a_fit_are_within_a_quarter_of_its_tolerance(tmp_path, outline):
    fit = ss.fit_curve(outline("hand620_closed"), tolerance=1.0)
    ss.write(tmp_path / "hand.dxf", fit, arcs=True)
    (again,) = ss.read(tmp_path / "hand.dxf")
    found = ss.compare(again.spline, fit.spline)
    assert found.hausdorff_distance <= 0.25 * 1.001
    assert found.hausdorff_distance >= 0.1  # and they make use of it


def test_options_that_do_not_go_together(tmp_path):
    with pytest.raises(InvalidInputError, match="arc_tolerance acts with arcs only"):
        ss.write(tmp_path / "x.dxf", nested(), arc_tolerance=0.1)
    with pytest.raises(InvalidInputError, match="arc_tolerance must be a positive length"):
        ss.write(tmp_path / "x.dxf", nested(), arcs=True, arc_tolerance=-1)
    assert not (tmp_path / "x.dxf").exists()


@pytest.mark.parametrize("options", [{}, {"arcs": True}, {"release": "R12"}])
def test_the_file_says_its_extents(tmp_path, options):
    drawing = Drawing([fit_of(blob(11, 3))])
    ss.write(tmp_path / "drawing.dxf", drawing, **options)
    header = ezdxf.readfile(tmp_path / "drawing.dxf").header
    low, high = drawing.bounds[:2], drawing.bounds[2:]
    assert header["$EXTMIN"] == (*low, 0.0)
    assert header["$EXTMAX"] == (*high, 0.0)
