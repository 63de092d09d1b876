"""Objects of other libraries that are read like files: geometries, and glyphs of fonts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from shapespline.formats.geo import reference_of
from shapespline.formats.geojson import shape_of
from shapespline.formats.known import known_options
from shapespline.formats.pens import outlines_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from shapespline.geometry import Outlines
    from shapespline.values import Shape


def read_object(source: object, options: Mapping[str, object]) -> Shape | Outlines | None:
    """What a geometry or a glyph holds; None if the object is neither.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> line = {"type": "LineString", "coordinates": ((0, 0), (1, 2), (3, 4))}
    >>> read_object(SimpleNamespace(__geo_interface__=line), {})
    Shape(1 contour, 3 points)
    """
    name = f"a {type(source).__name__}"
    if isinstance(source, str | bytes):
        return None
    if hasattr(source, "__geo_interface__"):
        return _geometry(source, **known_options(name, "geometries", _geometry, options))
    if callable(getattr(source, "draw", None)):
        return _glyph(source, **known_options(name, "glyphs", _glyph, options))
    return None


def _geometry(source: Any, *, closed: Any = None) -> Shape:
    return shape_of(source.__geo_interface__, closed, reference_of(source))


def _glyph(source: Any, *, glyph_set: Any = None) -> Outlines:
    return outlines_of(source, glyph_set)
