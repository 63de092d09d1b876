"""Averages of runs of points: as near to all of them as they say."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.scattered import rose

from checks import distance_to_polyline
from shapespline.analysis.run_averages import (
    WIDTHS,
    at_end,
    averaged,
    averages,
    best_width,
    joint,
    strayed,
)


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


def test_runs_by_hand():
    points = np.column_stack([np.arange(12.0), np.zeros(12)])
    found = averages(points, 3)
    assert found.nodes[:, 0].tolist() == [1, 4, 7, 10]
    assert found.indices.tolist() == [1, 4, 7, 10]
    assert found.error_bound == 0
    assert [len(run) for run in (*found.head, *found.tail)] == [3, 3, 3, 3]
    # At least four runs; points that are to be alone are runs of their own.
    assert averages(points, 100).nodes[:, 0].tolist() == [1, 4, 7, 10]
    alone = averages(points, 3, np.array([4]))
    assert alone.nodes[:, 0].tolist() == [1, 3, 4, 5, 7, 10]


def test_the_widest_run_that_is_about_as_near_is_taken():
    assert best_width([1.0, 0.5, 0.4, 0.43, 0.45]) == WIDTHS[3]
    assert best_width([0.1, 0.5, 0.4, 0.43, 0.45]) == WIDTHS[0]
    assert best_width([0.3] * 5) == WIDTHS[-1]


def test_where_chunks_meet_points_count_too():
    straight = averages(np.column_stack([np.arange(40.0), np.zeros(40)]), 10)
    on = np.column_stack([np.arange(40.0, 80.0), np.zeros(40)])
    assert joint(straight, averages(on, 10)) == 0
    on[3, 1] = 5.0  # its average is off by a tenth of that, the point itself by nearly all
    assert 4.5 <= joint(straight, averages(on, 10)) <= 5.0
    assert at_end(np.array([0.0, 0.0]), straight.head) == 0
    assert at_end(np.array([0.0, 3.0]), straight.head) > 0.5
