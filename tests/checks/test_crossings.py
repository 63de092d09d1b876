"""Crossings of the outside checker: by hand, and every pair of sides by whole numbers."""

from __future__ import annotations

import numpy as np
import pytest

from checks import crossings, self_crossings


def by_definition(one, other):
    """Pairs of sides that cross inside of both, by whole numbers; no three points on a line."""

    def side(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    count = 0
    for i in range(len(one) - 1):
        for j in range(i + 2 if one is other else 0, len(other) - 1):
            p, q, r, s = one[i], one[i + 1], other[j], other[j + 1]
            count += side(p, q, r) * side(p, q, s) < 0 and side(r, s, p) * side(r, s, q) < 0
    return count


@pytest.mark.parametrize("seed", range(10))
def test_random_ways_every_pair_tried(seed):
    rng = np.random.default_rng(seed)
    whole = [[tuple(map(int, p)) for p in rng.integers(0, 10**8, (30, 2))] for _ in range(2)]
    one, other = (np.array(way, dtype=float) for way in whole)
    assert self_crossings(one) == by_definition(whole[0], whole[0]) > 20
    assert crossings(one, other) == by_definition(*whole) > 20


def test_a_figure_eight_crosses_once():
    for n in (37, 100, 1001):
        t = np.linspace(0, 2 * np.pi, n + 1)
        eight = np.column_stack([np.sin(t), np.sin(2 * t)])
        eight[-1] = eight[0]
        # Also with a point in the crossing, and beginning there.
        for start in range(0, n, 7 if n < 1000 else 77):
            way = np.roll(eight[:-1], -start, axis=0)
            assert self_crossings(np.concatenate([way, way[:1]])) == 1


def test_what_meets_in_a_vertex_crosses_or_touches():
    plus = np.array([(-1.0, 0), (0, 0), (1, 0), (1, 1), (0, 1), (0, 0), (0, -1)])
    assert self_crossings(plus) == 1
    touching = np.array([(-1.0, -1), (0, 0), (1, -1), (2, 0), (1, 1), (0, 0), (-1, 1)])
    assert self_crossings(touching) % 2 == 0
    bar, stem = np.array([(-1.0, 0), (0, 0), (1, 0)]), np.array([(0.0, -1), (0, 0), (0, 1)])
    assert crossings(bar, stem) == crossings(bar, stem[::2]) == 1


def test_an_outline_that_closes_does_not_cross_where_it_begins():
    t = np.linspace(0, 2 * np.pi, 200)
    ring = np.column_stack([np.cos(t), np.sin(t)])  # ends where it begins up to rounding
    assert (ring[0] != ring[-1]).any()
    assert self_crossings(ring) == 0
    assert self_crossings(np.concatenate([ring[:-1], ring[:1]])) == 0


def test_long_sides_among_short_ones():
    comb = [(0.0, 0.0), (100.0, 0.0)]
    for k in range(20):
        comb += [(99.0 - k / 10, 1.0), (98.95 - k / 10, -1.0)]
    assert self_crossings(np.array(comb)) == 39


def test_a_joint_up_to_rounding_is_one_point():
    t = np.linspace(0, 3, 100)
    way = np.column_stack([t, np.sin(t)])
    rng = np.random.default_rng(1)
    doubled = np.repeat(way, 2, axis=0) + rng.normal(0, 1e-15, (200, 2))
    assert self_crossings(doubled) == 0
