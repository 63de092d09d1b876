"""GeoJSON (RFC 7946): polygons with holes and lines, of points at a chordal tolerance."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import FormatError
from shapespline.formats.cubics import groups
from shapespline.geometry import parents_of, sampled, signed_area
from shapespline.values import Contour, Shape

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from shapespline.typing import FloatArray
    from shapespline.values import Drawing, Fit


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
        at the end, as RFC 7946 wants it.

    Raises
    ------
    InvalidInputError
        If ``chord`` is not positive, or absurdly small.
    """
    features = []
    for group in groups(drawing):
        if drawing.fits[group[0]].closed:
            rings = [
                _ring(drawing.fits[index], chord, counter_clockwise=index == group[0])
                for index in group
            ]
            geometry: dict[str, Any] = {"type": "Polygon", "coordinates": rings}
        else:
            contour, _ = sampled(drawing.fits[group[0]].spline, chord)
            geometry = {"type": "LineString", "coordinates": contour.points.tolist()}
        features.append({"type": "Feature", "properties": {}, "geometry": geometry})
    text = json.dumps({"type": "FeatureCollection", "features": features})
    return f"{text}\n".encode()


def _ring(fit: Fit, chord: float | None, *, counter_clockwise: bool) -> list[list[float]]:
    contour, _ = sampled(fit.spline, chord)
    points = contour.points
    if (signed_area(points) > 0) != counter_clockwise:
        points = points[::-1]
    return [*points.tolist(), points[0].tolist()]


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
    found = list(_lines(held))
    if not found:
        raise FormatError("no line and no polygon in the file; points alone make no outline")
    contours = [Contour(points, True if ring else closed) for points, ring in found]
    return Shape(contours, parents_of(contours))


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
        yield _points(value.get("coordinates"), kind), False
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
    if not isinstance(value.get(name), list):
        raise FormatError(f"{name} of a {value['type']} must be a list")
    return list(value[name])


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
