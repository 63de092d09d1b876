"""A curve within a tolerance, and all that its caller is promised.

Many points are fitted in passes; curves that cross where their data do not come apart; points that
weigh more are kept closer.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.fitting.large import fit_all_in_passes
from shapespline.fitting.repair.crossings import uncrossed
from shapespline.fitting.repair.weights import Limits, weighted
from shapespline.fitting.within import checked_corners, checked_held, fit_within

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.fitting.repair.refit import Tangents
    from shapespline.fitting.within import Wanted
    from shapespline.monitor import Monitor
    from shapespline.typing import ArrayLike, IntArray
    from shapespline.values import Contour, Fit

# So many points are fitted in passes over chunks, where nothing asks for more.
MANY_POINTS = 50_000


def fit_promised(
    contour: Contour,
    tolerance: float,
    wanted: Wanted,
    weights: ArrayLike | None,
    monitor: Monitor,
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
        return fit_within(contour, within, wanted._replace(held=holding), monitor)

    def closer(part: Contour, within: float, tangents: Tangents, through: Sequence[int]) -> Fit:
        free = isinstance(corners, str) and corners == "free"
        ends = checked_held(part, "fixed", None if free else tangents, through or None)
        among = corners if corners is None or isinstance(corners, str) else "auto"
        asked = wanted._replace(corners=among, held=ends, symmetric=False)
        return fit_within(part, within, asked, monitor)

    found = None
    if len(contour) >= MANY_POINTS and plain:
        found = fit_all_in_passes(contour, tolerance, wanted, monitor)
    if found is None or not (found.kept or monitor.ended):
        found = whole(tolerance)
        if apart and not monitor.ended:
            found = uncrossed([contour], [found], closer)[0]
    if limits is None:
        return found
    return weighted(found, limits, closer if apart else None, whole)
