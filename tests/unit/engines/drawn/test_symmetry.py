"""Outlines that are their own images: which mirrors are tried, and what is level then."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.renderers import exact
from benchmarks.drawn.shapes import rounded

import shapespline as ss
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


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_level_edges_of_a_nut_with_small_fillets_are_level(seed):
    # Centres of its arcs follow from their neighbours but for rounding, which told the direction
    # of all edges to 1e-9 radians where they were told before the radii.
    angle = np.pi / 6 + np.pi / 3 * np.arange(6)
    corners = 100 * np.column_stack([np.cos(angle), np.sin(angle)])
    moved = np.random.default_rng(seed).uniform(-0.5, 0.5, 2) + 128
    nut = [one.moved(1.0, 0.0, moved) for one in rounded(corners, 4.0)]
    fit = ss.fit_shape(ss.trace(exact([nut], 256)), character="drawn").fits[0]
    assert {one.name for one in fit.regularities} >= {"rotation", "axis-parallel"}
    edges = [piece.control_points for piece in fit.pieces if piece.kind == "line"]
    assert sum(bool((np.ptp(edge, axis=0) == 0.0).any()) for edge in edges) == 2
