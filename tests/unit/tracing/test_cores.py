"""Cores of strokes tell which ink their edges are of."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

from shapespline.tracing.palette import palette_of


def test_edges_of_a_black_line_are_not_of_a_grey_between():
    # Of both lines the pixels above are half covered: those of the black one are as grey as the
    # grey line itself.
    picture = np.full((60, 80, 3), 255, dtype=np.uint8)
    for row, ink in ((10, 0), (40, 128)):
        picture[row : row + 2, 5:75] = ink
        picture[row - 1, 5:75] = (ink + 255) // 2 + 1
    colors, labels = palette_of(picture, "auto")
    black, grey, white = (int(np.flatnonzero(colors[:, 0] == v)[0]) for v in (0, 128, 255))
    wanted = np.full(labels.shape, white)
    wanted[10:12, 5:75], wanted[40:42, 5:75] = black, grey
    assert_array_equal(labels, wanted)
