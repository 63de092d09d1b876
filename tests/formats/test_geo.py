"""Geometries of shapely and geopandas in and out, with their coordinate reference."""

from __future__ import annotations

import json
from types import SimpleNamespace

import numpy as np
import pytest

import shapespline as ss

shapely = pytest.importorskip("shapely")

REFERENCE = "EPSG:25832"


@pytest.fixture(scope="module")
def lake():
    """A disc with an island, and a way."""
    disc = shapely.Point(500, 5000).buffer(10, 64)
    lake = disc.difference(shapely.Point(502, 5001).buffer(3, 64))
    return lake, shapely.LineString([(480, 4990), (490, 4995), (500, 4985)])


@pytest.mark.slow
def test_polygons_keep_their_holes_and_points(lake):
    shape = ss.read(lake[0])
    assert shape.parents in [(-1, 0), (1, -1)]
    assert shape.to_shapely().equals(lake[0])
    assert shape.reference is None
    fit = ss.fit_shape(shape, tolerance=0.05)
    found = shapely.geometry.shape(fit)  # by __geo_interface__ alone
    assert (found.geom_type, found.is_valid, len(found.interiors)) == ("Polygon", True, 1)
    # What the curve keeps, what its points are off it, and the sampling of shapely's measure.
    assert shapely.hausdorff_distance(found, lake[0], densify=0.01) < 0.05 + 1e-4 * 30 + 0.05


def test_one_fit_and_one_contour_are_geometries_too(lake):
    contour = ss.Contour(np.array(lake[1].coords), closed=False)
    assert shapely.geometry.shape(contour).equals(lake[1])
    assert ss.fit_curve(contour, tolerance=0.01).to_shapely(chord=0.1).geom_type == "LineString"
    kinds = {"Polygon", "LineString"}
    shape = ss.read(shapely.GeometryCollection(lake))
    assert {part.geom_type for part in shape.to_shapely().geoms} == kinds
    two = ss.read(shapely.MultiLineString([lake[1], shapely.affinity.translate(lake[1], 50)]))
    assert two.to_shapely().geom_type == "MultiLineString"


@pytest.mark.slow
def test_a_coordinate_reference_goes_all_the_way(lake, tmp_path):
    geopandas = pytest.importorskip("geopandas")
    frame = geopandas.GeoDataFrame({"name": ["lake", "way"]}, geometry=list(lake), crs=REFERENCE)
    drawing = ss.fit_shape(ss.read(frame), tolerance=0.05, character="fewest")
    assert drawing.reference == REFERENCE
    series = drawing.to_geopandas()
    assert series.crs.to_string() == REFERENCE
    assert sorted(series.geom_type) == ["LineString", "Polygon"]
    for name in ("lake.geojson", "lake.json"):
        ss.write(tmp_path / name, drawing)
        assert ss.read(tmp_path / name).reference == REFERENCE
    assert geopandas.read_file(tmp_path / "lake.geojson").crs.to_string() == REFERENCE
    assert drawing.offset(0.5).reference == REFERENCE
    # Other numbers are no places of it.
    assert ss.read(frame, scale=2.0).reference is None
    assert drawing.transformed([[1, 0, 5], [0, 1, 0]]).reference is None


def test_no_reference_is_written_where_none_is_known(lake, tmp_path):
    path, way = tmp_path / "way.geojson", ss.read(lake[1])
    with pytest.warns(ss.MissingReferenceWarning, match="longitude and latitude") as said:
        ss.write(path, way)
    assert said[0].filename == __file__
    assert "crs" not in json.loads(path.read_text())


def test_points_that_may_be_degrees_need_no_reference(lake, tmp_path):
    points = ss.read(lake[1]).contours[0].points
    ss.write(tmp_path / "way.geojson", ss.Contour(points * 80.0 / np.abs(points).max()))
    assert len(ss.read(tmp_path / "way.geojson")) == 1


@pytest.mark.slow
def test_a_table_gets_its_fitted_geometries_back(lake):
    geopandas = pytest.importorskip("geopandas")
    frame = geopandas.GeoDataFrame({"name": ["lake", "way"]}, geometry=list(lake), crs=REFERENCE)
    fitted = frame.set_geometry(
        [ss.fit_shape(ss.read(one), tolerance=0.05).to_shapely() for one in frame.geometry],
        crs=frame.crs,
    )
    assert fitted.name.tolist() == ["lake", "way"]
    assert fitted.crs == frame.crs
    assert abs(fitted.area - frame.area).max() < 0.05 * frame.length.max()


