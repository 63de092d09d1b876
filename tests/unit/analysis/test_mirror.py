"""Axes of symmetry, found where the data have them."""

import numpy as np
import pytest
from tests.support.shapes import flower, rectangle

from shapespline.analysis.mirror import REFINED, SAMPLES, find_mirror


@pytest.mark.parametrize("contour", [flower(), rectangle(40, 20)])
def test_axes_are_found(contour):
    mirror = find_mirror(contour)
    # The axis is that of a sum over samples, a midpoint rule: its error is a part of the square of
    # their distance, times curvatures of the product, over a slope that the whole length makes.
    step = contour.length / (SAMPLES * REFINED)
    assert mirror.error <= step**2 * contour.length / contour.box_diagonal
    for point in contour.at(np.array(mirror.crossings)):
        assert np.hypot(*(mirror.projected(point) - point)) <= mirror.error + 1e-12
