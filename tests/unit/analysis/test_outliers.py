"""Outliers: found where they are, and nothing else taken for one."""

import numpy as np
import pytest
from benchmarks.outliers import contaminated
from numpy.testing import assert_array_equal
from tests.support.shapes import flower, moved

from shapespline import Contour
from shapespline.analysis.outliers import LONGEST_RUN, find_outliers


@pytest.mark.slow
def test_none_on_clean_outlines(all_outlines):
    for name, contour in all_outlines:
        assert len(find_outliers(contour)) == 0, name


@pytest.mark.parametrize("length", range(1, LONGEST_RUN + 2))
def test_several_in_a_row(length):
    points = flower(300).points.copy()
    points[100 : 100 + length] += [7.0, 7.0]
    found = find_outliers(Contour(points, closed=True)).tolist()
    # A longer run may be a feature.
    assert found == (list(range(100, 100 + length)) if length <= LONGEST_RUN else [])


def test_a_real_spike_and_a_real_hairpin_stay():
    x = np.arange(0.0, 10.0, 0.1)
    flank = np.arange(0.1, 4.0, 0.1)
    spike = np.concatenate(
        [
            np.column_stack([x[:50], 0 * x[:50]]),
            np.column_stack([0 * flank + 5.0, flank]),
            np.column_stack([0 * flank + 5.05, flank[::-1]]),
            np.column_stack([x[51:], 0 * x[51:]]),
        ]
    )
    assert len(find_outliers(Contour(spike, closed=False))) == 0


def test_uneven_sampling_is_no_outlier():
    steps = 1000.0 ** np.random.default_rng(5).uniform(0, 1, 300)
    t = 2 * np.pi * np.cumsum(steps) / steps.sum()
    ellipse = np.column_stack([8 * np.cos(t), 5 * np.sin(t)])
    assert len(find_outliers(Contour(ellipse, closed=True))) == 0


def test_neither_motion_nor_start_nor_direction_matter(outline):
    data, _ = contaminated(outline("leaf840_closed"), 0.03, 0.05, seed=7)
    n, found = len(data), find_outliers(data)
    assert len(found) > 0
    turned = Contour(moved(data.points), closed=True)
    assert_array_equal(find_outliers(turned), found)
    rolled = Contour(np.roll(data.points, 123, axis=0), closed=True)
    assert_array_equal(np.sort((find_outliers(rolled) - 123) % n), found)
    reverse = Contour(data.points[::-1], closed=True)
    assert_array_equal(np.sort(n - 1 - find_outliers(reverse)), found)
