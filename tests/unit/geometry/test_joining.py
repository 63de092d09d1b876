"""Pieces as one B-spline: the same curve, the right knots."""

from itertools import pairwise
from math import comb, dist

import numpy as np
import pytest
from scipy.interpolate import BSpline
from tests.support.pieces import CUBIC, LINE, QUADRATIC, bezier, piece

from shapespline import _kernels
from shapespline.errors import InvalidInputError
from shapespline.geometry.joining import elevated, joined


def spline_piece(rng, inner, begin):
    points = np.concatenate([[begin], rng.uniform(-5, 5, (3 + len(inner), 2))])
    return piece([0, 0, 0, 0, *inner, 1, 1, 1, 1], points)


def chain(rng):
    """A line, a quadratic, a cubic, a spline, end to end."""
    line = piece(LINE, [(0, 0), (3, 1)])
    bend = piece(QUADRATIC, [(3, 1), (4, 4), (6, 2)])
    curve = piece(CUBIC, [(6, 2), (8, 1), (9, 5), (11, 3)])
    return [line, bend, curve, spline_piece(rng, [0.2, 0.5, 0.5, 0.9], (11, 3))]


@pytest.mark.parametrize("degree", range(3, 10))
def test_elevation_leaves_the_curve_as_it_is(rng_pieces, degree):
    u = np.linspace(0, 1, 300)
    for part in rng_pieces:
        raised = elevated(part, degree)
        assert raised.degree == degree
        before = BSpline(part.knots, part.control_points, part.degree)(u)
        after = BSpline(raised.knots, raised.control_points, degree)(u)
        # Means of at most 84 blossoms, each a few roundings of numbers up to 20.
        assert np.abs(after - before).max() < 1e-12


@pytest.fixture
def rng_pieces():
    return chain(np.random.default_rng(4))


@pytest.mark.parametrize("degree", [3, 4, 5, 9])
def test_joined_is_the_pieces_end_to_end(rng_pieces, degree):
    whole = joined(rng_pieces, degree)
    assert whole.domain == (0.0, 1.0)
    full = [u for u in whole.breakpoints if np.count_nonzero(whole.knots == u) >= degree]
    assert len(full) == len(rng_pieces) + 1
    for part, a, b in zip(rng_pieces, full, full[1:], strict=False):
        u = np.linspace(0, 1, 100)[:-1]
        expected = BSpline(part.knots, part.control_points, part.degree)(u)
        assert np.abs(whole(a + u * (b - a)) - expected).max() < 1e-11


def test_a_common_tangent_saves_a_knot_and_the_curve_is_c1():
    line = piece(LINE, [(0, 0), (4, 0)])
    bend = piece(CUBIC, [(4, 0), (5, 0), (6, 1), (6, 3)])
    whole = joined([line, bend], 3)
    joint = whole.breakpoints[1]
    assert np.count_nonzero(whole.knots == joint) == 2
    assert whole([joint])[0] == pytest.approx([4, 0], abs=1e-12)
    before, after = whole([joint - 1e-9, joint + 1e-9], derivative=1)
    assert before == pytest.approx(after, abs=1e-6)
    u = np.linspace(0, 1, 50)[:-1]
    expected = BSpline(bend.knots, bend.control_points, 3)(u)
    assert np.abs(whole(joint + u * (1 - joint)) - expected).max() < 1e-12


def test_a_corner_is_a_knot_of_full_multiplicity():
    whole = joined([piece(LINE, [(0, 0), (1, 0)]), piece(LINE, [(1, 0), (1, 1)])], 3)
    assert np.count_nonzero(whole.knots == 0.5) == 3


def test_the_highest_degree_is_enough(rng_pieces):
    assert [joined(rng_pieces[:count]).degree for count in (1, 2, 3, 4)] == [1, 2, 3, 3]


def test_lines_only_make_a_spline_of_degree_one():
    whole = joined([piece(LINE, [(0, 0), (1, 0)]), piece(LINE, [(1, 0), (1, 1)])], 1)
    assert whole.control_points.tolist() == [[0, 0], [1, 0], [1, 1]]


@pytest.mark.parametrize("leg", [4.0, 0.2, 0.01, 1e-9])
def test_no_piece_rushes_past(leg):
    """However near to a smooth joint the next control point lies, each piece has its share."""
    line = piece(LINE, [(0, 0), (30, 0)])
    bow = piece(CUBIC, [(30, 0), (30 + leg, 0), (60, 5), (60, 30)])
    after = piece(LINE, [(60, 30), (60, 60)])
    curve = joined([line, bow, after], 3)
    x, y = curve(np.linspace(0, 1, 2001)).T
    on_bow = (x > 30) & (y < 30)
    lengths = [part.polygon_length for part in (line, bow, after)]
    # A tenth of the share, of which the other two may have ten times theirs.
    assert on_bow.mean() > lengths[1] / sum(lengths) / 100
    breaks, counts = np.unique(curve.knots, return_counts=True)
    assert np.diff(breaks).min() > 0.003
    # Only where the next control point is near is the joint a full knot.
    assert counts[1] == (2 if leg > 1 else 3)


@pytest.mark.parametrize("p", [1, 2, 3, 6])
@pytest.mark.parametrize("degree", [3, 6, 9])
def test_elevation_of_a_bezier_is_the_formula(p, degree):
    if p >= degree:
        return
    points = np.random.default_rng(p).normal(0, 5, (p + 1, 2))
    shares = [
        [
            comb(p, j) * comb(degree - p, i - j) / comb(degree, i) if i >= j else 0
            for j in range(p + 1)
        ]
        for i in range(degree + 1)
    ]
    # Means of up to seven numbers about 5.
    assert elevated(bezier(*points), degree).control_points == pytest.approx(
        np.array(shares) @ points, abs=1e-13
    )


def test_polygons_are_as_long_as_python_says():
    rows = [np.random.default_rng(n).normal(0, 10, (n, 2)) for n in (2, 3, 4, 9)]
    found = _kernels.polygon_lengths([len(row) for row in rows], np.concatenate(rows))
    expected = [sum(dist(*step) for step in pairwise(row.tolist())) for row in rows]
    assert found == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    "wrong",
    [
        bezier((0, 0), (1, 0), (2, 1), (3, 3), (4, 0)),
        bezier((0, 0), (1, 0))._replace(degree=3, knots=np.arange(6.0)),
        bezier((0, 0), (1, 0))._replace(knots=np.arange(3.0)),
        bezier((0, 0), (1, 0))._replace(degree=0, knots=np.arange(3.0)),
    ],
)
def test_pieces_whose_knots_do_not_fit_are_refused(wrong):
    with pytest.raises(InvalidInputError, match="pieces must have a degree of 1 to 3"):
        joined([bezier((0, 0), (0, 0)), wrong], 3)
