"""The pieces engine: lines, Beziers and small splines between nodes."""

from shapespline.engines.pieces.constraints import Constraints, pinned_exactly
from shapespline.engines.pieces.end_tangents import with_ends_turned
from shapespline.engines.pieces.engine import (
    PIECE_DEGREE,
    TOLERANCE_FACTORS,
    in_data,
    search_pieces,
)
from shapespline.engines.pieces.fallbacks import (
    Chords,
    chords_found,
    drawn_straight,
    drawn_with_lines,
    in_facets,
    search_lines,
    through_all,
)
from shapespline.engines.pieces.mirrored import MirroredHalf
from shapespline.engines.pieces.observed import fit_observed
from shapespline.engines.pieces.problem import PiecesProblem
from shapespline.engines.pieces.search import n_points_of

__all__ = [
    "PIECE_DEGREE",
    "TOLERANCE_FACTORS",
    "Chords",
    "Constraints",
    "MirroredHalf",
    "PiecesProblem",
    "chords_found",
    "drawn_straight",
    "drawn_with_lines",
    "fit_observed",
    "in_data",
    "in_facets",
    "n_points_of",
    "pinned_exactly",
    "search_lines",
    "search_pieces",
    "through_all",
    "with_ends_turned",
]
