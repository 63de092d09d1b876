"""Arcs of open outlines whose ends are held: through both, however straight they are."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

import shapespline as ss
from shapespline.values import Contour

TOLERANCE = 0.3


def nearly_straight(seed):
    """Points of a picture's edge that rises by a part of a pixel or a whole one, its ends moved."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0.0, 1.0, 132)
    x = 4 * rng.uniform(0.1, 1.0) * t * (1 - t) + rng.normal(0, 0.03, len(t))
    x[[0, -1]] += rng.normal(0, 0.07, 2)
    points = np.column_stack([x, 130 * t])
    return Contour(points, False, accuracy=0.04, level_line=points)


def test_arcs_lie_beside_their_twins_and_begin_where_they_are_held():
    arcs = 0
    for seed in range(40):
        contour = nearly_straight(seed)
        fit = ss.fit_curve(contour, ends="fixed", tolerance=TOLERANCE)
        assert fit.kept
        assert_array_equal(fit.pieces[0].control_points[0], contour.points[0])
        assert_array_equal(fit.pieces[-1].control_points[-1], contour.points[-1])
        for piece in fit.pieces:
            arcs += piece.arc is not None
            assert piece.twin_error <= 0.01 * TOLERANCE
    assert arcs > 20  # else this is no test
