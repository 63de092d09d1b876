"""A curve within a tolerance, and all that its caller is promised.

Many points are fitted in passes; curves that cross where their data do not come apart; points that
weigh more are kept closer.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from shapespline.large import fit_all_in_passes
from shapespline.tolerance import checked_corners, checked_held, fit_within
from shapespline.uncrossing import uncrossed
from shapespline.weighting import Limits, weighted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.contour import Contour
    from shapespline.drawing import Fit
    from shapespline.held import Held
    from shapespline.progress import Watch
    from shapespline.refitting import Tangents
    from shapespline.tolerance import Effort, Form
    from shapespline.typing import ArrayLike, IntArray

# So many points are fitted in passes over chunks, where nothing asks for more.
MANY_POINTS = 50_000


def fit_promised(
    contour: Contour,
    tolerance: float,
    degree: int,
    corners: Literal["auto", "free"] | ArrayLike | None,
    form: Form,
    held: Held,
    symmetric: bool,
    effort: Effort,
    weights: ArrayLike | None,
    watch: Watch,
) -> Fit:
    """The fit of `fit_curve` within a tolerance in data units, its other arguments checked."""
    corners = checked_corners(corners, len(contour))
    limits = None if weights is None else Limits.of(weights, contour, tolerance)
    apart = not (form == "spline" or held.anything or symmetric)

    def whole(within: float, through: IntArray | None = None) -> Fit:
        holding = held
        if through is not None:
            more = checked_held(contour, "free", None, np.union1d(held.through, through))
            holding = held._replace(ends=held.ends or more.ends, through=more.through)
        return fit_within(contour, within, degree, corners, form, holding, symmetric, effort, watch)

    def closer(part: Contour, within: float, tangents: Tangents, through: Sequence[int]) -> Fit:
        free = isinstance(corners, str) and corners == "free"
        ends = checked_held(part, "fixed", None if free else tangents, through or None)
        among = corners if corners is None or isinstance(corners, str) else "auto"
        return fit_within(part, within, degree, among, form, ends, False, effort, watch)

    found = None
    if len(contour) >= MANY_POINTS and not (held.anything or symmetric):
        found = fit_all_in_passes(contour, tolerance, degree, corners, form, effort, watch)
    if found is None or not (found.kept or watch.ended_as):
        found = whole(tolerance)
        if apart and not watch.ended_as:
            found = uncrossed([contour], [found], closer)[0]
    if limits is None:
        return found
    return weighted(found, limits, closer if apart else None, whole)
