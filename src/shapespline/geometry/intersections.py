"""Which polylines cross each other, or themselves; the loops are in the kernel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray


def crossing_pairs(
    polylines: Sequence[FloatArray], *, at_vertices: bool = False
) -> set[tuple[int, int]]:
    """Pairs of polylines of which a segment crosses one of the other, (i, j) with i < j.

    Touching is no crossing. With ``at_vertices`` a way through a vertex of the other is one, and
    one that only touches a vertex may count as one.

    Examples
    --------
    >>> cross = [np.array([(0.0, 0.0), (2.0, 2.0)]), np.array([(0.0, 2.0), (2.0, 0.0)])]
    >>> crossing_pairs([*cross, np.array([(5.0, 5.0), (6.0, 6.0)])])
    {(0, 1)}
    """
    if len(polylines) < 2:
        return set()
    starts = np.cumsum([0, *(len(polyline) for polyline in polylines)])
    vertices = np.ascontiguousarray(np.concatenate(polylines), dtype=np.float64)
    return set(_kernels.crossing_pairs(vertices, starts, at_vertices))


def self_crossings(polyline: FloatArray) -> int:
    """Number of pairs of segments of a polyline that cross.

    A way through a vertex counts once, one that only touches it not at all or twice; as often for
    the mirrored polyline.

    Examples
    --------
    >>> self_crossings(np.array([(0.0, 0), (2, 2), (4, 4), (4, 0), (2, 2), (0, 4)]))
    1
    """
    return int(_kernels.count_crossings(np.ascontiguousarray(polyline)))
