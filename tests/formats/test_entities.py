"""Entities: the same curve, cut at corners and beside lines."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from tests.support.make_fit import blob, fit_of, wave
from tests.support.shapes import flower

import shapespline as ss
from shapespline.formats.entities import entities
from shapespline.values.curve import BSplineCurve


def check(fit, found):
    """End to end, and never off the curve that went in."""
    size = fit.contour.box_diagonal
    for a, b in itertools.pairwise(found):
        assert_array_equal(a.curve.control_points[-1], b.curve.control_points[0])
    if fit.closed:
        assert_array_equal(found[-1].curve.control_points[-1], found[0].curve.control_points[0])
    within = ss.compare(fit.spline, ss.Drawing([fit_of(entity.curve) for entity in found]))
    assert within.hausdorff_distance <= 1e-12 * size


def test_a_periodic_spline_is_one_closed_entity():
    fit = fit_of(blob())
    (entity,) = entities(fit)
    assert entity.closed
    assert not entity.curve.periodic
    check(fit, [entity])
    u = np.linspace(0, 1, 101)
    assert_allclose(entity.curve(u), fit.spline(u), rtol=0, atol=1e-13 * 20)


@pytest.mark.parametrize("corners", ["auto", "free"])
@pytest.mark.parametrize("name", ["hand620_closed", "plane1100_closed", "loop500_open"])
@pytest.mark.slow
def test_real_outlines(outline, name, corners):
    fit = ss.fit_curve(outline(name), tolerance=0.2, corners=corners)
    found = entities(fit)
    check(fit, found)
    lines = sum(piece.kind == "line" for piece in fit.pieces)
    assert sum(entity.is_line for entity in found) == lines
    assert sum(entity.closed for entity in found) == (len(found) == 1 and fit.closed)


def test_a_knot_of_full_multiplicity_cuts():
    knots = [0, 0, 0, 0.25, 0.5, 0.5, 1, 1, 1]
    points = [(0, 0), (1, 1), (2, 1), (3, 0), (4, 3), (5, 0)]
    fit = fit_of(BSplineCurve(knots, points, 2))
    found = entities(fit)
    assert [entity.curve.n_control_points for entity in found] == [4, 3]
    check(fit, found)


def test_an_open_spline_is_one_entity():
    fit = fit_of(wave())
    (entity,) = entities(fit)
    assert not entity.closed
    check(fit, [entity])


def test_a_smooth_ring_of_pieces_is_one_closed_entity():
    fit = ss.fit_curve(flower(300), tolerance=0.02, corners=None)
    assert all(entity.closed for entity in entities(fit)) == (len(entities(fit)) == 1)
    check(fit, entities(fit))
