"""Geometries of other libraries, by the protocol ``__geo_interface__`` (GeoJSON as objects)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import require
from shapespline.formats.cubics import groups
from shapespline.geometry import as_drawing, sampled, signed_area

if TYPE_CHECKING:
    from shapespline.geometry import Drawable
    from shapespline.typing import FloatArray
    from shapespline.values import Drawing, Fit

# What several geometries of one kind are together.
TOGETHER = {"Polygon": "MultiPolygon", "LineString": "MultiLineString"}


def geometry_of(value: Drawable, chord: float | None = None) -> dict[str, Any]:
    """One GeoJSON geometry of all outlines.

    Parameters
    ----------
    value : Drawing, Fit, Shape or Contour
    chord : float, optional
        Largest distance between a curve and its points, data units; 1e-4 of the box diagonal if not
        given.

    Examples
    --------
    >>> from shapespline.values import Contour
    >>> geometry_of(Contour([(0, 0), (1, 0), (1, 1)], closed=False))["type"]
    'LineString'
    """
    found = geometries(as_drawing(value), chord)
    kinds = {geometry["type"] for geometry in found}
    if len(found) == 1:
        return found[0]
    if len(kinds) > 1:
        return {"type": "GeometryCollection", "geometries": found}
    coordinates = [geometry["coordinates"] for geometry in found]
    return {"type": TOGETHER[kinds.pop()], "coordinates": coordinates}


def geometries(drawing: Drawing, chord: float | None) -> list[dict[str, Any]]:
    """A geometry for each outline with its holes; outer rings run counter-clockwise."""
    found = []
    for group in groups(drawing):
        first = drawing.fits[group[0]]
        if drawing.is_area(group[0]):
            rings = [
                _ring(drawing.fits[index], chord, counter_clockwise=index == group[0])
                for index in group
            ]
            found.append({"type": "Polygon", "coordinates": rings})
        else:
            points = _points(first, chord)
            if first.closed:  # a stroke that comes back to where it began
                points = np.concatenate([points, points[:1]])
            found.append({"type": "LineString", "coordinates": points.tolist()})
    return found


def _points(fit: Fit, chord: float | None) -> FloatArray:
    """Points of a curve, a closed one's first not repeated; those of a polyline as they are."""
    if fit.degree == 1 and chord is None:
        points = fit.spline.control_points
        return points[:-1] if fit.closed and (points[0] == points[-1]).all() else points
    return sampled(fit.spline, chord, longest=np.inf)[0].points


def _ring(fit: Fit, chord: float | None, *, counter_clockwise: bool) -> list[list[float]]:
    points = _points(fit, chord)
    if (signed_area(points) > 0) != counter_clockwise:
        points = points[::-1]
    return [*points.tolist(), points[0].tolist()]


def shapely_geometry(value: Drawable, chord: float | None = None) -> Any:
    """What `Exchanged.to_shapely` returns."""
    require("shapely", "geo", "to_shapely needs")
    from shapely.geometry import shape

    return shape(geometry_of(value, chord))


def geopandas_series(value: Drawable, chord: float | None = None) -> Any:
    """What `Exchanged.to_geopandas` returns."""
    require("geopandas", "geo", "to_geopandas needs")
    from geopandas import GeoSeries
    from shapely.geometry import shape

    drawing = as_drawing(value)
    return GeoSeries([shape(one) for one in geometries(drawing, chord)], crs=drawing.reference)


def reference_of(value: object) -> str | None:
    """The coordinate reference that an object of geopandas or the like says, as text."""
    reference = getattr(value, "crs", None)
    if reference is None:
        return None
    said = getattr(reference, "to_string", None)
    return str(reference if said is None else said())


def plain_lists(value: Any) -> Any:
    """Coordinates as lists, whatever sequences they are."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    return [plain_lists(item) for item in value] if isinstance(value, tuple | list) else value
