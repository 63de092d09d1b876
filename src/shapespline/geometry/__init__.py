"""Geometry: pure functions on values."""

from shapespline.geometry.bands import confidence_band
from shapespline.geometry.biarcs import arc_polyline
from shapespline.geometry.comparison import Comparison, Curves, compare
from shapespline.geometry.distances import (
    FLOOR,
    CentredCurve,
    Distances,
    reverse_distance,
    rounding,
    two_sided_distance,
)
from shapespline.geometry.exact import Outlines, exact_drawing, exact_fit
from shapespline.geometry.flattening import chords, sampled
from shapespline.geometry.hooks import chords_for_hooks, hooks
from shapespline.geometry.intersections import crossing_pairs, self_crossings
from shapespline.geometry.joining import elevated, joined, turn_between, turns_of
from shapespline.geometry.lines_and_arcs import bulge_piece, bulged, lines_and_arcs
from shapespline.geometry.measures import Box, bounds, contains, enclosed_area, evenly_spaced
from shapespline.geometry.moving import (
    reversed_fit,
    split_fit,
    transformed_drawing,
    transformed_fit,
)
from shapespline.geometry.nearest import (
    PointsByX,
    distance_from_chords,
    nearest,
    nearest_points,
    nondecreasing,
)
from shapespline.geometry.nesting import (
    all_containing,
    containing,
    holding,
    parents_of,
    signed_area,
)
from shapespline.geometry.normal_motion import curve_motion, unit_normals
from shapespline.geometry.offsetting import OffsetLine, Source, offset_lines
from shapespline.geometry.parametrization import PARAMETRIZATIONS, greville_matched, parametrize
from shapespline.geometry.polygons import Drawable, as_drawing, polygon_drawing, polyline_curve
from shapespline.geometry.reversal import backwards, reversed_curve
from shapespline.geometry.scaling import in_unit, scaled

__all__ = [
    "FLOOR",
    "PARAMETRIZATIONS",
    "Box",
    "CentredCurve",
    "Comparison",
    "Curves",
    "Distances",
    "Drawable",
    "OffsetLine",
    "Outlines",
    "PointsByX",
    "Source",
    "all_containing",
    "arc_polyline",
    "as_drawing",
    "backwards",
    "bounds",
    "bulge_piece",
    "bulged",
    "chords",
    "chords_for_hooks",
    "compare",
    "confidence_band",
    "containing",
    "contains",
    "crossing_pairs",
    "curve_motion",
    "distance_from_chords",
    "elevated",
    "enclosed_area",
    "evenly_spaced",
    "exact_drawing",
    "exact_fit",
    "greville_matched",
    "holding",
    "hooks",
    "in_unit",
    "joined",
    "lines_and_arcs",
    "nearest",
    "nearest_points",
    "nondecreasing",
    "offset_lines",
    "parametrize",
    "parents_of",
    "polygon_drawing",
    "polyline_curve",
    "reverse_distance",
    "reversed_curve",
    "reversed_fit",
    "rounding",
    "sampled",
    "scaled",
    "self_crossings",
    "signed_area",
    "split_fit",
    "transformed_drawing",
    "transformed_fit",
    "turn_between",
    "turns_of",
    "two_sided_distance",
    "unit_normals",
]
