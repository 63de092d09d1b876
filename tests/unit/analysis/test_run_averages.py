"""Averages of runs of points: as near to all of them as they say."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.scattered import rose

from checks import distance_to_polyline
from shapespline.analysis.run_averages import averaged, averages, strayed


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("noise", [0.0, 0.05, 1.0])
@pytest.mark.slow
def test_averages_lie_as_near_as_they_say(closed, noise):
    points = rose(5000, noise, seed=3)
    if not closed:
        points = points[:4000]
    found = averaged(points, closed, np.array([777]))
    assert_array_equal(found.nodes[found.indices == 777], points[[777]])
    nodes, data = found.nodes, points
    if closed:
        nodes, data = (np.concatenate([a, a[:1]]) for a in (nodes, data))
    assert distance_to_polyline(points, nodes).max() <= found.error_bound * (1 + 1e-12)
    share = np.linspace(0, 1, 9)[:, None, None]
    dense = (nodes[:-1] + share * np.diff(nodes, axis=0)).reshape(-1, 2)
    assert distance_to_polyline(dense, data).max() <= found.error_bound * (1 + 1e-12)


def test_what_strays_is_seen():
    points = np.column_stack([np.arange(100.0), np.zeros(100)])
    points[45, 1] = 7.0
    assert averages(points, 10).error_bound >= 6.0
    nodes = np.array([(0.0, 0.0), (4.0, 0.0), (8.0, 0.0)])
    run = np.array([0, 1, 1, 2])
    assert strayed(nodes, np.array([(0.0, 0), (3, 1), (5, -1), (8, 0)]), run) == 1.0
