"""GeoJSON (RFC 7946): polygons with holes and lines, of points at a chordal tolerance."""

from __future__ import annotations

import json
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import (
    FormatError,
    MissingReferenceWarning,
    ShapesplineError,
    caller_level,
)
from shapespline.formats.geo import geometries, plain_lists
from shapespline.geometry import parents_of
from shapespline.values import Contour, Shape

if TYPE_CHECKING:
    from pathlib import Path

    from shapespline.typing import FloatArray
    from shapespline.values import Drawing

# Longitude and latitude lie between these and their negatives, degrees (RFC 7946, section 4).
LAST_DEGREES = (180.0, 90.0)


def encode(drawing: Drawing, *, chord: float | None = None) -> bytes:
    """Text of a feature collection: one feature for each outline with its holes.

    Parameters
    ----------
    drawing : Drawing
    chord : float, optional
        Largest distance between the curve and the polyline written, data units; 1e-4 of the box
        diagonal if not given. Straight pieces are two points whatever it is.

    Returns
    -------
    bytes
        UTF-8. Outer rings run counter-clockwise, holes clockwise; positions repeat the first one
        at the end, as RFC 7946 wants it. The coordinate reference of the drawing is the member
        ``crs`` of GeoJSON 2008, which programs still write and read; RFC 7946 has none.

    Raises
    ------
    InvalidInputError
        If ``chord`` is not positive, or absurdly small.

    Warns
    -----
    MissingReferenceWarning
        If the drawing names no coordinate reference and its points cannot be degrees, for which
        programs will take them.
    """
    features = [
        {"type": "Feature", "properties": {}, "geometry": geometry}
        for geometry in geometries(drawing, chord)
    ]
    document: dict[str, Any] = {"type": "FeatureCollection"}
    if drawing.reference is None:
        _say_of_reference(drawing)
    else:
        document["crs"] = {"type": "name", "properties": {"name": drawing.reference}}
    text = json.dumps({**document, "features": features})
    return f"{text}\n".encode()


def _say_of_reference(drawing: Drawing) -> None:
    """Warn where points without a coordinate reference cannot be longitude and latitude."""
    if len(drawing) and np.any(np.abs(drawing.bounds).reshape(-1, 2) > LAST_DEGREES):
        warnings.warn(
            "the drawing names no coordinate reference, so programs take its points for longitude"
            " and latitude: read it with one (ss.Shape(contours, reference='EPSG:25832')), or set"
            " that of the layer there",
            MissingReferenceWarning,
            stacklevel=caller_level(),
        )


def read(path: Path, *, closed: bool | None = None) -> Shape:
    """Lines and polygons of a GeoJSON file, polygons with their holes.

    Geometries, features and collections of them; points and what else there is are skipped, third
    coordinates too.

    Parameters
    ----------
    path : Path
    closed : bool, optional
        Whether lines are closed; if not given, those whose last position is the first. Polygons
        are closed.

    Raises
    ------
    FormatError
        If the file is no JSON, no GeoJSON, or holds neither a line nor a polygon.
    InvalidInputError
        Naming the feature, if a line or ring has too few points or one that is no finite number.
    """
    try:
        held = json.loads(path.read_bytes())
    except (ValueError, RecursionError) as error:
        raise FormatError(f"no JSON: {error}") from error
    return shape_of(held, closed, _said_reference(held))


def shape_of(held: Any, closed: bool | None, reference: str | None) -> Shape:
    """Lines and polygons of GeoJSON as an object.

    Raises
    ------
    FormatError
        If it is no GeoJSON, or holds neither a line nor a polygon.
    """
    contours = _contours(held, closed)
    if not contours:
        raise FormatError("no line and no polygon; points alone make no outline")
    return Shape(contours, parents_of(contours), reference=reference)


def _said_reference(held: Any) -> str | None:
    """The coordinate reference that a document of GeoJSON 2008 names."""
    try:
        name = held["crs"]["properties"]["name"]
    except (KeyError, TypeError):
        return None
    return name if isinstance(name, str) and name.strip() else None


def _contours(value: Any, closed: bool | None) -> list[Contour]:
    """Every line and every ring of a polygon."""
    if not isinstance(value, dict) or not isinstance(value.get("type"), str):
        raise FormatError("no GeoJSON: an object with a type was expected")
    kind = value["type"]
    if kind == "FeatureCollection":
        features = enumerate(_list(value, "features"), start=1)
        return [one for number, held in features for one in _of_feature(number, held, closed)]
    if kind == "Feature":
        geometry = value.get("geometry")
        return [] if geometry is None else _contours(geometry, closed)
    if kind == "GeometryCollection":
        return [one for held in _list(value, "geometries") for one in _contours(held, closed)]
    if kind == "LineString":
        return [_line(plain_lists(value.get("coordinates")), kind, closed)]
    if kind == "MultiLineString":
        return [_line(positions, kind, closed) for positions in _list(value, "coordinates")]
    if kind == "Polygon":
        return [Contour(_points(ring, kind), True) for ring in _list(value, "coordinates")]
    if kind == "MultiPolygon":
        polygons = _list(value, "coordinates")
        if not all(isinstance(polygon, list) for polygon in polygons):
            raise FormatError("coordinates of a MultiPolygon must be lists of rings")
        return [Contour(_points(ring, kind), True) for rings in polygons for ring in rings]
    if kind not in ("Point", "MultiPoint"):
        raise FormatError(f"no GeoJSON: unknown type {kind[:40]!r}")
    return []


def _of_feature(number: int, feature: Any, closed: bool | None) -> list[Contour]:
    """Contours of a feature of a collection; errors name it."""
    try:
        return _contours(feature, closed)
    except ShapesplineError as error:
        ident = feature.get("id") if isinstance(feature, dict) else None
        said = f" (id {str(ident)[:40]!r})" if isinstance(ident, str | int) else ""
        raise type(error)(f"feature {number}{said}: {error}") from error


def _line(positions: Any, kind: str, closed: bool | None) -> Contour:
    """A line, closed if it says so by its ends; one there and back between two points is not."""
    points = _points(positions, kind)
    if closed is None:
        ring = len(points) > 3 and bool((points[0] == points[-1]).all())
        closed = ring and len(np.unique(points, axis=0)) > 2
    return Contour(points, closed)


def _list(value: dict[str, Any], name: str) -> list[Any]:
    items = plain_lists(value.get(name)) if name == "coordinates" else value.get(name)
    if not isinstance(items, list | tuple):
        raise FormatError(f"{name} of a {value['type']} must be a list")
    return list(items)


def _points(positions: Any, kind: str) -> FloatArray:
    """Positions as an (n, 2) array."""
    sound = isinstance(positions, list) and all(
        isinstance(position, list)
        and len(position) >= 2
        and all(isinstance(x, int | float) and not isinstance(x, bool) for x in position[:2])
        for position in positions
    )
    if not sound:
        raise FormatError(f"coordinates of a {kind} must be lists of two or three numbers")
    try:
        return np.array([position[:2] for position in positions], dtype=float).reshape(-1, 2)
    except OverflowError as error:
        raise FormatError(f"a coordinate of a {kind} is no finite number") from error
