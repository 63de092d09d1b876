"""Runs between corners: where corners may go, how an open contour is fitted."""

from __future__ import annotations

import numpy as np

from shapespline import Contour
from shapespline.fitting.runs import Runs
from shapespline.monitor import Monitor


def hook(n: int = 30, at: int = 1) -> Contour:
    """A straight row whose first points stand up, noise of 0.01."""
    points = np.column_stack([np.maximum(np.arange(n) - at, 0), np.maximum(at - np.arange(n), 0)])
    return Contour(points + np.random.default_rng(1).normal(0, 0.01, points.shape), closed=False)


def test_a_corner_beside_an_end_is_not_moved_onto_it():
    # That ended in "zip() argument 2 is longer than argument 1".
    runs = Runs(hook(), 3, 0.01, Monitor())
    assert runs._placed([1])[0] >= 1
    assert runs._placed([28])[0] <= 28


def test_lines_and_splines_of_an_open_contour_end_in_its_ends_and_meet_in_its_corner():
    contour = hook(60, 20)
    pieces = Runs(contour, 3, 0.01, Monitor()).fitted()
    assert [piece.kind for piece in pieces] == ["line", "line"]
    assert np.array_equal(pieces[0].control_points[0], contour.points[0])
    assert np.array_equal(pieces[1].control_points[-1], contour.points[-1])
    assert np.array_equal(pieces[0].control_points[-1], pieces[1].control_points[0])
    # Two lines of twenty and forty points: their crossing is known to less than a deviation.
    assert np.hypot(*pieces[0].control_points[-1]) < 3 * 0.01
