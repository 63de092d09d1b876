"""Loose pieces chained to outlines, whatever their order and direction."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from shapespline.errors import FormatError, OpenOutlinesWarning, SkippedContentWarning
from shapespline.formats import chains
from shapespline.values import FULL_TURN
from shapespline.values.arc import Arc
from shapespline.values.piece import Piece


def chained(pieces):
    return chains.chained([[piece] for piece in pieces], "test")


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


def sides(x, y, size=10):
    """The lines of a square, drawn one after the other."""
    corners = [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]
    return [line(corners[k], corners[(k + 1) % 4]) for k in range(4)]


DIAGONAL = line((0, 0), (10, 10))


def shuffled(pieces, seed):
    """In any order and direction, each end off by what programs are off."""
    rng = np.random.default_rng(seed)
    found = [
        piece._replace(
            control_points=piece.control_points[:: rng.choice([1, -1])]
            + 1e-8 * rng.standard_normal((2, 2))
        )
        for piece in pieces
    ]
    rng.shuffle(found)
    return found


def area(chain):
    """Of a closed chain of lines, by the shoelace formula; 0 of an open one."""
    x, y = np.array(vertices(chain)).T
    closed = x[0] == x[-1] and y[0] == y[-1]
    return abs(0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) if closed else 0.0


def areas(chains):
    return sorted(round(area(chain), 3) for chain in chains)


@pytest.mark.parametrize(
    ("pieces", "expected"),
    [
        ([*sides(0, 0), DIAGONAL], [0, 100]),
        ([DIAGONAL, *sides(0, 0)], [0, 100]),
        ([line((10, 10), (0, 0)), *sides(0, 0)], [0, 100]),
        ([*sides(0, 0), *sides(10, 0)], [100, 100]),
        ([*sides(0, 0), *sides(10, 10)], [100, 100]),
        ([side for x in (0, 10, 20) for y in (0, 10, 20) for side in sides(x, y)], [100] * 9),
    ],
)
def test_what_a_file_draws_in_order_is_one_outline(pieces, expected):
    assert areas(chained(pieces)) == expected


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize(
    ("pieces", "expected"),
    [
        ([*sides(0, 0), line((0, 0), (-5, -5)), line((10, 0), (20, 0))], [0, 0, 100]),
        ([*sides(0, 0), *sides(10, 10)], [100, 100]),
        ([*sides(0, 0), line((10, 10), (20, 20)), line((20, 20), (30, 0))], [0, 100]),
    ],
)
def test_loose_ends_open_nothing_in_any_order(pieces, expected, seed):
    assert areas(chained(shuffled(pieces, seed))) == expected


def test_what_goes_on_straightest_is_joined_first():
    three = [line((10, 0), (10, 10)), *sides(0, 0)[2:], sides(0, 0)[0], *sides(10, 0)[:3]]
    rng = np.random.default_rng(4)
    for _ in range(10):
        rng.shuffle(three)
        if not any(np.array_equal(a.control_points[-1], b.control_points[0])
                   for a, b in itertools.pairwise(three)):  # fmt: skip
            assert areas(chained(three)) == [0, 200]


def test_a_seam_is_a_joint_like_any_other():
    for off in (1e-7, 1e-6, 1e-5):  # of a size of 85
        ring = [(0, 0), (60, 0), (60, 60), (0, 60)]
        lines = [
            line(a, (b[0] + off, b[1])) for a, b in zip(ring, ring[1:] + ring[:1], strict=True)
        ]
        (chain,) = chained(lines)
        assert vertices(chain)[0] == vertices(chain)[-1]
        (whole,) = chains.chained([lines], "polyline")
        assert (whole[0].control_points[0] == whole[-1].control_points[-1]).all()
    assert [len(chain) for chain in chained([line((0, 0), (1, 0)), line((1, 0), (0, 1e-2))])] == [2]


def test_rounding_to_three_decimals_opens_nothing():
    """Each end is off by up to half a thousandth across and along: 1.4e-3 from its neighbour."""
    rng = np.random.default_rng(5)
    for _ in range(20):
        turn = rng.uniform(0, 2 * np.pi)
        across = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        corners = np.array([(0, 0), (100, 0), (100, 60), (0, 60)]) @ across
        off = 5e-4 * rng.choice([-1, 1], (4, 2, 2))
        lines = [line(corners[k] + off[k, 0], corners[k - 1] + off[k, 1]) for k in range(4)]
        (chain,) = chained(lines)
        assert vertices(chain)[0] == vertices(chain)[-1]


def test_an_arc_that_all_but_closes_is_a_circle():
    for gap in (1e-11, 1e-7, 1e-6):
        (found,) = chained([Piece.of_arc(Arc((1, 2), 3.0, 0.5, gap - FULL_TURN))])
        assert found[0].arc.is_circle
        assert (found[0].control_points[0] == found[0].control_points[-1]).all()
    (found,) = chained([Piece.of_arc(Arc((1, 2), 3.0, 0.5, 0.9 * FULL_TURN))])
    assert not found[0].arc.is_circle


def test_ends_that_almost_meet_are_said_once():
    gap, corners = 0.01, [(0, 0), (100, 0), (100, 60), (0, 60)]
    lines = [line(corners[k], (corners[k - 1][0], corners[k - 1][1] + gap)) for k in range(4)]
    with pytest.warns(OpenOutlinesWarning, match=r"nearest 0.01 apart \(4 such gaps\)") as said:
        assert len(chained(lines)) == 4
    assert len(said) == 1
    # What was drawn apart, ends on others and dashes are no gaps.
    chained([line((0, 0), (100, 0)), line((0, 0.2), (100, 0.2))])
    chained([line((0, 0), (100, 0)), *(line((0, y), (-9, y)) for y in (0, 3, -3))])
    chained([line((x, 0), (x + 0.06, 0)) for x in np.arange(0, 100, 0.09)])


def test_repeated_runs_are_left_out_and_said():
    square = sides(0, 0)
    for pieces, count, expected in [
        ([*square, square[1]], "an entity that repeats another was", [100]),
        ([square[1], *square], "an entity that repeats another was", [100]),
        (square * 3, "8 entities that repeat others were", [100]),
        (square[:3] * 2, "3 entities that repeat others were", [0]),
        ([DIAGONAL] * 2, "an entity that repeats another was", [0]),
    ]:
        for seed in range(5):
            with pytest.warns(SkippedContentWarning, match=f"test: {count} left out"):
                assert areas(chained(shuffled(pieces, seed))) == expected
        with pytest.warns(SkippedContentWarning, match=f"test: {count} left out"):
            assert areas(chained(pieces)) == expected


def test_outlines_that_repeat_others_however_they_are_cut():
    square = sides(0, 0)
    with pytest.warns(SkippedContentWarning, match="an entity that repeats another"):
        (found,) = chains.chained([[*square[2:], *square[:2]], *([side] for side in square)], "x")
    assert area(found) == 100
    circles = [Piece.of_arc(Arc((1, 2), 3.0, start, sweep)) for start, sweep in
               [(0.0, FULL_TURN), (2.0, -FULL_TURN)]]  # fmt: skip
    with pytest.warns(SkippedContentWarning, match="an entity that repeats another"):
        assert len(chained(circles)) == 1


def test_a_crumb_between_two_ends_opens_nothing():
    _, *others = sides(0, 0)
    near = [(0, 0), (1e-7, 0)]
    assert areas(chained([line(*near), line(near[1], (10, 0)), *others])) == [0, 100]


def test_small_outlines_far_from_the_origin_of_a_drawing_are_none_the_less_joined():
    small = [line(*(piece.control_points + 1e7)) for piece in [*sides(0, 0), *sides(1, 1, 8)]]
    assert areas(chained([*small, line((0, 0), (1, 0))])) == [0, 64, 100]


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
