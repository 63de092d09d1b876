"""On which side of its element each point lies: errors that go on leave neighbours on the same."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import FloatArray


def go_on(distances: Sequence[FloatArray]) -> bool:
    """Whether more of the neighbours lie on one side of their element than on both.

    Signed distances of each element's points given; no few large ones decide. In the half of the
    elements where it is least so: what the others are off by may be their shape (DRA-57).

    Examples
    --------
    >>> go_on([np.array([0.1, 0.3, 0.2]), np.array([-0.1, 0.4, 0.1, 0.3])])
    True
    >>> go_on([np.array([0.1, 0.3, 0.2]), np.array([-0.1, 0.4, -0.1, 0.3])])
    False
    """
    signs = [np.sign(own) for own in distances]
    products = sorted((own[1:] * own[:-1] for own in signs if len(own) > 1), key=np.mean)
    counts = np.cumsum([len(own) for own in products])
    if not len(counts):
        return False
    calm = products[: int(np.searchsorted(counts, counts[-1] / 2)) + 1]
    return float(np.concatenate(calm).sum()) > 0.0
