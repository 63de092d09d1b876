"""How closely arcs follow a curve in formats for machines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.errors import InvalidInputError
from shapespline.validation import is_number

if TYPE_CHECKING:
    from shapespline.values import Fit

# Distance between a curve and its arcs, of the tolerance that the curve was fitted to, if no other
# is asked for; but not less than this part of the size.
ARC_PART, ARC_LEAST = 0.25, 1e-6


def arc_tolerance_of(fit: Fit, asked: float | None) -> float:
    """The distance that was asked for, or a part of the tolerance of the fit; data units."""
    if asked is None:
        return max(ARC_PART * fit.tolerance, ARC_LEAST * fit.contour.box_diagonal)
    if not (is_number(asked) and 0 < asked < float("inf")):
        raise InvalidInputError(f"arc_tolerance must be a positive length, got {asked!r}")
    return float(asked)
