"""Outlines with free-form parts that are one but for their places: letters of a word, two ears.

What lines and arcs alone make up is solved together (`across`); of the others one curve, as it was
drawn or the smallest, stands for its copies, moved, turned or mirrored, wherever it tells their
points as well as its own (DRA-31).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.fitting.across import MISSED, MOST_OUTLINES, WORSE_BY, WORSE_PART
from shapespline.fitting.motions import PLACES, Placed, motion_between
from shapespline.geometry import polyline_curve, two_sided_distance
from shapespline.values import Contour, Regularity

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.fitting.motions import Motion
    from shapespline.values import Fit

# An outline of fewer points tells no copies; lengths of copies differ by less than this part
# (DRA-31).
FEWEST_POINTS, LENGTHS = 12, 0.01


def equal_copies(
    fits: Sequence[Fit], tolerance: float | None
) -> tuple[list[Fit], tuple[Regularity, ...]]:
    """The fits with one curve for all copies of an outline, and which these are.

    Parameters
    ----------
    fits : sequence of Fit
    tolerance : float or None
        The one asked for.
    """
    able = [k for k, fit in enumerate(fits) if _has_curves(fit)]
    if not 1 < len(able) <= MOST_OUTLINES:
        return list(fits), ()
    seen = {k: Placed(fits[k], fits[k].contour) for k in able}
    found = list(fits)
    heads: dict[int, dict[int, float]] = {}
    for k in sorted(able, key=lambda k: (fits[k].method != "drawn", fits[k].n_stored_points, k)):
        for head, copies in heads.items():
            motion = _motion(seen[head], seen[k])
            copy = None if motion is None else _copy(seen[head], seen[k], motion, tolerance)
            if motion is not None and copy is not None:
                found[k], copies[k] = copy, _miss(seen[head], seen[k], motion)
                break
        else:
            heads[k] = {}
    return found, tuple(
        Regularity("equal-copies", tuple(sorted((head, *copies))), max(copies.values()))
        for head, copies in heads.items()
        if copies
    )


def _has_curves(fit: Fit) -> bool:
    """Whether it may be a copy, of more than lines and arcs."""
    return may_be_copy(fit) and any(piece.kind not in ("line", "arc") for piece in fit.pieces)


def may_be_copy(fit: Fit) -> bool:
    """Whether nothing but its own points shaped the fit of a closed outline."""
    enough = len(fit.contour) >= FEWEST_POINTS and fit.closed and fit.kept
    return enough and fit.uncertainty is None and not len(fit.outliers)


def _motion(head: Placed, other: Placed) -> Motion | None:
    near = MISSED * max(head.deviation, other.deviation) + 0.5 * head.line.length / PLACES
    return motion_between(head, other, near, LENGTHS)


def _miss(head: Placed, other: Placed, motion: Motion) -> float:
    """How far the data of one, moved, are from those of the other."""
    images = head.images(head.line.points, motion, other)
    image = polyline_curve(Contour.silently(images, closed=True))
    return two_sided_distance(image, other.line).hausdorff_distance


def _copy(head: Placed, other: Placed, motion: Motion, tolerance: float | None) -> Fit | None:
    """The curve of one as that of the other; None if it is not as good there."""
    fit = head.as_fit_of(other, motion, tolerance)
    return fit if fit.kept and is_as_good(fit, head, other) else None


def is_as_good(fit: Fit, head: Placed, other: Placed) -> bool:
    """Whether the curve of one tells the points of another as well as its own, or those of this."""
    old, reach = other.fit, MISSED * max(head.deviation, other.deviation)
    rms = max(old.rms_distance, head.fit.rms_distance)
    rms = max(WORSE_PART * rms, rms + WORSE_BY * other.deviation)
    far = max(old.hausdorff_distance, head.fit.hausdorff_distance) + reach
    return fit.rms_distance <= rms and fit.hausdorff_distance <= far
