"""Runs of pieces that repeat others: the same geometry, drawn again."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry import backwards

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Piece

# Knots over [0, 1] that differ by less are the same.
SAME_KNOT = 1e-6


def repeated(runs: Sequence[Sequence[Piece]], part: float) -> IntArray:
    """For each run the first one that it repeats, itself if there is none.

    Parameters
    ----------
    runs : sequence of sequences of Piece
        Those that end where they begin may begin elsewhere.
    part : float
        Control points within this part of the extent of a run are one: of the drawing it would
        take small things for each other wherever something lies far off.

    Examples
    --------
    >>> from shapespline.formats import bezier
    >>> there, back = bezier([(0, 0), (4, 1)]), bezier([(4, 1), (0, 0)])
    >>> repeated([[there], [bezier([(0, 0), (4, 0)])], [back]], 1e-6).tolist()
    [0, 1, 0]
    """
    from scipy.spatial import cKDTree

    # Those that repeat others to the bit may be many.
    known: dict[tuple[Piece, ...], int] = {}
    keys = [tuple(run) for run in runs]
    found = np.array([known.setdefault(key, number) for number, key in enumerate(keys)], dtype=int)
    which = np.array(list(known.values()), dtype=int)
    boxes = np.array([_box(run) for run in runs])
    near = part * np.hypot(*(boxes[:, 2:] - boxes[:, :2]).T)
    pairs = cKDTree(boxes[which]).query_pairs(float(near.max()), p=np.inf, output_type="ndarray")
    for one, other in sorted(which[pairs].tolist()):
        if (found[[one, other]] == (one, other)).all() and _same(runs[one], runs[other], near[one]):
            found[other] = one
    return found[found]


def _box(run: Sequence[Piece]) -> FloatArray:
    """Least and largest coordinates of the control points; of a circle its own."""
    arc = run[0].arc
    if arc is not None and arc.is_circle:
        points = np.add(arc.centre, [[-arc.radius], [arc.radius]])
    else:
        points = np.concatenate([piece.control_points for piece in run])
    return np.concatenate([points.min(axis=0), points.max(axis=0)])


def _same(one: Sequence[Piece], other: Sequence[Piece], near: float) -> bool:
    """Whether two runs are the same, whichever way and, if closed, wherever they begin."""
    if len(one) != len(other):
        return False
    begin = one[0].control_points[0]
    for turned in (other, backwards(other)):
        for first, piece in enumerate(turned):
            if np.abs(piece.control_points[0] - begin).max() <= near:
                moved = [*turned[first:], *turned[:first]]
                if all(_alike(a, b, near) for a, b in zip(one, moved, strict=True)):
                    return True
    a, b = one[0].arc, other[0].arc
    if len(one) > 1 or a is None or b is None or not (a.is_circle and b.is_circle):
        return False
    apart = np.hypot(a.centre[0] - b.centre[0], a.centre[1] - b.centre[1])
    return bool(max(apart, abs(a.radius - b.radius)) <= near)


def _alike(one: Piece, other: Piece, near: float) -> bool:
    return (
        (one.arc is None) == (other.arc is None)
        and one.control_points.shape == other.control_points.shape
        and bool(np.abs(one.control_points - other.control_points).max() <= near)
        and bool(np.abs(one.knots - other.knots).max() <= SAME_KNOT)
    )
