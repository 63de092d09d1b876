"""Delimited text: every dialect gives the numbers that were written, every fault its line."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.support.make_fit import blob, fit_of

import shapespline as ss
from shapespline.errors import DegenerateContourError, FormatError
from shapespline.formats import csv
from shapespline.formats.registry import read

numbers = st.floats(-1e12, 1e12, allow_nan=False)
point_lists = st.lists(st.tuples(numbers, numbers), min_size=1, max_size=12)
# What stands between the columns, and the decimal mark that goes with it.
separations = st.sampled_from(
    [
        (",", "."),
        (", ", "."),
        (";", "."),
        (";", ","),
        (" ; ", ","),
        ("\t", "."),
        ("\t", ","),
        (" ", "."),
        ("   ", ","),
        (",\t", "."),
    ]
)
headers = st.sampled_from(["", "x,y", "x;y", "x y", "X (mm)\tY (mm)", '"x","y"', "NACA 2412"])
comments = st.sampled_from(["", "# a comment, with 1,2", "#", "   # indented"])


def written(points, separation, header="", comment="", newline="\n", tail=""):
    between, decimal = separation
    lines = [line for line in (comment, header) if line]
    lines += [between.join(repr(v).replace(".", decimal) for v in point) for point in points]
    if comment:
        lines.insert(len(lines) // 2 + 1, comment)
    return newline.join(lines) + tail


@pytest.mark.slow
@given(
    point_lists,
    separations,
    headers,
    comments,
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.sampled_from(["", "\n", "\n\n  \n\n"]),
    st.sampled_from(["utf-8", "utf-8-sig", "latin-1", "utf-16"]),
)
def test_every_dialect_is_read_exactly(
    points, separation, header, comment, newline, tail, encoding
):
    text = written(points, separation, header, comment, newline, tail)
    assert np.array_equal(csv.parse(text.encode(encoding)).points, np.array(points))


@pytest.mark.parametrize(
    ("text", "points"),
    [
        ("1,2\n3,4\n", [(1, 2), (3, 4)]),
        ("1,5 2,5\n3 4\n", [(1.5, 2.5), (3, 4)]),  # blanks separate: the comma is decimal
        ("1 2\n1,5 2,5\n", [(1, 2), (1.5, 2.5)]),  # ... also where the first line shows none
        ("1;2\n1,5;2\n", [(1, 2), (1.5, 2)]),
        ("1, 2\n", [(1, 2)]),  # a comma at a field's end separates
        ("  1\t 2  \n", [(1, 2)]),
        ("1,2 # inline\n\n\n3,4\n", [(1, 2), (3, 4)]),
        ('"1.5","-2e3"\n', [(1.5, -2000)]),
        ("+1,-.5\n1.,1E+2\n", [(1, -0.5), (1, 100)]),
    ],
)
def test_by_hand(text, points):
    assert csv.parse(text.encode()).points.tolist() == [list(map(float, point)) for point in points]


@pytest.mark.parametrize(
    "text",
    [
        '"x","y"\n"0,5","-1,5"\n"2",",25"\n',
        '"x, east";"y"\n"0,5";-1,5\n"2";"0,25"\n',
        "sep=;\nx;y\n0,5;-1,5\n2;0,25\n",
        "Measured with X\nDate 2020-01-01\nx,y\nmm,mm\n\n0.5,-1.5\n2,0.25\n",
        "y,x\n-1.5,0.5\n0.25,2\n",
        "Lat;Lon\n-1,5;0,5\n0,25;2\n",
        '"Latitude [deg]","Longitude [deg]"\n-1.5,0.5\n0.25,2\n',
        "northing (m)\teasting (m)\n-1.5\t0.5\n0.25\t2\n",
        "Y [mm] X [mm]\n-1.5 0.5\n0.25 2\n",
        "lat,lon\ndeg,deg\n-1.5,0.5\n0.25,2\n",
        "X,Y\n0.5,-1.5\n2,0.25\n",
        "lon,lat\n0.5,-1.5\n2,0.25\n",
        "height,width\n0.5,-1.5\n2,0.25\n",
    ],
)
def test_what_spreadsheets_write(text):
    assert csv.parse(text.encode()).points.tolist() == [[0.5, -1.5], [2, 0.25]]


def test_columns_that_are_asked_for_are_taken_as_asked():
    table = b'"id","lat","lon"\n"a;1","-1,5","0,5"\n"b;2","0,25","2,0"\n'
    for columns in ("lon,lat", "3,2"):
        with_names = table if columns == "lon,lat" else table.split(b"\n", 1)[1]
        points = csv.parse(with_names, columns).points
        assert points.tolist() == [[0.5, -1.5], [2, 0.25]]
    assert csv.parse(b"lat,lon\n1,2\n", "1,2").points.tolist() == [[1, 2]]


def test_points_of_scanners(tmp_path):
    path = tmp_path / "scan.xyz"
    path.write_text("0.5 -1.5\n2 0.25\n")
    assert read(path).contours[0].points.tolist() == [[0.5, -1.5], [2, 0.25]]
    path.write_text("0.5 -1.5 7\n2 0.25 7\n")
    assert len(read(path, columns="1,2").contours[0]) == 2
    with pytest.raises(FormatError, match=r"found 3: .*; say which two: --columns"):
        read(path)


def test_latin_1_header_is_no_obstacle():
    assert csv.parse("x (µm);y (µm)\n1;2\n".encode("latin-1")).points.tolist() == [[1.0, 2.0]]


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("1,2\n3,4,5\n", r"line 2: expected 2 columns \(x and y\), found 3: '3,4,5'"),
        ("1,2,3\n4,5,6\n", "line 1: expected 2 columns .* found 3"),
        ("x,y,z\n1,2,3\n", "line 1: expected 2 columns .* found 3"),
        ("1\n2\n", "line 1: expected 2 columns .* found 1"),
        ("1,2\n3\n", "line 2: expected 2 columns .* found 1"),
        ("1,2\n3,4,\n", "line 2: expected 2 columns .* found 3"),
        ("x,y\n1,2\n\n# note\n3,four\n", "line 5: 'four' is not a number"),
        ("1,abc\n2,3\n", "line 1: 'abc' is not a number"),  # half a line of numbers: no header
        ("x,y\n1,2\nx,y\n", "line 3: 'x' is not a number"),
        ("x,y\n7 points,\n1,2\n", "line 1: 'x' is not a number"),
        ("1,2\n3,1_000\n", "line 2: '1_000' is not a number"),
        ("1,2\n3,\n", "line 2: '' is not a number"),
        ("1,2\nnan,4\n", "line 2: 'nan' is not finite"),
        ("1,2\n3,-inf\n", "line 2: '-inf' is not finite"),
        ("nan,nan\n1,2\n", "line 1: 'nan' is not finite"),
        ("1,2\n3,1e999\n", "line 2: '1e999' is not finite"),
        ("1.234,5;6\n", "line 1: '1.234.5' is not a number"),  # no thousands separators
        ("\n# only comments\n\n", "no points"),
        ("lorem ipsum dolor\nsit amet\n", "line 1: expected 2 columns .* found 3"),
    ],
)
def test_a_fault_is_named_with_its_line(text, complaint):
    with pytest.raises(FormatError, match=complaint):
        csv.parse(text.encode())


def test_binary_data_is_refused():
    with pytest.raises(FormatError, match="binary"):
        csv.parse(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR")


@pytest.mark.slow
@given(st.binary(max_size=200))
def test_any_bytes_give_points_or_a_format_error(data):
    try:
        points = csv.parse(data).points
    except FormatError:
        return
    assert points.shape[1] == 2
    assert np.isfinite(points).all()


SQUARE = "0,0\n4,0\n4,1\n0,1\n"


def test_closedness(tmp_path):
    path = tmp_path / "square.csv"
    path.write_text(SQUARE + "0,0\n")
    (repeated,) = read(path)
    assert repeated.closed
    assert len(repeated) == 4
    assert read(path, closed=False).longest.semi_closed
    path.write_text("0,0\n1,0\n2,0\n3,1\n")
    assert not read(path).longest.closed
    assert read(path, closed=True).longest.closed


@pytest.mark.parametrize("ending", ["csv", "geojson"])
@pytest.mark.parametrize("chord", [None, 0.001, 1.0])
def test_straight_pieces_are_written_as_two_points(tmp_path, ending, chord):
    corners = [(0, 0), (10, 0), (10, 10), (0, 10)]
    fit = ss.fit_curve(ss.Contour(corners, closed=True), tolerance=0.01)
    ss.write(tmp_path / f"a.{ending}", fit, chord=chord)
    (contour,) = ss.read(tmp_path / f"a.{ending}")
    assert contour.closed
    assert sorted(map(tuple, contour.points.round(9))) == sorted(corners)


def test_a_larger_chord_means_fewer_points(tmp_path):
    """A chord h off spans sqrt(8 h / curvature): the number goes with the root of the ratio."""
    fit, counts = fit_of(blob(9)), []
    for chord in (0.15, 0.0015):
        ss.write(tmp_path / "a.csv", fit, chord=chord)
        counts.append(len(ss.read(tmp_path / "a.csv").contours[0]))
    # Whole steps on each span.
    assert counts[0] <= counts[1] / 10 + len(fit.spline.breakpoints)


def test_an_open_curve_of_long_lines_comes_back_open(tmp_path):
    corners = ss.Contour([(0, 0), (10, 0), (10, 10), (0, 10)], closed=False)
    ss.write(tmp_path / "a.csv", ss.fit_curve(corners, tolerance=0.01))
    assert not ss.read(tmp_path / "a.csv").contours[0].closed


def test_y_down_turns_over_within_the_box(tmp_path):
    path = tmp_path / "triangle.txt"
    path.write_text("0 10\n4 10\n4 12\n")
    assert read(path, y_down=True, closed=True).longest.points.tolist() == [
        [0, 12],
        [4, 12],
        [4, 10],
    ]


def test_too_few_points_name_the_file(tmp_path):
    path = tmp_path / "dot.csv"
    path.write_text("1,2\n")
    with pytest.raises(DegenerateContourError, match=r"dot\.csv: points must hold at least"):
        read(path)


@pytest.mark.parametrize(
    ("header", "named", "expected"),
    [
        ("No,X [mm],Y [mm]", "x,y", [[1, 2], [3, 5]]),
        ("x,X,y (m)", "x,Y", [[0, 2], [1, 5]]),
        ("x [mm],x [in],y", "x,y", None),
        ("x [mm],x [in],y", "x [in],y", [[1, 2], [3, 5]]),
    ],
)
def test_names_of_columns_may_leave_out_units_and_capitals(tmp_path, header, named, expected):
    path = tmp_path / "table.csv"
    path.write_text(f"{header}\n0,1,2\n1,3,5\n4,4,4\n")
    if expected is None:  # either could be meant
        with pytest.raises(FormatError, match="no column 'x'; the table has 3"):
            read(path, columns=named)
    else:
        assert read(path, columns=named).longest.points.tolist()[:2] == expected
