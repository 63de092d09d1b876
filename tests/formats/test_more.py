"""GeoJSON, CSV of samples, PDF, PNG and Python: read by others, and back where they hold it."""

from __future__ import annotations

import io
import json
import re
import runpy
import zlib

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from PIL import Image
from tests.support.make_fit import blob, fit_of, nested, wave

import shapespline as ss
from shapespline.formats import csv, geojson, pdf, picture
from shapespline.values.drawing import Drawing

CHORD = 0.01


def signed_area(ring):
    x, y = np.transpose(ring)
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def test_geojson_holds_polygons_as_the_standard_wants_them():
    held = json.loads(geojson.encode(nested(), chord=CHORD))
    assert held["type"] == "FeatureCollection"
    *polygons, stroke = held["features"]
    assert stroke["geometry"]["type"] == "LineString"
    for feature in polygons:
        assert feature["type"] == "Feature"
        outer, *holes = feature["geometry"]["coordinates"]
        assert signed_area(outer) > 0
        assert all(signed_area(hole) < 0 for hole in holes)
        assert all(ring[0] == ring[-1] for ring in (outer, *holes))
    assert [len(feature["geometry"]["coordinates"]) for feature in polygons] == [2, 1]


@pytest.mark.parametrize("ending", ["csv", "geojson"])
@pytest.mark.parametrize("drawing", [nested(), Drawing([fit_of(wave())])], ids=["nested", "open"])
def test_samples_keep_the_chord(tmp_path, drawing, ending):
    path = tmp_path / f"drawing.{ending}"
    ss.write(path, drawing, chord=CHORD)
    shape = ss.read(path)
    assert len(shape) == len(drawing)
    found = ss.compare(shape, drawing)
    # Vertices lie on the curve; between samples a distance grows by half their spacing at most.
    assert found.hausdorff_distance <= CHORD + 0.5 * found.spacing
    assert sorted(contour.closed for contour in shape) == sorted(fit.closed for fit in drawing)
    holes = [drawing.is_hole(index) for index in range(len(drawing))]
    assert sum(shape.is_hole(index) for index in range(len(shape))) == sum(holes)


def test_coarser_chords_need_fewer_points(tmp_path):
    counts = []
    for chord in (0.1, 0.001):
        ss.write(tmp_path / "x.csv", fit_of(blob()), chord=chord)
        counts.append(len(ss.read(tmp_path / "x.csv").longest))
    assert counts[0] < counts[1]
    for wrong in (0, -1, np.nan, "fine"):
        with pytest.raises(ss.InvalidInputError):
            ss.write(tmp_path / "x.csv", fit_of(blob()), chord=wrong)


def test_several_outlines_in_a_text_file(tmp_path):
    path = tmp_path / "two.csv"
    path.write_text("x,y\n0,0\n9,0\n9,9\n0,9\n0,0\n\n\n# the hole\n3,3\n6,3\n6,6\n3,3\n")
    shape = ss.read(path)
    assert [len(contour) for contour in shape] == [4, 3]
    assert shape.parents == (-1, 0)
    path.write_text("0,0\n\n9,0\n\n9,9\n\n0,9\n")  # a blank line after every point
    assert [len(contour) for contour in ss.read(path)] == [4]


@pytest.mark.parametrize("blank", ["\n", ""])
def test_airfoils_in_both_layouts(tmp_path, blank):
    upper = [(0.0, 0.0), (0.1, 0.05), (0.5, 0.08), (1.0, 0.001)]
    lower = [(0.0, 0.0), (0.2, -0.03), (1.0, -0.001)]
    row = "{:.4f} {:.4f}\n".format
    around = [*upper[::-1], *lower[1:]]
    selig = tmp_path / "selig.dat"
    selig.write_text("NACA 0012\n" + "".join(row(*point) for point in around))
    lednicer = tmp_path / "lednicer.dat"
    lednicer.write_text(
        "NACA 0012\n       4.       3.\n" + blank + "".join(row(*point) for point in upper) + blank
        + "".join(row(*point) for point in lower)
    )  # fmt: skip
    for path in (selig, lednicer):
        assert_array_equal(ss.read(path).longest.points, around)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "no JSON"),
        ("[" * 100_000, "no JSON"),
        ("[1, 2]", "an object with a type"),
        ('{"type": "Ring"}', "unknown type 'Ring'"),
        ('{"type": "Point", "coordinates": [1, 2]}', "no line and no polygon"),
        ('{"type": "Polygon"}', "coordinates of a Polygon must be a list"),
        ('{"type": "Polygon", "coordinates": [[1, 2]]}', "lists of two or three numbers"),
        ('{"type": "LineString", "coordinates": [[1, "a"], [2, 3]]}', "lists of two or three"),
        ('{"type": "LineString", "coordinates": [[1, 2]]}', "distinct points"),
        ('{"type": "LineString", "coordinates": [[1, NaN], [2, 3]]}', "finite"),
        ('{"type": "FeatureCollection", "features": 3}', "features of a FeatureCollection"),
    ],
)
def test_broken_geojson_is_a_sentence(tmp_path, text, message):
    path = tmp_path / "broken.geojson"
    path.write_text(text)
    with pytest.raises(ss.ShapesplineError, match=message):
        ss.read(path)


