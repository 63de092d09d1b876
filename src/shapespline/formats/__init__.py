"""Formats: one file and one line of the registry for each."""

from shapespline.formats.atomic import check_target, write_atomically
from shapespline.formats.child_process import ChildProcess
from shapespline.formats.compared import compare
from shapespline.formats.csv import columns_of
from shapespline.formats.geo import geometry_of, geopandas_series, shapely_geometry
from shapespline.formats.pens import draw_with_pen
from shapespline.formats.pieces import bezier
from shapespline.formats.preview import html_preview, svg_preview
from shapespline.formats.registry import (
    FORMATS,
    Format,
    check_output,
    read,
    read_options,
    readable,
    writable,
    write,
)

__all__ = [
    "FORMATS",
    "ChildProcess",
    "Format",
    "bezier",
    "check_output",
    "check_target",
    "columns_of",
    "compare",
    "draw_with_pen",
    "geometry_of",
    "geopandas_series",
    "html_preview",
    "read",
    "read_options",
    "readable",
    "shapely_geometry",
    "svg_preview",
    "writable",
    "write",
    "write_atomically",
]