@pytest.mark.parametrize(
    ("held", "sentence"),
    [
        ({"type": "Point", "coordinates": (0, 0)}, "points alone make no outline"),
        ({"type": "Polygon", "coordinates": (((0, 0), (1, np.nan), (1, 1)),)}, "finite"),
        ({"type": "LineString", "coordinates": (("a", 0), (1, 1))}, "lists of two or three"),
        ({"type": "Blob"}, "unknown type 'Blob'"),
        (3, "no GeoJSON"),
    ],
)
def test_what_is_no_outline_is_said(held, sentence):
    with pytest.raises(ss.ShapesplineError, match=sentence):
        ss.read(SimpleNamespace(__geo_interface__=held))


@pytest.mark.parametrize(
    ("points", "closed"),
    [
        ([(0, 0), (10, 0), (5, 8)], False),
        ([(0, 0), (10, 0), (10, 10), (0, 10)], False),
        ([(0, 0), (10, 0), (10, 10), (0, 10), (0, 0.1)], False),
        ([(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)], True),
        ([(0, 0), (10, 0), (5, 8), (0, 0)], True),
        ([(0, 0), (10, 0), (0, 0)], False),
        ([(0, 0), (10, 0), (10, 0), (0, 0)], False),
    ],
)
@pytest.mark.filterwarnings("ignore:dropped 1 of 4 points")
def test_a_line_is_closed_if_its_last_position_is_the_first(tmp_path, points, closed):
    (tmp_path / "a.geojson").write_text(json.dumps({"type": "LineString", "coordinates": points}))
    for source in (tmp_path / "a.geojson", shapely.LineString(points)):
        (contour,) = ss.read(source).contours
        assert contour.closed == closed
        assert not ss.read(source, closed=False).contours[0].closed
    if len(set(points)) > 2:
        assert ss.read(shapely.LineString(points), closed=True).contours[0].closed


@pytest.mark.filterwarnings("ignore::shapespline.errors.ArcsAsCurvesWarning")
def test_an_open_curve_with_near_ends_comes_back_open(tmp_path):
    turn = np.linspace(0.01, 2 * np.pi - 0.01, 200)
    points = np.column_stack([np.cos(turn), np.sin(turn)])
    fit = ss.fit_curve(ss.Contour(points, closed=False), tolerance=0.01)
    ss.write(tmp_path / "a.geojson", fit)
    assert not ss.read(tmp_path / "a.geojson").contours[0].closed


@pytest.mark.parametrize("ring", [[], [(1, 1)] * 4, [(0, 0), (1, 0), (0, 0)], [(0, 0), ("a", 1)]])
@pytest.mark.filterwarnings("ignore:dropped")
def test_the_feature_that_cannot_be_read_is_named(ring):
    rings = [[(0, 0), (4, 0), (4, 4), (0, 0)], ring]
    features = [
        {"type": "Feature", "id": ident, "geometry": {"type": "Polygon", "coordinates": [ring]}}
        for ident, ring in zip([7, "lake"], rings, strict=True)
    ]
    held = {"type": "FeatureCollection", "features": features}
    with pytest.raises(ss.ShapesplineError, match=r"feature 2 \(id 'lake'\): "):
        ss.read(SimpleNamespace(__geo_interface__=held))


def test_options_and_arguments_are_checked(lake):
    with pytest.raises(ss.InvalidInputError, match="level is not an option for a LineString"):
        ss.read(lake[1], level=3)
    with pytest.raises(ss.InvalidInputError, match="reference must name"):
        ss.Shape(ss.read(lake[1]).contours, reference=4326)
    with pytest.raises(ss.InvalidInputError, match="must be a positive length"):
        ss.read(lake[1]).to_shapely(chord=-1)


def test_a_geometry_where_points_belong_is_told_its_way(lake):
    with pytest.raises(ss.InvalidInputError, match=r"got a geometry \(Polygon\); read it first"):
        ss.fit_curve(lake[0], tolerance=1)
    with pytest.raises(ss.InvalidInputError, match=r"got Polygon; make one .* read a geometry"):
        ss.fit_shape(lake[0], tolerance=1)


def test_crossing_polygons_are_read_as_they_are():
    bow = shapely.Polygon([(0, 0), (4, 4), (4, 0), (0, 4)])
    assert not bow.is_valid
    fit = ss.fit_shape(ss.read(bow), tolerance=0.01)
    assert fit.fits[0].kept
