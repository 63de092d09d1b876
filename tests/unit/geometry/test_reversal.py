"""Curves and pieces the other way round: the same points, in the other order."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.pieces import CUBIC, LINE, piece
from tests.support.shapes import closures, some_curve

from checks import gaps, splines
from shapespline.geometry.reversal import backwards, reversed_curve


@closures
@pytest.mark.parametrize("degree", [1, 2, 3, 6])
def test_a_curve_runs_the_other_way(degree, periodic):
    curve = some_curve(degree, periodic)
    u = np.linspace(0, 1, 501)[1:-1]
    turned = reversed_curve(curve)
    # A knot of a linear curve moves by its rounding, at a slope of some thousands.
    assert turned(1 - u) == pytest.approx(curve(u), abs=1e-9)
    again = reversed_curve(turned)
    assert again.periodic is periodic
    assert again.knots == pytest.approx(curve.knots, abs=1e-15)
    assert again(u) == pytest.approx(curve(u), abs=1e-9)


def test_pieces_come_in_the_other_order():
    pieces = (
        piece(LINE, [(0, 0), (3, 1)]),
        piece(CUBIC, [(3, 1), (4, 4), (6, 2), (7, 0)]),
        piece([0, 0, 0, 0.3, 1, 1, 1], [(7, 0), (8, 1), (9, 5), (11, 3)]),
    )
    turned = backwards(pieces)
    assert [one.degree for one in turned] == [2, 3, 1]
    assert not gaps(turned, closed=False).any()
    u = np.linspace(0, 1, 64)
    for before, after in zip(splines(pieces), splines(turned[::-1]), strict=True):
        assert after(1 - u) == pytest.approx(before(u), abs=1e-14)
    for before, after in zip(pieces, backwards(turned), strict=True):
        assert_array_equal(before.control_points, after.control_points)
        assert before.knots == pytest.approx(after.knots, abs=1e-15)
