"""Mirrors that cannot be are told by how far nodes are from their middle."""

from __future__ import annotations

import numpy as np

from shapespline.engines.drawn.symmetry import _axis, _turns_of_mirrors


def test_no_mirror_within_reach_is_left_out():
    rng = np.random.default_rng(5)
    n_left, n_within = 0, 0
    for _ in range(200):
        half = rng.uniform(0.2, 1.0, (rng.integers(2, 5), 2))
        points = np.concatenate([half, half[::-1] * (-1.0, 1.0)])
        points += rng.normal(0.0, 0.02, points.shape)
        n, reach = len(points), 0.06
        able = _turns_of_mirrors(points, reach)
        n_left += int(able.sum())
        for turn in range(n):
            mirrored = points[[(turn - k - 1) % n for k in range(n)]]
            if _axis(points, mirrored)[1] <= reach:
                n_within += 1
                assert able[turn]
    assert 150 < n_within <= n_left < 2 * n_within  # few are looked at in vain
