"""The pieces engine: lines, Beziers and small splines between nodes."""

from shapespline.engines.pieces.constraints import Constraints
from shapespline.engines.pieces.engine import (
    ROUGH_PART,
    SECTION_DEGREE,
    SHARP_TURN,
    PiecesResult,
    fit_pieces,
    verified_pieces,
)
from shapespline.engines.pieces.fallbacks import through_all
from shapespline.engines.pieces.mirrored import fit_mirrored
from shapespline.engines.pieces.observed import fit_observed
from shapespline.engines.pieces.problem import PiecesProblem
from shapespline.engines.pieces.search import Effort

__all__ = [
    "ROUGH_PART",
    "SECTION_DEGREE",
    "SHARP_TURN",
    "Constraints",
    "Effort",
    "PiecesProblem",
    "PiecesResult",
    "fit_mirrored",
    "fit_observed",
    "fit_pieces",
    "through_all",
    "verified_pieces",
]
