"""Crossings of polylines, by hand."""

from __future__ import annotations

import numpy as np

from shapespline.geometry.intersections import crossing_pairs, self_crossings


def test_crossings_by_hand():
    a = np.array([(0.0, 0.0), (4.0, 4.0)])
    b = np.array([(0.0, 4.0), (4.0, 0.0)])
    touching = np.array([(4.0, 4.0), (8.0, 0.0)])
    assert crossing_pairs([a, b, touching]) == {(0, 1)}
    assert self_crossings(np.array([(-1.0, -2), (0, 0), (2, 2), (2, 0), (0, 2)])) == 1
    rng = np.random.default_rng(1)
    long = np.cumsum(rng.standard_normal((3000, 2)), axis=0)
    assert crossing_pairs([long, long + 0.1]) == {(0, 1)}
