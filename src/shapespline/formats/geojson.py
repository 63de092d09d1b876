"""GeoJSON (RFC 7946): polygons with holes and lines, of points at a chordal tolerance."""

from __future__ import annotations

import json
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import FormatError, MissingReferenceWarning, caller_level
from shapespline.formats.geo import geometries, plain_lists
from shapespline.geometry import parents_of
from shapespline.values import Contour, Shape

if TYPE_CHECKING:
    from collections.abc import Iterator
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
        Whether lines are closed; found from their ends if not given. Polygons are closed.

    Raises
    ------
    FormatError
        If the file is no JSON, no GeoJSON, or holds neither a line nor a polygon.
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
    found = list(_lines(held))
    if not found:
        raise FormatError("no line and no polygon; points alone make no outline")
    contours = [Contour(points, True if ring else closed) for points, ring in found]
    return Shape(contours, parents_of(contours), reference=reference)


def _said_reference(held: Any) -> str | None:
    """The coordinate reference that a document of GeoJSON 2008 names."""
    try:
        name = held["crs"]["properties"]["name"]
    except (KeyError, TypeError):
        return None
    return name if isinstance(name, str) and name.strip() else None


def _lines(value: Any) -> Iterator[tuple[FloatArray, bool]]:
    """Points of every line, and whether it is the ring of a polygon."""
    if not isinstance(value, dict) or not isinstance(value.get("type"), str):
        raise FormatError("no GeoJSON: an object with a type was expected")
    kind = value["type"]
    if kind == "FeatureCollection":
        for feature in _list(value, "features"):
            yield from _lines(feature)
    elif kind == "Feature":
        if value.get("geometry") is not None:
            yield from _lines(value["geometry"])
    elif kind == "GeometryCollection":
        for geometry in _list(value, "geometries"):
            yield from _lines(geometry)
    elif kind == "LineString":
        yield _points(plain_lists(value.get("coordinates")), kind), False
    elif kind in ("MultiLineString", "Polygon"):
        for line in _list(value, "coordinates"):
            yield _points(line, kind), kind == "Polygon"
    elif kind == "MultiPolygon":
        for polygon in _list(value, "coordinates"):
            if not isinstance(polygon, list):
                raise FormatError("coordinates of a MultiPolygon must be lists of rings")
            for ring in polygon:
                yield _points(ring, kind), True
    elif kind not in ("Point", "MultiPoint"):
        raise FormatError(f"no GeoJSON: unknown type {kind[:40]!r}")


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
