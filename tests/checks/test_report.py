"""The report of the outside checker, the forms in which it takes curves, and fingerprints."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from scipy.interpolate import BSpline, make_interp_spline
from tests.checks.test_distance import circle, ring

from checks import bits, gaps, report, splines


class Piece(NamedTuple):
    """What a piece looks like from outside."""

    kind: str
    degree: int
    knots: np.ndarray
    control_points: np.ndarray


LINE = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([(0.0, 0.0), (2.0, 1.0)]))


@pytest.mark.parametrize(
    "curve",
    [
        BSpline(LINE.knots, LINE.control_points, 1),
        (LINE.knots, LINE.control_points, 1),
        (LINE.knots, LINE.control_points, np.int64(1)),
        LINE,
        [LINE],
        (BSpline(LINE.knots, LINE.control_points, 1),),
    ],
)
def test_curves_come_in_many_forms(curve):
    (spline,) = splines(curve)
    assert spline(0.5).tolist() == [1.0, 0.5]
    assert len(splines([curve, curve, curve])) == 3


def test_a_circle():
    found = report(circle(), ring(60), closed=True, tolerance=0.01)
    assert found.forward < 1e-6 < found.reverse < 0.0014  # the sagitta of 60 sides: 0.00137
    assert (found.gap, found.crossings, found.data_crossings, found.hooks) == (0, 0, 0, 0)
    assert found.inflections == 0


def test_an_eight_that_lost_its_crossing():
    t = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    data = np.column_stack([np.sin(t), 0.2 * np.sin(2 * t)])
    closed = np.concatenate([data, data[:1]])
    curve = make_interp_spline(np.linspace(0, 1, 121), closed, bc_type="periodic")
    found = report(curve, data, closed=True, tolerance=0.05)
    assert found.crossings == found.data_crossings == 1
    around = circle()
    around.c = around.c * (1, 0.2)
    assert report(around, data, closed=True, tolerance=0.05).crossings == 0


def test_gaps_by_hand():
    parts = [LINE, LINE._replace(control_points=np.array([(2.0, 1.5), (0.0, 3.0)]))]
    assert gaps(parts, closed=False).tolist() == [0.5]
    assert gaps(parts, closed=True).tolist() == [0.5, 3.0]


def test_bits_see_the_last_one():
    values = np.linspace(0, 1, 7).reshape(-1, 1)
    assert bits(values) == bits(values.copy(order="F")) == bits(values[::1])
    assert bits(values) != bits(np.nextafter(values, 2))
    assert bits(values) != bits(values.ravel())
    assert bits(values) != bits(values.astype(np.float32))
    assert bits(np.array([0.0])) != bits(np.array([-0.0]))
    assert bits([1], [2]) != bits([1, 2])
