"""A curve within a tolerance, and all that its caller is promised.

Many points are fitted in passes; curves that cross where their data do not come apart; points that
weigh more are kept closer.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.large import fit_all_in_passes
from shapespline.tolerance import checked_corners, checked_held, fit_within
from shapespline.uncrossing import uncrossed
from shapespline.weighting import Limits, weighted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.contour import Contour
    from shapespline.drawing import Fit
    from shapespline.progress import Watch
    from shapespline.refitting import Tangents
    from shapespline.tolerance import Wanted
    from shapespline.typing import ArrayLike, IntArray

# So many points are fitted in passes over chunks, where nothing asks for more.
MANY_POINTS = 50_000


def fit_promised(
    contour: Contour,
    tolerance: float,
    wanted: Wanted,
    weights: ArrayLike | None,
    watch: Watch,
) -> Fit:
    """The fit of `fit_curve` within a tolerance in data units."""
    corners, held = checked_corners(wanted.corners, len(contour)), wanted.held
    plain = not (held.anything or wanted.symmetric)
    limits = None if weights is None else Limits.of(weights, contour, tolerance)
    apart = plain and wanted.form != "spline"

    def whole(within: float, through: IntArray | None = None) -> Fit:
        holding = held
        if through is not None:
            more = checked_held(contour, "free", None, np.union1d(held.through, through))
            holding = held._replace(ends=held.ends or more.ends, through=more.through)
        return fit_within(contour, within, wanted._replace(held=holding), watch)

    def closer(part: Contour, within: float, tangents: Tangents, through: Sequence[int]) -> Fit:
        free = isinstance(corners, str) and corners == "free"
        ends = checked_held(part, "fixed", None if free else tangents, through or None)
        among = corners if corners is None or isinstance(corners, str) else "auto"
        asked = wanted._replace(corners=among, held=ends, symmetric=False)
        return fit_within(part, within, asked, watch)

    found = None
    if len(contour) >= MANY_POINTS and plain:
        found = fit_all_in_passes(contour, tolerance, wanted, watch)
    if found is None or not (found.kept or watch.ended_as):
        found = whole(tolerance)
        if apart and not watch.ended_as:
            found = uncrossed([contour], [found], closer)[0]
    if limits is None:
        return found
    return weighted(found, limits, closer if apart else None, whole)