def test_every_kind_of_geojson(tmp_path):
    square = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]
    hole = [[1, 1], [1, 2], [2, 2], [1, 1]]
    triangle = [[9, 9, 5], [10, 9, 5], [9, 10, 5]]  # heights are skipped
    path = tmp_path / "all.geojson"
    geometries = [
        {"type": "MultiPolygon", "coordinates": [[square, hole], [triangle]]},
        {"type": "MultiLineString", "coordinates": [[[20, 0], [21, 0]], [[30, 0], [31, 0]]]},
        {"type": "Point", "coordinates": [0, 0]},
    ]  # fmt: skip
    path.write_text(json.dumps({"type": "GeometryCollection", "geometries": geometries}))
    shape = ss.read(path)
    assert [contour.closed for contour in shape] == [True, True, True, False, False]
    assert shape.parents == (-1, 0, -1, -1, -1)


def operators(data):
    """Content stream of the only page, as tokens."""
    stream = re.search(rb"stream\n(.*?)\nendstream", data, re.DOTALL).group(1)
    return zlib.decompress(stream).decode("ascii").split()


def test_pdf_holds_the_exact_beziers():
    fit = fit_of(blob())
    data = pdf.encode(Drawing([fit], unit="pt"))
    tokens = operators(data)
    pieces = fit.spline.beziers().points
    assert tokens.count("c") == len(pieces)
    assert tokens[-1] == "f*"
    numbers = [float(token) for token in tokens[: tokens.index("h")] if token[-1].isdigit()]
    points = np.array(numbers[3:]).reshape(-1, 2)  # after width, join and cap
    wanted = np.concatenate([pieces[0][:1], pieces[:, 1:].reshape(-1, 2)])
    offset = points[0] - wanted[0]
    assert np.abs(points - wanted - offset).max() <= 1.1 * 10.0**-pdf.DECIMALS
    assert data == pdf.encode(Drawing([fit], unit="pt"))


def test_pdf_tables_point_at_the_objects():
    data = pdf.encode(nested())
    table = int(re.search(rb"startxref\n(\d+)", data).group(1))
    assert data[table : table + 4] == b"xref"
    for number, start in enumerate(re.findall(rb"(\d{10}) 00000 n", data), start=1):
        assert data[int(start) :].startswith(b"%d 0 obj" % number)
    assert operators(data).count("f*") == 2  # the ring, the island in its hole
    assert operators(data).count("S") == 1
    assert operators(pdf.encode(Drawing([fit_of(wave())])))[-1] == "S"


def test_png_covers_the_area():
    fit = fit_of(blob())
    image = Image.open(io.BytesIO(picture.encode(Drawing([fit]), pixels=400)))
    assert max(image.size) == 400
    dark = (255 - np.asarray(image, dtype=float)).sum() / 255
    outline = fit.spline(np.linspace(0, 1, 4000))
    size = np.ptp(outline, axis=0)
    pixel = max(size) * (1 + 2 * (picture.MARGIN + picture.STROKE)) / 400
    # The polygon covers each pixel to one sixteenth; along the border the rest averages out.
    border = len(outline) and np.hypot(*np.diff(outline, axis=0).T).sum() / pixel
    assert abs(dark * pixel**2 - abs(signed_area(outline))) <= border * pixel**2 / 4
    assert image.getpixel((0, 0)) == 255


def test_png_of_open_curves_and_holes():
    ring = np.asarray(Image.open(io.BytesIO(picture.encode(nested()))))
    assert 0 < (ring < 128).mean() < 0.9
    line = np.asarray(Image.open(io.BytesIO(picture.encode(Drawing([fit_of(wave())])))))
    assert 0 < (line < 128).mean() < 0.1
    for wrong in (0, 1e9, 3.5, "many"):
        with pytest.raises(ss.InvalidInputError, match="pixels must be a whole number"):
            picture.encode(nested(), pixels=wrong)


@pytest.mark.parametrize("drawing", [nested(), Drawing([fit_of(wave(degree=4))], unit="mm")])
def test_the_python_snippet_makes_the_same_bits(tmp_path, drawing):
    path = tmp_path / "curves.py"
    ss.write(path, drawing)
    curves = runpy.run_path(str(path))["curves"]
    u = np.linspace(0, 1, 101)
    for fit, curve in zip(drawing, curves, strict=True):
        assert_array_equal(curve(u), fit.curve(u))
        assert_array_equal(curve.t, fit.curve.t)


def test_sample_bytes_are_the_same():
    assert csv.encode(nested()) == csv.encode(nested())
    assert geojson.encode(nested()) == geojson.encode(nested())
