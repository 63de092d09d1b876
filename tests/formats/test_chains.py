"""Loose pieces chained to outlines, whatever their order and direction."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from shapespline.errors import FormatError
from shapespline.formats import chains
from shapespline.values.piece import Piece


def chained(pieces):
    return chains.chained([[piece] for piece in pieces])


def line(a, b):
    return Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([a, b], dtype=float))


def vertices(chain):
    for before, after in itertools.pairwise(chain):
        assert_array_equal(before.control_points[-1], after.control_points[0])
    return [piece.control_points[0].tolist() for piece in chain] + [
        chain[-1].control_points[-1].tolist()
    ]


RING = [(0, 0), (4, 0), (4, 3), (1, 5), (0, 2)]


@pytest.mark.parametrize("seed", range(20))
def test_a_shuffled_ring_closes_to_the_bit(seed):
    rng = np.random.default_rng(seed)
    sides = [
        line(*pair[:: rng.choice([1, -1])]) for pair in zip(RING, RING[1:] + RING[:1], strict=True)
    ]
    rng.shuffle(sides)
    jittered = [
        side._replace(control_points=side.control_points + 1e-9 * rng.standard_normal((2, 2)))
        for side in sides
    ]
    (chain,) = chained(jittered)
    found = vertices(chain)
    assert found[0] == found[-1]
    assert len(found) == 6
    assert {tuple(np.round(v, 6)) for v in found} == set(RING)


@pytest.mark.parametrize("seed", range(20))
def test_a_shuffled_path_runs_from_end_to_end(seed):
    rng = np.random.default_rng(seed)
    sides = [line(*pair[:: rng.choice([1, -1])]) for pair in itertools.pairwise(RING)]
    rng.shuffle(sides)
    (chain,) = chained(sides)
    found = [tuple(v) for v in vertices(chain)]
    assert found in (RING, RING[::-1])


def test_a_branch_ends_the_chains():
    star = [line((0, 0), tip) for tip in [(1, 0), (0, 1), (-1, 0)]]
    assert [len(chain) for chain in chained(star)] == [1, 1, 1]
    lollipop = [line(a, b) for a, b in zip(RING, RING[1:] + RING[:1], strict=True)]
    found = chained([*lollipop, line((0, 0), (-3, -3))])
    assert sorted(len(chain) for chain in found) == [1, 5]
    assert sum(len(chain) for chain in found) == 6


def test_a_piece_that_is_a_ring_itself_stays_alone():
    points = np.array([(0, 0), (1, 2), (3, 1), (0, 0)], dtype=float)
    loop = Piece("bezier", 3, np.repeat([0.0, 1.0], 4), points)
    assert [len(chain) for chain in chained([loop, line((5, 5), (6, 6))])] == [1, 1]


def test_turned_round_knots():
    bent = Piece(
        "spline", 1, np.array([0.0, 0, 0.25, 1, 1]), np.array([(2.0, 0), (1.5, 1), (1, 0)])
    )
    (chain,) = chained([line((0, 0), (1, 0)), bent])
    turned = chain[1] if chain[1].kind == "spline" else chain[0]
    straight = turned.control_points[0].tolist() == [1, 0]
    assert turned.knots.tolist() == ([0, 0, 0.75, 1, 1] if straight else [0, 0, 0.25, 1, 1])


def test_nothing():
    assert chained([]) == []
    assert chained([line((1, 1), (1, 1))]) == []


def test_coordinates_without_squares_are_refused():
    with pytest.raises(FormatError, match=r"must not exceed 1e\+60 in magnitude, found 1e\+200"):
        chained([line((0, 0), (1e200, 1))])
