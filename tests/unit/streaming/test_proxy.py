"""The polyline that stands for a stream: as near to all points as it says, both ways."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.scattered import N, rose

from checks import distance_to_polyline
from shapespline.errors import InvalidInputError
from shapespline.streaming import Passes, PointStream, ProxyPolyline

# So many points are looked at from outside.
SOME = 2000


def proxy_of(points, closed, tolerance, longest=np.inf):
    passes = Passes(PointStream(points), None, 2)
    return ProxyPolyline.of(passes, passes.look(), closed, tolerance, longest)


def assert_stands_for(proxy, points, closed):
    line = proxy.points
    if closed:
        line = np.concatenate([line, line[:1]])
        points = np.concatenate([points, points[:1]])
    bound = proxy.error_bound * (1 + 1e-9)
    some = points[:: len(points) // SOME]
    assert distance_to_polyline(some, line).max() <= bound
    share = np.linspace(0, 1, 5)[:, None, None]
    dense = (line[:-1] + share * np.diff(line, axis=0)).reshape(-1, 2)
    assert distance_to_polyline(dense[:: max(1, len(dense) // SOME)], points).max() <= bound
    assert (np.diff(proxy.indices) > 0).all()


@pytest.mark.slow
@pytest.mark.parametrize("closed", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_clean_points_are_thinned(closed):
    points = rose(N) if closed else rose(N)[: 3 * N // 4]
    proxy = proxy_of(points, closed, 0.1)
    assert_stands_for(proxy, points, closed)
    assert proxy.error_bound <= 0.01 * 0.1
    assert len(proxy.points) < 5000
    assert_array_equal(proxy.points, points[proxy.indices])
    if not closed:
        assert_array_equal(proxy.points[[0, -1]], points[[0, -1]])


@pytest.mark.slow
@pytest.mark.parametrize("closed", [True, False])
def test_points_that_scatter_are_averaged(closed):
    points = rose(N, 0.01) if closed else rose(N, 0.01)[: 3 * N // 4]
    proxy = proxy_of(points, closed, 0.15)
    assert_stands_for(proxy, points, closed)
    assert proxy.error_bound < 0.15
    assert len(proxy.points) < 20_000
    if not closed:
        assert_array_equal(proxy.points[[0, -1]], points[[0, -1]])


def test_chords_are_no_longer_than_asked():
    points = rose(N)
    proxy = proxy_of(points, True, 0.1, longest=0.5)
    assert np.hypot(*np.diff(proxy.points, axis=0).T).max() <= 0.5 * (1 + 1e-9)


@pytest.mark.slow
def test_what_no_polyline_of_few_vertices_stands_for_is_refused():
    with pytest.raises(InvalidInputError, match=r"tolerance must be larger .* they scatter by"):
        proxy_of(rose(N, 0.1), True, 0.05)
