"""A stream of points: what a chunk holds."""

import numpy as np
from numpy.testing import assert_array_equal

from shapespline.streaming.stream import PointStream


def test_a_chunk_is_read_as_it_is():
    points = np.arange(20.0).reshape(10, 2)
    stream = PointStream(points)
    assert_array_equal(stream.read(2, 5), points[2:5])
    assert stream.begins == [0, 10]
    assert not stream.read(2, 5).flags.writeable  # a view of what is the caller's
    assert points.flags.writeable
