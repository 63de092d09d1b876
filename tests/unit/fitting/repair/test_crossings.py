"""Slits narrower than the tolerance stay open, for few points."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from tests.support import shapes
from tests.support.engines import fit_pieces
from tests.support.places import IMAGES
from tests.support.shapes import airfoil, ribbon

import shapespline as ss
from checks import polyline_of, self_crossings, two_sided
from shapespline.fitting.repair.crossings import _no_larger_than_data, uncrossed
from shapespline.fitting.request import Request
from shapespline.fitting.settings import Settings
from shapespline.fitting.solve import answer
from shapespline.fitting.verify import verified_fit
from shapespline.geometry.intersections import crossing_pairs
from shapespline.geometry.joining import joined
from shapespline.monitor import Monitor
from shapespline.values.piece import Piece


def crossings(fit, tolerance):
    return self_crossings(polyline_of(fit.pieces, tolerance / 10))


SLITS = [
    *(
        (airfoil(camber, 2.5), part)
        for camber in (0.03, 0.06, 0.09)
        for part in (0.003, 0.008, 0.012)
    ),
    *((ribbon(waves, 0.002), part) for waves in (7, 11) for part in (0.005, 0.008)),
]


@pytest.mark.slow
def test_slits_stay_open_for_few_points():
    n_crossing = 0
    for points, part in SLITS:
        contour = ss.Contour(points, closed=True)
        tolerance = part * contour.box_diagonal
        searched = fit_pieces(contour, tolerance)
        n_crossing += crossings(searched, tolerance) > 0
        fit = ss.fit_curve(contour, tolerance=tolerance)
        assert crossings(fit, tolerance) == self_crossings(contour.polyline) == 0
        assert fit.kept
        assert two_sided(fit.curve, points, closed=True, step=tolerance / 10).larger <= tolerance
        # Cubics err with the fourth power of their length: twice the points are a fit of everything
        # within a sixteenth of the distance.
        assert fit.n_stored_points <= 2 * searched.n_stored_points
    assert n_crossing >= 3  # else no test


@pytest.mark.slow
def test_every_outline_of_a_drawing_comes_apart():
    # One of them is so narrow that a node is nearer to the other side than to its own.
    drawing = ss.fit_shape(ss.read(IMAGES / "opencv_butterfly.jpg", min_area=120), tolerance=1.5)
    assert all(fit.kept and crossings(fit, 1.5) == 0 for fit in drawing)
    assert not [fit for fit in drawing if "crosses" in fit.status.value]


@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_ways_that_cross_in_a_vertex_cross(turn):
    """Points on a grid often meet where a pen crosses its own way: nothing to part there."""
    t = np.linspace(0, 6 * np.pi, 90)
    loops = np.column_stack([6 * t + 22 * np.sin(t), 25 * np.cos(t) + 6 * np.sin(0.4 * t)])
    points = shapes.moved(np.round(loops), turn)
    contour = ss.Contour(points, closed=False)
    fit = ss.fit_curve(contour, tolerance=0.6)
    searched = fit_pieces(contour, 0.6)
    assert self_crossings(contour.polyline) == crossings(fit, 0.6) == 3
    assert fit.n_stored_points <= searched.n_stored_points < 20


def test_strokes_that_cross_in_a_vertex_cross():
    bar = np.column_stack([np.arange(-20.0, 21), np.zeros(41)])
    stem = np.column_stack([0.02 * np.arange(-20.0, 21) ** 2, np.arange(-20.0, 21)])
    assert crossing_pairs([bar, stem]) == set()
    assert crossing_pairs([bar, stem], at_vertices=True) == {(0, 1)}
    beside, above = stem + np.array([0.5, 0.0]), bar + np.array([0.0, 3.0])
    assert crossing_pairs([bar, beside], at_vertices=True) == {(0, 1)}
    assert crossing_pairs([bar, above], at_vertices=True) == set()
    shape = ss.Shape([ss.Contour(p, closed=False) for p in (bar, stem)])
    drawing = ss.fit_shape(shape, tolerance=0.3)
    assert all(fit.kept and not fit.status.value.endswith("do not") for fit in drawing)
    assert drawing.fits[0].n_stored_points == 2


def test_what_comes_apart_stores_no_more_points_than_the_data():
    contour = ss.Contour(SLITS[0][0], closed=True)
    halves = [
        Piece("line", 1, np.array([0.0, 0.0, 1.0, 1.0]), np.array(ends))
        for a, b in pairwise(contour.polyline)
        for ends in ((a, (a + b) / 2), ((a + b) / 2, b))
    ]
    larger = verified_fit(
        contour, joined(halves, 3), tolerance=0.01, method="sections", sections=tuple(halves)
    )
    assert larger.n_stored_points == 2 * len(contour)
    smaller = _no_larger_than_data(larger)
    assert smaller.kept
    assert smaller.n_stored_points == len(contour)
    assert _no_larger_than_data(smaller) is smaller


def test_a_walk_that_is_nearly_all_corners_is_joined_by_lines_at_once():
    # It crosses itself everywhere: each of hundreds of pieces would be fitted again and again.
    points = np.cumsum(np.random.default_rng(2).normal(0, 1, (500, 2)), axis=0)
    asked = []
    fit = ss.fit_curve(points, closed=False, tolerance="0.1%", callback=asked.append)
    line = polyline_of(fit.pieces, fit.tolerance / 10)
    assert fit.kept
    assert self_crossings(line) <= self_crossings(fit.contour.polyline)
    assert len(asked) < 20


def test_what_comes_apart_without_a_tolerance_keeps_what_it_has():
    points, part = SLITS[0]
    contour = ss.Contour(points[::-1], closed=True)  # read backwards, where sums round otherwise
    searched = fit_pieces(contour, part * contour.box_diagonal)
    loose = verified_fit(
        contour, searched.spline, tolerance=None, method="sections", sections=searched.sections
    )
    request = Request.of(contour, None, Settings())
    assert crossings(loose, loose.tolerance) > 0
    (apart,) = uncrossed([loose], request, lambda asked: answer(asked, Monitor()))
    assert crossings(apart, loose.tolerance) == 0
    assert apart.status.value.startswith("no tolerance asked for")
    assert apart.tolerance == max(apart.max_distance, apart.hausdorff_distance)


def test_curves_that_are_told_alone_are_looked_at_beside_each_other():
    x = np.linspace(0, 10, 150)
    low = ss.Contour(np.column_stack([x, np.sin(x)]), closed=False)
    high = ss.Contour(np.column_stack([x, np.sin(x) + 0.03 * (1.5 + np.cos(9 * x))]), closed=False)
    far = ss.Contour(high.points + np.array([0.0, 9.0]), closed=False)
    low, high, far = (ss.fit_curve(contour, tolerance=0.4) for contour in (low, high, far))
    request = Request.of(low.contour, None, Settings(tolerance=0.4))

    def apart(*fits, **said):
        return uncrossed(fits, request, lambda asked: answer(asked, Monitor()), **said)

    assert apart(low, far, each_is_told=True) == [low, far]
    assert apart(low, each_is_told=True) == [low]
    assert apart(low, high, each_is_told=True) == apart(low, high) != [low, high]
