"""Places of a drawing at which ends of runs lie together."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import BoolArray, IntArray
    from shapespline.values import Piece

# Of the extent of a run: its ends are moved no farther, however large something far off makes the
# drawing. Three decimals join what is longer than a hundred of the last of them.
LARGEST_PART = 0.01


class Places(NamedTuple):
    """The place of each end, 2 i the start of run i, 2 i + 1 its end; which runs are crumbs.

    A crumb lies at one place whole, between others that meet there.
    """

    of_ends: IntArray
    is_crumb: BoolArray


def places(runs: Sequence[Sequence[Piece]], near: float) -> Places:
    """Ends within ``near`` of each other, by way of others too, are at one place.

    Examples
    --------
    >>> from shapespline.formats import bezier
    >>> runs = [[bezier([(0, 0), (4, 0)])], [bezier([(0, 3), (0, 0)])]]
    >>> start, corner, other, again = places(runs, 1e-6).of_ends.tolist()
    >>> start == again, corner == other
    (True, False)
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    lines = [np.concatenate([piece.control_points for piece in run]) for run in runs]
    reach = np.minimum(
        near, LARGEST_PART * np.array([np.hypot(*np.ptp(xy, axis=0)) for xy in lines])
    )
    ends = np.array([point for line in lines for point in (line[0], line[-1])])
    points, which = np.unique(ends, axis=0, return_inverse=True)
    widest = np.zeros(len(points))
    np.maximum.at(widest, which, np.repeat(reach, 2))
    pairs = cKDTree(points).query_pairs(float(widest.max()), output_type="ndarray")
    apart = np.hypot(*(points[pairs[:, 0]] - points[pairs[:, 1]]).T)
    pairs = pairs[apart <= np.minimum(widest[pairs[:, 0]], widest[pairs[:, 1]])]
    links = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(points), len(points)))
    of_ends = connected_components(links, directed=False)[1][which]
    gaps = np.hypot(*(ends[::2] - ends[1::2]).T)
    return Places(of_ends, (of_ends[::2] == of_ends[1::2]) & (gaps > reach))
