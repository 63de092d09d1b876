"""Straight runs of the data."""

import pytest
from tests.support.scattered import noisy_walk
from tests.support.shapes import flower, on_circle, rectangle

from shapespline import Contour
from shapespline.analysis import has_straight_runs
from shapespline.analysis.normalization import NormalizedContour


@pytest.mark.parametrize(
    ("contour", "straight"),
    [
        (flower(2000), False),
        (Contour(on_circle(3000, 7.0), closed=True), False),
        (rectangle(400, 300, 0.1), True),
        (Contour(noisy_walk(2000, 0.01), closed=False), True),  # too noisy to tell
    ],
)
def test_straight_runs_of_the_data_are_seen(contour, straight):
    work = NormalizedContour.of(contour)
    assert has_straight_runs(work.contour, 0.05 * work.scale) is straight
